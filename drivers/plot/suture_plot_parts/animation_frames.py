"""Frames of the animation of a 2D run."""
import matplotlib
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection
from matplotlib.colors import Normalize

from .deformation import gaps
from .plane_image import PlaneImage
from .style import canvas, colour_bar
from .units import scaled

FEW_CELLS = 5000  # with more cells, their sides would hide the colours
SIZE = (6.4, 4.4)  # inches: largest width of a frame, largest height of its axes


class Frames:
    """What all frames have in common: the largest stress, and the box that contains the bodies of all of them."""

    def __init__(self):
        self.top, self.low, self.high = 0.0, np.full(2, np.inf), np.full(2, -np.inf)

    def contain(self, points, values):
        """\\param points  in the plane of the picture  \\param values  stresses that are seen"""
        self.low, self.high = np.minimum(self.low, points.min(axis=0)), np.maximum(self.high, points.max(axis=0))
        self.top = max(self.top, values[np.isfinite(values)].max(initial=0.0))

    def title(self, run, factor):
        enlarged = "" if factor == 1 else f", displacements enlarged {factor:g} times"
        return f"{run.title}: von Mises stress{enlarged}{run.state_of_answer}"


class PlaneFrames(Frames):
    """The bodies in their plane."""

    where = "of the deformed bodies"
    gaps = staticmethod(lambda run: gaps(run.fields))

    def add(self, run, factor):
        """Extends box and scale by the fields of a step."""
        self.contain(moved(run, factor), stress(run)[0])

    def figure(self, run, factor, words):
        """\\param words  of the step, in the title"""
        grid, points = run.fields, moved(run, factor)
        figure, axes = canvas(np.stack([self.low, self.high]), self.title(run, factor), run.length_unit, extra=0.9, names=run.axes, most=SIZE)
        add_line(axes, words)
        scale, unit = scaled(run.stress_unit, self.top)
        values, nodal = stress(run)
        high = scale * self.top or 1.0
        image = PlaneImage(axes, grid, points)
        image.colour_by(scale * values, nodal, 0.0, high, matplotlib.colormaps["viridis"])
        image.edges(points, FEW_CELLS, colors="#00000050")
        axes.add_collection(LineCollection(grid.lines(grid.boundary, points), colors="black", linewidths=0.8, zorder=5))
        colour_bar(axes, ScalarMappable(Normalize(0.0, high), "viridis"), f"von Mises stress [{unit}]")
        return figure


def add_line(axes, words):
    """Adds a line to the title of the axes."""
    axes.set_title(f"{axes.get_title(loc='left')}\n{words}", loc="left", y=1.0)


def moved(run, factor):
    return (run.fields.points + factor * run.fields.point_data["Displacement"])[:, :2]


def stress(run):
    """(von Mises stress, whether it is nodal)"""
    nodal = run.fields.point_data.get("NodalVonMises")
    return (nodal, True) if nodal is not None else (run.fields.cell_data["VonMises"], False)
