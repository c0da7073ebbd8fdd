"""suture_new, and the scene of suture_schema: scenes that run, bodies and contacts found in geometries, refusals. new_scene.py --new PROGRAM --solve PROGRAM
--mpirun "mpirun ..." --work DIR --input FOLDER [--full | --space]

Geometries become scenes that are solved and verified: those of several bodies with coarse meshes on two ranks; with --full all geometries of the input
folder with their own meshes on one and two ranks; with --space 3D geometries."""
import argparse
import json
import pathlib
import re
import shlex
import xml.etree.ElementTree as xml

from harness import arguments, check, finish, run, setting

parser = argparse.ArgumentParser()
parser.add_argument("--full", action="store_true")
parser.add_argument("--space", action="store_true")
options = arguments("--new", "--solve", "--input", "--schema", parser=parser)
INPUT = pathlib.Path(options.input)
HERE = pathlib.Path(__file__).resolve().parent
# Constants for coarse meshes.
COARSE = {"arch": "h=.2", "bolted_joint": "h=2", "roller_bearing": "fine=.2"}
COARSE_IN_SPACE = {"bolted_joint_3d": "h=8", "fault_3d": "order=1", "sphere": "resolution=3", "spheres": "resolution=2"}
AXISYMMETRIC = {"bolted_joint"}
# Contacts whose bodies overlap in the geometry, and the depth.
OVERLAPS = {"bolted_joint": {"lower_seat on nut_seat": 0.08}, "shrink_fit": {"bore of the outer on outside of the inner": 0.02}}

# Bodies and contacts of the geometries, by their names there.
KNOWN = {
    "tunnel": (["left", "right"], {("fault_lower_left", "fault_lower_right"), ("fault_upper_left", "fault_upper_right")}, 0.0),
    "hertz": (["block", "cylinder"], {("block_contact", "cylinder_contact")}, 0.0),
    "pin": (["lug", "pin"], {("lug_hole", "pin_outside")}, 0.02),
    "rings": (["inner", "outer"], {("inner_contact", "outer_contact")}, 0.0),
}
KNOWN_IN_SPACE = {
    "bolted_joint_3d": (["bolt", "lower", "nut", "upper"], {("bolt_shoulder", "nut_shoulder"), ("head_seat", "upper_seat"), ("lower_joint", "upper_joint"),
                                                            ("lower_seat", "nut_top")}),
    "fault_3d": (["left", "right"], {("fault_left", "fault_right")}),
    "sphere": (["ball"], set()),
    # The rims of the balls are also within search distance of each other.
    "spheres": (["lower", "upper"], {("{lower_contact, lower_flank}", "{upper_contact, upper_flank}")}),
}


def parameter(element, name):
    found = element.find(f"Parameter[@name='{name}']")
    return found.get("value") if found is not None else None


def sublists(root, name):
    found = root.find(f"ParameterList[@name='{name}']")
    return [] if found is None else found.findall("ParameterList")


def new(geometry, *words, ranks=1, scene="scene.xml"):
    path = options.work / scene
    code, text = run(options.new, ranks, geometry, "--output", path, *words)
    return code, text, path


def uncommented(name, path):
    """The scene with all its examples uncommented: parameters and sublists of a list have different names, without text between them."""
    text, count = re.subn(r"<!--[^<]*?\n((?:[ ]*<(?!!).*>\n)+)[ ]*-->", r"\1", path.read_text())
    root = xml.fromstring(text)
    for element in root.iter():
        names = [child.get("name") for child in element]
        check(f"{name}: names in '{element.get('name')}' differ", sorted(one for one in set(names) if names.count(one) > 1), [])
        wrong = [part.strip() for part in (element.text, *(child.tail for child in element)) if part and part.strip()]
        check(f"{name}: no words between the parameters of '{element.get('name')}'", wrong, [])
    return root, count


