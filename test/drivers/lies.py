"""The verdict on a solver that falsely reports convergence for a perturbed trace (plugins/LyingSolver.cpp).

lies.py --solve PROGRAM --plugin LIBRARY --mpirun "mpirun ..." --work DIR --input FOLDER
"""
import json
import pathlib
import re
import subprocess

import harness
from harness import arguments, check, finish, setting

options = arguments("--solve", "--plugin", "--input")
work = options.work
TUNNEL = pathlib.Path(options.input) / "tunnel" / "tunnel_open.xml"
COARSE = setting("Mesh/Constants/scale", 3)
# All methods of the interface formulation; the plugin represents any solver that reports wrongly.
LYING = ["--plugin", options.plugin, *setting("Formulation", "Contact On The Interface"), *setting("Outer Solver/Type", "Lying")]


def run(ranks, folder, *words):
    return harness.run(options.solve, ranks, TUNNEL, *COARSE, "--output", work / folder, *words)


def summary(folder):
    path = work / folder / "summary.json"
    return json.loads(path.read_text()) if path.exists() else None


for ranks in (1, 2):
    what = f"{ranks} ranks: "
    folder = f"out_{ranks}"
    code, text = run(ranks, folder, *LYING, *setting("Outer Solver/Lying/Lie", 0))
    check(what + "without a lie: exit code", code, 0)
    first = summary(folder)
    check(what + "without a lie: verified", (first["converged"], first["verified"], first["exit_code"]), (True, True, 0))

    # Into the same folder: files read afterwards must be those of the second run.
    for lie, quiet in ((1e-3, []), (1e-4, ["--quiet"])):
        code, text = run(ranks, folder, *LYING, *setting("Outer Solver/Lying/Lie", lie), *quiet)
        case = what + f"a lie of {lie}: "
        check(case + "exit code", code, 4)
        found = summary(folder)
        check(case + "the summary is that of this run", found["exit_code"] if found else None, 4)
        if not found:
            continue
        check(case + "it is not verified", found["verified"], False)
        check(case + "it is not an earlier one", found["parameters"]["Outer Solver"]["Lying"]["Lie"], lie)
        broken = {name: finding for name, finding in found["verification"].items() if not finding["value"] <= finding["bound"]}
        check(case + "a finding exceeds its bound", len(broken), lambda n: n > 0)
        check(case + "every finding has its body and place", [finding["where"] for finding in broken.values()],
              lambda places: all(re.search(r"(left|right)", place) and re.search(r"\(-?[\d.e+-]+, -?[\d.e+-]+\)", place) for place in places))
        check(case + "the failure names the verdict and a place", found["failure"], lambda f: "verdict" in f and any(b["where"] in f for b in broken.values()))
        check(case + "the message names a finding with its place", text, lambda t: any(b["where"] in t for b in broken.values()))
        files = sorted(f.name for f in (work / folder).iterdir())
        check(case + "the fields are there to be looked at", files, lambda names: "fields_0000.vtkhdf" in names and "history.csv" in names)

finish()
