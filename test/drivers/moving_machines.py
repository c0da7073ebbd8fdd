"""Bodies that slide and turn far (Motion = Moving) as parts of machines: cam, rocking block, screw, ball in a groove, against geometry and
statics.

moving_machines.py --solve PROGRAM --mpirun "mpirun ..." --work DIR --input FOLDER
"""
import math
import pathlib

from harness import arguments, check, finish, setting
from moving_runs import force, motion, reactions, solve, table

options = arguments("--solve", "--input")
INPUT = pathlib.Path(options.input)


def scene(name):
    return INPUT / name / f"{name}.xml"


def near(value, tolerance):
    return lambda found: abs(found - value) <= tolerance


# A disc of radius 10 turns about a point 4 from its centre and lifts a flat face that carries 2000: lift e (1 - cos angle) at all angles, and
# the torque of the force at the distance e sin angle, with that of friction at the height R - e cos angle.
ECCENTRIC, RADIUS, LOAD = 4.0, 10.0, 2000.0
for name, friction, turn, steps in (("smooth", 0.0, 0.5, 2), ("smooth_far", 0.0, 2.4, 4), ("rough", 0.1, 1.0, 4), ("rough_back", 0.1, -0.4, 2)):
    times = "{" + ", ".join(repr(1 + 8 * k / steps) for k in range(steps + 1)) + "}"
    words = setting("Boundary Conditions/drive/Rotation z", turn) + setting("Contact/joint/Coulomb/Coefficient", friction)
    words += setting("Load Steps/Times", times)
    code, _, summary, rows, frames = solve(f"cam_{name}", scene("cam"), *words)
    check(f"cam, {name}: all steps", (code, summary["verified"], len(rows)), (0, True, steps + 1))
    start = motion(frames, "follower", "displacement_y", 1)
    check("cam: approach of the bodies", start, lambda y: -0.045 < y < -0.038)
    for row in rows[1:]:
        angle = motion(frames, "disc", "rotation_z", float(row["time"]))
        lift = motion(frames, "follower", "displacement_y", float(row["time"])) - start
        check(f"cam, {name}: lift at {angle:.3f}", lift, near(ECCENTRIC * (1 - math.cos(angle)), 1e-3))
        check("cam: weight", force(row)[1], near(LOAD, 1e-5 * LOAD))
        check("cam: friction", force(row)[0], near(-friction * math.copysign(LOAD, turn), 1.5e-3 * LOAD))
    parts = reactions(f"cam_{name}")
    lever = ECCENTRIC * math.sin(turn) + math.copysign(friction, turn) * (RADIUS - ECCENTRIC * math.cos(turn))
    torque = float(parts["drive"]["mz"])
    check(f"cam, {name}: torque", torque / LOAD - lever, near(0, 3e-3 * ECCENTRIC))
    check("cam: the guide carries force and moment", [float(parts["guide"]["fx"]) + force(rows[-1])[0], float(parts["guide"]["mz"]) + torque],
          lambda sums: abs(sums[0]) < 1e-6 * LOAD and abs(sums[1]) < 1e-4 * abs(torque))

# A block of 2 x 6 on one corner: the force at the height of its centre over its weight is tan(alpha - angle), tan alpha = 1 / 3, on both sides
# of the point at which it would fall over.
for ranks in (1, 2):
    code, _, summary, rows, frames = solve(f"rocking_{ranks}", scene("rocking_block"), ranks=ranks)
    check("rocking: all steps", (code, summary["verified"], len(rows)), (0, True, 10))
    for row in rows[1:]:
        angle = -motion(frames, "block", "rotation_z", float(row["time"]))
        along, down = force(row)
        check(f"rocking: weight at {angle:.3f}", down / -294.3 - 1, near(0, 1e-6))
        check("rocking: statics", -along / down, near(math.tan(math.atan(1 / 3) - angle), 1e-4))
        moved = motion(frames, "block", "displacement_x", float(row["time"]))
        check("rocking: the corner stays", math.sqrt(10) * math.sin(math.atan(1 / 3) - angle), near(1 - moved, 1e-3))

# Put down again and tilted to the other side: the same force in the other direction, and no turn between.
code, _, summary, rows, frames = solve("rocking_back", scene("rocking_block"), *setting("Load Steps/Times", "{1, 2, 3, 4}"),
                                       *setting("Load Steps/Factors/push", "{0, 0.2, 0, -0.2}"))
