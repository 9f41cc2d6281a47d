#!/usr/bin/env python3
"""Mutation tests: changes one operator at a time and sees whether a test fails.

    python3 tests/mutation/mutate.py [--sample 500] [--seed 1] [--jobs 2] [--only FOLDER...]

Every operator of the folders below that stands between two spaces becomes a site (mutants.h); the copy of the tree in
build-mutation/ is compiled once. Each test, run alone, says which sites it reaches. Then a sample of the sites is changed,
one per run: a mutant is killed if a test that reaches it fails, crashes, or takes ten times as long. Survivors are listed
with their line in build-mutation/survivors.txt as they are found; sites that no test reaches count as survivors.
"""
import argparse, os, pathlib, random, re, shutil, subprocess, sys, time
from concurrent.futures import ThreadPoolExecutor

ROOT = pathlib.Path(__file__).resolve().parents[2]
WORK = ROOT / "build-mutation"
FOLDERS = {
    "engine": ["engine/base/", "engine/scene/", "engine/pose/", "engine/rays/", "engine/surface/"],
    "motion": ["motion/"],
    "perception": ["perception/"],
    "cache": ["render/cache/"],
    "light": ["render/light/"],
    "path": ["render/path/"],
    "time": ["render/time/"],
    **{room: [f"render/{room}/"] for room in ("shade", "frame", "estimate", "plan", "pixels", "guide", "budget", "verify", "compare")},
}
PROGRAMS = {
    "engine": ["test_base", "test_pose", "test_motion", "test_subdivide", "test_scene_file", "test_render", "test_gltf",
               "test_alembic"],
    "motion": ["test_motion", "test_pose", "test_render"],
    "perception": ["test_perception", "test_gratings"],
    "cache": ["test_render", "test_cache", "test_records", "test_materials", "test_lighting_keyframes", "test_sequence"],
    "light": ["test_paths", "test_records", "test_render", "test_blur"],
    "path": ["test_paths", "test_records", "test_blur"],
    "time": ["test_paths", "test_lighting_keyframes", "test_blur"],
    "shade": ["test_render", "test_records", "test_materials", "test_blur"],
    "frame": ["test_sequence", "test_lighting_keyframes", "test_blur"],
    "estimate": ["test_maps_images", "test_render", "test_blur"],
    "plan": ["test_effects"],
    "pixels": ["test_records", "test_render"],
    "guide": ["test_render", "test_maps_images"],
    "budget": ["test_budget"],
    "verify": ["test_verify"],
    "compare": ["test_sequence"],
}
OPERATOR = re.compile(r"(?<=[\w)\]}]) (<=|>=|==|!=|<|>|\+|-|\*|/)(?= |$)")
# Where an operator is no expression of values: preprocessor, templates, declarations of operators, static assertions.
# Constants of the compiler too: they cannot change when a program starts.
SKIPPED = re.compile(r"^\s*(#|//|\*|template|using|requires|static_assert|case )|operator|\bconcept\b|<=>|sizeof\.\.\.|"
                     r"\bconstexpr [^()]*=|if constexpr|std::array<[^>]* [-+*/] [^>]*>")

# The smaller or larger of two values: where they are equal, either is right.
VALUE = r"(-?[\w.\[\]]+|static_cast<\w+>\(\w+\))"
CHOICE = re.compile(rf"(?<![\w.]){VALUE} [<>] {VALUE} \? (?:\1 : \2|\2 : \1)(?![\w.\[(])")


def code_of(line):
    """The line's length without a comment, and whether it has strings, in which operators are text."""
    at = line.find("//")
    return (line if at < 0 else line[:at]), '"' in line or "'" in line


def mutate(path, sites):
    lines = path.read_text().split("\n")
    for number, line in enumerate(lines):
        code, text = code_of(line)
        if SKIPPED.search(line) or text or not code.strip():
            continue
        free = {choice.end(1) + 1 for choice in CHOICE.finditer(code)}
        def replace(match):
            if match.start(1) in free:
                return match.group(0)
            sites.append((str(path.relative_to(WORK / "tree")), number + 1, match.group(1), line.strip()))
            return f" {match.group(1)}ALEPH_SITE({len(sites) - 1}){match.group(1)}"
        lines[number] = OPERATOR.sub(replace, code) + line[len(code):]
    path.write_text("\n".join(lines))


def make_tree(only):
    tree = WORK / "tree"
    tree.mkdir(parents=True, exist_ok=True)
    files = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=True).stdout.split("\n")
    sites, kinds = [], []
    for name in filter(None, files):
        source, target = ROOT / name, tree / name
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(source, target)
        for kind, places in FOLDERS.items():
            if (not only or kind in only) and name.endswith((".h", ".cpp")) and any(name.startswith(p) for p in places):
                mutate(target, sites)
                kinds += [kind] * (len(sites) - len(kinds))
                shutil.copystat(source, target)
    return sites, kinds


