"""Fixtures of the tests of the Python module. ALEPH is the program, PYTHONPATH has the module."""

import os
import pathlib
import subprocess

import pytest

import aleph

ROOT = pathlib.Path(__file__).resolve().parents[2]

# A ball of half a metre that moves 1 m in 16 frames before an orthographic camera: 32 pixels show 2 m.
BALL = {
    "aleph": 1, "name": "ball", "fps": 24, "frames": [0, 16],
    "materials": {"red": {"base_color": [0.8, 0.1, 0.1]}},
    "nodes": [
        {"name": "ball", "translation": {"keys": [[0, [0, 0, 0]], [16, [1, 0, 0]]]},
         "shape": {"type": "sphere", "radius": 0.5}, "material": "red"},
        {"name": "lamp", "light": {"type": "directional", "intensity": 3}},
        {"name": "eye", "translation": [0, 0, 5], "camera": {"orthographic": True, "half_height": 1}}]}

QUICK = {"size": (32, 32), "spp": 4, "light_step": 0}


@pytest.fixture
def ball():
    return aleph.load(BALL)


@pytest.fixture
def cornell():
    return ROOT / "scenes/cornell/scene.json"


@pytest.fixture
def program():
    def run(*arguments, code=0):
        done = subprocess.run([os.environ["ALEPH"], *map(str, arguments)], capture_output=True, text=True)
        assert done.returncode == code, done.stderr
        return done.stdout
    return run
