"""Frames of the animation of a 2D run."""
import matplotlib
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection
from matplotlib.colors import Normalize

from .deformation import gaps
from .plane_image import PlaneImage
from .space.level import lines
from .style import canvas, colour_bar
from .units import scaled
from .view.turns import angle_of, rotation

FEW_CELLS = 1000  # with more cells, their sides would hide the colours, and files would be three times as large
TURNED = 0.1  # radians, from which a body has lines that show its rotation
OUTLINE = {"colors": "black", "linewidths": 0.8, "snap": False}
MARKS = {"colors": "white", "linewidths": 0.8, "snap": False}
SIZE = (6.4, 4.4)  # inches: largest width of a frame, largest height of its axes


class Frames:
    """What all frames have in common: the largest stress, the box that contains the bodies of all of them, the bodies that turn, and the figure."""

    def __init__(self):
        self.top, self.low, self.high, self.turning = 0.0, np.full(2, np.inf), np.full(2, -np.inf), set()
        self.axes, self._title, self._kept = None, "", []

    def contain(self, points, values):
        """\\param points  in the plane of the picture  \\param values  stresses that are seen"""
        self.low, self.high = np.minimum(self.low, points.min(axis=0)), np.maximum(self.high, points.max(axis=0))
        self.top = max(self.top, values[np.isfinite(values)].max(initial=0.0))

    def watch(self, before, after, body):
        """Finds bodies that turn. \\param before, after  points as drawn and in a frame  \\param body  number of the body of each point"""
        for number in set(np.unique(body).tolist()) - self.turning:
            own = body == number
            if angle_of(rotation(before[own], after[own])) > TURNED:
                self.turning.add(number)

    def marks(self, before, triangles, body, after):
        """Lines through the middle of each body that turns, along the axes as drawn: rows of two points of `after`.

        \\param body  number of the body of each triangle
        """
        segments = [np.zeros((0, 2, after.shape[1]))]
        for number in self.turning:
            own = triangles[body == number]
            place = before[own].reshape(-1, before.shape[1])
            for axis, middle in enumerate(0.5 * (place.min(axis=0) + place.max(axis=0))):
                segments.append(lines(after, own, before[:, axis], middle)[0])
        return np.concatenate(segments)

    def keep(self, axes):
        """Keeps the axes with what they show now for all frames, since new ones would take most of the time."""
        self.axes, self._title, self._kept = axes, axes.get_title(loc="left"), axes.get_children()

    def clear(self, words):
        """Removes the bodies of the frame before. \\param words  second line of the title"""
        for artist in [artist for artist in self.axes.get_children() if artist not in self._kept]:
            artist.remove()
        self.axes.set_title(f"{self._title}\n{words}", loc="left", y=1.0)

    def title(self, run, factor):
        enlarged = "" if factor == 1 else f", displacements enlarged {factor:g} times"
        return f"{run.title}: von Mises stress{enlarged}{run.state_of_answer}"


class PlaneFrames(Frames):
    """The bodies in their plane."""

    where = "of the deformed bodies"
    gaps = staticmethod(lambda run: gaps(run.fields))

    def add(self, run, factor):
        """Extends box and scale by the fields of a step."""
        points, (triangles, cells) = moved(run, factor), run.fields.fans
        self.contain(points, stress(run)[0])
        body = np.zeros(len(points), dtype=int)
        body[triangles] = run.fields.cell_data["Body"][cells][:, None]
        self.watch(run.fields.points[:, :2], points, body)

    def figure(self, run, factor, words):
        """\\param words  of the step, in the title"""
        grid, points = run.fields, moved(run, factor)
        scale, unit = scaled(run.stress_unit, self.top)
        high = scale * self.top or 1.0
        if self.axes is None:
            _, axes = canvas(np.stack([self.low, self.high]), self.title(run, factor), run.length_unit, extra=0.9, names=run.axes, most=SIZE)
            colour_bar(axes, ScalarMappable(Normalize(0.0, high), "viridis"), f"von Mises stress [{unit}]")
            self.keep(axes)
        self.clear(words)
        values, nodal = stress(run)
        image = PlaneImage(self.axes, grid, points)
        image.colour_by(scale * values, nodal, 0.0, high, matplotlib.colormaps["viridis"])
        image.edges(points, FEW_CELLS, colors="#00000050")
        triangles, cells = grid.fans
        marks = self.marks(grid.points[:, :2], triangles, grid.cell_data["Body"][cells], points)
        self.axes.add_collection(LineCollection(marks, **MARKS, zorder=4))
        self.axes.add_collection(LineCollection(grid.lines(grid.boundary, points), **OUTLINE, zorder=5))
        return self.axes.figure


def moved(run, factor):
    return (run.fields.points + factor * run.fields.point_data["Displacement"])[:, :2]


def stress(run):
    """(von Mises stress, whether it is nodal)"""
    nodal = run.fields.point_data.get("NodalVonMises")
    return (nodal, True) if nodal is not None else (run.fields.cell_data["VonMises"], False)
