"""Models whose keys, skins and targets matter; author_models.py writes them."""
from gltf_writer import Model, box, turn

TIMES = [0, 0.5, 1, 1.5, 2]


def interpolation():
    """Nine boxes: each interpolation of each of scale, rotation and translation, in an animation of its own."""
    model = Model()
    mesh = model.add("meshes", primitives=[model.box((0.5, 0.5, 0.5))])
    for row, path in enumerate(("scale", "rotation", "translation")):
        for column, mode in enumerate(("STEP", "LINEAR", "CUBICSPLINE")):
            place = [3 * column, 3 * row, 0]
            node = model.node(f"{mode} {path}", mesh=mesh, translation=place)
            values = {"scale": [[1, 1 + k % 2, 1 + k / 4] for k in range(5)],
                      "rotation": [turn(2, 75 * k) if k < 3 else turn(0, 80) for k in range(5)],
                      "translation": [[place[0], place[1] + k % 2, k / 2] for k in range(5)]}[path]
            if mode == "CUBICSPLINE":  # arrives level, leaves with 4 per second along y
                level, rise = [0] * len(values[0]), [0, 4, 0, 0][:len(values[0])]
                values = [part for value in values for part in (level, value, rise)]
            model.animate(f"{mode} {path}", (node, path, mode, TIMES, values))
    model.save("interpolation.glb")


def inverse_parent():
    """Children under the inverse matrix of their parent's rest, so that at 0 s they stand where their values say."""
    model = Model()
    mesh = model.add("meshes", primitives=[model.box((0.25, 0.5, 0.25))])
    parent = model.node("parent", mesh=mesh, translation=[1, 2, 3], scale=[2, 2, 2])
    inverse = [0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 0.5, 0, -0.5, -1, -1.5, 1]
    child = model.node("child", model.node("inverse", parent, matrix=inverse), mesh=mesh, translation=[0, 1, 0])
    leaf = model.node("leaf", child, mesh=mesh, translation=[0, 1, 0], rotation=turn(0, 30))
    zero = [0, 0, 0]
    model.animate("swing", (parent, "rotation", "LINEAR", [0, 1, 2], [turn(2, d) for d in (0, 60, 135)]),
                  (parent, "translation", "CUBICSPLINE", [0, 2],
                   [zero, [1, 2, 3], [2, 0, 0], [0, -1, 0], [4, 2, 3], zero]))
    model.animate("stretch", (child, "scale", "CUBICSPLINE", [0, 1.5],
                              [zero, [1, 1, 1], [0, 1, 0], zero, [1, 3, 0.5], zero]))
    model.animate("nod", (leaf, "rotation", "CUBICSPLINE", [0, 0.75, 1.5], [
        row for d in (30, -20, 30) for row in ([0.1, 0, 0, 0], turn(0, d), [0, 0.2, 0, 0])]))
    model.save("inverse_parent.glb")


def morph_cube():
    """Two targets with displacements of positions and normals, and keys of both weights."""
    model = Model()
    positions, normals, _, indices = box((0.5, 0.5, 0.5))
    taper = [[-p[0] / 2, 0, -p[2] / 2] if p[1] > 0 else [0, 0, 0] for p in positions]
    tilt = [[0, 0.5, 0] if n[1] == 0 else [0, 0, 0] for n in normals]
    shear = [[p[1], 0, 0] for p in positions]
    lean = [[0, -n[0], 0] for n in normals]
    targets = [{"POSITION": model.accessor(moves, bounds=True), "NORMAL": model.accessor(turns)}
               for moves, turns in ((taper, tilt), (shear, lean))]
    mesh = model.add("meshes", weights=[0, 0], primitives=[
        model.primitive(positions, indices, targets=targets, NORMAL=normals)])
    node = model.node("cube", mesh=mesh)
    keys = [[0, 0], [1, 0], [1, 0.75], [0.25, 1], [0, 0]]
    model.animate("square", (node, "weights", "LINEAR", TIMES, [w for key in keys for w in key]))
    model.save("morph_cube.glb")


def skin():
    """A square tube of 32 triangles without indices and normals, around three joints 2 m apart; three animations of the
    same joints. The mesh's own node is moved, which does not count."""
    model = Model()
    ring = [(1, 1), (-1, 1), (-1, -1), (1, -1)]
    positions, joints, weights = [], [], []
    for level in range(4):
        for side in range(4):
            corners = [(*ring[(side + i) % 4], level + k) for i, k in ((0, 0), (0, 1), (1, 1), (0, 0), (1, 1), (1, 0))]
            for x, z, height in corners:
                positions.append([x / 4, 1.5 * height, z / 4])
                share = height / 4
                joints.append([0, 1, 2, 0])
                weights.append([(1 - share) ** 2, 2 * share * (1 - share), share ** 2, 0])
    mesh = model.add("meshes", primitives=[model.primitive(
        positions, JOINTS_0=model.accessor(joints, "H"), WEIGHTS_0=weights)])
    armature = model.node("armature", scale=[2, 2, 2])
    hip = model.node("hip", armature)
    knee = model.node("knee", hip, translation=[0, 1, 0])
    foot = model.node("foot", knee, translation=[0, 1, 0])
    # The bind pose in the world: scale 2, at 0, 2 and 4 m.
    binds = [[0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 0.5, 0, 0, -height, 0, 1] for height in (0, 1, 2)]
    model.add("skins", joints=[hip, knee, foot], inverseBindMatrices=model.accessor(binds))
    model.node("tube", mesh=mesh, skin=0, translation=[5, 5, 5])
    for name, end, angle in (("survey", 2, 60), ("walk", 0.75, 25), ("run", 0.5, -40)):
        times, turns = [0, end / 2, end], [turn(2, 0), turn(2, angle), turn(0, angle)]
        cubic = [row for value in turns for row in ([0, 0, 0, 0], value, [0, 0, 0.25, 0])]
        model.animate(name, (knee, "rotation", "LINEAR", times, turns), (foot, "rotation", "CUBICSPLINE", times, cubic),
                      (hip, "translation", "LINEAR", times, [[0, 0, 0], [0.5, 0, 0], [0.5, 0.25, 0]]))
    model.save("skin.glb")


def recursive():
    """Two nodes, each the other's child: no reader may follow them."""
    model = Model()
    model.json["scenes"] = [{"nodes": [0]}]
    model.json["nodes"] = [{"name": "hen", "children": [1]}, {"name": "egg", "children": [0]}]
    model.save("recursive.glb")
