"""Functions on arrays as parts of the guide; maps of pictures, comparisons and studies."""

import numpy as np
import pytest

import aleph
from conftest import BALL, QUICK


def test_a_vision_of_ones_sees_everything(ball):
    frame = aleph.render(ball, 3, vision=lambda frequency, retinal, tracked, luminance: 1, **QUICK)
    assert np.all(frame.aleph == 1)


def test_vision_gets_rows_and_gives_elevations(ball):
    frequencies = set()

    def elevation(frequency, retinal, tracked, luminance):
        frequencies.add(frequency)
        assert retinal.shape == tracked.shape == luminance.shape and np.all(luminance >= 0)
        return 1 + retinal

    frame = aleph.render(ball, 3, vision=elevation, **QUICK)
    assert len(frequencies) == 7
    assert np.allclose(frame.aleph, 1 + frame.retinal_velocity, rtol=1e-5)


def test_an_added_vision_has_a_name(ball):
    aleph.add_vision("two", lambda *stimulus: 2, lambda luminance: np.full_like(luminance, 0.25))
    frame = aleph.render(ball, 3, vision="two", **QUICK)
    assert np.all(frame.aleph == 2) and np.all(frame.threshold == 0.5)
    with pytest.raises(aleph.InputError, match="above 0"):
        aleph.add_vision("two", lambda *stimulus: 2, lambda luminance: luminance * 0)
        aleph.render(ball, 3, vision="two", **QUICK)
    aleph.add_vision("two", lambda *stimulus: 3)
    assert np.all(aleph.render(ball, 3, vision="two", **QUICK).aleph == 3)
    with pytest.raises(aleph.InputError, match="aleph's own"):
        aleph.add_vision("thesis", lambda *stimulus: 2)


@pytest.mark.parametrize("wrong", [
    lambda *stimulus: np.ones(3), lambda *stimulus: float("nan"), lambda *stimulus: "high"])
def test_wrong_elevations_are_refused(ball, wrong):
    with pytest.raises(aleph.InputError):
        aleph.render(ball, 3, vision=wrong, **QUICK)


def test_adapter(ball):
    frame = aleph.render(ball, 3, adapter=lambda aleph_map, accuracy: accuracy / aleph_map, accuracy=0.2, **QUICK)
    assert np.allclose(frame.accuracy, 0.2 / frame.aleph, rtol=1e-5)
    with pytest.raises(aleph.InputError, match="size"):
        aleph.render(ball, 3, adapter=lambda aleph_map, accuracy: aleph_map[1:], **QUICK)


def test_stopping_rule(ball):
    stages = []

    def rule(x, y, samples, error, deviation, tolerance):
        stages.append(samples.max())
        return (samples >= 8) | (x < 16)

    frame = aleph.render(ball, 3, sampling=rule, size=(32, 32), spp=64)
    first = stages[0]
    assert np.all(frame.samples[:, :16] == first) and np.all(frame.samples[:, 16:] == max(first, 8))


def test_what_a_function_raises_ends_the_render(ball):
    def fail(*arguments):
        raise ArithmeticError("in the function")

    for part in ["vision", "adapter", "sampling"]:
        with pytest.raises(ArithmeticError, match="in the function"):
            aleph.render(ball, 3, **{part: fail}, **QUICK)


def test_maps_of_pictures_are_those_of_the_command_line(ball, program, tmp_path):
    colors = []
    for number in (3, 4):
        frame = aleph.render(ball, number, **QUICK)
        frame.save(tmp_path / f"frame.{number:04}.exr")
        colors.append(frame.color)
    program("maps", "--images", tmp_path / "frame.####.exr", "--fps", 24, "--motion-layer", "none", "--depth-layer",
            "none", "-q", "-o", tmp_path / "cli.####.exr")
    for number, maps in zip((3, 4), aleph.maps(colors, fps=24)):
        maps.save(tmp_path / "python.exr")
        program("compare", tmp_path / "python.exr", tmp_path / f"cli.{number:04}.exr")


def test_maps_take_motion():
    images = [np.random.default_rng(5).random((32, 32, 3)) for _ in range(2)]
    motion = np.zeros((32, 32, 2))
    motion[:, 16:] = [3, -4]
    motion[0, 0] = np.nan
    first, _ = aleph.maps(images, fps=30, motion=[motion, motion])
    assert np.array_equal(first.motion[1:], motion[1:]) and first.motion_valid[0, 0] == -3
    assert np.allclose(first.velocity[8, 20], 5 / 31 * 30, rtol=1e-5)


def test_cuts_outside_of_the_pictures_give_a_warning():
    images = [np.zeros((8, 8, 3), np.float32)] * 2
    for cut in -5, 2:
        with pytest.warns(UserWarning, match=f"cuts: frame {cut} lies outside"):
            assert len(aleph.maps(images, fps=24, cuts=[1, cut])) == 2


def test_maps_of_pictures_refuse_what_needs_a_scene():
    images = [np.zeros((8, 8, 3), np.float32)] * 2
    for settings in {"size": (8, 8)}, {"spp": 4}:
        with pytest.raises(aleph.InputError, match="this setting needs a scene"):
            aleph.maps(images, fps=24, **settings)


