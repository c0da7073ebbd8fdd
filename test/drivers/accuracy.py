"""Accuracy on request (list Accuracy): the error is reached on any number of ranks, with matching contact sides and few unknowns; the true
error is as small as said; limits; bad input; --again.

accuracy.py --solve PROGRAM --mpirun "mpirun ..." --work DIR --input FOLDER
"""
import json
import pathlib

from harness import arguments, check, finish, run, setting

options = arguments("--solve", "--input")
INPUT = pathlib.Path(options.input)
TUNNEL = INPUT / "tunnel" / "tunnel.xml"


def solve(name, scene, *words, ranks=1):
    """Exit code, output and summary."""
    code, text = run(options.solve, ranks, scene, "--output", options.work / name, *words, timeout=300)
    path = options.work / name / "summary.json"
    return code, text, json.loads(path.read_text()) if path.exists() else {}


def error(value):
    return setting("Accuracy/Error", value)


# The tunnel, on three numbers of ranks.
first = None
for ranks in (1, 2, 4):
    code, text, summary = solve(f"tunnel_{ranks}", TUNNEL, *error(0.003), ranks=ranks)
    accuracy = summary["accuracy"]
    check("the error is reached", (code, accuracy["limit"], accuracy["reached"] <= 0.003), (0, "", True))
    check("the summary is that of the last mesh", summary["dofs"], accuracy["levels"][-1]["unknowns"])
    check("a bound, for the polygon of the mesh", (accuracy["strict"], summary["bound"]["reasons"]), (True, []))
    check("with its straight sides", (accuracy["reached"] ** 2 + accuracy["geometry"] ** 2) ** 0.5, lambda both: both <= 0.003)
    check("matching sides stay matching", "do not match" in text, False)
    first = first or accuracy
    check("the same meshes", [level["unknowns"] for level in accuracy["levels"]], [level["unknowns"] for level in first["levels"]])
    for mine, its in zip(accuracy["levels"], first["levels"]):
        # With an automatic tolerance, iterates differ by the round-off of preconditioners in single precision.
        check("the same errors", abs(mine["error"] / its["error"] - 1), lambda part: part < 1e-5)
        check("the same straight sides", abs(mine["geometry"] / its["geometry"] - 1), lambda part: part < 1e-4)
levels = first["levels"]
check("levels", len(levels), lambda count: 3 <= count <= 5)
check("unknowns of all meshes", sum(level["unknowns"] for level in levels) / levels[-1]["unknowns"], lambda part: part < 3.5)
check("the error falls like 1 / unknowns", levels[-1]["error"] * levels[-1]["unknowns"] / (levels[1]["error"] * levels[1]["unknowns"]),
      lambda part: part < 1.1)
check("no history of other meshes", len((options.work / "tunnel_1" / "history.csv").read_text().split()) - 1, levels[-1]["outer"])

# True errors. Without loads a(u, u) = 2 J, and |u - u_h|^2 = 2 (J_h - J): the relative error is sqrt((J_h - J) / J). The mesh of the reference has
# a twentieth of the error.
PUNCH = INPUT / "validation" / "v7_punch" / "v7_punch.xml"
_, _, fine = solve("reference", PUNCH, *error(0.0005))
_, _, coarse = solve("punch", PUNCH, *error(0.01))
for level in coarse["accuracy"]["levels"] + fine["accuracy"]["levels"][:3]:
    true = (level["energy"] / fine["energy"] - 1) ** 0.5
    check("the estimate is close to the error", level["error"] / true, lambda part: 0.7 < part < 1.6)

# A corner at inclined sides, where elements become so small that three nodes of a side are not on a line: the same meshes at any angle. The
# difference of the energies is half of the difference of the squared errors, both below 0.05 %.
BRACKET = pathlib.Path(__file__).parent / "turned_bracket.xml"
energies = []
for angle in (0, 23, 120):
    code, _, summary = solve(f"bracket_{angle}", BRACKET, *error(0.0005), *setting("Mesh/Constants/angle", angle))
    check("bracket: the error is reached", (code, summary["accuracy"]["limit"], summary["accuracy"]["strict"]), (0, "", True))
    energies.append(summary["energy"])
for energy in energies:
    check("bracket: the same energy", abs(energy / energies[0] - 1), lambda part: part < 0.0005**2)

