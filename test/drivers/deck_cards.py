"""suture_convert --scene card by card: small decks whose solution is known in closed form; lists and errors.

deck_cards.py --convert PROGRAM --solve PROGRAM --mpirun "mpirun ..." --work DIR
"""
import pathlib
import re
import sys

try:
    import h5py  # noqa: F401, which bars needs
    import numpy as np
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent / "decks"))
from bars import MATERIAL, Bar, bar_deck, convert, end_of, entry, nset, scene, solved
from grids import listed
from harness import arguments, check, finish, forked

options = arguments("--convert", "--solve")
work = options.work
# Loads on a bar of length 4 and section 1, E = 1000, nu = 0: u = F l / (E A).
right = Bar(4).at(4)
end_of("nodal_forces", bar_deck("*CLOAD\nright, 1, 0.25\n"), 4e-3)
check("nodal_forces: recognised as a uniform traction", entry(scene("nodal_forces"), "Boundary Conditions", "right", "Type"), "Force")
end_of("added_forces", bar_deck("*CLOAD\nright, 1, 0.25\n*CLOAD\nright, 1, 0.5\n"), 12e-3)
end_of("point_forces", bar_deck(f"*CLOAD\n{right[0]}, 1, 0.5\n{right[1]}, 1, 0.5\n"), 4e-3)
check("point_forces: as forces on nodes", len([c for c in entry(scene("point_forces"), "Boundary Conditions") if entry(c, "Type") == "Point Force"]), 2)
end_of("pressure", bar_deck("*DLOAD\n4, P4, -2.\n"), 8e-3)
end_of("surface_pressure", bar_deck("*DSLOAD\nend, P, -2.\n", "*SURFACE, NAME=end\n4, S4\n"), 8e-3)
end_of("traction_vector", bar_deck("*DSLOAD\nend, TRVEC, 2., 3., 0., 0.\n", "*SURFACE, NAME=end\n4, S4\n"), 8e-3)
end_of("gravity", bar_deck("*DLOAD\nE, GRAV, 10., 1., 0., 0.\n"), 2.0 * 10 * 16 / 2 / 1000)
end_of("gravity_everywhere", bar_deck("*DLOAD\n, GRAV, 10., 1., 0., 0.\n"), 2.0 * 10 * 16 / 2 / 1000)
end_of("body_force", bar_deck("*DLOAD\nE, BX, 5.\n"), 5.0 * 16 / 2 / 1000)
end_of("rotation", bar_deck("*DLOAD\nE, CENTRIF, 9., 0., 0., 0., 0., 0., 1.\n"), 2.0 * 9 * 64 / 3 / 1000)
end_of("temperature", bar_deck("*TEMPERATURE\nall, 30.\n", "*INITIAL CONDITIONS, TYPE=TEMPERATURE\nall, 20.\n"), 1e-3 * 10 * 4)
# 1 + 2 x: u = alpha (x + x^2)
gradient = "".join(f"{label}, {1 + 2 * p[0]}\n" for label, p in Bar(4).nodes.items())
end_of("temperature_gradient", bar_deck("*TEMPERATURE\n" + gradient, support="*BOUNDARY\nleft, 1\nleft, 2\nleft, 3\n"), 1e-3 * 20, left=False)
end_of("prescribed", bar_deck("*BOUNDARY\nright, 1, 1, 0.02\n"), 0.01, x=2.0)
# Plane stress with thickness 5, and plane strain: forces of the deck are those of the whole thickness.
flat = Bar(4, dimension=2)
end_of("thickness", bar_deck("*CLOAD\nright, 1, 2.5\n", bar=flat, type_="CPS4", section="5.\n", support="*BOUNDARY\nleft, 1, 2\n"), 4e-3)
check("thickness: listed", "thickness 5: forces of the scene" in (work / "thickness.xml").read_text(), True)
check("thickness: model", entry(scene("thickness"), "Model"), "Plane Stress")
end_of("thick_couple", bar_deck("*CLOAD\n999, 1, 5.\n", "*NODE\n999, 4., 0.5\n*SURFACE, NAME=end\n4, S2\n*COUPLING, REF NODE=999, SURFACE=end, "
                                "CONSTRAINT NAME=c\n*DISTRIBUTING\n", bar=flat, type_="CPS4", section="5.\n", support="*BOUNDARY\nleft, 1, 2\n"), 4e-3)
