#!/usr/bin/python3
"""suture_study as a user runs it: a tiny study on several ranks against suture_solve, and invalid studies.

study.py figures|ends|bad|space --ranks N --study PROGRAM --solve PROGRAM --mpirun "mpirun ..." --work DIR --source FOLDER
"""
import argparse
import csv
import json
import math
import pathlib
import shutil
import sys

from harness import arguments, check, finish, run

parser = argparse.ArgumentParser()
parser.add_argument("part", choices=["figures", "ends", "bad", "space"])
parser.add_argument("--ranks", type=int, required=True)
options = arguments("--study", "--solve", "--source", "--fault", parser=parser)
work = options.work
source = pathlib.Path(options.source)
TINY = source / "test" / "drivers" / "study" / "tiny.xml"
SQUARE = source / "input" / "linear_square" / "linear_square.xml"


def table(folder):
    with open(folder / "table.csv") as file:
        return list(csv.DictReader(file))


def close(a, b, relative):
    return math.isclose(float(a), float(b), rel_tol=relative)


def edited(name, *edits):
    text = TINY.read_text().replace("../../../input", str(source / "input"))
    for old, new in edits:
        if old not in text:
            sys.exit(f"study.py: tiny.xml has no '{old}' to replace")
        text = text.replace(old, new)
    path = work / (name + ".xml")
    path.write_text(text)
    return path


def figures(ranks):
    """The figures of a study equal those of suture_solve, on any number of ranks."""
    expected = {}
    for size, n, blocks in (("small", 8, 2), ("large", 16, 4)):
        for space in ("None", "Kernels", "Rigid Modes"):
            folder = work / f"solve_{size}_{space.split()[0]}"
            code, text = run(options.solve, 1, SQUARE, "--output", folder, "--set", f"Mesh/Boxes/square/Cells={{{n}, {n}}}", "--set",
                             f"Mesh/Boxes/square/Blocks={{{blocks}, {blocks}}}", "--set", "Outer Solver/Tolerance=1e-10", "--set",
                             "Preconditioner/Type=Neumann-Neumann", "--set", f"Preconditioner/Neumann-Neumann/Coarse Space={space}")
            check(f"suture_solve {size} {space}", code, 0)
            expected[size, space] = n, blocks, json.loads((folder / "summary.json").read_text())
    folder = work / f"np{ranks}"
    code, text = run(options.study, ranks, TINY, "--output", folder)
    print(text)
    check(f"np{ranks}: exit code", code, 0)
    check(f"np{ranks}: a line for each run", text.count("  dofs "), 6)
    check(f"np{ranks}: all bands and orders kept", (text.count("kept  "), "MISSED" in text), (3 + 3, False))
    check(f"np{ranks}: an order for each line", text.count("dofs against h: order -1.918 over 2 runs"), 3)
    rows = table(folder)
    check(f"np{ranks}: combinations in order", [(row["size"], row["coarse space"]) for row in rows], list(expected))
    for row in rows:
        name = f"np{ranks} {row['size']} {row['coarse space']}: "
        n, blocks, summary = expected[row["size"], row["coarse space"]]
        check(name + "elements", int(row["elements"]), 2 * n * n)
        check(name + "dofs", int(row["dofs"]), 2 * n * (n + 1))
        check(name + "subdomains", int(row["subdomains"]), blocks**2)
        # Rigid-body modes of all subdomains, or of those not held by the clamped side.
        coarse = {"None": 0, "Kernels": 3 * blocks * (blocks - 1), "Rigid Modes": 3 * blocks**2}[row["coarse space"]]
        check(name + "coarse", int(row["coarse"]), coarse)
        check(name + "dofs per subdomain", float(row["per_subdomain"]), 2 * n * (n + 1) / blocks**2)
        check(name + "resultant of the traction", float(row["pull"]), lambda f: close(f, math.sqrt(2) * 1e-3, 1e-12))
        check(name + "pcg as suture_solve", int(row["pcg"]), lambda k: abs(k - summary["auxiliary"]["iterations"]) <= 1)
        check(name + "condition as suture_solve", row["condition"], lambda c: close(c, summary["auxiliary"]["condition"], 1e-3))
        check(name + "time", float(row["solve_seconds"]), lambda s: 0 < s < 60)
    check(f"np{ranks}: table.md has all rows", (folder / "table.md").read_text().count("| small |") + (folder / "table.md").read_text().count("| large |"), 6)
    check(f"np{ranks}: picture", (folder / "condition.png").stat().st_size if (folder / "condition.png").exists() else 0, lambda b: b > 10000)
    check(f"np{ranks}: each run's summary", len(list(folder.glob("runs/*/summary.json"))), 6)