# Lame's tube under internal pressure: energy of the exact solution, -1/2 p u(a) pi a / 2 for a quarter. The squared bound and the squared
# effect of straight sides are together a bound of twice the difference of the energies.
TUBE = pathlib.Path(__file__).parent / "ring.xml"
for outer in (2.0, 10.0):
    moved = 1e-3 * 1.3 / (outer**2 - 1) * (0.4 + outer**2)
    exact = -0.5 * 1e-3 * moved * 1.5707963267948966
    for sides in ("Straight", "Curved"):
        code, _, summary = solve(f"tube_{outer}_{sides}", TUBE, *error(0.003), *setting("Accuracy/Sides", sides), *setting("Mesh/Constants/b", outer))
        accuracy = summary["accuracy"]
        check("tube: the error is reached", (code, accuracy["limit"], accuracy["strict"]), (0, "", sides == "Straight"))
        for level in accuracy["levels"]:
            true = level["energy"] / exact - 1  # (u - u_h, u - u_h) / (u, u) = (J_h - J) / (-J), without contact
            both = level["error"] ** 2 + level.get("geometry", 0.0) ** 2
            check(f"tube {sides}: bound and straight sides hold", abs(true) / both, lambda part: part <= 1.02)
        if sides == "Straight" and outer == 10.0:  # almost all of the effect is that of the inner side
            first = accuracy["levels"][0]
            check("tube: straight sides have this effect", first["geometry"] ** 2 / abs(first["energy"] / exact - 1), lambda part: 0.7 < part < 1.5)

# The tunnel: |u - u_h|^2 <= 2 (J_h - J), with what its second-order sides change in J against the circle.
_, _, fine = solve("tunnel_fine", TUNNEL, *error(0.0004))
tunnel = json.loads((options.work / "tunnel_1" / "summary.json").read_text())
norm = tunnel["error"]["estimated_energy_norm"] / tunnel["error"]["estimated_energy_norm_relative"]
check("the true error with the circle", (2 * abs(tunnel["energy"] - fine["energy"])) ** 0.5 / norm, lambda part: part < 1.3 * 0.003)

# Boxes of quadrilaterals, without a geometry: triangles of second order, bisected. The pressure is unbounded at the ends of
# the contact.
# On another number of ranks an automatic tolerance gives a solution that differs within a tenth of the error of the mesh, and with it a
# mesh that differs by some elements.
EXACTLY = setting("Outer Solver/Tolerance", "1e-8")
BOXES = pathlib.Path(__file__).parent / "punch_of_boxes.xml"
first = None
for ranks in (1, 2, 4):
    code, text, summary = solve(f"boxes_{ranks}", BOXES, *error(0.01), *EXACTLY, ranks=ranks)
    accuracy = summary["accuracy"]
    check("boxes: the error is reached", (code, accuracy["limit"], accuracy["reached"] <= 0.01), (0, "", True))
    check("boxes: bisection", {level["refinement"] for level in accuracy["levels"][1:]} <= {"bisection", "uniform"}, True)
    first = first or accuracy
    check("boxes: the same meshes", [level["unknowns"] for level in accuracy["levels"]], [level["unknowns"] for level in first["levels"]])
code, _, fine = solve("boxes_fine", BOXES, *error(0.001), *setting("Accuracy/Most Levels", 20))
check("boxes: the reference", code, 0)
norm = summary["error"]["estimated_energy_norm"] / summary["error"]["estimated_energy_norm_relative"]
for level in first["levels"][1:]:
    true = (2 * (level["energy"] - fine["energy"])) ** 0.5 / norm
    check("boxes: the estimate is close to the error", level["error"] / true, lambda part: 0.6 < part < 1.7)

# Load steps: each mesh computes the whole path, and the error is that of the last step. Without friction it is that of all loads at once.
_, _, once = solve("once", TUNNEL, *error(0.01))
for ranks in (1, 2):
    code, text, summary = solve(f"steps_{ranks}", TUNNEL, *error(0.01), *setting("Load Steps/Times", "{0.5, 1}"), ranks=ranks)
    accuracy = summary["accuracy"]
    check("steps: a bound", (code, accuracy["limit"], accuracy["strict"]), (0, "", True))
    check("steps: the same meshes", [level["unknowns"] for level in accuracy["levels"]], [level["unknowns"] for level in once["accuracy"]["levels"]])
    for mine, its in zip(accuracy["levels"], once["accuracy"]["levels"]):
        check("steps: the same errors", abs(mine["error"] / its["error"] - 1), lambda part: part < 1e-5)
    check("steps: the same energy", abs(summary["energy"] / once["energy"] - 1), lambda part: part < 1e-9)
    folder = options.work / f"steps_{ranks}"
    check("steps: all of the last mesh", len((folder / "steps.csv").read_text().splitlines()) - 1, len(list(folder.glob("fields_*.vtkhdf"))))

# Friction, compressed and released: the ratio of the forces on the fault follows from statics, the dissipated work from a finer mesh.
FAULT = INPUT / "fault_slip" / "fault_slip.xml"


def last_step(name):
    head, *rows = (options.work / name / "steps.csv").read_text().splitlines()
    return dict(zip(head.split(","), map(float, rows[-1].split(","))))


code, _, summary = solve("fault", FAULT, *error(0.02))
check("fault: an estimate", (code, summary["accuracy"]["limit"], summary["accuracy"]["strict"], len(summary["accuracy"]["levels"]) > 1),
      (0, "", False, True))
