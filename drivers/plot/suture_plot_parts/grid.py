"""Grids in the field files."""
import json
from copy import copy
from functools import cached_property

import h5py
import numpy as np

from .style import PlotError

# Node order of 2D VTK cells along their outline.
OUTLINE = {5: [0, 1, 2], 22: [0, 3, 1, 4, 2, 5], 9: [0, 1, 2, 3], 23: [0, 4, 1, 5, 2, 6, 3, 7], 28: [0, 4, 1, 5, 2, 6, 3, 7]}
# 3D cells in the order of the file.
ORDER = {**OUTLINE, **{kind: list(range(nodes)) for kind, nodes in ((10, 4), (24, 10), (12, 8), (25, 20), (29, 27), (13, 6), (14, 5))}}
WORDS = {5: "triangles of 3 nodes", 22: "triangles of 6 nodes", 9: "quadrilaterals of 4 nodes", 23: "quadrilaterals of 8 nodes",
         28: "quadrilaterals of 9 nodes", 10: "tetrahedra of 4 nodes", 24: "tetrahedra of 10 nodes", 12: "hexahedra of 8 nodes",
         25: "hexahedra of 20 nodes", 29: "hexahedra of 27 nodes", 13: "wedges of 6 nodes", 14: "pyramids of 5 nodes"}


