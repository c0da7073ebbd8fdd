#!/usr/bin/python3
"""suture_plot on the report of the test program Fields: every picture is made and is not blank; what cannot be drawn is named. Pictures are
drawn of one run; those on other numbers of ranks are read as the same. Regions and factors that the program chooses: drivers.report.

check_plots.py PROGRAM FOLDER OTHERS...
"""
import json
import shutil
import sys
import tempfile
from pathlib import Path

import h5py
import matplotlib.image
import numpy as np

plot, folder, others = sys.argv[1], Path(sys.argv[2]), map(Path, sys.argv[3:])
sys.path[:0] = [str(Path(plot).parent), str(Path(__file__).parents[1] / "drivers")]
from harness import forked  # noqa: E402
from suture_plot_parts.grid import Grid  # noqa: E402
from suture_plot_parts.run import RunFolder  # noqa: E402
from suture_plot_parts.steps import steps_figure  # noqa: E402


def run(*arguments):
    """Exit code and output."""
    code, text = forked(plot, *arguments)
    print(text, end="")
    return code, text


def cells(path):
    """Outlines and values of the cells as suture_plot reads them, sorted by place."""
    grid = Grid(path)
    order = np.lexsort(grid.centroids.round(9).T)
    return np.array(grid.outlines)[order], *(grid.cell_data[name][order] for name in ("Stress", "VonMises", "Subdomain", "Body"))


for other in others:
    for here, there in zip(cells(folder / "fields_0000.vtkhdf"), cells(other / "fields_0000.vtkhdf")):
        assert np.abs(here - there).max() <= 1e-12 * np.abs(here).max(), f"{other} is read otherwise than {folder}"


with tempfile.TemporaryDirectory() as out:
    assert run(folder, "--output", out, "--zoom", "0.5,1.5,0.5,1.5", "--factor", "20")[0] == 0
    for name in ("scene", "mesh", "deformation", "von_mises", "von_mises_zoom", "principal_stress", "principal_stress_zoom", "contact", "convergence"):
        image = matplotlib.image.imread(f"{out}/{name}.png")
        assert min(image.shape[:2]) > 300, f"{name}.png is too small: {image.shape}"
        ink = (image[..., :3].min(axis=2) < 0.9).mean()
        assert 0.01 < ink < 0.95, f"{name}.png has ink on {ink:.1%} of its area"
    assert Path(out, "report.html").stat().st_size > 100000
    assert "mobilisation" not in Path(out, "report.html").read_text()
    smooth = matplotlib.image.imread(f"{out}/contact.png").shape[0]

# The same with friction: its pictures have more panels, its report a table of friction.
rubbing = folder.parent / folder.name.replace("fields", "rubbing")
with tempfile.TemporaryDirectory() as out:
    Path(out, "steps.png").write_text("of an earlier run with load steps")
    assert run(rubbing, "--output", out)[0] == 0
    assert not Path(out, "steps.png").exists()
    height = matplotlib.image.imread(f"{out}/contact.png").shape[0]
    assert height > 1.3 * smooth, f"no panel of friction: contact.png is {height} pixels high, without friction {smooth}"
    assert "largest mobilisation" in Path(out, "report.html").read_text()

# The same as the last of two load steps: one more picture, and the fields of the requested step.
with tempfile.TemporaryDirectory() as path:
    shutil.copytree(rubbing, path, dirs_exist_ok=True)
    for kind in ("fields", "contact"):
        shutil.copy(Path(path, f"{kind}_0000.vtkhdf"), Path(path, f"{kind}_0001.vtkhdf"))
    with h5py.File(Path(path, "fields_0001.vtkhdf"), "a") as file:
        file["VTKHDF/CellData/VonMises"][...] *= 3.0
    summary = json.loads(Path(path, "summary.json").read_text())
    summary["load_steps"] = {"count": 2, "time": 2.0, "work": {"external": 3.0, "stored": 2.0, "dissipated": 1.0, "step_error": 0.01},
                             "steps": [{"given_up": 0}, {"given_up": 1}]}
    Path(path, "summary.json").write_text(json.dumps(summary))
    columns = "step,time,length,active,sticking,slipping,external_work,stored_energy,dissipated_work,force <a> x,force <a> y,force <a> z"
    Path(path, "steps.csv").write_text(f"{columns}\n1,1,1,3,2,1,1,1,0,1,-2,0\n2,2,1,2,0,2,3,2,1,2,-2,0\n")
    steps = RunFolder(path)
    forces, states, work = steps_figure(steps)[0].axes[0], *steps_figure(steps)[0].axes[-2:]
    assert len(steps_figure(steps)[0].axes) == 4
    assert forces.lines[-1].get_xydata().tolist() == [[0, 0], [1, 1], [2, 2]], forces.lines[-1].get_xydata()
    assert [text.get_text() for text in states.get_legend().get_texts()] == ["stick", "slip", "all pairs"]
    assert work.lines[-1].get_ydata().tolist() == [0, 0, 1]
    assert np.allclose(steps.fields.cell_data["VonMises"], 3 * RunFolder(path, 1).fields.cell_data["VonMises"])
    assert RunFolder(path, 2).state == steps.state and "load step 1 of 2, t = 1" in RunFolder(path, 1).state
    assert run(path, "--step", "1")[0] == 0
    assert "Plots of fields show load step 1 of 2" in Path(path, "report.html").read_text()
    assert 0.01 < (matplotlib.image.imread(f"{path}/steps.png")[..., :3].min(axis=2) < 0.9).mean() < 0.95
    code, text = run(path, "--step", "3")
    assert code == 3 and "load steps 1 to 2" in text
    Path(path, "steps.csv").write_text("step,time\n1,1\n")
    code, text = run(path)
    assert code == 3 and "steps.csv has no column 'length'" in text
code, text = run(folder, "--step", "1")
assert code == 3 and "has no load steps" in text

with tempfile.TemporaryDirectory() as copy:
    for name in ("summary.json", "history.csv"):
        shutil.copy(folder / name, copy)
    code, text = run(copy)
    assert code == 3 and "fields_*.vtkhdf" in text
    Path(copy, "fields_0000.vtkhdf").write_text("no HDF5")
    code, text = run(copy)
    assert code == 3 and "fields_0000.vtkhdf" in text and "Traceback" not in text
code, text = run("/nonexistent")
assert code == 3 and "/nonexistent" in text
code, text = run(folder, "--output", tempfile.gettempdir(), "--zoom", "50,60,50,60")
assert code == 3 and "no element lies in the region" in text
assert run(folder, "--zoom", "1,0,0,1")[0] == 2
