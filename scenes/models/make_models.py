#!/usr/bin/env python3
"""Makes walker.glb, a wanderer with a lantern (a skin, a looped animation "walk", a light that goes along), and
chess.glb, turned pieces of a game, by the standard library alone:

    scenes/models/make_models.py
"""

import json
import math
import struct
from pathlib import Path


class Writer:
    """A .glb in the making."""

    def __init__(self):
        self.binary = bytearray()
        self.root = {"asset": {"version": "2.0", "generator": "Tyndall's make_models.py"}}

    def add(self, kind, element):
        self.root.setdefault(kind, []).append(element)
        return len(self.root[kind]) - 1

    def accessor(self, rows, kind, code="f", bounds=False, target=None):
        component = {"f": 5126, "H": 5123, "B": 5121, "I": 5125}[code]
        while len(self.binary) % 4:
            self.binary.append(0)
        begin = len(self.binary)
        for row in rows:
            self.binary += struct.pack("<%d%s" % (len(row), code), *row)
        view = {"buffer": 0, "byteOffset": begin, "byteLength": len(self.binary) - begin}
        if target:
            view["target"] = target
        out = {"bufferView": self.add("bufferViews", view), "componentType": component, "count": len(rows),
               "type": kind}
        if bounds:
            rounded = [struct.unpack("<%df" % len(r), struct.pack("<%df" % len(r), *r)) for r in rows]
            out["min"] = [min(column) for column in zip(*rounded)]
            out["max"] = [max(column) for column in zip(*rounded)]
        return self.add("accessors", out)

    def save(self, path):
        self.root["buffers"] = [{"byteLength": len(self.binary)}]
        text = json.dumps(self.root, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        binary = bytes(self.binary) + b"\0" * (-len(self.binary) % 4)
        path.write_bytes(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(binary)) +
                         struct.pack("<I4s", len(text), b"JSON") + text +
                         struct.pack("<I4s", len(binary), b"BIN\0") + binary)


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(v):
    size = math.sqrt(sum(x * x for x in v))
    return [x / size for x in v] if size > 0 else [0.0, 1.0, 0.0]


class Mesh:
    """Points with normals, and for skins what they hang on: at most four (joint, weight)."""

    def __init__(self):
        self.points, self.triangles, self.influences = [], [], []

    def rings(self, rings, influence=None):
        """A surface through rings of equally many points, closed around, capped by its first and last ring."""
        first, n = len(self.points), len(rings[0])
        for k, ring in enumerate(rings):
            for p in ring:
                self.points.append(p)
                self.influences.append(influence(k, p) if influence else None)
        for k in range(len(rings) - 1):
            for i in range(n):
                a, b = first + k * n + i, first + k * n + (i + 1) % n
                self.triangles += [[a, b, b + n], [a, b + n, a + n]]

    def normals(self):
        """Means over the faces around each place."""
        sums = {}
        places = [tuple(round(x, 6) for x in p) for p in self.points]
        for a, b, c in self.triangles:
            n = cross(minus(self.points[b], self.points[a]), minus(self.points[c], self.points[a]))
            for corner in (a, b, c):
                s = sums.setdefault(places[corner], [0.0, 0.0, 0.0])
                for axis in range(3):
                    s[axis] += n[axis]
        return [unit(sums.get(place, [0.0, 1.0, 0.0])) for place in places]

    def write(self, writer, material):
        faces = [f for f in self.triangles if len({tuple(self.points[i]) for i in f}) == 3]
        attributes = {"POSITION": writer.accessor(self.points, "VEC3", bounds=True, target=34962),
                      "NORMAL": writer.accessor(self.normals(), "VEC3", target=34962)}
        if self.influences[0]:
            joints, weights = [], []
            for given in self.influences:
                four = sorted(given, key=lambda g: -g[1])[:4]
                total = sum(w for _, w in four)
                four = [(j, w / total) for j, w in four if w > 0] + [(0, 0.0)] * 4
                joints.append([j for j, _ in four[:4]])
                weights.append([w for _, w in four[:4]])
            attributes["JOINTS_0"] = writer.accessor(joints, "VEC4", "B", target=34962)
            attributes["WEIGHTS_0"] = writer.accessor(weights, "VEC4", target=34962)
        code = "H" if len(self.points) < 65535 else "I"
        return {"attributes": attributes, "material": material,
                "indices": writer.accessor([[i] for f in faces for i in f], "SCALAR", code, target=34963)}


