#!/usr/bin/env bash
# Builds with a sanitizer into build-address/ or build-thread/ and runs the tests that can fail under it.
#   tests/sanitizers.sh readers    memory and undefined behaviour, in what reads files, in scenes, rays and motion
#   tests/sanitizers.sh address    the same, and in maps, cache, paths and small pictures: three minutes more
#   tests/sanitizers.sh thread     races: parallel_for on std::thread, since oneTBB causes false reports (DT-08)
# JOBS is the number of compilers and test programs at a time (2).
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/.." && pwd)
jobs=${JOBS:-2}
source "$here/results.sh"

kind=${1:-}
sanitizer=$kind
case $kind in
  readers | address)
    sanitizer=address
    programs=(test_base test_pose test_image_io test_motion test_scene_file test_gltf
      test_alembic test_subdivide test_hostile)
    # Tests of time, memory and size on large texts are for the Release build, and so are killed processes. test_hostile covers
    # damaged scene files. Slow readings of image and raster motion are arithmetic; their other tests run here.
    filter='-HostileSceneFile.*:DamagedSceneFile.*:SceneJsonWrite.KF24*:SceneJsonWrite.ManyNames*:SceneJsonWrite.DT09*'
    filter+=':SceneJsonWrite.LoadOfSaveIsTheSameScene:Gltf.S13_5_KF24*:ImageMotion.EqualsTheSlowReadingOfTheModel'
    filter+=':CageMotion.FastTurnsTakeNoMoreMemory:GuidedRefused.MoreWorkThanSeconds:Output.OU07_KilledWhile*:Raster.ShowsTheTriangleThatRaysHit'
    # Pyramids, cache, sampling and materials. Left out: what checks statistics, memory or a growth of work in millions.
    rows=()
    [ "$kind" = readers ] || rows=(test_perception test_records test_materials test_paths test_lighting_keyframes)
    row_filter='AimedRays.*:LightRays.*:BrightSurfaces.*:SmallPictures.*:TextureControl.Nothing*:TextureControl.Corrected*:*.DT07*:*.PY*:*.IC*:*.MC*'
    row_filter+='-FlatPicture.*:Optimization.*:*.IC11_TheIndexFinds*:*.IC15*'
    row_filter+=':PathValues.MC13*:Accumulation.*:FurnaceScenes.*:Path.MC14*:Path.MC19*:PathLights.MC23*'
    # Pictures that are compared by what they show, and two processes with one cache file.
    row_filter+=':*.IC14_*Between*:*.IC14_LightOf*:*.IC17_*Radii*:*.IC22_TwoProcesses*:*.IC23_*:MotionBlur.MC27_IndirectLight*'
    optimize=-O1
    ;;
  thread)
    programs=(test_base test_races)
    filter='*'
    rows=()
    optimize=-O1
    ;;
  *)
    sed -n '2,7s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"
    exit 2
    ;;
esac
build=$root/build-$sanitizer

# run_filtered FILTER PROGRAM...
run_filtered() {
  local filter=$1
  shift
  GTEST_FILTER=$filter run_tests "$build" --tests-regex "^($(IFS='|'; echo "$*"))\$"
}

# GCC 12 takes parts of instrumented std::regex for uninitialized.
cmake -S "$root" -B "$build" -G Ninja -DALEPH_SANITIZE="$sanitizer" -DCMAKE_BUILD_TYPE=None \
  -DCMAKE_CXX_FLAGS="$optimize -g1 -Wno-maybe-uninitialized" -DALEPH_TESTS=ON -DALEPH_PRECOMPILE=ON -DALEPH_REPORT=OFF
cmake --build "$build" --parallel "$jobs" --target "${programs[@]}" "${rows[@]}"

# GCC 12's sanitizers cannot start if the kernel randomizes more address bits than they support. setarch turns that off; if
# it cannot, the tests are skipped.
if setarch --addr-no-randomize true 2>/dev/null; then launcher=(setarch --addr-no-randomize); fi
if "${launcher[@]}" "$build/test_base" --gtest_list_tests 2>&1 | grep -q "unexpected memory mapping"; then
  echo "Skipped: this kernel's address layout keeps the $sanitizer sanitizer from starting."
  exit 0
fi

# Leak detection is off: it needs ptrace, which containers refuse.
export ASAN_OPTIONS=detect_leaks=0:strict_string_checks=1
export UBSAN_OPTIONS=print_stacktrace=1
export TSAN_OPTIONS=suppressions=$here/tsan.supp
code=0
rm -rf "$build/results"
run_filtered "$filter" "${programs[@]}" || code=1
[ ${#rows[@]} = 0 ] || run_filtered "$row_filter" "${rows[@]}" || code=1
summarize "$build" || code=1
exit "$code"
