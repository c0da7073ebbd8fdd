"""Shapes of elements by meshio's names. Nodes are in VTK's order as in Suture (mesh/Cell.cpp): vertices, then the nodes between them."""
import numpy as np

TRIANGLE, SQUARE = [(0, 1), (1, 2), (2, 0)], [(0, 1), (1, 2), (2, 3), (3, 0)]
CUBE = [*SQUARE, (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
CUBE_SIDES = [(0, 4, 7, 3), (1, 2, 6, 5), (0, 1, 5, 4), (3, 7, 6, 2), (0, 3, 2, 1), (4, 5, 6, 7)]
TETRAHEDRON = [*TRIANGLE, (0, 3), (1, 3), (2, 3)]
TETRAHEDRON_SIDES = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]
# Vertex positions that are invariant under an exchange of x and y.
PLACES = {"triangle": [(0, 0), (1, 0), (0, 1)], "quad": [(-1, -1), (1, -1), (1, 1), (-1, 1)],
          "tetra": [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)],
          "hexahedron": [(*p, z) for z in (-1, 1) for p in ((-1, -1), (1, -1), (1, 1), (-1, 1))],
          "wedge": [(*p, z) for z in (-1, 1) for p in ((0, 0), (1, 0), (0, 1))],
          "pyramid": [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0), (0, 0, 1)]}


class Cell:
    """
    number, gmsh  Suture's Cell, Gmsh's type
    vertices      number of vertices
    between       vertices around each other node: two for an edge, four for a side, or all
    sides         local nodes of each side: vertices counter-clockwise seen from outside, mid-edge nodes, centre
    mirrored      node order of the reversed shape
    gmsh_order    node i in Gmsh's order is node gmsh_order[i] here
    """

    def __init__(self, number, gmsh, family, sides, between=(), gmsh_between=None):
        self.number, self.gmsh, self.vertices, self.between = number, gmsh, len(PLACES[family]), list(between)
        self.dimension, self.nodes = len(PLACES[family][0]), self.vertices + len(self.between)
        at = {frozenset(around): self.vertices + i for i, around in enumerate(self.between)}

        def whole(side):
            steps = [side] if self.dimension == 2 else [*zip(side, side[1:] + side[:1]), side]
            return (*side, *(at[frozenset(step)] for step in steps if frozenset(step) in at))

        self.sides = [whole(side) for side in sides]
        places = [np.array(place, dtype=float) for place in PLACES[family]]
        places += [np.mean([places[i] for i in around], axis=0) for around in self.between]
        numbers = {tuple(place): i for i, place in enumerate(places)}
        self.mirrored = [numbers[(p[1], p[0], *p[2:])] for p in places]
        order = self.between if gmsh_between is None else gmsh_between
        self.gmsh_order = [*range(self.vertices), *(at[frozenset(around)] for around in order)]


FACES = [(0, 3, 2, 1), (0, 1, 5, 4), (0, 4, 7, 3), (1, 2, 6, 5), (2, 3, 7, 6), (4, 5, 6, 7)]  # in Gmsh's order of their centres
ALL = tuple(range(8))
GMSH_CUBE = sorted(tuple(sorted(edge)) for edge in CUBE)
CELLS = {
    "triangle": Cell(0, 2, "triangle", TRIANGLE),
    "triangle6": Cell(1, 9, "triangle", TRIANGLE, TRIANGLE),
    "quad": Cell(2, 3, "quad", SQUARE),
    "quad8": Cell(3, 16, "quad", SQUARE, SQUARE),
    "quad9": Cell(4, 10, "quad", SQUARE, [*SQUARE, (0, 1, 2, 3)]),
    "tetra": Cell(5, 4, "tetra", TETRAHEDRON_SIDES),
    "tetra10": Cell(6, 11, "tetra", TETRAHEDRON_SIDES, TETRAHEDRON, [*TRIANGLE, (0, 3), (2, 3), (1, 3)]),
    "hexahedron": Cell(7, 5, "hexahedron", CUBE_SIDES),
    "hexahedron20": Cell(8, 17, "hexahedron", CUBE_SIDES, CUBE, GMSH_CUBE),
    "hexahedron27": Cell(9, 12, "hexahedron", CUBE_SIDES, [*CUBE, *CUBE_SIDES, ALL], [*GMSH_CUBE, *FACES, ALL]),
    "wedge": Cell(10, 6, "wedge", [(0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)]),
    "pyramid": Cell(11, 7, "pyramid", [(0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)]),
}
# Kinds of elements that are converted: dimension, nodes.
KINDS = {"vertex": (0, 1), "line": (1, 2), "line3": (1, 3), **{kind: (cell.dimension, cell.nodes) for kind, cell in CELLS.items()}}
SIDE_KINDS = {(2, 2): "line", (2, 3): "line3", (3, 3): "triangle", (3, 4): "quad", (3, 6): "triangle6", (3, 8): "quad8", (3, 9): "quad9"}


def vertices_of(kind):
    """Number of vertices of an element or a side; they are its first nodes."""
    return CELLS[kind].vertices if kind in CELLS else 2


def in_order(kind, nodes, points):
    """Nodes of 3D elements with the nodes between vertices in Suture's order, for any order in the file: determined from the geometry, averaged
    over all elements. None: they are not between the vertices."""
    cell = CELLS[kind]
    if cell.dimension == 2 or not cell.between or not len(nodes):
        return nodes
    corners = points[nodes[:, :cell.vertices]]
    size = np.linalg.norm(np.ptp(corners, axis=1), axis=1)
    order = []
    for around in cell.between:
        target = corners[:, list(around)].mean(axis=1)
        away = [(np.linalg.norm(points[nodes[:, i]] - target, axis=1) / size).mean() for i in range(cell.vertices, cell.nodes)]
        order.append(cell.vertices + int(np.argmin(away)))
    if len(set(order)) < len(order):
        return None
    return nodes[:, [*range(cell.vertices), *order]]


def sizes_of(kind, nodes, points):
    """Signed areas or volumes of the polygons or polyhedra of the vertices."""
    cell = CELLS[kind]
    corners = points[nodes[:, :cell.vertices]] - points[nodes[:, :1]]
    if cell.dimension == 2:
        following = np.roll(corners, -1, axis=1)
        return (corners[..., 0] * following[..., 1] - corners[..., 1] * following[..., 0]).sum(axis=1) / 2
    total = np.zeros(len(nodes))
    for side in cell.sides:
        own = [corners[:, i] for i in side if i < cell.vertices]
        centre = sum(own) / len(own)
        for a, b in zip(own, own[1:] + own[:1]):
            total += np.einsum("ij,ij->i", centre, np.cross(a, b))
    return total / 6
