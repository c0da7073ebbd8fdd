"""Replaces ticks in a 3D view: the directions x, y, z, a length scale, and the viewing direction."""
import numpy as np
from matplotlib.transforms import ScaledTranslation, blended_transform_factory

from ..units import round_down

AXIS = 0.34  # inches, of the arrows along x, y, z


def axes_and_scale(figure, axes, view, unit):
    """Draws all of them below the plot."""
    inches = inches_of(figure, axes)
    ends = AXIS * view.flat(np.eye(3))
    cross(axes, inches, view, np.array([0.12 - min(ends[:, 0].min(), 0.0), -0.15 - max(ends[:, 1].max(), 0.0)]))
    scale(axes, inches, unit, 0.22)
    whence(axes, inches, view, 1.0, -0.3, "right")


def axes_and_scale_beside(figure, axes, view, unit):
    """The same for small plots: the directions to the left of the plot."""
    inches = inches_of(figure, axes)
    ends = AXIS * view.flat(np.eye(3))
    cross(axes, inches, view, np.array([-0.3 - max(ends[:, 0].max(), 0.0), -min(ends[:, 1].min(), 0.0)]))
    scale(axes, inches, unit, 0.4)
    whence(axes, inches, view, 0.5, -0.66, "center")


def inches_of(figure, axes):
    """Inches from the lower left corner of the axes."""
    return figure.dpi_scale_trans + ScaledTranslation(0, 0, axes.transAxes)


def whence(axes, inches, view, x, y, align):
    """Prints the viewing direction. `x`: fraction of the plot's width, `y`: inches."""
    at = blended_transform_factory(axes.transAxes, inches)
    axes.text(x, y, f"seen from {view.words()}", transform=at, ha=align, va="center", color="#59636e", fontsize=8)


def cross(axes, inches, view, origin):
    """Arrows along x, y, z; an arrow along the viewing direction has no length and no name."""
    taken = []
    for name, end in zip("xyz", AXIS * view.flat(np.eye(3))):
        if np.hypot(*end) < 0.05 * AXIS:
            continue
        axes.annotate("", origin + end, origin, xycoords=inches, textcoords=inches, annotation_clip=False,
                      arrowprops={"arrowstyle": "-|>", "lw": 1.0, "color": "#333333", "shrinkA": 0, "shrinkB": 0, "mutation_scale": 7})
        unit = end / np.hypot(*end)
        places = [end + 0.1 * unit, end + 0.12 * np.array([unit[1], -unit[0]]), end - 0.12 * np.array([unit[1], -unit[0]])]
        place = next((place for place in places if all(np.hypot(*(place - other)) > 0.13 for other in taken)), places[0])
        taken.append(place)
        axes.text(*(origin + place), name, transform=inches, ha="center", va="center", fontsize=9)


def scale(axes, inches, unit, part, above=0.0):
    """A round length, at most a given fraction of the plot's width. \\param above  inches above its usual place below the plot"""
    (x0, x1), middle = axes.get_xlim(), np.mean(axes.get_xlim())
    length, at = round_down(part * (x1 - x0)), blended_transform_factory(axes.transData, inches)
    style = {"transform": at, "color": "black", "clip_on": False}
    axes.plot([middle - 0.5 * length, middle + 0.5 * length], [above - 0.3, above - 0.3], lw=1.4, solid_capstyle="butt", **style)
    for end in (-0.5, 0.5):
        axes.plot([middle + end * length] * 2, [above - 0.34, above - 0.26], lw=1.0, **style)
    axes.text(middle, above - 0.37, f"{length:g} {unit}".rstrip(), transform=at, ha="center", va="top")
