"""Bodies that slide and turn far (Motion = Moving): the same results for any number of steps and ranks, in turned axes, and against statics,
Hertz and another program; bodies that rest; axes of stresses; refused scenes.

moving.py --solve PROGRAM --partition PROGRAM --mpirun "mpirun ..." --work DIR --input FOLDER
"""
import csv
import math
import pathlib

import h5py
import numpy as np

from harness import arguments, check, finish, run, setting
from moving_runs import force, solve, table
from moving_runs import motion as motion_of

options = arguments("--solve", "--partition", "--input")
INPUT = pathlib.Path(options.input)
HERE = pathlib.Path(__file__).parent


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

# Displacements since a time are those from the places of the bodies then.
code, _, summary, *_ = solve("block_since", BLOCK, *setting("Output/Displacements Since", 2))
check("block: displacement since t = 2", (code, summary["extremes"]["displacement_since"]["value"]), lambda found: found[0] == 0 and abs(found[1] / 1.5 - 1) < 1e-3)

# Lifted first, it lands on the base while it moves sideways in the same step: it slides. Landing straight down, it sticks.
for name, slide in (("sideways", "{0, 0, 1}"), ("down", "{0, 0, 0}")):
    code, _, summary, rows, _ = solve(f"lands_{name}", BLOCK, *setting("Load Steps/Times", "{1, 2, 3}"), *setting("Load Steps/Factors/slide", slide),
                                      *setting("Load Steps/Factors/press", "{1, -5, 1}"))
    check(f"lands {name}: solved", (code, summary["verified"], len(rows), rows[1]["active"]), (0, True, 3, "0"))
    tangential, normal = force(rows[-1])
    if name == "sideways":
        check("lands sideways: as if it had slid there", abs(normal / ends[0][1] - 1), lambda part: part < 1e-4)
        check("lands sideways: Coulomb", abs(-tangential / normal / 0.3 - 1), lambda part: part < 1e-3)
    else:
        check("lands down: sticks, as pressed at first", (rows[-1]["sticking"], max(abs(a / b - 1) for a, b in zip(force(rows[-1]), force(rows[0])))),
              lambda found: found[0] == rows[0]["sticking"] and found[1] < 1e-3)

# It slides off: no pairs are left, and no forces.
code, _, summary, rows, _ = solve("off", BLOCK, *setting("Boundary Conditions/slide/Value", "{12}"))
check("block: slides off", (code, summary["verified"], summary["max_displacement"] > 12, force(rows[-1])), (0, True, True, [0, 0]))
dissipated = [float(row["dissipated_work"]) for row in rows]
check("block: friction only dissipates", dissipated == sorted(dissipated), True)

# The same press, seen from turned axes: both bodies turn about the origin by any angle.
TURNED = HERE / "turned_block.xml"
first = None
for angle in (0.0, 0.3, 1.0, 3.0, 100.0):
    words = setting("Boundary Conditions/ground/Rotation z", angle)
    for motion, value in (("Motion x", 0.002 * math.sin(angle)), ("Motion y", -0.002 * math.cos(angle)), ("Rotation z", angle)):
        words += setting(f"Boundary Conditions/press/{motion}", repr(value))
    code, _, _, rows, frames = solve(f"turned_{angle}", TURNED, *words, *setting("Outer Solver/Tolerance", "1e-10"))
    x, y = force(rows[-1])
    own = [x * math.cos(angle) + y * math.sin(angle), -x * math.sin(angle) + y * math.cos(angle)]
    if first and angle == 0.3:  # a turn of the whole scene does no work
        check("plate: work of the turned plate", float(rows[-1]["external_work"]) / still - 1, lambda part: abs(part) < 0.02)
    if not first:
        still = float(rows[-1]["external_work"])
    first = first or own
    check(f"turned by {angle}: the path is solved", code, 0)
    check(f"turned by {angle}: forces turn along", max(abs(a - b) for a, b in zip(own, first)) / abs(first[1]), lambda part: part < 1e-12)
    check("frames", max(abs(float(row["rotation_z"]) - angle) for row in frames), lambda apart: apart < 1e-10)

