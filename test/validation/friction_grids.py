"""Bodies of random scenes as grids of cells: patches of mapped grids, joined at common nodes, written as one mesh in Gmsh's format 2.2."""
import math

LINES = {1: 1, 2: 8}
# Cell: Gmsh's number, order, and nodes after the vertices: edges by vertex pairs, then sides, then the cell.
CELLS = {
    "Triangle3": (2, 1, []),
    "Triangle6": (9, 2, [(0, 1), (1, 2), (2, 0)]),
    "Quadrilateral4": (3, 1, []),
    "Quadrilateral8": (16, 2, [(0, 1), (1, 2), (2, 3), (3, 0)]),
    "Quadrilateral9": (10, 2, [(0, 1), (1, 2), (2, 3), (3, 0), (0, 1, 2, 3)]),
    "Tetrahedron4": (4, 1, []),
    "Tetrahedron10": (11, 2, [(0, 1), (1, 2), (0, 2), (0, 3), (2, 3), (1, 3)]),
    "Hexahedron8": (5, 1, []),
    "Hexahedron20": (17, 2, [(0, 1), (0, 3), (0, 4), (1, 2), (1, 5), (2, 3), (2, 6), (3, 7), (4, 5), (4, 7), (5, 6), (6, 7)]),
    "Hexahedron27": (12, 2, [(0, 1), (0, 3), (0, 4), (1, 2), (1, 5), (2, 3), (2, 6), (3, 7), (4, 5), (4, 7), (5, 6), (6, 7),
                             (0, 3, 2, 1), (0, 1, 5, 4), (0, 4, 7, 3), (1, 2, 6, 5), (2, 3, 7, 6), (4, 5, 6, 7), tuple(range(8))]),
    "Wedge6": (6, 1, []),
}
FACES = {"Tetrahedron4": "Triangle3", "Tetrahedron10": "Triangle6", "Hexahedron8": "Quadrilateral4", "Hexahedron20": "Quadrilateral8",
         "Hexahedron27": "Quadrilateral9"}
CORNERS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
# Kuhn's six tetrahedra about the diagonal of a cube: the diagonals of opposite faces are parallel.
TETRAHEDRA = [(0, 1, 2, 6), (0, 5, 1, 6), (0, 4, 5, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6)]


