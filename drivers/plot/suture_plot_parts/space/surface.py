"""The outside of the bodies of a 3D run."""
import numpy as np

from ..grid import numbered
from .cells import CELLS, FACES, with_centres

CREASE = np.cos(np.radians(30.0))  # an edge is drawn if the normals of its triangles differ by more


class Surface:
    """Faces that belong to a single cell, as triangles, with the edges between them.

    Vertices are grid nodes, merged over ranks, and centres of quadrilaterals; at() interpolates nodal values of the grid to the vertices.
    Triangles are anticlockwise seen from outside. Contact sides belong to the outside if they have separate nodes.
    """

    def __init__(self, grid):
        self.grid = grid
        node = node_numbers(grid)
        faces = given_faces(grid) or faces_used_once(grid, node)
        self.faces = sum(len(nodes) for _, nodes in faces)
        self.nodes, place = points_of(faces, node)
        self._centres = []  # of quadrilaterals without a centre node: with_centres()
        triangles, cells, edges, first = [np.zeros((0, 3), dtype=int)], [np.zeros(0, dtype=int)], [np.zeros((0, 3), dtype=int)], []
        vertices, count = len(self.nodes), 0
        for owners, nodes in faces:
            shape, own = FACES[nodes.shape[1]], place[node[nodes]]
            if shape.centre is not None:
                self._centres.append((own, shape.centre))
                own = np.column_stack([own, vertices + np.arange(len(own))])
                vertices += len(own)
            parts = len(shape.triangles)
            numbers = count + np.arange(len(own) * parts).reshape(-1, parts)
            count += numbers.size
            triangles.append(own[:, shape.triangles].reshape(-1, 3))
            cells.append(np.repeat(owners, parts))
            ends = own[:, shape.outline]
            edges.append(np.stack([ends, np.roll(ends, -1, axis=1), numbers[:, shape.beside]], axis=-1).reshape(-1, 3))
            first.append(np.column_stack([own[:, :2], numbers[:, [0, -1]]]))
        self.triangles, self.cells = np.concatenate(triangles), np.concatenate(cells)
        self.edges, self.beside = joined(np.concatenate(edges))
        # For each face: its first two vertices, which identify it in the record of side groups, and its first and last triangle.
        self._first = np.concatenate(first) if first else np.zeros((0, 4), dtype=int)

    def at(self, values):
        """Values at the vertices, from values at the grid's nodes."""
        return with_centres(values[self.nodes], self._centres)

    def of_cells(self, name):
        """The cell field on the triangles."""
        return self.grid.cell_data[name][self.cells]

    def creases(self):
        """Numbers of the edges at which the surface bends, ends or meets another body."""
        left, right = self.beside.T
        normal = normals(self.at(self.grid.points), self.triangles)
        body = self.of_cells("Body")
        return np.flatnonzero((right < 0) | (np.einsum("ij,ij->i", normal[left], normal[right]) < CREASE) | (body[left] != body[right]))

    def contours(self, points, toward):
        """Sides of triangles beyond which the surface turns away from the viewer, one row of two vertices each."""
        facing = normals(points, self.triangles) @ toward > 0
        low, high = np.sort(np.stack([self.triangles, np.roll(self.triangles, -1, axis=1)]), axis=0).astype(np.int64)
        key = low * len(points) + high
        return np.column_stack(np.divmod(np.intersect1d(key[facing], key[~facing]), max(len(points), 1)))

    def borders(self, of_triangles):
        """Numbers of the edges between triangles with different numbers."""
        left, right = self.beside.T
        return np.flatnonzero((right >= 0) & (of_triangles[left] != of_triangles[right]))

    def around(self, triangles):
        """The edges between these triangles and others."""
        mine = np.zeros(len(self.triangles) + 1, dtype=bool)
        mine[triangles] = True  # the last entry means no triangle
        return self.edges[mine[self.beside[:, 0]] != mine[self.beside[:, 1]]]

    def of_groups(self, names):
        """Triangles of the faces of side groups."""
        grid = self.grid
        cells = getattr(grid, "group_cells", {})
        if cells:
            own = [cells[name] for name in names if name in cells]
            return np.flatnonzero(np.isin(self.cells, np.concatenate(own))) if own else np.zeros(0, dtype=int)
        own = [self.of_group(grid.side_groups[name]) for name in names if len(grid.side_groups.get(name, []))]
        return np.concatenate(own) if own else np.zeros(0, dtype=int)

    def of_group(self, sides):
        """Triangles of the faces of a side group. Each row is a face, given by two vertices in an order unique to it in its body.

        Bodies that touch have vertices at the same places: rows belong to the body that has most of them, and so on.
        """
        first, last = self._first[:, 2:].T
        number = self._keys(sides)
        mine, rows = number[:len(first)], np.unique(number[len(first):])
        body = self.of_cells("Body")[first] if len(first) else first
        chosen = np.zeros(len(first), dtype=bool)
        while len(rows):
            found = np.isin(mine, rows) & ~chosen
            if not found.any():
                break
            best = np.argmax(np.bincount(body[found].astype(int)))
            own = found & (body == best)
            chosen |= own
            rows = np.setdiff1d(rows, mine[own])
        return np.concatenate([np.zeros(0, dtype=int), *(np.arange(a, b + 1) for a, b in zip(first[chosen], last[chosen]))])

    def _keys(self, sides):
        """A number for each face of the surface, then for each row of `sides`, equal for equal places of both vertices."""
        points = self.at(self.grid.points)
        rows = np.vstack([points[self._first[:, :2]].reshape(-1, 6), sides])
        return numbered(np.round(rows / (1e-8 * max(np.ptp(points, axis=0).max(initial=0.0), 1e-300))).astype(np.int64))


