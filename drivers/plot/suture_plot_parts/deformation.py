"""deformation.png: deformed and undeformed bodies."""
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.lines import Line2D
from matplotlib.transforms import offset_copy

from .style import canvas, edge_style
from .units import round_down, scaled


def enlargement(run, factor):
    """The enlargement given by the user, else by the scene, else such that the largest displacement is about a twentieth of the model size."""
    if factor is not None:
        return factor
    try:
        return float(run.parameter("Output", "Enlargement", default="Automatic"))
    except (TypeError, ValueError):
        norm = np.linalg.norm(run.fields.point_data["Displacement"], axis=1).max()
        size = np.linalg.norm(np.ptp(run.fields.points, axis=0))
        return round_down(0.05 * size / norm) if norm > 0 and np.isfinite(norm) else 1.0


def deformation_figure(run, factor):
    """\\return figure, enlargement, whether bodies overlap as drawn"""
    grid = run.fields
    u = grid.point_data["Displacement"]
    norm = np.linalg.norm(u, axis=1)
    factor = enlargement(run, factor)
    moved = grid.points + factor * u
    scale, name = scaled(run.length_unit, norm.max())
    drawn_in = factor != 1 and has_interference(run)
    words = f"{run.title}: deformation, enlarged {factor:g} times{' (interference is not)' if drawn_in else ''}{run.state}"
    figure, axes = canvas(np.vstack([grid.points, moved]), words, run.length_unit, extra=0.9, names=run.axes)
    edges = edge_style(grid.count, 0.15)
    drawn = PolyCollection(grid.polygons(moved), array=grid.cell_means(scale * norm), cmap="viridis", **{"edgecolors": "#00000066", **edges})
    axes.add_collection(drawn)
    for points, style in ((grid.points, {"colors": "#8a8a8a", "linewidths": 0.9, "linestyles": (0, (4, 2)), "zorder": 4}),
                          (moved, {"colors": "black", "linewidths": 1.0, "zorder": 5})):
        axes.add_collection(LineCollection(grid.lines(grid.boundary, points), **style))
    bar = figure.colorbar(drawn, ax=axes, shrink=0.8, pad=0.02)
    bar.set_label(f"|u| [{name}], largest {scale * norm.max():.4g}")
    bar.outline.set_linewidth(0.4)
    axes.legend(handles=[Line2D([], [], color="black", lw=1.0, label="deformed" if factor == 1 else f"deformed \u00d7 {factor:g} (bodies may seem to overlap)"),
                         Line2D([], [], color="#8a8a8a", lw=0.9, ls=(0, (4, 2)), label="undeformed")],
                loc="upper center", bbox_to_anchor=(0.5, 0.0), ncol=2,
                bbox_transform=offset_copy(axes.transAxes, fig=figure, y=-26.0, units="points"))  # below the label, even if the axes are flat
    return figure, factor, drawn_in


def has_interference(run):
    """True if contact sides overlap in the undeformed state by more than a thousandth of the largest displacement."""
    if run.contact is None or not len(run.contact.points):
        return False
    largest = np.linalg.norm(run.fields.point_data["Displacement"], axis=1).max()
    return bool(np.nanmin(run.contact.point_data["InitialGap"], initial=0.0) < -1e-3 * largest)
