#!/usr/bin/env python3
"""Writes the glTF models of this folder, one per group of features; it needs the standard library only.
tests/engine/gltf/poses_test.cpp works out their poses.
"""
import math

from author_motion import interpolation, inverse_parent, morph_cube, recursive, skin
from gltf_writer import Model, box, pack, png, turn

STRENGTH = "KHR_materials_emissive_strength"


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


if __name__ == "__main__":
    for author in (sparse, truck, lamp_box, interpolation, inverse_parent, morph_cube, skin, recursive):
        author()