at = {float(row["time"]): row for row in rows}
check("rocking back: all steps", (code, summary["verified"]), (0, True))
for time, side in ((2, 1), (4, -1)):
    angle = -motion(frames, "block", "rotation_z", time)
    check("rocking back: angle", angle, lambda found: 0.08 < side * found < 0.09)
    check("rocking back: statics", force(at[time])[0] / 294.3, near(side * math.tan(math.atan(1 / 3) - side * angle), 1e-4))
check("rocking back: stands", (motion(frames, "block", "rotation_z", 3), at[3]["active"]), lambda found: abs(found[0]) < 1e-4 and found[1] == "17")

# Too little friction for that: the block slides, with the angle of rest.
code, _, summary, rows, frames = solve("pushed", scene("rocking_block"), *setting("Contact/joint/Coulomb/Coefficient", 0.2))
check("pushed: all steps", (code, summary["verified"]), (0, True))
check("pushed: Coulomb", force(rows[-1])[0] / -force(rows[-1])[1], near(0.2, 1e-5))
check("pushed: stays upright", motion(frames, "block", "rotation_z"), near(0, 1e-4))

# Tilted while it is drawn over the base: its edge slides along the base, so that Coulomb's law holds about the normal of the base.
for name, contact in (("block", []), ("base", [*setting("Contact/joint/Side A", "base_top"), *setting("Contact/joint/Side B", "block_bottom")])):
    code, _, summary, rows, frames = solve(f"tilted_{name}", scene("rocking_block"), *setting("Contact/joint/Coulomb/Coefficient", 0.3),
                                           *setting("Boundary Conditions/push/Rotation z", -0.2), *setting("Load Steps/Times", "{1, 5, 9}"), *contact)
    check(f"tilted block: all steps, side A {name}", (code, summary["verified"], abs(motion(frames, "block", "rotation_z") + 0.2) < 1e-4), (0, True, True))
    check(f"tilted block: Coulomb, side A {name}", abs(force(rows[-1])[0] / force(rows[-1])[1]), near(0.3, 1e-3))

# Cut into more parts, which exchange nodes of the rigid group on the way: the same work.
whole = float(solve("rocking_whole", scene("rocking_block"))[3][-1]["external_work"])
for ranks in (1, 3):
    code, _, summary, rows, _ = solve(f"rocking_parts_{ranks}", scene("rocking_block"), *setting("Partition/Type", "METIS"),
                                      *setting("Partition/METIS/Subdomains", 15), ranks=ranks)
    check("rocking in parts: all steps", (code, summary["verified"], len(rows)), (0, True, 10))
    check("rocking in parts: work", float(rows[-1]["external_work"]) / whole - 1, near(0, 1e-4))

# A helicoid of pitch 6: the nut sinks by pitch * angle / (2 pi), and turns the screw by that lever of its load.
LEVER = 6 / (2 * math.pi)
code, _, summary, rows, frames = solve("screw", scene("screw"))
check("screw: all steps", (code, summary["verified"], len(rows)), (0, True, 5))
start = motion(frames, "nut", "displacement_z", 1)
for row in rows[1:]:
    angle = motion(frames, "screw", "rotation_z", float(row["time"]))
    sunk = start - motion(frames, "nut", "displacement_z", float(row["time"]))
    check(f"screw: path at {angle:.3f}", sunk / (LEVER * angle) - 1, near(0, 1e-3))
    check("screw: load", force(row, "thread", "z")[0], near(-2000, 1e-3))
# The work of the load, 2 pi / 4 times the lever of 2000, is that of the drive.
check("screw: work", abs(float(rows[-1]["work_imbalance"])), near(0, 5e-3))
check("screw: forces and moments balance", [float(reactions("screw")["sum"][name]) for name in ("fx", "fy", "fz", "mx", "my", "mz")],
      lambda sums: max(map(abs, sums)) < 1e-3)
check("screw: torque", float(reactions("screw")["drive"]["mz"]) / (-2000 * LEVER) - 1, near(0, 4e-3))

code, _, _, rows, frames = solve("screw_at_once", scene("screw"), *setting("Load Steps/Times", "{1, 5}"))
at_once = start - motion(frames, "nut", "displacement_z")
check("screw: independent of the number of steps", (code, len(rows), abs(at_once / sunk - 1) < 1e-5), (0, 2, True))

