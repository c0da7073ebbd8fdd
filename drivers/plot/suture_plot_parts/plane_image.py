"""Images of 2D bodies: one sample per pixel, coloured by cells or by values at nodes."""
from copy import copy

import matplotlib
import numpy as np
from matplotlib.collections import LineCollection

from .samples import show
from .space.image import colour_table, image_of_pixels, packed
from .space.raster import Raster
from .style import HIGHEST, MOST_EDGES, WIDEST, box_in_pixels

FINER = 1.1  # relative scale up to which samples of another raster are used


class PlaneImage:
    """The bodies of a 2D run on axes. Pictures of the same points share the search for the cell at each sample."""

    def __init__(self, axes, grid, points, shared=None):
        """\\param shared  a raster of these points"""
        self.axes, self.grid = axes, grid
        (x0, x1), (y0, y1) = axes.get_xlim(), axes.get_ylim()
        shape = [max(1, round(pixels)) for pixels in box_in_pixels(axes)[::-1]]
        self.triangles, self.cells = grid.fans
        if shared is not None and shape[1] / (x1 - x0) <= FINER * shared.scale[0]:
            self.raster = shared.resampled((x0, y0), (x1, y1), shape)
            return
        corners = points[self.triangles, :2]
        near = np.flatnonzero(((corners.max(axis=1) >= [x0, y0]) & (corners.min(axis=1) <= [x1, y1])).all(axis=1))
        self.triangles, self.cells = self.triangles[near], self.cells[near]
        self.raster = Raster((x0, y0), (x1, y1), shape)
        self.raster.draw(points[:, :2], None, self.triangles)

    def colour(self, colours):
        """\\param colours  red, green, blue of each cell, or of all"""
        pixels = packed(np.broadcast_to(np.asarray(colours, dtype=np.float32), (self.grid.count, 3)))
        show(self.axes, image_of_pixels(self.raster, pixels[self.cells[self.raster.shown]]))

    def colour_by(self, values, nodal, low, high, colours):
        """\\param values  at the nodes, interpolated, or of the cells; without a value: grey"""
        found = self.raster.interpolate(values[self.triangles]) if nodal else values[self.cells[self.raster.shown]]
        table, row = colour_table(found, low, high, colours)
        show(self.axes, image_of_pixels(self.raster, packed(table)[row]))

    def edges(self, points, most=MOST_EDGES, **style):
        """The sides of all cells, unless there are more than `most` cells, whose sides would merge into an area. Not smoothed: files would be five times as large."""
        if self.grid.count <= most:
            self.axes.add_collection(LineCollection(points[self.grid.edges][:, :, :2], **{"linewidths": 0.3, "zorder": 1.5, "antialiaseds": False, **style}))


def image_of(axes, grid):
    """The undeformed bodies."""
    if not hasattr(grid, "shared_raster"):
        low, high = grid.points[:, :2].min(axis=0), grid.points[:, :2].max(axis=0)
        size = np.maximum(high - low, 1e-300)
        scale = (matplotlib.rcParams["savefig.dpi"] * np.array([WIDEST - 1.0, HIGHEST]) / size).min()  # pixels per length, of the largest picture
        raster = Raster(low - 1 / scale, high + 1 / scale, np.ceil(scale * size[::-1]).astype(int) + 2)
        raster.draw(grid.points[:, :2], None, grid.fans[0])
        grid.shared_raster = raster
        grid.shared_images = {}
    frame = (*axes.get_xlim(), *axes.get_ylim(), *box_in_pixels(axes))
    if frame not in grid.shared_images:
        grid.shared_images = {**dict(list(grid.shared_images.items())[-1:]), frame: PlaneImage(axes, grid, grid.points, grid.shared_raster)}
    image = copy(grid.shared_images[frame])
    image.axes = axes
    return image
