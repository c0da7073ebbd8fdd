"""suture_convert --scene: local axes, supports over several steps, generated nodes, the text of dialects; solutions in closed form.

deck_dialects.py --convert PROGRAM --solve PROGRAM --mpirun "mpirun ..." --work DIR
"""
import pathlib
import sys

try:
    import h5py
    import numpy as np
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent / "decks"))
from bars import MATERIAL, Bar, bar_deck, convert, end_of, entry, nset, scene, solved
from grids import Grid, listed
from harness import arguments, check, finish

options = arguments("--convert", "--solve")
work = options.work


def rotation(axis, degrees):
    axis, angle = np.array(axis) / np.linalg.norm(axis), np.radians(degrees)
    cross = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


def numbers(values):
    return ", ".join(repr(float(value)) for value in values)


def conditions(name, type_=None):
    return [c for c in entry(scene(name), "Boundary Conditions") if type_ is None or entry(c, "Type") == type_]


def farthest(name, fields, expected):
    """Checks displacements at all nodes: expected(points) -> displacements."""
    if fields is not None:
        points, u = fields
        exact = expected(points)
        check(f"{name}: displacements at all nodes", np.abs(u - exact).max() / np.abs(exact).max(), lambda x: x < 1e-9)


# A bar along a turned axis, on rollers and with forces in its own axes: u = F x / (E A) along the axis, plus a given u across it.
q = rotation((1, 2, 0.5), 40)
bar = Bar(4)
straight = {label: list(point) for label, point in bar.nodes.items()}
low = [label for label, p in straight.items() if p[1] == 0]
front = [label for label, p in straight.items() if p[2] == 0]
bar.nodes = {label: list(q @ point) for label, point in straight.items()}
left, right = ([label for label, p in straight.items() if p[0] == x] for x in (0, 4))
turned = (bar.text("E") + nset("left", left) + nset("right", right) + nset("low", low) + nset("front", front) + nset("all", list(bar.nodes))
          + f"*TRANSFORM, NSET=all\n{numbers(q[:, 0])}, {numbers(q[:, 0] + q[:, 1])}\n" + MATERIAL + "*SOLID SECTION, ELSET=E, MATERIAL=M\n"
          "*BOUNDARY\nleft, 1\nlow, 2, 2, 0.01\nfront, 3\n*STEP\n*STATIC\n*CLOAD\nright, 1, 0.5\nright, 2, 0.\n*END STEP\n")
fields, said = solved("turned", turned)
farthest("turned", fields, lambda p: np.column_stack([(p @ q)[:, 0] * 2 / 1000, np.full(len(p), 0.01), np.zeros(len(p))]) @ q.T)
check("turned: everything is taken over", "not taken over" in said, False)
check("turned: one condition per card", sorted(entry(c, "Type") for c in conditions("turned")), ["Displacement"] * 3 + ["Force"])
# A sector of a pipe about an oblique axis. Equal radial strains all over it, u = c (x - axis), satisfy equilibrium: facets do not matter.
grid = Grid((1, 4, 1), (10, 20, 0), (16, 110, 8))
origin, c = np.array([3.0, -2.0, 1.0]), -1e-3
places = {label: q @ [p[0] * np.cos(np.radians(p[1])), p[0] * np.sin(np.radians(p[1])), p[2]] + origin for label, p in grid.points.items()}
sets = {"inside": lambda r, a, z: r == 10, "outside": lambda r, a, z: r == 16, "begin": lambda r, a, z: a == 20, "end": lambda r, a, z: a == 110,
        "bottom": lambda r, a, z: z == 0}
