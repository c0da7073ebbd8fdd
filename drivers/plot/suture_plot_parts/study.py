"""Plots of a study."""
import json

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator

from .log_axis import logarithmic_ticks

# Okabe and Ito's palette, suitable for colour-blind readers; with more lines than colours, only the markers differ.
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#8A7A00"]
MARKERS = ["o", "s", "^", "D", "v", "P", "h", "*"]
STYLE = {
    "savefig.dpi": 160, "font.size": 9, "axes.titlesize": 10, "axes.linewidth": 0.6, "axes.spines.top": False, "axes.spines.right": False,
    "lines.linewidth": 1.2, "lines.markersize": 4, "legend.frameon": False
}


def number(text):
    try:
        return float(text)
    except (TypeError, ValueError):
        return None


# Columns that every study can have, with their units (input/studies/README.md).
WORDS = {"seconds": "total time [s]", "solve_seconds": "time of the solve [s]", "setup_seconds": "time of the setup [s]",
         "peak_mb": "peak memory per process [MB]", "dofs": "unknowns", "pcg": "PCG iterations", "outer_pcg": "PCG iterations of the outer steps"}


def words(column):
    """Title of an axis or a panel."""
    return WORDS.get(column, column.replace("_", " "))


class Table:
    """Runs of a study: `rows` with a solution, `failed` without."""

    def __init__(self, path):
        with open(path, encoding="utf-8") as file:
            self.study = json.load(file)
        self.sweeps = [sweep["name"] for sweep in self.study["sweeps"]]
        self.columns = self.study["columns"]
        self.all = self.study["rows"]
        self.rows = [row for row in self.all if row["exit_code"] == 0]
        self.failed = [row for row in self.all if row["exit_code"] != 0]

    def value(self, row, name):
        """The label of a sweep or the value of a column; None if a failed run has none."""
        if name in self.sweeps:
            return row["labels"][self.sweeps.index(name)]
        at = self.columns.index(name)
        return row["cells"][at] if at < len(row["cells"]) else None

    def label(self, row, plot):
        return ", ".join(f"{by} {self.value(row, by)}" for by in plot["by"])

    def positions(self, name):
        """x -> position on the axis: the value if all are numbers, else an index; and the tick labels, or None."""
        values = [self.value(row, name) for row in self.rows] + [self.value(row, name) for row in self.failed if name in self.sweeps]
        if all(number(value) is not None for value in values):
            return {value: number(value) for value in values}, None
        if name in self.sweeps:  # in study order
            order = [label for label in self.study["sweeps"][self.sweeps.index(name)]["labels"] if label in values]
        else:
            order = sorted(set(values), key=str)
        return {value: i for i, value in enumerate(order)}, order


def lines(table, plot, column):
    """Label of the line -> [(x value, mean, least, largest)], in the order of the rows; empty for a line of failed runs only."""
    groups = {}
    for row in table.all:
        points = groups.setdefault(table.label(row, plot), {})
        y = number(table.value(row, column)) if row["exit_code"] == 0 else None
        if y is not None and not (plot["logarithmic_y"] and y <= 0):
            points.setdefault(table.value(row, plot["x"]), []).append(y)
    return {label: [(x, sum(ys) / len(ys), min(ys), max(ys)) for x, ys in points.items()] for label, points in groups.items()}


def mark_front(panel, table, plot, column, place):
    """A line through the runs that no other run beats in both x and y (less is better)."""
    points = sorted((place[table.value(row, plot["x"])], number(table.value(row, column))) for row in table.rows
                    if number(table.value(row, column)) is not None)
    front, least = [], float("inf")
    for x, y in points:
        if y < least:
            front.append((x, y))
            least = y
    if front:
        panel.plot(*zip(*front), color="0.3", linewidth=4, alpha=0.25, solid_capstyle="round", zorder=0, label="Pareto front")


def mark_failed(panel, table, plot, place, colours):
    """Crosses of failed runs at the upper edge, side by side for equal x. \\return number of runs without a position"""
    seen, nowhere = {}, 0
    for row in table.failed:
        x = place.get(table.value(row, plot["x"]))
        if x is None:
            nowhere += 1
            continue
        beside = seen.setdefault(x, [])
        label = table.label(row, plot)
        if label in beside:
            continue
        # Stacked vertically, so that crosses of different lines do not overlap.
        panel.plot([x], [1.0 - 0.055 * len(beside)], "x", ms=7, mew=2.0, color=colours[label], transform=panel.get_xaxis_transform(), clip_on=False,
                   zorder=5, gid="failed")
        beside.append(label)
    return nowhere


