"""Topology of 3D cells by their VTK types, and the linear parts into which they are split for plotting.

Nodes are numbered as in the files.
"""
from functools import cached_property

import numpy as np

TETRAHEDRON_EDGES = ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))
CUBE_EDGES = ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7))
TETRAHEDRON_FACES = ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2))
CUBE_FACES = ((0, 4, 7, 3), (1, 2, 6, 5), (0, 1, 5, 4), (3, 7, 6, 2), (0, 3, 2, 1), (4, 5, 6, 7))
WEDGE_FACES = ((0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5))
PYRAMID_FACES = ((0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4))


class Face:
    """Shape of a face with a given number of nodes: vertices, mid-edge nodes, centre node, if present.

    It is plotted as triangles, a quadrilateral as a fan about its centre; a missing centre node is added by the shape functions.
    """

    def __init__(self, vertices, outline, triangles, beside, centre=None):
        self.vertices, self.outline = vertices, np.array(outline)
        self.triangles = np.array(triangles)
        self.beside = np.array(beside)  # triangle at each part of the outline
        self.centre = None if centre is None else np.array(centre)  # weights of the nodes


def fan(outline, centre=None):
    parts = len(outline)
    return Face(4, outline, [(a, b, 8 if parts == 8 else 4) for a, b in zip(outline, np.roll(outline, -1))], range(parts), centre)


ROUND = (0, 4, 1, 5, 2, 6, 3, 7)  # outline of a second-order quadrilateral
FACES = {
    3: Face(3, (0, 1, 2), [(0, 1, 2)], (0, 0, 0)), 4: fan((0, 1, 2, 3), [0.25] * 4),
    6: Face(3, (0, 3, 1, 4, 2, 5), [(0, 3, 5), (3, 1, 4), (5, 4, 2), (3, 4, 5)], (0, 1, 1, 2, 2, 0)),
    8: fan(ROUND, [-0.25] * 4 + [0.5] * 4), 9: fan(ROUND)
}


def with_centres(values, centres):
    """Values at vertices, followed by values at centres of faces. `centres`: [(vertices of each face, weights)]"""
    return np.concatenate([values, *(np.tensordot(values[faces], weights, axes=(1, 0)) for faces, weights in centres)])


class Cell:
    """Shape of a cell; its vertices come first.

    Face nodes are anticlockwise seen from outside: vertices, mid-edge nodes, centre. `centre`: weights of the nodes for the cell centre.
    """

    def __init__(self, nodes, vertices, faces, centre):
        self.nodes, self.vertices, self.centre = nodes, vertices, np.array(centre)
        self.faces = [np.array(face) for face in faces]

    @cached_property
    def tetrahedra(self):
        """(weights, tetrahedra): the cell as tetrahedra from its centre to the triangles of its faces, which neighbours share.

        One row of weights per point: the nodes, the centres of faces without a centre node, the cell centre.
        """
        rows, found = list(np.eye(self.nodes)), []
        for face in self.faces:
            shape = FACES[len(face)]
            points = list(face)
            if shape.centre is not None:
                points.append(len(rows))
                rows.append(shape.centre @ np.eye(self.nodes)[face])
            found += [[points[i] for i in triangle] for triangle in shape.triangles]
        rows.append(self.centre)
        return np.array(rows), np.array([[*triangle, len(rows) - 1] for triangle in found])


def with_middles(faces, edges, vertices):
    """Faces of a second-order cell."""
    middle = {frozenset(edge): vertices + number for number, edge in enumerate(edges)}
    return [(*face, *(middle[frozenset(ends)] for ends in zip(face, (*face[1:], face[0])))) for face in faces]


CUBE_MIDDLES = with_middles(CUBE_FACES, CUBE_EDGES, 8)
CELLS = {
    10: Cell(4, 4, TETRAHEDRON_FACES, [1 / 4] * 4),
    24: Cell(10, 4, with_middles(TETRAHEDRON_FACES, TETRAHEDRON_EDGES, 4), [-1 / 8] * 4 + [1 / 4] * 6),
    12: Cell(8, 8, CUBE_FACES, [1 / 8] * 8),
    25: Cell(20, 8, CUBE_MIDDLES, [-1 / 4] * 8 + [1 / 4] * 12),
    29: Cell(27, 8, [(*face, 20 + number) for number, face in enumerate(CUBE_MIDDLES)], [0] * 26 + [1]),
    13: Cell(6, 6, WEDGE_FACES, [1 / 6] * 6),
    14: Cell(5, 5, PYRAMID_FACES, [1 / 5] * 5)
}