sector = ("*NODE, NSET=N\n" + "".join(f"{label}, {numbers(p)}\n" for label, p in places.items()) + "*ELEMENT, TYPE=C3D8, ELSET=E\n" + grid.elements_text()
          + "".join(nset(name, grid.nodes_where(where)) for name, where in sets.items()) + MATERIAL.replace("1000., 0.", "1000., 0.25")
          + f"*SOLID SECTION, ELSET=E, MATERIAL=M\n*TRANSFORM, TYPE=C, NSET=N\n{numbers(origin - 2 * q[:, 2])}, {numbers(origin + 5 * q[:, 2])}\n"
          f"*BOUNDARY\nbegin, 2\nend, 2\nbottom, 3\n*STEP\n*STATIC\n*BOUNDARY\ninside, 1, 1, {10 * c}\noutside, 1, 1, {16 * c}\n*END STEP\n")
fields, said = solved("sector", sector)
lame = -2 * 0.25 * c / (1 - 0.25)  # strain along the axis, free of stress
farthest("sector", fields, lambda p: ((p - origin) @ q * [c, c, lame]) @ q.T)
check("sector: radial, tangential and axial", sorted(str(entry(e, "Along")) for e in conditions("sector")), ["Circumference"] * 2 + ["None"] + ["Radius"] * 2)
# Forces and supports in a plane model; nodes on the axis have no radius.
flat = Bar(2, dimension=2)
plane = bar_deck("*CLOAD\nfar, 2, -1.5\n", nset("far", flat.at(2)) + "*TRANSFORM, NSET=far\n0., 1., 0., -1., 0., 0.\n", bar=flat, type_="CPS4",
                 support="*BOUNDARY\nleft, 1, 2\n")
end_of("plane_axes", plane, 3.0 * 2 / 1000, x=2.0)
code, said = convert("on_axis", bar_deck("*CLOAD\nright, 1, 1.\n", "*TRANSFORM, NSET=right, TYPE=C\n4., 0., 0., 4., 0., 1.\n"))
check("on_axis: listed once", (code, said.count("undefined at a node on the axis")), (0, 1))
# Supports that begin or end in a later step: without friction the last steps do not depend on the ones before.
middle = nset("middle", Bar(4).at(2))
end_of("begins", bar_deck("*CLOAD\nright, 1, 0.5\n*END STEP\n*STEP\n*STATIC\n*BOUNDARY\nmiddle, 1, 3\n", middle), 2.0 * 2 / 1000, left=True)
end_of("ends", bar_deck("*CLOAD\nright, 1, 0.5\n*END STEP\n*STEP\n*STATIC\n*BOUNDARY, OP=NEW\nleft, 1, 3\n", middle,
                        support="*BOUNDARY\nleft, 1, 3\nmiddle, 1, 3\n"), 2.0 * 4 / 1000, left=True)
end_of("restated", bar_deck("*CLOAD\nright, 1, 0.5\n*END STEP\n*STEP\n*STATIC\n*BOUNDARY, OP=NEW\nleft, 1, 3\n"), 2.0 * 4 / 1000)
check("restated: keeps both steps", entry(scene("restated"), "Load Steps", "Times"), "{1.0, 2.0}")
code, said = convert("kept", bar_deck("*BOUNDARY\nright, 1, 1, 0.5\n*END STEP\n*STEP\n*STATIC\n*BOUNDARY, FIXED\nright, 1, 1\nmiddle, 1, 1\n", middle))
check("kept: FIXED holds the last value", entry(scene("kept"), "Boundary Conditions", "right", "Value"), "{0.5}")
check("kept: or is listed", "*BOUNDARY, FIXED on 'middle': the displacements at the beginning of step 2 are not known" in said, True)
# Loads follow an amplitude in total time over later steps.
convert("follows", bar_deck("*CLOAD, AMPLITUDE=A\nright, 1, 1.\n*END STEP\n*STEP\n*STATIC\n*CLOAD\nright, 2, 1.\n",
                            "*AMPLITUDE, NAME=A, TIME=TOTAL TIME\n0., 0., 1.5, 3., 2., 1.\n"))
