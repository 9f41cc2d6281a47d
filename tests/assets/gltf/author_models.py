#!/usr/bin/env python3
"""Writes the glTF models of this folder, one per group of features; it needs the standard library only. The numbers are
repeated in tests/engine/gltf/assets_test.cpp; poses_test.cpp there works out the poses.
"""
import math

from author_motion import interpolation, inverse_parent, morph_cube, recursive, skin
from gltf_writer import FOLDER, Model, box, pack, png, turn

STRENGTH = "KHR_materials_emissive_strength"


def interleaved():
    """Positions and normals in one view, 24 bytes a vertex."""
    model = Model()
    positions, normals, _, indices = box((0.5, 0.5, 0.5))
    view = model.view(pack([p + n for p, n in zip(positions, normals)], "f"), byteStride=24, target=34962)
    attributes = {"POSITION": model.accessor(positions, bounds=True, view=view),
                  "NORMAL": model.accessor(normals, view=view, byteOffset=12)}
    mesh = model.add("meshes", primitives=[{"attributes": attributes, "indices": model.accessor(indices, "H")}])
    model.node("box", mesh=mesh)
    model.save("interleaved.glb")


def sparse():
    """Sparse values on a base (a corner of the plane), on zeros (a displacement) and of keys (the second weight)."""
    model = Model()
    plane = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
    base = model.view(pack(plane, "f"))
    corner = model.sparse(4, 3, [2], [[2, 2, 0]], base, min=[0, 0, 0], max=[2, 2, 0])
    lifted = model.sparse(4, 3, [1], [[0, 0, 4]], min=[0, 0, 0], max=[0, 0, 4])
    mesh = model.add("meshes", weights=[0], primitives=[{
        "attributes": {"POSITION": corner}, "indices": model.accessor([0, 1, 2, 0, 2, 3], "H"),
        "targets": [{"POSITION": lifted}]}])
    node = model.node("plane", mesh=mesh)
    model.animate("lift", (node, "weights", "LINEAR", [1, 2], model.sparse(2, 1, [1], [[1]])))
    model.save("sparse.glb")


def triangles():
    """Two triangles without indices, normals and material, the root with a child that holds nothing."""
    model = Model()
    corners = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
    root = model.node("root", mesh=model.add("meshes", primitives=[model.primitive(corners)]))
    model.node("empty", root)
    model.save("triangles.gltf")


def cameras():
    model = Model()
    model.add("cameras", type="perspective", perspective={"yfov": 0.7, "znear": 0.125, "zfar": 100})
    model.add("cameras", type="orthographic", orthographic={"xmag": 2.0, "ymag": 1.5, "znear": 0.01, "zfar": 100})
    stand = model.node("stand", translation=[0, 1, 4], rotation=turn(1, 30))
    model.node("near", stand, camera=0)
    model.node("flat", stand, camera=1, translation=[0, 0, 2])
    model.save("cameras.gltf")


def textures():
    """Pictures beside the file and inside its text; the transform of one, in the second set of coordinates."""
    model = Model()
    model.extension("KHR_texture_transform", required=True)
    (FOLDER / "squares.png").write_bytes(png([[(255, 0, 0), (0, 255, 0)], [(0, 0, 255), (255, 255, 255)]]))
    model.add("images", uri="squares.png")
    rough = model.view(png([[(0, 64, 255), (0, 255, 0)]]))
    model.add("images", bufferView=rough, mimeType="image/png")
    model.add("samplers", magFilter=9728, wrapS=33071, wrapT=33648)
    model.add("textures", source=0, sampler=0)
    model.add("textures", source=1)
    moved = {"index": 0, "extensions": {"KHR_texture_transform": {
        "offset": [0.25, -0.5], "rotation": 0.5, "scale": [2, 3], "texCoord": 1}}}
    material = model.material("squares", (1, 1, 1), 1, 1, {
        "baseColorTexture": moved, "metallicRoughnessTexture": {"index": 1}})
    square = model.primitive([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], [0, 1, 2, 0, 2, 3], material,
                             TEXCOORD_0=[[0, 1], [1, 1], [1, 0], [0, 0]], TEXCOORD_1=[[0, 2], [2, 2], [2, 0], [0, 0]])
    model.node("square", mesh=model.add("meshes", primitives=[square]))
    model.save("textures.gltf", external=True)