def runs(geometry, ranks, *words):
    """A geometry becomes a scene that is solved and verified; proposed contacts carry a force."""
    name = geometry.stem
    model = ["--model", "Axisymmetric"] if name in AXISYMMETRIC else []
    code, text, path = new(geometry, *model, *words, "--force", scene=f"{name}.xml")
    check(f"{name}: a scene", code, 0)
    found = {contact: float(depth) for contact, depth in re.findall(r"contact: (.*), overlap of ([^ ,]+)", text)}
    check(f"{name}: overlaps are reported", found, lambda depths: depths.keys() == OVERLAPS.get(name, {}).keys() and
          all(abs(depth - OVERLAPS[name][contact]) < .02 * depth for contact, depth in depths.items()))
    check(f"{name}: all bodies are held", "does not run yet" in text, False)
    for number in ranks:
        code, text = run(options.solve, number, path, "--output", options.work / name)
        check(f"{name}: the scene runs on {number} rank(s)", (code, "verified: forces, supports and contact hold" in text), (0, True))
        summary = json.loads((options.work / name / "summary.json").read_text())
        check(f"{name}: contact carries", summary["contact"]["active"] > 0, len(sublists(xml.parse(path).getroot(), "Contact")) > 0)


if options.full:
    for geometry in sorted(INPUT.rglob("*.geo")):
        runs(geometry, (1, 2))
    finish()

# Two hexahedral blocks of first- or second-order elements; the upper one is pushed by the gap plus 1e-4 of the diagonal.
HEXAHEDRA = """
DefineConstant[ order = {1}, gap = {.01} ];
name_0 = "lower"; name_1 = "upper";
For k In {0:1}
  p = newp; z = k * (1 + gap); n = 3 + k;
  Point(p) = {0, 0, z}; Point(p+1) = {2, 0, z}; Point(p+2) = {2, 1, z}; Point(p+3) = {0, 1, z};
  l = newl; Line(l) = {p, p+1}; Line(l+1) = {p+1, p+2}; Line(l+2) = {p+2, p+3}; Line(l+3) = {p+3, p};
  c = newll; Curve Loop(c) = {l:l+3}; s = news; Plane Surface(s) = {c};
  Transfinite Curve {l:l+3} = n + 1; Transfinite Surface {s}; Recombine Surface {s};
  block() = Extrude {0, 0, 1} { Surface{s}; Layers{n}; Recombine; };
  Physical Volume(StrCat(name~{k}, "")) = {block(1)};
  Physical Surface(StrCat(name~{k}, "_bottom")) = {s}; Physical Surface(StrCat(name~{k}, "_top")) = {block(0)};
  top[k] = block(0);
EndFor
Mesh.ElementOrder = order; Mesh.SecondOrderIncomplete = %d;
"""

if options.space:
    for name, (bodies, contacts) in KNOWN_IN_SPACE.items():
        runs(INPUT / name / f"{name}.geo", (2,), "--constant", COARSE_IN_SPACE[name])
        root = xml.parse(options.work / f"{name}.xml").getroot()
        check(f"{name}: model", parameter(root, "Model"), "Solid")
        check(f"{name}: bodies", sorted(e.get("name") for e in sublists(root, "Bodies")), bodies)
        check(f"{name}: contacts", {(parameter(e, "Side A"), parameter(e, "Side B")) for e in sublists(root, "Contact")}, contacts)
    check("sides in a plane of symmetry are found", 'value="{lower_x, upper_x}"' in (options.work / "spheres.xml").read_text(), True)
    root, count = uncommented("spheres", options.work / "spheres.xml")
    check("examples are uncommented", (count >= 6, sum(e.get("name").startswith("symmetry") for e in sublists(root, "Boundary Conditions"))), (True, 2))
    geometry = options.work / "hexahedra.geo"
    for incomplete, order in ((0, 1), (1, 2)):
        geometry.write_text(HEXAHEDRA % incomplete)
        runs(geometry, (2,), "--constant", f"order={order}")
        push = json.loads((options.work / "hexahedra" / "summary.json").read_text())["parameters"]["Boundary Conditions"]["push upper"]["Value"]
        check("the push closes the gap and presses by a ten-thousandth", push, lambda u: u[:2] == [0, 0] and abs(u[2] + .01 + 1e-4 * 6 ** .5) < 1e-7)
    # A mesh with two names per side, as in Gmsh's .inp files.
    geometry.write_text(HEXAHEDRA % 0 + 'Physical Surface("second name of it") = {top[0]};\n')
    code, text, path = new(geometry, "--force", scene="named.xml")
    check("a second name of a side makes no second contact", (code, "contact: lower_top on upper_bottom" in text, "1 contact proposed" in text),
          (0, True, True))
    finish()

