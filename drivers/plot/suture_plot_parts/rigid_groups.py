"""Panels of steps.png on rigid groups: rotation with moment of those that turn, travel with force of those that move along; transmission errors."""
import csv

import numpy as np

from .style import LINES, PlotError

COLUMNS = ("time", *(f"{kind}_{axis}" for kind in ("displacement", "rotation") for axis in "xyz"), *(kind + axis for kind in "fm" for axis in "xyz"))
ROUND_OFF = 1e-9  # of the largest motion, below which a group counts as held
# Title of each panel, its columns in rigid_groups.csv, and the motion that a group in it has.
PANELS = (("rotation [rad]", "rotation_{}", "rotation_{}"), ("travel [{length}]", "displacement_{}", "displacement_{}"),
          ("moment [{moment}]", "m{}", "rotation_{}"), ("force on group [{force}]", "f{}", "displacement_{}"))


def group_tables(path):
    """{name of the group: its columns}; empty if the file does not exist."""
    if not path.is_file():
        return {}
    try:
        with open(path, newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        names = dict.fromkeys(row["group"] for row in rows)
        return {name: {column: np.array([float(row[column]) for row in rows if row["group"] == name]) for column in COLUMNS} for name in names}
    except (KeyError, TypeError, ValueError) as error:
        raise PlotError(f"{path} is damaged: {error}") from error


def size(table, columns):
    return max(np.abs(table[columns.format(axis)]).max(initial=0.0) for axis in "xyz")


def group_panels(run):
    """[(label of the panel, [(group, axis, times, values, colour)])], without panels that would be empty; names of groups beyond the colours.

    A line shows the component along the axis with the largest value.
    """
    tables = run.groups
    largest = {"rotation_{}": max((size(table, "rotation_{}") for table in tables.values()), default=0.0),
               "displacement_{}": max((size(table, "displacement_{}") for table in tables.values()), default=0.0)}
    largest["displacement_{}"] = max(largest["displacement_{}"], run.summary.get("max_displacement") or 0.0)
    moving = [name for name, table in tables.items() if any(size(table, motion) > ROUND_OFF * most for motion, most in largest.items())]
    colours, left_out = dict(zip(moving, LINES)), moving[len(LINES):]
    units = {"length": run.length_unit, "force": run.force_unit, "moment": f"{run.force_unit} {run.length_unit}".strip()}
    panels = []
    for label, columns, motion in PANELS:
        lines = []
        for name, colour in colours.items():
            table = tables[name]
            if size(table, motion) > ROUND_OFF * largest[motion]:
                axis = max("xyz", key=lambda axis: np.abs(table[columns.format(axis)]).max(initial=0.0))  # noqa: B023
                lines.append((name, axis, table["time"], table[columns.format(axis)], colour))
        if lines:
            panels.append((label.format(**units), lines))
    return panels, left_out


def transmission_tables(folder):
    """{name of the file without its beginning: (times, errors)} of transmission_<name>.csv"""
    tables = {}
    for path in sorted(folder.glob("transmission_*.csv")):
        try:
            with open(path, newline="", encoding="utf-8") as file:
                rows = list(csv.DictReader(file))
            tables[path.stem[len("transmission_"):]] = tuple(np.array([float(row[column]) for row in rows]) for column in ("time", "error"))
        except (KeyError, TypeError, ValueError) as error:
            raise PlotError(f"{path} is damaged: {error}") from error
    return tables


def transmission_panels(run):
    """As group_panels(): one panel per transmission, in whose axis label is its unit."""
    settings = ((run.summary.get("parameters") or {}).get("Output") or {}).get("Transmissions") or {}
    turning = {safe(name): str(one.get("Driven Motion", "")).startswith("Rotation") for name, one in settings.items() if isinstance(one, dict)}
    panels = []
    for (name, (times, errors)), colour in zip(run.transmissions.items(), LINES):
        unit = "rad" if turning.get(name, True) else run.length_unit
        panels.append((f"error [{unit}]", [(f"transmission {name}", "", times, errors, colour)]))
    return panels


def safe(name):
    """The name as it is in the name of the file."""
    return "".join(c if c.isascii() and (c.isalnum() or c == "-") else "_" for c in name)
