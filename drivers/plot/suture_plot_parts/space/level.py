"""Level sets of functions that are linear on triangles or tetrahedra."""
import numpy as np


def lines(points, triangles, values, level):
    """Segments on which `values` (at the points) equal `level`: (rows of two points, the triangles that they cross).

    A point at the level counts as above it, so that no segment is found twice.
    """
    above = values[triangles] >= level
    crossed = np.flatnonzero(above.any(axis=1) & ~above.all(axis=1))
    own, above = triangles[crossed], above[crossed]
    # The vertex alone on its side, and the other two.
    alone = np.where(above.sum(axis=1) == 1, above.argmax(axis=1), (~above).argmax(axis=1))
    rows = np.arange(len(own))
    tip, one, two = (own[rows, (alone + k) % 3] for k in range(3))
    return np.stack([between(points, values, level, tip, other) for other in (one, two)], axis=1), crossed


def between(points, values, level, a, b):
    """Points on the edges from a to b where the values equal `level`."""
    t = (level - values[a]) / (values[b] - values[a])
    return points[a] + t.reshape(-1, *[1] * (points.ndim - 1)) * (points[b] - points[a])


def section(points, tetrahedra, values, level):
    """Triangles that are the sections of tetrahedra where `values` equal `level`: (rows of three points, tetrahedra).

    `points` may have more than three columns, for other quantities that are linear in a tetrahedron.
    """
    above = values[tetrahedra] >= level
    count = above.sum(axis=1)
    found, owners = [], []
    for side, number in ((above, 1), (~above, 3)):  # one vertex alone
        cut = np.flatnonzero(count == number)
        own, alone = tetrahedra[cut], side[cut].argmax(axis=1)
        rows = np.arange(len(own))
        tip, others = own[rows, alone], [own[rows, (alone + k) % 4] for k in (1, 2, 3)]
        found.append(np.stack([between(points, values, level, tip, other) for other in others], axis=1))
        owners.append(cut)
    cut = np.flatnonzero(count == 2)
    order = np.argsort(~above[cut], axis=1, kind="stable")  # those above come first
    a, b, c, d = np.take_along_axis(tetrahedra[cut], order, axis=1).T
    corners = [between(points, values, level, *edge) for edge in ((a, c), (a, d), (b, d), (b, c))]
    for triangle in ((0, 1, 2), (0, 2, 3)):
        found.append(np.stack([corners[k] for k in triangle], axis=1))
        owners.append(cut)
    return np.concatenate(found), np.concatenate(owners)