def build(programs, jobs):
    flags = f"-std=c++20 -w -include {ROOT}/tests/mutation/mutants.h"
    tree, folder = WORK / "tree", WORK / "build"
    subprocess.run(["cmake", "-S", tree, "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DALEPH_REPORT=OFF",
                    "-DALEPH_PRECOMPILE=ON", f"-DCMAKE_CXX_FLAGS={flags}", "-DCMAKE_CXX_FLAGS_RELEASE=-O1"],
                   check=True, stdout=subprocess.DEVNULL)
    dropped = set()
    while True:  # lines that no longer compile are put back
        made = subprocess.run(["ninja", "-C", folder, "-j", str(jobs), "-k", "0", *programs], capture_output=True, text=True)
        if made.returncode == 0:
            return dropped
        wrong = {(path, int(line)) for path, line in re.findall(rf"(?:{tree}|\.\./tree)/(\S+?):(\d+):\d+:? (?:error|  required)", made.stdout)}
        if not wrong - dropped:
            sys.exit(made.stdout[-4000:])
        dropped |= wrong
        for path in {path for path, _ in wrong}:
            lines, original = (tree / path).read_text().split("\n"), (ROOT / path).read_text().split("\n")
            for _, line in filter(lambda place: place[0] == path, wrong):
                lines[line - 1] = original[line - 1]
            (tree / path).write_text("\n".join(lines))


def run(program, tests, variables, limit):
    command = [WORK / "build" / program, "--gtest_brief=1", "--gtest_fail_fast", "--gtest_filter=" + ":".join(tests)]
    try:
        return subprocess.run(command, env={**os.environ, **variables}, cwd=WORK, stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL, timeout=limit).returncode == 0
    except subprocess.TimeoutExpired:
        return False


def list_tests(program):
    printed = subprocess.run([WORK / "build" / program, "--gtest_list_tests"], capture_output=True, text=True, check=True)
    suite = ""
    for line in printed.stdout.split("\n"):
        if line.startswith("  "):
            yield program, suite + line.split()[0]
        elif line.endswith(".") or ".  #" in line:
            suite = line.split()[0]


def reach(test):
    """The sites that a test (program, name) reaches, and the seconds that it takes."""
    seen, start = WORK / "seen" / "-".join(test).replace("/", "."), time.time()
    seen.unlink(missing_ok=True)
    if not run(test[0], [test[1]], {"ALEPH_MUTANT_SEEN": str(seen)}, 3600):
        print(f"{test[0]} {test[1]} fails without a mutant: left out", flush=True)
        return [], 0.0
    return [int(site) for site in seen.read_text().split()] if seen.exists() else [], time.time() - start


def is_killed(site, tests, seconds):
    """Quick tests of a program in one run, then each slow one."""
    quick = {}
    for test in filter(lambda test: seconds[test] < 1, tests):
        quick.setdefault(test[0], []).append(test[1])
    runs = list(quick.items()) + [(program, [name]) for program, name in sorted(tests, key=seconds.get) if seconds[program, name] >= 1]
    for program, names in runs:
        if not run(program, names, {"ALEPH_MUTANT": str(site)}, 10 + 10 * sum(seconds[program, name] for name in names)):
            return True
    return False


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sample", type=int, default=500)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--only", choices=FOLDERS, nargs="+")
    options = parser.parse_args()
    sites, kinds = make_tree(options.only)
    programs = sorted({program for kind in FOLDERS if not options.only or kind in options.only for program in PROGRAMS[kind]})
    dropped = build(programs, options.jobs)
    (WORK / "seen").mkdir(exist_ok=True)
    reached, seconds = {}, {}
    with ThreadPoolExecutor(options.jobs) as pool:
        tests = [test for program in programs for test in list_tests(program)]
        for test, (found, took) in zip(tests, pool.map(reach, tests)):
            seconds[test] = took
            for site in found:
                reached.setdefault(site, []).append(test)
        usable = [i for i, (path, line, _, _) in enumerate(sites) if (path, line) not in dropped]
        chosen = sorted(random.Random(options.seed).sample(usable, min(options.sample, len(usable))))
        killed = {}
        with open(WORK / "survivors.txt", "w") as out:
            for site, dead in zip(chosen, pool.map(lambda site: is_killed(site, reached.get(site, []), seconds), chosen)):
                killed[site] = dead
                path, line, operator, text = sites[site]
                if not dead:
                    print(f"{path}:{line}: {operator}: {text}{'' if site in reached else '   (not reached)'}", file=out, flush=True)
    print(f"{len(usable)} sites, {len(chosen)} tried")
    for kind in FOLDERS:
        mine = [s for s in chosen if kinds[s] == kind]
        if mine:
            print(f"{kind:12} {sum(killed[s] for s in mine)} of {len(mine)} killed")


if __name__ == "__main__":
    main()