check("follows: factors", [c.get("value") for c in entry(scene("follows"), "Load Steps", "Factors")][0], "{0.66666666666667, 1.0, 0.33333333333333}")
# Two loads of different steps on the same elements: CalculiX and Abaqus differ.
again = "*DLOAD\nE, P3, 1.\n*END STEP\n*STEP\n*STATIC\n*DLOAD{}\n2, P3, 5.\n"
for name, option, listed_ in (("overlap", "", 1), ("no_overlap", ", OP=NEW", 0)):
    code, said = convert(name, bar_deck(again.format(option)))
    check(f"{name}: listed", (code, said.count("load P3 on 'element 2' shares elements with that on 'E' of step 1")), (0, listed_))
# A rigid body whose rotation is given: u = w x (x - p), here for all nodes.
fields, said = solved("rotated", bar_deck("*BOUNDARY\n99, 1, 1, 0.1\n99, 2, 3\n98, 1, 1, 0.002\n98, 2, 2, -0.001\n98, 3, 3, 0.004\n",
                                          "*NODE\n98, 1., 0., 0.\n99, 1., 2., 3.\n*RIGID BODY, ELSET=E, REF NODE=99, ROT NODE=98\n", support=""))
farthest("rotated", fields, lambda p: [0.1, 0, 0] + np.cross([0.002, -0.001, 0.004], p - [1, 2, 3]))
# An elastic foundation of stiffness 50: u = p / 50 + p L / E.
end_of("foundation", bar_deck("*DSLOAD\nend, P, -2.\n", "*SURFACE, NAME=end\n4, S4\n*FOUNDATION\n1, F6, 50.\n" + nset("low", low) + nset("front", front),
                              support="*BOUNDARY\nlow, 2\nfront, 3\n"), 2 / 50 + 8e-3)
# Cards with options that change their meaning are left out and listed.
code, said = convert("other", bar_deck("*CLOAD\nright, 1, 1.\n*BOUNDARY, SUBMODEL, STEP=1\nright, 1\n*BOUNDARY, USER\nright, 2\n"))
check("other: listed", all(f"*BOUNDARY with the option {option}" in said for option in ("SUBMODEL", "USER")), True)
check("other: left out", [entry(e, "Type") for e in conditions("other")], ["Displacement", "Force"])
code, said = convert("reasons", bar_deck("*CLOAD\nright, 1, 1.\n", "*EQUATION\n2\nright, 1, 1., left, 1, -1.\n*SPRING, ELSET=E\n\n1.\n*MODEL CHANGE, TYPE=CONTACT PAIR\n"))
for words in ("*EQUATION: a scene has no equations between nodes", "*SPRING: a scene has springs on areas only", "*MODEL CHANGE: a scene has the same contacts"):
    check(f"reasons: '{words}'", words in said, True)


# Generated nodes and elements, local systems: the same mesh as one that is written out.
def mesh_of(name):
    with h5py.File(work / f"{name}.h5") as file:
        return file["Coordinates"][:]


written = ("*NODE, SYSTEM=C, NSET=A\n" + "".join(f"{1 + 100 * k}, 10., {30 * k}, 0.\n" for k in range(4)) + "*NODE, SYSTEM=C, NSET=B\n"
           + "".join(f"{4 + 100 * k}, 16., {30 * k}, 0.\n" for k in range(4))
           + "*NFILL, NSET=low\nA, B, 3, 1\n*NCOPY, CHANGE NUMBER=1000, OLD SET=low, NEW SET=high, SHIFT\n0., 0., 3.\n,\n"
           "*ELEMENT, TYPE=C3D8\n1, 1, 2, 102, 101, 1001, 1002, 1102, 1101\n*ELGEN, ELSET=E\n1, 3, 1, 1, 2, 100, 10\n"
           "*NSET, NSET=all\nlow, high\n*ELSET, ELSET=row\n11, 12, 13\n*ELCOPY, OLD SET=row, NEW SET=E, ELEMENT SHIFT=10, SHIFT NODES=100\n") + MATERIAL
