"""The block that slides by half of its length (input/sliding_block) beside CalculiX: the same cells, finite displacements, 20 increments.

moving_ccx.py --solve PROGRAM --mpirun "mpirun ..." --work DIR --input FOLDER

Exit code 77 without ccx (Debian: apt-get install calculix-ccx).
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys

from harness import SLOWER, arguments, check, finish
from moving_runs import force, solve

if not shutil.which("ccx"):
    print("skipped: ccx is not installed (Debian: apt-get install calculix-ccx)")
    sys.exit(77)

options = arguments("--solve", "--input")
INCREMENTS = 20
STORED = 457.78, 137.40  # normal and tangential force that CalculiX 2.20 gave, which moving.py compares with
BLOCK, BASE = ((-2, 2, 24), (0, 2, 12)), ((-5, 7.1, 60), (-3, 0, 12))  # ends and cells, along x and y


def grid(axes, first):
    """Nodes {number: (x, y)} and quadrilaterals of a box, numbered from `first`, rows from below."""
    (x0, x1, n), (y0, y1, m) = axes
    nodes = {first + j * (n + 1) + i: (x0 + (x1 - x0) * i / n, y0 + (y1 - y0) * j / m) for j in range(m + 1) for i in range(n + 1)}
    corner = [first + j * (n + 1) + i for j in range(m) for i in range(n)]
    return nodes, [(c, c + 1, c + n + 2, c + n + 1) for c in corner]


def lines(name, kind, numbers):
    return [f"*{kind},{kind}={name}", *(", ".join(map(str, numbers[k:k + 8])) + "," for k in range(0, len(numbers), 8))]


def deck():
    """One layer of bricks in plane strain: pressed in one increment, then pushed."""
    nodes, cells = grid(BLOCK, 1)
    others, below = grid(BASE, len(nodes) + 1)
    nodes, count = {**nodes, **others}, len(cells)
    layer = max(nodes)
    top = [n for n in range(1, 1 + len(nodes) - len(others)) if nodes[n][1] > 2 - 1e-9]
    bottom = [n for n in others if nodes[n][1] < -3 + 1e-9]
    both = lambda chosen: [*chosen, *(n + layer for n in chosen)]
    loaded = ["*NODE PRINT,NSET=TOP,TOTALS=ONLY", "RF", "*END STEP"]
    text = ["*NODE,NSET=ALL", *(f"{n + z * layer}, {x:.12g}, {y:.12g}, {z}." for z in (0, 1) for n, (x, y) in nodes.items()),
            "*ELEMENT,TYPE=C3D8I,ELSET=EALL",
            *(f"{e}, " + ", ".join(map(str, both(cell))) for e, cell in enumerate([*cells, *below], 1)),
            *lines("TOP", "NSET", both(top)), *lines("BOTTOM", "NSET", both(bottom)),
            "*SURFACE,NAME=UPPER,TYPE=ELEMENT", *(f"{e}, S3" for e in range(1, BLOCK[0][2] + 1)),
            "*SURFACE,NAME=LOWER,TYPE=ELEMENT", *(f"{count + e}, S5" for e in range(len(below) - BASE[0][2] + 1, len(below) + 1)),
            "*MATERIAL,NAME=STEEL", "*ELASTIC", "2.1E5, .3", "*SOLID SECTION,ELSET=EALL,MATERIAL=STEEL",
            "*SURFACE INTERACTION,NAME=JOINT", "*SURFACE BEHAVIOR,PRESSURE-OVERCLOSURE=LINEAR", "1.E8", "*FRICTION", ".3, 1.E6",
            "*CONTACT PAIR,INTERACTION=JOINT,TYPE=SURFACE TO SURFACE", "UPPER, LOWER",
            "*BOUNDARY", "ALL,3,3", "BOTTOM,1,2",
            "*STEP,NLGEOM,INC=1000", "*STATIC", "1.,1.", "*BOUNDARY", "TOP,1,1", "TOP,2,2,-.002", *loaded,
            "*STEP,NLGEOM,INC=10000", "*STATIC", f"{1 / INCREMENTS},1.,1.E-6,{1 / INCREMENTS}", "*BOUNDARY", "TOP,2,2,-.002", "TOP,1,1,2.", *loaded]
    return "\n".join(text) + "\n"


def reference():
    """Normal and tangential force at the end, positive, of the layer of unit thickness."""
    folder = options.work / "ccx"
    folder.mkdir()
    (folder / "block.inp").write_text(deck())
    done = subprocess.run(["ccx", "block"], cwd=folder, capture_output=True, text=True, timeout=850 * SLOWER,
                          env={**os.environ, "OMP_NUM_THREADS": "1", "CCX_NPROC_EQUATION_SOLVER": "1"})
    check("CalculiX ends", ("Job finished" in done.stdout), True)
    totals = re.findall(r"total force.*?\n\s*\n?\s*([-+.\dE]+)\s+([-+.\dE]+)", (folder / "block.dat").read_text())
    along, across = map(float, totals[-1])
    return abs(across), abs(along)


normal, tangential = reference()
print(f"CalculiX: normal force {normal:.2f}, tangential force {tangential:.2f} N/mm")
check("CalculiX: the stored values", (abs(normal / STORED[0] - 1) < 1e-3, abs(tangential / STORED[1] - 1) < 1e-3), (True, True))
code, _, summary, rows, _ = solve("block", pathlib.Path(options.input) / "sliding_block" / "sliding_block.xml")
found = [abs(one) for one in force(rows[-1])]
print(f"Suture: normal force {found[1]:.2f}, tangential force {found[0]:.2f} N/mm")
check("all steps", (code, summary["verified"]), (0, True))
check("normal force", found[1] / normal - 1, lambda part: abs(part) < 0.006)
check("tangential force", found[0] / tangential - 1, lambda part: abs(part) < 0.006)
finish()