# The documented scene runs unchanged: the contact carries a pressure of 1e6 on a width of 2.
code, text = run(options.schema, 1, "--format", "xml")
documented = options.work / "documented.xml"
documented.write_text(text)
for ranks in (1, 2):
    code, text = run(options.solve, ranks, documented, "--output", options.work / "documented_out")
    check(f"the documented scene on {ranks} ranks: exit code", code, 0)
    contact = json.loads((options.work / "documented_out/summary.json").read_text())["reactions"]["contacts"]["joint"]
    check("its contact carries the load", abs(abs(contact["force"][1]) - 2e6) < 1, True)

for name, (bodies, contacts, gap) in KNOWN.items():
    code, text, path = new(INPUT / name / f"{name}.geo", ranks=2, scene=f"{name}.xml")
    check(f"{name}: exit code", code, 0)
    root = xml.parse(path).getroot()
    check(f"{name}: bodies", sorted(e.get("name") for e in sublists(root, "Bodies")), bodies)
    check(f"{name}: contacts", {(parameter(e, "Side A"), parameter(e, "Side B")) for e in sublists(root, "Contact")}, contacts)
    distances = [float(word) for word in re.findall(r"minimum distance (\S+)", text)]
    check(f"{name}: the least distance is reported", distances, lambda found: all(abs(one - gap) < .01 * max(gap, 1e-12) for one in found))
    again = path.read_text()
    new(INPUT / name / f"{name}.geo", "--force", ranks=1, scene=f"{name}.xml")
    check(f"{name}: the same on one rank", path.read_text(), again)

# Bodies held only by contact, sides shared by several bodies, overlapping sides; --full runs all geometries.
for name in ("arch", "bolted_joint", "roller_bearing"):
    runs(INPUT / name / f"{name}.geo", (2,), "--constant", COARSE[name])
check("sides in a plane of symmetry are found", 'value="{ring_cut, roller_0_cut, shaft_cut}"' in (options.work / "roller_bearing.xml").read_text(), True)
for name in ("loose_roller", "pile_of_discs", "shaft_in_plates", "shrink_fit"):
    runs(HERE / f"{name}.geo", (2,))

code, text, path = new(INPUT / "tunnel" / "tunnel.geo", scene="tunnel.xml")
check("an existing scene is kept", (code, "overwrite it with --force" in text), (3, True))

# Two blocks that share nodes, and a third one that touches a side of both.
GEO = """
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 1, 1}; Rectangle(2) = {1, 0, 0, 1, 1};
BooleanFragments{ Surface{1, 2}; Delete; }{}
Rectangle(7) = {0, 1, 0, 2, .5};
MeshSize{:} = .2;
Physical Surface("a") = {1}; Physical Surface("b") = {2}; Physical Surface("lid") = {7};
%s
b() = Boundary{ Surface{7}; };
Physical Curve("lid_bottom") = {b(0)};
"""
geometry = options.work / "joined.geo"
geometry.write_text(GEO % "")
code, text, path = new(geometry, scene="joined.xml")
check("bodies that share nodes are refused", (code, "share nodes and belong to a, b" in text, path.exists()), (3, True, False))
geometry.write_text(GEO % 'Physical Surface("both") = {1, 2};')
code, text, path = new(geometry, scene="joined.xml")
root = xml.parse(path).getroot()
check("a group of all of it is the body", sorted(e.get("name") for e in sublists(root, "Bodies")), ["both", "lid"])
check("its parts are offered as regions", [f'name="Group" type="string" value="{part}"' in path.read_text() for part in "ab"], [True, True])
check("unnamed sides that face another body are reported", "with sides in no curve group: name them" in text, True)

