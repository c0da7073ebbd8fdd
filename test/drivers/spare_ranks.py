"""More ranks than subdomains: one subdomain per body, and one more rank than bodies. Exit code, energy and contact forces equal those on one rank.

spare_ranks.py --solve PROGRAM --work DIR --mpirun "mpirun ..." --input FOLDER [--all]

Default: scenes that take about a second. --all: every scene with an expected.json and at most ten bodies.
"""
import argparse
import glob
import json
import os
import pathlib
import xml.etree.ElementTree

import check_run
from harness import arguments, check, command, finish, setting

FEW = ("friction_block", "hertz_sphere", "patch_3d", "pin", "two_blocks")
MOST = 10    # bodies
SAME = 1e-6  # relative, of energy and forces

parser = argparse.ArgumentParser()
parser.add_argument("--all", action="store_true")
options = arguments("--solve", "--input", parser=parser)


def bodies(scene):
    for part in xml.etree.ElementTree.parse(scene).getroot():
        if part.get("name") == "Bodies":
            return len(part.findall("ParameterList"))
    return 0


def run(scene, ranks, words):
    """Exit code, output and summary."""
    folder = options.work / f"{scene.stem}_{ranks}"
    text, code = check_run.run([*command(options.solve, ranks, scene, *words), "--output", str(folder), *setting("Output/Fields", "false")], 200)
    path = folder / "summary.json"
    return code, text, json.loads(path.read_text()) if path.exists() else {}


def forces(summary):
    return [x for _, force in sorted(summary.get("contact", {}).get("force", {}).items()) for x in force]


for path in sorted(glob.glob(os.path.join(options.input, "*", "*.expected.json"))):
    case = json.loads(pathlib.Path(path).read_text())
    scene = (pathlib.Path(path).parent / case["scene"]).resolve()
    count = bodies(scene)
    if not (1 <= count <= MOST if options.all else pathlib.Path(path).name.split(".")[0] in FEW):
        continue
    words = [*case.get("arguments", []), *setting("Partition/Type", "METIS"), *setting("Partition/METIS/Subdomains", count)]
    one, many = run(scene, 1, words), run(scene, count + 1, words)
    name = f"{scene.stem}, {count} bodies on {count + 1} ranks"
    check(f"{name}: exit code", many[0], one[0])
    if many[0] != one[0]:
        print(many[1][-3000:])
        continue
    if not one[2]:
        continue
    check(f"{name}: a rank without a subdomain", many[2]["subdomains"] < many[2]["ranks"], True)
    check(f"{name}: energy", many[2]["energy"], lambda e: abs(e - one[2]["energy"]) <= SAME * abs(one[2]["energy"]))
    size = max(map(abs, forces(one[2])), default=0.0)
    check(f"{name}: contact forces", forces(many[2]), lambda f: all(abs(x - y) <= SAME * size for x, y in zip(f, forces(one[2]))))
finish()
