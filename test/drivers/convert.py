"""suture_convert as a user runs it: one mesh in every format, as the original program writes it, gives the same mesh and groups.

convert.py --convert PROGRAM --solve PROGRAM --mpirun "mpirun ..." --work DIR
"""
import re
import subprocess
import sys

try:
    import h5py
    import meshio
    import netCDF4
    import numpy as np
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

from harness import arguments, check, finish, forked, run

options = arguments("--convert", "--solve")
work = options.work

# Two bodies without common nodes: quadrilaterals below, triangles above; one quadrilateral is clockwise.
X = [0.0, 1.0, 2.0]
LOWER = [(x, y) for y in (0.0, 1.0) for x in X]
UPPER = [(x, y) for y in (1.0, 2.0) for x in X]
POINTS = LOWER + UPPER
QUADS = [(0, 1, 4, 3), (1, 4, 5, 2)]
TRIANGLES = [(6, 7, 10), (6, 10, 9), (7, 8, 10), (8, 11, 10)]
BOTTOM, TOP = [(0, 1), (1, 2)], [(9, 10), (10, 11)]


def quadratic():
    """The same mesh with mid-side nodes: points, elements, sides."""
    points, middles = list(POINTS), {}

    def middle(a, b):
        key = (min(a, b), max(a, b))
        if key not in middles:
            middles[key] = len(points)
            points.append(tuple((np.array(points[a]) + points[b]) / 2))
        return middles[key]

    def whole(element):
        return (*element, *(middle(a, b) for a, b in zip(element, element[1:] + element[:1])))

    return points, [whole(e) for e in QUADS], [whole(e) for e in TRIANGLES], [(a, b, middle(a, b)) for a, b in BOTTOM], [(a, b, middle(a, b)) for a, b in TOP]


def labels(rows):
    return "".join(", ".join(str(word) for word in row) + "\n" for row in rows)


def inp(points, quads, triangles, kinds):
    """Labels begin at 101; the set of the upper body consists of numbers, a range and another set."""
    text = "** comment\n*Heading\n two bodies\n*NODE, NSET=Nall\n" + labels((101 + i, x, y, 0.0) for i, (x, y) in enumerate(points))
    text += f"*ELEMENT, TYPE={kinds[0]}, ELSET=lower\n" + labels((11 + i, *(101 + n for n in e)) for i, e in enumerate(quads))
    text += f"*Element, type={kinds[1]}\n" + labels((21 + i, *(101 + n for n in e)) for i, e in enumerate(triangles))
    text += "*ELSET, ELSET=part, GENERATE\n21, 23, 2\n*ELSET, ELSET=Upper\nPART, 22,\n24\n"
    text += "*NSET, NSET=bottom\n101, 102, 103" + "".join(f", {101 + i}" for i, p in enumerate(points) if i >= 12 and p[1] == 0) + "\n"
    text += "*NSET, NSET=corner\n101\n*SURFACE, NAME=top, TYPE=ELEMENT\n22, S2\n24, S2\n"
    return text + "*MATERIAL, NAME=steel\n*ELASTIC\n210000., 0.3\n*STEP\n*STATIC\n*END STEP\n"