# Stresses in the axes of the body do not see that it turns.
stresses, principal = {}, {}
for angle, axes in ((0.0, "Global"), (2.0, "Body"), (2.0, "Global")):
    words = [*setting("Boundary Conditions/ground/Rotation z", angle), *setting("Output/Stress Axes", axes), *setting("Output/Nodal Stresses", "true")]
    for motion, value in (("Motion x", 0.002 * math.sin(angle)), ("Motion y", -0.002 * math.cos(angle)), ("Rotation z", angle)):
        words += setting(f"Boundary Conditions/press/{motion}", repr(value))
    code, *_ = solve(f"axes_{angle}_{axes}", TURNED, *words, *setting("Outer Solver/Tolerance", "1e-10"))
    check(f"stresses of a turned body in the axes {axes}: solved", code, 0)
    with h5py.File(options.work / f"axes_{angle}_{axes}" / "fields_0000.vtkhdf") as file:
        cells, points = file["VTKHDF/CellData"], file["VTKHDF/PointData"]
        stresses[angle, axes] = (cells["Stress"][:], points["NodalStress"][:])
        principal[angle, axes] = (cells["PrincipalDirection1"][:], points["NodalPrincipalStress"][:])
for k, name in enumerate(("stress", "nodal stress")):
    drawn = stresses[0.0, "Global"][k]
    check(f"{name} in the axes of the body", abs(stresses[2.0, "Body"][k] - drawn).max() / abs(drawn).max(), lambda part: part < 1e-8)
    check(f"{name}: principal directions and stresses are global", np.abs(principal[2.0, "Body"][k] - principal[2.0, "Global"][k]).max(), 0.0)
    check(f"{name} in global axes", abs(stresses[2.0, "Global"][k] - drawn).max() / abs(drawn).max(), lambda part: part > 0.5)

# A block slides without friction on a bed that stays where it is, on springs, of an orthotropic material: it sinks and tilts as by statics.
BED = HERE / "moving_bed.xml"
for name, ranks in (("bed", 1), ("bed_3", 3)):
    code, _, summary, rows, frames = solve(name, BED, ranks=ranks)
    check("bed: solved", (code, summary["verified"], len(rows)), (0, True, 3))
    sinks, tilts = 10 / (100 * 10), 5 * 10 * 2 / (100 * 10**3 / 12)
    for probe, expected in (("left", tilts - sinks), ("right", -tilts - sinks)):
        found = float(table(options.work / name, f"probe_{probe}.csv")[0]["uy"])
        check(f"bed: displacement {probe}", abs(found - expected) / sinks, lambda part: part < 5e-3)
    check("bed: its frame stays", {float(row[column]) for row in frames if row["body"] == "bed" for column in ("displacement_x", "displacement_y", "rotation_z")}, {0.0})
for name, words, expected in (("springs", setting("Bodies/bed/Motion", "Scene"), ["Boundary Conditions/springs", "Materials/stiff/Type", "Motion = Small"]),
                              ("other_springs", [*setting("Bodies/bed/Motion", "Small"), *setting("Boundary Conditions/springs/Group", "block_left")],
                               ["Boundary Conditions/springs", "'block'"]),
                              ("all_small", setting("Bodies/block/Motion", "Small"), ["Motion: is Moving, but Motion of each body is Small"])):
    code, text, *_ = solve("bed_" + name, BED, *words)
    check(f"bed, refused: {name}", (code, [part in text for part in expected]), (3, [True] * len(expected)))

# A bush pressed into a plate (plane stress; drawn with an interference of 0.002) between rigid rings, turned with the plate and pushed aside. Pressure
# by Lame: u = A (r - s^2 / r) is zero at the radius s of the rigid ring.
PLATE = HERE / "turned_plate.xml"


def lame(young, poisson, interference, inside, fit, outside):
    def flexibility(s):  # displacement at the fit over the radial stress there
        return (1 - poisson**2) / young * (fit - s * s / fit) / (1 + poisson + (1 - poisson) * (s / fit) ** 2)
    return interference / (flexibility(inside) - flexibility(outside))


