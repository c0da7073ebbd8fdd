"""The output folder of a run."""
import csv
import datetime
import math
from pathlib import Path

import numpy as np

from .grid import Grid
from .style import PlotError
from .summary import read_summary


def last(folder, pattern):
    files = sorted(folder.glob(pattern))
    return files[-1] if files else None


class RunFolder:
    """Everything that suture_solve left in a folder.

    `fields` and `contact` are None where the run wrote no fields: the scene switched them off, or the run failed before.
    """

    def __init__(self, folder):
        self.folder = Path(folder)
        self.summary = self._summary(folder)
        # Fields of an earlier run may lie in the folder of a run without.
        wanted = self.parameter("Output", "Fields", default=True) is not False
        fields = last(self.folder, "fields_*.vtkhdf") if wanted else None
        if fields is None and wanted and self.summary["exit_code"] == 0:
            raise PlotError(f"'{folder}' has no fields_*.vtkhdf, although its run wrote fields (summary.json: Output/Fields is true)")
        self.fields = Grid(fields) if fields else None
        if fields and self.fields.mesh_hash and self.fields.mesh_hash != self.summary.get("mesh_hash", self.fields.mesh_hash):
            raise PlotError(f"{fields} is of another mesh than summary.json: its run has hash {self.fields.mesh_hash}, "
                            f"that of the summary {self.summary['mesh_hash']}")
        contact = last(self.folder, "contact_*.vtkhdf")
        self.contact = Grid(contact) if fields and contact else None
        self.history = self._history(self.folder / "history.csv")
        self.title = self.summary.get("title") or Path(self.summary.get("scene") or "").stem or "untitled"
        self.units = ([part.strip() for part in str(self.summary.get("units", "")).split(",")] + ["", "", ""])[:3]
        self.length_unit, self.force_unit, self.stress_unit = self.units
        self.model = self.parameter("Model", default="Plane Strain")
        self.dimension = self.summary.get("dimension", 2)
        self.axes = ("r", "axis y") if self.model == "Axisymmetric" else ("x", "y")
        # Suffix of every title: a picture of an unfinished iteration must say so itself.
        self.state = "" if self.good else f"  ({self.verdict})".replace("NOT ", "NOT\u00a0")

    def _summary(self, folder):
        if not self.folder.is_dir():
            raise PlotError(f"there is no folder '{folder}'")
        path = self.folder / "summary.json"
        if not path.is_file():
            if (self.folder / "study.json").is_file():
                raise PlotError(f"'{folder}' is the folder of a study: 'suture_study_plot {folder}' draws it, and this program the runs in it")
            if (self.folder / "summary.previous.json").is_file():
                raise PlotError(f"'{folder}' has no summary.json: its last run did not finish (summary.previous.json is of the run before)")
            raise PlotError(f"'{folder}' has no summary.json: is it the output folder of a finished run (suture_solve SCENE.xml --output DIR)?")
        self.written = datetime.datetime.fromtimestamp(path.stat().st_mtime)
        return read_summary(path)

    @staticmethod
    def _history(path):
        if not path.is_file():
            return []
        with open(path, newline="", encoding="utf-8") as file:
            try:
                return [{name: float(value) if value != "" else math.nan for name, value in row.items()} for row in csv.DictReader(file)]
            except (TypeError, ValueError) as error:
                raise PlotError(f"{path} is damaged: {error}") from error

    def parameter(self, *path, default=None):
        value = self.summary["parameters"]
        for name in path:
            if not isinstance(value, dict) or name not in value:
                return default
            value = value[name]
        return value

    @property
    def good(self):
        return self.summary["exit_code"] == 0 and self.summary["converged"] and self.summary.get("verified") is not False

    @property
    def verdict(self):
        if self.good:
            return "converged and verified" if self.summary.get("verified") else "converged"
        if not self.summary["converged"]:
            return "NOT CONVERGED"
        return "NOT VERIFIED" if self.summary.get("verified") is False else "NOT DETERMINED" if self.summary.get("neutral_motions") else "FAILED"

    def probes(self):
        return sorted(self.folder.glob("probe_*.csv"))


def probe_table(path):
    """Columns of a probe's table: arrays, NaN where a field is empty; `body` is a list of names."""
    def number(field):
        return float(field) if field else math.nan

    try:
        with open(path, newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        return {name: [row[name] for row in rows] if name == "body" else np.array([number(row[name]) for row in rows]) for name in (rows[0] if rows else {})}
    except (TypeError, ValueError) as error:
        raise PlotError(f"{path} is damaged: {error}") from error
