"""A path of load steps: SIGUSR1 stops it after a step, and another number of ranks continues to the result of an uninterrupted run; files of
the path; a step that is not solved.

load_steps.py --solve PROGRAM --mpirun "mpirun ..." --work DIR --input FOLDER
"""
import csv
import json
import pathlib
import signal
import subprocess
import time

import harness
from harness import SLOWER, arguments, check, finish, setting

options = arguments("--solve", "--input")
work = options.work
SCENE = pathlib.Path(options.input) / "stick_slip_cycle" / "stick_slip_cycle.xml"
FINE = setting("Outer Solver/Tolerance", "1e-10")


def run(ranks, name, *words):
    code, text = harness.run(options.solve, ranks, SCENE, "--output", work / name, *FINE, *words)
    summary = work / name / "summary.json"
    return code, text, json.loads(summary.read_text()) if summary.exists() else {}


def steps(name):
    path = work / name / "steps.csv"
    return list(csv.DictReader(path.open())) if path.exists() else []


code, text, whole = run(1, "whole")
check("exit code", code, 0)
rows = steps("whole")
check("one row per step", len(rows), whole["load_steps"]["count"])
series = json.loads((work / "whole" / "fields.vtkhdf.series").read_text())["files"]
check("one file per step, with its time", [(f["name"], f["time"]) for f in series],
      [(f"fields_{i:04d}.vtkhdf", float(row["time"])) for i, row in enumerate(rows)])
check("they exist", all((work / "whole" / f["name"]).exists() for f in series), True)
check("times of the scene are ends of steps", {0.25, 0.5, 0.75, 1.0, 1.25} <= {float(row["time"]) for row in rows}, True)
check("work is balanced", whole["load_steps"]["work"]["imbalance"], lambda e: e < 1e-7)
check("it is part of the verdict", whole["verification"]["work"]["value"] <= whole["verification"]["work"]["bound"], True)
history = list(csv.DictReader((work / "whole" / "history.csv").open()))
check("steps in the history", {int(row["load_step"]) for row in history}, set(range(1, len(rows) + 1)))

# Stopped after t = 0.25.
with open(work / "stopped.log", "w") as log:
    process = subprocess.Popen(harness.command(options.solve, 2, SCENE, "--output", work / "stopped", *FINE,
                                               *setting("Load Steps/Largest Change", "0.06")), stdout=log, stderr=log)
    until = time.time() + 60 * SLOWER
    while time.time() < until and max((float(row.get("time") or 0) for row in steps("stopped")), default=0) <= 0.25:
        time.sleep(0.02)
    process.send_signal(signal.SIGUSR1)
    check("exit code of a path stopped on request", process.wait(timeout=60 * SLOWER), 75)
stopped = json.loads((work / "stopped" / "summary.json").read_text())
check("its summary says where", "stopped on request, after t = " in stopped["failure"], True)
before = steps("stopped")
check("the path is not complete", float(before[-1]["time"]), lambda t: 0.25 < t < 1.25)
code, text, _ = run(2, "since", "--restart", str(work / "stopped" / "checkpoint.h5"), *setting("Output/Displacements Since", 0.25))
check("exit code of a restart after the time of Displacements Since", code, 3)
check("message for it", "after t = 0.25, and has no displacements of that time" in text, True)
code, text, rest = run(1, "stopped", "--restart", str(work / "stopped" / "checkpoint.h5"), *setting("Partition/METIS/Subdomains", 6))
check("exit code of the rest", code, 0)
after = steps("stopped")
check("rows before are kept", [row["time"] for row in after[:len(before)]], [row["time"] for row in before])
check("its end", float(after[-1]["time"]), 1.25)
check("files of all steps", sorted(p.name for p in (work / "stopped").glob("fields_*.vtkhdf")), [f"fields_{i:04d}.vtkhdf" for i in range(len(after))])
for name in ("dissipated_work", "force sole x", "force sole y"):
    a, b = float(after[-1][name]), float(rows[-1][name])
    check(name + " as without a stop", a / b - 1, lambda e: abs(e) < 1e-2)  # other steps: not the same path
code, text, _ = run(1, "stopped", "--restart", str(work / "stopped" / "checkpoint.h5"))
check("exit code at the end of the path", code, 3)
check("message for it", "the checkpoint is at t = 1.25, but the last step ends at t = 1.25" in text, True)

# A scene without load steps into the same folder.
code, text = harness.run(options.solve, 1, SCENE.parents[1] / "sliding_pad" / "sliding_pad.xml", "--output", work / "stopped")
check("exit code of one step", code, 0)
check("files of the path are gone", sorted(p.name for p in (work / "stopped").glob("*fields*")), ["fields_0000.vtkhdf"])
check("its table, too", (work / "stopped" / "steps.csv").exists(), False)

# Too few iterations for the first step.
code, text, failed = run(2, "failed", *setting("Outer Solver/Maximum Iterations", 2), *setting("Load Steps/Halvings", 0))
check("exit code where a step is not solved", code, 4)
check("the step and its time are named", "load step 1, to t = 0.05:" in text, True)

finish()