end_of("plane_strain", bar_deck("*DLOAD\n4, P2, -1.\n", bar=flat, type_="CPE4", support="*BOUNDARY\nleft, 1, 2\n"), 4e-3)
# A ring under internal forces: one radian has the force F / (2 pi).
end_of("couple", bar_deck("*CLOAD\n999, 1, 1.\n", "*NODE, NSET=ref\n999, 4., 0.5, 0.5\n*SURFACE, NAME=end\n4, S4\n*COUPLING, REF NODE=999, SURFACE=end, "
                          "CONSTRAINT NAME=c\n*DISTRIBUTING\n1, 3\n"), 4e-3)
# A force along x, off the axis by 0.5 in y, bends the bar: curvature M / (E I), I = 1 / 12, deflection M l^2 / (2 E I).
end_of("moment", bar_deck("*CLOAD\n999, 1, 1.\n", "*NODE\n999, 4., 1., 0.5\n*SURFACE, NAME=end\n4, S4\n*COUPLING, REF NODE=999, SURFACE=end, "
                          "CONSTRAINT NAME=c\n*DISTRIBUTING\n1, 3\n"), -0.5 * 16 / 2 / (1000 / 12), component=1)
end_of("kinematic", bar_deck("*BOUNDARY\n999, 1, 1, 0.02\n999, 2, 6\n", "*NODE\n999, 5., 0.5, 0.5\n*SURFACE, NAME=end\n4, S4\n*COUPLING, REF NODE=999, "
                             "SURFACE=end, CONSTRAINT NAME=c\n*KINEMATIC\n1, 6\n"), 0.01, x=2.0)
end_of("rigid", bar_deck("*BOUNDARY\n999, 1, 1, 0.02\n999, 2, 3\n998, 1, 3\n", "*NODE\n999, 5., 0.5, 0.5\n998, 5., 0.5, 0.5\n*RIGID BODY, NSET=right, REF NODE=999, "
                         "ROT NODE=998\n"), 0.01, x=2.0)
# The same force on a rigid end, which may turn or not.
for name, held, expected, component in (("rigid_moment", "", -0.5 * 16 / 2 / (1000 / 12), 1), ("guided", "*BOUNDARY\n999, 4, 6\n", 4e-3, 0)):
    end_of(name, bar_deck(held + "*CLOAD\n999, 1, 1.\n", "*NODE\n999, 4., 1., 0.5\n*SURFACE, NAME=end\n4, S4\n*COUPLING, REF NODE=999, SURFACE=end, "
                          "CONSTRAINT NAME=c\n*KINEMATIC\n1, 6\n"), expected, component=component)
check("guided: as a rigid group", [c.get("name") for c in entry(scene("guided"), "Boundary Conditions") if entry(c, "Type") == "Rigid Group"], ["end"])
# One body of two sections, connected by common nodes.
two = bar_deck("*CLOAD\nright, 1, 0.25\n").replace("*SOLID SECTION, ELSET=E", "*ELSET, ELSET=soft\n3, 4\n*ELSET, ELSET=hard\n1, 2\n*MATERIAL, NAME=S\n*ELASTIC\n"
                                                   "500., 0.\n*SOLID SECTION, ELSET=soft, MATERIAL=S\n*SOLID SECTION, ELSET=hard")