def ring(center, rx, rz, n=24):
    """Around the vertical axis, counter-clockwise seen from below: so that faces of rising rings look outside."""
    return [[center[0] + rx * math.cos(2 * math.pi * i / n), center[1],
             center[2] - rz * math.sin(2 * math.pi * i / n)] for i in range(n)]


def tube(points, radii, n=16):
    """Rings around a way, closed at both ends."""
    rings = []
    for k, (p, r) in enumerate(zip(points, radii)):
        along = unit(minus(points[min(k + 1, len(points) - 1)], points[max(k - 1, 0)]))
        side = unit(cross(along, [0.0, 0.0, 1.0] if abs(along[2]) < 0.9 else [1.0, 0.0, 0.0]))
        other = cross(side, along)
        rings.append([[p[a] + r * (math.cos(t) * side[a] + math.sin(t) * other[a]) for a in range(3)]
                      for t in (-2 * math.pi * i / n for i in range(n))])
    return [[points[0]] * n] + rings + [[points[-1]] * n]


def smooth(a, b, x):
    t = min(max((x - a) / (b - a), 0.0), 1.0)
    return t * t * (3 - 2 * t)


# ------------------------------------------------------------------------------------------------- the walker

# name: (parent, where it is in the file at rest)
JOINTS = {
    "Hips": (None, [0.0, 0.98, 0.0]),
    "Spine": ("Hips", [0.0, 1.12, 0.0]),
    "Chest": ("Spine", [0.0, 1.38, 0.0]),
    "Head": ("Chest", [0.0, 1.58, 0.0]),
    "ArmL": ("Chest", [0.2, 1.46, 0.0]),
    "ForearmL": ("ArmL", [0.27, 1.19, -0.01]),
    "HandL": ("ForearmL", [0.29, 0.95, 0.03]),
    "ArmR": ("Chest", [-0.2, 1.46, 0.0]),
    "ForearmR": ("ArmR", [-0.27, 1.19, -0.01]),
    "HandR": ("ForearmR", [-0.29, 0.95, 0.03]),
    "ThighL": ("Hips", [0.1, 0.92, 0.0]),
    "ShinL": ("ThighL", [0.105, 0.5, 0.015]),
    "FootL": ("ShinL", [0.105, 0.09, -0.02]),
    "ThighR": ("Hips", [-0.1, 0.92, 0.0]),
    "ShinR": ("ThighR", [-0.105, 0.5, 0.015]),
    "FootR": ("ShinR", [-0.105, 0.09, -0.02]),
}
NUMBER = {name: i for i, name in enumerate(JOINTS)}
SECONDS, KEYS = 1.2, 24


def place(name):
    return JOINTS[name][1]


def limb(mesh, joints, radii, steps=9):
    """A tube through joints that hangs on each of them, softly from one to the next."""
    way, sizes, on = [], [], []
    for k in range(len(joints) - 1):
        a, b = place(joints[k]), place(joints[k + 1])
        for i in range(steps if k < len(joints) - 2 else steps + 1):
            t = i / steps
            way.append([a[x] + t * (b[x] - a[x]) for x in range(3)])
            sizes.append(radii[k] + t * (radii[k + 1] - radii[k]))
            # Half way into the next joint at the joint itself.
            before = 0.5 * (1 - smooth(0, 0.22, t)) if k > 0 else 0.0
            after = 0.5 * smooth(0.78, 1, t) if k + 2 < len(joints) else 0.0
            weights = [(NUMBER[joints[k]], 1 - before - after)]
            if before > 0:
                weights.append((NUMBER[joints[k - 1]], before))
            if after > 0:
                weights.append((NUMBER[joints[k + 1]], after))
            on.append(weights)
    on = [on[0]] + on + [on[-1]]
    mesh.rings(tube(way, sizes), lambda k, p: on[k])


