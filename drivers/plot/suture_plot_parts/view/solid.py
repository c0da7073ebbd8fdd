"""Vertices, triangles and cells of the interactive view."""
import numpy as np

from ..space.cells import CELLS
from ..space.surface import Surface, node_numbers

class Solid:
    """The outside of the bodies and, with `inside`, their cells by vertices.

    Vertices are those of the surface, then the other vertices of cells. `triangles` are anticlockwise seen from outside and sorted by body;
    `owners`: the cell of each triangle. `cells`: {number of vertices: (cells, vertices)}.
    """

    def __init__(self, grid, inside):
        self.grid, self.surface = grid, Surface(grid)
        body = grid.cell_data["Body"].astype(int)
        order = np.argsort(body[self.surface.cells], kind="stable")
        self.triangles, self.owners = self.surface.triangles[order], self.surface.cells[order]
        self.creases = self.surface.edges[self.surface.creases()]
        self.crease_bodies = body[self.surface.cells[self.surface.beside[self.surface.creases(), 0]]] if len(self.creases) else np.zeros(0, dtype=int)
        self.within, self.cells = np.zeros(0, dtype=int), {}
        if inside:
            self._add_cells()
        self.points = self.at(grid.points)

    def _add_cells(self):
        number = node_numbers(self.grid)
        blocks = [(CELLS[kind], own, nodes[:, :CELLS[kind].vertices]) for kind, own, nodes in self.grid.blocks if kind in CELLS]
        used = np.unique(np.concatenate([nodes.reshape(-1) for _, _, nodes in blocks]))
        outside = number[self.surface.nodes]
        self.within = used[~np.isin(number[used], outside)]
        _, first = np.unique(number[self.within], return_index=True)  # one for each node that several ranks have
        self.within = self.within[np.sort(first)]
        place = np.full(number.max() + 1, -1)
        place[outside] = np.arange(len(outside))
        place[number[self.within]] = self.count_outside + np.arange(len(self.within))
        for shape, own, nodes in blocks:
            cells, vertices = self.cells.get(shape.vertices, (np.zeros(0, dtype=int), np.zeros((0, shape.vertices), dtype=int)))
            self.cells[shape.vertices] = (np.concatenate([cells, own]), np.concatenate([vertices, place[number[nodes]]]))

    @property
    def count_outside(self):
        return len(self.surface.nodes) + sum(len(faces) for faces, _ in self.surface._centres)

    def at(self, values):
        """Values at the vertices, from values at the nodes of the grid."""
        return np.concatenate([self.surface.at(values), values[self.within]])


def faces_of(vertices):
    """Faces of a cell by vertices, anticlockwise seen from outside."""
    shape = next(cell for cell in CELLS.values() if cell.vertices == vertices)
    return [[int(node) for node in face if node < vertices] for face in shape.faces]


class Reduced:
    """The surface of a Solid with at most `most` triangles: of the vertices of one body in a box of a lattice only that of the largest weight
    remains. `weights`: at the vertices of the Solid"""

    def __init__(self, solid, most, weights):
        self.solid = solid
        body = solid.grid.cell_data["Body"].astype(int)[solid.owners]
        low, size = solid.points.min(axis=0), np.ptp(solid.points, axis=0).max()
        of_vertex = np.zeros(len(solid.points), dtype=int)
        of_vertex[solid.triangles] = body[:, None]
        heaviest = np.argsort(-np.nan_to_num(weights), kind="stable")
        boxes = 2.0 * most**0.5
        while True:
            key = np.column_stack([of_vertex, np.floor((solid.points - low) / size * boxes).astype(int)])[heaviest]
            _, first, inverse = np.unique(key, axis=0, return_index=True, return_inverse=True)
            box = np.empty(len(key), dtype=int)
            box[heaviest] = inverse.reshape(-1)
            moved = box[solid.triangles]
            kept = (moved[:, 0] != moved[:, 1]) & (moved[:, 1] != moved[:, 2]) & (moved[:, 2] != moved[:, 0])
            if kept.sum() <= most:
                break
            boxes *= 0.8
        self.chosen, self.triangles, self.owners = heaviest[first], moved[kept], solid.owners[kept]
        creases = box[solid.creases]
        bent = creases[:, 0] != creases[:, 1]
        self.creases, self.crease_bodies = creases[bent], solid.crease_bodies[bent]
        self.points, self.cells, self.grid = solid.points[self.chosen], {}, solid.grid

    def at(self, values):
        return self.solid.at(values)[self.chosen]