FAIL = ["--set", "Outer Solver/Maximum Inner Iterations=10", "--only", "large"]


def ends(ranks):
    """Outcomes of a study, and effects of its options. Only studies with refused runs draw pictures, which take a second each."""
    text = TINY.read_text()
    plots = text[text.index('  <ParameterList name="Plots">'):text.rindex("</ParameterList>")]
    plain = edited("plain", (plots, ""))
    # --check, --only, --quiet.
    code, text = run(options.study, ranks, TINY, "--output", work / "checked", "--check")
    check("--check: exit code", code, 0)
    check("--check: lists the runs", text.count("Mesh/Boxes/square/Cells="), 6)
    check("--check: runs nothing", (work / "checked").exists(), False)
    code, text = run(options.study, ranks, plain, "--output", work / "only", "--only", "small", "--only", "coarse space=Kernels", "--quiet")
    check("--only: exit code", code, 0)
    check("--only: rows", [(row["size"], row["coarse space"]) for row in table(work / "only")], [("small", "Kernels")])
    check("--quiet: silent", text.strip(), "")

    # --continue reuses existing results that are valid and belong to the same runs.
    folder = work / "continued"
    code, text = run(options.study, ranks, plain, "--output", folder, "--only", "small")
    check("before --continue: exit code", code, 0)
    (folder / "runs" / "002" / "finished.json").write_text('{"key": ')
    code, text = run(options.study, ranks, plain, "--output", folder, "--continue")
    check("--continue: exit code", code, 0)
    check("--continue: runs what is missing or damaged", (text.count("done before"), len(table(folder))), (2, 6))
    code, text = run(options.study, ranks, plain, "--output", folder, "--continue")
    check("--continue, nothing left: runs nothing", text.count("done before"), 6)
    code, text = run(options.study, ranks, plain, "--output", folder, "--continue", "--only", "small", "--set", "Outer Solver/Maximum Iterations=49")
    check("--continue, another scene: runs all", text.count("done before"), 0)

    # Without its plot script the program draws nothing and does not fail.
    alone = work / "alone"
    alone.mkdir()
    shutil.copy(options.study, alone / "suture_study")
    code, text = run(alone / "suture_study", 1, TINY, "--output", alone / "out", "--only", "small")
    check("without the script: exit code", code, 0)
    check("without the script: reports it", "no plots: " in text, True)

    # Runs that do not converge have rows in the table.
    code, text = run(options.study, ranks, plain, "--output", work / "failed", *FAIL)
    check("failed runs: exit code", code, 4)
    rows = table(work / "failed")
    check("failed runs: all rows are there", len(rows), 3)
    check("failed runs: reason", all("10 iterations" in row["failure"] for row in rows), True)
    check("failed runs: miss their band", "MISSED   every run converges" in text, True)


    # So do runs that meet a bug or run out of memory: earlier results are kept and later runs continue.
    plotted = edited("plotted")
    for kind, expected, reason in (("other", 70, "injected fault"), ("memory", 4, "not enough memory")):
        code, text = run("env", ranks, "LD_PRELOAD=" + options.fault, f"SUTURE_TEST_FAULT=solve work 1 1 {kind}", options.study, plotted,
                         "--output", work / kind, "--only", "small")
        rows = table(work / kind)
        check(f"{kind}: exit code", code, expected)
        check(f"{kind}: the first run failed, the others have rows", [(reason in row["failure"], row["pcg"] != "") for row in rows],
              [(True, False), (False, True), (False, True)])
        check(f"{kind}: picture", (work / kind / "condition.png").exists(), True)
    code, text = run(options.study, ranks, plotted, "--output", work / "other", "--only", "small", "--continue")
    check("after the bug, --continue runs the one that failed", (code, text.count("done before"), len(table(work / "other"))), (0, 2, 3))

    bands = TINY.read_text()
    bands = bands[bands.index('  <ParameterList name="Bands">'):bands.index('  <ParameterList name="Plots">')].replace("../../../input", str(source / "input"))
    lenient = edited("lenient", (plots, ""), (bands, '  <Parameter name="Allow Failures" type="bool" value="true"/>\n'))
    code, text = run(options.study, ranks, lenient, "--output", work / "lenient", *FAIL)
    check("allowed failures: exit code", code, 0)
    check("allowed failures: rows", [bool(row["failure"]) for row in table(work / "lenient")], [True] * 3)

    # So does a combination refused once its mesh is known: 3 x 3 blocks do not divide 16 x 16 cells.
    refused = edited("refused", ("{{2, 2}, {4, 4}}", "{{2, 2}, {3, 3}}"))
    code, text = run(options.study, ranks, refused, "--output", work / "refused")
    rows = table(work / "refused")
    check("refused runs: exit code", code, 4)
    check("refused runs: reason", ["Blocks" in row["failure"] for row in rows], [False] * 3 + [True] * 3)
    check("refused runs: picture", (work / "refused" / "condition.png").exists(), True)
    check("refused runs: the others are solved", [row["pcg"] != "" for row in rows], [True] * 3 + [False] * 3)

    # A missed band.
    missed = edited("missed", (plots, ""), ('<Parameter name="At Most" type="double" value="3.5"/>', '<Parameter name="At Most" type="double" value="1.2"/>'))
    code, text = run(options.study, ranks, missed, "--output", work / "missed", "--quiet")
    check("missed band: exit code", code, 4)
    check("missed band: says which", "MISSED   rigid modes are flat: condition: 1.5" in text and "at most 1.2" in text, True)


