"""Gaps between the walls of 3D bodies, along lines parallel to the axes."""
import numpy as np

from ..enlarged import RAYS, between_hits
from .raster import Raster, planes


def gaps_of_surface(points, moves, triangles):
    """(widths, changes of width). \\param moves  displacements of the points"""
    widths, changes = [np.zeros(0)], [np.zeros(0)]
    low, high = points.min(axis=0), points.max(axis=0)
    for axis, (u, v) in enumerate(((1, 2), (2, 0), (0, 1))):
        flat = points[:, [u, v]]
        reach = np.maximum((high - low)[[u, v]], 1e-300)
        raster = Raster(low[[u, v]], low[[u, v]] + reach, np.maximum(np.ceil(RAYS / 2 * reach[::-1] / reach.max()), 1).astype(int))
        hits = []
        for leaves, corners in ((True, triangles), (False, triangles[:, ::-1])):
            line, place, moved = along(raster, flat, corners, points[:, axis], moves[:, axis])
            hits.append((line, place, np.full(len(line), leaves), moved))
        found = between_hits(*(np.concatenate(parts) for parts in zip(*hits)))
        widths.append(found[0])
        changes.append(found[1])
    return np.concatenate(widths), np.concatenate(changes)


def along(raster, flat, triangles, place, moved):
    """(line, position, displacement) where lines towards the viewer cross triangles that face the viewer."""
    corners = raster.in_samples(flat)[triangles]
    which, row, start, length = raster.spans(corners)
    which, at = np.repeat(which, length), np.repeat(start, length) + np.arange(length.sum()) - np.repeat(np.cumsum(length) - length, length)
    row = np.repeat(row, length)
    x, y = at + 0.5 - corners[which, 0, 0], row + 0.5 - corners[which, 0, 1]
    found = []
    for values in (place, moved):
        p, q, value = planes(corners, values[triangles])
        found.append(value[which] + p[which] * x + q[which] * y)
    return row * raster.shape[1] + at, *found