# Two stacked 3D blocks.
geometry = options.work / "stack.geo"
geometry.write_text("""
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 2, 1, 1}; Box(2) = {0, 0, 1.25, 2, 1, 1};
MeshSize{:} = .5;
Physical Volume("lower") = {1}; Physical Volume("upper") = {2};
Physical Surface("lower_bottom") = {5}; Physical Surface("lower_top") = {6}; Physical Surface("upper_bottom") = {11};
""")
code, text, path = new(geometry, scene="stack.xml")
check("a 3D scene", (code, "2 bodies, 3 surface groups, 1 contact proposed" in text), (0, True))
root = xml.parse(path).getroot()
check("its model", parameter(root, "Model"), "Solid")
check("its contact", [(parameter(e, "Side A"), parameter(e, "Side B")) for e in sublists(root, "Contact")], [("lower_top", "upper_bottom")])
check("the gap is reported", re.findall(r"minimum distance (\S+)", text), ["0.25"])
held = [e for e in sublists(root, "Boundary Conditions") if parameter(e, "Type") == "Displacement"]
check("its support", [(parameter(e, "Group"), parameter(e, "Value")) for e in held][:1], [("lower_bottom", "{0, 0, 0}")])
check("its groups are listed", re.findall(r"surface +lower_top  on lower, from (.*) to (.*), .* area (\S+)", path.read_text()), [("(0, 0, 1)", "(2, 1, 1)", "2")])
code, text, path = new(geometry, "--model", "Plane Strain", scene="flat.xml")
check("a 2D model of a 3D geometry is refused", (code, "expected Solid" in text, path.exists()), (3, True, False))
code, text, path = new(INPUT / "pin" / "pin.geo", "--model", "Solid", scene="solid.xml")
check("and the other way round", (code, "expected Plane Strain" in text, path.exists()), (3, True, False))


# Coordinates at round-off level become zeros; the example's numbers are in the user's units.
geometry = options.work / "turned.geo"
geometry.write_text("""
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 100, 100}; Rectangle(2) = {0, 100, 0, 100, 100};
Rotate {{0, 0, 1}, {33, 17, 0}, Pi/7} { Surface{1, 2}; } Rotate {{0, 0, 1}, {33, 17, 0}, -Pi/7} { Surface{1, 2}; }
MeshSize{:} = 25;
Physical Surface("low") = {1}; Physical Surface("up") = {2};
a() = Boundary{ Surface{1}; }; b() = Boundary{ Surface{2}; };
Physical Curve("low_bottom") = {a(0)}; Physical Curve("low_top") = {a(2)}; Physical Curve("up_bottom") = {b(0)}; Physical Curve("up_top") = {b(2)};
Physical Curve("low_left") = {a(3)}; Physical Curve("up_left") = {b(3)}; Physical Curve("low_right") = {a(1)}; Physical Curve("up_right") = {b(1)};
""")
code, text, path = new(geometry, "--units", "mm, N, MPa", scene="turned.xml")
check("a turned geometry: numbers at round-off level", (code, re.findall(r"\S*e-1[0-9]\b", path.read_text() + text)), (0, []))
root, count = uncommented("turned", path)
check("a turned geometry: both planes of symmetry", sorted(e.get("name") for e in sublists(root, "Boundary Conditions") if "symmetry" in e.get("name")),
      ["symmetry x", "symmetry x 2"])
steel = [e for e in sublists(root, "Materials")][0]
check("units", (parameter(root, "Units"), float(parameter(steel, "Young Modulus"))), ("mm, N, MPa", 2.1e5))
weight = [e for e in sublists(root, "Boundary Conditions") if e.get("name") == "weight"][0]
check("weight in N / mm^3", abs(float(parameter(weight, "Value").strip("{}").split(",")[1]) + 7.7e-5) < 1e-10, True)
code, text = run(options.solve, 1, path, "--output", options.work / "turned")
check("it runs", code, 0)
summary = json.loads((options.work / "turned" / "summary.json").read_text())
check("with these units", summary["units"], "mm, N, MPa")
traction = [e for e in sublists(root, "Boundary Conditions") if e.get("name") == "traction"][0]
check("the example traction pushes down", parameter(traction, "Value"), "{0, -1}")
check("the example roller is not named like a body", [e.get("name") for e in sublists(root, "Boundary Conditions") if "roller" in e.get("name")],
      ["roller support"])
