"""suture_convert on 3D meshes: two elements of every shape in every format, one of them inverted, give the same mesh and groups.

convert_in_space.py --convert PROGRAM --work DIR --mpirun ""
"""
import sys

try:
    import h5py
    import meshio
    import netCDF4
    import numpy as np
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

from harness import arguments, check, finish, forked

options = arguments("--convert")
work = options.work

# Shapes as in VTK's file formats: vertices, edges with a midpoint node, sides with a centre node.
SQUARE = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
PLACES = {"tetra": [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], "hexahedron": [(x, y, z) for z in (-1, 1) for x, y in SQUARE],
          "wedge": [(x, y, z) for z in (-1, 1) for x, y in ((0, 0), (1, 0), (0, 1))],
          "pyramid": [(x, y, 0) for x, y in SQUARE] + [(0, 0, 1)]}
EDGES = {"tetra": [(0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)],
         "hexahedron": [(0, 1), (1, 2), (2, 3), (0, 3), (4, 5), (5, 6), (6, 7), (4, 7), (0, 4), (1, 5), (2, 6), (3, 7)]}
CENTRES = [(0, 3, 4, 7), (1, 2, 5, 6), (0, 1, 4, 5), (2, 3, 6, 7), (0, 1, 2, 3), (4, 5, 6, 7), tuple(range(8))]
# Sides by their vertices, in Suture's numbering (packages/mesh/Cell.cpp).
SIDES = {"tetra": [(0, 1, 2), (0, 1, 3), (1, 2, 3), (0, 2, 3)], "hexahedron": CENTRES[:6],
         "wedge": [(0, 1, 2), (3, 4, 5), (0, 1, 3, 4), (1, 2, 4, 5), (0, 2, 3, 5)],
         "pyramid": [(0, 1, 2, 3), (0, 1, 4), (1, 2, 4), (2, 3, 4), (0, 3, 4)]}
VOLUME = {"tetra": 1 / 6, "hexahedron": 8, "wedge": 1, "pyramid": 4 / 3}
NUMBER = {"tetra": 5, "tetra10": 6, "hexahedron": 7, "hexahedron20": 8, "hexahedron27": 9, "wedge": 10, "pyramid": 11}
COLUMNS = np.array([(1, .2, 0), (.1, 1, .3), (0, -.2, 1)])
FACETS = {3: "triangle", 4: "quad", 6: "triangle6", 8: "quad8", 9: "quad9"}


def family(kind):
    return kind.rstrip("0123456789")


def between(kind):
    """Vertices surrounding each node that is not a vertex."""
    return {"tetra10": EDGES["tetra"], "hexahedron20": EDGES["hexahedron"], "hexahedron27": EDGES["hexahedron"] + CENTRES}.get(kind, [])


def drawn(kind):
    places = [np.array(p, dtype=float) for p in PLACES[family(kind)]]
    return np.array(places + [np.mean([places[i] for i in around], axis=0) for around in between(kind)])


class Pair:
    """Two elements: the shape under an affine map, and its inverted mirror image behind the side `joint`."""

    def __init__(self, kind):
        self.kind, places = kind, drawn(kind)
        joint = SIDES[family(kind)][0]
        one = places @ COLUMNS
        a, b, c = one[list(joint[:3])]
        normal = np.cross(b - a, c - a)
        normal /= np.linalg.norm(normal)
        other = one - 2 * np.outer((one - a) @ normal, normal)
        self.points, self.elements = list(one), [list(range(len(one))), []]
        for i, p in enumerate(other):
            if np.linalg.norm(p - one[i]) < 1e-12:
                self.elements[1].append(i)
            else:
                self.elements[1].append(len(self.points))
                self.points.append(p)
        self.points = np.array(self.points)
        self.volume = abs(np.linalg.det(COLUMNS)) * VOLUME[family(kind)]
        self.skin = [(element, side) for element in range(2) for side in SIDES[family(kind)][1:]]  # all but the joint
        self.middles = [self.facet(element, side) for element, side in self.skin]

    def facet(self, element, side):
        """Nodes of a side: vertices in order, edge midpoints, centre."""
        nodes = self.elements[element]
        edges = EDGES.get(family(self.kind)) or [e for s in SIDES[family(self.kind)] for e in ring_edges(s, family(self.kind))]
        ring = [side[0]]
        while len(ring) < len(side):
            ring.append(next(i for i in side if i not in ring and tuple(sorted((i, ring[-1]))) in {tuple(sorted(e)) for e in edges}))
        whole = [nodes[i] for i in ring]
        extra = [frozenset(pair) for pair in zip(ring, ring[1:] + ring[:1])] + [frozenset(side)]
        numbers = {frozenset(around): len(PLACES[family(self.kind)]) + i for i, around in enumerate(between(self.kind))}
        return whole + [nodes[numbers[e]] for e in extra if e in numbers]

    def corners(self, side):
        return frozenset(tuple(np.round(self.points[node], 9)) for node in side)


