"""Memory per subdomain when there are many: heap peaks with one-element subdomains, by glibc's counting library.

subdomain_memory.py --solve PROGRAM --mpirun "mpirun ..." --work DIR --input FOLDER

The slope of the peak over the number of subdomains is the memory per subdomain, without program, libraries and buffers. The counts do not
depend on the machine's load. libmemusage counts malloc, not the packed matrices, which use a separate allocator.
"""
import os
import pathlib
import re
import sys

from harness import SANITIZED, arguments, check, finish, run, setting

options = arguments("--solve", "--input")
if SANITIZED or not any(pathlib.Path(folder, "libmemusage.so").exists() for folder in ("/lib", "/usr/lib", *pathlib.Path("/lib").glob("*-linux-*"))):
    sys.exit(77)  # skipped: memory comes from another allocator, or cannot be counted
SCENE = pathlib.Path(options.input) / "studies" / "square.xml"
CELLS = (34, 54)  # per side: 1156 and 2916 subdomains, above 1000, where the coarse problem has one more level
# Bytes per subdomain over all ranks: 8310 on one rank, 8820 on two. Of these 3700 are matrices and factors, 1800 meshes and vectors of
# their unknowns, 2800 bookkeeping; see the table in input/studies/many_subdomains.md.
MOST = 9800


def peak(cells, ranks):
    """The largest heap of a process, in bytes."""
    words = [*setting("Mesh/Boxes/square/Cells", f"{{{cells}, {cells}}}"), *setting("Mesh/Boxes/square/Blocks", f"{{{cells}, {cells}}}"),
             "--output", options.work / f"{cells}_{ranks}", "--quiet"]
    code, text = run("env", ranks, "LD_PRELOAD=libmemusage.so", "MEMUSAGE_NO_TIMER=1", options.solve, SCENE, *words)
    peaks = [int(found) for found in re.findall(r"heap peak: (\d+)", text)]
    check(f"{cells} x {cells} subdomains, np{ranks}: solved and counted", (code, len(peaks) >= ranks), (0, True))
    return max(peaks, default=0)


os.environ.pop("LD_PRELOAD", None)
for ranks in (1, 2):
    few, many = (peak(cells, ranks) for cells in CELLS)
    slope = (many - few) / (CELLS[1] ** 2 - CELLS[0] ** 2)
    print(f"np{ranks}: {few} and {many} bytes, {slope:.0f} per subdomain")
    check(f"np{ranks}: {slope:.0f} bytes per subdomain over all ranks", slope, lambda found: 0 < ranks * found < MOST)

finish()