def coat():
    """From the collar to below the knees, open in a slit that its swing makes."""
    mesh = Mesh()
    rows = [(1.53, 0.055, 0.06), (1.51, 0.12, 0.085), (1.47, 0.2, 0.115), (1.4, 0.215, 0.13), (1.25, 0.195, 0.13),
            (1.1, 0.175, 0.125), (1.0, 0.19, 0.14), (0.9, 0.21, 0.16), (0.8, 0.225, 0.18), (0.7, 0.24, 0.2),
            (0.6, 0.255, 0.215), (0.5, 0.27, 0.23), (0.42, 0.28, 0.24)]
    outside = [[[x, y + (0.02 * math.sin(5 * math.atan2(z, x)) if y < 0.5 else 0.0), z]
                for x, _, z in ring([0, y, 0], rx * (1 + 0.0), rz, 40)] for y, rx, rz in reversed(rows)]
    folds = []
    for row in outside:
        depth = smooth(1.05, 0.45, row[0][1]) if row[0][1] < 1.05 else 0.0
        folds.append([[x * (1 + 0.05 * depth * math.sin(9 * math.atan2(z, x))), y,
                       z * (1 + 0.05 * depth * math.sin(9 * math.atan2(z, x)))] for x, y, z in row])
    inside = [[[x * 0.93, y + 0.004, z * 0.93] for x, y, z in row] for row in folds]

    def hang(_, p):
        x, y, _ = p
        weights = []
        up = smooth(1.0, 1.3, y)
        if y > 1.0:
            chest = smooth(1.2, 1.42, y)
            weights += [(NUMBER["Chest"], up * chest), (NUMBER["Spine"], up * (1 - chest)),
                        (NUMBER["Hips"], 1 - up)]
        else:
            leg = 0.8 * smooth(0.98, 0.62, y)
            shin = 0.45 * smooth(0.62, 0.42, y)
            left = smooth(-0.16, 0.16, x)
            weights += [(NUMBER["Hips"], 1 - leg)]
            for side, share in (("L", left), ("R", 1 - left)):
                weights.append((NUMBER["Thigh" + side], leg * share * (1 - shin)))
            weights.append((NUMBER["ShinL" if left > 0.5 else "ShinR"], leg * abs(2 * left - 1) * shin))
        return [w for w in weights if w[1] > 1e-4]

    closed = list(reversed(inside)) + folds  # up the inside is down the outside
    mesh.rings(closed, hang)
    return mesh


def body():
    """Legs, arms, boots and gloves."""
    mesh = Mesh()
    for side in "LR":
        limb(mesh, ["Thigh" + side, "Shin" + side, "Foot" + side], [0.09, 0.062, 0.048])
        heel = place("Foot" + side)
        on = [(NUMBER["Foot" + side], 1.0)]
        way = [[heel[0], 0.05, heel[2] - 0.075 + 0.29 * t] for t in (0, 0.15, 0.35, 0.6, 0.85, 1)]
        mesh.rings([[[p[0], min(max(p[1], 0.002), 0.115), p[2]] for p in r]
                    for r in tube(way, [0.03, 0.055, 0.062, 0.058, 0.045, 0.02])], lambda k, p: on)
        ankle = [[heel[0], y, heel[2]] for y in (0.05, 0.12, 0.2, 0.26)]
        mesh.rings(tube(ankle, [0.055, 0.056, 0.062, 0.066]), lambda k, p: on if p[1] < 0.13 else
                   [(NUMBER["Foot" + side], 0.4), (NUMBER["Shin" + side], 0.6)])
    return mesh


def sleeves():
    mesh = Mesh()
    for side in "LR":
        limb(mesh, ["Arm" + side, "Forearm" + side, "Hand" + side], [0.082, 0.064, 0.06])
        top = place("Arm" + side)
        ball = [[top[0], top[1] - 0.07 + 0.14 * t, top[2]] for t in (0.02, 0.2, 0.4, 0.6, 0.8, 0.98)]
        mesh.rings(tube(ball, [0.03, 0.07, 0.086, 0.084, 0.064, 0.02]),
                   lambda k, p: [(NUMBER["Arm" + side], 0.5), (NUMBER["Chest"], 0.5)])
    return mesh


