"""A scene before it is solved: the file that suture_solve --scene-data writes."""
import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from .grid import Grid, as_text, looked_up
from .style import PlotError

# Nodes of the faces of 3D bodies in the order of the file: vertices, mid-edge nodes, centre.
FACE_ORDER = {5: range(3), 9: range(4), 22: range(6), 23: range(8), 28: range(9)}


class SceneGrid(Grid):
    """Elements in 2D, outer faces in 3D, with the scene's resolved parameters."""

    def _read(self, file):
        record = file["Record"]
        self.dimension = int(record.attrs["dimension"][0])
        self.parameters = json.loads(as_text(record["Scene"][()]))
        self.input_path = as_text(record["InputPath"][()])
        if self.dimension == 3:
            self._order = FACE_ORDER
        super()._read(file)
        self.group_cells = {name: cells[:] for name, cells in record["GroupCells"].items()} if "GroupCells" in record else {}


class SceneData:
    """A scene before it is solved, with the attributes of a RunFolder that a drawing needs."""

    contact, step, steps, summary, state = None, None, {}, {}, ""

    def __init__(self, path):
        self.fields = SceneGrid(path)
        self.dimension = self.fields.dimension
        scene = Path(self.fields.input_path)
        self.title = self.parameter("Title", default="") or scene.stem or "untitled"
        self.units = ([part.strip() for part in str(self.parameter("Units", default="")).split(",")] + ["", "", ""])[:3]
        self.length_unit, self.force_unit, self.stress_unit = self.units
        self.model = self.parameter("Model", default="Plane Strain")
        self.axes = ("r", "axis y") if self.model == "Axisymmetric" else ("x", "y")

    def parameter(self, *path, default=None):
        return looked_up(self.fields.parameters, path, default)

    @property
    def folder(self):
        """Output folder of a run of this scene, as suture_solve chooses it."""
        return self.parameter("Output", "Folder", default="") or f"{Path(self.fields.input_path).stem}_out"


def solve_program():
    """suture_solve beside this program, else on the path."""
    beside = Path(sys.argv[0]).resolve().parent / "suture_solve"
    found = str(beside) if beside.is_file() and os.access(beside, os.X_OK) else shutil.which("suture_solve")
    if not found:
        raise PlotError("there is no suture_solve beside suture_plot or on the PATH, which reads the scene")
    return found


class SolveError(Exception):
    """suture_solve refused the scene; it has printed why."""

    def __init__(self, code):
        super().__init__(f"exit code {code}")
        self.code = code


def read_scene(path, assignments, plugins):
    """Reads a scene file, or a file of suture_solve --scene-data."""
    if not Path(path).is_file():
        raise PlotError(f"there is no file '{path}'")
    if Path(path).suffix == ".vtkhdf":
        if assignments or plugins:
            raise PlotError(f"'{path}' holds a scene that has been read; --set and --plugin need the scene file")
        return SceneData(path)
    with tempfile.TemporaryDirectory(prefix="suture_plot.") as folder:
        file = Path(folder) / "scene.vtkhdf"
        words = [solve_program(), str(path), "--scene-data", str(file), "--quiet"]
        for option, values in (("--set", assignments), ("--plugin", plugins)):
            for value in values:
                words += [option, value]
        code = subprocess.run(words, stdin=subprocess.DEVNULL, check=False).returncode
        if code != 0:
            raise SolveError(code)
        return SceneData(file)
