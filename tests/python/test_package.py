"""The package: its stubs, its notebooks, and its wheel."""

import ast
import json
import os
import pathlib
import subprocess
import sys
import zipfile

import pytest

import aleph
from conftest import ROOT

PYTHON = ROOT / "render/python"


def declared(body):
    names = set()
    for part in body:
        if isinstance(part, (ast.FunctionDef, ast.ClassDef)):
            names.add(part.name)
        elif isinstance(part, ast.AnnAssign):
            names.add(part.target.id)
    return names


def public(thing):
    return {name for name in vars(thing) if not name.startswith("_")}


def test_stubs_have_every_name_and_no_other():
    stubs = ast.parse((PYTHON / "aleph/__init__.pyi").read_text())
    classes = {part.name: part for part in stubs.body if isinstance(part, ast.ClassDef)}
    assert {name for name in declared(stubs.body) if not name.startswith("_")} == set(aleph.__all__)
    inherited = declared(classes["_Element"].body)
    for name in aleph.__all__:
        thing = getattr(aleph, name)
        assert thing.__doc__, name
        if not isinstance(thing, type) or issubclass(thing, Exception):
            continue
        stub = {part for part in declared(classes[name].body) if not part.startswith("_")}
        if any(getattr(base, "id", "") == "_Element" for base in classes[name].bases):
            stub |= inherited
        assert stub == public(thing), name


def test_functions_and_properties_are_described():
    for name in aleph.__all__:
        thing = getattr(aleph, name)
        for member in public(thing) if isinstance(thing, type) else ():
            assert getattr(thing, member).__doc__ or member == "results", (name, member)


@pytest.mark.parametrize("notebook", sorted((PYTHON / "notebooks").glob("*.ipynb")), ids=lambda path: path.stem)
def test_notebook_runs(notebook, tmp_path):
    cells = json.loads(notebook.read_text())["cells"]
    code = "\n".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "code")
    environment = dict(os.environ, MPLBACKEND="Agg", QUICK="1")
    code += f"\nplt.savefig({str(tmp_path / 'plot.png')!r})"
    done = subprocess.run([sys.executable, "-c", code], cwd=notebook.parent, env=environment, capture_output=True,
                          text=True)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "plot.png").stat().st_size > 5000


def test_wheel_is_installed_without_the_network(tmp_path):
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check"]
    if subprocess.run([*pip, "--version"], capture_output=True).returncode != 0:
        pytest.skip("pip is not installed")
    environment = dict(os.environ, ALEPH_BUILD=str(pathlib.Path(aleph._aleph.__file__).parents[2]))
    done = subprocess.run([*pip, "install", "--no-index", "--no-deps", "--target", tmp_path / "site", PYTHON],
                          env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    environment["PYTHONPATH"] = str(tmp_path / "site")
    where = subprocess.run([sys.executable, "-c", "import aleph; print(aleph.__file__, aleph.__version__)"],
                           env=environment, capture_output=True, text=True, check=True).stdout
    assert where.startswith(str(tmp_path)) and where.split()[1] == aleph.__version__