def test_compare(ball, program, tmp_path):
    coarse, fine = aleph.render(ball, 3, **QUICK), aleph.render(ball, 3, size=(32, 32), spp=64, light_step=0)
    result = aleph.compare(coarse, fine, fine)
    difference = np.abs(coarse.color.astype(float) - fine.color)
    assert not result["same"] and result["max"] == pytest.approx(difference.max())
    assert result["rms"] == pytest.approx(np.sqrt((difference ** 2).mean()))
    assert aleph.compare(fine, fine.color)["same"]
    luminance = difference @ [0.2126, 0.7152, 0.0722] * 100
    by_array = aleph.compare(coarse.color, fine.color, fine.threshold)
    assert by_array["thresholds_beyond"] == result["thresholds_beyond"] > 0
    grey = aleph.compare(fine.color + 0.01, fine.color, fine.threshold)
    assert grey["thresholds_beyond"] == pytest.approx(100 * (1 > fine.threshold).mean(), abs=0.5)
    for wrong in {"tolerance": -1}, {"tolerance": np.nan}, {"display_white": 0}:
        with pytest.raises(aleph.InputError, match=f"{next(iter(wrong))}: must"):
            aleph.compare(fine, fine, fine, **wrong)


def test_seen(ball):
    settings = dict(size=(32, 32), light_step=0)
    reference = aleph.Sequence(ball, spp=64, **settings)
    frames = [reference.render(number) for number in (3, 4, 5)]
    assert aleph.seen(frames, frames, frames)["seen"] == 0
    brighter = [frame.color * 1.5 for frame in frames]
    shares = aleph.seen(brighter, frames, frames)
    assert 5 < shares["seen"] <= 100 and shares["lasting"] > 0 and shares["noticed"] >= 0
    with pytest.raises(aleph.InputError):
        aleph.seen(frames, frames[1:], frames)
    with pytest.raises(aleph.InputError, match=r"maps\[0\]: expected a Frame"):
        aleph.seen(frames, frames, brighter)
    for wrong in frames[::-1], [frames[0]] * 3:
        with pytest.raises(aleph.InputError, match=r"maps\[1\]: frame \d does not come after frame \d"):
            aleph.seen(frames, frames, wrong)


def test_study_gives_columns(cornell, tmp_path):
    progress = []
    arguments = dict(frames=[1], sweep={"spp": [1, 4]}, size=(24, 18), reference={"passes": 2, "spp": 16},
                     folder=tmp_path / "study")
    table = aleph.study(cornell, **arguments, on_progress=lambda share, what: progress.append(share))
    assert table["variant"] == ["spp=1", "spp=4"] and table["frame"] == [1, 1] and table["spp"] == [1, 4]
    assert table["mean_error"][0] > table["mean_error"][1] > 0
    assert table.rows()[1]["variant"] == "spp=4" and table.results["variants"][0]["id"] == "spp=1"
    again = aleph.study(cornell, **arguments)
    kept = ["mean_error", "processor_seconds"]
    assert [again[name] for name in kept] == [table[name] for name in kept]


def test_settings_are_numbers_of_numpy_too(ball):
    plain = aleph.render(ball, 0, size=(8, 8), spp=2, neutral_opponent=True)
    numpy = aleph.render(ball, np.int64(0), size=np.array([8, 8]), spp=np.int64(2), neutral_opponent=np.bool_(True))
    assert np.array_equal(plain.aleph, numpy.aleph)


def test_a_study_takes_no_arguments_of_a_scene(cornell):
    study = {"scenes": [{"scene": str(cornell), "frames": "1"}], "size": "8x6", "sweep": {"spp": [1]},
             "reference": {"passes": 2, "spp": 1}}
    assert aleph.study(study)["variant"] == ["spp=1"]
    with pytest.raises(TypeError):
        aleph.study(study, frames=[2])
    for arguments in {"sweep": {"spp": [2]}}, {"size": (16, 12)}:
        with pytest.raises(TypeError, match="a study has these itself"):
            aleph.study(study, **arguments)
    for frames in 0, [0], np.array([0]), "0":
        assert aleph.study(cornell, frames, {"spp": [1]}, size=(4, 3), reference={"passes": 2, "spp": 1})["frame"] == [0]
    with pytest.raises(TypeError):
        aleph.study(cornell, [5.5], {"spp": [1]})
    with pytest.raises(TypeError, match="a scene file needs sweep, variants or pictures"):
        aleph.study(cornell, frames=[2])
    for scene in aleph.load(cornell), aleph.load(cornell).to_dict():
        with pytest.raises(TypeError, match="Scene.save writes one"):
            aleph.study(scene, sweep={"spp": [1]})


def test_study_of_an_added_vision(cornell):
    aleph.add_vision("blind", lambda *stimulus: 250)
    table = aleph.study(
        cornell, frames=[1], size=(24, 18), reference={"passes": 2, "spp": 4},
        variants={"thesis": {"vision": "thesis"}, "blind": {"vision": "blind"}},
        settings={"sampling": "variance", "spp": 64, "light_step": 0}, metrics=["samples", "mean_error"])
    thesis, blind = table["samples"]
    assert blind < thesis