written += "*SOLID SECTION, ELSET=E, MATERIAL=M\n*BOUNDARY\nlow, 1, 3\n*STEP\n*STATIC\n*BOUNDARY\nhigh, 1, 3, 0.01\n*END STEP\n"
code, said = convert("generated", written)
check("generated: exit code", (code, said if code else ""), (0, ""))
check("generated: mesh", "32 nodes, 9 elements" in said and "E (9)" in said and "high (9), low (9)" in said, True)
expected = {(round(r * np.cos(a), 9) + 0.0, round(r * np.sin(a), 9) + 0.0, z) for r in (10, 12, 14, 16) for a in np.radians([0, 30, 60, 90]) for z in (0.0, 3.0)}
check("generated: positions", {tuple(np.round(p, 9) + 0.0) for p in mesh_of("generated").reshape(-1, 3)} == expected, True)
moved = bar_deck("*CLOAD\nright, 1, 0.25\n").replace("*NODE\n", "*SYSTEM\n10., 0., 0., 10., 1., 0.\n9., 0., 0.\n*NODE\n")
code, said = convert("system", moved)
points = mesh_of("system").reshape(-1, 3)
check("system: positions", (points.min(axis=0).tolist(), points.max(axis=0).tolist()), ([9.0, 0.0, 0.0], [10.0, 4.0, 1.0]))
code, said = convert("bias", written.replace("*NFILL, NSET=low", "*NFILL, NSET=low, BIAS=2."))
check("bias: an option that is not supported is an error", (code, "*NFILL: option BIAS is not supported" in said), (3, True))
# Text: byte order mark, quoted names with blanks and commas, data lines in files, sets of instances.
(work / "sub").mkdir()
(work / "sub" / "held.dat").write_text("** in a file\n\"Part, 1\".left, 1, 3\n")
quoted = ("\ufeff*Heading\n two parts\n*Part, name=\"a bar\"\n" + Bar(4).text("E") + nset("left", Bar(4).at(0)) + nset("right", Bar(4).at(4))
          + "*Solid Section, elset=E, material=\"my steel\"\n,\n*End Part\n*Assembly, name=A\n*Instance, name=\"Part, 1\", part=\"A BAR\"\n*End Instance\n"
          "*Instance, name=Second, part=\"a bar\"\n0., 0., 0.\n0., 0., 0., 0., 0., 1., 90.\n*End Instance\n*Nset, nset=Tip, instance=\"Part, 1\"\nright\n*End Assembly\n"
          + MATERIAL.replace("NAME=M", "NAME=\"my steel\"") + "*BOUNDARY, INPUT=sub\\held.dat\n*BOUNDARY\nSecond.left, 1, 3\nSecond.right, PINNED\n*STEP\n*STATIC\n*CLOAD\n"
          "TIP, 1,\t.5\n*END STEP\n")
end_of("quoted", quoted, 8e-3)
check("quoted: bodies", [body.get("name") for body in entry(scene("quoted"), "Bodies")], ["Part_ 1", "Second"])
# A surface without face labels has the free sides; a load on a surface of nodes has no sides and is listed.
code, said = convert("free", bar_deck("*DSLOAD\nskin, P, 1.\ntips, P, 1.\n", "*SURFACE, NAME=skin\nE\n*SURFACE, NAME=tips, TYPE=NODE\nright\n"))
check("free: sides", (code, "skin (18)" in said, "*DSLOAD on 'tips': it has no sides" in said, said.count("not taken over")), (0, True, True, 1))
# Laws of contact and rigid groups are read completely, also what no scene expresses.
sys.path.insert(0, str(pathlib.Path(options.convert).resolve().parent))
from suture_convert_formats.deck.to_scene import DeckScene

pair = bar_deck("*BOUNDARY\n99, 1, 1, 0.02\n*CLOAD\n99, 5, 7.\n", "*NODE\n99, 5., 0.5, 0.5\n*SURFACE, NAME=end\n4, S4\n*COUPLING, REF NODE=99, SURFACE=end, "
                "CONSTRAINT NAME=c\n*KINEMATIC\n1, 2\n4\n")