def skin_parts():
    """Head, neck, hands."""
    mesh = Mesh()
    neck = [[0, y, 0.0] for y in (1.5, 1.55, 1.6)]
    mesh.rings(tube(neck, [0.06, 0.052, 0.05]), lambda k, p: [(NUMBER["Chest"], 0.5), (NUMBER["Head"], 0.5)])
    head = [[0, 1.57 + 0.25 * t, 0.015] for t in [i / 10 for i in range(11)]]
    mesh.rings(tube(head, [0.1 * math.sqrt(max(1 - (2 * i / 10 - 1) ** 2, 0.02)) for i in range(11)]),
               lambda k, p: [(NUMBER["Head"], 1.0)])
    for side in "LR":
        hand = place("Hand" + side)
        way = [[hand[0], hand[1] + 0.03 - 0.13 * t, hand[2] + 0.015 * t] for t in (0, 0.2, 0.5, 0.8, 1)]
        mesh.rings(tube(way, [0.03, 0.042, 0.048, 0.04, 0.015]), lambda k, p: [(NUMBER["Hand" + side], 1.0)])
    return mesh


def hat():
    """A wide brim and a scarf."""
    mesh = Mesh()
    on = [(NUMBER["Head"], 1.0)]
    profile = [(1.735, 0.0), (1.74, 0.09), (1.728, 0.17), (1.712, 0.235), (1.718, 0.24), (1.74, 0.17), (1.757, 0.115),
               (1.79, 0.108), (1.85, 0.1), (1.885, 0.085), (1.895, 0.05), (1.885, 0.0)]
    mesh.rings([[[x, y + 0.5 * (x * x - 0.3 * z * z), z] for x, y, z in ring([0, y, 0.0], r, r * 1.05, 40)]
                for y, r in profile], lambda k, p: on)
    turns = [[0.095 * math.cos(t), 1.535 + 0.01 * math.sin(3 * t), -0.1 * math.sin(t) + 0.01]
             for t in [2 * math.pi * i / 24 for i in range(25)]]
    mesh.rings(tube(turns, [0.042 + 0.006 * math.sin(7 * i) for i in range(25)], 12),
               lambda k, p: [(NUMBER["Chest"], 0.7), (NUMBER["Head"], 0.3)])
    tail = [[-0.05, 1.53 - 0.34 * t, -0.12 - 0.05 * t] for t in [i / 8 for i in range(9)]]
    mesh.rings(tube(tail, [0.03, 0.04, 0.045, 0.045, 0.047, 0.048, 0.05, 0.05, 0.03], 12),
               lambda k, p: [(NUMBER["Chest"], 0.6 + 0.4 * smooth(1.3, 1.5, p[1])), (NUMBER["Spine"], 0.4)])
    return mesh


LANTERN = [0.29, 0.66, 0.06]


def lantern_frame():
    mesh = Mesh()
    on = [(NUMBER["HandL"], 1.0)]
    x, y, z = LANTERN
    for low, high, radius in ((-0.125, -0.1, 0.075), (0.095, 0.115, 0.075)):
        mesh.rings(tube([[x, y + low, z], [x, y + (low + high) / 2, z], [x, y + high, z]], [radius] * 3, 24),
                   lambda k, p: on)
    mesh.rings(tube([[x, y + 0.115, z], [x, y + 0.15, z], [x, y + 0.18, z]], [0.07, 0.04, 0.015], 24), lambda k, p: on)
    for i in range(4):
        a = math.pi / 4 + math.pi / 2 * i
        px, pz = x + 0.066 * math.cos(a), z + 0.066 * math.sin(a)
        mesh.rings(tube([[px, y - 0.11, pz], [px, y + 0.105, pz]], [0.006] * 2, 8), lambda k, p: on)
    bow = [[x + 0.05 * math.cos(t), y + 0.17 + 0.1 * math.sin(t), z] for t in [math.pi * i / 12 for i in range(13)]]
    mesh.rings(tube(bow, [0.005] * 13, 8), lambda k, p: on)
    return mesh


def lantern_flame():
    mesh = Mesh()
    on = [(NUMBER["HandL"], 1.0)]
    x, y, z = LANTERN
    way = [[x, y - 0.095 + 0.07 * t, z] for t in [i / 8 for i in range(9)]]
    mesh.rings(tube(way, [0.004, 0.016, 0.023, 0.025, 0.022, 0.016, 0.01, 0.005, 0.002], 12), lambda k, p: on)
    return mesh


def about(axis, angle):
    s = math.sin(angle / 2)
    return [axis[0] * s, axis[1] * s, axis[2] * s, math.cos(angle / 2)]


