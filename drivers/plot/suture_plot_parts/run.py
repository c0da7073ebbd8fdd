"""The output folder of a run."""
import csv
import datetime
import math
from pathlib import Path

import numpy as np

from .grid import Grid, looked_up
from .rigid_groups import group_tables, transmission_tables
from .style import PlotError
from .summary import read_summary

STEP_COLUMNS = ("time", "length", "active", "sticking", "slipping", "external_work", "stored_energy", "dissipated_work")


def last(folder, pattern):
    files = sorted(folder.glob(pattern))
    return files[-1] if files else None


class RunFolder:
    """Everything that suture_solve wrote into a folder.

    `fields` and `contact` are None if the run wrote no fields, because of its settings or an early failure.
    """

    def __init__(self, folder, step=None):
        """\\param step  number of the load step whose fields are read, from 1; default: the last step"""
        self.folder = Path(folder)
        self.summary = self._summary(folder)
        self.steps = step_table(self.folder / "steps.csv") if self.summary.get("load_steps") else {}
        self.groups = group_tables(self.folder / "rigid_groups.csv") if self.steps else {}
        self.transmissions = transmission_tables(self.folder) if self.steps else {}
        self.step = self._step(step)
        # A run without fields may share the folder with fields of an earlier run.
        wanted = self.parameter("Output", "Fields", default=True) is not False
        place = "*" if self.step is None else f"{self.step - 1:04d}"
        fields = last(self.folder, f"fields_{place}.vtkhdf") if wanted else None
        if fields is None and wanted and self.summary["exit_code"] == 0:
            raise PlotError(f"'{folder}' has no fields_{place}.vtkhdf, although its run wrote fields (summary.json: Output/Fields is true)")
        self.fields = Grid(fields) if fields else None
        if fields and self.fields.mesh_hash and self.fields.mesh_hash != self.summary.get("mesh_hash", self.fields.mesh_hash):
            raise PlotError(f"{fields} is of another mesh than summary.json: its run has hash {self.fields.mesh_hash}, "
                            f"that of the summary {self.summary['mesh_hash']}")
        # The file of the same step: a step without pairs has none.
        contact = self.folder / fields.name.replace("fields", "contact", 1) if fields else None
        self.contact = Grid(contact) if contact and contact.is_file() else None
        self.history = self._history(self.folder / "history.csv")
        self.title = self.summary.get("title") or Path(self.summary.get("scene") or "").stem or "untitled"
        self.units = ([part.strip() for part in str(self.summary.get("units", "")).split(",")] + ["", "", ""])[:3]
        self.length_unit, self.force_unit, self.stress_unit = self.units
        self.model = self.parameter("Model", default="Plane Strain")
        self.dimension = self.summary.get("dimension", 2)
        self.moving = self.parameter("Motion", default="Small") == "Moving"  # bodies move far; contact pairs are those of the present shapes
        self.axes = ("r", "axis y") if self.model == "Axisymmetric" else ("x", "y")
        # Suffix of every title, since a plot of an unfinished run must be recognisable by itself.
        self.state_of_answer = "" if self.good and not self.coarse else f"  ({self.verdict})".replace("NOT ", "NOT\u00a0")
        self.state = self.state_of_answer + (f"  ({self.words_of_step})" if self.step is not None else "")

    def _summary(self, folder):
        if not self.folder.is_dir():
            raise PlotError(f"there is no folder '{folder}'")
        path = self.folder / "summary.json"
        if not path.is_file():
            if (self.folder / "study.json").is_file():
                raise PlotError(f"'{folder}' is the folder of a study: 'suture_plot {folder}' plots it")
            if (self.folder / "summary.previous.json").is_file():
                raise PlotError(f"'{folder}' has no summary.json: its last run did not finish (summary.previous.json is of the run before)")
            raise PlotError(f"'{folder}' has no summary.json: is it the output folder of a finished run (suture_solve SCENE.xml --output DIR)?")
        self.written = datetime.datetime.fromtimestamp(path.stat().st_mtime)
        return read_summary(path)

    def _step(self, step):
        """The chosen step; None if its fields are those of the final solution."""
        if step is None:
            return None
        count = len(self.steps.get("time", []))
        if count == 0:
            raise PlotError(f"--step: the run of '{self.folder}' has no load steps")
        if not 1 <= step <= count:
            raise PlotError(f"--step {step}: the run of '{self.folder}' has the load steps 1 to {count}")
        return step if step < count else None

    @property
    def words_of_step(self):
        return f"load step {self.step} of {len(self.steps['time'])}, t = {self.steps['time'][self.step - 1]:g}"

    @property
    def extremes(self):
        """Extremes of summary.json, which belong to the last load step."""
        found = self.summary.get("extremes", {})
        return found if self.step is None else {key: value for key, value in found.items() if key == "stresses"}

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
        return looked_up(self.summary["parameters"], path, default)

    @property
    def coarse(self):
        """True for a valid solution whose error is larger than the list Accuracy of the scene allows."""
        return (self.summary["exit_code"] == 4 and bool((self.summary.get("accuracy") or {}).get("limit")) and self.summary["converged"]
                and self.summary.get("verified") is not False and not self.summary.get("neutral_motions"))

    @property
    def good(self):
        return self.coarse or self.summary["exit_code"] == 0 and self.summary["converged"] and self.summary.get("verified") is not False

    @property
    def verdict(self):
        if self.coarse:
            return "ACCURACY NOT REACHED"
        if self.good:
            return "converged and verified" if self.summary.get("verified") else "converged"
        if not self.summary["converged"]:
            return "NOT CONVERGED"
        return "NOT VERIFIED" if self.summary.get("verified") is False else "NOT DETERMINED" if self.summary.get("neutral_motions") else "FAILED"

    def probes(self):
        return sorted(self.folder.glob("probe_*.csv"))


def step_table(path):
    """Columns of steps.csv; empty if the file does not exist."""
    if not path.is_file():
        return {}
    try:
        with open(path, newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        table = {name: np.array([float(row[name]) for row in rows]) for name in (rows[0] if rows else {})}
        lacking = [name for name in STEP_COLUMNS if rows and name not in table]
        if lacking:
            raise PlotError(f"{path} has no column '{lacking[0]}'")
        return table
    except (TypeError, ValueError) as error:
        raise PlotError(f"{path} is damaged: {error}") from error


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
