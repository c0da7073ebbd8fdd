"""The estimate of the memory beside what a run took: elements of all shapes on two ranks, of the cheapest and the dearest on one.

memory.py --solve PROGRAM --mpirun "mpirun ..." --work DIR --input FOLDER
"""
import json
import pathlib
import re
import sys

from harness import SANITIZED, arguments, check, finish, run, setting

options = arguments("--solve", "--input")
if SANITIZED:
    sys.exit(77)  # skipped: AddressSanitizer takes several times as much
SCENE = pathlib.Path(options.input) / "linear_square" / "linear_square.xml"
CELLS = {"Triangle3": 260, "Triangle6": 130, "Quadrilateral4": 260, "Quadrilateral8": 150, "Quadrilateral9": 130}  # about 135,000 unknowns

for shape, cells in CELLS.items():
    for ranks in (1, 2) if shape in ("Triangle3", "Quadrilateral9") else (2,):
        words = [*setting("Mesh/Boxes/square/Cell", shape), *setting("Mesh/Boxes/square/Cells", f"{{{cells}, {cells}}}"),
                 *setting("Mesh/Boxes/square/Blocks", "{1, 1}"), *setting("Partition/Type", "METIS"),
                 *setting("Outer Solver/Tolerance", "1e-6"), "--output", options.work / shape]
        code, text = run(options.solve, ranks, SCENE, *words, "--check")
        found = re.search(r"about (\d+) MB of memory", text)
        check(f"{shape}, np{ranks}: --check says how much", (code, found is not None), (0, True))
        code, _ = run(options.solve, ranks, SCENE, *words, "--quiet")
        check(f"{shape}, np{ranks}: solved", code, 0)
        if code or not found:
            continue
        peak = json.loads((options.work / shape / "summary.json").read_text())["peak_memory_mb"]["sum"]
        check(f"{shape}, np{ranks}: {found.group(1)} MB estimated, {peak:.0f} taken", float(found.group(1)) / peak,
              lambda ratio: 0.85 < ratio < 1.2)  # 0.90 to 1.06 found

finish()