def times(p, q):
    px, py, pz, pw = p
    qx, qy, qz, qw = q
    return [pw * qx + px * qw + py * qz - pz * qy, pw * qy - px * qz + py * qw + pz * qx,
            pw * qz + px * qy - py * qx + pz * qw, pw * qw - px * qx - py * qy - pz * qz]


X, Y, Z = [1, 0, 0], [0, 1, 0], [0, 0, 1]


def walk(phase):
    """Rotations by joint, and how far the hips are from rest; one turn of `phase` is two steps. It looks along +z,
    so that a turn about x by a negative angle swings a leg forwards."""
    out = {}
    s, c = math.sin, math.cos
    for side, f in (("L", phase), ("R", phase + math.pi)):
        # A leg is farthest ahead at f = 0 and farthest behind at π; in between it swings back on the ground.
        hip = 0.05 + 0.42 * c(f)
        swing = max(0.0, s(f - math.pi - 0.25))  # while it comes forwards through the air
        knee = 0.1 + 0.95 * swing ** 1.5 + 0.12 * max(0.0, s(f)) ** 2
        ankle = -hip + knee * 0.75 - 0.28 * max(0.0, c(f)) ** 4 + 0.5 * max(0.0, -c(f - 0.15)) ** 5
        out["Thigh" + side] = about(X, -hip)
        out["Shin" + side] = about(X, knee)
        out["Foot" + side] = about(X, max(min(ankle * 0.6, 0.5), -0.35))
    out["Hips"] = times(about(Y, 0.1 * c(phase)), about(Z, 0.035 * s(phase)))
    out["Spine"] = times(about(X, 0.07), about(Y, -0.12 * c(phase)))
    out["Chest"] = times(about(X, 0.03), about(Y, -0.1 * c(phase)))
    out["Head"] = times(about(X, 0.02 + 0.02 * c(2 * phase)), about(Y, 0.11 * c(phase)))
    out["ArmR"] = times(about(X, 0.1 - 0.42 * c(phase)), about(Z, -0.1))
    out["ForearmR"] = about(X, -0.35 - 0.2 * max(0.0, c(phase)))
    out["HandR"] = about(X, -0.1)
    # The left arm holds the lantern before it, and the lantern hangs almost plumb.
    out["ArmL"] = times(about(X, -0.62 + 0.06 * c(phase)), about(Z, 0.12))
    out["ForearmL"] = about(X, -0.62 + 0.05 * c(2 * phase))
    out["HandL"] = times(about(X, 1.14 + 0.1 * s(phase + 0.6) - 0.06 * c(phase)), about(Z, -0.1 + 0.06 * s(phase)))
    return out, [0.012 * s(phase), -0.045 - 0.022 * c(2 * phase), 0.0]


