"""Frames from Python: what they hold, whose memory it is, and how a render ends."""

import gc
import os
import resource
import signal
import subprocess
import sys
import threading
import warnings
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import aleph
from conftest import BALL, QUICK


@pytest.mark.parametrize("settings", [{"error": 2}, {}, {"integrator": "path", "spp": 2}])
def test_frame_is_that_of_the_command_line(cornell, program, tmp_path, settings):
    aleph.render(cornell, 1, size=(32, 24), **settings).save(tmp_path / "python.exr")
    options = [text for key, value in settings.items() for text in (f"--{key}", value)]
    program("render", cornell, "--frames", 1, "--size", "32x24", "--aovs", "-q", "-o", tmp_path / "cli.exr", *options)
    program("compare", tmp_path / "python.exr", tmp_path / "cli.exr")


def test_arrays_share_the_memory_of_their_frame(ball):
    frame = aleph.render(ball, 3, **QUICK)
    for name in ["color", "motion", "aleph", "threshold", "saliency", "samples", "motion_valid", "depth"]:
        array = getattr(frame, name)
        assert array.shape[:2] == (32, 32), name
        assert array.base is frame and not array.flags.writeable and not array.flags.owndata, name
        assert array.__array_interface__["data"] == getattr(frame, name).__array_interface__["data"], name
    assert frame.color.dtype == np.float32 and frame.color.shape == (32, 32, 3)
    assert frame.motion.dtype == np.float64 and frame.motion.shape == (32, 32, 2)


def test_arrays_outlive_their_frame(ball):
    color = aleph.render(ball, 3, **QUICK).color
    before = color.copy()
    gc.collect()
    others = [aleph.render(ball, 3, **QUICK) for _ in range(4)]
    assert np.array_equal(color, before) and np.array_equal(others[0].color, before)


def test_motion_is_what_the_keys_say(ball):
    frame = aleph.render(ball, 3, **QUICK)
    on_ball = frame.motion_valid == 1
    assert 100 < on_ball.sum() < 400
    assert np.allclose(frame.motion[on_ball], [1, 0], atol=1e-9)
    assert np.allclose(frame.backward[frame.backward_valid == 1], [-1, 0], atol=1e-9)


def test_without_maps_only_what_is_needed_is_computed(ball):
    frame = aleph.render(ball, 3, maps=False, guide="none", **QUICK)
    assert frame.color is not None and frame.saliency is None and frame.depth is None
    frame = aleph.Sequence(ball, **QUICK).render(3, picture=False)
    assert frame.color is None and frame.saliency is not None
    with pytest.raises(aleph.InputError, match="maps only"):
        frame.save("frame.png")


def test_statistics_and_plan(ball):
    frame = aleph.render(ball, 3, **QUICK)
    assert frame.number == 3 and frame.statistics["frame"] == 3
    assert frame.statistics["samples"] == int(frame.samples.sum()) == 4 * 32 * 32
    assert {"effect", "decision", "reason", "bound"} <= set(frame.plan[0])


def test_sequence_does_not_depend_on_order(ball):
    sequence = aleph.Sequence(ball, **QUICK)
    assert sequence.frames == (0, 16)
    last, first = sequence.render(9), sequence.render(2)
    assert np.array_equal(first.color, aleph.render(ball, 2, exposure=sequence.exposure, **QUICK).color)
    assert not np.array_equal(first.color, last.color)


def test_edit_between_frames(ball):
    sequence = aleph.Sequence(ball, **QUICK)
    sequence.render(0)
    kept = []

    def move(scene):
        scene.nodes["ball"].translation = [0.25, 0, 0]
        kept.append(scene.nodes["ball"])

    sequence.edit(move)
    frame = sequence.render(1)
    assert np.allclose(frame.motion[frame.motion_valid == 1], [4, 0], atol=1e-9)
    assert np.array_equal(kept[0].translation, [0.25, 0, 0])
    with pytest.raises(ZeroDivisionError):
        sequence.edit(lambda scene: 1 / 0)
    assert np.array_equal(sequence.render(1).color, frame.color)


def test_progress_comes_to_this_thread_and_may_end_the_frame(ball):
    seen = []
    aleph.render(ball, 3, on_progress=lambda share, stage: seen.append((share, stage, threading.get_ident())), **QUICK)
    assert all(0 <= share <= 1 and thread == threading.get_ident() for share, _, thread in seen)

    def end(share, stage):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        aleph.render(ball, 3, on_progress=end, integrator="path", spp=65536, size=(64, 64))


def test_ctrl_c_ends_a_render(tmp_path):
    code = ("import aleph, sys; from conftest import BALL\n"
            "try: aleph.render(BALL, 3, on_progress=lambda f, s: print(s, flush=True), integrator='path', spp=65536, size=(640, 640))\n"
            "except KeyboardInterrupt: print('interrupted')\n")
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True,
                          cwd=os.path.dirname(__file__)) as child:
        assert any(line == "shade\n" for line in child.stdout)
        child.send_signal(signal.SIGINT)
        assert child.stdout.read().splitlines()[-1] == "interrupted"


def test_several_python_threads_render_at_once(ball):
    expected = aleph.render(ball, 3, **QUICK).color
    with ThreadPoolExecutor(4) as pool:
        results = list(pool.map(lambda _: aleph.render(ball, 3, **QUICK).color, range(4)))
    assert all(np.array_equal(color, expected) for color in results)


def test_python_threads_share_a_sequence(ball):
    sequence = aleph.Sequence(ball, **QUICK)
    expected = [sequence.render(number).color for number in range(6)]
    with ThreadPoolExecutor(6) as pool:
        results = list(pool.map(lambda number: sequence.render(number, on_progress=lambda share, stage: None).color,
                                range(6)))
    assert all(map(np.array_equal, results, expected))


def test_a_sequence_is_not_used_while_it_renders(ball):
    sequence = aleph.Sequence(ball, **QUICK)
    with pytest.raises(aleph.InputError, match="cannot use the sequence"):
        sequence.render(3, on_progress=lambda share, stage: sequence.render(4))
    with pytest.raises(aleph.InputError, match="cannot use the sequence"):
        sequence.edit(lambda scene: sequence.render(4))
    assert np.array_equal(sequence.render(3).color, aleph.render(ball, 3, **QUICK).color)


def test_memory_does_not_grow(ball):
    def render(times):
        for _ in range(times):
            aleph.render(ball, 3, threads=1, **QUICK)
        gc.collect()
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss

    before = render(50)
    assert render(100) - before < 4 * 1024  # KiB; the frames alone would be 30 MiB


def test_frames_outside_the_shot_give_a_warning(ball):
    with pytest.warns(UserWarning, match="frame 99 lies outside the shot, which has the frames 0 to 16"):
        aleph.render(ball, 99, **QUICK)
    sequence = aleph.Sequence(ball, **QUICK)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        sequence.render(16)
        with pytest.raises(UserWarning, match="frame -1"):
            sequence.render(-1)
        sequence.edit(lambda scene: None)  # a simulation has numbers of its own
        sequence.render(99)
    with pytest.raises(aleph.InputError, match="within 9e15"):
        sequence.render(2**63 - 1)
