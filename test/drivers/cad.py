"""CAD files from suture_new to the result: an assembly in inches, touching solids, a clevis joint beside the same joint from a .geo file.
cad.py --new PROGRAM --solve PROGRAM --gmsh PROGRAM --source FOLDER --work DIR --mpirun "mpirun ..."

The program gmsh draws the STEP files; without it (--gmsh none) only the stored files are tested."""
import csv
import json
import pathlib
import re
import subprocess
import xml.etree.ElementTree as xml

from harness import arguments, check, finish, run, setting

options = arguments("--new", "--solve", "--gmsh", "--source")
SOURCE = pathlib.Path(options.source)
ASSEMBLY = SOURCE / "test" / "reader" / "cad" / "bolted_joint_in.step"
HERE = pathlib.Path(__file__).resolve().parent


def new(geometry, *words, ranks=1, scene="scene.xml"):
    path = options.work / scene
    code, text = run(options.new, ranks, geometry, "--output", path, "--force", *words)
    return code, text, path


def solved(scene, *words, ranks=1, name="out"):
    out = options.work / name
    code, text = run(options.solve, ranks, scene, "--output", out, *words, timeout=300)
    check(f"{name}: solved and verified", (code, "verified: forces, supports and contact hold" in text), (0, True))
    return json.loads((out / "summary.json").read_text()), out


def value(root, *path):
    for name in path[:-1]:
        root = root.find(f"ParameterList[@name='{name}']")
    return root.find(f"Parameter[@name='{path[-1]}']").get("value")


def drawn(name, text):
    """A STEP file of Gmsh's program."""
    (options.work / f"{name}.geo").write_text(text)
    path = options.work / f"{name}.step"
    subprocess.run([options.gmsh, options.work / f"{name}.geo", "-0", "-o", path], check=True, capture_output=True)
    return path


# The same assembly in three units: all lengths of the result follow the unit, all forces its force.
POUND, INCH = 4.4482216152605, 0.0254
extremes = {}
for unit, metres, newtons, names in (("in", INCH, POUND, "in, lbf, psi"), ("mm", 1e-3, 1, "mm, N, MPa"), ("m", 1, 1, "m, N, Pa")):
    code, text, path = new(ASSEMBLY, "--units", unit, scene=f"bolts_{unit}.xml")
    root = xml.parse(path).getroot()
    check(f"{unit}: bodies and contacts", (code, "3 bodies, 14 surface groups, 2 contacts proposed" in text), (0, True))
    check(f"{unit}: units", value(root, "Units"), names)
    check(f"{unit}: the next steps", f"suture_plot --scene {path}" in text and f"suture_solve {path}" in text, True)
    gaps = [float(gap) for gap in re.findall(r"contact: base_plate_steel_cylinder_\d on bolt_\d_cylinder_1, minimum distance (\S+)", text)]
    check(f"{unit}: the clearance of .01 in", gaps, lambda found: len(found) == 2 and all(abs(gap * metres / INCH - .01) < 1e-4 for gap in found))
    reach = re.search(r"contacts: sides of different bodies that face each other, up to (\S+) apart", text)
    check(f"{unit}: the tolerance, a twentieth of the bolt", reach and abs(float(reach[1]) * metres / INCH - .05 * (.5 ** 2 + .5 ** 2 + .75 ** 2) ** .5) < 1e-3, True)
    scene = path.read_text()
    radius = re.search(r"base_plate_steel_cylinder_1  on base_plate_steel, cylinder, radius (\S+), along z, hollow, from .*, area (\S+)", scene)
    check(f"{unit}: radius and area in the comment", [float(n) for n in radius.groups()] if radius else None, lambda found: found and
          abs(found[0] * metres / INCH - .26) < 1e-6 and abs(found[1] * (metres / INCH) ** 2 - 2 * 3.14159265 * .26 * .5) < 1e-3)
    check(f"{unit}: numbers at round-off level", re.findall(r"[ (]-?\d\S*e-1\d", scene), [])
    summary, _ = solved(path, ranks=2, name=f"bolts_{unit}")
    extremes[unit] = (summary["extremes"]["displacement"]["value"] * metres, summary["extremes"]["pressure"]["value"] * newtons / metres ** 2)
for unit in ("in", "m"):
    check(f"displacement and pressure of the scene in {unit} and in mm", [a / b for a, b in zip(extremes[unit], extremes["mm"])],
          lambda found: all(abs(ratio - 1) < 1e-3 for ratio in found))