def make_walker(path):
    w = Writer()

    def material(name, color, roughness, metallic=0.0, **more):
        return w.add("materials", {"name": name, "pbrMetallicRoughness": {
            "baseColorFactor": color + [1], "metallicFactor": metallic, "roughnessFactor": roughness}, **more})

    cloth = material("Coat", [0.05, 0.045, 0.06], 0.9)
    boots = material("Boots", [0.03, 0.022, 0.018], 0.5)
    face = material("Skin", [0.35, 0.2, 0.14], 0.6)
    felt = material("Hat", [0.16, 0.05, 0.04], 0.9)
    brass = material("Brass", [0.5, 0.36, 0.14], 0.4, 1.0)
    flame = material("Flame", [0, 0, 0], 1.0, emissiveFactor=[1, 0.55, 0.2],
                     extensions={"KHR_materials_emissive_strength": {"emissiveStrength": 8}})
    parts = [(coat(), cloth), (sleeves(), cloth), (body(), boots), (skin_parts(), face), (hat(), felt),
             (lantern_frame(), brass), (lantern_flame(), flame)]
    mesh = w.add("meshes", {"name": "Walker", "primitives": [m.write(w, material) for m, material in parts]})
    node_of = {}
    for name, (parent, at) in JOINTS.items():
        up = JOINTS[parent][1] if parent else [0, 0, 0]
        node_of[name] = w.add("nodes", {"name": name, "translation": [round(a - b, 6) for a, b in zip(at, up)]})
        if parent:
            w.root["nodes"][node_of[parent]].setdefault("children", []).append(node_of[name])
    hand = place("HandL")
    light = w.add("nodes", {"name": "Lantern", "translation": [round(a - b + c, 6) for a, b, c in zip(LANTERN, hand, (0, 0.02, 0))],
                            "extensions": {"KHR_lights_punctual": {"light": 0}}})
    w.root["nodes"][node_of["HandL"]]["children"] = [light]
    w.root["extensions"] = {"KHR_lights_punctual": {"lights": [
        {"type": "point", "name": "Lantern", "color": [1, 0.6, 0.26], "intensity": 4000}]}}
    bind = [[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -at[0], -at[1], -at[2], 1] for _, at in JOINTS.values()]
    w.add("skins", {"name": "Bones", "joints": [node_of[name] for name in JOINTS], "skeleton": node_of["Hips"],
                    "inverseBindMatrices": w.accessor(bind, "MAT4")})
    figure = w.add("nodes", {"name": "Walker", "mesh": mesh, "skin": 0})
    w.add("scenes", {"nodes": [node_of["Hips"], figure]})
    w.root["scene"] = 0
    seconds = w.accessor([[SECONDS * k / KEYS] for k in range(KEYS + 1)], "SCALAR", bounds=True)
    poses = [walk(2 * math.pi * k / KEYS) for k in range(KEYS)]
    poses.append(poses[0])
    samplers, channels = [], []

    def channel(node, path, rows, kind):
        samplers.append({"input": seconds, "output": w.accessor(rows, kind), "interpolation": "LINEAR"})
        channels.append({"sampler": len(samplers) - 1, "target": {"node": node, "path": path}})

    for name in poses[0][0]:
        channel(node_of[name], "rotation", [pose[name] for pose, _ in poses], "VEC4")
    channel(node_of["Hips"], "translation", [[a + b for a, b in zip(place("Hips"), moved)] for _, moved in poses],
            "VEC3")
    w.add("animations", {"name": "walk", "samplers": samplers, "channels": channels})
    w.root["extensionsUsed"] = ["KHR_lights_punctual", "KHR_materials_emissive_strength"]
    w.save(path)


# ---------------------------------------------------------------------------------------------- the chessmen


def spline(profile, steps=4):
    """Catmull and Rom's through (radius, height); doubled points are edges."""
    out = []
    for k in range(len(profile) - 1):
        p0, p1, p2, p3 = (profile[min(max(k + d, 0), len(profile) - 1)] for d in (-1, 0, 1, 2))
        if p1 == p2:
            continue
        if p0 == p1:
            p0 = [2 * a - b for a, b in zip(p1, p2)]
        if p2 == p3:
            p3 = [2 * a - b for a, b in zip(p2, p1)]
        for i in range(steps):
            t = i / steps
            out.append([max(0.5 * (2 * b + (c - a) * t + (2 * a - 5 * b + 4 * c - d) * t * t +
                                   (3 * b - a - 3 * c + d) * t ** 3), 0.0) for a, b, c, d in zip(p0, p1, p2, p3)])
    return out + [list(profile[-1])]


def turned(mesh, profile, n=48):
    mesh.rings([ring([0, y, 0], r, r, n) for r, y in spline(profile)])


FOOT = [(0, 0), (0, 0), (0.36, 0), (0.36, 0), (0.38, 0.05), (0.37, 0.12), (0.3, 0.17), (0.3, 0.17), (0.31, 0.21),
        (0.28, 0.26), (0.22, 0.32)]


def box(mesh, lo, hi):
    corners = [[hi[a] if i >> a & 1 else lo[a] for a in range(3)] for i in range(8)]
    for a, b, c, d in ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)):
        first = len(mesh.points)
        mesh.points += [corners[i] for i in (a, b, c, d)]
        mesh.influences += [None] * 4
        mesh.triangles += [[first, first + 1, first + 2], [first, first + 2, first + 3]]