class Mesh:
    """Nodes and groups of elements. Coincident nodes of one body are merged."""

    def __init__(self):
        self.nodes, self.groups, self.elements = [], {}, []

    def group(self, dimension, name):
        return self.groups.setdefault((dimension, name), len(self.groups) + 1)

    def patch(self, body, cell, cells, place, sides, index):
        """A grid of `cells` (two or three numbers) under the map `place` of the unit square or cube. `sides`: names of its faces ("s0",
        "s1", "t0", "t1", "r0", "r1"; none: no side). `index`: the nodes of the body, by coordinates."""
        d = len(cells)

        def node(at):
            point = tuple(place(*(a / (2 * n) for a, n in zip(at, cells))))
            key = tuple(round(x * 1e7) for x in point)
            if key not in index:
                self.nodes.append(point + (0.0,) * (3 - len(point)))
                index[key] = len(self.nodes)
            return index[key]

        def element(kind, group, vertices):
            number, _, more = CELLS[kind]
            middle = lambda of: tuple(sum(vertices[k][c] for k in of) // len(of) for c in range(d))
            self.elements.append((number, group, [node(v) for v in vertices] + [node(middle(of)) for of in more]))

        volume = self.group(d, body)
        for at in grid(cells):
            corners = [tuple(2 * (a + c) for a, c in zip(at, corner)) for corner in CORNERS[:2 ** d]]
            for kind, vertices in divided(cell, corners, sum(at) % 2):
                element(kind, volume, vertices)
        order = CELLS[cell][1]
        for face, name in sides.items():
            if not name:
                continue
            axis, end = "str".index(face[0]), int(face[1])
            group = self.group(d - 1, body + "_" + name)
            rest = [k for k in range(d) if k != axis]
            for at in grid([cells[k] for k in rest]):
                def corner(*shift):
                    full = [0] * d
                    full[axis] = 2 * cells[axis] * end
                    for k, a, s in zip(rest, at, shift):
                        full[k] = 2 * (a + s)
                    return tuple(full)
                if d == 2:
                    a, b = corner(0), corner(1)
                    middle = [tuple((x + y) // 2 for x, y in zip(a, b))] if order == 2 else []
                    self.elements.append((LINES[order], group, [node(at) for at in [a, b, *middle]]))
                    continue
                quad = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)]
                kind = FACES.get(cell) or ("Triangle3" if axis == 2 else "Quadrilateral4")
                for part in ([(0, 1, 2), (0, 2, 3)] if kind.startswith("Triangle") else [(0, 1, 2, 3)]):
                    element(kind, group, [quad[k] for k in part])

    def write(self, path):
        with open(path, "w") as file:
            file.write("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n%d\n" % len(self.groups))
            for (dimension, name), number in self.groups.items():
                file.write('%d %d "%s"\n' % (dimension, number, name))
            file.write("$EndPhysicalNames\n$Nodes\n%d\n" % len(self.nodes))
            for k, point in enumerate(self.nodes):
                file.write("%d %.17g %.17g %.17g\n" % (k + 1, *point))
            file.write("$EndNodes\n$Elements\n%d\n" % len(self.elements))
            for k, (number, group, nodes) in enumerate(self.elements):
                file.write("%d %d 2 %d %d %s\n" % (k + 1, number, group, group, " ".join(map(str, nodes))))
            file.write("$EndElements\n")


def grid(cells):
    """All cells of a grid."""
    if len(cells) == 1:
        return [(i,) for i in range(cells[0])]
    if len(cells) == 2:
        return [(i, j) for j in range(cells[1]) for i in range(cells[0])]
    return [(i, j, k) for k in range(cells[2]) for j in range(cells[1]) for i in range(cells[0])]


def divided(cell, corners, odd):
    """The elements of a square or cube of the grid, by their vertices."""
    if cell.startswith("Triangle"):
        a, b, c, d = corners
        return [(cell, t) for t in ([(a, b, c), (a, c, d)] if not odd else [(a, b, d), (b, c, d)])]
    if cell.startswith("Tetrahedron"):
        return [(cell, [corners[k] for k in t]) for t in TETRAHEDRA]
    if cell == "Wedge6":
        return [(cell, [corners[k] for k in t]) for t in ((0, 1, 2, 4, 5, 6), (0, 2, 3, 4, 6, 7))]
    return [(cell, corners)]


def straight(*corners):
    """The bilinear map onto a quadrilateral with anticlockwise corners."""
    a, b, c, d = corners
    return lambda s, t: tuple((1 - s) * (1 - t) * a[k] + s * (1 - t) * b[k] + s * t * c[k] + (1 - s) * t * d[k] for k in range(2))


def arc(centre, inner, outer, begin, end):
    """The map onto a ring segment: s along the angle, t from the outer radius inwards."""
    def place(s, t):
        radius, angle = outer + (inner - outer) * t, begin + (end - begin) * s
        return centre[0] + radius * math.cos(angle), centre[1] + radius * math.sin(angle)
    return place


def deep(place, depth):
    """The prism over a 2D map: r along z."""
    return lambda s, t, r: (*place(s, t), depth * (r - 0.5))


def rotation(random, dimension):
    """A random 2D or 3D rotation matrix, as rows."""
    if dimension == 2:
        a = random.uniform(0, 2 * math.pi)
        return [[math.cos(a), -math.sin(a)], [math.sin(a), math.cos(a)]]
    w, x, y, z = (random.gauss(0, 1) for _ in range(4))
    n = math.sqrt(w * w + x * x + y * y + z * z)
    w, x, y, z = w / n, x / n, y / n, z / n
    return [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
