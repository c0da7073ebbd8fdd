"""Converts a Foreign mesh to a Suture mesh: orientation of elements, groups of elements and of boundary sides."""
import numpy as np

from .cells import CELLS, KINDS, in_order, sizes_of, vertices_of
from .foreign import ConvertError

MOST = 9  # largest number of nodes of a side


def padded(sides, width):
    """An array of rows of this width; shorter rows are filled with -1"""
    if isinstance(sides, np.ndarray) and sides.ndim == 2:
        rows = np.full((len(sides), width), -1, dtype=np.int64)
        rows[:, :sides.shape[1]] = sides
        return rows
    return np.array([[*side, *[-1] * (width - len(side))] for side in sides], dtype=np.int64).reshape(-1, width)


def numbered(rows):
    """Numbers from 0 for rows of vertices, equal for rows with the same vertices in any order"""
    rows = np.sort(rows, axis=1) + 1
    numbers = np.zeros(len(rows), dtype=np.int64)
    for column in rows.T:  # products of two counts fit into 64 bits, products of four do not
        numbers = np.unique(numbers * (column.max(initial=0) + 1) + column, return_inverse=True)[1].ravel()
    return numbers


class Mesh:
    """
    points       points x dimension
    blocks       list of (kind, nodes)
    groups       name -> elements
    side_groups  name -> rows of (element, side, its nodes or -1)

    A file with volume elements is a 3D mesh, and its surface elements are sides; otherwise the mesh is 2D, and its lines are sides."""

    def __init__(self, foreign, path):
        self.path, self.remarks = path, list(foreign.remarks)
        self._take_elements(foreign)
        self._take_points(foreign)
        self._turn_round()
        self._find_sides()
        self._take_groups(foreign)

    def _fail(self, message):
        raise ConvertError(f"{self.path}: {message}")

    def _take_elements(self, foreign):
        self.dimension = 3 if any(KINDS.get(kind, (0,))[0] == 3 for kind, _ in foreign.blocks) else 2
        known = [kind for kind, cell in CELLS.items() if cell.dimension == self.dimension]
        self.blocks, self.number = [], np.full(foreign.elements(), -1)  # number of each foreign element; -1: not an element of the mesh
        first = count = 0
        others = {}
        for kind, nodes in foreign.blocks:
            if kind in known:
                self.number[first:first + len(nodes)] = np.arange(count, count + len(nodes))
                self.blocks.append((kind, nodes.copy()))
                count += len(nodes)
            elif kind not in KINDS:
                others[kind] = others.get(kind, 0) + len(nodes)
            first += len(nodes)
        if others:
            kinds = ", ".join(f"{number} of the kind '{kind}'" for kind, number in sorted(others.items()))
            self._fail(f"elements unknown to Suture: {kinds}; known are {', '.join(CELLS)}. Export elements of order 1 or 2, "
                       "wedges and pyramids of order 1")
        if not count:
            self._fail(f"no surface elements and no volume elements; known are {', '.join(CELLS)}")

    def _take_points(self, foreign):
        used = np.unique(np.concatenate([nodes.ravel() for _, nodes in self.blocks]))
        points = foreign.points[used]
        if not np.isfinite(points).all():
            self._fail(f"point {used[~np.isfinite(points).all(axis=1)][0]} (counted from 0) has a coordinate that is not finite")
        flat = np.ptp(points[:, 2])
        if self.dimension == 2 and flat > 1e-9 * np.ptp(points[:, :2], axis=0).max():
            self._fail(f"the mesh has a thickness of {flat:g} in z but no volume elements; expected a 2D mesh with constant z, or a "
                       "mesh of volumes. Rotate it into the xy plane first")
        self.points = points[:, :self.dimension]
        self.new = np.full(len(foreign.points), -1)
        self.new[used] = np.arange(len(used))

    def _turn_round(self):
        turned = 0
        for b, (kind, nodes) in enumerate(self.blocks):
            nodes = in_order(kind, self.new[nodes], self.points)
            if nodes is None:
                self._fail(f"the mid-side nodes of elements of the kind '{kind}' are not between their vertices")
            inverted = sizes_of(kind, nodes, self.points) < 0
            nodes[inverted] = nodes[inverted][:, CELLS[kind].mirrored]
            turned += inverted.sum()
            self.blocks[b] = (kind, nodes)
        if turned:
            self.remarks.append(f"{turned} {'clockwise' if self.dimension == 2 else 'inverted'} elements reversed")

    def _find_sides(self):
        """All sides of elements: rows of (element, side, nodes), and their vertices."""
        rows, vertices = [], []
        first = 0
        for kind, nodes in self.blocks:
            for number, side in enumerate(CELLS[kind].sides):
                places = np.column_stack([np.arange(first, first + len(nodes)), np.full(len(nodes), number)])
                rows.append(np.hstack([places, padded(nodes[:, list(side)], MOST)]))
                vertices.append(padded(nodes[:, [node for node in side if node < CELLS[kind].vertices]], 4))
            first += len(nodes)
        self.sides, self.vertices = np.concatenate(rows), np.concatenate(vertices)

    def _take_groups(self, foreign):
        self.groups, self.side_groups = {}, {}
        sides = np.full((foreign.elements(), 4), -1)  # vertices of foreign elements that may be sides
        first = 0
        for kind, nodes in foreign.blocks:
            if KINDS.get(kind, (0,))[0] == self.dimension - 1:
                sides[first:first + len(nodes)] = self._renumbered(padded(nodes[:, :vertices_of(kind)], 4))
            first += len(nodes)
        wanted = {}
        for name, members in foreign.groups.items():
            numbers = np.unique(self.number[members])
            if (numbers >= 0).any():
                self.groups[name] = numbers[numbers >= 0]
            own = sides[members]
            wanted[name] = [own[(own != -1).any(axis=1)]]
        for name, own in foreign.side_sets.items():
            wanted.setdefault(name, []).append(self._renumbered(padded(own, 4)))
        self._add_sides({name: np.concatenate(rows) for name, rows in wanted.items() if sum(map(len, rows))})
        for name, nodes in foreign.node_sets.items():
            self._add_nodes(name, self.new[nodes])
        if not self.groups:
            self.groups["all"] = np.arange(sum(len(nodes) for _, nodes in self.blocks))
            self.remarks.append("the file has no element group: all elements form the group 'all'")

    def _renumbered(self, rows):
        """Numbers of the nodes in this mesh; -1: none; -2: a node without elements."""
        numbers = np.where(rows >= 0, self.new[rows], -1)
        numbers[(rows >= 0) & (numbers < 0)] = -2
        return numbers

    def _add_sides(self, wanted):
        """Adds the boundary sides that have all the vertices of a row."""
        counts = [len(rows) for rows in wanted.values()]
        numbers = numbered(np.concatenate([self.vertices, *wanted.values()]) + 1)
        own, asked = numbers[:len(self.sides)], np.split(numbers[len(self.sides):], np.cumsum(counts)[:-1])
        owners = np.bincount(own, minlength=numbers.max(initial=0) + 1)  # elements at each side
        row = np.zeros(len(owners), dtype=np.int64)
        row[own] = np.arange(len(own))
        self.boundary = self.sides[owners[own] == 1]
        self.boundary_vertices = self.vertices[owners[own] == 1]
        for name, ids in zip(wanted, asked):
            ids = np.unique(ids)
            found = owners[ids] == 1
            if (~found).any():
                self.remarks.append(f"group '{name}': {(~found).sum()} of its sides left out, {(owners[ids] > 1).sum()} of them inside the "
                                    "material, the others not sides of elements")
            self._add_rows(name, self.sides[row[ids[found]]])

    def sides_with(self, rows):
        """Boundary sides with the vertices of each row, in any order. \\return their rows, number of rows inside the material, of other rows"""
        if not hasattr(self, "_row_of"):
            vertices = np.sort(self.vertices, axis=1).tolist()
            self._row_of = {}
            for at, key in enumerate(map(tuple, vertices)):
                self._row_of[key] = -1 if key in self._row_of else at  # -1: two elements have this side
        found = [self._row_of.get(tuple(sorted([*row, *[-1] * (4 - len(row))])), -2) for row in rows]
        places = sorted({at for at in found if at >= 0})
        return self.sides[places], found.count(-1), found.count(-2)

    def _add_nodes(self, name, nodes):
        """Adds the boundary sides whose nodes (or vertices, if the set contains vertices only) are all in a set."""
        among = np.zeros(len(self.points) + 1, dtype=bool)  # the last entry means no node
        among[nodes] = True
        among[-1] = True
        between = np.where(np.arange(MOST) < (self.boundary_vertices >= 0).sum(axis=1)[:, None], -1, self.boundary[:, 2:])
        of = among[self.boundary_vertices].all(axis=1)
        if (among[between] & (between >= 0)).any():
            of &= among[between].all(axis=1)
        if of.any():
            self._add_rows(name, self.boundary[of])
        else:
            self.remarks.append(f"node set '{name}' left out: it contains no boundary side")

    def _add_rows(self, name, rows):
        if not len(rows):
            return
        if name in self.side_groups:
            rows = np.unique(np.vstack([self.side_groups[name], rows]), axis=0)
        self.side_groups[name] = rows[np.lexsort((rows[:, 1], rows[:, 0]))]