def given_faces(grid):
    """[(cells, nodes)] of a grid whose cells are the outer faces already, grouped by their number of nodes."""
    return sorted(((own, nodes) for kind, own, nodes in grid.blocks if kind not in CELLS), key=lambda face: face[1].shape[1])


def node_numbers(grid):
    """A number for each point, equal for points that are one node of the mesh."""
    return grid.point_data["NodeId"] if "NodeId" in grid.point_data else grid.merged(grid.cell_data["Body"])


def points_of(faces, node):
    """(points, places): one point for each node of the faces, and the index of each node among them."""
    all_points = np.concatenate([nodes.reshape(-1) for _, nodes in faces]) if faces else np.zeros(0, dtype=int)
    used, first = np.unique(node[all_points], return_index=True)
    place = np.full(node.max(initial=-1) + 1, -1)
    place[used] = np.arange(len(used))
    return all_points[first], place


def faces_used_once(grid, node):
    """[(cells, nodes)]: faces that belong to a single cell, grouped by their number of nodes."""
    # A face is identified by the sum of random numbers of its vertices; different faces have equal sums with probability 2^-64.
    mark = np.random.default_rng(1).integers(0, 2**63, size=node.max(initial=-1) + 1, dtype=np.uint64)
    all_faces = {}
    for kind, own, nodes in grid.blocks:
        for face in CELLS[kind].faces if kind in CELLS else ():
            all_faces.setdefault(len(face), []).append((own, nodes[:, face]))
    shapes = sorted(all_faces)
    joint = [tuple(np.concatenate(part) for part in zip(*all_faces[shape])) for shape in shapes]
    sums = [mark[node[nodes[:, :FACES[shape].vertices]]].sum(axis=1) for shape, (_, nodes) in zip(shapes, joint)]
    sums = np.concatenate(sums) if sums else np.zeros(0)
    once, start, found = used_once(sums), 0, []
    for cells, nodes in joint:
        mine = once[start:start + len(cells)]
        start += len(cells)
        if mine.any():
            found.append((cells[mine], nodes[mine]))
    return found


def used_once(keys):
    order = np.argsort(keys)
    same = keys[order][1:] == keys[order][:-1]
    once = np.empty(len(keys), dtype=bool)
    once[order] = ~(np.concatenate([[False], same]) | np.concatenate([same, [False]])) if len(keys) else False
    return once


def joined(sides):
    """(edges, adjacent triangles, -1 for none). `sides`: both ends and the triangle, from each triangle."""
    if len(sides) == 0:
        return np.zeros((0, 2), dtype=int), np.zeros((0, 2), dtype=int)
    low, high = np.sort(sides[:, :2], axis=1).T
    order = np.lexsort((high, low))
    ends = np.column_stack([low, high])[order]
    first = np.concatenate([[True], (ends[1:] != ends[:-1]).any(axis=1)])
    starts = np.flatnonzero(first)
    count = np.diff(np.append(starts, len(ends)))
    triangles = sides[order, 2]
    # An edge with more than two faces counts as an end of the surface.
    return ends[starts], np.column_stack([triangles[starts], np.where(count == 2, triangles[np.minimum(starts + 1, len(ends) - 1)], -1)])


def normals(points, triangles):
    """Unit normals of the triangles; zero for degenerate triangles."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    n = np.cross(b - a, c - a)
    return n / np.maximum(np.linalg.norm(n, axis=1), 1e-300)[:, None]
