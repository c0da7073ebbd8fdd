"""A panel of values along a contact line."""
import numpy as np
from matplotlib.ticker import MaxNLocator

from .style import GREY


def curve(axis, arc, values, active, colour, small):
    """One panel: values along the line, with different markers for closed and open pairs."""
    shade(axis, arc, ~active, "#e9e9e9")
    axis.axhline(0.0, color=GREY, lw=0.6, zorder=1)
    axis.plot(arc, values, color=colour, zorder=2)
    axis.plot(arc[active], values[active], "o", ms=2 if small else 3, color=colour, zorder=3)
    axis.plot(arc[~active], values[~active], "o", ms=2.5 if small else 3.5, mfc="white", mec=colour, zorder=4)
    axis.margins(x=0.02)
    axis.yaxis.set_major_locator(MaxNLocator(nbins=4 if small else 5))
    axis.xaxis.set_major_locator(MaxNLocator(nbins=5 if small else 6))
    # Do not scale round-off to the height of the panel.
    if np.nanmax(np.abs(values), initial=0.0) < 1e-6:
        axis.set_ylim(-1, 1)


def shade(axis, arc, mask, colour):
    """Colours the background where `mask` is true; a pair extends half way to its neighbours."""
    for first, end in runs(mask):
        a = arc[first] if first == 0 else 0.5 * (arc[first - 1] + arc[first])
        b = arc[end - 1] if end == len(arc) else 0.5 * (arc[end - 1] + arc[end])
        axis.axvspan(a, b, color=colour, lw=0, zorder=0)


def runs(mask):
    """(first, end) of each run of true values."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], mask.astype(int), [0]])))
    return list(zip(edges[::2], edges[1::2]))
