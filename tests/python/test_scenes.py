"""Scenes from Python: loading, reading, changing and saving them, and errors."""

import numpy as np
import pytest

import aleph
from conftest import BALL, QUICK, ROOT


def test_elements_by_name_and_index(ball):
    assert [node.name for node in ball.nodes] == ["ball", "lamp", "eye"]
    assert ball.nodes[0] == ball.nodes["ball"] and ball.nodes[-1].camera == ball.cameras[0]
    assert "ball" in ball.nodes and "cube" not in ball.nodes
    assert ball.nodes["ball"].meshes[0].material.name == "red"
    assert ball.lights[0].kind == "directional" and ball.lights[0].intensity == 3
    with pytest.raises(KeyError, match="no node .*bal.*; did you mean \"ball\""):
        ball.nodes["bal"]
    with pytest.raises(IndexError, match="no node 3; the scene has 3"):
        ball.nodes[3]


def test_elements_keep_their_scene():
    node = aleph.load(BALL).nodes["ball"]
    assert len(node.translation) == 2


def test_tracks_are_read_and_written(ball):
    node = ball.nodes["ball"]
    track = node.translation
    assert np.array_equal(track.times, np.array([0, 16]) / 24) and track.interpolation == "linear"
    assert np.array_equal(track.values, [[0, 0, 0], [1, 0, 0]]) and not track.values.flags.writeable
    node.translation = aleph.Track(ball.seconds([0, 4, 8]), [[0, 0, 0], [0, 1, 0], [0, 0, 0]], "step")
    assert np.array_equal(ball.world("ball", 5)[:3, 3], [0, 1, 0])
    assert np.array_equal(ball.worlds(5), [ball.world(node.name, 5) for node in ball.nodes])
    node.translation = [1, 2, 3]
    assert np.array_equal(node.translation, [1, 2, 3])


def test_rotations(ball):
    node = ball.nodes["ball"]
    node.rotation = [0, 0, np.sqrt(0.5), np.sqrt(0.5)]
    assert np.allclose(ball.world("ball", 0)[:3, :3], [[0, -1, 0], [1, 0, 0], [0, 0, 1]])
    node.rotation = ((0, 2, 0), aleph.Track(ball.seconds([0, 10]), [0, 720]))
    axis, degrees = node.rotation
    assert axis == (0, 1, 0) and np.allclose(degrees.values, [0, 720])
    assert np.allclose(ball.world("ball", 2.5)[:3, :3], np.diag([-1, 1, -1]))
    node.matrix = np.diag([2, 2, 2, 1])
    assert np.array_equal(ball.world("ball", 0), np.diag([2, 2, 2, 1]))
    node.matrix = None
    assert node.matrix is None


def test_what_is_assigned_replaces_an_archives_operations():
    for assign in ("matrix", "translation"):
        scene = aleph.load(ROOT / "tests/assets/abc/xform_uniform.abc")
        arm = scene.nodes["arm"]
        before = scene.world("arm", 3)
        if assign == "matrix":
            arm.matrix = np.diag([2, 2, 2, 1])
        else:
            arm.translation = [9, 9, 9]
        assert not np.allclose(scene.world("arm", 3), before)


def test_a_mesh_may_have_no_material():
    scene = aleph.load(ROOT / "scenes/cornell/scene.json")
    mesh = scene.meshes[0]
    mesh.material = None
    assert mesh.material is None


def test_points_of_any_kind_of_number():
    scene = aleph.load(ROOT / "tests/assets/gltf/sparse.glb")
    mesh = scene.meshes[0]
    moved = mesh.positions.astype(np.float64) + 0.25
    mesh.positions = moved
    assert mesh.positions.dtype == np.float32
    assert np.allclose(mesh.positions, moved)


def test_materials_and_cameras(ball):
    red = ball.materials["red"]
    red.roughness, red.base_color = 0.25, aleph.Track(ball.seconds([0, 8]), [[1, 0, 0], [0, 1, 0]])
    assert red.roughness == 0.25 and np.array_equal(red.base_color.values[1], [0, 1, 0])
    camera = ball.cameras[0]
    camera.orthographic, camera.fov, camera.shutter = False, 50, (0, 0.5)
    assert camera.fov == pytest.approx(50) and camera.shutter == (0, 0.5)
    assert aleph.render(ball, 0, **QUICK).color.max() > 0


def test_film(ball):
    assert ball.fps == 24 and ball.frames == (0, 16) and ball.exposure is None
    ball.fps, ball.frames, ball.exposure, ball.camera = "30000/1001", (3, 4), 0.5, "eye"
    assert ball.fps == 30000 / 1001 and ball.frames == (3, 4) and ball.exposure == 0.5 and ball.camera == "eye"
    assert np.allclose(ball.seconds(30), 1.001)