def ring_edges(side, shape):
    """Edges of a side of a wedge or pyramid."""
    edges = {"wedge": [(0, 1), (1, 2), (0, 2), (3, 4), (4, 5), (3, 5), (0, 3), (1, 4), (2, 5)],
             "pyramid": [(0, 1), (1, 2), (2, 3), (0, 3), (0, 4), (1, 4), (2, 4), (3, 4)]}[shape]
    return [e for e in edges if set(e) <= set(side)]


def as_meshio(pair):
    facets = {}
    for nodes in pair.middles:
        facets.setdefault(FACETS[len(nodes)], []).append(nodes)
    return [(pair.kind, np.array(pair.elements))] + [(kind, np.array(nodes)) for kind, nodes in facets.items()]


def through_meshio(pair, path):
    cells = as_meshio(pair)
    mesh = meshio.Mesh(pair.points, cells)
    which = [np.full(len(nodes), 1 if b == 0 else 2) for b, (_, nodes) in enumerate(cells)]
    words = {}
    if path.suffix == ".msh":
        mesh.cell_data = {"gmsh:physical": which, "gmsh:geometrical": which}
        mesh.field_data = {"body": np.array([1, 3]), "skin": np.array([2, 2])}
        words = {"file_format": "gmsh22", "binary": "binary" in path.name}
    elif path.suffix == ".med":
        mesh.cell_data = {"cell_tags": [-5 - w for w in which]}
        mesh.cell_tags = {-6: ["body"], -7: ["skin"]}
        mesh.point_tags = {}
    else:
        mesh.cell_data = {name: [(w == number) * 1 for w in which] for number, name in ((1, "body"), (2, "skin"))}
    meshio.write(path, mesh, **words)


def labels(rows):
    return "".join(",\n".join(", ".join(map(str, row[i:i + 14])) for i in range(0, len(row), 14)) + "\n" for row in rows)


# Faces of Abaqus' solids, and the position of our nodes in its C3D27.
ABAQUS = {"tetra": [(0, 1, 2), (0, 1, 3), (1, 2, 3), (0, 2, 3)], "wedge": [(0, 1, 2), (3, 4, 5), (0, 1, 3, 4), (1, 2, 4, 5), (0, 2, 3, 5)],
          "hexahedron": [(0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 4, 5), (1, 2, 5, 6), (2, 3, 6, 7), (0, 3, 4, 7)],
          "pyramid": [(0, 1, 2, 3), (0, 1, 4), (1, 2, 4), (2, 3, 4), (0, 3, 4)]}
C3D = {"tetra": "C3D4", "tetra10": "C3D10M", "hexahedron": "C3D8R", "hexahedron20": "C3D20R",
       "hexahedron27": "C3D27", "wedge": "C3D6", "pyramid": "C3D5"}
C3D27 = [*range(20), 26, 24, 25, 22, 21, 23, 20]


def inp(pair):
    order = C3D27 if pair.kind == "hexahedron27" else range(len(pair.elements[0]))
    text = "*NODE\n" + labels((i + 1, *map(float, p)) for i, p in enumerate(pair.points))
    text += f"*ELEMENT, TYPE={C3D[pair.kind]}, ELSET=body\n"
    text += labels((11 + e, *(nodes[i] + 1 for i in order)) for e, nodes in enumerate(pair.elements))
    text += "*NSET, NSET=nodes\n" + labels([[node + 1 for nodes in pair.middles for node in nodes]]) + "*SURFACE, NAME=skin\n"
    return text + "".join(f"{11 + element}, S{1 + ABAQUS[family(pair.kind)].index(side)}\n" for element, side in pair.skin)


# Sides of Exodus, and the position of our nodes in its shapes.
EXODUS = {"tetra": [(0, 1, 3), (1, 2, 3), (0, 2, 3), (0, 1, 2)], "wedge": [(0, 1, 3, 4), (1, 2, 4, 5), (0, 2, 3, 5), (0, 1, 2), (3, 4, 5)],
          "hexahedron": [(0, 1, 4, 5), (1, 2, 5, 6), (2, 3, 6, 7), (0, 3, 4, 7), (0, 1, 2, 3), (4, 5, 6, 7)],
          "pyramid": [(0, 1, 4), (1, 2, 4), (2, 3, 4), (0, 3, 4), (0, 1, 2, 3)]}
