"""Runs of scenes with Motion = Moving: their tables, for the tests moving*.py."""
import csv
import json

import harness


def table(folder, name):
    """Rows of a CSV file of a run; none if the run has not written it."""
    path = folder / name
    return list(csv.DictReader(path.open())) if path.exists() else []


def solve(name, scene, *words, ranks=1):
    """Exit code, output, summary, rows of steps.csv and of frames.csv."""
    folder = harness.options.work / name
    code, text = harness.run(harness.options.solve, ranks, scene, "--output", folder, *words, timeout=300)
    path = folder / "summary.json"
    return code, text, json.loads(path.read_text()) if path.exists() else {}, table(folder, "steps.csv"), table(folder, "frames.csv")


def reactions(name):
    """Rows of reactions.csv of a run, by name: forces and moments of the last step."""
    return {row["name"]: row for row in table(harness.options.work / name, "reactions.csv")}


def force(row, contact="joint", axes="xy"):
    """Force of a contact on its side B in a row of steps.csv."""
    return [float(row[f"force {contact} {axis}"]) for axis in axes]


def motion(frames, body, column, time=None):
    """Motion of a body at the end of the path, or at a time."""
    rows = [row for row in frames if row["body"] == body and (time is None or float(row["time"]) == time)]
    return float(rows[-1][column])
