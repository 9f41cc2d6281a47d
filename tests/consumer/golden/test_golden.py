"""Golden images as pytest tests, one for each frame.

    ALEPH=aleph SCENE=scene.json GOLDEN=FOLDER pytest test_golden.py

FOLDER has the reference frames as NAME.####.exr, and their maps in FOLDER/maps.
"""

import json
import os
import pathlib
import subprocess

import pytest

ALEPH = os.environ.get("ALEPH", "aleph")
SCENE = os.environ.get("SCENE", "scene.json")
GOLDEN = pathlib.Path(os.environ.get("GOLDEN", "golden"))
SETTINGS = os.environ.get("SETTINGS", "").split()
FRAMES = sorted(int(path.suffixes[-2][1:]) for path in GOLDEN.glob("*.*.exr"))


@pytest.fixture(scope="session")
def new(tmp_path_factory):
    folder = tmp_path_factory.mktemp("new")
    frames = ",".join(map(str, FRAMES))
    subprocess.run([ALEPH, "render", SCENE, "--frames", frames, *SETTINGS, "-o", f"{folder}/", "-q"], check=True)
    return folder


@pytest.fixture(scope="session")
def result(new):
    run = subprocess.run(
        [ALEPH, "compare", str(new), str(GOLDEN), "--seen", str(GOLDEN / "maps"), "--share", "0.5", "--json"],
        capture_output=True, text=True)
    assert run.returncode in (0, 1), run.stderr
    return {frame["frame"]: frame for frame in json.loads(run.stdout)["frames"]}


@pytest.mark.parametrize("frame", FRAMES)
def test_frame(result, frame):
    assert result[frame]["same"], result[frame]["visible"]
