"""Boxes and rectangles of elements with node labels, from which the sample decks are written."""
import itertools

import numpy as np

CUBE = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2)]
EDGES = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
TET_EDGES = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]
FACES = {"bottom": (2, 0, "S1"), "top": (2, 1, "S2"), "front": (1, 0, "S3"), "right": (0, 1, "S4"), "back": (1, 1, "S5"), "left": (0, 0, "S6")}


def listed(words, each=10):
    """Data lines of a list; a comma continues it."""
    return "".join(", ".join(map(str, words[i:i + each])) + (",\n" if i + each < len(words) else "\n") for i in range(0, len(words), each))


def middle(one, other):
    return tuple((a + b) // 2 for a, b in zip(one, other))


class Grid:
    """Box of elements; nodes have positions in half cells.

    shape  hex8, hex20 or tet10
    """

    def __init__(self, cells, low, high, shape="hex8", first_node=1, first_element=1, keep=lambda centre: True):
        self.cells, self.low, self.high = np.array(cells), np.array(low, float), np.array(high, float)
        self.shape, self.label, self.points, self.elements, self.cell_of = shape, {}, {}, {}, {}
        self.next_node, element = first_node, first_element
        for cell in sorted(itertools.product(*map(range, cells)), key=lambda c: c[::-1]):
            corners = [tuple(2 * c + d for c, d in zip(cell, corner)) for corner in CUBE]
            if not keep(self.place(middle(corners[0], corners[6]))):
                continue
            for nodes in self.divided(corners):
                self.elements[element] = [self.node(n) for n in nodes]
                self.cell_of[element] = cell
                element += 1
        self.next_element = element

    def divided(self, corners):
        if self.shape == "hex8":
            return [corners]
        if self.shape == "hex20":
            return [corners + [middle(corners[a], corners[b]) for a, b in EDGES]]
        tets = []  # Kuhn's six tetrahedra of a cube
        for order in itertools.permutations(range(3)):
            path = [np.array(corners[0])]
            for axis in order:
                path.append(path[-1] + 2 * np.eye(3, dtype=int)[axis])
            if np.linalg.det(np.array([p - path[0] for p in path[1:]])) < 0:
                path[1], path[2] = path[2], path[1]
            vertices = [tuple(int(x) for x in p) for p in path]
            tets.append(vertices + [middle(vertices[a], vertices[b]) for a, b in TET_EDGES])
        return tets

    def place(self, at):
        return self.low + (self.high - self.low) * np.array(at) / (2 * self.cells)

    def node(self, at):
        if at not in self.label:
            self.label[at] = self.next_node
            self.points[self.next_node] = self.place(at)
            self.next_node += 1
        return self.label[at]

    def nodes_text(self):
        return "".join(f"{label}, {x:.12g}, {y:.12g}, {z:.12g}\n" for label, (x, y, z) in self.points.items())

    def elements_text(self):
        return "".join(listed([label, *nodes]) for label, nodes in self.elements.items())

    def nodes_where(self, condition):
        return [label for label, point in self.points.items() if condition(*point)]

    def layer(self, axis, end, condition=lambda centre: True):
        """Labels of hexahedra whose cell is the first (0) or last (1) along an axis"""
        wanted = 0 if end == 0 else self.cells[axis] - 1
        return [label for label, cell in self.cell_of.items() if cell[axis] == wanted and condition(self.place([2 * c + 1 for c in cell]))]

    def facets(self, condition, first):
        """Triangles of tetrahedra whose nodes satisfy a condition: label -> nodes"""
        found = {}
        for nodes in self.elements.values():
            for face in ((0, 1, 2), (0, 1, 3), (1, 2, 3), (0, 2, 3)):
                if all(condition(*self.points[nodes[k]]) for k in face):
                    edges = [TET_EDGES.index(next(e for e in TET_EDGES if set(e) == {face[i], face[(i + 1) % 3]})) for i in range(3)]
                    found[first + len(found)] = [nodes[k] for k in face] + [nodes[4 + e] for e in edges]
        return found

    def tet_sides(self, condition):
        """'label, Sn' of the sides of tetrahedra whose nodes satisfy a condition"""
        return [(label, f"S{k + 1}") for label, nodes in self.elements.items() for k, face in enumerate(((0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0)))
                if all(condition(*self.points[nodes[i]]) for i in face)]


class PlaneGrid:
    """Rectangle of 8-node quadrilaterals"""

    def __init__(self, cells, low, high, first_node, first_element):
        self.label, self.points, self.elements, self.cell_of = {}, {}, {}, {}
        self.cells, self.low, self.high, self.next_node, element = np.array(cells), np.array(low, float), np.array(high, float), first_node, first_element
        for j in range(cells[1]):
            for i in range(cells[0]):
                corners = [(2 * i, 2 * j), (2 * i + 2, 2 * j), (2 * i + 2, 2 * j + 2), (2 * i, 2 * j + 2)]
                nodes = corners + [middle(corners[k], corners[(k + 1) % 4]) for k in range(4)]
                self.elements[element] = [self.node(n) for n in nodes]
                self.cell_of[element] = (i, j)
                element += 1
        self.next_element = element

    node = Grid.node
    nodes_where = Grid.nodes_where

    def place(self, at):
        return np.array([*(self.low + (self.high - self.low) * np.array(at) / (2 * self.cells)), 0.0])
