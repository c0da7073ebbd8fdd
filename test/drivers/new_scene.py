"""suture_new, and the scene of suture_schema: scenes that run, bodies and contacts found from geometries, refusals. new_scene.py --new PROGRAM --solve PROGRAM
--mpirun "mpirun ..." --work DIR --input FOLDER"""
import json
import pathlib
import re
import xml.etree.ElementTree as xml

from harness import arguments, check, finish, run, setting

options = arguments("--new", "--solve", "--input", "--schema")
INPUT = pathlib.Path(options.input)

# Bodies and contacts of geometries, as those who drew them named them.
KNOWN = {
    "tunnel": (["left", "right"], {("fault_lower_left", "fault_lower_right"), ("fault_upper_left", "fault_upper_right")}, 0.0),
    "hertz": (["block", "cylinder"], {("block_contact", "cylinder_contact")}, 0.0),
    "pin": (["lug", "pin"], {("lug_hole", "pin_outside")}, 0.02),
    "rings": (["inner", "outer"], {("inner_contact", "outer_contact")}, 0.0),
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


# The documented scene runs as it is: a pressure of 1e6 on a width of 2 goes through the contact.
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
    told = [float(word) for word in re.findall(r"least distance (\S+)", text)]
    check(f"{name}: the least distance is told", told, lambda found: all(abs(one - gap) < .01 * max(gap, 1e-12) for one in found))
    again = path.read_text()
    new(INPUT / name / f"{name}.geo", "--force", ranks=1, scene=f"{name}.xml")
    check(f"{name}: the same on one rank", path.read_text(), again)
    code, text = run(options.solve, 2, path, "--output", options.work / name)
    check(f"{name}: the scene runs", (code, "verified: forces, supports and contact hold" in text), (0, True))
    summary = json.loads((options.work / name / "summary.json").read_text())
    check(f"{name}: its contact carries", summary["contact"]["active"], lambda found: found > 0)

code, text, path = new(INPUT / "tunnel" / "tunnel.geo", scene="tunnel.xml")
check("an existing scene is kept", (code, "--force to overwrite" in text), (3, True))

# Two blocks that share nodes, and a third beside them that touches one side of both.
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
check("sides without a name that face another body are told", "with sides in no curve group: name these" in text, True)

geometry.write_text("Point(1) = {0, 0, 0, .3}; Point(2) = {1, 0, 0, .3}; Point(3) = {0, 1, 0, .3}; Line(1) = {1, 2}; Line(2) = {2, 3}; "
                    "Line(3) = {3, 1}; Curve Loop(1) = {1, 2, 3}; Plane Surface(1) = {1}; Physical Curve(\"all\") = {1, 2, 3};")
code, text, path = new(geometry, scene="none.xml")
check("a geometry without surface groups is refused", (code, path.exists()), (3, False))
code, text, path = new(options.work / "no.geo", scene="no.xml")
check("a geometry that is not there is refused", (code, "no.geo" in text, path.exists()), (3, True, False))
code, text, path = new(INPUT / "pin" / "pin.geo", "--constant", "clearnace=.1", scene="typo.xml")
check("a constant that is not there is refused with the nearest", (code, "clearance" in text, path.exists()), (3, True, False))
code, text, path = new(INPUT / "pin" / "pin.geo", "--constant", "clearance=.05", scene="wide.xml")
code, text = run(options.solve, 1, path, "--check", "--output", options.work / "wide")
check("constants stand in the scene", (code, 'name="clearance"' in path.read_text()), (0, True))
finish()