def truck():
    """One wheel mesh under two nodes with matrices, turning once in 1.25 s; two textures of one picture."""
    model = Model()
    model.add("images", bufferView=model.view(png([[(30, 60, 220)] * 4, [(255, 255, 255), (30, 60, 220)] * 2] * 2)),
              mimeType="image/png")
    model.add("textures", source=0)
    model.add("textures", source=0, sampler=model.add("samplers", wrapS=33071))
    paint = model.material("paint", (1, 1, 1), 0, 0.5, {"baseColorTexture": {"index": 0}})
    glass = model.material("glass", (0.25, 0.25, 0.25), 0, 0.25)
    trim = model.material("trim", (0.5, 0.5, 0.5), 1, 0.5)
    tyre = model.material("tyre", (0.25, 0.25, 0.25), 0, 1, {"baseColorTexture": {"index": 1}})
    body = model.add("meshes", name="body", primitives=[
        model.box((2, 0.5, 0.75), (0, 1, 0), paint, textured=True),
        model.box((0.5, 0.25, 0.625), (1, 1.75, 0), glass),
        model.box((2.125, 0.0625, 0.8125), (0, 0.5, 0), trim)])
    rim = [(0.4375 * math.cos(math.pi * i / 6), 0.4375 * math.sin(math.pi * i / 6)) for i in range(12)]
    positions = [[x, y, z] for z in (-1, 1) for x, y in rim]
    indices = []
    for i in range(12):
        after = (i + 1) % 12
        indices += [i, after, 12 + after, i, 12 + after, 12 + i]  # the tread
    for i in range(1, 11):
        indices += [0, i + 1, i, 12, 12 + i, 13 + i]  # the faces
    wheel = model.add("meshes", name="wheel", primitives=[
        model.primitive(positions, indices, tyre, TEXCOORD_0=[[(x + 1) / 2, (y + 1) / 2] for x, y, _ in positions])])
    root = model.node("truck", mesh=body)
    times, turns = [i / 24 for i in range(31)], [turn(2, -12 * i) for i in range(31)]
    channels = []
    # The front wheels are steered: a turn about y of cosine .96.
    for name, x, c, s in (("rear", -1.375, 1, 0), ("front", 1.5, 0.96, 0.28)):
        axle = model.node(name, root, matrix=[c, 0, -s, 0, 0, 1, 0, 0, s, 0, c, 0, x, 0.4375, 0, 1])
        node = model.node(name + " wheels", axle, mesh=wheel, rotation=turns[0])
        channels.append((node, "rotation", "LINEAR", times, turns))
    model.animate("roll", *channels)
    model.save("truck.glb")


def lamp_box():
    """A closed box with a red and a green wall, a lamp under its ceiling, a metal block, a rough cube and a camera."""
    model = Model()
    model.extension(STRENGTH)
    lamp = model.material("lamp", (0.75, 0.75, 0.75), emissiveFactor=[1, 1, 1], doubleSided=True,
                          extensions={STRENGTH: {"emissiveStrength": 20.0}})
    white, red = model.material("white", (0.75, 0.75, 0.75)), model.material("red", (0.5, 0, 0))
    green, metal = model.material("green", (0, 0.5, 0)), model.material("metal", (0.75, 0.75, 0.75), 1, 0.25)
    colors = model.accessor([[65535, 65535, 65535, 65535], [65535, 0, 0, 65535], [0, 65535, 0, 65535], [0, 0, 0, 0]],
                            "H", normalized=True)
    corners = [[-0.25, 0, -0.25], [0.25, 0, -0.25], [0.25, 0, 0.25], [-0.25, 0, 0.25]]
    light = model.primitive(corners, [0, 1, 2, 0, 2, 3], lamp, NORMAL=[[0, -1, 0]] * 4, COLOR_0=colors,
                            TEXCOORD_0=[[0, 0], [1, 0], [1, 1], [0, 1]],
                            TEXCOORD_1=[[0, 0], [0.5, 0], [0.5, 0.5], [0, 0.5]])
    model.node("lamp", translation=[0, 1.9375, -0.25], mesh=model.add("meshes", primitives=[light]))
    model.node("block", translation=[-0.375, 0.5, -0.5], rotation=turn(1, 20), mesh=model.add("meshes", primitives=[
        model.box((0.25, 0.5, 0.25), material=metal)]))
    model.node("cube", translation=[0.375, 0.25, 0], rotation=turn(1, -15), mesh=model.add("meshes", primitives=[
        model.box((0.25, 0.25, 0.25), material=white)]))
    positions, normals, _, indices = box((1, 1, 1))
    inwards = [[-c for c in normal] for normal in normals]
    sides = [[indices[6 * side + i] for i in (0, 2, 1, 3, 5, 4)] for side in range(6)]
    walls = ((sum(sides[2:], []), white), (sides[0], red), (sides[1], green))  # x = -1 and x = 1 are coloured
    model.node("walls", translation=[0, 1, 0], mesh=model.add("meshes", primitives=[
        model.primitive(positions, faces, material, NORMAL=inwards) for faces, material in walls]))
    model.add("cameras", type="perspective", perspective={"yfov": 1.2, "znear": 0.01})
    model.node("camera", translation=[0, 1, 0.9375], camera=0)
    model.save("lamp_box.glb")


