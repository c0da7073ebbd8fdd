"""deformation.png: deformed and undeformed bodies."""
import matplotlib
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection
from matplotlib.colors import Normalize
from matplotlib.lines import Line2D
from matplotlib.transforms import offset_copy

from .enlarged import enlargement, gaps_of_outline
from .plane_image import PlaneImage
from .style import canvas, colour_bar
from .units import scaled

FEW_CELLS = 5000  # with more cells, their sides would hide the colours


def gaps(grid):
    """(widths, changes of width) of the gaps of a 2D run."""
    edges, u = grid.boundary, grid.point_data["Displacement"]
    starts, ends = grid.points[edges[:, 0], :2], grid.points[edges[:, 1], :2]
    return gaps_of_outline(starts, ends, u[edges[:, 0], :2], u[edges[:, 1], :2], True)


def deformation_figure(run, factor):
    """\\return figure, enlargement, whether gaps limit it, whether bodies overlap as drawn"""
    grid = run.fields
    u = grid.point_data["Displacement"]
    norm = np.linalg.norm(u, axis=1)
    factor, limited = enlargement(run, factor, lambda: gaps(grid))
    moved = grid.points + factor * u
    scale, name = scaled(run.length_unit, norm.max())
    drawn_in = factor != 1 and has_interference(run)
    words = f"{run.title}: deformation, {in_words(factor, drawn_in)}{run.state}"
    figure, axes = canvas(np.vstack([grid.points, moved]), words, run.length_unit, extra=0.9, names=run.axes)
    image, high = PlaneImage(axes, grid, moved), scale * norm.max() or 1.0
    image.colour_by(scale * norm, True, 0.0, high, matplotlib.colormaps["viridis"])
    image.edges(moved, FEW_CELLS, colors="#00000038")
    for points, style in ((grid.points, {"colors": "#8a8a8a", "linewidths": 0.9, "linestyles": (0, (4, 2)), "zorder": 4}),
                          (moved, {"colors": "black", "linewidths": 1.0, "zorder": 5})):
        axes.add_collection(LineCollection(grid.lines(grid.boundary, points), **style))
    colour_bar(axes, ScalarMappable(Normalize(0.0, high), "viridis"), f"|u| [{name}], largest {scale * norm.max():.4g}")
    axes.legend(handles=[Line2D([], [], color="black", lw=1.0, label="deformed" if factor == 1 else f"deformed \u00d7 {factor:g}"),
                         Line2D([], [], color="#8a8a8a", lw=0.9, ls=(0, (4, 2)), label="undeformed")],
                loc="upper center", bbox_to_anchor=(0.5, 0.0), ncol=2,
                bbox_transform=offset_copy(axes.transAxes, fig=figure, y=-26.0, units="points"))  # below the label, even if the axes are flat
    return figure, factor, limited, drawn_in


def in_words(factor, drawn_in):
    """The enlargement in a title. \\param drawn_in  whether bodies overlap as drawn"""
    return ("not enlarged" if factor == 1 else f"enlarged {factor:g} times") + (" (interference is not)" if drawn_in else "")


def seeming(factor, limited, given):
    """A sentence on the enlargement. \\param given  by the user, without regard to gaps"""
    if factor == 1:
        return " Displacements are drawn as they are, since a larger enlargement would close a gap." if limited else ""
    if factor < 1:
        return f" Displacements are reduced to {factor:g} of their size."
    if given:
        return f" Displacements are enlarged {factor:g} times, so bodies may seem to overlap or separate: the true gaps are in the section on contact."
    return f" Displacements are enlarged {factor:g} times" + (", the most at which no gap closes." if limited else ".")


def is_given(run, factor):
    """True if the user or the scene sets the enlargement."""
    return factor is not None or run.parameter("Output", "Enlargement", default="Automatic") != "Automatic"


def has_interference(run):
    """True if contact sides overlap in the undeformed state by more than a thousandth of the largest displacement."""
    if run.contact is None or not len(run.contact.points):
        return False
    largest = np.linalg.norm(run.fields.point_data["Displacement"], axis=1).max()
    return bool(np.nanmin(run.contact.point_data["InitialGap"], initial=0.0) < -1e-3 * largest)