end_of("regions", two, 2e-3 + 4e-3)
check("regions: one body", len(entry(scene("regions"), "Bodies")), 1)
# Orthotropic by nine stiffnesses, axis 1 along y: E_1 = 2000, E_2 = 1000, E_3 = 500; along x acts E_2.
e, nu12, nu13, nu23 = [2000.0, 1000.0, 500.0], 0.2, 0.1, 0.15
c = np.array([[1 / e[0], -nu12 / e[0], -nu13 / e[0]], [-nu12 / e[0], 1 / e[1], -nu23 / e[1]], [-nu13 / e[0], -nu23 / e[1], 1 / e[2]]])
d = np.linalg.inv(c)
ortho = f"*ELASTIC, TYPE=ORTHO\n{d[0, 0]!r}, {d[0, 1]!r}, {d[1, 1]!r}, {d[0, 2]!r}, {d[1, 2]!r}, {d[2, 2]!r}, 300., 200.,\n100.\n".replace("np.float64(", "").replace(")", "")
free = "*BOUNDARY\nleft, 1, 1\n" + "".join(f"{label}, {k}, {k}\n" for k, label in ())
text = bar_deck("*DLOAD\n4, P4, -2.\n", "*ORIENTATION, NAME=turned\n0., 1., 0., -1., 0., 0.\n", support="*BOUNDARY\nleft, 1\n*SURFACE, NAME=below\n1, S3\n2, S3\n3, S3\n"
                "4, S3\n").replace("*ELASTIC\n1000., 0.\n", ortho).replace("MATERIAL=M\n*", "MATERIAL=M, ORIENTATION=turned\n*")
low = [label for label, p in Bar(4).nodes.items() if p[1] == 0]
front = [label for label, p in Bar(4).nodes.items() if p[2] == 0]
end_of("orthotropic", text.replace("*STEP", nset("low", low) + nset("front", front) + "*BOUNDARY\nlow, YSYMM\nfront, ZSYMM\n*STEP", 1), 8e-3)
# Two bars with a gap of 0.5 drawn: pushed by 2, or with another gap.
first, second = Bar(2), Bar(2, begin=2.5, first=100)
pair = (first.text("A") + second.text("B") + nset("left", first.at(0)) + nset("end", second.at(4.5)) + MATERIAL
        + "*SOLID SECTION, ELSET=A, MATERIAL=M\n*SOLID SECTION, ELSET=B, MATERIAL=M\n*SURFACE, NAME=SA\n2, S4\n*SURFACE, NAME=SB\n101, S6\n"
        + "*SURFACE INTERACTION, NAME=I\n*BOUNDARY\nleft, 1, 3\nend, 2, 3\n{extra}*STEP\n*STATIC\n*BOUNDARY\nend, 1, 1, -1.\n*END STEP\n")
contact = "*CONTACT PAIR, INTERACTION=I{more}\nSB, SA\n"
end_of("gap", pair.format(extra=contact.format(more="")), -0.25, x=2.0)
end_of("clearance", pair.format(extra=contact.format(more="") + "*CLEARANCE, SLAVE=SB, MASTER=SA, VALUE=0.2\n"), -0.4, x=2.0)
# The same surfaces by nodes, by a union, by sets of sets before their members.
other = pair.replace("*SURFACE, NAME=SA\n2, S4\n", "*SURFACE, NAME=SA, TYPE=NODE\nNA\n*NSET, NSET=NA\nNB\n*NSET, NSET=NB\n" + listed(first.at(2)))
other = other.replace("*SURFACE, NAME=SB\n101, S6\n", "*SURFACE, NAME=SB, COMBINE=UNION\nSC, SC\n*SURFACE, NAME=SC\nEC, S6\n*ELSET, ELSET=EC\nEB\n*ELSET, ELSET=EB, "
                      "GENERATE\n101, 103, 2\n")
end_of("surfaces", other.format(extra=contact.format(more="")), -0.25, x=2.0)
fields, said = solved("adjust", pair.format(extra=contact.format(more=", ADJUST=0.6")))
check("adjust: moves the nodes", "4 nodes of 'SB' moved onto 'SA', by at most 0.5" in said, True)
if fields is not None:
    ends = fields[1][np.abs(fields[0][:, 0] - 2.0) < 1e-9][:, 0]
    # Two bars of lengths 2 and 2.5 in series
    check("adjust: both sides move together", np.abs(ends + 2 / 4.5).max() < 1e-6, True)
tie = "*TIE, NAME=T, POSITION TOLERANCE=0.6\nSB, SA\n"
fields, said = solved("tie", pair.replace("-1.\n", "0.9\n").format(extra=tie))
if fields is not None:
    check("tie: carries tension", np.abs(fields[1][np.abs(fields[0][:, 0] - 2.0) < 1e-9][:, 0] - 0.9 * 2 / 4.5).max() < 1e-6, True)
