"""Plots and report of the output folder of suture_study."""
import re
import sys
from pathlib import Path


def is_study(folder):
    """True for the folder of a study; a folder with summary.json is the one of a run."""
    folder = Path(folder)
    return (folder / "study.json").is_file() and not (folder / "summary.json").is_file()


def plot_study(program, folder, quiet):
    """Writes one picture per plot of the study, and report.html. Returns the exit code; errors name `program`."""
    from .study import Table, draw  # only for studies, since pyplot starts slowly
    from .study_report import study_report
    folder = Path(folder)
    try:
        table = Table(folder / "study.json")
    except (OSError, ValueError, KeyError, TypeError) as error:
        hint = "; 'suture_plot' plots the folder of a run" if (folder / "summary.json").is_file() else ""
        print(f"{program}: '{folder}' has no study.json of suture_study, or it is damaged: {error}{hint}", file=sys.stderr)
        return 3
    try:
        made = []
        for plot in table.study["plots"] if table.rows else []:
            path = folder / (re.sub(r"[^A-Za-z0-9]+", "_", plot["name"]).strip("_") + ".png")
            draw(table, plot, path)
            made.append((plot["name"], path))
        page = study_report(table, made, folder)
    except OSError as error:
        print(f"{program}: {error}", file=sys.stderr)
        return 5
    if not table.rows:
        print(f"{program}: no run has converged, nothing to plot", file=sys.stderr)
    if not quiet:
        for path in (*(path for _, path in made), page):
            print(path)
    return 0 if table.rows else 3
