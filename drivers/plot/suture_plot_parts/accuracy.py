"""accuracy.png: error of each mesh of an adaptive run over unknowns and over seconds, and the predicted cost of uniform refinement."""
import math

import numpy as np

from .log_axis import logarithmic_ticks
from .style import GREY, PALETTE, halo, headline, with_panels, wrapped

ADAPTIVE, UNIFORM, REQUESTED = PALETTE[4], PALETTE[5], PALETTE[2]
ORDERS = {1: "first", 2: "second", 3: "third"}
ROOM = 1.6  # factor by which logarithmic axes are wider than their values


def has_levels(run):
    return bool((run.summary.get("accuracy") or {}).get("levels"))


def is_energy(accuracy):
    """True if the error of the energy norm was requested."""
    return accuracy.get("quantity", "Energy").lower() == "energy"


class Levels:
    """The meshes of an adaptive run, one value per mesh. `spent`: seconds until the mesh is done, those of the earlier meshes included."""

    def __init__(self, accuracy):
        levels = accuracy["levels"]
        self.unknowns, self.error, self.seconds, self.estimate = (np.array([math.nan if level.get(key) is None else level[key] for level in levels],
                                                                           dtype=float) for key in ("unknowns", "error", "seconds", "estimate"))
        self.strict = np.array([bool(level.get("strict")) for level in levels])
        self.spent = np.cumsum(np.nan_to_num(self.seconds))
        self.of_energy = is_energy(accuracy)
        self.quantity = accuracy.get("quantity", "Energy")
        self.requested = accuracy.get("requested")
        # Meshes of uniform refinement that were solved: the first one and, if it is one, the second.
        self.measured = [0, 1] if len(levels) > 1 and levels[1].get("refinement") == "uniform" else [0]
        uniform = accuracy.get("uniform") or {}
        self.order, self.uniform_unknowns, self.uniform_seconds = (uniform.get(key) for key in ("order", "unknowns", "seconds"))

    @property
    def has_estimate(self):
        """True if an estimate of the energy error is to be drawn beside its bound."""
        return self.of_energy and bool(np.any(np.isfinite(self.estimate) & (self.estimate > 0)))

    @property
    def known(self):
        """True for meshes that can be drawn on logarithmic axes."""
        return np.isfinite(self.error) & (self.error > 0) & (self.unknowns > 0)

    def rate(self):
        """p of error ~ unknowns^-p, fitted to the meshes that grew, without the first; None for less than three of them."""
        grew = self.known.copy()
        grew[0] = False
        x, y = np.log(self.unknowns[grew]), np.log(self.error[grew])
        if len(x) < 3 or np.ptp(x) < math.log(2):
            return None
        slope = -np.polyfit(x, y, 1)[0]
        return slope if slope > 0 else None


def per_cent(value, digits=2):
    """A relative error as a text, without trailing zeros: 0.87 %."""
    text = f"{100 * value:.{digits}g}"
    return f"{float(text):g} %" if 1e-4 <= abs(float(text)) < 1e6 else f"{text} %"


def rounded_up(value, digits=2):
    """The value with so many digits, never smaller than it is: the text of a bound must not be below the bound."""
    if not (value > 0 and math.isfinite(value)):
        return value
    power = 10.0**(math.floor(math.log10(value)) - digits + 1)
    steps = value / power
    return (round(steps) if abs(steps - round(steps)) < 1e-9 * steps else math.ceil(steps)) * power


def rough(value):
    """A predicted number with two digits and separators."""
    return f"{float(f'{value:.2g}'):,.0f}" if value >= 100 else f"{value:.2g}"


def seconds_in_words(value, form=".2g"):
    """A duration in a unit that is easy to read."""
    for unit, size in (("years", 31557600.0), ("days", 86400.0), ("hours", 3600.0), ("minutes", 60.0)):
        if value >= 2 * size:
            return f"{float(f'{value / size:{form}}'):,g} {unit}"
    return f"{float(f'{value:{form}}'):,g} s"


