"""Frames of the animation of a 3D run: the outside of the bodies."""
import matplotlib
import numpy as np

from ..animation_frames import MARKS, OUTLINE, SIZE, Frames
from ..units import scaled
from .gaps import gaps_of_surface
from .outside import stress
from .page import Page, Seen, raster_of
from .seen_from import chosen_view, trial
from .surface import Surface
from .view import view_from

FINE = 400  # samples along the longer side of the images in which the largest visible stress is sought


class SpaceFrames(Frames):
    """The bodies in one view. The colour scale ends at the largest stress that is visible in any frame."""

    where = "on the outside of the deformed bodies"

    def __init__(self, run, view):
        """\\param view  direction towards the viewer; None: that of the other pictures"""
        super().__init__()
        self._grid, self._surface, self._page = run.fields, Surface(run.fields), None
        self.view = view_from(view or chosen_view(run, self._surface))

    def surface(self, run):
        """The outside of the bodies, computed again if the cells have changed."""
        if run.fields.points is not self._grid.points:
            self._grid, self._surface = run.fields, Surface(run.fields)
        return self._surface

    def gaps(self, run):
        surface = self.surface(run)
        return gaps_of_surface(surface.at(run.fields.points), surface.at(run.fields.point_data["Displacement"]), surface.triangles)

    def moved(self, run, factor):
        surface = self.surface(run)
        return surface.at(run.fields.points) + factor * surface.at(run.fields.point_data["Displacement"])

    def values(self, run):
        """Stresses at the points of the surface, or of its triangles."""
        found, nodal = stress(run, "NodalVonMises", "VonMises")
        return self.surface(run).at(found) if nodal else found[self.surface(run).cells]

    def add(self, run, factor):
        """Extends box and scale by the fields of a step."""
        points, values, triangles = self.moved(run, factor), self.values(run), self.surface(run).triangles
        body = np.zeros(len(points), dtype=int)
        body[triangles] = self.surface(run).of_cells("Body")[:, None]
        self.watch(self.surface(run).at(run.fields.points), points, body)
        seen = np.flatnonzero(trial(self.view, points, triangles, FINE))
        self.contain(self.view.flat(points), values[triangles[seen]] if len(values) == len(points) else values[seen])

    def figure(self, run, factor, words):
        """\\param words  of the step, in the title"""
        surface, points, colours = self.surface(run), self.moved(run, factor), matplotlib.colormaps["viridis"]
        scale, unit = scaled(run.stress_unit, self.top)
        high = scale * self.top or 1.0
        if self.axes is None:
            corners = np.outer([self.low[0], self.high[0]], self.view.right) + np.outer([self.low[1], self.high[1]], self.view.up)
            self._page = Page(run, self.view, corners, self.title(run, factor), most=SIZE)
            self._page.bar(0.0, high, colours, f"von Mises stress [{unit}]")
            self.keep(self._page.axes)
        self.clear(words)
        page = self._page
        page.draw(Seen(self.view, points, surface.triangles, raster_of(page.axes)))
        page.paint(scale * self.values(run), 0.0, high, colours)
        marks = self.marks(surface.at(run.fields.points), surface.triangles, surface.of_cells("Body"), points)
        page.lines(marks.reshape(-1, 3), np.arange(2 * len(marks)).reshape(-1, 2), **MARKS, zorder=3.5)
        page.lines(points, np.unique(np.vstack([surface.edges[surface.creases()], surface.contours(points, self.view.toward)]), axis=0), **OUTLINE)
        return page.figure