# Invalid studies are refused before the first run, with all errors listed together.
CELLS = "Mesh/Boxes/square/Cells"
BAD = {
    "unknown_path": ([("Neumann-Neumann/Coarse Space", "Neumann-Neumann/Coarse Spice")], [
        "Sweeps/coarse space/name: Preconditioner/Neumann-Neumann/Coarse Spice: no such parameter. Did you mean 'Coarse Space'?"]),
    "unknown_list": ([("Preconditioner/Neumann-Neumann/Coarse Space", "Preconditoner/Neumann-Neumann/Coarse Space")], [
        "Sweeps/coarse space/name: Preconditoner: no such list. Did you mean 'Preconditioner'?"]),
    "unknown_in_set": ([("Outer Solver/Tolerance", "Outer Solver/Tolerence")], [
        "Set: Outer Solver/Tolerence: no such parameter. Did you mean 'Tolerance'?"]),
    "bad_value": ([("{None, Kernels, Rigid Modes}", "{None, Kernls, Rigid Modes}"), ("{coarse space=Rigid Modes}", "{coarse space=None}")], [
        "Sweeps/coarse space/name: Preconditioner/Neumann-Neumann/Coarse Space: no such name 'Kernls'. Did you mean 'Kernels'?"]),
    "tied_lengths": ([("{{2, 2}, {4, 4}}", "{{2, 2}, {4, 4}, {8, 8}}")], [
        "Sweeps/size/blocks/Values: has 3 values, but 'cells' of the same sweep has 2"]),
    "label_count": ([("{small, large}", "{small}")], ["Sweeps/size/Labels: has 1 labels for 2 values"]),
    "same_label": ([("{small, large}", "{small, small}")], ["Sweeps/size: the label 'small' occurs twice"]),
    "unknown_column": ([("interface_dofs, coarse,", "interface_dofs, outer.iteratoins,")], [
        "Columns: no such column 'outer.iteratoins'. Did you mean 'outer.iterations'?"]),
    "bad_formula": ([("1 * dofs / subdomains", "(1 * dofs / subdomains")], ["Columns: '(1 * dofs / subdomains': expected ')' at the end"]),
    "band_without_limit": ([('<Parameter name="At Most" type="double" value="1e-10"/>', "")], [
        "Bands/every run converges: has no bound"]),
    "band_on_no_column": ([('"Column" type="string" value="pull"', '"Column" type="string" value="pulll"')], [
        "Bands/the traction does not depend on the mesh/Column: no such column 'pulll'"]),
    "band_on_no_label": ([("{coarse space=Rigid Modes}", "{coarse space=Rigid Mode}")], [
        "Bands/rigid modes are flat/Where: no such label of coarse space 'Rigid Mode'. Did you mean 'Rigid Modes'?"]),
    "band_on_no_sweep": ([("{coarse space=Rigid Modes}", "{coarse spice=Rigid Modes}")], [
        "Where: no such sweep 'coarse spice'. Did you mean 'coarse space'?"]),
    "plot_of_no_column": ([("{condition, pcg}", "{conditon, pcg}")], ["Plots/condition/Y: no such column 'conditon'. Did you mean 'condition'?"]),
    "order_without_limit": ([('<Parameter name="At Least" type="double" value="-1.9176"/>', ""), ('<Parameter name="At Most" type="double" value="-1.9174"/>', "")], [
        "Orders/unknowns: has no bound"]),
    "order_of_no_column": ([('<Parameter name="Y" type="string" value="dofs"/>', '<Parameter name="Y" type="string" value="dosf"/>')], [
        "Orders/unknowns/Y: no such column 'dosf'. Did you mean 'dofs'?"]),
    "order_by_no_sweep": ([('name="By" type="Array(string)" value="{coarse space}"/>\n      <Parameter name="At', 'name="By" type="Array(string)" value="{coarse spice}"/>\n      <Parameter name="At')], [
        "Orders/unknowns/By: no such sweep 'coarse spice'. Did you mean 'coarse space'?"]),
    "swept_twice": ([("Mesh/Boxes/square/Blocks", CELLS)], [f"Sweeps/size/blocks: '{CELLS}' is changed in Sweeps/size/cells as well"]),
    "missing_scene": ([("linear_square.xml", "linear_sqare.xml")], ["linear_sqare.xml: cannot be read"]),
    "no_scene": ([('<Parameter name="Scene" type="string"', '<Parameter name="Title2" type="string"')], ["Title2", "Did you mean 'Title'?"]),
    "several": ([("{small, large}", "{small}"), ("interface_dofs, coarse,", "interface_dofs, coarze,"), ("{condition, pcg}", "{conditon, pcg}")], [
        "suture_study: 3 errors in ", "Sweeps/size/Labels", "Columns: no such column 'coarze'", "Plots/condition/Y"]),
}