def accuracy_figure(run):
    levels = Levels(run.summary["accuracy"])
    figure, (left, right) = with_panels(1, 2, (9.4, 3.9), sharey=True)
    panel(left, levels, levels.unknowns, levels.uniform_unknowns, lambda value: f"{value:,.0f}", rough)
    panel(right, levels, levels.spent, levels.uniform_seconds, seconds_in_words, seconds_in_words, levels.seconds)
    left.set_xlabel("unknowns of a mesh")
    right.set_xlabel("seconds since the start, all meshes so far")
    left.set_ylabel("error / energy norm of the solution" if levels.of_energy else "relative error")
    for axis in (left, right):
        logarithmic_ticks(axis.xaxis, *axis.get_xlim(), lambda value: f"{value:,g}" if value < 1e6 else f"{value:.0e}".replace("e+0", "e"))
    logarithmic_ticks(left.yaxis, *left.get_ylim(), lambda value: per_cent(value, 3))
    triangle(left, levels)
    right.legend(loc="upper left", bbox_to_anchor=(1.02, 1.0), borderaxespad=0.0, fontsize=8)
    headline(figure, wrapped(f"{run.title}: {outcome(run, levels)}{run.state_of_answer}", 110))
    return figure


def outcome(run, levels):
    """Error, unknowns and seconds of the last mesh in a few words."""
    last = levels.error[-1]
    if not levels.known[-1]:
        return "error of each mesh"
    size = f"at most {per_cent(rounded_up(last))}" if levels.strict[-1] else f"about {per_cent(last)}"
    what = "energy error" if levels.of_energy else f"error of {levels.quantity}"
    return f"{what} {size}, {levels.unknowns[-1]:,.0f} unknowns, {seconds_in_words(levels.spent[-1])}"


def panel(axis, levels, cost, predicted, words, rough_words, own=None):
    """Error over one kind of cost. `predicted`: that of uniform refinement; `words`, `rough_words`: texts of a cost; `own`: cost of each mesh
    alone, if `cost` sums over the meshes"""
    axis.set_xscale("log")
    axis.set_yscale("log")
    shown = levels.known & (cost > 0)
    x, y, strict = cost[shown], levels.error[shown], levels.strict[shown]
    axis.grid(lw=0.3, color="#cccccc")
    axis.plot(x, y, color=ADAPTIVE, zorder=3)
    if strict.any():
        axis.plot(x[strict], y[strict], "o", ms=5, color=ADAPTIVE, zorder=4, label="upper bound (strict)")
    if not strict.all():
        axis.plot(x[~strict], y[~strict], "o", ms=5, mfc="white", mec=ADAPTIVE, zorder=4, label="estimate")
    if levels.has_estimate:
        axis.plot(x, levels.estimate[shown], "x", ms=4, mew=0.9, color=GREY, zorder=3, label="from recovered stresses\n(estimate)", gid="recovered")
    drawn = predicted if len(x) else None
    if drawn:
        uniform(axis, levels, cost if own is None else own, drawn, y[-1])
    if levels.requested:
        axis.axhline(levels.requested, color=REQUESTED, ls=":", lw=1.4, zorder=1, label=f"requested: {per_cent(levels.requested, 3)}")
    axis.set_xlim(limits([*x, *([drawn] if drawn else [])], 12.0))
    estimates = [value for value in levels.estimate[shown] if value > 0] if levels.has_estimate else []
    axis.set_ylim(limits([*y, *estimates, *([levels.requested] if levels.requested else [])], 4.0))
    if len(x):  # space for the texts below the last points
        low, high = axis.get_ylim()
        axis.set_ylim(min(low, y[-1] * (high / low)**-0.12), high)
        name_ends(axis, x[-1], y[-1], drawn, words, rough_words)


