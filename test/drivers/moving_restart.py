"""Paths of bodies that move far go on from a checkpoint, on other numbers of ranks, as if they had not been interrupted; checkpoints that do
not fit are refused.

moving_restart.py --solve PROGRAM --mpirun "mpirun ..." --work DIR --input FOLDER
"""
import pathlib

from harness import arguments, check, finish, setting
from moving_runs import force, solve, table

options = arguments("--solve", "--input")
INPUT = pathlib.Path(options.input)


def times(count):
    return setting("Load Steps/Times", "{" + ", ".join(str(k + 1) for k in range(count)) + "}")


def apart(one, other, column, key):
    """Largest difference of a column of two tables, relative to its largest value, row by row of the same step and name."""
    first = {(row["step"], row[key]): float(row[column]) for row in one}
    second = {(row["step"], row[key]): float(row[column]) for row in other}
    if first.keys() != second.keys():
        return float("inf")
    return max(abs(first[at] - second[at]) for at in first) / max(1e-30, *(abs(value) for value in first.values()))


# Friction that slides, sticks and rolls; a hinge. Paths need more steps than the interrupted run has.
for name, part, whole, ranks, words in (("sliding_block", 2, 5, 2, setting("Load Steps/Factors/slide", "(t - 1) / 4")), ("roller", 4, 7, 3, []), ("hinge", 3, 6, 1, []),
                                        ("cam", 3, 6, 2, []), ("screw", 2, 3, 1, [])):
    scene = INPUT / name / f"{name}.xml"
    tight = [*words, *setting("Outer Solver/Tolerance", "1e-10"), *setting("Output/Displacements Since", 2)]
    code, _, whole_summary, rows, frames = solve(f"{name}_whole", scene, *tight, *times(whole))
    check(f"{name}: the whole path", (code, whole_summary["verified"]), (0, True))
    code, _, _, before, _ = solve(f"{name}_part", scene, *tight, *times(part))
    check(f"{name}: its beginning", code, 0)
    checkpoint = options.work / f"{name}_part" / "checkpoint.h5"
    code, text, summary, again, moved = solve(f"{name}_again", scene, *tight, *times(whole), "--restart", checkpoint, ranks=ranks)
    since = [one["extremes"]["displacement_since"]["value"] for one in (whole_summary, summary)]
    check(f"{name}: the same displacements since t = 2", abs(since[1] / since[0] - 1), lambda part: part < 1e-5)
    check(f"{name}: goes on", (code, summary.get("verified"), f"after load step {len(before)}" in text), (0, True, True))
    check(f"{name}: all steps", [row["time"] for row in again], [row["time"] for row in rows])
    for column in ("displacement_x", "displacement_y", "rotation_z"):
        check(f"{name}: the same {column}", apart(frames, moved, column, "body"), lambda part: part < 1e-6)
    contact = next(column for column in rows[0] if column.startswith("force ")).split()[1]
    size = max(abs(x) for row in rows for x in force(row, contact))
    for one, other in zip(rows, again):
        differ = max(abs(a - b) for a, b in zip(force(one, contact), force(other, contact)))
        check(f"{name}: the same forces at {one['time']}", differ / size, lambda part: part < 1e-5)
    for column in ("dissipated_work", "external_work"):
        largest = max(abs(float(row[column])) for row in rows)
        check(f"{name}: the same {column}", abs(float(rows[-1][column]) - float(again[-1][column])), lambda gap: gap <= 1e-5 * largest)
    groups = [table(options.work / f"{name}_{kind}", "rigid_groups.csv") for kind in ("whole", "again")]
    for column in ("rotation_z", "mz") if groups[0] else ():  # the torque of a roller is round-off
        check(f"{name}: the same {column} of rigid groups", apart(*groups, column, "group"), lambda part: part < (1e-3 if name == "roller" else 1e-5))

BLOCK = INPUT / "sliding_block" / "sliding_block.xml"
checkpoint = options.work / "sliding_block_part" / "checkpoint.h5"
for name, words, expected in (("finished", times(2), "the last step ends at"),
                              ("small", [*times(5), *setting("Motion", "Small")], "expected a scene with Motion = Moving"),
                              ("since", [*times(5), *setting("Output/Displacements Since", 1)], "and has no displacements of that time"),
                              ("mesh", [*times(5), *setting("Mesh/Boxes/block/Cells", "{20, 12}")], "a checkpoint of another mesh")):
    code, text, *_ = solve(f"refused_{name}", BLOCK, *setting("Load Steps/Factors/slide", "(t - 1) / 4"), *words, "--restart", checkpoint)
    check(f"refused: {name}", (code, expected in text), (3, True))
code, *_ = solve("small", BLOCK, *setting("Load Steps/Factors/slide", "0"), *setting("Motion", "Small"), *times(1))
code, text, *_ = solve("refused_moving", BLOCK, *setting("Load Steps/Factors/slide", "0"), *times(5), "--restart", options.work / "small" / "checkpoint.h5")
check("refused: a checkpoint of bodies that do not move", (code, "a checkpoint without bodies that move far" in text), (3, True))
finish()