LAYERS = [*range(12), *range(16, 20), *range(12, 16)]
EXODUS_ORDER = {"hexahedron20": LAYERS, "hexahedron27": [*LAYERS, 26, 24, 25, 20, 21, 22, 23]}


def exodus(pair, path):
    each, shape = len(pair.elements[0]), {"tetra": "TETRA", "hexahedron": "HEX", "wedge": "WEDGE", "pyramid": "PYRAMID"}[family(pair.kind)]
    order = EXODUS_ORDER.get(pair.kind, range(each))
    with netCDF4.Dataset(path, "w", format="NETCDF3_64BIT_OFFSET") as nc:
        for name, size in {"num_dim": 3, "num_nodes": len(pair.points), "num_elem": 2, "num_el_blk": 1, "num_side_sets": 1, "len_name": 33,
                           "num_el_in_blk1": 2, "num_nod_per_el1": each, "num_side_ss1": len(pair.skin)}.items():
            nc.createDimension(name, size)

        def put(name, kind, dimensions, values):
            nc.createVariable(name, kind, dimensions)[:] = values

        for k, name in enumerate(("coordx", "coordy", "coordz")):
            put(name, "f8", ("num_nodes",), pair.points[:, k])
        put("connect1", "i4", ("num_el_in_blk1", "num_nod_per_el1"), [[nodes[i] + 1 for i in order] for nodes in pair.elements])
        nc.variables["connect1"].elem_type = shape + str(each)
        put("elem_ss1", "i4", ("num_side_ss1",), [element + 1 for element, _ in pair.skin])
        put("side_ss1", "i4", ("num_side_ss1",), [1 + EXODUS[family(pair.kind)].index(side) for _, side in pair.skin])
        for what, dimension, name in (("eb", "num_el_blk", "body"), ("ss", "num_side_sets", "skin")):
            put(f"{what}_names", "S1", (dimension, "len_name"), np.array([list(name.ljust(33, "\0"))], dtype="S1"))


# Descriptors of I-DEAS, and the node order of its parabolic solids: around each layer, each vertex followed by the next midpoint.
UNV = {"tetra": (111, range(4)), "wedge": (112, range(6)), "hexahedron": (115, range(8)), "tetra10": (118, [0, 4, 1, 5, 2, 6, 7, 8, 9, 3]),
       "hexahedron20": (116, [0, 8, 1, 9, 2, 10, 3, 11, 16, 17, 18, 19, 4, 12, 5, 13, 6, 14, 7, 15])}


def unv(pair):
    def row(numbers):
        return "".join("".join(f"{n:10d}" for n in numbers[i:i + 8]) + "\n" for i in range(0, len(numbers), 8))

    def block(number, body):
        return f"    -1\n{number:6d}\n{body}    -1\n"

    descriptor, order = UNV[pair.kind]
    nodes = "".join(row([i + 1, 1, 1, 11]) + "".join(f"{v:25.16E}".replace("E", "D") for v in p) + "\n" for i, p in enumerate(pair.points))
    elements = "".join(row([e + 1, descriptor, 1, 1, 7, len(own)]) + row([own[i] + 1 for i in order])
                       for e, own in enumerate(pair.elements))
    groups = ""
    skin = sorted({n + 1 for own in pair.middles for n in own})
    for number, (name, code, tags) in enumerate([("body", 8, [1, 2]), ("skin", 7, skin)], 1):
        groups += row([number, 0, 0, 0, 0, 0, 0, len(tags)]) + name + "\n" + row([w for tag in tags for w in (code, tag, 0, 0)])
    return block(2411, nodes) + block(2412, elements) + block(2467, groups)


def are_middles(kind, places):
    """All nodes other than vertices lie at the mean of the surrounding vertices."""
    first = len(PLACES[family(kind)])
    return all(np.allclose(places[first + i], places[list(around)].mean(axis=0)) for i, around in enumerate(between(kind)))


