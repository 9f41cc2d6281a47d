#!/usr/bin/env python3
"""Writes NAME.scene.json: scene files with the same content as two of the archives, made from NAME.json (the content of
the archives as the reference library reads it). tests/engine/alembic/authored_test.cpp compares both. Run it in
this folder; it needs the JSON files only.

Nodes are named by the path of the object; "#n" at the end distinguishes the parts of one object.
"""
import json
import re

FPS = 24


def load(name):
    with open(name + ".json", encoding="utf-8") as file:
        return {entry["path"]: entry for entry in json.load(file)["objects"]}


def geometry(entry):
    """Samples of P, face counts and face indices, each a list over time."""
    found = {p["name"]: p for p in entry["properties"][0]["properties"]}
    return [[sample[2] for sample in found[name]["samples"]] for name in ("P", ".faceCounts", ".faceIndices")]


def triangles(counts, indices, clockwise):
    """Fans about the first point of every face, counter-clockwise."""
    result, first = [], 0
    for count in counts:
        face = indices[first:first + count]
        if clockwise:
            face = [face[0]] + face[:0:-1]
        result += [[face[0], face[i], face[i + 1]] for i in range(1, count - 1)]
        first += count
    return result


def channels(entry, first, count):
    return [sample["channels"][first:first + count] for sample in entry["xform"]["samples"]]


def keyed(values):
    """One value per frame from frame 0, or a plain value if it never changes."""
    return values[0] if all(value == values[0] for value in values) else {"values": values}


def row_matrix(translation):
    x, y, z = translation
    return [1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, z, 0, 0, 0, 1]


def polymesh_anim():
    objects = load("polymesh_anim")
    nodes = [{"name": "/meshXform", "translation": keyed(channels(objects["/meshXform"], 0, 3))}]
    for path, clockwise in (("/meshXform/wave", False), ("/meshXform/pentagon", True)):
        points, counts, indices = geometry(objects[path])
        shape = {"type": "mesh", "positions": keyed(points), "triangles": triangles(counts[0], indices[0], clockwise)}
        nodes.append({"name": path, "parent": "/meshXform", "shape": shape})
    points, counts, indices = geometry(objects["/growing"])
    for i, positions in enumerate(points):  # one mesh per topology, shown on its frame
        shape = {"type": "mesh", "positions": positions, "triangles": triangles(counts[i], indices[i], True)}
        keys = [[0, i == 0]] if i == 0 else [[0, False], [i, True]]
        if i + 1 < len(points):
            keys.append([i + 1, False])
        nodes.append({"name": f"/growing#{i}", "shape": shape, "visible": {"keys": keys}})
    return {"aleph": 1, "fps": FPS, "frames": [0, 7], "nodes": nodes}


def instances():
    objects = load("instances")
    points, counts, indices = geometry(objects["/prototypes/box/boxShape"])
    box = {"shape": {"type": "mesh", "positions": points[0], "triangles": triangles(counts[0], indices[0], True)}}
    prototype = objects["/prototypes/box"]
    turned = {
        "rotation": {"axis": [0, 1, 0], "degrees": keyed([c[0] for c in channels(prototype, 0, 1)])},
        "scale": keyed(channels(prototype, 1, 3)),
    }

    def placed(path, children):
        moves = [row_matrix(t) for t in channels(objects[path], 0, 3)]
        return {"name": path, "matrix": keyed(moves), "children": children}

    def turning(path, below):
        return {"name": path, **turned, "children": [{"name": path + "/" + below, "mesh": "box"}]}

    layout = [placed(f"/layout/place{i}", [turning(f"/layout/place{i}/boxInst", "boxShape")]) for i in range(3)]
    layout.append(placed("/layout/shapeOnly", [{"name": "/layout/shapeOnly/shapeInst", "mesh": "box"}]))
    nodes = [
        placed("/prototypes", [turning("/prototypes/box", "boxShape")]),
        {"name": "/layout", "children": layout},
    ]
    return {"aleph": 1, "fps": FPS, "frames": [0, 2], "meshes": {"box": box}, "nodes": nodes}


for scene_name, scene in (("polymesh_anim", polymesh_anim()), ("instances", instances())):
    with open(scene_name + ".scene.json", "w", encoding="utf-8") as output:
        text = json.dumps(scene, indent=1)
        # Lists of numbers on one line.
        output.write(re.sub(r"\[[^\[\]{}]*\]", lambda found: re.sub(r"\s+", " ", found.group()), text) + "\n")
