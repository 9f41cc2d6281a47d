#!/usr/bin/env python3
"""Mutation tests: changes one operator at a time and sees whether a test fails.

    python3 tests/mutation/mutate.py [--sample 500] [--seed 1] [--jobs 2] [--only FOLDER]

Every operator of the folders below that stands between two spaces becomes a site (mutants.h); the copy of the tree in
build-mutation/ is compiled once. Each test program says which sites it reaches. Then a sample of the sites is changed,
one per run: a mutant is killed if a program that reaches it fails, crashes, or takes ten times as long. Survivors are
listed with their line in build-mutation/survivors.txt; sites that no program reaches count as survivors.
"""
import argparse, os, pathlib, random, re, shutil, subprocess, sys, time
from concurrent.futures import ThreadPoolExecutor

ROOT = pathlib.Path(__file__).resolve().parents[2]
WORK = ROOT / "build-mutation"
FOLDERS = {
    "engine": ["engine/base", "engine/scene", "engine/pose", "engine/rays", "engine/surface"],
    "motion": ["motion"],
    "perception": ["perception"],
    "cache": ["render/irradiance_", "render/record_index", "render/cache_fill", "render/gather.", "render/pixel_filter"],
}
PROGRAMS = {
    "engine": ["test_base", "test_pose", "test_motion", "test_subdivide", "test_render"],
    "motion": ["test_motion", "test_pose", "test_render"],
    "perception": ["test_perception"],
    "cache": ["test_render", "test_cache", "test_key_moments"],
}
OPERATOR = re.compile(r"(?<=[\w)\]}]) (<=|>=|==|!=|<|>|\+|-|\*|/)(?= |$)")
# Where an operator is no expression of values: preprocessor, templates, declarations of operators, static assertions.
SKIPPED = re.compile(r"^\s*(#|//|\*|template|using|requires|static_assert|case )|operator|\bconcept\b|<=>|sizeof\.\.\.")


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
        def replace(match):
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
            if (only in (None, kind)) and name.endswith((".h", ".cpp")) and any(name.startswith(p) for p in places):
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
        wrong = {(path, int(line)) for path, line in re.findall(rf"{tree}/(\S+?):(\d+):\d+:? (?:error|  required)", made.stdout)}
        if not wrong - dropped:
            sys.exit(made.stdout[-4000:])
        dropped |= wrong
        for path in {path for path, _ in wrong}:
            lines, original = (tree / path).read_text().split("\n"), (ROOT / path).read_text().split("\n")
            for _, line in filter(lambda place: place[0] == path, wrong):
                lines[line - 1] = original[line - 1]
            (tree / path).write_text("\n".join(lines))


def run(program, variables, limit):
    try:
        done = subprocess.run([WORK / "build" / program, "--gtest_brief=1", "--gtest_fail_fast"], env={**os.environ, **variables},
                              cwd=WORK, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=limit)
        return done.returncode == 0
    except subprocess.TimeoutExpired:
        return False


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sample", type=int, default=500)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--only", choices=FOLDERS)
    options = parser.parse_args()
    sites, kinds = make_tree(options.only)
    programs = sorted({program for kind in FOLDERS if options.only in (None, kind) for program in PROGRAMS[kind]})
    dropped = build(programs, options.jobs)
    reached, seconds = {}, {}
    for program in programs:
        seen = WORK / f"{program}.seen"
        seen.unlink(missing_ok=True)
        start = time.time()
        if not run(program, {"ALEPH_MUTANT_SEEN": str(seen)}, 3600):
            sys.exit(f"{program} fails without a mutant")
        seconds[program] = time.time() - start
        for line in seen.read_text().split() if seen.exists() else []:
            reached.setdefault(int(line), set()).add(program)
    usable = [i for i, (path, line, _, _) in enumerate(sites) if (path, line) not in dropped]
    chosen = sorted(random.Random(options.seed).sample(usable, min(options.sample, len(usable))))

    def is_killed(site):
        for program in sorted(reached.get(site, []), key=seconds.get):
            if not run(program, {"ALEPH_MUTANT": str(site)}, 10 + 10 * seconds[program]):
                return True
        return False

    with ThreadPoolExecutor(options.jobs) as pool:
        killed = dict(zip(chosen, pool.map(is_killed, chosen)))
    with open(WORK / "survivors.txt", "w") as out:
        for site in chosen:
            if not killed[site]:
                path, line, operator, text = sites[site]
                out.write(f"{path}:{line}: {operator}: {text}{'' if site in reached else '   (not reached)'}\n")
    print(f"{len(usable)} sites, {len(chosen)} tried")
    for kind in FOLDERS:
        mine = [s for s in chosen if kinds[s] == kind]
        if mine:
            print(f"{kind:12} {sum(killed[s] for s in mine)} of {len(mine)} killed")


if __name__ == "__main__":
    main()