def unv(points, quads, triangles, bottom, top, descriptors):
    def row(numbers):
        return "".join(f"{n:10d}" for n in numbers) + "\n"

    def block(number, body):
        return f"    -1\n{number:6d}\n{body}    -1\n"

    def around(element):
        half = len(element) // 2
        return [n for pair in zip(element[:half], element[half:]) for n in pair] if len(element) > 4 else element

    nodes = "".join(row([i + 1, 1, 1, 11]) + "".join(f"{v:25.16E}".replace("E", "D") for v in (*p, 0.0)) + "\n" for i, p in enumerate(points))
    elements, number = "", 0
    for members, descriptor in ((quads, descriptors[0]), (triangles, descriptors[1])):
        for element in members:
            number += 1
            elements += row([number, descriptor, 1, 1, 7, len(element)]) + row([n + 1 for n in around(element)])
    for side in top:
        number += 1
        nodes_of = [side[0], side[2], side[1]] if len(side) > 2 else side
        elements += row([number, 24 if len(side) > 2 else 21, 1, 1, 7, len(side)]) + row([0, 1, 1]) + row([n + 1 for n in nodes_of])
    lower, upper = len(quads), len(quads) + len(triangles)
    groups = ""
    for number, (name, code, tags) in enumerate([("lower", 8, range(1, lower + 1)), ("Upper", 8, range(lower + 1, upper + 1)),
                                                 ("top", 8, range(upper + 1, upper + 1 + len(top))),
                                                 ("bottom", 7, sorted({n + 1 for side in bottom for n in side}))], 1):
        words = [w for tag in tags for w in (code, tag, 0, 0)]
        groups += row([number, 0, 0, 0, 0, 0, 0, len(words) // 4]) + name + "\n" + "".join(row(words[i:i + 8]) for i in range(0, len(words), 8))
    return block(164, "         1SI\n") + block(2411, nodes) + block(2412, elements) + block(2467, groups)


def exodus(path):
    with netCDF4.Dataset(path, "w", format="NETCDF3_64BIT_OFFSET") as nc:
        sizes = {"num_dim": 2, "num_nodes": 12, "num_elem": 6, "num_el_blk": 2, "num_node_sets": 1, "num_side_sets": 1, "len_name": 33, "num_el_in_blk1": 2,
                 "num_nod_per_el1": 4, "num_el_in_blk2": 4, "num_nod_per_el2": 3, "num_nod_ns1": 3, "num_side_ss1": 2}
        for name, size in sizes.items():
            nc.createDimension(name, size)

        def put(name, kind, dimensions, values):
            nc.createVariable(name, kind, dimensions)[:] = values

        put("coordx", "f8", ("num_nodes",), [p[0] for p in POINTS])
        put("coordy", "f8", ("num_nodes",), [p[1] for p in POINTS])
        for number, (kind, elements) in enumerate((("QUAD4", QUADS), ("TRI3", TRIANGLES)), 1):
            put(f"connect{number}", "i4", (f"num_el_in_blk{number}", f"num_nod_per_el{number}"), np.array(elements) + 1)
            nc.variables[f"connect{number}"].elem_type = kind
        put("node_ns1", "i4", ("num_nod_ns1",), [1, 2, 3])
        put("elem_ss1", "i4", ("num_side_ss1",), [4, 6])
        put("side_ss1", "i4", ("num_side_ss1",), [2, 2])
        for what, dimension, names in (("eb", "num_el_blk", ["lower", "Upper"]), ("ns", "num_node_sets", ["bottom"]), ("ss", "num_side_sets", ["top"])):
            put(f"{what}_names", "S1", (dimension, "len_name"), np.array([list(n.ljust(33, "\0")) for n in names], dtype="S1"))
            put(f"{what}_prop1", "i4", (dimension,), range(10, 10 + len(names)))


def through_meshio(path):
    cells = [("quad", np.array(QUADS)), ("triangle", np.array(TRIANGLES)), ("line", np.array(BOTTOM + TOP))]
    mesh = meshio.Mesh(np.column_stack([np.array(POINTS), np.zeros(12)]), cells)
    if path.suffix == ".med":
        mesh.cell_data = {"cell_tags": [np.full(2, -6), np.full(4, -7), np.array([-8, -8, -9, -9])]}
        mesh.cell_tags = {-6: ["lower"], -7: ["Upper"], -8: ["bottom"], -9: ["top"]}
        mesh.point_tags = {}
    else:
        mesh.cell_data = {name: [np.full(len(c[1]), b == number) * 1 if number < 2 else np.full(len(c[1]), 0) for b, c in enumerate(cells)]
                          for number, name in enumerate(["lower", "Upper"])}
        sides = np.array([1, 1, 2, 2])
        for name, value in (("bottom", 1), ("top", 2)):
            mesh.cell_data[name] = [np.zeros(2, dtype=int), np.zeros(4, dtype=int), (sides == value) * 1]
    meshio.write(path, mesh)


def convert(source, target):
    return forked(options.convert, source, target)


def contents(path):
    """Mesh of a Suture file by coordinates, independent of numbering: elements and sides of each group."""
    with h5py.File(path) as file:
        points, offsets, nodes, cells = (file[name][:] for name in ("Coordinates", "Offsets", "Connectivity", "Cells"))
        elements = [points[nodes[a:b]] for a, b in zip(offsets, offsets[1:])]
        found = {"cells": sorted(cells.tolist())}
        areas = [0.5 * np.sum(e[:c, 0] * np.roll(e[:c, 1], -1) - np.roll(e[:c, 0], -1) * e[:c, 1]) for e, c in zip(elements, np.where(cells < 2, 3, 4))]
        found["positive"] = bool(min(areas) > 0)
        found["middles"] = all(np.allclose(e[c:], (e[:c] + np.roll(e[:c], -1, axis=0)) / 2) for e, c in zip(elements, np.where(cells < 2, 3, 4)) if len(e) > c)
        for member in file["ElementGroups"].values():
            found[member.attrs["Name"].decode()] = sum(areas[e] for e in member[:])
        for member in file["SideGroups"].values():
            ends = []
            for element, side in member[:]:
                corners = 3 if cells[element] < 2 else 4
                ends += [tuple(elements[element][side]), tuple(elements[element][(side + 1) % corners])]
            found[member.attrs["Name"].decode()] = sorted(ends)
    return found


def expected(cells):
    line = [(0.0, 0.0), (1.0, 0.0), (1.0, 0.0), (2.0, 0.0)]
    return {"cells": cells, "positive": True, "middles": True, "lower": 2.0, "Upper": 2.0, "bottom": line, "top": [(x, 2.0) for x, _ in line]}


SCENE = """<ParameterList name="Suture">
  <ParameterList name="Mesh"><Parameter name="File" type="string" value="MESH"/></ParameterList>
  <ParameterList name="Bodies"><ParameterList name="lower"><Parameter name="Material" type="string" value="rock"/></ParameterList>
    <ParameterList name="Upper"><Parameter name="Material" type="string" value="rock"/></ParameterList></ParameterList>
  <ParameterList name="Materials"><ParameterList name="rock"><Parameter name="Type" type="string" value="Isotropic"/>
    <Parameter name="Young Modulus" type="double" value="1"/><Parameter name="Poisson Ratio" type="double" value="0.3"/></ParameterList></ParameterList>
  <ParameterList name="Boundary Conditions">
    <ParameterList name="hold"><Parameter name="Group" type="string" value="bottom"/><Parameter name="Type" type="string" value="Displacement"/>
      <Parameter name="Value" type="Array(double)" value="{0, 0}"/></ParameterList>
    <ParameterList name="pull"><Parameter name="Group" type="string" value="top"/><Parameter name="Type" type="string" value="Displacement"/>
      <Parameter name="Value" type="Array(double)" value="{0, 1}"/></ParameterList></ParameterList>
</ParameterList>
"""


def checked(mesh):
    """Suture reads the file: exit code of --check and the first words of its output."""
    scene = work / (mesh.name + ".xml")
    scene.write_text(SCENE.replace("MESH", mesh.name))
    code, text = run(options.solve, 1, scene, "--check", "--no-drawing")
    return code if code == 0 else text


points, quads, triangles, bottom, top = quadratic()
sources = {}
for name, text, cells in (("linear.inp", inp(POINTS, QUADS, TRIANGLES, ("CPE4R", "CPS3")), [0] * 4 + [2] * 2),
                          ("quadratic.inp", inp(points, quads, triangles, ("CPE8R", "CAX6M")), [1] * 4 + [3] * 2),
                          ("windows.inp", inp(POINTS, QUADS, TRIANGLES, ("S4", "S3")).replace("\n", "\r\n"), [0] * 4 + [2] * 2),
                          ("linear.unv", unv(POINTS, QUADS, TRIANGLES, BOTTOM, TOP, (44, 41)), [0] * 4 + [2] * 2),
                          ("quadratic.unv", unv(points, quads, triangles, bottom, top, (95, 92)), [1] * 4 + [3] * 2)):
    (work / name).write_bytes(text.encode())
    sources[name] = cells
exodus(work / "linear.exo")
for name in ("linear.med", "linear.vtu"):
    through_meshio(work / name)
sources.update({name: [0] * 4 + [2] * 2 for name in ("linear.exo", "linear.med", "linear.vtu")})

for name, cells in sources.items():
    source = work / name
    own, gmsh = work / (name + ".h5"), work / (name + ".msh")
    code, text = convert(source, own)
    check(f"{name}: exit code of conversion to .h5", (code, text if code else ""), (0, ""))
    if code:
        continue
    found = contents(own)
    for extra in ("Nall", "part"):
        found.pop(extra, None)
    check(f"{name}: the mesh and its groups", found, expected(cells))
    check(f"{name}: Suture takes the .h5", checked(own), 0)
    code, text = convert(source, gmsh)
    check(f"{name}: exit code of conversion to .msh", code, 0)
    check(f"{name}: Suture takes the .msh", checked(gmsh), 0)
    again = work / (name + ".again.h5")  # in Gmsh's file, surface and curve groups of the same name are separate
    check(f"{name}: .msh through meshio", convert(gmsh, again)[0], 0)
    found = contents(again)
    check(f"{name}: the groups again", {key: found.get(key) for key in ("lower", "Upper", "top")}, {key: expected(cells)[key] for key in ("lower", "Upper", "top")})

for name, text, complaint in (
        ("bad.inp", "*NODE\n1, 0, x\n", "line 2: expected a node number and its coordinates, found '1, 0, x'"),
        ("part.inp", "*PART, NAME=a\n*NODE\n1, 0, 0\n*INSTANCE, NAME=b, PART=aa\n", "no such part 'aa'. Did you mean 'a'?"),
        ("solid.inp", "*NODE\n1, 0, 0\n*ELEMENT, TYPE=C3D15\n1, 1, 1, 1, 1\n", "solid elements of the type C3D15; known are C3D4, C3D5,"),
        ("node.inp", "*NODE\n1, 0, 0\n*ELEMENT, TYPE=CPS3\n1, 1, 2, 3\n", "element 1 has the node 2, which no *NODE defines"),
        ("set.inp", "*NODE\n1, 0, 0\n*NSET, NSET=a\nb\n", "no such node set 'b'"),
        ("empty.inp", "", "no surface elements"),
        ("lifted.inp", "*NODE\n1, 0, 0, 0\n2, 1, 0, 1\n3, 0, 1, 0\n*ELEMENT, TYPE=S3\n1, 1, 2, 3\n", "in z but no volume elements"),
        ("nan.inp", "*NODE\n1, 0, nan\n2, 1, 0\n3, 0, 1\n*ELEMENT, TYPE=S3\n1, 1, 2, 3\n", "not finite"),
        ("open.unv", "    -1\n  2411\n", "the dataset does not end"), ("bad.unv", "    -1\n  2411\n 1 1 1 1\n 0 0 0\n 2 a\n    -1\n", "line 5: cannot be read as dataset 2411"),
        ("bad.exo", "garbage", "is not an Exodus file"), ("bad.med", "garbage", "meshio cannot read it"), ("bad.vtu", "garbage", "meshio cannot read it"),
        ("a.xyz", "garbage", "meshio cannot read it"), ("a.geo", "Point(1) = {0, 0, 0};", "a.geo is a geometry, not a mesh: enter it in Mesh/File"),
        ("a.step", "garbage", 'read it in a .geo file by Merge "a.step";'), ("a.BREP", "garbage", "Mesh/File of the scene takes the .geo file")):
    (work / name).write_text(text)
    code, said = convert(work / name, work / "out.h5")
    check(f"{name}: exit code", code, 3)
    check(f"{name}: says '{complaint}'", said, lambda s: complaint in s and "Traceback" not in s)
    check(f"{name}: leaves no file", list(work.glob("out.h5*")), [])
check("no such file", convert(work / "none.inp", work / "out.h5")[0], 3)
check("an unknown form of OUT", convert(work / "linear.inp", work / "out.stl"), lambda r: r[0] == 2 and "expected one of .h5, .msh" in r[1])
check("a folder that is not there", convert(work / "linear.inp", work / "none" / "out.h5")[0], 5)
done = subprocess.run([options.convert, "--help"], capture_output=True, text=True, timeout=60)
check("help on one screen", done.returncode == 0 and len(done.stdout.splitlines()) <= 40, True)
check("usage once", done.stdout.count("suture_convert IN OUT"), 1)
check("number of nodes", convert(work / "linear.inp", work / "out.h5")[1], lambda text: re.search(r"out.h5: [\d,]+ nodes, [\d,]+ elements", text))
done = subprocess.run([options.convert, work / "linear.inp", work / "out.h5"], capture_output=True, text=True, timeout=60)
check("started by itself", (done.returncode, contents(work / "out.h5") == contents(work / "linear.inp.h5")), (0, True))
finish()
