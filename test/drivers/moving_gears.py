"""Two gears: the torques of both shafts, the transmission error and the shared load against theory; and the tables of Output/Transmissions.

moving_gears.py --solve PROGRAM --mpirun "mpirun ..." --work DIR --input FOLDER
"""
import math
import pathlib

from harness import arguments, check, finish, setting
from moving_runs import force, solve, table

options = arguments("--solve", "--input")
GEARS = pathlib.Path(options.input) / "gears" / "gears.xml"
BASE, MOMENT = 30 * math.cos(math.radians(20)), 3000.0


def between(least, most):
    return lambda found: least <= found <= most


def single_tooth_stiffness(first, second):
    """ISO 6336-1, method B, standard tooth profile: mesh stiffness c' of one pair of teeth, without the factor 0.8 for real gears and with it
    [N / (mm micrometre)]."""
    flexibility = 0.04723 + 0.15551 / first + 0.25791 / second
    return 1 / flexibility, 0.8 / flexibility


code, text, summary, rows, _ = solve("gears", GEARS)
check("all steps", (code, summary["verified"], len(rows)), (0, True, 13))
found = [{name: float(value) for name, value in row.items()} for row in table(options.work / "gears", "transmission_teeth.csv")]
groups = {name: [row for row in table(options.work / "gears", "rigid_groups.csv") if row["group"] == name] for name in ("drive", "shaft")}
check("one row per step", [(row["step"], row["time"]) for row in found], [(k, k) for k in range(1, 14)])
check("listed on the console", "transmission_teeth.csv" in text and "rigid_groups.csv" in text, True)
for row, drive, shaft in zip(found, groups["drive"], groups["shaft"]):
    angles = float(drive["rotation_z"]), float(shaft["rotation_z"])
    check("columns", (row["driving"], row["driven"], row["driving_load"], row["driven_load"]),
          (*angles, float(drive["mz"]), float(shaft["mz"])))
    check("transmission error", abs(row["error"] - (angles[0] + angles[1])), lambda apart: apart < 1e-14)
    check("the moment of the shaft", abs(row["driven_load"] / MOMENT - 1), lambda part: part < 1e-6)

# Work: over one pitch the state repeats, so that the mean torques are in the ratio of the teeth. At each step the torques differ by the
# change of the bent teeth's energy, and where a pair begins with the edge of a tip.
figures = summary["transmissions"]["teeth"]
check("mean torque ratio", figures["efficiency"], between(1 - 1e-3, 1 + 1e-3))
check("range of the error", (figures["error_min"], figures["error_max"]), (min(row["error"] for row in found), max(row["error"] for row in found)))
check("the state repeats", found[-1]["error"] - found[0]["error"], between(-2e-5 / BASE * 10, 2e-5 / BASE * 10))
torques = sorted(row["driving_load"] / MOMENT for row in found)
check("torque ratio at all steps except that of the edge of a tip", (torques[0], torques[-2]), lambda ends: 0.998 < ends[0] and ends[1] < 1.002)

# One pair of teeth carries from 0.667 to 0.833 pitches. The bending is that of ISO 6336, the hub's ring included.
one_pair = [row for row in found if 0.66 < row["driving"] * 30 / (2 * math.pi) < 0.84]
stiff, soft = single_tooth_stiffness(30, 30)
for row in one_pair:
    check("one pair of teeth: torque ratio", row["driving_load"] / MOMENT, between(0.998, 1.002))
    check("one pair of teeth: bending", 1e3 * row["error"] * BASE, between(MOMENT / BASE / stiff, MOMENT / BASE / soft))
for row in rows:
    along = force(row, "mesh")
    line = along[0] * math.sin(math.radians(20)) + along[1] * math.cos(math.radians(20))
    check("force along the line of action times base radius", line * BASE / MOMENT, between(0.996, 1.004))

# Other numbers of teeth: z1 / z2 = 3 / 4.
words = setting("Mesh/Constants/z2", 40) + setting("Boundary Conditions/shaft/Point", "{70, 0}") + setting("Output/Transmissions/teeth/Ratio", -0.75)
code, _, summary, rows, _ = solve("ratio", GEARS, *words)
check("30 and 40 teeth: all steps", (code, summary["verified"], len(rows)), (0, True, 13))
check("30 and 40 teeth: mean torque ratio over that of the teeth", summary["transmissions"]["teeth"]["efficiency"], between(1 - 1e-3, 1 + 1e-3))
check("30 and 40 teeth: error", 1e3 * summary["transmissions"]["teeth"]["error_max"] * 40 * math.cos(math.radians(20)), between(4, 12))

# A transmission that does not exist, with all its errors.
bad = [*setting("Output/Transmissions/teeth/Driving", "drve"), *setting("Output/Transmissions/teeth/Driven Motion", "Motion z"),
       *[word for name in ("a b", "a_b") for entry, value in (("Driving", "drive"), ("Driven", "shaft"), ("Ratio", -1))
         for word in setting(f"Output/Transmissions/{name}/{entry}", value)]]
code, text, *_ = solve("bad", GEARS, *bad)
check("refused", (code, "3 errors" in text), (3, True))
for part in ("Output/Transmissions/teeth/Driving: no such rigid group 'drve'", "Did you mean 'drive'?", "Output/Transmissions/teeth/Driven Motion: 'Motion z' does not exist in 2D",
             "Output/Transmissions/a_b: writes the same file transmission_a_b.csv as the transmission 'a b'"):
    check(f"refused: {part}", part in text, True)
code, text, *_ = solve("few", GEARS, *setting("Output/Transmissions/other/Driving", "drive"))
check("refused: a missing entry", (code, "Output/Transmissions/other/Driven" in text, "Output/Transmissions/other/Ratio" in text), (3, True, True))
still = pathlib.Path(options.input) / "two_blocks" / "two_blocks.xml"
code, text, *_ = solve("still", still, *setting("Output/Transmissions/a/Driving", "press"), *setting("Output/Transmissions/a/Driven", "press"),
                       *setting("Output/Transmissions/a/Ratio", 1))
check("refused: no rigid groups, no steps", (code, "needs Load Steps/Times" in text, "no boundary condition with Type = Rigid Group" in text),
      (3, True, True))
finish()
