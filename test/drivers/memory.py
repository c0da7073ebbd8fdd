"""Estimated against measured memory: the cheapest and the most expensive 2D element on one and two ranks, and 3D contact with matching nodes
and with a mortar; with --all also the other shapes.

memory.py --solve PROGRAM --mpirun "mpirun ..." --work DIR --input FOLDER [--all]
"""
import argparse
import json
import pathlib
import re
import sys

from harness import SANITIZED, arguments, check, finish, run, setting

parser = argparse.ArgumentParser()
parser.add_argument("--all", action="store_true")
options = arguments("--solve", "--input", parser=parser)
if SANITIZED:
    sys.exit(77)  # skipped: AddressSanitizer needs several times as much
INPUT = pathlib.Path(options.input)
CELLS = {"Triangle3": 260, "Triangle6": 130, "Quadrilateral4": 260, "Quadrilateral8": 150, "Quadrilateral9": 130}  # about 135,000 unknowns


def compare(name, scene, words, ranks, low, high):
    words = [*words, "--output", options.work / name]
    code, text = run(options.solve, ranks, scene, *words, "--check", "--no-drawing")
    found = re.search(r"about ([\d,]+) MB of memory", text)
    check(f"{name}, np{ranks}: --check says how much", (code, found is not None), (0, True))
    code, _ = run(options.solve, ranks, scene, *words, "--quiet")
    check(f"{name}, np{ranks}: solved", code, 0)
    if code or not found:
        return
    peak = json.loads((options.work / name / "summary.json").read_text())["peak_memory_mb"]["sum"]
    check(f"{name}, np{ranks}: {found.group(1)} MB estimated, {peak:.0f} taken", float(found.group(1).replace(",", "")) / peak, lambda ratio: low < ratio < high)


for shape, cells in CELLS.items():
    ends = shape in ("Triangle3", "Quadrilateral9")
    if not ends and not options.all:
        continue
    words = [*setting("Mesh/Boxes/square/Cell", shape), *setting("Mesh/Boxes/square/Cells", f"{{{cells}, {cells}}}"),
             *setting("Mesh/Boxes/square/Blocks", "{1, 1}"), *setting("Partition/Type", "METIS"), *setting("Outer Solver/Tolerance", "1e-6")]
    for ranks in (1, 2) if ends else (2,):
        compare(shape, INPUT / "linear_square" / "linear_square.xml", words, ranks, 0.85, 1.2)  # 0.90 to 1.06 found

tetrahedra = [word for body in ("lower", "upper")
              for word in (*setting(f"Mesh/Boxes/{body}/Cell", "Tetrahedron10"), *setting(f"Mesh/Boxes/{body}/Cells", "{12, 12, 6}"))]
compare("matching", INPUT / "press" / "press.xml", tetrahedra, 2, 0.8, 1.25)  # 45,000 unknowns; 1.0 found
# 21,500 unknowns, 484 pairs of 63 unknowns each; else 12,900 and 226. 1.0 and 1.1 found
compare("mortar", INPUT / "spheres" / "spheres.xml", [] if options.all else setting("Mesh/Constants/resolution", 4), 1, 0.8, 1.25)

finish()
