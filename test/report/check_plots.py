#!/usr/bin/python3
"""suture_plot on the report of the test program Fields: every picture is made and is not blank.

check_plots.py PROGRAM FOLDER [--wrong]      with --wrong also what cannot be drawn: missing files are named
"""
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import matplotlib.image
import numpy as np

plot, folder = sys.argv[1], Path(sys.argv[2])


def run(*arguments):
    done = subprocess.run([sys.executable, "-B", plot, *map(str, arguments)], capture_output=True, text=True, timeout=100)
    print(done.stdout + done.stderr, end="")
    return done


with tempfile.TemporaryDirectory() as out:
    assert run(folder, "--output", out, "--zoom", "0.5,1.5,0.5,1.5", "--factor", "20").returncode == 0
    for name in ("scene", "mesh", "deformation", "von_mises", "von_mises_zoom", "principal_stress", "principal_stress_zoom", "contact", "convergence"):
        image = matplotlib.image.imread(f"{out}/{name}.png")
        assert min(image.shape[:2]) > 300, f"{name}.png is too small: {image.shape}"
        ink = (image[..., :3].min(axis=2) < 0.9).mean()
        assert 0.01 < ink < 0.95, f"{name}.png has ink on {ink:.1%} of its area"
    assert Path(out, "report.html").stat().st_size > 100000

with tempfile.TemporaryDirectory() as out:
    assert run(folder, "--output", out).returncode == 0  # region and factor chosen by the program

if "--wrong" not in sys.argv:
    sys.exit(0)
with tempfile.TemporaryDirectory() as copy:
    for name in ("summary.json", "history.csv"):
        shutil.copy(folder / name, copy)
    lacking = run(copy)
    assert lacking.returncode == 3 and "fields_*.vtkhdf" in lacking.stderr
    Path(copy, "fields_0000.vtkhdf").write_text("no HDF5")
    damaged = run(copy)
    assert damaged.returncode == 3 and "fields_0000.vtkhdf" in damaged.stderr and "Traceback" not in damaged.stderr
nowhere = run("/nonexistent")
assert nowhere.returncode == 3 and "/nonexistent" in nowhere.stderr
outside = run(folder, "--output", tempfile.gettempdir(), "--zoom", "50,60,50,60")
assert outside.returncode == 3 and "no element lies in the region" in outside.stderr
assert run(folder, "--zoom", "1,0,0,1").returncode == 2
