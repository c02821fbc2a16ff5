#!/usr/bin/env python3
"""The comparison's scenes for Blender's Cycles; the .tyn files beside this one are the same for Tyndall, and the .pov files
for POV-Ray.

  blender -b --factory-startup -P cycles_scene.py -- --scene cloud --samples 64 --seed 1 --out picture.exr

Renders on two threads, with nothing but path tracing: no denoising, no clamping, no light threshold, a box filter of
one pixel. Prints `CYCLES {"cpu_seconds": …}`: what the render took, without Blender's own start.
"""
import argparse
import json
import math
import pathlib
import resource
import sys

import bpy
import numpy
from mathutils import Matrix, Vector

parser = argparse.ArgumentParser(prog="cycles_scene.py")
parser.add_argument("--scene", required=True, choices=["point-light", "sphere-light", "cloud", "slab", "smoke", "model", "fire", "lamps", "motion"])
parser.add_argument("--samples", type=int, required=True)
parser.add_argument("--seed", type=int, required=True)
parser.add_argument("--bounces", type=int, required=True)
parser.add_argument("--no-sky", action="store_true", help="without the cloud's sky")
parser.add_argument("--grid", help="the file of the smoke")
parser.add_argument("--resolution", default="320x240")
parser.add_argument("--out", required=True)
options = parser.parse_args(sys.argv[sys.argv.index("--") + 1 :])

bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene


def settings():
    scene.render.engine = "CYCLES"
    scene.render.threads_mode, scene.render.threads = "FIXED", 2
    scene.render.resolution_x, scene.render.resolution_y = map(int, options.resolution.split("x"))
    scene.render.resolution_percentage = 100
    scene.render.use_compositing = scene.render.use_sequencer = False
    scene.render.dither_intensity = 0
    scene.view_settings.view_transform = "Raw"
    image = scene.render.image_settings
    image.file_format, image.color_mode, image.color_depth = "OPEN_EXR", "RGB", "32"
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.samples, cycles.seed = options.samples, options.seed
    cycles.use_denoising = cycles.use_adaptive_sampling = False
    cycles.sampling_pattern = "PROGRESSIVE_MULTI_JITTER"
    cycles.pixel_filter_type, cycles.filter_width = "BOX", 1.0
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.light_sampling_threshold = 0
    cycles.blur_glossy = 0
    cycles.volume_bounces = options.bounces
    cycles.max_bounces = options.bounces + 2
    cycles.diffuse_bounces = cycles.glossy_bounces = cycles.transmission_bounces = 0
    cycles.volume_step_rate, cycles.volume_max_steps = 1, 65536
    cycles.tile_size, cycles.use_auto_tile = 2048, False


def link(thing):
    scene.collection.objects.link(thing)
    return thing


def y_up(x, y, z):
    """A place of a scene whose y axis goes up: Blender's z axis does."""
    return (x, -z, y)


def camera(place, target, degrees, fit="HORIZONTAL"):
    data = bpy.data.cameras.new("camera")
    data.sensor_fit, data.angle = fit, math.radians(degrees)
    data.clip_start, data.clip_end = 1e-4, 1e5
    scene.camera = link(bpy.data.objects.new("camera", data))
    scene.camera.location = place
    scene.camera.rotation_euler = (Vector(target) - Vector(place)).to_track_quat("-Z", "Y").to_euler()


def world(radiance):
    scene.world = bpy.data.worlds.new("world")
    scene.world.use_nodes = True
    background = scene.world.node_tree.nodes["Background"].inputs
    background[0].default_value, background[1].default_value = (radiance,) * 3 + (1,), 1


def sun(towards, irradiance):
    data = bpy.data.lights.new("sun", "SUN")
    data.energy, data.angle = irradiance, 0
    lamp = link(bpy.data.objects.new("sun", data))
    lamp.rotation_euler = Vector(towards).to_track_quat("Z", "Y").to_euler()  # it shines along -Z


