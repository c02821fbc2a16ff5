#!/usr/bin/env python3
"""The comparison's scenes for Blender's Cycles; the .tyn files beside this one are the same for Tyndall.

  blender -b --factory-startup -P cycles_scene.py -- --scene cloud --samples 64 --seed 1 --out picture.exr

Renders on two threads, with nothing but path tracing: no denoising, no clamping, no light threshold, a box filter of
one pixel. Prints `CYCLES {"cpu_seconds": …}`: what the render took, without Blender's own start.
"""
import argparse
import json
import math
import resource
import sys

import bpy
from mathutils import Vector

parser = argparse.ArgumentParser(prog="cycles_scene.py")
parser.add_argument("--scene", required=True, choices=["sphere-light", "cloud", "slab"])
parser.add_argument("--samples", type=int, required=True)
parser.add_argument("--seed", type=int, required=True)
parser.add_argument("--bounces", type=int, required=True)
parser.add_argument("--step-rate", type=float, default=1.0, help="1 is Cycles' default")
parser.add_argument("--albedo", type=float, help="of the medium, instead of the scene's")
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
    cycles.volume_step_rate, cycles.volume_max_steps = options.step_rate, 65536
    cycles.tile_size, cycles.use_auto_tile = 2048, False


def link(thing):
    scene.collection.objects.link(thing)
    return thing


def camera(place, target, width_degrees):
    data = bpy.data.cameras.new("camera")
    data.sensor_fit, data.angle = "HORIZONTAL", math.radians(width_degrees)
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
    link(bpy.data.objects.new("box", data)).location = center


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
        albedo = albedo if options.albedo is None else options.albedo
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


def sphere_light():
    world(0)
    box((2, 2, 2), Nodes("fog", True).medium(0.5, 0.9, 0.0))
    data = bpy.data.lights.new("lamp", "POINT")
    data.energy, data.shadow_soft_size = 100, 0.1
    link(bpy.data.objects.new("lamp", data)).location = (0, 1.2, 0.5)
    black = Nodes("black", True)
    surface = black.tree.nodes.new("ShaderNodeBsdfDiffuse")
    surface.inputs["Color"].default_value = (0, 0, 0, 1)
    black.tree.links.new(surface.outputs[0], black.output.inputs["Surface"])
    bpy.ops.mesh.primitive_uv_sphere_add(segments=256, ring_count=128, radius=0.4, location=(0, 0.1, 0.2))
    bpy.context.object.data.materials.append(black.material)
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
    world(0.1 if options.albedo is None else 1.0)
    if options.albedo is None:
        sun((0.7, 0.3, 0.7), 5)
    camera((0, -6, 0.6), (0, 0, 0), 28)


def slab():
    world(0)
    box((12, 12, 1), Nodes("slab", True).medium(2.0, 0.99, 0.75), (0, 0, 1))
    sun((0.5, 0, 0.8), 1)
    camera((0, -6, 7), (0, 0, 1), 40)


settings()
{"sphere-light": sphere_light, "cloud": cloud, "slab": slab}[options.scene]()
bpy.context.view_layer.update()
scene.render.filepath = options.out
before = resource.getrusage(resource.RUSAGE_SELF)
bpy.ops.render.render(write_still=True)
after = resource.getrusage(resource.RUSAGE_SELF)
cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
print("CYCLES " + json.dumps({"cpu_seconds": cpu}), flush=True)
