"""A stopped run leaves a checkpoint from which another number of ranks, with another partition, continues.

restart.py --solve PROGRAM --mpirun "mpirun ..." --work DIR --input FOLDER
"""
import json
import pathlib
import re
import shlex
import signal
import subprocess
import time

import harness
from harness import SLOWER, arguments, check, finish, setting

options = arguments("--solve", "--input")
work = options.work
OPEN = pathlib.Path(options.input) / "tunnel" / "tunnel_open.xml"
OTHER = pathlib.Path(options.input) / "two_blocks" / "two_blocks.xml"


def command(ranks, scene, name, *words):
    return harness.command(options.solve, ranks, scene, "--output", work / name, *words)


def run(ranks, scene, name, *words):
    code, text = harness.run(options.solve, ranks, scene, "--output", work / name, *words)
    summary = work / name / "summary.json"
    return code, text, json.loads(summary.read_text()) if summary.exists() else {}


whole = run(2, OPEN, "whole")[2]

# Not converged after one iteration: exit code 4 and a checkpoint, from which one rank with METIS continues.
code, text, cut = run(2, OPEN, "cut", *setting("Outer Solver/Maximum Iterations", 1))
check("exit code of a run that did not converge", code, 4)
check("its summary reports it", cut["converged"], False)
check("its last lines list the checkpoint", re.findall(r"\n   \S*cut/  .*", text), lambda lines: len(lines) == 1 and " checkpoint.h5 " in lines[0])
check("it recommends more iterations, and no other tolerance", ("from where this run ended" in text, "smaller Outer Solver/Tolerance" in text), (True, False))
words = shlex.split(re.search(r"to try: .*: (--restart .*)", text)[1])
code, _, more = run(2, OPEN, "more", *words)
check("what it recommends converges", (code, more["converged"], more["contact"]["active"]), (0, True, whole["contact"]["active"]))
code, _, rest = run(1, OPEN, "rest", "--restart", str(work / "cut" / "checkpoint.h5"), *setting("Partition/Type", "METIS"))
check("exit code of the restarted run", code, 0)
check("it needs fewer iterations", rest["outer"]["pcg_total"], lambda n: n < whole["outer"]["pcg_total"])
check("it solves no auxiliary problem", rest["auxiliary"]["iterations"], 0)
check("closed pairs", rest["contact"]["active"], whole["contact"]["active"])
check("energy", rest["energy"] / whole["energy"] - 1, lambda e: abs(e) < 1e-9)
check("largest displacement", rest["max_displacement"] / whole["max_displacement"] - 1, lambda e: abs(e) < 1e-6)

# Start from an earlier load step, in both formulations: 10 % more load changes the contact only slightly.
for name, method in (("groups", []), ("interface", setting("Formulation", "Contact On The Interface") + setting("Outer Solver/Type", "Active Set")
                                      + setting("Preconditioner/Type", "BDDC"))):
    method = method + setting("Outer Solver/Tolerance", "1e-10")
    code, _, first = run(2, OPEN, name + "_step_1", *method, *setting("Output/Checkpoint", "true"))
    check(name + ": first load step", code, 0)
    more = method + setting("Boundary Conditions/overburden/Value", "0.55e7")
    code, _, cold = run(2, OPEN, name + "_cold", *more)
    check(name + ": second load step at once", (code, cold["converged"]), (0, True))
    check(name + ": writes no checkpoint unless requested", (work / (name + "_cold") / "checkpoint.h5").exists(), False)
    code, _, warm = run(4, OPEN, name + "_warm", *more, "--restart", str(work / (name + "_step_1") / "checkpoint.h5"))
    check(name + ": second load step from the first", (code, warm["converged"]), (0, True))
    # The number of Newton steps may be equal: steps that change no pair cost one linear solve.
    pcg = [case["auxiliary"]["iterations"] + case["outer"]["pcg_total"] for case in (warm, cold)]
    check(name + ": it needs fewer iterations", pcg[0], lambda n: n < pcg[1])
    check(name + ": closed pairs", warm["contact"]["active"], cold["contact"]["active"])
    check(name + ": energy", warm["energy"] / cold["energy"] - 1, lambda e: abs(e) < 1e-9)

# Stopped by SIGUSR1, which mpirun forwards: exit code 75.
slow = setting("Outer Solver/Type", "Successive Approximation") + setting("Outer Solver/Maximum Iterations", 5000) + \
    setting("Outer Solver/Tolerance", "1e-13")
with open(work / "stopped.log", "w") as log:
    process = subprocess.Popen(command(2, OPEN, "stopped", *slow), stdout=log, stderr=log)
    until = time.time() + 60 * SLOWER
    while time.time() < until and "residual   active" not in (work / "stopped.log").read_text():
        time.sleep(0.2)  # the table has begun
    process.send_signal(signal.SIGUSR1)
    check("exit code of a run stopped on request", process.wait(timeout=60 * SLOWER), 75)
check("its last lines list the checkpoint", " checkpoint.h5 " in (work / "stopped.log").read_text(), True)
check("its summary's exit code", json.loads((work / "stopped" / "summary.json").read_text())["exit_code"], 75)
code, _, rest = run(4, OPEN, "resumed", "--restart", str(work / "stopped" / "checkpoint.h5"))
check("exit code of its restart", code, 0)
check("closed pairs of its restart", rest["contact"]["active"], whole["contact"]["active"])

# Files that are not checkpoints of this mesh.
code, text, _ = run(2, OTHER, "foreign", "--restart", str(work / "cut" / "checkpoint.h5"))
check("exit code for the checkpoint of another mesh", code, 3)
check("message for it", "another mesh" in text, True)
(work / "damaged.h5").write_bytes((work / "cut" / "checkpoint.h5").read_bytes()[:3000])
code, text, _ = run(2, OPEN, "damaged", "--restart", str(work / "damaged.h5"))
check("exit code for a truncated checkpoint", code, 3)
code, text, _ = run(2, OPEN, "none", "--restart", str(work / "nothing.h5"))
check("exit code for a missing checkpoint", code, 3)

finish()