first = None
for aside, angle in ((0.0, 0.0), (0.0, 2.0), (5e-4, 0.0), (5e-4, 0.3), (5e-4, 3.0), (5e-4, -100.0)):
    words = setting("Boundary Conditions/frame/Rotation z", angle)
    for motion, value in (("Motion x", -aside * math.sin(angle)), ("Motion y", aside * math.cos(angle)), ("Rotation z", angle)):
        words += setting(f"Boundary Conditions/shaft/{motion}", repr(value))
    name = f"plate_{aside}_{angle}"
    code, _, summary, rows, frames = solve(name, PLATE, *words, *setting("Outer Solver/Tolerance", "1e-10"))
    check(f"plate turned by {angle}: solved", (code, summary["verified"], {row["body"] for row in frames}), (0, True, {"bush", "plate"}))
    pairs = table(options.work / name, "contact.csv")
    pressure = sum(float(pair["force"]) for pair in pairs) / sum(float(pair["length"]) for pair in pairs)
    x, y = force(rows[-1])
    if aside == 0:
        check(f"plate turned by {angle}: Lame", pressure / lame(2.1e5, 0.3, 0.002, 1, 2, 4) - 1, lambda part: abs(part) < 3e-3)
        check("plate: no force", math.hypot(x, y), lambda size: size < 1e-6 * 12.6 * pressure)
        continue
    own = [x * math.cos(angle) + y * math.sin(angle), -x * math.sin(angle) + y * math.cos(angle), pressure]
    first = first or own
    check("plate: pushed aside", first[1] > 100 and abs(first[0]) < 1e-6 * first[1], True)
    check(f"plate turned by {angle}: forces and pressure turn along", max(abs(a - b) for a, b in zip(own, first)) / first[1], lambda part: part < 1e-9)

# A roller on a plane: Hertz' pressure at all angles, and a path of 2 pi R a turn, with any steps: those of the scene move it by .43 of the
# width of its contact. The path is short by 1 / 6 of the square of half that width over R, at most.
for steps, accuracy in ((8, 2e-3), (4, 2e-3), (16, 1e-3)):
    times = "{" + ", ".join(str(k + 1) for k in range(steps + 1)) + "}"
    code, _, summary, rows, frames = solve(f"roller_{steps}", INPUT / "roller" / "roller.xml", *setting("Output/Tables", "true"),
                                           *setting("Load Steps/Times", times), *setting("Load Steps/Factors/axle", f"max(t - 1, 0) * {1.6 / steps}"))
    check(f"roller in {steps} steps: all steps", (code, summary["verified"], len(rows) < 18), (0, True, True))
    way = motion_of(frames, "roller", "displacement_x") - motion_of(frames, "roller", "displacement_x", 1)
    check(f"roller in {steps} steps: path", abs(way / 16.0 - 1), lambda part: part < accuracy)
    check(f"roller in {steps} steps: angle", abs(motion_of(frames, "roller", "rotation_z") + 1.6), lambda apart: apart < 1e-9)
    for row in rows:
        check("roller: forces", max(abs(force(row)[0]), abs(force(row)[1] + 12000)), lambda apart: apart < 1e-3)
stiffness = 2.1e5 / (1 - 0.3**2) / 2
half = math.sqrt(4 * 12000 * 10 / math.pi / stiffness)
check("roller: Hertz", summary["extremes"]["pressure"]["value"] / (2 * 12000 / math.pi / half), lambda ratio: 0.98 < ratio < 1.025)

code, _, summary, _, _ = solve("roller_plane_stress", INPUT / "roller" / "roller.xml", *setting("Model", "Plane Stress"), *setting("Load Steps/Times", "{1, 2}"))
half = math.sqrt(4 * 12000 * 10 / math.pi / (2.1e5 / 2))
check("roller in plane stress: Hertz", (code, summary["extremes"]["pressure"]["value"] / (2 * 12000 / math.pi / half)), lambda found: found[0] == 0 and 0.98 < found[1] < 1.025)

# A pin in the bore of a lug that turns about it: the contact stays at the friction angle.
code, _, summary, rows, _ = solve("hinge", INPUT / "hinge" / "hinge.xml")
check("hinge: all steps", (code, summary["verified"]), (0, True))
joint = next(row for row in csv.DictReader((options.work / "hinge" / "reactions.csv").open()) if row["name"] == "joint")
check("hinge: the friction angle", abs(math.atan2(-float(joint["centre_x"]), float(joint["centre_y"])) / math.atan(0.2) - 1), lambda part: part < 5e-3)
check("hinge: torque with the arc of contact", abs(-float(joint["mz"]) / 1e4 / 0.19844 - 1), lambda part: part < 1e-3)
check("hinge: pressure", abs(summary["extremes"]["pressure"]["value"] / 202.5 - 1), lambda part: part < 0.01)

