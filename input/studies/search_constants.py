#!/usr/bin/python3
"""Varies the constants of the contact search, one at a time, and counts solved scenes, solves and conjugate gradient iterations.

    input/studies/search_constants.py --work DIR [--friction N] [--wide N] [--jobs N] [--only REGEX]

Builds a copy of the sources in DIR in which each constant of packages/search can be set by an environment variable, and runs random scenes
of the corpora (test/validation) with each constant divided and multiplied by ten; where a fraction would exceed one, half of the rest is
added instead. Integers are halved and doubled. Prints a table; DIR/results.json keeps all runs, and an interrupted study continues.
"""
import argparse
import concurrent.futures
import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path[:0] = [str(ROOT / "test" / "validation"), str(ROOT / "test" / "drivers")]
CONSTANT = re.compile(r"^(\s*)(?:static )?constexpr (double|int) (k\w+) = ([-+.\de]+);", re.M)
READER = """
#include <cstdlib>
namespace {
template <typename T>
T studied(const char* name, T value) {
  const char* set = std::getenv(name);
  return set ? static_cast<T>(std::atof(set)) : value;
}
}  // namespace
"""


def patched(work):
    """Copies the sources, with constants read from the environment; returns them by name, with file and value."""
    source = work / "source"
    if not source.exists():
        shutil.copytree(ROOT, source, ignore=shutil.ignore_patterns("build*", ".git"))
    constants = {}
    for file in sorted((ROOT / "packages" / "search").glob("*.cpp")):
        text = file.read_text()

        def read(match):
            indent, kind, name, value = match.groups()
            constants[name] = (file.name, kind, float(value))
            return f'{indent}const {kind} {name} = studied<{kind}>("{name}", {value});'

        changed = CONSTANT.sub(read, text)
        if changed != text:
            last = [m.end() for m in re.finditer(r"^#include.*$", changed, re.M)][-1]
            reader = READER.replace("studied(", f"studied_{file.stem}(")
            changed = changed[:last] + reader + changed[last:].replace("studied<", f"studied_{file.stem}<")
        target = source / "packages" / "search" / file.name
        if target.read_text() != changed:
            target.write_text(changed)
    return constants


def build(work):
    folder = work / "source" / "build"
    for command in (["cmake", "-S", str(work / "source"), "-B", str(folder), "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                     "-DSUTURE_UNITY=ON", "-DSUTURE_TESTS=OFF"],
                    ["ninja", "-C", str(folder), "suture_solve"]):
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return folder / "drivers" / "suture_solve"


def write_scenes(work, friction, wide):
    import friction_scenes
    import wide_scenes
    scenes = []
    for kind, count in (("friction", friction), ("wide", wide)):
        for seed in range(1, count + 1):
            folder = work / "scenes" / f"{kind}_{seed}"
            if not (folder / "scene.xml").exists():
                scene = friction_scenes.scene(seed, None, None) if kind == "friction" else wide_scenes.scene(seed)
                scene.write(str(folder))
            scenes.append(folder)
    return scenes


def run(solve, scene, name, value):
    output = scene / f"run_{name}_{value:g}"
    own = {name: repr(value)} if name else {}
    try:
        code = subprocess.run([str(solve), str(scene / "scene.xml"), "--output", str(output), "--set", "Output/Fields=false"],
                              env={**os.environ, **own}, capture_output=True, timeout=120).returncode
        outer = json.loads((output / "summary.json").read_text())["outer"] if code == 0 else {}
    except (subprocess.TimeoutExpired, OSError):
        code, outer = -1, {}
    shutil.rmtree(output, ignore_errors=True)
    return code, outer.get("iterations", 0), outer.get("pcg_total", 0)


def variants(kind, value):
    if kind == "int":
        return [max(1, int(value) // 2), 2 * int(value)]
    return [value / 10, 10 * value if 10 * value <= 1 or value > 1 else value + (1 - value) / 2 if value < 1 else 10 * value]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--work", type=Path, required=True)
    parser.add_argument("--friction", type=int, default=40)
    parser.add_argument("--wide", type=int, default=20)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--only", default="", help="constants whose file or name matches")
    options = parser.parse_args()
    options.work.mkdir(parents=True, exist_ok=True)
    constants = patched(options.work)
    solve = build(options.work)
    scenes = write_scenes(options.work, options.friction, options.wide)
    path = options.work / "results.json"
    results = json.loads(path.read_text()) if path.exists() else {}

    def all_scenes(name, value):
        key = f"{name} {value:g}" if name else "defaults"
        if key not in results:
            with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
                results[key] = list(pool.map(lambda scene: run(solve, scene, name, value), scenes))
            path.write_text(json.dumps(results))
        return results[key]

    before = all_scenes("", 0.0)
    print(f"| constant | file | value | lost, gained | solves | iterations |\n|---|---|---|---|---|---|\n"
          f"| defaults | | | {sum(code == 0 for code, _, _ in before)} of {len(before)} solved "
          f"| {sum(outer for _, outer, _ in before)} | {sum(pcg for _, _, pcg in before)} |", flush=True)
    for name, (file, kind, value) in constants.items():
        if not re.search(options.only, f"{file} {name}"):
            continue
        for other in variants(kind, value):
            now = all_scenes(name, float(other))
            both = [(a, b) for a, b in zip(before, now) if a[0] == b[0] == 0]
            lost, gained = (sum(a[0] == 0 != b[0] for a, b in pairs) for pairs in (zip(before, now), zip(now, before)))
            change = [100 * (sum(b[k] for _, b in both) / max(1, sum(a[k] for a, _ in both)) - 1) for k in (1, 2)]
            print(f"| `{name}` | {file} | {value:g} -> {other:g} | {lost}, {gained} | {change[0]:+.1f} % | {change[1]:+.1f} % |", flush=True)


if __name__ == "__main__":
    main()