code, said = convert("far_tie", pair.format(extra=tie.replace("0.6", "0.1")))
check("far_tie", (code, "farther apart than the tolerance 0.1" in said), (3, True))
# Laws
for law, lines, expected, listed in (
        ("hard", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD\n", None, ""),
        ("coulomb", "*FRICTION\n0.25, 1000.\n", "Coulomb", ""), ("bonded", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=TIED\n1.E5\n", "Tied", ""),
        ("sliding", "*SURFACE BEHAVIOR, NO SEPARATION\n", "No Separation", ""),
        ("penalty", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n1.E5\n", None, "changed:\n    line 51: *SURFACE BEHAVIOR of 'I': hard contact instead"),
        ("soft", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n1.E3\n", None, ""),
        ("exponential", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=EXPONENTIAL\n0.1, 2.\n", None, "changed:\n    line 51: *SURFACE BEHAVIOR of 'I' as Pressure Overclosure = Exponential"),
        ("table", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=TABULAR\n0., 0.\n1., .1\n", None, ""),
        ("softening", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=TABULAR\n0., 0.\n2., .1\n3., .2\n", None, "line 51: *SURFACE BEHAVIOR of 'I': hard contact instead of a table"),
        ("rough", "*FRICTION, ROUGH\n", None, "line 51: *FRICTION: option ROUGH")):
    code, said = convert(law, pair.format(extra=contact.format(more="")).replace("NAME=I\n", "NAME=I\n" + lines))
    law_of = entry(scene(law), "Contact", "SB on SA", "Law") if code == 0 else said
    check(f"{law}: law", (code, law_of), (0, expected))
    check(f"{law}: listed", listed in said, True)
overclosures = {law: entry(scene(law), "Contact", "SB on SA", "Pressure Overclosure") for law in ("penalty", "soft", "exponential", "table", "softening")}
check("overclosures", overclosures, {"penalty": None, "soft": "Linear", "exponential": "Exponential", "table": "Table", "softening": None})
check("soft: stiffness", entry(scene("soft"), "Contact", "SB on SA", "Linear", "Stiffness"), "1000.0")
check("table: pressures", entry(scene("table"), "Contact", "SB on SA", "Table", "Pressures"), "{0.0, 1.0}")
check("exponential: clearance", entry(scene("exponential"), "Contact", "SB on SA", "Exponential", "Clearance At Zero Pressure"), "0.1")
check("coulomb: coefficient", entry(scene("coulomb"), "Contact", "SB on SA", "Coulomb", "Coefficient"), "0.25")
# Steps: loads persist, OP=NEW ends them, amplitudes scale them.
steps = ("*CLOAD\nright, 1, 0.25\n*END STEP\n*STEP\n*STATIC\n1., 2.\n*CLOAD\nright, 2, 0.5\n*END STEP\n*STEP\n*STATIC\n*CLOAD, OP=NEW, AMPLITUDE=A\nright, 1, 0.75\n")
code, said = convert("steps", bar_deck(steps, "*AMPLITUDE, NAME=A\n0., 0., 0.25, 2., 1., 1.\n"))
check("steps: exit code", (code, said if code else ""), (0, ""))
check("steps: times", entry(scene("steps"), "Load Steps", "Times"), "{1.0, 3.0, 3.25, 4.0}")
factors = {c.get("name"): c.get("value") for c in entry(scene("steps"), "Load Steps", "Factors")}
check("steps: factors", factors, {"right": "{0.16666666666667, 0.16666666666667, 1.0, 0.5}", "right 2": "{0.0, 1.0, 0.75, 0.0}"})
values = [entry(scene("steps"), "Boundary Conditions", name, "Value") for name in ("right", "right 2")]
check("steps: values", values, ["{6.0, 0.0, 0.0}", "{0.0, 2.0, 0.0}"])
# Temperatures begin at the initial one, 20, and OP=NEW leads back to it.
heat = "*TEMPERATURE\nall, 30.\n*END STEP\n*STEP\n*STATIC\n*TEMPERATURE\nall, 60.\n*END STEP\n*STEP\n*STATIC\n*TEMPERATURE, OP=NEW\n"
code, said = convert("heat", bar_deck(heat, "*INITIAL CONDITIONS, TYPE=TEMPERATURE\nall, 20.\n"))
check("heat: factors", entry(scene("heat"), "Load Steps", "Factors", "temperature of E"), "{0.25, 1.0, 0.0}")
hot = entry(scene("heat"), "Boundary Conditions", "temperature of E")
check("heat: value and reference", (entry(hot, "Value"), entry(hot, "Reference Temperature")), ("{60.0}", "20.0"))
# Supports that begin or end in a later step, values in spherical axes, nodes without elements, surface elements with a section.
code, said = convert("late", bar_deck("*END STEP\n*STEP\n*STATIC\n*BOUNDARY\nright, 2, 2\n*END STEP\n*STEP\n*STATIC\n*BOUNDARY, OP=NEW\nleft, 1, 3\n*CLOAD\n77, 1, 1.\n"
                                      "all, 4, 1.\n", "*NODE\n77, 9., 9., 9.\n*NSET, NSET=turned\n5, 6\n*TRANSFORM, NSET=turned, TYPE=S\n1., 1., 0., -1., 1., 0.\n"
                                      "*ELEMENT, TYPE=S4, ELSET=skin\n900, 1, 4, 8, 5\n*SHELL SECTION, ELSET=skin, MATERIAL=M\n0.1\n"
                                      "*ELEMENT, TYPE=S4, ELSET=face\n901, 1, 2, 3, 4\n", support="*BOUNDARY\nleft, 1, 3\nturned, 3, 3\n"))
check("late: exit code", (code, said if code else ""), (0, ""))
for words in ("*BOUNDARY on 'right' begins in step 2, ends in step 3; a scene has the same supports in all its steps; therefore the scene begins with step 3",
              "*BOUNDARY on 'turned' ends in step 3", "*TRANSFORM, TYPE=S: only rectangular and cylindrical axes",
              "at nodes without solid elements such as node 77", "*CLOAD on 'all': direction 4", "1 element of the type S4"):
    check(f"late: lists '{words}'", words in said, True)
check("late: a surface element without section is a name of sides", said.count("of the type S4"), 1)
# What is not taken over is listed with its line, and --strict refuses it.
text = bar_deck("*CLOAD\nright, 1, 0.25\n*VIEWFACTOR\n*NODE FILE\nU\n", "*SPRING, ELSET=x\n\n1.\n*PLASTIC\n1.\n*PLASTIC\n2.\n", support="*BOUNDARY\nleft, 1, 3\n"
                "3, 1\n")
code, said = convert("lists", text)
for line in ("*SPRING", "*PLASTIC", "*VIEWFACTOR", "without influence on the answer:", "*NODE FILE"):
    check(f"lists: '{line}'", code == 0 and line in said and line in (work / "lists.xml").read_text(), True)
alone = [c for c in entry(scene("lists"), "Boundary Conditions") if entry(c, "Point") is not None]
check("lists: a single node is held at its point", [(entry(c, "Components"), entry(c, "Value")) for c in alone], [("x", "{0.0}")])
at = [number for number, line in enumerate(text.splitlines(), 1) if line == "*PLASTIC"]
check("lists: lines", f"lines {at[0]}, {at[1]}: *PLASTIC" in said, True)
for file in work.glob("strict.*"):
    file.unlink()
code, said = convert("strict", text, "--strict")
check("strict: exit code and list", (code, "*SPRING" in said, "*NODE FILE" in said), (3, True, False))
check("strict: nothing is written", [file.name for file in work.glob("strict.*")], ["strict.inp"])
code, said = convert("strict", bar_deck("*CLOAD\nright, 1, 0.25\n"), "--strict")
check("strict: a deck that is taken over completely", (code, said if code else ""), (0, ""))
code, said = convert("inside", bar_deck("*DLOAD\nE, P4, -2.\n"))
check("inside: pressure on a whole set", (code, "pressure on 'E': of 4 sides 3 are inside the material" in said), (0, True))
code, said = convert("no_step", bar_deck("").replace("*STEP\n*STATIC\n*END STEP\n", "").replace("*STATIC", ""))
check("no_step: keeps the supports", (code, entry(scene("no_step"), "Boundary Conditions", "left", "Type")), (0, "Displacement"))
check("no_step: listed", "no *STATIC step" in said, True)
code, said = convert("frequency", bar_deck("*CLOAD\nright, 1, 1.\n").replace("*STATIC", "*FREQUENCY"))
check("frequency: listed, without loads", (code, "step 1 (*FREQUENCY) with all its loads" in said, entry(scene("frequency"), "Boundary Conditions", "right")),
      (0, True, None))
# Errors: all at once, with lines and nearest names.
bad = bar_deck("*CLOAD\nrigth, 1, 0.25\n*DSLOAD\nende, P, 1.\n*BOUNDARY, AMPLITUDE=B\nleft, ENCASTER\n", "*SURFACE, NAME=end\n4, S4\n*SURFACE, NAME=odd\n4, S7\n"
               "*CONTACT PAIR, INTERACTION=J\nend, odd\n*AMPLITUDE, NAME=A\n0., 0., 1., 1.\n")
code, said = convert("bad", bad)
check("bad: exit code", code, 3)
for words in ("errors in", "no such node set 'rigth'. Did you mean 'right'?", "no such surface 'ende'. Did you mean 'end'?", "element 4 has no side S7",
              "no such surface interaction 'J'", "no such amplitude 'B'. Known here: A", "found 'left, ENCASTER'"):
    check(f"bad: says '{words}'", words in said, True)
check("bad: lines", len(re.findall(r"^  line \d+: ", said, re.M)), 6)
check("bad: nothing is written", list(work.glob("bad.[hx]*")), [])
for name, text, words in (
        ("no_section", Bar(1).text("E"), "no solid elements with a *SOLID SECTION"), ("no_material", bar_deck("").replace("MATERIAL=M\n*B", "MATERIAL=N\n*B"),
                                                                                    "no such material 'N'. Known here: M"),
        ("no_density", bar_deck("*DLOAD\nE, GRAV, 9., 0., 0., 1.\n").replace("*DENSITY\n2.\n", ""), "material 'M' has no *DENSITY"),
        ("some_without", bar_deck("").replace("ELSET=E, MATERIAL", "ELSET=few, MATERIAL") + "*ELSET, ELSET=few\n1, 2\n", "2 elements of the type C3D8I have no *SOLID SECTION"),
        ("mixed_models", bar_deck("", bar=flat, type_="CPS4", support="") + "*ELEMENT, TYPE=CPE4, ELSET=E\n9, 1, 2, 3, 4\n", "elements of several models"),
        ("ring", "*INCLUDE, INPUT=ring.inp\n", "includes itself")):
    code, said = convert(name, text)
    check(f"{name}: says '{words}'", (code, words in said and "Traceback" not in said), (3, True))
# Options
bar = bar_deck("*CLOAD\nright, 1, 0.25\n")
for units, names in (("mm", "mm, N, MPa"), ("m", "m, N, Pa"), ("in", "in, lbf, psi"), ("cm, N, N/cm2", "cm, N, N/cm2")):
    convert("units", bar, "--units", units)
    check(f"units {units}", entry(scene("units"), "Units"), names)
check("units of PrePoMax", (convert("units", "*HEADING\nUnit system: M_KG_S_C\n" + bar)[0], entry(scene("units"), "Units")), (0, "m, N, Pa"))
check("wrong units", convert("units", bar, "--units", "inches")[0], 2)
(work / "old.inp").write_text(bar)
check("written once", forked(options.convert, work / "old.inp", "--scene", work / "old.xml")[0], 0)
check("not overwritten", forked(options.convert, work / "old.inp", "--scene", work / "old.xml"), lambda r: r[0] == 3 and "--force overwrites it" in r[1])
(work / "full.h5.part").mkdir()  # the mesh cannot be written
check("a mesh that cannot be written", forked(options.convert, work / "old.inp", "--scene", work / "full.xml")[0], 5)
check("a mesh that cannot be written: no scene", [file.name for file in work.glob("full.*")], ["full.h5.part"])
check("a folder that is not there", forked(options.convert, work / "old.inp", "--scene", work / "none" / "old.xml")[0], 5)
check("only decks", forked(options.convert, work / "old.unv", "--scene")[0], 2)
check("options of --scene", forked(options.convert, work / "old.inp", work / "old.h5", "--strict")[0], 2)
finish()
