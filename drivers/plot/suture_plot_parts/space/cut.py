"""Plane sections through the bodies."""
import argparse
import re

import numpy as np

from ..style import PlotError
from . import level
from .cells import CELLS
from .view import View

INSIDE = 1e-7  # fraction of the model size by which a plane on the outside is moved inward, since a section there would be empty


class Plane:
    """All points whose coordinate `axis` (0, 1, 2) is `value`. The plot shows the other two to the right and upward."""

    def __init__(self, axis, value):
        self.axis, self.value = axis, value
        right, up = {0: (1, 2), 1: (0, 2), 2: (0, 1)}[axis]
        self.names = ("xyz"[right], "xyz"[up])
        toward = np.cross(np.eye(3)[right], np.eye(3)[up])
        self.view = View(np.eye(3)[right], np.eye(3)[up], toward, tuple(toward))

    def words(self, unit):
        return f"{'xyz'[self.axis]} = {self.value:.4g} {unit}".rstrip().replace("-", "\u2212")


def plane(text):
    """Parses x=0.5 of the command line."""
    found = re.fullmatch(r"\s*([xyz])\s*=\s*(\S+)\s*", text)
    try:
        return "xyz".index(found.group(1)), float(found.group(2))
    except (AttributeError, ValueError):
        raise argparse.ArgumentTypeError(f"'{text}' is not of the form x=0.5 (or y=, z=)") from None


def chosen_plane(run, wanted):
    """The requested plane, (axis, value); else normal to the shorter horizontal extent of the bodies: through the largest pressure, through
    the middle of the pressed pairs if the largest one is at a corner of the contact, or without contact through their middle."""
    points = run.fields.points
    low, high = points.min(axis=0), points.max(axis=0)
    if wanted:
        axis, value = wanted
        slack = 1e-9 * (high - low).max()
        if not low[axis] - slack <= value <= high[axis] + slack:
            name = "xyz"[axis]
            raise PlotError(f"--cut {name}={value:g} is outside the bodies, which reach from {name} = {low[axis]:g} to {high[axis]:g}")
        return Plane(axis, value)
    axis = int(np.argmin((high - low)[:2]))
    value = 0.5 * (low + high)[axis]
    if run.contact is not None and len(run.contact.points):
        pressure = np.nan_to_num(run.contact.point_data["ContactPressure"])
        if pressure.max() > 0:
            own, slack = run.contact.points[:, axis], 1e-6 * (high - low)[axis]
            value = own[np.argmax(pressure)]
            # At the corner of a turned block the section would only touch it.
            if min(value - own.min(), own.max() - value) <= slack and np.count_nonzero(abs(own - value) <= slack) == 1:
                value = np.average(own, weights=pressure)
    return Plane(axis, float(value))


class Cut:
    """Triangles of the section: `corners` (triangles x 3 x 3), and the fields `values` at corners or in cells, by name.

    \\param fields  at the grid's nodes, by name
    """

    def __init__(self, grid, plane, fields):
        self.plane, names = plane, list(fields)
        low, high = grid.points[:, plane.axis].min(), grid.points[:, plane.axis].max()
        inward = INSIDE * np.ptp(grid.points, axis=0).max()
        self.at = np.clip(plane.value, low + inward, high - inward) if high - low > 2 * inward else plane.value
        place = np.column_stack([grid.points, *fields.values()])
        corners, cells = [np.zeros((0, 3, place.shape[1]))], [np.zeros(0, dtype=int)]
        for kind, own, nodes in grid.blocks:
            if kind not in CELLS:
                continue
            along = grid.points[nodes, plane.axis]
            # Curved cells may bulge beyond their nodes.
            reach = 0.3 * np.ptp(along, axis=1) if CELLS[kind].nodes > CELLS[kind].vertices else 0.0
            near = np.flatnonzero((along.min(axis=1) - reach <= self.at) & (along.max(axis=1) + reach >= self.at))
            weights, tetrahedra = CELLS[kind].tetrahedra
            points = np.einsum("pn,cnk->cpk", weights, place[nodes[near]])
            flat = points.reshape(-1, place.shape[1])
            all_of_them = (np.arange(len(near))[:, None, None] * len(weights) + tetrahedra).reshape(-1, 4)
            found, owner = level.section(flat, all_of_them, flat[:, plane.axis], self.at)
            corners.append(found)
            cells.append(own[near[owner // len(tetrahedra)]])
        corners, self.cells = np.concatenate(corners), np.concatenate(cells)
        flat = plane.view.flat(corners[:, :, :3])
        turned = np.cross(flat[:, 1] - flat[:, 0], flat[:, 2] - flat[:, 0]) < 0
        corners[turned] = corners[turned][:, ::-1]
        self.corners = corners[:, :, :3]
        self.values = {name: corners[:, :, 3 + k] for k, name in enumerate(names)}

    @property
    def flat(self):
        return self.plane.view.flat(self.corners)

    def lines(self, points, triangles):
        """The intersection lines of a surface with the plane, in plot coordinates, and the triangle of each."""
        segments, crossed = level.lines(points, triangles, points[:, self.plane.axis], self.at)
        return self.plane.view.flat(segments), crossed