def bad(ranks):
    for name, (edits, messages) in BAD.items():
        path = edited(name, *edits)
        for np in {1, ranks} if name == "several" else {1}:
            code, text = run(options.study, np, path, "--output", work / (name + "_out"))
            check(f"{name} np{np}: exit code", code, 3)
            for message in messages:
                check(f"{name} np{np}: says '{message}'", text, lambda t: t.count(message) == 1 or (t.count(message) > 0 and len(message) < 25))
            check(f"{name} np{np}: runs nothing", (work / (name + "_out")).exists(), False)

    code, text = run(options.study, ranks, TINY, "--set", CELLS + "={4, 4}", "--output", work / "set_out")
    check("--set of what is swept: exit code", code, 3)
    check("--set of what is swept: says which sweep", f"'{CELLS}' is varied by the sweep 'size'" in text, True)
    code, text = run(options.study, ranks, TINY, "--only", "smal", "--output", work / "set_out")
    check("--only of no label: exit code", code, 3)
    check("--only of no label: nearest", "Did you mean 'small'?" in text, True)
    code, text = run(options.study, ranks, TINY, "--onyl", "small")
    check("misspelt option: exit code", code, 2)
    check("misspelt option: nearest", "Did you mean '--only'?" in text, True)
    code, text = run(options.study, ranks, TINY, "--set", "Study/Repetitons=2")
    check("--set of the study: exit code", code, 3)
    check("--set of the study: nearest", "Did you mean 'Repetitions'?" in text, True)


def space(ranks):
    """A 3D study: element sizes, and the theoretical orders (energy p, displacement p + 1)."""
    folder = work / "space"
    code, text = run(options.study, ranks, source / "test" / "drivers" / "study" / "in_space.xml", "--output", folder)
    print(text)
    check("3D: exit code", code, 0)
    check("3D: all orders kept", (text.count("kept  "), "MISSED" in text), (4, False))
    rows = table(folder)
    check("3D: elements", [int(row["elements"]) for row in rows], [64, 512, 6 * 64, 6 * 512])
    for row, count in zip(rows, (64, 512, 384, 3072)):
        check(f"3D: size of one of {count} elements of a unit cube", row["h"], lambda h: close(h, count ** (-1 / 3), 1e-9))
    # Free nodes: below the top and between the four sides; the bottom slides.
    check("3D: unknowns", [int(row["dofs"]) for row in rows], [3 * (m - 1) ** 2 * m for m in (4, 8, 8, 16)])
    check("3D: picture", (folder / "errors.png").stat().st_size if (folder / "errors.png").exists() else 0, lambda b: b > 10000)


{"figures": figures, "ends": ends, "bad": bad, "space": space}[options.part](options.ranks)
finish()
