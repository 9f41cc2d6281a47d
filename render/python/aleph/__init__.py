"""aleph: animated scenes, rendered to the error that a viewer tolerates.

    import aleph
    scene = aleph.load("scene.json")
    frame = aleph.render(scene, frame=20, error=1, size=(320, 240))
    frame.color, frame.motion, frame.aleph     # numpy arrays that share the frame's memory
"""

import csv as _csv
import io as _io
import os as _os
import tempfile as _tempfile
from operator import index as _index

from ._aleph import (
    Camera, Frame, InputError, Light, Material, Mesh, Node, OutputError, Scene, Sequence, Track, __version__,
    add_vision, compare, load, maps, render, run_study as _run_study, seen)

__all__ = [
    "Camera", "Frame", "InputError", "Light", "Material", "Mesh", "Node", "OutputError", "Scene", "Sequence",
    "Table", "Track", "add_vision", "compare", "load", "maps", "render", "seen", "study"]


class Table(dict):
    """Columns of a study by name, lists of one length; pandas.DataFrame(table) takes it.

    results: everything that study.json has, as a dict.
    """

    results = None

    def rows(self):
        """The rows, each a dict."""
        return [dict(zip(self, values)) for values in zip(*self.values())]


def _value(text):
    if text == "":
        return None
    try:
        number = float(text)
    except ValueError:
        return text
    return int(number) if number.is_integer() and text.lstrip("-").isdigit() else number


def study(scene, frames="", sweep=None, *, variants=None, pictures=None, size=(320, 240), settings=None, reference=None,
          metrics=None, viewers=None, seeds=1, folder=None, threads=0, on_progress=None):
    """Measures what settings cost in time, and what error they leave.

    scene: a scene file, a study file, or a study as a dict (`scenes/studies/study.schema.json`); the arguments after
        it are for a scene file.
    frames: a number or a list of them, or text such as "0-89x10"; empty: the middle of the shot.
    sweep: lists of values by setting, such as {"error": [0.5, 1, 2]}; every combination is a variant.
    variants: settings by name, such as {"mine": {"vision": "mine"}}.
    pictures: frames that other programs made, such as {"other": "other.####.exr"}: judged without costs.
    reference: {"passes": 4, "spp": 32}: path tracing that judges the variants.
    viewers: models of vision that judge, such as [{"name": "castle", "settings": {"vision": "castle"}}].
    seeds: renderings of each with random numbers of their own.
    folder: keeps the pictures and finished runs; None: they are thrown away.
    Returns a Table with one row for each variant and frame.
    """
    if isinstance(scene, Scene) or isinstance(scene, dict) and "aleph" in scene:
        raise TypeError("a study reads its scene from a file: Scene.save writes one")
    if not isinstance(frames, str):
        frames = ",".join(str(_index(frame)) for frame in (frames if hasattr(frames, "__iter__") else [frames]))
    chosen = sweep or variants or pictures
    one = isinstance(scene, dict) or not chosen
    if one and (frames or chosen or settings or reference or metrics or viewers or seeds != 1 or size != (320, 240)):
        raise TypeError("a study has these itself; a scene file needs sweep, variants or pictures beside them")
    if one:
        asked = scene if isinstance(scene, dict) else _os.fspath(scene)
    else:
        asked = {"scenes": [{"scene": _os.path.abspath(_os.fspath(scene))}],
                 "size": size if isinstance(size, str) else "{}x{}".format(*size), "seeds": list(range(seeds))}
        if frames:
            asked["scenes"][0]["frames"] = frames
        asked["variants"] = [
            *({"name": name, "settings": chosen} for name, chosen in (variants or {}).items()),
            *({"name": name, "pictures": _os.path.abspath(files)} for name, files in (pictures or {}).items())]
        given = {"sweep": sweep, "settings": settings, "reference": reference, "metrics": metrics, "viewers": viewers}
        asked.update({key: value for key, value in given.items() if value})
    with _tempfile.TemporaryDirectory() as temporary:
        text, results = _run_study(asked, folder or temporary, threads=threads, on_progress=on_progress)
    rows = list(_csv.reader(_io.StringIO(text)))
    table = Table((name, [_value(row[i]) for row in rows[1:]]) for i, name in enumerate(rows[0]))
    table.results = results
    return table


for _name in __all__:
    globals()[_name].__module__ = __name__