def uniform(axis, levels, cost, predicted, error):
    """Cost of uniform refinement: of the meshes that were solved, and from there to the last error as predicted."""
    order = f", {ORDERS[levels.order]} order" if levels.order in ORDERS else ""
    places = [place for place in levels.measured if levels.known[place] and cost[place] > 0]
    x, y = [cost[place] for place in places], [levels.error[place] for place in places]
    if len(x) > 1:  # around the circles of the same meshes
        axis.plot(x, y, "D", ms=9, mew=1.2, mec=UNIFORM, mfc="none", zorder=5, label=f"uniform refinement{order}:\nmeasured", gid="measured")
    if x and error < y[-1]:
        axis.plot([x[-1], predicted], [y[-1], error], ls="--", color=UNIFORM, zorder=2,
                  label="predicted" if len(x) > 1 else f"uniform refinement{order}:\npredicted")
    axis.plot([predicted], [error], "D", ms=5, color=UNIFORM, zorder=4, gid="uniform")


def limits(values, least):
    """Ends of a logarithmic axis around values, with a ratio of at least `least`."""
    low, high = (min(values), max(values)) if values else (1.0, 1.0)
    room = max(ROOM, math.sqrt(least * low / high))
    return low / room, high * room


def name_ends(axis, x, y, predicted, words, rough_words):
    """The cost of the last mesh, and that of uniform refinement, below their points."""
    ends = [(x, words(x), ADAPTIVE, "center")] + ([(predicted, f"about {rough_words(predicted)}", UNIFORM, "right")] if predicted else [])
    low, high = axis.get_xlim()
    if predicted and abs(math.log(predicted / x)) < 0.3 * math.log(high / low):  # side by side, without overlap
        sides = ("right", "left") if x <= predicted else ("left", "right")
        ends = [(at, text, colour, side) for (at, text, colour, _), side in zip(ends, sides)]
    for at, text, colour, side in ends:
        axis.annotate(text, (at, y), xytext=({"center": 0, "right": -2, "left": 2}[side], -6), textcoords="offset points", ha=side, va="top",
                      fontsize=8, color=colour, path_effects=halo(), zorder=6)


def triangle(axis, levels):
    """The fitted rate of the adaptive meshes, below their line where the axes have space."""
    rate = levels.rate()
    if rate is None:
        return
    x, y = np.log(levels.unknowns[levels.known]), np.log(levels.error[levels.known])
    order = np.argsort(x)
    (low, high), (least, most) = np.log(axis.get_xlim()), np.log(axis.get_ylim())
    width, below = min(0.16 * (high - low), 0.3 * (most - least) / rate), (0.17 if levels.has_estimate else 0.1) * (most - least)
    for middle in np.linspace(x[-1] - 0.6 * width - 0.07 * (high - low), x[0], 12):  # the cost of the last mesh is written below its point
        level = np.interp(middle, x[order], y[order]) - below
        a, b, top, bottom = middle - width / 2, middle + width / 2, level + rate * width / 2, level - rate * width / 2
        if a > low + 0.1 * (high - low) and bottom > least + 0.12 * (most - least):
            axis.plot(np.exp([a, b, a, a]), np.exp([top, bottom, bottom, top]), color=GREY, lw=0.9, zorder=2, gid="rate")
            axis.text(math.exp(a), math.exp(level), f"{rate:.2g} ", ha="right", va="center", fontsize=8, color="#59636e", path_effects=halo())
            axis.text(math.exp(middle), math.exp(bottom), "1", ha="center", va="top", fontsize=8, color="#59636e", path_effects=halo())
            return


def accuracy_caption(run):
    levels = Levels(run.summary["accuracy"])
    words = ("Error of each mesh in the energy norm, relative to the solution. " if levels.of_energy else
             f"Relative error of {levels.quantity} on each mesh. ")
    kinds = ["Filled circles: strict upper bounds."] * bool(levels.strict.any()) + ["Hollow circles: estimates."] * (not levels.strict.all())
    words += " ".join(kinds)
    if levels.has_estimate:
        words += " Crosses: an estimate from recovered stresses, which is cheaper and not proved."
    if levels.uniform_unknowns or levels.uniform_seconds:
        measured = "Hollow diamonds: the first mesh and its uniform refinement, both solved; dashed" if len(levels.measured) > 1 else "Dashed"
        words += f" {measured}: the cost of refining uniformly to the last error, predicted and not computed."
    if levels.rate() is not None:
        words += f" From the second mesh on, the error falls as the number of unknowns to the power \u2212{levels.rate():.2g}."
    return words