def box(half, material, center=(0, 0, 0)):
    corners = [(x * half[0], y * half[1], z * half[2]) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    data = bpy.data.meshes.new("box")
    data.from_pydata(corners, [], faces)
    data.materials.append(material)
    thing = link(bpy.data.objects.new("box", data))
    thing.location = center
    return thing


def box_between(low, high, material):
    half = [(b - a) / 2 for a, b in zip(low, high)]
    return box(half, material, [(a + b) / 2 for a, b in zip(low, high)])


def ground(half, material):
    data = bpy.data.meshes.new("ground")
    data.from_pydata([(-half, -half, 0), (half, -half, 0), (half, half, 0), (-half, half, 0)], [], [(0, 1, 2, 3)])
    data.materials.append(material)
    link(bpy.data.objects.new("ground", data))


def matte(reflectance):
    n = Nodes("matte", True)
    surface = n.tree.nodes.new("ShaderNodeBsdfDiffuse")
    surface.inputs["Color"].default_value = (reflectance,) * 3 + (1,)
    n.tree.links.new(surface.outputs[0], n.output.inputs["Surface"])
    return n.material


def point_lamp(place, watts, radius=0):
    data = bpy.data.lights.new("lamp", "POINT")
    data.energy, data.shadow_soft_size = watts, radius
    link(bpy.data.objects.new("lamp", data)).location = place


class Nodes:
    """A material's nodes."""

    def __init__(self, name, even):
        self.material = bpy.data.materials.new(name)
        self.material.use_nodes = True
        self.tree = self.material.node_tree
        self.tree.nodes.clear()
        self.output = self.tree.nodes.new("ShaderNodeOutputMaterial")
        self.material.cycles.homogeneous_volume = even
        self.material.cycles.volume_sampling = "MULTIPLE_IMPORTANCE"

    def set(self, socket, value):
        if isinstance(value, (int, float)):
            socket.default_value = value
        else:
            self.tree.links.new(value, socket)

    def math(self, operation, *values):
        node = self.tree.nodes.new("ShaderNodeMath")
        node.operation = operation
        for socket, value in zip(node.inputs, values):
            self.set(socket, value)
        return node.outputs[0]

    def place(self):
        coordinates = self.tree.nodes.new("ShaderNodeTexCoord").outputs["Object"]
        separate = self.tree.nodes.new("ShaderNodeSeparateXYZ")
        self.tree.links.new(coordinates, separate.inputs[0])
        length = self.tree.nodes.new("ShaderNodeVectorMath")
        length.operation = "LENGTH"
        self.tree.links.new(coordinates, length.inputs[0])
        return list(separate.outputs), length.outputs["Value"]

    def smoothstep(self, low, high, value):
        node = self.tree.nodes.new("ShaderNodeMapRange")
        node.interpolation_type = "SMOOTHSTEP"
        for name, x in (("Value", value), ("From Min", low), ("From Max", high), ("To Min", 0), ("To Max", 1)):
            self.set(node.inputs[name], x)
        return node.outputs["Result"]

    def medium(self, extinction, albedo, anisotropy):
        color = (albedo,) * 3 + (1,)
        scatter = self.tree.nodes.new("ShaderNodeVolumeScatter")
        absorb = self.tree.nodes.new("ShaderNodeVolumeAbsorption")  # takes (1 - color) * density
        scatter.inputs["Color"].default_value = absorb.inputs["Color"].default_value = color
        scatter.inputs["Anisotropy"].default_value = anisotropy
        self.set(scatter.inputs["Density"], extinction)
        self.set(absorb.inputs["Density"], extinction)
        both = self.tree.nodes.new("ShaderNodeAddShader")
        self.tree.links.new(scatter.outputs[0], both.inputs[0])
        self.tree.links.new(absorb.outputs[0], both.inputs[1])
        self.tree.links.new(both.outputs[0], self.output.inputs["Volume"])
        return self.material


def point_light():
    world(0)
    box((2, 2, 2), Nodes("fog", True).medium(0.5, 0.9, 0.0))
    point_lamp((0.3, -0.2, 0.4), 100)
    camera((0, -9, 0), (0, 0, 0), 36)


def sphere_light():
    world(0)
    box((2, 2, 2), Nodes("fog", True).medium(0.5, 0.9, 0.0))
    point_lamp((0, 1.2, 0.5), 100, 0.1)
    bpy.ops.mesh.primitive_uv_sphere_add(segments=256, ring_count=128, radius=0.4, location=(0, 0.1, 0.2))
    bpy.context.object.data.materials.append(matte(0))
    camera((4, -8, 1.5), (0, 0, 0), 36)


def cloud():
    n = Nodes("cloud", False)
    (x, y, z), radius = n.place()

    def wave(a, b):
        inner = n.math("SINE", n.math("MULTIPLY", b, 3.0))
        return n.math("SINE", n.math("MULTIPLY_ADD", inner, 2.0, n.math("MULTIPLY", a, 5.0)))

    def fine(a, factor, offset):
        return n.math("SINE", n.math("MULTIPLY_ADD", a, factor, offset))

    waves = n.math("ADD", n.math("ADD", wave(x, y), wave(y, z)), wave(z, x))
    detail = n.math("MULTIPLY", n.math("MULTIPLY", fine(x, 13.0, 3.0), fine(y, 11.0, 1.0)), fine(z, 12.0, 2.0))
    height = n.math("MULTIPLY_ADD", waves, 0.12, n.math("MULTIPLY_ADD", detail, 0.2, n.math("SUBTRACT", 0.65, radius)))
    density = n.math("MULTIPLY", n.smoothstep(0.0, 0.4, height), 20.0)
    box((1.4, 1.4, 1.4), n.medium(density, 0.99, 0.6))
    world(0.0 if options.no_sky else 0.1)
    sun((0.7, 0.3, 0.7), 5)
    camera((0, -6, 0.6), (0, 0, 0), 28)


def slab():
    world(0)
    box((12, 12, 1), Nodes("slab", True).medium(2.0, 0.99, 0.75), (0, 0, 1))
    sun((0.5, 0, 0.8), 1)
    camera((0, -6, 7), (0, 0, 1), 40)


def smoke():
    world(0.35)
    background = scene.world.node_tree.nodes["Background"].inputs
    background[0].default_value, background[1].default_value = (0.6, 0.8, 1, 1), 0.35
    sun(y_up(1, 0.6, 0.5), 6)
    bpy.data.lights["sun"].color = (1, 0.85, 0.65)
    n = Nodes("smoke", False)
    grid = n.tree.nodes.new("ShaderNodeAttribute")
    grid.attribute_name = "density"
    data = bpy.data.volumes.new("smoke")
    data.filepath = options.grid
    data.render.precision, data.render.clipping = "FULL", 0
    data.materials.append(n.medium(n.math("MULTIPLY", grid.outputs["Fac"], 0.6), 0.9, 0.4))
    volume = link(bpy.data.objects.new("smoke", data))
    volume.rotation_euler = (math.radians(90), 0, 0)  # Blender takes a grid's axes for its own
    camera(y_up(-8, 44, 190), y_up(-8, 40, 0), 34, "VERTICAL")


def model():
    numpy.bool = bool  # which Debian's importer still asks for
    world(0)
    bpy.ops.import_scene.gltf(filepath=str(pathlib.Path(__file__).resolve().parent / "jar.glb"))
    paint = matte(0.5)
    for thing in [thing for thing in scene.collection.all_objects if thing.type != "MESH"]:
        bpy.data.objects.remove(thing)
    for thing in scene.collection.all_objects:
        thing.data.materials.clear()
        thing.data.materials.append(paint)
    ground(2.4, paint)
    box_between((-2.2, -2.2, 0.001), (2.2, 2.2, 2.2), Nodes("fog", True).medium(0.3, 0.9, 0.4))
    sun(y_up(-0.6, 0.7, 0.2), 3)
    camera(y_up(0, 1.6, 4.5), y_up(0, 0.6, 0), 36, "VERTICAL")


def fire():
    world(0)
    n = Nodes("fire", False)
    (x, y, z), _ = n.place()

    def wave(a, b, factor):
        return n.math("SINE", n.math("MULTIPLY_ADD", b, factor, n.math("MULTIPLY", a, 6.0)))

    half_z = n.math("MULTIPLY", z, 0.5)
    squares = [n.math("MULTIPLY", a, a) for a in (x, y, half_z)]
    radius = n.math("SQRT", n.math("ADD", n.math("ADD", squares[0], squares[1]), squares[2]))
    waves = n.math("MULTIPLY", wave(x, z, 3.0), wave(y, z, -2.0))
    shape = n.smoothstep(0.0, 0.5, n.math("MULTIPLY_ADD", waves, 0.25, n.math("SUBTRACT", 0.8, radius)))
    absorb = n.tree.nodes.new("ShaderNodeVolumeAbsorption")
    absorb.inputs["Color"].default_value = (0, 0, 0, 1)
    absorb.inputs["Density"].default_value = 0.5
    glow = n.tree.nodes.new("ShaderNodeEmission")
    glow.inputs["Color"].default_value = (8, 3, 0.6, 1)
    n.set(glow.inputs["Strength"], n.math("MULTIPLY", shape, 0.5))
    both = n.tree.nodes.new("ShaderNodeAddShader")
    n.tree.links.new(absorb.outputs[0], both.inputs[0])
    n.tree.links.new(glow.outputs[0], both.inputs[1])
    n.tree.links.new(both.outputs[0], n.output.inputs["Volume"])
    thing = box_between((-0.7, -0.7, -0.95), (0.7, 0.7, 1.6), n.material)
    offset = thing.location.copy()
    thing.data.transform(Matrix.Translation(offset))  # so that its coordinates are those of the shader
    thing.location = (0, 0, 1)
    ground(3, matte(0.5))
    scene.cycles.diffuse_bounces = 1
    camera((0, -5, 1.4), (0, 0, 0.7), 36, "VERTICAL")


def lamps():
    world(0)
    wall = matte(0.3)
    for i in range(-15, 15):
        for j in range(-15, 15):
            point_lamp((10 * i, 10 * j, 4), 60)
            height = 4 + 3 * ((i * i + 3 * j * j) % 4)
            box_between((10 * i + 2, 10 * j + 2, 0), (10 * i + 8, 10 * j + 8, height), wall)
    ground(200, matte(0.1))
    box_between((-160, -160, 0.001), (160, 160, 30), Nodes("fog", True).medium(0.005, 0.95, 0.0))
    camera((0, -140, 60), (0, -20, 0), 30, "VERTICAL")


def move(thing, begin, end):
    """Along a line while the shutter is open, from frame 1 to 2."""
    for frame, place in ((1, begin), (2, end)):
        thing.location = place
        thing.keyframe_insert("location", frame=frame)
    for curve in thing.animation_data.action.fcurves:
        for key in curve.keyframe_points:
            key.interpolation = "LINEAR"
    thing.cycles.use_motion_blur = True


def motion():
    world(0.2)
    move(box((0.8, 0.8, 0.8), Nodes("fog", True).medium(1.5, 0.9, 0.3)), (-0.4, 0, 0), (0.4, 0, 0))
    bpy.ops.mesh.primitive_uv_sphere_add(segments=256, ring_count=128, radius=0.25)
    bpy.context.object.data.materials.append(matte(0))
    move(bpy.context.object, (0.6, -1.2, 0.5), (0.6, -1.2, -0.3))
    sun((0.5, -0.4, 0.8), 3)
    scene.frame_start, scene.frame_end = 1, 2
    scene.frame_set(1)
    scene.render.use_motion_blur, scene.render.motion_blur_shutter = True, 1
    scene.cycles.motion_blur_position = "START"
    camera((0, -6, 1), (0, 0, 0), 30, "VERTICAL")


settings()
globals()[options.scene.replace("-", "_")]()
bpy.context.view_layer.update()
scene.render.filepath = options.out
before = resource.getrusage(resource.RUSAGE_SELF)
bpy.ops.render.render(write_still=True)
after = resource.getrusage(resource.RUSAGE_SELF)
cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
print("CYCLES " + json.dumps({"cpu_seconds": cpu}), flush=True)