text = new(ASSEMBLY, "--units", "mm", ranks=2, scene="bolts_mm.xml")[2].read_text()
check("the same scene on two ranks", text, new(ASSEMBLY, "--units", "mm", ranks=1, scene="bolts_mm.xml")[2].read_text())
code, text, path = new(ASSEMBLY, "--units", "furlong, N, Pa", scene="furlong.xml")
check("an unknown unit is refused", (code, "Mesh/Length Unit: is unknown" in text), (3, True))

# Files that are no CAD files, on two ranks: the same message once.
for name, content, says in (("empty.step", "", "is empty"), ("cut.step", ASSEMBLY.read_text()[:9000], "is cut off"), ("text.igs", "hello\n", "is not an IGES file")):
    (options.work / name).write_text(content)
    code, text, path = new(options.work / name, ranks=2, scene="damaged.xml")
    check(f"{name} is refused", (code, text.count(says), path.exists()), (3, 1, False))
if options.gmsh == "none":
    finish()

BLOCKS = """SetFactory("OpenCASCADE"); Box(1) = {0, 0, 0, 4, 4, 1}; Box(2) = {1, 1, 1, 2, 2, 1}; %s\n"""
for name, more in (("touching", ""), ("glued", "BooleanFragments{ Volume{1}; Delete; }{ Volume{2}; Delete; }")):
    code, text, path = new(drawn(name, BLOCKS % more), "--units", "mm", scene=f"{name}.xml")
    contacts = re.findall(r"contact: (.*) on (.*), minimum distance (\S+)", text)
    # The face of the lower block that is cut along the edge of the upper one is two sides, and both are near the upper one.
    sides = "body_1_top" if name == "touching" else "body_1_top_1, body_1_top_2"
    check(f"{name}: the contact", (code, [(set(one[:2]), float(one[2])) for one in contacts]), (0, [({"body_2_bottom", sides}, 0.0)]))
    summary, _ = solved(path, ranks=2, name=name)
    check(f"{name}: the contact carries", summary["contact"]["active"] > 0, True)

# The clevis joint of tutorial 5 beside the same joint with groups named by hand, with second-order elements.
tutorial = SOURCE / "doc" / "tutorials"
step = drawn("clevis", (tutorial / "clevis.geo").read_text())
code, text, path = new(step, "--units", "mm", scene="clevis_new.xml")
old = {line.strip() for line in path.read_text().splitlines()}
typed = [line for line in (tutorial / "clevis.xml").read_text().splitlines() if line.strip() and line.strip() not in old]
commands = [line for block in re.findall(r"```sh\n(.*?)```", (tutorial / "5_clevis.md").read_text(), re.S) for line in block.splitlines()
            if re.match(r"gmsh|suture_new|suture_solve clevis.xml$|suture_plot", line)]
check("lines to type from STEP to report", (len(commands), len(commands) + len(typed)), lambda count: count[0] == 4 and count[1] <= 12)
(options.work / "clevis.xml").write_text((tutorial / "clevis.xml").read_text())
cad, out = solved(options.work / "clevis.xml", ranks=2, name="clevis")
hand, by_hand = solved(HERE / "clevis_by_hand.xml", *setting("Mesh/Order", 2), *setting("Mesh/Mesh Size Factor", 1.4), ranks=2, name="by_hand")
moved = [run["extremes"]["displacement"]["value"] for run in (cad, hand)]
check("displacements agree", moved, lambda u: abs(u[0] / u[1] - 1) < .02)


def forces(folder):
    with open(folder / "reactions.csv", newline="") as table:
        return {row["name"]: [float(row[f"f{k}"]) for k in "xyz"] for row in csv.DictReader(table)}


def on_rod(folder, rod):
    """Force of the pin on the rod along x, from the pairs."""
    total = 0.0
    with open(folder / "contact.csv", newline="") as table:
        for row in csv.DictReader(table):
            if rod in (row["body_a"], row["body_b"]) and row["status"] != "open":
                total += float(row["force"]) * float(row["nx"]) * (1 if row["body_b"] == rod else -1)
    return total


found, expected = forces(out), forces(by_hand)
check("the lug's end carries the load", abs(found["hold lug"][0] - 2500) < .01 and abs(expected["hold lug"][0] - 2500) < .01, True)
pin = "body_2_cylinder_1 on body_1_cylinder_1 and others"
check("the pin is in equilibrium along x", abs(found[pin][0]) < .1, True)
normal = [on_rod(out, "body_1"), on_rod(by_hand, "rod")]
check("normal forces of the pin on the rod agree", normal, lambda f: abs(abs(f[0]) / abs(f[1]) - 1) < .03)
check("and the rod's 2500 N are these and friction, at most the coefficient times them", normal, lambda f: abs(2500 - abs(f[0])) < .15 * 2500)
finish()
