"""Accuracy of other quantities than the energy (Accuracy/Quantity): forces, mean displacements and pressures against finer meshes and exact
values, on any number of ranks; infinite and vanishing quantities; bad input.

quantities.py --solve PROGRAM --mpirun "mpirun ..." --work DIR --input FOLDER
"""
import json
import math
import pathlib

from harness import arguments, check, finish, run, setting

options = arguments("--solve", "--input")
INPUT = pathlib.Path(options.input)
PUNCH = INPUT / "studies" / "punch.xml"
HERTZ = INPUT / "hertz" / "hertz.xml"


def solve(name, scene, *words, ranks=1):
    """Exit code, output and summary."""
    code, text = run(options.solve, ranks, scene, "--output", options.work / name, *words, timeout=300)
    path = options.work / name / "summary.json"
    return code, text, json.loads(path.read_text()) if path.exists() else {}


def wanted(error, quantity, **objects):
    words = [*setting("Accuracy/Error", error), *setting("Accuracy/Quantity", quantity)]
    for name, value in objects.items():
        words += setting(f"Accuracy/{quantity}/{name}", value)
    return words


# Forces and displacement of a flat punch against a mesh with a hundredth of the error; the mean of the surface of the block.
MEAN = {"Group": "under_top", "Direction": "{0, 2}"}
_, _, fine = solve("reference", PUNCH, *wanted(2e-5, "Mean Displacement", **MEAN), *setting("Accuracy/Most Levels", 30))
force = math.hypot(*fine["reactions"]["contacts"]["joint"]["force"])
mean = fine["accuracy"]["levels"][-1]["value"]
for name, words, exact, said in (("contact", wanted(0.002, "Contact Force", Contact="joint"), force, "the force of contact 'joint'"),
                                 ("reaction", wanted(0.002, "Reaction", Condition="ground"), force, "the reaction of 'ground'"),
                                 ("mean", wanted(0.002, "Mean Displacement", **MEAN), mean, "the mean displacement of 'under_top'")):
    first = None
    exactly = setting("Outer Solver/Tolerance", "1e-8") if name == "contact" else []  # meshes of other ranks differ with Automatic
    for ranks in (1, 2, 4) if name == "contact" else (1,):
        code, text, summary = solve(f"{name}_{ranks}", PUNCH, *words, *exactly, ranks=ranks)
        accuracy = summary["accuracy"]
        check(f"{name}: reached", (code, accuracy["limit"], accuracy["reached"] <= 0.002), (0, "", True))
        check(f"{name}: an estimate", (accuracy["strict"], accuracy["quantity"], said in text), (False, said, True))
        first = first or accuracy
        check(f"{name}: the same meshes", [level["unknowns"] for level in accuracy["levels"]], [level["unknowns"] for level in first["levels"]])
    for level in first["levels"]:
        check(f"{name}: the error is as small as estimated", abs(level["value"] / exact - 1) / level["error"], lambda part: part < 1)
    check(f"{name}: the energy error is larger", first["levels"][-1]["energy_error"], lambda error: 0.01 < error < 0.05)

# The pressure of Hertz (Johnson): the scene's expected value, exact for half-planes within 1 %.
code, text, summary = solve("hertz", HERTZ, *wanted(0.03, "Largest Pressure"))
check("hertz: reached", (code, summary["accuracy"]["limit"], len(summary["accuracy"]["levels"]) > 1), (0, "", True))
pressures = [level["value"] for level in summary["accuracy"]["levels"]]
check("hertz: the largest pressure", pressures[-1], summary["extremes"]["pressure"]["value"])
check("hertz: as Johnson", abs(pressures[-1] / 6.6124 - 1), lambda error: error < 0.04)

# Infinite at the ends of the punch; zero without a load along x.
code, text, summary = solve("infinite", PUNCH, *wanted(0.05, "Largest Pressure", Contact="joint"))
check("infinite", (code, summary["accuracy"]["limit"], len(summary["accuracy"]["levels"]), summary["verified"]), (4, "quantity", 1, True))
check("infinite: the reason", "infinite" in summary["failure"] and "partner that continues" in summary["failure"], True)
code, text, summary = solve("open", PUNCH, *wanted(0.05, "Contact Force"), *setting("Boundary Conditions/push/Value", "{0, 1e-6}"))
check("no force", (code, summary["accuracy"]["limit"], "zero" in summary["failure"]), (4, "quantity", True))

# Straight sides in place of the tunnel's curve are part of the error, against a fine mesh with curved sides.
TUNNEL = INPUT / "tunnel" / "tunnel.xml"
_, _, fine = solve("curved", TUNNEL, *setting("Accuracy/Error", 0.0005), *setting("Accuracy/Sides", "Curved"))
force = math.hypot(*fine["reactions"]["contacts"]["fault above"]["force"])
code, _, summary = solve("straight", TUNNEL, *wanted(1e-4, "Contact Force", Contact="fault above"))
check("straight sides: reached", code, 0)
for level in summary["accuracy"]["levels"]:
    check("straight sides: their share", level["geometry"] ** 2, lambda share: 0 < share <= level["error"])
    check("straight sides: the error holds", abs(level["value"] / force - 1), lambda true: true <= level["error"])

# Bad input.
for name, words, expected in (
        ("quantity", wanted(0.01, "Force"), "Accuracy/Quantity"),
        ("contact", wanted(0.01, "Contact Force", Contact="joynt"), "Did you mean 'joint'?"),
        ("condition", wanted(0.01, "Reaction", Condition="grund"), "Did you mean 'ground'?"),
        ("no condition", wanted(0.01, "Reaction"), "Accuracy/Reaction/Condition"),
        ("group", wanted(0.01, "Mean Displacement", Group="undertop", Direction="{0, 1}"), "Did you mean 'under_top'?"),
        ("direction", wanted(0.01, "Mean Displacement", Group="under_top", Direction="{0, 0, 1}"), "expected 2"),
        ("no direction", wanted(0.01, "Mean Displacement", Group="under_top", Direction="{0, 0}"), "is zero")):
    code, text, _ = solve("bad_" + name.replace(" ", "_"), PUNCH, *words)
    check(f"bad input: {name}", (code, expected in text), (3, True))
finish()