# A drawer that is pulled by more than L / (2 mu) off its middle jams: friction holds it against any force, and driven on it fails the verdict.
DRAWER = INPUT / "validation" / "v23_moving" / "drawer.xml"
OFF = setting("Boundary Conditions/pull/Point", "{100, 170}") + setting("Load Steps/Times", "{1, 2}")
code, text, summary, rows, _ = solve("driven_drawer", DRAWER, *OFF, *setting("Load Steps/Factors/pull", "(t - 1)"))
check("jammed drawer, driven", (code, summary["converged"], "a body that friction locks cannot be driven on" in text, "set Motion = Moving" in text),
      (4, False, True, False))
text = DRAWER.read_text().replace('<Parameter name="Motion x" type="double" value="30"/>', '<Parameter name="Force" type="Array(double)" value="{500, 0}"/>')
pulled = options.work / "pulled.xml"
pulled.write_text(text.replace("drawer.geo", str(DRAWER.with_suffix(".geo").resolve())))
code, _, summary, _, frames = solve("pulled_drawer", pulled, *OFF, *setting("Load Steps/Factors/pull", "t - 0.9"))
check("jammed drawer, pulled: held", (code, summary["verified"]), (0, True))
check("jammed drawer, pulled: stays", [abs(float(row["displacement_x"])) for row in frames if row["body"] == "drawer"][-1], lambda way: way < 0.5)

# Settings that bodies that move far cannot have. All are reported together.
for name, words, expected in (
        ("steps", setting("Load Steps/Times", "{}"), "Load Steps/Times"),
        ("accuracy", setting("Accuracy/Error", 0.01), "Accuracy/Error"),
        ("motion", setting("Motion", "Movin"), "Did you mean 'Moving'?"),
        ("removed", setting("Load Steps/Removed/block", 2), "Load Steps: is not supported"),
        ("formulation", [*setting("Formulation", "Condensed Groups"), *setting("Outer Solver/Type", "Semismooth Newton")], "Formulation")):
    code, text, *_ = solve("bad_" + name, BLOCK, *words)
    check(f"refused: {name}", (code, expected in text), (3, True))
ALL = {"Load Steps/Times", "Model", "Boundary Conditions", "Contact", "Formulation", "Outer Solver/Start", "Output/Error Bound",
       "Boundary Conditions/springs", "Boundary Conditions/in situ", "Materials/wood/Type"}
for name, ranks, words, expected in (
        ("all", 1, [], ALL), ("ranks_2", 2, [], ALL),
        ("all_with_accuracy", 1, [*setting("Outer Solver/Start", "Bilateral"), *setting("Accuracy/Error", 0.1)], ALL - {"Outer Solver/Start"} | {"Accuracy/Error"}),
        ("small", 1, setting("Motion", "Small"), set())):
    code, text, *_ = solve("bad_" + name, HERE / "moving_refused.xml", *words, ranks=ranks)
    found = {line.split(":")[0].strip() for line in text.splitlines() if "Motion = Moving" in line and line.startswith("  ")}
    check(f"refused together: {name}", found, expected)
    check(f"refused together: {name}, exit code", (code, f"{len(expected)} errors" in text), lambda end: end == (3, True) or not expected)
    check("refused: nothing is written", (options.work / f"bad_{name}" / "steps.csv").exists(), False)
mesh = options.work / "block.h5"
check("partitioned", run(options.partition, 1, BLOCK, "--output", mesh)[0], 0)
partitioned = options.work / "partitioned.xml"
partitioned.write_text(BLOCK.read_text().replace('"Generator" type="string" value="Boxes"', f'"File" type="string" value="{mesh}"'))
code, text, *_ = solve("bad_partition", partitioned, *setting("Partition/Type", "Partitioned Mesh"))
check("refused: a partitioned mesh", (code, "Partition/Type: is not supported with Motion = Moving" in text), (3, True))
finish()