def moving_light():
    """A point light and a camera that move; the first key is not at 0."""
    model = Model()
    model.extension("KHR_lights_punctual", required=True)
    model.json["extensions"] = {"KHR_lights_punctual": {"lights": [
        {"type": "point", "color": [1, 0.5, 0.25], "intensity": 40, "range": 8}]}}
    model.add("cameras", type="perspective", perspective={"yfov": 0.8, "znear": 0.1})
    model.node("floor", mesh=model.add("meshes", primitives=[model.box((2, 0.125, 2))]))
    crane = model.node("crane", translation=[0, 2, 0])
    lamp = model.node("lamp", crane, extensions={"KHR_lights_punctual": {"light": 0}})
    camera = model.node("camera", camera=0)
    times = [i / 24 for i in range(1, 13)]
    model.animate(
        "move", (lamp, "translation", "LINEAR", times, [[i / 8, 0, 0] for i in range(12)]),
        (camera, "translation", "LINEAR", times, [[0, 1 + i / 16, 5] for i in range(12)]),
        (camera, "rotation", "LINEAR", times, [turn(1, 2 * i) for i in range(12)]))
    model.save("moving_light.gltf")


def orientation():
    """Six arrows along y under nodes that turn them about an axis, by a quaternion or a matrix, and a target for each
    where a right-handed turn puts the point of its arrow."""
    model = Model()
    arrow = model.add("meshes", primitives=[model.primitive(
        [[-0.125, 1, 0], [0.125, 1, 0], [0, 2, 0], [0, 1, -0.125], [0, 1, 0.125], [0, 2, 0]], [0, 1, 2, 3, 4, 5])])
    target = model.add("meshes", primitives=[model.box((0.125, 0.125, 0.125))])
    for axis, (first, second) in enumerate(((40, -110), (65, 160), (-35, 100))):
        name = "XYZ"[axis]
        for side, degrees in (("1", first), ("2", second)):
            c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
            # About y itself, the arrow is laid along z first: a turn of 90 degrees about x.
            lie = {"rotation": turn(0, 90)} if axis == 1 else {}
            a, b = (axis + 1) % 3, (axis + 2) % 3  # the turn takes a to b
            columns = [[float(i == k) for i in range(4)] for k in range(4)]
            columns[a][a], columns[a][b], columns[b][a], columns[b][b] = c, s, -s, c
            given = {"rotation": turn(axis, degrees)} if side == "1" else {"matrix": sum(columns, [])}
            holder = model.node("Turn" + name + side, **given)
            model.node("Arrow" + name + side, holder, mesh=arrow, **lie)
            point = [0.0, 0.0, 0.0]
            rest = 2 if axis == 1 else 1
            point[a], point[b] = (2 * c, 2 * s) if rest == a else (-2 * s, 2 * c)
            model.node("Target" + name + side, mesh=target, translation=point)
    model.save("orientation.glb")


if __name__ == "__main__":
    for author in (interleaved, sparse, triangles, cameras, textures, truck, lamp_box, moving_light, orientation,
                   interpolation, inverse_parent, morph_cube, skin, recursive):
        author()
