#!/usr/bin/env bash
# Installs what aleph is built from. On Debian 12 (or a derivative) missing packages come through apt;
# elsewhere it prints what to install and stops. It does nothing if all packages are installed.
set -euo pipefail

packages=(
  g++ cmake ninja-build pkg-config
  ccache               # what was compiled before, in any checkout, is not compiled again
  libembree-dev        # rays
  libopenexr-dev       # EXR files
  libopenimageio-dev   # every other image file, comparisons
  libosd-dev           # subdivision surfaces
  libopencv-video-dev  # optical flow for --motion flow: 6 MB to fetch, 34 installed
  libtinygltf-dev nlohmann-json3-dev libvalijson-dev   # scenes
  libglm-dev libtbb-dev libcli11-dev libfmt-dev
  libjemalloc-dev      # memory in huge pages, for the program's speed
  libgtest-dev libgmock-dev                             # tests
  python3-dev pybind11-dev python3-numpy                # the Python module
  python3-pytest python3-matplotlib                     # its tests, and the plots of its notebooks
  fonts-dejavu-core    # labels on the pictures that studies draw
  locales              # the tests check that a comma locale changes nothing
  ffmpeg               # films: `aleph render -o film.mp4` starts it, and tests decode what it wrote
)

# For the comparison with Khronos' glTF-Validator. Debian's Node conflicts with other builds of it, so only where there is
# none at all.
if ! command -v node >/dev/null 2>&1 && ! command -v npm >/dev/null 2>&1; then packages+=(nodejs npm); fi

# scenes/setup.sh PACKAGE...: these too; tests/fuzz/run.sh wants clang, tests/farm.sh slurm.
for package in "$@"; do
  if [ "$package" = slurm ]; then packages+=(slurm-wlm munge); else packages+=("$package"); fi
done

if ! command -v dpkg-query >/dev/null 2>&1; then
  cat >&2 <<TEXT
This is not a Debian system, so nothing was installed. Please install, with your own package manager:
  a C++20 compiler, CMake 3.25, Ninja, Embree 3.13, OpenEXR 3.1, OpenImageIO 2.4, OpenSubdiv 3.5, tinygltf 2.7, nlohmann-json 3.11,
  valijson 1.0, GLM .9.9.8, oneTBB 2021, CLI11 2.1, fmt 9, GoogleTest 1.12, pybind11 2.9 and Python 3.11 for the
  Python module, ffmpeg, for --motion flow the module video of OpenCV 4, for speed jemalloc 5,
then configure by hand: cmake -S . -B build -G Ninja && ninja -C build
TEXT
  if command -v cmake >/dev/null 2>&1 && command -v ninja >/dev/null 2>&1; then exit 0; fi
  exit 1
fi

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query -W -f '${Status}' "$package" 2>/dev/null || true)
  [ "$status" = "install ok installed" ] || missing+=("$package")
done
[ ${#missing[@]} -gt 0 ] || exit 0

echo "aleph set-up: installing ${missing[*]}"
as_root=()
if [ "$(id -u)" != 0 ]; then
  if ! command -v sudo >/dev/null 2>&1; then
    echo "Installing needs root. Please run: apt-get install ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi
export DEBIAN_FRONTEND=noninteractive
"${as_root[@]}" apt-get update -q
"${as_root[@]}" apt-get install -y -q --no-install-recommends "${missing[@]}"
