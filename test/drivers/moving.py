"""Bodies that slide and turn far (Motion = Moving): the same results for any number of steps and ranks, in turned axes, and against statics,
Hertz and another program; refused scenes.

moving.py --solve PROGRAM --mpirun "mpirun ..." --work DIR --input FOLDER
"""
import csv
import json
import math
import pathlib

from harness import arguments, check, finish, run, setting

options = arguments("--solve", "--input")
INPUT = pathlib.Path(options.input)


def solve(name, scene, *words, ranks=1):
    """Exit code, output, summary, rows of steps.csv and of frames.csv."""
    folder = options.work / name
    code, text = run(options.solve, ranks, scene, "--output", folder, *words, timeout=300)
    tables = []
    for table in ("steps.csv", "frames.csv"):
        path = folder / table
        tables.append(list(csv.DictReader(path.open())) if path.exists() else [])
    path = folder / "summary.json"
    return code, text, json.loads(path.read_text()) if path.exists() else {}, *tables


def force(row, contact="joint"):
    return [float(row[f"force {contact} {axis}"]) for axis in "xy"]


# A block presses on a base of another mesh and slides by half of its length, with friction. CalculiX with 20 increments: a normal force
# of 457.78, a tangential one of 137.40.
BLOCK = INPUT / "sliding_block" / "sliding_block.xml"
ends = []
for steps in (1, 4, 20):
    times = "{" + ", ".join(str(k + 1) for k in range(steps + 1)) + "}"
    factors = "{" + ", ".join(repr(k / steps) for k in range(steps + 1)) + "}"
    code, _, summary, rows, _ = solve(f"block_{steps}", BLOCK, *setting("Load Steps/Times", times), *setting("Load Steps/Factors/slide", factors))
    check("block: all steps", (code, summary["verified"], len(rows)), (0, True, steps + 1))
    ends.append(force(rows[-1]))
    # Within a step forces and displacements change in proportion.
    check("block: work", abs(float(rows[-1]["work_imbalance"])), lambda part: part < (0.3 if steps == 1 else 1e-2 / steps))
for tangential, normal in ends:
    check("block: independent of the number of steps", abs(normal / ends[0][1] - 1), lambda part: part < 1e-5)
    check("block: CalculiX", abs(-normal / 457.78 - 1), lambda part: part < 0.01)
    check("block: Coulomb", abs(-tangential / normal / 0.3 - 1), lambda part: part < 1e-3)
for name, ranks, words in (("ranks_2", 2, []), ("ranks_4", 4, []), ("monolithic", 1, setting("Outer Solver/Type", "Monolithic"))):
    code, _, _, rows, _ = solve(f"block_{name}", BLOCK, *words, ranks=ranks)
    check(f"block: {name}", (code, abs(force(rows[-1])[1] / ends[0][1] - 1) < 1e-6), (0, True))

# It slides off: no pairs are left, and no forces.
code, _, summary, rows, _ = solve("off", BLOCK, *setting("Boundary Conditions/slide/Value", "{12}"))
check("block: slides off", (code, summary["verified"], summary["max_displacement"] > 12, force(rows[-1])), (0, True, True, [0, 0]))
dissipated = [float(row["dissipated_work"]) for row in rows]
check("block: friction only dissipates", dissipated == sorted(dissipated), True)

# The same press, seen from turned axes: both bodies turn about the origin by any angle.
TURNED = pathlib.Path(__file__).parent / "turned_block.xml"
first = None
for angle in (0.0, 0.3, 1.0, 3.0, 100.0):
    words = setting("Boundary Conditions/ground/Rotation z", angle)
    for motion, value in (("Motion x", 0.002 * math.sin(angle)), ("Motion y", -0.002 * math.cos(angle)), ("Rotation z", angle)):
        words += setting(f"Boundary Conditions/press/{motion}", repr(value))
    code, _, _, rows, frames = solve(f"turned_{angle}", TURNED, *words, *setting("Outer Solver/Tolerance", "1e-10"))
    x, y = force(rows[-1])
    own = [x * math.cos(angle) + y * math.sin(angle), -x * math.sin(angle) + y * math.cos(angle)]
    first = first or own
    check(f"turned by {angle}: the path is solved", code, 0)
    check(f"turned by {angle}: forces turn along", max(abs(a - b) for a, b in zip(own, first)) / abs(first[1]), lambda part: part < 1e-9)
    check("frames", max(abs(float(row["rotation_z"]) - angle) for row in frames), lambda apart: apart < 1e-10)

# A roller on a plane: Hertz' pressure at all angles, and a path of 2 pi R a turn.
code, _, summary, rows, frames = solve("roller", INPUT / "roller" / "roller.xml", *setting("Output/Tables", "true"))
check("roller: all steps, the long ones halved", (code, summary["verified"], 17 < len(rows) < 40), (0, True, True))
stiffness = 2.1e5 / (1 - 0.3**2) / 2
half = math.sqrt(4 * 12000 * 10 / math.pi / stiffness)
check("roller: Hertz", summary["extremes"]["pressure"]["value"] / (2 * 12000 / math.pi / half), lambda ratio: 0.98 < ratio < 1.025)
last = [row for row in frames if row["body"] == "roller"][-1]
check("roller: path", abs(float(last["displacement_x"]) / 16.0 - 1), lambda part: part < 1e-3)
check("roller: angle", abs(float(last["rotation_z"]) + 1.6), lambda apart: apart < 1e-9)
for row in rows:
    check("roller: forces", max(abs(force(row)[0]), abs(force(row)[1] + 12000)), lambda apart: apart < 1e-3)

# A pin in the bore of a lug that turns about it: the contact stays at the friction angle.
code, _, summary, rows, _ = solve("hinge", INPUT / "hinge" / "hinge.xml")
check("hinge: all steps", (code, summary["verified"]), (0, True))
joint = next(row for row in csv.DictReader((options.work / "hinge" / "reactions.csv").open()) if row["name"] == "joint")
check("hinge: the friction angle", abs(math.atan2(-float(joint["centre_x"]), float(joint["centre_y"])) / math.atan(0.2) - 1), lambda part: part < 5e-3)
check("hinge: torque with the arc of contact", abs(-float(joint["mz"]) / 1e4 / 0.19844 - 1), lambda part: part < 1e-3)
check("hinge: pressure", abs(summary["extremes"]["pressure"]["value"] / 202.5 - 1), lambda part: part < 0.01)

# What bodies that move far cannot have, all at once.
for name, words, expected in (
        ("steps", setting("Load Steps/Times", "{}"), "Load Steps/Times"),
        ("accuracy", setting("Accuracy/Error", 0.01), "Accuracy/Error"),
        ("motion", setting("Motion", "Movin"), "Did you mean 'Moving'?"),
        ("formulation", [*setting("Formulation", "Condensed Groups"), *setting("Outer Solver/Type", "Semismooth Newton")], "Formulation")):
    code, text, *_ = solve("bad_" + name, BLOCK, *words)
    check(f"refused: {name}", (code, expected in text), (3, True))
finish()