def contents(path):
    with h5py.File(path) as file:
        points, offsets, nodes, cells = (file[name][:] for name in ("Coordinates", "Offsets", "Connectivity", "Cells"))
        kinds = [next(kind for kind, number in NUMBER.items() if number == cell) for cell in cells]
        elements = [points[nodes[a:b]] for a, b in zip(offsets, offsets[1:])]
        found = {"dimension": int(file["Dimension"][0]), "kinds": sorted(set(kinds)), "middles": True, "nodes": len(points)}
        volumes = []
        for kind, places in zip(kinds, elements):
            three = (1, 2, 3) if family(kind) in ("tetra", "wedge") else (1, 3, 4)
            part = {"tetra": 1 / 6, "hexahedron": 1, "wedge": 1 / 2, "pyramid": 1 / 3}[family(kind)]  # of the three edges' parallelepiped
            volumes.append(np.linalg.det(places[list(three)] - places[0]) * part)
            found["middles"] &= are_middles(kind, places)
        for member in file["ElementGroups"].values():
            found[member.attrs["Name"].decode()] = [round(volumes[e], 9) for e in member[:]]
        for member in file["SideGroups"].values():
            found[member.attrs["Name"].decode()] = {
                frozenset(tuple(np.round(elements[e][i], 9)) for i in SIDES[family(kinds[e])][s]) for e, s in member[:]}
    return found


for kind in NUMBER:
    pair = Pair(kind)
    skin = {pair.corners([pair.elements[element][i] for i in side]) for element, side in pair.skin}
    expected = {"dimension": 3, "kinds": [kind], "middles": True, "nodes": len(pair.points), "skin": skin,
                "body": [round(pair.volume, 9)] * 2}
    sources = [work / f"{kind}{end}" for end in (".vtu", ".vtk", ".text.msh", ".binary.msh", ".med")]
    for path in list(sources):
        try:
            through_meshio(pair, path)
        except (KeyError, meshio.WriteError) as error:  # the format does not have the shape
            print(f"        {path.name}: meshio cannot write it: {error!r}")
            sources.remove(path)
    (work / f"{kind}.inp").write_text(inp(pair))
    exodus(pair, work / f"{kind}.exo")
    sources += [work / f"{kind}.inp", work / f"{kind}.exo"]
    if kind in UNV:
        (work / f"{kind}.unv").write_text(unv(pair))
        sources.append(work / f"{kind}.unv")
    for source in sources:
        target = source.with_name(source.name + ".h5")
        code, text = forked(options.convert, source, target)
        check(f"{source.name}: exit code", (code, text if code else ""), (0, ""))
        if code:
            continue
        found = contents(target)
        if source.suffix == ".inp":  # the whole boundary as nodes
            check(f"{source.name}: sides whose nodes are in a set", found.pop("nodes", None) and found.get("skin"), skin)
            found["nodes"] = len(pair.points)
        check(f"{source.name}: the mesh and its groups", found, expected)
    own = work / f"{kind}.vtu.h5"
    msh = work / f"{kind}.again.msh"
    code, text = forked(options.convert, work / f"{kind}.vtu", msh)
    check(f"{kind}: exit code of conversion to .msh", (code, text if code else ""), (0, ""))
    gmsh = meshio.read(msh)  # it also has Gmsh's node order
    block = next(block for block in gmsh.cells if block.type == kind)
    check(f"{kind}: nodes in Gmsh's order", all(are_middles(kind, gmsh.points[nodes]) for nodes in block.data), True)
    check(f"{kind}: .msh again", forked(options.convert, msh, work / f"{kind}.again.h5")[0], 0)
    check(f"{kind}: the mesh and its groups again", contents(work / f"{kind}.again.h5"), expected)

# A group of sides inside the material; misplaced nodes; an unknown shape.
pair = Pair("hexahedron")
cells = as_meshio(pair) + [("quad", np.array([pair.facet(0, SIDES["hexahedron"][0])]))]
inside = [np.full(len(nodes), b == 2) * 1 for b, (_, nodes) in enumerate(cells)]
mesh = meshio.Mesh(pair.points, cells, cell_data={"inside": inside})
meshio.write(work / "inside.vtu", mesh)
code, text = forked(options.convert, work / "inside.vtu", work / "inside.h5")
check("a side inside the material is left out with a warning",
      (code, "group 'inside': 1 of its sides left out, 1 of them inside the material" in text), (0, True))
pair = Pair("tetra10")
pair.elements[0][9] = pair.elements[0][4]
pair.elements[1][9] = pair.elements[1][4]
through_meshio(pair, work / "wrong.vtu")
code, text = forked(options.convert, work / "wrong.vtu", work / "wrong.h5")
check("nodes that do not lie between their vertices",
      (code, "the mid-side nodes of elements of the kind 'tetra10' are not between their vertices" in text), (3, True))
meshio.write(work / "other.vtu", meshio.Mesh(np.zeros((18, 3)), [("wedge18", np.arange(18).reshape(1, 18))]))
code, text = forked(options.convert, work / "other.vtu", work / "other.h5")
check("a shape that Suture does not have", (code, "1 of the kind 'wedge18'; known are" in text), (3, True))
finish()
