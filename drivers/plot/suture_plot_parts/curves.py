"""Curves: convergence.png, probe_*.png."""
import math

import numpy as np
from matplotlib.ticker import FuncFormatter, MaxNLocator, NullFormatter

from .run import probe_table
from .style import GREY, PALETTE, headline, with_panels, wrapped
from .units import scaled

MOST_MARKS = 60  # outer iterations with markers of full size


def probe_figure(run, path):
    """Values along a line or group; None for points and empty tables."""
    table = probe_table(path)
    if not table or len(table["arc_length"]) < 2 or not table["arc_length"][-1] > 0:
        return None
    length = run.length_unit
    stresses = np.abs([table["von_mises"], table["principal_1"], table["principal_3"]])
    stress_factor, stress_unit = scaled(run.stress_unit, np.nanmax(stresses, initial=0.0))
    panels = [(f"displacement [{length}]", [(f"u{axis}", 1.0, f"along {axis}") for axis in "xyz"[:run.dimension]]),
              (f"stress [{stress_unit}]", [("von_mises", stress_factor, "von Mises"), ("principal_1", stress_factor, "largest principal"),
                                          ("principal_3", stress_factor, "smallest principal")])]
    if np.isfinite(table["pressure"]).any():
        factor, unit = scaled(run.stress_unit, np.nanmax(np.abs(table["pressure"])))
        panels.append((f"pressure [{unit}]", [("pressure", factor, "contact pressure")]))
    figure, axes = with_panels(len(panels), 1, (6.5, 2.3 * len(panels) + 0.6), sharex=True, squeeze=False)
    for axis, (label, curves) in zip(axes[:, 0], panels):
        axis.axhline(0.0, color=GREY, lw=0.6, zorder=1)
        for number, (name, factor, words) in enumerate(curves):
            axis.plot(table["arc_length"], factor * table[name], marker="o" if len(table[name]) <= 40 else None, ms=3, color=PALETTE[(4, 5, 2)[number]],
                      ls=("-", "-", "--")[number], label=words)
        axis.set_ylabel(label)
        axis.margins(x=0.02)
        axis.yaxis.set_major_locator(MaxNLocator(nbins=5))
        axis.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=len(curves), borderaxespad=0.0, fontsize=8)
    axes[-1, 0].set_xlabel(f"arc length [{length}]")
    headline(figure, wrapped(f"{run.title}: {path.stem.replace('probe_', 'probe ')}{run.state}", 85))
    return figure


def convergence_figure(run):
    k = np.arange(1, len(run.history) + 1)
    starts = np.flatnonzero(np.diff([row.get("load_step", 1) for row in run.history])) + 1  # of load steps, except the first

    def parted(values):
        """Values with gaps between load steps."""
        return np.insert(np.asarray(values, dtype=float), starts, math.nan)

    many = len(k) > MOST_MARKS
    figure, (above, below) = with_panels(2, 1, (6.5, 5.2), sharex=True, gridspec_kw={"height_ratios": [2, 1]})
    above.semilogy(parted(k), parted([max(row["residual"], 1e-18) for row in run.history]), "o-", ms=2 if many else 4, color=PALETTE[4],
                   label="stopping norm")
    euclidean = [row.get("euclidean", 0.0) for row in run.history]
    if max(euclidean) > 0:
        above.semilogy(parted(k), parted([max(e, 1e-18) for e in euclidean]), "s--", ms=1.5 if many else 3, lw=0.9, color=GREY, label="Euclidean (not used)")
    try:
        tolerance = float(run.parameter("Outer Solver", "Tolerance"))
        above.axhline(tolerance, color=PALETTE[5], lw=0.9, ls=":", label=f"tolerance {tolerance:g}")
    except (TypeError, ValueError):
        pass  # Automatic: it depends on the estimated error
    above.set_ylabel("relative residual")
    above.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"1e{math.log10(value):.0f}"))  # without the slow mathtext
    above.yaxis.set_minor_formatter(NullFormatter())
    above.grid(axis="y", lw=0.3, color="#cccccc")
    above.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0), borderaxespad=0.0, fontsize=8)
    auxiliary, outer = run.summary.get("auxiliary", {}), run.summary["outer"]
    first = auxiliary.get("iterations", 0)
    after = f", after {first} in the auxiliary problem" if first else ""
    above.set_title(wrapped(f"{run.title}{run.state}", 60) + f"\n{outer.get('solver', '')}: {outer.get('pcg_total', 0)} PCG{after}", loc="left", y=1.0)
    below.bar(k, [row["pcg"] for row in run.history], width=0.6, color=PALETTE[1])
    for axis in (above, below):
        for start in starts:
            axis.axvline(start + 0.5, color="#cccccc", lw=0.3 if many else 0.7, zorder=0)
    below.set_ylabel("PCG iterations", color="#1c6b9c")
    below.set_xlabel("outer iteration")
    below.xaxis.set_major_locator(MaxNLocator(integer=True, min_n_ticks=1, nbins=12))
    below.yaxis.set_major_locator(MaxNLocator(integer=True, min_n_ticks=1, nbins=5))
    below.set_xlim(min(k) - 0.6, max(k) + 0.6)
    changed = below.twinx()
    changed.spines["right"].set_visible(True)
    changed.plot(parted(k), parted([row["changed"] for row in run.history]), "D-", ms=1.5 if many else 3.5, lw=0.9, color=PALETTE[5])
    changed.set_ylabel("changed pairs", color=PALETTE[5])
    changed.yaxis.set_major_locator(MaxNLocator(integer=True, min_n_ticks=1, nbins=5))
    changed.set_ylim(0, max(1.0, 1.1 * max(row["changed"] for row in run.history)))
    return figure
