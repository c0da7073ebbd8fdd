"""Chooses a view from which the surfaces of loads and supports are seen."""
import numpy as np

from ..words import conditions
from .raster import Raster
from .view import DEFAULT, view_from

SMALL = 160  # samples along the longer side of a trial
ENOUGH = 25  # samples of a surface that is seen
VIEWS = [DEFAULT, *((DEFAULT[0] * a, DEFAULT[1] * b, DEFAULT[2] * c) for c in (1, -1) for b in (1, -1) for a in (1, -1) if (a, b, c) != (1, 1, 1))]


def trial(view, points, triangles, size=SMALL):
    """Number of samples that show each triangle, in a small image. \\param size  samples along its longer side"""
    flat = view.flat(points)
    low, reach = flat.min(axis=0), np.maximum(np.ptp(flat, axis=0), 1e-300)
    raster = Raster(low, low + reach, np.maximum(np.ceil(size * reach[::-1] / reach.max()), 1).astype(int))
    raster.draw(flat, view.nearness(points), triangles)
    return np.bincount(raster.shown, minlength=len(triangles))


def chosen_view(run, surface):
    """The default view if it shows the surfaces of all loads and supports; else the view that shows most loads, then most supports, from
    below only if it shows more loads than any view from above."""
    found = [(surface.of_groups(c.groups), c.support) for c in conditions(run) if c.groups]
    found = [(triangles, support) for triangles, support in found if len(triangles)]
    points, best = surface.at(run.fields.points), None
    for direction in VIEWS:
        shown = trial(view_from(direction), points, surface.triangles)
        seen = [support for own, support in found if shown[own].sum() >= ENOUGH]
        worth = (seen.count(False), direction[2] > 0, seen.count(True))
        if best is None or worth > best[0]:
            best = worth, direction
        if len(seen) == len(found):
            break
    return best[1]