def ticks_of(panel, plot, place, ticks, width):
    """Ticks that do not overlap: on a logarithmic scale only those with enough space; long labels are rotated."""
    if ticks is not None:
        longest = max(map(len, map(str, ticks)))
        turned = longest * len(ticks) > 13 * width
        panel.set_xticks(range(len(ticks)), [str(tick) for tick in ticks], **({"rotation": 30, "ha": "right", "rotation_mode": "anchor"} if turned else {}))
        if turned and len(ticks) > 5 * width:
            panel.tick_params(axis="x", labelsize=6)
        panel.set_xlim(-0.4, len(ticks) - 0.6)
        return
    if not plot["logarithmic_x"]:
        panel.xaxis.set_major_locator(MaxNLocator(nbins=6))
        return
    panel.set_xscale("log")
    values = sorted(set(place.values()))
    low, high = values[0], values[-1]
    factors = [b / a for a, b in zip(values, values[1:])]
    # On a logarithmic scale the space between two ticks depends on their ratio; a label of six characters takes 0.45 inches.
    if low > 0 and len(values) <= 8 and (not factors or min(factors) > (high / low)**(0.5 / (0.75 * width))):
        panel.set_xticks(values, [f"{x:g}" for x in values])
        panel.minorticks_off()
    else:
        logarithmic_ticks(panel.xaxis, low, high)


def study_figure(table, plot):
    plt.rcParams.update(STYLE)
    place, ticks = table.positions(plot["x"])
    columns = plot["y"]
    width = 4.2
    figure, panels = plt.subplots(1, len(columns), figsize=(width * len(columns) + 0.4, 3.2), squeeze=False, layout="constrained")
    nowhere = 0
    for panel, column in zip(panels[0], columns):
        drawn = lines(table, plot, column)
        colours = {label: COLOURS[i % len(COLOURS)] for i, label in enumerate(drawn)}
        for i, (label, points) in enumerate(drawn.items()):
            points = sorted(points, key=lambda point: place[point[0]])
            x, y = [place[p[0]] for p in points], [p[1] for p in points]
            panel.plot(x, y, color=colours[label], marker=MARKERS[(i // len(COLOURS) + i) % len(MARKERS)], label=label or None)
            if any(p[3] > p[2] for p in points):
                panel.vlines(x, [p[2] for p in points], [p[3] for p in points], color=colours[label], linewidth=2.5, alpha=0.4)
        if plot.get("pareto"):
            mark_front(panel, table, plot, column, place)
        panel.set_title(words(column), loc="left", pad=10)
        panel.set_xlabel(words(plot["x"]))
        ticks_of(panel, plot, place, ticks, width)
        if plot["logarithmic_y"] and any(drawn.values()):
            panel.set_yscale("log")
            logarithmic_ticks(panel.yaxis, *panel.get_ylim())
        else:
            values = [p[1] for points in drawn.values() for p in points]
            largest = max((p[3] for points in drawn.values() for p in points), default=0.0)
            panel.set_ylim(0, 1.08 * largest or 1.0)
            panel.yaxis.set_major_locator(MaxNLocator(nbins=6, integer=all(float(value).is_integer() for value in values)))
        nowhere = mark_failed(panel, table, plot, place, colours)
    handles, labels = panels[0][-1].get_legend_handles_labels()
    if not (plot["by"] or plot.get("pareto")):
        handles, labels = [], []
    if table.failed:
        handles.append(Line2D([], [], color="0.3", marker="x", ms=7, mew=2.0, ls="none"))
        labels.append(f"no solution: {len(table.failed)} of {len(table.all)} runs" + (f"\n({nowhere} of unknown {plot['x'].replace('_', ' ')})" if nowhere else ""))
    if handles:
        panels[0][-1].legend(handles, labels, loc="center left", bbox_to_anchor=(1.02, 0.5), fontsize=8)
    figure.suptitle(table.study["title"], x=0.01, ha="left", fontsize=11)
    return figure


def draw(table, plot, path):
    figure = study_figure(table, plot)
    figure.savefig(path)
    plt.close(figure)
