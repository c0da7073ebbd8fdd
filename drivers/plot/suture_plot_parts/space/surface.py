"""The outside of the bodies of a run in space."""
import numpy as np

from ..grid import numbered
from .cells import CELLS, FACES, with_centres

CREASE = np.cos(np.radians(30.0))  # neighbours whose normals differ by more meet in an edge that is drawn


class Surface:
    """Faces that belong to one cell only, as triangles, with the edges between them.

    Vertices are nodes of the grid, one for all ranks that have the node, and centres of quadrilaterals: at() takes values at the
    grid's nodes to them. Triangles are seen from outside anticlockwise. Sides of a contact are outside, too, if their nodes are their own.
    """

    def __init__(self, grid):
        self.grid = grid
        node = node_numbers(grid)
        faces = faces_used_once(grid, node)
        self.faces = sum(len(nodes) for _, nodes in faces)
        self.nodes, place = points_of(faces, node)
        self._centres = []  # of quadrilaterals without a node in their centre: with_centres()
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
        # Of each face: its first two vertices, which name it in the record of side groups, its first and its last triangle.
        self._first = np.concatenate(first) if first else np.zeros((0, 4), dtype=int)

    def at(self, values):
        """Values at the vertices, of those at the grid's nodes."""
        return with_centres(values[self.nodes], self._centres)

    def of_cells(self, name):
        """The cell field at the triangles."""
        return self.grid.cell_data[name][self.cells]

    def creases(self):
        """Numbers of the edges at which the surface bends, ends or passes to another body."""
        left, right = self.beside.T
        normal = normals(self.at(self.grid.points), self.triangles)
        body = self.of_cells("Body")
        return np.flatnonzero((right < 0) | (np.einsum("ij,ij->i", normal[left], normal[right]) < CREASE) | (body[left] != body[right]))

    def contours(self, points, toward):
        """Sides of triangles beyond which the surface turns away from the eye, a row of two vertices each."""
        facing = normals(points, self.triangles) @ toward > 0
        low, high = np.sort(np.stack([self.triangles, np.roll(self.triangles, -1, axis=1)]), axis=0).astype(np.int64)
        key = low * len(points) + high
        return np.column_stack(np.divmod(np.intersect1d(key[facing], key[~facing]), max(len(points), 1)))

    def borders(self, of_triangles):
        """Numbers of the edges at which a number of the triangles changes."""
        left, right = self.beside.T
        return np.flatnonzero((right >= 0) & (of_triangles[left] != of_triangles[right]))

    def of_group(self, sides):
        """Triangles of the faces of a side group, a row a face: two of its vertices, which no other face of the body has in this order."""
        points = self.at(self.grid.points)
        first, last = self._first[:, 2:].T
        rows = np.vstack([points[self._first[:, :2]].reshape(-1, 6), sides])
        number = numbered(np.round(rows / (1e-8 * max(np.ptp(points, axis=0).max(initial=0.0), 1e-300))).astype(np.int64))
        chosen = np.isin(number[:len(first)], number[len(first):])
        return np.concatenate([np.zeros(0, dtype=int), *(np.arange(a, b + 1) for a, b in zip(first[chosen], last[chosen]))])


def node_numbers(grid):
    """A number for each point, the same for points that are one node of the mesh."""
    return grid.point_data["NodeId"] if "NodeId" in grid.point_data else grid.merged(grid.cell_data["Body"])


def points_of(faces, node):
    """(points, places): one point of each node of the faces; where each node is among them."""
    all_points = np.concatenate([nodes.reshape(-1) for _, nodes in faces]) if faces else np.zeros(0, dtype=int)
    used, first = np.unique(node[all_points], return_index=True)
    place = np.full(node.max(initial=-1) + 1, -1)
    place[used] = np.arange(len(used))
    return all_points[first], place


def faces_used_once(grid, node):
    """[(cells, nodes)]: faces that one cell only has, those with as many nodes together."""
    # A face is told by the sum of random numbers of its vertices: equal sums of different faces are as likely as 64 equal throws of a coin.
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
    """(edges, triangles beside them, -1 for none). `sides`: both ends and the triangle, seen from each triangle."""
    if len(sides) == 0:
        return np.zeros((0, 2), dtype=int), np.zeros((0, 2), dtype=int)
    low, high = np.sort(sides[:, :2], axis=1).T
    order = np.lexsort((high, low))
    ends = np.column_stack([low, high])[order]
    first = np.concatenate([[True], (ends[1:] != ends[:-1]).any(axis=1)])
    starts = np.flatnonzero(first)
    count = np.diff(np.append(starts, len(ends)))
    triangles = sides[order, 2]
    # Where more than two faces meet, the edge is one at which the surface ends.
    return ends[starts], np.column_stack([triangles[starts], np.where(count == 2, triangles[np.minimum(starts + 1, len(ends) - 1)], -1)])


def normals(points, triangles):
    """Unit normals of the triangles; zero for those without area."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    n = np.cross(b - a, c - a)
    return n / np.maximum(np.linalg.norm(n, axis=1), 1e-300)[:, None]