solve("fault_fine", FAULT, *setting("Mesh/Constants/scale", 0.7), *setting("Mesh/Order", 2))
coarse, fine = last_step("fault"), last_step("fault_fine")
check("fault: statics", coarse["force fault above y"] / coarse["force fault above x"] / 1.4805399 - 1, lambda part: abs(part) < 1e-6)
check("fault: the history of a finer mesh", coarse["dissipated_work"] / fine["dissipated_work"] - 1, lambda part: abs(part) < 0.02)

# Bricks in 3D, without a geometry: tetrahedra of second order, bisected; the contact stays matching.
BRICKS = pathlib.Path(__file__).parent / "punch_of_bricks.xml"
first = None
for ranks in (1, 2, 4):
    code, text, summary = solve(f"bricks_{ranks}", BRICKS, *error(0.12), *EXACTLY, ranks=ranks)
    accuracy = summary["accuracy"]
    check("bricks: a bound", (code, accuracy["limit"], accuracy["strict"], accuracy["reached"] <= 0.12), (0, "", True, True))
    check("bricks: bisection", [level["refinement"] for level in accuracy["levels"][1:]], lambda names: names and set(names) == {"bisection"})
    check("bricks: matching sides stay matching", "do not match" in text, False)
    first = first or accuracy
    check("bricks: the same meshes", [level["unknowns"] for level in accuracy["levels"]], [level["unknowns"] for level in first["levels"]])
    for mine, its in zip(accuracy["levels"], first["levels"]):
        check("bricks: the same errors", abs(mine["error"] / its["error"] - 1), lambda part: part < 1e-6)
# Against a uniform mesh of half the size: |u - u_h|^2 >= 2 (J_h - J_fine).
_, _, fine = solve("bricks_fine", BRICKS, *setting("Mesh/Boxes/punch/Cells", "{8, 8, 8}"), *setting("Mesh/Boxes/under/Cells", "{16, 16, 16}"),
                   *setting("Mesh/Boxes/punch/Cell", "Hexahedron20"), *setting("Mesh/Boxes/under/Cell", "Hexahedron20"))
for level in first["levels"]:
    true = max(0.0, level["energy"] / fine["energy"] - 1) ** 0.5
    check("bricks: the bound holds", level["error"] / true, lambda part: 1 < part < 2.5)

# Limits: the results so far, and exit code 4.
code, text, summary = solve("levels", TUNNEL, *error(0.001), *setting("Accuracy/Most Levels", 1))
check("one mesh", (code, summary["exit_code"], summary["accuracy"]["limit"], len(summary["accuracy"]["levels"])), (4, 4, "levels", 1))
check("it is verified", (summary["verified"], "Accuracy/Most Levels" in summary["failure"], "ACCURACY NOT REACHED" in text), (True, True, True))
code, _, summary = solve("unknowns", TUNNEL, *error(0.0005), *setting("Accuracy/Most Unknowns", 8000))
check("unknowns", (code, summary["accuracy"]["limit"]), (4, "unknowns"))
check("the cap is used and kept", max(level["unknowns"] for level in summary["accuracy"]["levels"]), lambda most: 5000 < most < 9600)
code, _, summary = solve("seconds", TUNNEL, *error(0.001), *setting("Accuracy/Most Seconds", 0.01))
check("seconds", (code, summary["accuracy"]["limit"], len(summary["accuracy"]["levels"])), (4, "time", 1))
code, _, summary = solve("memory", TUNNEL, *error(0.0001), *setting("Subdomain/Memory Limit", 75))
check("memory", (code, summary["accuracy"]["limit"], summary["verified"]), (4, "memory", True))

# Nothing without a request.
_, text, summary = solve("plain", TUNNEL, *setting("Output/Checkpoint", "true"))
check("no request, no result", ("accuracy" in summary, "level" in text), (False, False))

# Bad input.
for name, words, expected in (
        ("negative", error(-0.01), "Accuracy/Error"),
        ("two", error(2), "Accuracy/Error"),
        ("unknown", setting("Accuracy/Eror", 0.01), "Did you mean 'Error'?"),
        ("order", [*error(0.01), *setting("Accuracy/Order", 3)], "Accuracy/Order"),
        ("restart", [*error(0.01), "--restart", options.work / "plain" / "checkpoint.h5"], "--restart"),
        ("nested", [*error(0.01), *setting("Outer Solver/Start", "Nested"), *setting("Outer Solver/Nested/Levels", "{Mesh/Constants/scale=2}")],
         "Outer Solver/Start"),
        ("phases", [*error(0.01), *setting("Load Steps/Times", "{0.5, 1}"), *setting("Load Steps/Removed/left", 0.5)], "Load Steps/Removed"),
        ("sides", [*error(0.01), *setting("Accuracy/Sides", "Round")], "Accuracy/Sides")):
    code, text, _ = solve("bad_" + name, TUNNEL, *words)
    check(f"bad input: {name}", (code, expected in text), (3, True))

# The same run again, also on another number of ranks.
for ranks in (1, 2):
    code, text = run(options.solve, ranks, "--again", options.work / "tunnel_1" / "summary.json", "--output", options.work / f"again_{ranks}", timeout=300)
    check("again", (code, "agrees" in text), (0, True))
finish()
