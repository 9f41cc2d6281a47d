"""Builds the wheel for `pip install ./render/python`, by CMake and without the network.

The module is built in build/pip; ALEPH_BUILD names another build folder, such as one that has the libraries already.
"""

import base64
import hashlib
import os
import pathlib
import subprocess
import sys
import sysconfig
import tomllib
import zipfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
PROJECT = tomllib.loads((HERE / "pyproject.toml").read_text())["project"]
NAME = "{}-{}".format(PROJECT["name"].replace("-", "_"), PROJECT["version"])
TAG = "cp{0}{1}-cp{0}{1}-{2}".format(
    *sys.version_info[:2], sysconfig.get_platform().replace("-", "_").replace(".", "_"))


def get_requires_for_build_wheel(config_settings=None):
    return []


def _build():
    """Builds the module. Returns the folder of the package."""
    build = pathlib.Path(os.environ.get("ALEPH_BUILD", ROOT / "build" / "pip")).absolute()
    subprocess.run(
        ["cmake", "-S", ROOT, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DALEPH_PYTHON=ON",
         f"-DPython_EXECUTABLE={sys.executable}",
         *([] if "ALEPH_BUILD" in os.environ else ["-DALEPH_TESTS=OFF", "-DALEPH_PRECOMPILE=ON"])], check=True)
    subprocess.run(["cmake", "--build", build, "--target", "aleph_python"], check=True)
    return build / "python" / "aleph"


def _metadata():
    lines = ["Metadata-Version: 2.1", "Name: " + PROJECT["name"], "Version: " + PROJECT["version"],
             "Summary: " + PROJECT["description"], "Requires-Python: " + PROJECT["requires-python"]]
    return "\n".join(lines + ["Requires-Dist: " + name for name in PROJECT["dependencies"]]) + "\n"


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    package = _build()
    info = NAME + ".dist-info"
    files = {"aleph/" + path.name: path.read_bytes() for path in sorted(package.iterdir()) if path.is_file()}
    files[info + "/METADATA"] = _metadata().encode()
    files[info + "/WHEEL"] = "Wheel-Version: 1.0\nGenerator: aleph\nRoot-Is-Purelib: false\nTag: {}\n".format(TAG).encode()
    record = ""
    for name, data in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        record += f"{name},sha256={digest},{len(data)}\n"
    files[info + "/RECORD"] = (record + f"{info}/RECORD,,\n").encode()
    wheel = f"{NAME}-{TAG}.whl"
    with zipfile.ZipFile(pathlib.Path(wheel_directory) / wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in files.items():
            archive.writestr(name, data)
    return wheel