def test_scene_as_dict_and_file(ball, tmp_path):
    ball.nodes["ball"].translation = [0.125, 0, 0]
    again = aleph.load(ball.to_dict())
    assert np.array_equal(again.world("ball", 0), ball.world("ball", 0)) and again.to_dict() == ball.to_dict()
    ball.save(tmp_path / "ball.json")
    assert aleph.load(tmp_path / "ball.json").to_dict() == ball.to_dict()
    copy = ball.copy()
    copy.nodes["ball"].translation = [9, 0, 0]
    assert np.array_equal(ball.nodes["ball"].translation, [0.125, 0, 0])


def test_dicts_may_hold_numbers_of_numpy():
    scene = {"aleph": 1, "nodes": [{"name": "eye", "translation": np.array([1, 2, 3.5]), "scale": [np.float32(2), np.int64(1), 1],
                                    "camera": {"orthographic": np.bool_(True)}}]}
    assert np.array_equal(aleph.load(scene).nodes["eye"].translation, [1, 2, 3.5])


@pytest.mark.parametrize("value, place, reason", [
    (np.array([1, 2, np.nan]), "/2", "expected a finite number, found nan"),
    ([1, float("-inf"), 3], "/1", "expected a finite number, found -inf"),
    ({"keys": ((0, (0, object(), 0)),)}, "/keys/0/1/1", "<object object .* is no value of a scene"),
    ({"a/b": {(1, 2): 3}}, "/a~1b", "keys must be str"),
])
def test_what_cannot_be_json_is_refused_with_its_place(value, place, reason):
    with pytest.raises(aleph.InputError, match=reason) as raised:
        aleph.load({"aleph": 1, "nodes": [{"name": "eye"}, {"translation": value}]})
    assert raised.value.place == "/nodes/1/translation" + place and raised.value.file == ""


def test_a_dict_that_holds_itself_is_refused():
    nodes = []
    nodes.append(nodes)
    with pytest.raises(aleph.InputError, match="Circular reference"):
        aleph.load({"aleph": 1, "nodes": nodes})


def test_warnings_of_a_scene_are_given(ball):
    scene = dict(ball.to_dict(), cuts=[99])
    with pytest.warns(UserWarning, match="the cut at frame 99 lies outside") as given:
        assert len(aleph.load(scene).warnings) == len(given) == 1
    assert given[0].filename == __file__


def test_missing_folders_are_made(ball, tmp_path):
    ball.save(tmp_path / "new/folder/ball.json")
    assert aleph.load(tmp_path / "new/folder/ball.json").to_dict() == ball.to_dict()
    with pytest.raises(aleph.InputError):
        ball.save(tmp_path / "other/ball.txt")
    frame = aleph.render(ball, 0, **QUICK)
    for name in "a/frame.exr", "b/frame.png":
        frame.save(tmp_path / name)
        assert (tmp_path / name).stat().st_size > 0
    with pytest.raises(aleph.InputError, match="end in .exr or .png"):
        frame.save(tmp_path / "other/frame.jpg")
    assert not (tmp_path / "other").exists()


@pytest.mark.parametrize("call, place, reason", [
    (lambda: aleph.maps([np.zeros((2, 2, 3))]), "fps", "frames per second, such as 30"),
    (lambda: aleph.maps(fps=24), "images", r"aleph.maps\(images, fps=24\)"),
    (lambda: aleph.maps(5, fps=24), "images", r"aleph.maps\(images, fps=24\)"),
    (lambda: aleph.maps([np.zeros((2, 2, 3))], fps=24, cuts=1), "cuts", r"such as \[24, 48\]"),
    (lambda: aleph.maps([np.zeros((2, 2, 3))], fps=24, motion=5), "motion", "expected a list"),
    (lambda: aleph.study(ROOT / "scenes/cornell/scene.json"), "", "needs what is compared, such as sweep="),
    (lambda: aleph.compare(np.zeros((2, 2, 3))), "b", "expected an array"),
    (lambda: aleph.seen([np.zeros((2, 2, 3))], [np.zeros((2, 2, 3))]), "maps", "expected a list"),
    (lambda: aleph.render(frame=3), "scene", "such as 'scene.json'"),
    (lambda: aleph.Sequence(), "scene", "such as 'scene.json'"),
    (lambda: aleph.load(), "scene", "such as 'scene.json'"),
])
def test_missing_and_wrong_arguments_are_named(call, place, reason):
    with pytest.raises(aleph.InputError, match=reason) as raised:
        call()
    assert raised.value.place == place


def test_folder_of_textures():
    scene = {"aleph": 1, "images": {"wood": "floor.png"}, "nodes": [
        {"name": "floor", "shape": {"type": "quad"}, "material": {"base_color_texture": "wood"}}]}
    with pytest.raises(aleph.InputError) as raised:
        aleph.load(scene, folder=ROOT / "no-such-folder")
    assert raised.value.place == "/images/wood" and "floor.png" in str(raised.value)


