"""The plane mesh of Suture that is in a Foreign one: elements turned counter-clockwise, groups of elements and of boundary sides."""
import numpy as np

from .foreign import KINDS, ConvertError

# Each kind: number of Suture's Cell, Gmsh's type, sides (end points, middle), order of the nodes seen from behind.
CELLS = {
    "triangle": (0, 2, [(0, 1), (1, 2), (2, 0)], [0, 2, 1]),
    "triangle6": (1, 9, [(0, 1, 3), (1, 2, 4), (2, 0, 5)], [0, 2, 1, 5, 4, 3]),
    "quad": (2, 3, [(0, 1), (1, 2), (2, 3), (3, 0)], [0, 3, 2, 1]),
    "quad8": (3, 16, [(0, 1, 4), (1, 2, 5), (2, 3, 6), (3, 0, 7)], [0, 3, 2, 1, 7, 6, 5, 4]),
    "quad9": (4, 10, [(0, 1, 4), (1, 2, 5), (2, 3, 6), (3, 0, 7)], [0, 3, 2, 1, 7, 6, 5, 4, 8]),
}


class Plane:
    """points x 2; blocks of (kind, nodes); groups: name -> elements; side_groups: name -> rows of (element, side, nodes of it)."""

    def __init__(self, foreign, path):
        self.path, self.remarks = path, list(foreign.remarks)
        self._take_elements(foreign)
        self._take_points(foreign)
        self._find_boundary()
        self._take_groups(foreign)

    def _fail(self, message):
        raise ConvertError(f"{self.path}: {message}")

    def _take_elements(self, foreign):
        self.blocks, self.number = [], np.full(foreign.elements(), -1)  # of each foreign element; -1: no surface element
        first = count = 0
        solid = {}
        for kind, nodes in foreign.blocks:
            if kind in CELLS:
                self.number[first:first + len(nodes)] = np.arange(count, count + len(nodes))
                self.blocks.append((kind, nodes.copy()))
                count += len(nodes)
            elif kind not in KINDS:
                solid[kind] = solid.get(kind, 0) + len(nodes)
            first += len(nodes)
        if solid:
            kinds = ", ".join(f"{number} of the kind '{kind}'" for kind, number in sorted(solid.items()))
            self._fail(f"elements that a plane scene cannot have: {kinds}; known are {', '.join(CELLS)}. Export the surface mesh only, of order 1 or 2")
        if not count:
            self._fail(f"no surface elements; known are {', '.join(CELLS)}")

    def _take_points(self, foreign):
        used = np.unique(np.concatenate([nodes.ravel() for _, nodes in self.blocks]))
        points = foreign.points[used]
        if not np.isfinite(points).all():
            self._fail(f"point {used[~np.isfinite(points).all(axis=1)][0]} (counted from 0) has a coordinate that is not finite")
        flat = np.ptp(points[:, 2])
        if flat > 1e-9 * np.ptp(points[:, :2], axis=0).max():
            self._fail(f"the mesh is {flat:g} thick in z; expected a plane mesh, z the same everywhere. Turn it into the plane of x and y first")
        self.points = points[:, :2]
        self.new = np.full(len(foreign.points), -1)
        self.new[used] = np.arange(len(used))
        turned = 0
        for b, (kind, nodes) in enumerate(self.blocks):
            nodes = self.new[nodes]
            corners = self.points[nodes[:, :len(CELLS[kind][2])]]
            following = np.roll(corners, -1, axis=1)
            clockwise = (corners[..., 0] * following[..., 1] - corners[..., 1] * following[..., 0]).sum(axis=1) < 0
            nodes[clockwise] = nodes[clockwise][:, CELLS[kind][3]]
            turned += clockwise.sum()
            self.blocks[b] = (kind, nodes)
        if turned:
            self.remarks.append(f"{turned} clockwise elements turned round")

    def _find_boundary(self):
        ends, places, nodes3 = [], [], []
        first = 0
        for kind, nodes in self.blocks:
            for side, of in enumerate(CELLS[kind][2]):
                ends.append(nodes[:, of[:2]])
                places.append(np.column_stack([np.arange(first, first + len(nodes)), np.full(len(nodes), side)]))
                middle = nodes[:, of[2]] if len(of) > 2 else np.full(len(nodes), -1)
                nodes3.append(np.column_stack([nodes[:, of[:2]], middle]))
            first += len(nodes)
        keys = self._keys(np.concatenate(ends))
        _, where, counts = np.unique(keys, return_index=True, return_counts=True)
        where = where[counts == 1]
        self.boundary_keys = keys[where]  # ascending
        self.boundary = np.column_stack([np.concatenate(places)[where], np.concatenate(nodes3)[where]])  # element, side, ends, middle
        self.inner_keys = np.setdiff1d(keys, self.boundary_keys)

    def _keys(self, ends):
        return ends.min(axis=1) * np.int64(len(self.points)) + ends.max(axis=1)

    def _take_groups(self, foreign):
        self.groups, self.side_groups = {}, {}
        ends = np.full((foreign.elements(), 2), -1)
        first = 0
        for kind, nodes in foreign.blocks:
            if KINDS.get(kind, (0,))[0] == 1:
                ends[first:first + len(nodes)] = self.new[nodes[:, :2]]
            first += len(nodes)
        for name, members in foreign.groups.items():
            numbers = np.unique(self.number[members])
            numbers = numbers[numbers >= 0]
            lines = ends[members]
            lines = lines[(self.number[members] < 0) & (lines >= 0).all(axis=1)]
            if len(numbers):
                self.groups[name] = numbers
            if len(lines):
                self._add_sides(name, lines)
        for name, sides in foreign.side_sets.items():
            self._add_sides(name, self.new[sides])
        for name, nodes in foreign.node_sets.items():
            among = np.zeros(len(self.points) + 1, dtype=bool)  # the last one stands for no node
            among[self.new[nodes]] = True
            among[-1] = False
            middle = self.boundary[:, 4]
            has_middles = among[middle[middle >= 0]].any()
            of = among[self.boundary[:, 2]] & among[self.boundary[:, 3]] & (~has_middles | (middle < 0) | among[middle])
            if of.any():
                self._add_rows(name, self.boundary[of])
            else:
                self.remarks.append(f"node set '{name}' left out: it holds no side of the boundary")
        if not self.groups:
            self.groups["all"] = np.arange(sum(len(nodes) for _, nodes in self.blocks))
            self.remarks.append("the file has no group of elements: all of them are the group 'all'")

    def _add_sides(self, name, ends):
        keys = np.unique(self._keys(ends[(ends >= 0).all(axis=1)]))
        at = np.minimum(np.searchsorted(self.boundary_keys, keys), len(self.boundary_keys) - 1)
        found = self.boundary_keys[at] == keys
        if (~found).any():
            inside = np.isin(keys, self.inner_keys).sum()
            self.remarks.append(f"group '{name}': {(~found).sum()} of its sides left out, {inside} of them inside the material, "
                                "the others no side of an element")
        if found.any():
            self._add_rows(name, self.boundary[at[found]])

    def _add_rows(self, name, rows):
        if name in self.side_groups:
            rows = np.unique(np.vstack([self.side_groups[name], rows]), axis=0)
        self.side_groups[name] = rows[np.lexsort((rows[:, 1], rows[:, 0]))]