class Grid:
    """Unstructured grid of a VTKHDF file, with its partitions merged."""

    _order = ORDER

    def __init__(self, path):
        self.path = path
        try:
            with h5py.File(path, "r") as file:
                self._read(file)
        except (OSError, KeyError, ValueError, IndexError) as error:
            raise PlotError(f"{path} is not a field file of suture_solve, or is damaged: {error}") from error

    def _read(self, file):
        root = file["VTKHDF"]
        points, cells, ids = (root[name][:] for name in ("NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"))
        self.points = root["Points"][:]
        self.types = root["Types"][:]
        connectivity, offsets = root["Connectivity"][:], root["Offsets"][:]
        nodes, starts = [], []
        point_base = id_base = offset_base = 0
        for n_points, n_cells, n_ids in zip(points, cells, ids):
            nodes.append(connectivity[id_base:id_base + n_ids] + point_base)
            starts.append(offsets[offset_base:offset_base + n_cells] + id_base)
            point_base, id_base, offset_base = point_base + n_points, id_base + n_ids, offset_base + n_cells + 1
        nodes = np.concatenate(nodes) if nodes else np.zeros(0, dtype=int)
        starts = np.concatenate(starts) if starts else np.zeros(0, dtype=int)
        self.count = len(self.types)
        # Cells of one kind: their numbers and nodes; nodes of 2D cells along the outline.
        self.blocks = []
        for kind in np.unique(self.types).tolist():
            if kind in self._order:
                own = np.flatnonzero(self.types == kind)
                self.blocks.append((kind, own, nodes[starts[own][:, None] + np.array(self._order[kind])]))
        self.point_data = {name: data[:] for name, data in root["PointData"].items()}
        self.cell_data = {name: data[:] for name, data in root["CellData"].items()}
        self.units = {}
        for group in (root["PointData"], root["CellData"]):
            for name, data in group.items():
                self.units[name] = as_text(data.attrs.get("unit", ""))
        record = file["Record"]
        self.names = {name: json.loads(as_text(record[name][()])) for name in ("Bodies", "Subdomains", "ContactPieces") if name in record}
        self.side_groups = {name: data[:] for name, data in record["SideGroups"].items()} if "SideGroups" in record else {}
        self.mesh_hash = as_text(record["MeshHash"][()]) if "MeshHash" in record else ""
        self.scene = as_text(record["Input"][()]) if "Input" in record else ""

    def moved(self, points):
        """The same grid with its points at other places."""
        other = copy(self)
        other.points = points
        for name in ("outlines", "centroids", "boundary", "silhouette", "shared_raster", "shared_images"):  # of the points before
            other.__dict__.pop(name, None)
        return other

    def polygons(self, points):
        """Outline of each 2D cell, including mid-side nodes."""
        result = [None] * self.count
        for _, own, nodes in self.blocks:
            for cell, polygon in zip(own, points[nodes][:, :, :2]):
                result[cell] = polygon
        return [polygon for polygon in result if polygon is not None]

    @cached_property
    def outlines(self):
        return self.polygons(self.points)

    @cached_property
    def centroids(self):
        result = np.zeros((self.count, 2))
        for kind, own, nodes in self.blocks:
            corners = nodes[:, ::2] if kind in (22, 23, 28) else nodes
            result[own] = self.points[corners][:, :, :2].mean(axis=1)
        return result

    def cell_means(self, values):
        """Mean over the nodes of each cell."""
        result = np.zeros(self.count)
        for _, own, nodes in self.blocks:
            result[own] = values[nodes].mean(axis=1)
        return result

    @cached_property
    def fans(self):
        """(triangles, cells): triangles that cover the cells, and the cell of each."""
        triangles, cells = [np.zeros((0, 3), dtype=int)], [np.zeros(0, dtype=int)]
        for _, own, nodes in self.blocks:
            for i in range(1, nodes.shape[1] - 1):
                triangles.append(nodes[:, [0, i, i + 1]])
                cells.append(own)
        return np.concatenate(triangles), np.concatenate(cells)

    @cached_property
    def edges(self):
        """All edges of the cells, one row of two points each."""
        ends = [np.stack([nodes, np.roll(nodes, -1, axis=1)], axis=-1).reshape(-1, 2) for _, _, nodes in self.blocks]
        ends = np.sort(np.concatenate(ends), axis=1).astype(np.int64)
        return np.column_stack(np.divmod(np.unique(ends[:, 0] * len(self.points) + ends[:, 1]), max(len(self.points), 1)))

    @cached_property
    def boundary(self):
        """Edges that belong to a single cell of a body, one per row: two points, their merged numbers, the cell."""
        return self._edges_used_once(self.merged(self.cell_data["Body"]))

    @cached_property
    def silhouette(self):
        """Edges that belong to a single cell of the scene; contact lines with coinciding sides are interior."""
        return self._edges_used_once(self.merged(None))

    def lines(self, edges, points):
        """The edges as 2D segments."""
        return points[edges[:, :2]][:, :, :2]

    def merged(self, body):
        """A number for each node, equal if the points coincide (and belong to one body, if `body` is given)."""
        size = np.ptp(self.points, axis=0).max() or 1.0
        grid = np.round(self.points / (1e-9 * size)).astype(np.int64)
        if body is not None:
            of_point = np.zeros(len(self.points), dtype=np.int64)
            for _, own, nodes in self.blocks:
                of_point[nodes] = body[own][:, None]
            grid = np.column_stack([grid, of_point])
        return numbered(grid)

    def _edges_used_once(self, number):
        edges = []
        for _, own, nodes in self.blocks:
            a, b = nodes, np.roll(nodes, -1, axis=1)
            cell = np.broadcast_to(own[:, None], a.shape)
            edges.append(np.stack([a, b, number[a], number[b], cell], axis=-1).reshape(-1, 5))
        if not edges:
            return np.zeros((0, 5), dtype=int)
        edges = np.concatenate(edges)
        keys = np.sort(edges[:, 2:4], axis=1)
        keys = keys[:, 0].astype(np.int64) * (number.max() + 1) + keys[:, 1]
        _, inverse, count = np.unique(keys, return_inverse=True, return_counts=True)
        return edges[count[inverse] == 1]


def numbered(rows):
    """The index of each row among the sorted unique rows; like np.unique(axis=0), but five times faster."""
    number = np.zeros(len(rows), dtype=np.int64)
    order = np.lexsort(rows.T[::-1])
    number[order[1:]] = np.cumsum((rows[order[1:]] != rows[order[:-1]]).any(axis=1))
    return number


def looked_up(parameters, path, default=None):
    """Value of nested lists of parameters. path: names from the outermost list inwards. default: result if a name does not exist."""
    for name in path:
        if not isinstance(parameters, dict) or name not in parameters:
            return default
        parameters = parameters[name]
    return parameters


def as_text(value):
    return value.decode() if isinstance(value, bytes) else str(value)