@pytest.mark.parametrize("change, place", [
    (lambda s: s.update(fps=-1), "/fps"),
    (lambda s: s["nodes"][0].update(materiel="red"), "/nodes/0"),
    (lambda s: s["nodes"][0].update(material="blue"), "/nodes/0/material"),
])
def test_errors_name_file_and_place(tmp_path, change, place):
    import copy
    import json
    scene = copy.deepcopy(BALL)
    change(scene)
    with pytest.raises(aleph.InputError) as raised:
        aleph.load(scene)
    assert raised.value.place.startswith(place) and raised.value.file == "" and raised.value.reason
    path = tmp_path / "scene.json"
    path.write_text(json.dumps(scene))
    with pytest.raises(ValueError) as raised:
        aleph.load(path)
    assert raised.value.file == str(path) and str(path) in str(raised.value)


@pytest.mark.parametrize("assign, place", [
    (lambda s: setattr(s.nodes["ball"], "translation", [1, 2]), "Node 'ball': translation"),
    (lambda s: setattr(s.nodes["ball"], "translation", [1, 2, float("nan")]), "Node 'ball': translation"),
    (lambda s: setattr(s.nodes["ball"], "rotation", [0, 0, 0, 0]), "Node 'ball': rotation"),
    (lambda s: setattr(s.nodes["ball"], "rotation", ((0, 0, 0), 5)), "Node 'ball': rotation"),
    (lambda s: setattr(s.materials["red"], "roughness", "rough"), "Material 'red': roughness"),
    (lambda s: setattr(s.meshes[0], "positions", np.zeros((3, 3), "float32")), "Mesh 'ball': positions"),
    (lambda s: setattr(s, "frames", (5, 4)), "frames"),
    (lambda s: setattr(s, "fps", 0), "fps"),
    (lambda s: setattr(s, "fps", "often"), "fps"),
    (lambda s: setattr(s, "fps", float("inf")), "fps"),
    (lambda s: setattr(s, "fps", None), "fps"),
    (lambda s: aleph.maps([np.zeros((2, 2, 3))], fps=24, motion=[np.zeros((2, 2))]), "motion[0]"),
    (lambda s: aleph.Track([0, 0], [1, 2]), "Track"),
    (lambda s: aleph.Track([0, 1], [1, 2], "bezier"), "Track"),
    (lambda s: aleph.Track([0, 1], [1, 2, 3]), "Track"),
    (lambda s: aleph.render(s, speed=3), "speed"),
    (lambda s: aleph.render(s, spp=0), "spp"),
    (lambda s: aleph.render(s, spp=[object()]), "spp"),
    (lambda s: aleph.render(s, guide=print), "guide"),
    (lambda s: aleph.render(s, threads=-1), "threads"),
    (lambda s: aleph.compare(np.zeros((2, 2)), np.zeros((2, 2))), "a"),
    (lambda s: aleph.compare(np.zeros((2, 2, 3)), np.array([["x"]])), "b"),
    (lambda s: aleph.maps([], fps=24), "images"),
    (lambda s: aleph.maps([np.zeros((2, 2, 3))], fps=24, motion=[np.zeros((3, 2, 2))]), "motion[0]"),
])
def test_wrong_values_are_refused(ball, assign, place):
    with pytest.raises(aleph.InputError) as raised:
        assign(ball)
    assert place in raised.value.place, raised.value


def test_what_does_not_fit_is_refused_when_rendered(ball):
    ball.cameras[0].aperture = 0.1
    ball.cameras[0].focus_distance = 0
    with pytest.raises(aleph.InputError, match="focus"):
        aleph.render(ball, 0, **QUICK)


@pytest.mark.parametrize("element, name, value", [
    ("material", "roughness", 7), ("material", "metallic", -3), ("material", "alpha", 5),
    ("material", "transmission", 2), ("material", "ior", 0.2), ("material", "emission_strength", -1),
    ("material", "emission", [1e300, 0, 0]), ("light", "intensity", -5), ("camera", "fov", 200),
    ("node", "visible", 0.5), ("node", "translation", [1e300, 0, 0])])
def test_numbers_out_of_range_are_refused_as_in_files(ball, tmp_path, element, name, value):
    setattr(getattr(ball, element + "s")[0], name, value)
    with pytest.raises(aleph.InputError, match=f"^{element} 0 ") as raised:
        aleph.render(ball, 0, **QUICK)
    assert raised.value.file == ""
    with pytest.raises(aleph.InputError, match=f"^{element} 0 "):
        ball.save(tmp_path / "scene.glb")
    assert not (tmp_path / "scene.glb").exists()