(work / "group.inp").write_text(pair)
group = DeckScene(work / "group.inp").couplings.all[0]
check("group: read", (group.kind, sorted(group.coupled), group.point, len(group.rows), len(group.nodes)), ("KINEMATIC", [0, 1, 3], [5.0, 0.5, 0.5], 1, 4))
check("group: motions and loads", ({k: v.tolist() for k, v in group.motions.items()}, {k: v.tolist() for k, v in group.loads.items()}), ({0: [0.02]}, {4: [7.0]}))
check("group: reason", group.reason, "*COUPLING: free motions of the reference node 99, coupled in some directions only")
one, two = Bar(2), Bar(2, begin=2, first=100)
laws = (one.text("A") + two.text("B") + MATERIAL + "*SOLID SECTION, ELSET=A, MATERIAL=M\n*SOLID SECTION, ELSET=B, MATERIAL=M\n*SURFACE, NAME=SA\n2, S4\n"
        "*SURFACE, NAME=SB\n101, S6\n*SURFACE INTERACTION, NAME=I\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE={law}\n*CONTACT PAIR, INTERACTION=I\nSB, SA\n")
# With friction the scene keeps all steps, with the supports of the last one.
code, said = convert("friction", laws.replace("{law}", "HARD\n*FRICTION\n0.3") + nset("left", one.at(0)) + nset("right", two.at(4)) + "*BOUNDARY\nleft, 1, 3\nright, 2, 3\n"
                     "*STEP\n*STATIC\n*CLOAD\nright, 1, -1.\n*END STEP\n*STEP\n*STATIC\n*BOUNDARY, OP=NEW\nleft, 1, 3\nright, 1, 1, -0.01\n*END STEP\n")
check("friction: listed", (code, said.count("in all its steps: here those of the last step; with friction the results depend on those of earlier steps")), (0, 2))
for words in ("direction 1, begins in step 2;", "directions 2, 3, ends in step 2;"):
    check(f"friction: '{words}'", f"*BOUNDARY on 'right', {words}" in said, True)
check("friction: steps", entry(scene("friction"), "Load Steps", "Times"), "{1.0, 2.0}")
check("friction: supports of the last step", [(e.get("name"), entry(e, "Components")) for e in conditions("friction", "Displacement")], [("left", None), ("right", "x")])


def law_of(text):
    (work / "law.inp").write_text(laws.replace("{law}", text))
    return DeckScene(work / "law.inp").contacts.all[0].overclosure


# Bars of compliance 2 / 1000 in series with a layer of compliance 1 / 1000.
soft = (laws.replace("{law}", "LINEAR\n1000.") + nset("left", one.at(0)) + nset("right", two.at(4))
        + "*BOUNDARY\nleft, 1, 3\nright, 2, 3\nright, 1, 1, -0.01\n*STEP\n*STATIC\n*END STEP\n")
fields, said = solved("soft_bars", soft)
if fields is not None:
    ends = np.unique(np.round(fields[1][np.abs(fields[0][:, 0] - 2.0) < 1e-9][:, 0], 9))
    check("soft bars: displacements of both sides", ends.tolist(), [-0.006, -0.004])
check("law: linear", (law_of("LINEAR\n500., 3., 1.E-3").stiffness, law_of("HARD").is_soft), (500.0, False))
law = law_of("Exponential\n0.1, 2.")
check("law: exponential", (law.kind, law.clearance, law.pressure), ("EXPONENTIAL", 0.1, 2.0))
check("law: table", law_of("TABULAR\n0., -.1\n3., 0.\n9., .1").table, [(0.0, -0.1), (3.0, 0.0), (9.0, 0.1)])
for name, text in (("falling", "TABULAR\n0., 0.\n3., .2\n2., .3\n"), ("short", "EXPONENTIAL\n0.1\n"), ("none", "LINEAR\n")):
    code, said = convert(name, laws.replace("{law}", text))
    check(f"{name}: an error", (code, "*SURFACE BEHAVIOR: expected" in said), (3, True))
finish()