# A nut that is free to turn: friction holds it only above tan lambda, 0.095 to 0.159 at its radii.
free = options.work / "free_nut.xml"
text = scene("screw").read_text().replace('"screw.geo"', f'"{scene("screw").with_suffix(".geo").resolve()}"')
free.write_text(text.replace('<Parameter name="Rotation z" type="double" value="0"/>', ""))
for friction, expected in ((0.0, 3), (0.08, 3), (0.2, 0)):
    code, text, _, _, frames = solve(f"free_nut_{friction}", free, *setting("Boundary Conditions/drive/Rotation z", 0), *setting("Load Steps/Times", "{1}"),
                                     *setting("Load Steps/Factors/drive", "1"), *setting("Contact/thread/Law", "Coulomb"),
                                     *setting("Contact/thread/Coulomb/Coefficient", friction))
    check(f"free nut, friction {friction}", (code, "body 'nut' can turn about the axis" in text), (expected, expected == 3))
check("free nut: stays", abs(motion(frames, "nut", "rotation_z")), lambda angle: angle < 1e-3)

# With friction each pair at the radius r carries the torque r tan(rho - lambda) of its axial force, also if a step turns the direction of
# sliding by 22.5 degrees.
code, _, summary, rows, _ = solve("rough_screw", scene("screw"), *setting("Contact/thread/Law", "Coulomb"),
                                  *setting("Contact/thread/Coulomb/Coefficient", 0.15))
check("screw with friction: all steps", (code, summary["verified"], int(rows[-1]["sticking"])), (0, True, 0))
expected = 0.0
for pair in table(options.work / "rough_screw", "contact.csv"):
    axial = float(pair["force"]) * float(pair["nz"]) + float(pair["tz"])
    radius = math.hypot(float(pair["x"]), float(pair["y"]))
    expected -= axial * radius * math.tan(math.atan(0.15) - math.atan(LEVER / radius))
check("screw with friction: torque", float(reactions("rough_screw")["drive"]["mz"]) / expected - 1, near(0, 0.02))

# A ball rolls in a groove whose sides are inclined by 45 degrees: its rolling radius is the distance of the contact from its axis.
code, _, summary, rows, frames = solve("rolling_ball", scene("ball_in_groove"), *setting("Load Steps/Times", "{1, 2, 3, 4}"))
check("rolling ball: all steps", (code, summary["verified"], len(rows) >= 4), (0, True, True))
drive = summary["rigid_groups"]["drive"]
path = drive["displacement"][0] - motion(frames, "ball", "displacement_x", 1)
check("rolling ball: angle", drive["rotation"][1], near(0.075, 1e-12))
check("rolling ball: path", path / (RADIUS * math.sqrt(0.5) * 0.075) - 1, near(0, 1e-3))
for row in rows:
    check("rolling ball: statics", [force(row, axes="x")[0], force(row, axes="z")[0] + 700], lambda rest: max(map(abs, rest)) < 1e-3)

# A ball is drawn along the groove, without friction: the force is normal to the side.
code, _, summary, rows, frames = solve("drawn_ball", scene("ball_in_groove"), *setting("Contact/joint/Law", "Frictionless"),
                                       *setting("Load Steps/Times", "{1, 5, 9}"),
                                       *setting("Boundary Conditions/drive/Motion x", RADIUS * math.sqrt(0.5) * 0.2))
check("drawn ball: all steps", (code, summary["verified"], len(rows)), (0, True, 3))
for row in rows:
    across, down = force(row, axes="yz")
    check("drawn ball: load", down, near(-700, 1e-3))
    check("drawn ball: normal force", math.hypot(across, down) / (700 / math.sin(math.pi / 4)) - 1, near(0, 1e-3))
    check("drawn ball: no force along the groove", force(row)[0], near(0, 5e-3 * 700))
normal, modulus = 700 / math.sin(math.pi / 4), 2.1e5 / (1 - 0.3**2) / 2
check("drawn ball: Hertz", summary["extremes"]["pressure"]["value"] / (6 * normal * modulus**2 / (math.pi**3 * RADIUS**2)) ** (1 / 3), near(0.98, 0.04))
finish()
