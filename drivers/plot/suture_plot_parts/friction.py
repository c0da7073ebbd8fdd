"""The friction panel of a contact line: tangential traction with its bounds, and which pairs stick, slip and are open."""
import numpy as np
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator

from .line_panel import shade
from .style import GREY
from .units import scaled

TRACTION_COLOUR = "#8F3F73"
STICK, SLIP, OPEN = "#d5eae1", "#fbe3cf", "#e9e9e9"


def has_friction(grid):
    return "TangentialTraction" in grid.point_data


def friction_caption(run):
    return (" Tangential traction: on side B, positive towards larger arc lengths, with its bounds; green background: stick, orange: slip."
            if has_friction(run.contact) else "")


def along_line(grid, own):
    """Tangential traction of the pairs of a line on side B, positive towards larger arc lengths."""
    data, points = grid.point_data, grid.points[own]
    tangent = np.column_stack([-data["Normal"][own][:, 1], data["Normal"][own][:, 0]])
    step = np.gradient(points[:, :2], axis=0) if len(own) > 1 else tangent
    forward = np.where((step * tangent).sum(axis=1) < 0, -1.0, 1.0)
    return forward * (data["TangentialTraction"][own][:, :2] * tangent).sum(axis=1)


def draw_friction(axis, grid, own, small, labels):
    """\\param own  points of the line, ordered by arc length"""
    data = grid.point_data
    arc, stick, bound = data["ArcLength"][own], data["Stick"][own], data["FrictionBound"][own]
    traction = along_line(grid, own)
    largest = max(np.nanmax(np.abs(traction), initial=0.0), np.nanmax(bound, initial=0.0))
    factor, unit = scaled(grid.units["TangentialTraction"], largest)
    for state, colour in ((1, STICK), (0, SLIP), (-1, OPEN)):
        shade(axis, arc, stick == state, colour)
    axis.axhline(0.0, color=GREY, lw=0.6, zorder=1)
    if bound.any():
        for sign in (1.0, -1.0):
            axis.plot(arc, sign * factor * bound, ls="--", lw=0.9, color="#555555", zorder=2)
    axis.plot(arc, factor * traction, color=TRACTION_COLOUR, zorder=3)
    axis.plot(arc[stick == 1], factor * traction[stick == 1], "o", ms=2 if small else 3, color=TRACTION_COLOUR, zorder=4)
    axis.plot(arc[stick != 1], factor * traction[stick != 1], "o", ms=2.5 if small else 3.5, mfc="white", mec=TRACTION_COLOUR, zorder=4)
    axis.margins(x=0.02)
    axis.yaxis.set_major_locator(MaxNLocator(nbins=4 if small else 5))
    axis.xaxis.set_major_locator(MaxNLocator(nbins=5 if small else 6))
    if not largest * factor > 1e-6:
        axis.set_ylim(-1, 1)
    if labels:
        axis.set_ylabel(f"tangential [{unit}]")
    axis.set_title(f"{np.count_nonzero(stick == 1)} stick, {np.count_nonzero(stick == 0)} slip", loc="left", fontsize=8 if small else 9, y=1.0)


def friction_legend(figure):
    """One legend for all panels, below them."""
    handles = [Patch(facecolor=colour, lw=0, label=name) for colour, name in ((STICK, "sticks"), (SLIP, "slips"), (OPEN, "open"))]
    handles.append(Line2D([], [], color="#555555", ls="--", lw=0.9, label="bound of the tangential traction"))
    figure.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, 0.0), ncols=len(handles))