def king():
    mesh = Mesh()
    turned(mesh, FOOT + [(0.15, 0.5), (0.12, 0.85), (0.125, 1.12), (0.125, 1.12), (0.23, 1.15), (0.23, 1.19), (0.15, 1.22),
                         (0.15, 1.22), (0.19, 1.25), (0.15, 1.29), (0.15, 1.29), (0.17, 1.4), (0.225, 1.58),
                         (0.225, 1.58), (0.21, 1.62), (0.1, 1.67), (0.04, 1.69), (0, 1.695)])
    box(mesh, (-0.03, 1.67, -0.03), (0.03, 1.92, 0.03))
    box(mesh, (-0.095, 1.77, -0.029), (0.095, 1.83, 0.029))
    return mesh


def queen():
    mesh = Mesh()
    turned(mesh, FOOT + [(0.14, 0.5), (0.105, 0.8), (0.11, 1.04), (0.11, 1.04), (0.21, 1.07), (0.21, 1.11), (0.13, 1.14),
                         (0.13, 1.14), (0.17, 1.17), (0.13, 1.2), (0.13, 1.2), (0.15, 1.3), (0.215, 1.47), (0.215, 1.47),
                         (0.19, 1.45), (0.1, 1.48), (0.04, 1.51), (0.04, 1.51), (0.065, 1.55), (0.045, 1.6), (0, 1.61)])
    return mesh


def bishop():
    mesh = Mesh()
    turned(mesh, FOOT + [(0.12, 0.5), (0.095, 0.72), (0.1, 0.86), (0.1, 0.86), (0.19, 0.89), (0.19, 0.92), (0.11, 0.95),
                         (0.11, 0.95), (0.17, 1.05), (0.14, 1.2), (0.05, 1.32), (0.03, 1.33), (0.03, 1.33),
                         (0.05, 1.37), (0.03, 1.41), (0, 1.415)])
    return mesh


def pawn():
    mesh = Mesh()
    turned(mesh, [(r * 0.82, y * 0.82) for r, y in FOOT] +
           [(0.1, 0.4), (0.085, 0.55), (0.085, 0.6), (0.085, 0.6), (0.16, 0.63), (0.16, 0.655), (0.09, 0.68),
            (0.09, 0.68), (0.16, 0.77), (0.16, 0.85), (0.1, 0.94), (0, 0.965)])
    return mesh


def make_chess(path):
    w = Writer()
    ivory = w.add("materials", {"name": "Ivory", "pbrMetallicRoughness": {
        "baseColorFactor": [0.78, 0.7, 0.56, 1], "metallicFactor": 0, "roughnessFactor": 0.35},
        "extensions": {"KHR_materials_clearcoat": {"clearcoatFactor": 0.6, "clearcoatRoughnessFactor": 0.12}}})
    ebony = w.add("materials", {"name": "Ebony", "pbrMetallicRoughness": {
        "baseColorFactor": [0.03, 0.022, 0.02, 1], "metallicFactor": 0, "roughnessFactor": 0.3},
        "extensions": {"KHR_materials_clearcoat": {"clearcoatFactor": 1, "clearcoatRoughnessFactor": 0.08},
                       "KHR_materials_specular": {"specularColorFactor": [1, 0.8, 0.6]}}})
    roots = []
    # The game's end: where each stands.
    men = (("King", king, [(0, 0)], [(2, -3)]), ("Queen", queen, [], [(-1, -2)]),
           ("Bishop", bishop, [(3, 0)], [(-2, 0), (1, -2)]),
           ("Pawn", pawn, [(1, 1), (-1, 2)], [(-2, -3), (2, -1), (-3, -1), (0, -4)]))
    for name, make, white, black in men:
        shape = make().write(w, ivory)
        for side, material, places in (("White", ivory, white), ("Black", ebony, black)):
            if not places:
                continue
            mesh = w.add("meshes", {"name": f"{side} {name}", "primitives": [dict(shape, material=material)]})
            for i, (x, z) in enumerate(places):
                number = f" {i + 1}" if len(places) > 1 else ""
                roots.append(w.add("nodes", {"name": f"{side} {name}{number}", "mesh": mesh,
                                             "translation": [x + 0.5, 0, z + 0.5]}))
    w.add("scenes", {"nodes": roots})
    w.root["scene"] = 0
    w.root["extensionsUsed"] = ["KHR_materials_clearcoat", "KHR_materials_specular"]
    w.save(path)


if __name__ == "__main__":
    folder = Path(__file__).resolve().parent
    make_walker(folder / "walker.glb")
    make_chess(folder / "chess.glb")
