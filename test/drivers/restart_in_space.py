"""Stops and restarts of 3D runs: the iteration limit and SIGUSR1 leave checkpoints from which another number of ranks with other subdomains
continues; load steps; nested start.

restart_in_space.py --solve PROGRAM --mpirun "mpirun ..." --work DIR --input FOLDER
"""
import json
import pathlib
import signal
import subprocess
import time

import harness
from harness import SLOWER, arguments, check, finish, setting

options = arguments("--solve", "--input")
work = options.work
PRESS = pathlib.Path(options.input) / "press" / "press.xml"
# PETSc 3.18 on the mesh of the scene, 20 x 20 x 10 cells in each block: primal-dual active set, conjugate gradients, smoothed aggregation.
CLOSED, FORCE = 181, 0.00163489


def cells(n, m):
    return [f"Mesh/Boxes/{box}/Cells={{{n}, {n}, {m}}}" for box in ("lower", "upper")]


def run(ranks, name, *words):
    code, text = harness.run(options.solve, ranks, PRESS, "--output", work / name, *words)
    summary = work / name / "summary.json"
    return code, text, json.loads(summary.read_text()) if summary.exists() else {}


def is_reference(what, found):
    check(f"{what}: closed pairs", found["contact"]["active"], CLOSED)
    check(f"{what}: force", abs(found["contact"]["force"]["joint"][2]), lambda f: abs(f / FORCE - 1) < 1e-6)


def restart(name):
    return ["--restart", str(work / name / "checkpoint.h5")]


# The iteration limit: exit code 4, and a checkpoint.
code, _, found = run(2, "cut", *setting("Outer Solver/Maximum Iterations", 2))
check("exit code of a run that did not converge", (code, found["converged"]), (4, False))
code, _, found = run(1, "rest", *restart("cut"), *setting("Partition/METIS/Subdomains", 11))
check("exit code of its restart on one rank with other subdomains", (code, found["subdomains"]), (0, 11))
check("it needs few steps", found["outer"]["iterations"], lambda n: n <= 4)
is_reference("restart", found)

# Coarser meshes first; these need not match.
levels = ", ".join("; ".join(cells(*size)) for size in ((6, 3), (10, 5)))
code, text, nested = run(2, "nested", *setting("Outer Solver/Start", "Nested"), *setting("Outer Solver/Nested/Levels", f"{{{levels}}}"))
check("exit code of a nested start", (code, text.count("nested start: ")), (0, 2))
check("its levels", ["216 elements" in text, "1,000 elements" in text], [True, True])
is_reference("nested start", nested)
check("it needs few steps", nested["outer"]["iterations"], lambda n: n <= 5)  # 6 from the default start

# A load step started from the previous one.
SMALL = [word for one in cells(10, 5) for word in ("--set", one)] + setting("Outer Solver/Tolerance", "1e-10")
MORE = setting("Boundary Conditions/press/Value", "{0, 0, -0.005}")
check("exit code of a first load step", run(2, "step_1", *SMALL, *setting("Output/Checkpoint", "true"))[0], 0)
cold, warm = run(2, "step_2_cold", *SMALL, *MORE)[2], run(1, "step_2_warm", *SMALL, *MORE, *restart("step_1"))[2]
check("second load step: iterations", warm["outer"]["pcg_total"], lambda n: n < cold["outer"]["pcg_total"])
check("second load step: closed pairs", warm["contact"]["active"], cold["contact"]["active"])
check("second load step: energy", warm["energy"] / cold["energy"] - 1, lambda e: abs(e) < 1e-9)

# SIGUSR1 to a run that continues until a stop request; both formulations continue from its checkpoint.
BLOCKS = [word for one in cells(8, 6) for word in ("--set", one)] + setting("Partition/METIS/Subdomains", 16)
GROUPS = setting("Formulation", "Condensed Groups") + setting("Preconditioner/Type", "Neumann-Neumann")
ENDLESS = GROUPS + setting("Outer Solver/Type", "Chord") + setting("Outer Solver/Maximum Iterations", 100000) + setting("Outer Solver/Tolerance", "1e-17")
log = work / "stopped.log"
with open(log, "w") as output:
    process = subprocess.Popen(harness.command(options.solve, 2, PRESS, "--output", work / "stopped", *BLOCKS, *ENDLESS), stdout=output, stderr=output)
    until = time.time() + 60 * SLOWER
    while time.time() < until and process.poll() is None and "residual   active" not in log.read_text():
        time.sleep(0.1)  # the table has begun
    process.send_signal(signal.SIGUSR1)
    check("exit code of a run stopped on request", process.wait(timeout=60 * SLOWER), 75)
check("its summary's exit code", json.loads((work / "stopped" / "summary.json").read_text())["exit_code"], 75)
exact = run(2, "monolithic", *BLOCKS, *setting("Outer Solver/Type", "Monolithic"))[2]
for name, words in (("interface", []), ("groups", GROUPS + setting("Outer Solver/Type", "Semismooth Newton"))):
    code, _, found = run(1, f"resumed_{name}", *BLOCKS, *words, *setting("Outer Solver/Tolerance", "1e-10"), *restart("stopped"))
    check(f"{name}: exit code of its restart", code, 0)
    check(f"{name}: closed pairs of its restart", found["contact"]["active"], exact["contact"]["active"])
    check(f"{name}: energy of its restart", found["energy"] / exact["energy"] - 1, lambda e: abs(e) < 1e-9)
code, text, _ = run(2, "foreign", *restart("stopped"))
check("the checkpoint of another mesh is refused", (code, "another mesh" in text), (3, True))
finish()
