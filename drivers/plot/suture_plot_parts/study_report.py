"""report.html of a study: its plots and the table of its runs."""
import os
from dataclasses import dataclass
from pathlib import Path

from .html import esc, figure, number, page, table


@dataclass
class Plot:
    name: str
    caption: str
    path: Path


def cell(value):
    return "" if value is None else number(value) if isinstance(value, (int, float)) and not isinstance(value, bool) else esc(value)


def study_report(runs, plots, folder):
    """Writes the page under a temporary name and renames it. \\return its path"""
    title, failed = runs.study["title"], len(runs.failed)
    state = ('<div class="verdict" id="banner"><strong>Every run has a solution</strong>' if not failed else
             f'<div class="verdict bad" id="banner"><strong>{number(failed)} of {number(len(runs.all))} runs without a solution</strong>They are marked in '
             'red below, and by crosses at the upper edge of the plots.') + "</div>\n"
    pictures = "".join(figure(Plot(path.stem, name, path), title) for name, path in plots)
    head = [*runs.sweeps, *(["failure"] if failed else []), *runs.columns]
    rows = []
    for row in runs.all:
        bad = row["exit_code"] != 0
        mark = (lambda text: f'<span class="fails">{text}</span>') if bad else (lambda text: text)
        cells = [cell(value) for value in [*row["cells"], *[None] * len(runs.columns)][:len(runs.columns)]]
        failure = [f'<span class="fails">FAILED: exit code {number(row["exit_code"])}</span> {esc(row.get("failure", ""))}'] if bad else [""]
        rows.append((*(mark(esc(label)) for label in row["labels"]), *(failure if failed else []), *cells))
    width = len(runs.sweeps)
    numeric = range(len(head) - len(runs.columns), len(head))
    sections = [("pictures", "Plots", pictures or '<p class="soft">None.</p>'),
                ("runs", "Runs", table(head, rows, numeric=numeric, long=(width,) if failed else ()))]
    path = folder / "report.html"
    partial = path.with_name(path.name + ".part")
    partial.write_text(page(title, f"<h1>{esc(title)}</h1>\n<p class=\"soft\">A study of {number(len(runs.all))} runs.</p>\n{state}", sections), encoding="utf-8")
    os.replace(partial, path)
    return path