check("sizes of groups", re.findall(r"curve +low_top  on low, .*, 4 element edges, length 100", path.read_text()), lambda found: len(found) == 1)

# A geometry in mm, without and with the units that a note recommends.
name = re.search(r"'low' is 100 m long in the default units \(m, N, Pa\). If the geometry is in mm, add: (.*)", new(geometry, scene="metres.xml")[1])
check("a body of 100 m: a note on the units", bool(name), True)
code, text, path = new(geometry, *shlex.split(name[1]), scene="metres.xml")
check("as recommended", (code, " m long" in text, parameter(xml.parse(path).getroot(), "Units")), (0, False, "mm, N, MPa"))
check("a body of 2 m: no note", " m long" in new(options.work / "joined.geo", scene="small.xml")[1], False)
code, text = run(options.solve, 1, geometry)
check("a geometry in place of a scene: what to do", (code, text.count(f"suture_new {geometry}")), (3, 1))

# Missing data is reported, and the scene has placeholders for it.
BLOCKS = """
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 1, 1}; Rectangle(2) = {0, 1, 0, 1, 1};
MeshSize{:} = .2;
Physical Surface("a") = {1}; Physical Surface("b") = {2};
a() = Boundary{ Surface{1}; }; b() = Boundary{ Surface{2}; };
"""
geometry = options.work / "blocks.geo"
geometry.write_text(BLOCKS + 'Physical Curve("a_bottom") = {a(0)}; Physical Curve("a_top") = {a(2)};\n')
code, text, path = new(geometry, scene="bare.xml")
check("a body without a curve group is reported", (code, "body 'b' has no curve group" in text, "FILL IN: body 'b'" in path.read_text()), (0, True, True))
code, text = run(options.solve, 1, path, "--output", options.work / "bare")
check("and named when it is solved", (code, "Bodies/b: nothing holds this body" in text), (3, True))
geometry.write_text(BLOCKS)
code, text, path = new(geometry, scene="nameless.xml")
check("a geometry without curve groups has the place for a support", (code, "FILL IN: the geometry has no curve group" in path.read_text()), (0, True))
geometry.write_text(BLOCKS + 'Physical Curve("joint") = {a(2), b(0)}; Physical Curve("bottom") = {a(0)};\n')
code, text, path = new(geometry, scene="shared.xml")
check("one group for both sides of a contact is reported", (code, "in the curve group 'joint', which is on several bodies" in text), (0, True))
geometry.write_text(BLOCKS + 'Physical Curve("around a") = {a()}; Physical Curve("around b") = {b()};\n')
code, text, path = new(geometry, scene="corners.xml")
check("a contact that suture_solve would refuse is left out with a reason", (code, "left out of the scene: 'around a' turns by 90 degrees" in text), (0, True))
code, text = run(options.solve, 1, path, "--output", options.work / "corners")
check("its scene runs", code, 0)

geometry.write_text("Point(1) = {0, 0, 0, .3}; Point(2) = {1, 0, 0, .3}; Point(3) = {0, 1, 0, .3}; Line(1) = {1, 2}; Line(2) = {2, 3}; "
                    "Line(3) = {3, 1}; Curve Loop(1) = {1, 2, 3}; Plane Surface(1) = {1}; Physical Curve(\"all\") = {1, 2, 3};")
code, text, path = new(geometry, scene="none.xml")
check("a geometry without surface groups is refused", (code, path.exists()), (3, False))
code, text, path = new(options.work / "no.geo", scene="no.xml")
check("a geometry that is not there is refused", (code, "no.geo" in text, path.exists()), (3, True, False))
code, text, path = new(INPUT / "pin" / "pin.geo", "--constant", "clearnace=.1", scene="typo.xml")
check("a constant that is not there is refused with the nearest", (code, "clearance" in text, path.exists()), (3, True, False))
code, text, path = new(INPUT / "pin" / "pin.geo", "--constant", "clearance=.05", scene="wide.xml")
code, text = run(options.solve, 1, path, "--check", "--no-drawing", "--output", options.work / "wide")
check("constants are in the scene", (code, 'name="clearance"' in path.read_text()), (0, True))
finish()
