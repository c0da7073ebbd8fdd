"""steps.png: contact forces, rigid groups, states of pairs and work over the time of load steps."""
import numpy as np
from matplotlib.ticker import MaxNLocator

from .friction import SLIP, STICK
from .rigid_groups import group_panels, transmission_panels
from .style import GREY, LINES, PALETTE, headline, shortened, with_panels, wrapped

CLOSED = "#cfe0ee"
MOST_MARKS = 40  # largest number of steps with individual markers
SEVERAL = 4  # names of contacts per row of the legend


def steps_figure(run):
    """\\return  figure, names of contacts and rigid groups that are not plotted"""
    table = run.steps
    names, left_out = contacts(run)
    axes_named = [axis for axis in "xyz"[:run.dimension] if any(np.any(force(table, name, axis)) for name in names)]
    of_groups, groups_left_out = group_panels(run)
    of_groups = of_groups + transmission_panels(run)
    panels = len(axes_named) + len(of_groups) + 2
    figure, axes = with_panels(panels, 1, (7.0, 1.75 * panels + 1.0), sharex=True, squeeze=False)
    axes = axes[:, 0]
    for axis, component in zip(axes, axes_named):
        for name, colour in zip(names, LINES):
            line(axis, table, force(table, name, component), colour, shortened(name))
        axis.set_ylabel(f"force {component} [{run.force_unit}]")
    if axes_named and len(names) > 1:
        legend(axes[0], min(len(names), SEVERAL))
    for axis, (label, lines) in zip(axes[len(axes_named):], of_groups):
        for name, component, times, values, colour in lines:
            begins_at_zero = not name.startswith("transmission ")
            line(axis, {**table, "time": times}, values, colour, shortened(name) + (f", {component}" if component else ""), starts=begins_at_zero)
        axis.set_ylabel(label)
        legend(axis, min(len(lines), SEVERAL))
    states(axes[-2], table, run.summary["contact"].get("pairs", 0))
    work(axes[-1], table, run)
    for axis in axes:
        axis.margins(x=0.02)
        axis.yaxis.set_major_locator(MaxNLocator(nbins=5))
    axes[-1].set_xlabel("time")
    figure.align_ylabels(axes)
    count = len(table["time"])
    headline(figure, wrapped(f"{run.title}: {count} load step{'s' if count != 1 else ''}{run.state_of_answer}", 85))
    return figure, left_out + groups_left_out


def contacts(run):
    """Names of the contacts with the largest forces, one per colour, and names of the others."""
    names = [column[len("force "):-len(" x")] for column in run.steps if column.startswith("force ") and column.endswith(" x")]
    size = {name: max(np.abs(force(run.steps, name, axis)).max() for axis in "xyz") for name in names}
    shown = sorted(names, key=lambda name: -size[name])[:len(LINES)]
    return [name for name in names if name in shown], [name for name in names if name not in shown]


def force(table, name, axis):
    return table[f"force {name} {axis}"]


def line(axis, table, values, colour, label, style="-", starts=True):
    """`starts`: from zero at time 0, if the path begins there."""
    times = table["time"]
    if starts and abs(times[0] - table["length"][0]) <= 1e-9 * times[0]:
        times, values = np.concatenate([[0.0], times]), np.concatenate([[0.0], values])
    axis.axhline(0.0, color=GREY, lw=0.6, zorder=1)
    axis.plot(times, values, color=colour, ls=style, marker="o" if len(times) <= MOST_MARKS else None, ms=3, label=label)


def states(axis, table, pairs):
    """Pairs by their state at the end of each step, plotted over the step; the remaining pairs are open."""
    edges = np.concatenate([[table["time"][0] - table["length"][0]], table["time"]])
    base = np.zeros(len(table["time"]))
    for name, count, colour in (("stick", table["sticking"], STICK), ("slip", table["slipping"], SLIP),
                                ("closed without friction", table["active"] - table["sticking"] - table["slipping"], CLOSED)):
        if np.any(count):
            axis.stairs(base + count, edges, baseline=base, fill=True, color=colour, lw=0, label=name)
            axis.stairs(base + count, edges, baseline=None, color=GREY, lw=0.7)
        base = base + count
    axis.axhline(pairs, color=GREY, lw=0.8, ls="--", label="all pairs")
    axis.set_ylim(0, 1.06 * max(pairs, 1))
    axis.set_ylabel("pairs")
    legend(axis, 4)


def work(axis, table, run):
    line(axis, table, table["external_work"], PALETTE[7], "external")
    line(axis, table, table["stored_energy"], PALETTE[4], "stored", "--")
    if np.any(table["dissipated_work"]):
        line(axis, table, table["dissipated_work"], PALETTE[5], "dissipated by friction")
    axis.set_ylabel(f"work [{run.force_unit} {run.length_unit}]")
    legend(axis, 3)


def legend(axis, columns):
    axis.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=columns, borderaxespad=0.0, fontsize=8)
