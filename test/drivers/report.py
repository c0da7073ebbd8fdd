#!/usr/bin/python3
"""report.html of suture_plot: complete, without network access, with the numbers of summary.json; clear errors for folders that are not runs.

    report.py --solve suture_solve --plot suture_plot --input DIR --work DIR --mpirun "..."
"""
import base64
import io
import json
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from html.parser import HTMLParser
from pathlib import Path

import h5py  # noqa: F401, here and below: imported once for all forks
import matplotlib.pyplot  # noqa: F401
from PIL import Image, ImageChops
from harness import arguments, check, finish, forked, run, setting

SECTIONS = ["answers", "mesh", "deformation", "von_mises", "principal", "contact", "scene", "reactions", "verdict", "error", "convergence", "cost", "provenance"]
SOMETIMES = ["state", "view", "steps", "probes", "accuracy", "pieces", "path"]
EMPTY = {"area", "base", "br", "col", "embed", "hr", "img", "input", "link", "meta", "source", "track", "wbr"}
options = arguments("--solve", "--plot", "--input")
scenes = Path(options.input)


class Nesting(HTMLParser):
    """Whether all elements are properly nested, as a browser requires."""

    def __init__(self):
        super().__init__()
        self.open, self.wrong = [], []

    def handle_starttag(self, tag, attributes):
        if tag not in EMPTY:
            self.open.append(tag)

    def handle_endtag(self, tag):
        if tag not in EMPTY and (not self.open or self.open.pop() != tag):
            self.wrong.append(tag)


def started(program, *words):
    """Exit code and output of a Python program, started as a user starts it."""
    done = subprocess.run([sys.executable, "-B", program, *map(str, words)], capture_output=True, text=True, timeout=200)
    return done.returncode, done.stdout + done.stderr


def plot(folder, *more):
    return forked(options.plot, folder, *more)


def page_of(name, folder):
    """Checks common to all reports. Returns the page as a tree."""
    text = (folder / "report.html").read_text(encoding="utf-8")
    nesting = Nesting()
    nesting.feed(text)
    check(f"{name}: elements are nested", (nesting.wrong, nesting.open), ([], []))
    tree = ElementTree.fromstring(text.split("\n", 1)[1])
    scripts = re.findall(r"<script.*?</script>", text, flags=re.S)
    bare = re.sub(r"data:image/png;base64,[A-Za-z0-9+/=]*|<script.*?</script>", "", text, flags=re.S)
    check(f"{name}: nothing outside is named", re.findall(r"https?:|//[a-z]|url\(|@import|<link|<iframe|<object|javascript:", bare), [])
    check(f"{name}: browsers refuse to load anything", "default-src 'none'" in tree.find(".//meta[@http-equiv]").get("content"), True)
    check(f"{name}: scripts only with an interactive view", bool(scripts), tree.find(".//div[@id='view3d']") is not None)
    for element in tree.iter():
        for key, value in element.attrib.items():
            if key == "src" and not value.startswith("data:image/png;base64,") or key == "href" and not value.startswith("#") or key.startswith("on"):
                check(f"{name}: {element.tag} {key}", value[:60], "data: or #")
    check(f"{name}: sections", [section.get("id") for section in tree.iter("section") if section.get("id") not in SOMETIMES], SECTIONS)
    check(f"{name}: every section has a heading and content", [s.get("id") for s in tree.iter("section") if s.find("h2") is None or len(s) < 2], [])
    linked = [a.get("href")[1:] for a in tree.iter("a")]
    check(f"{name}: links lead to sections", [key for key in linked if tree.find(f".//section[@id='{key}']") is None], [])
    pictures = [base64.b64decode(image.get("src").split(",", 1)[1])[:8] for image in tree.iter("img")]
    check(f"{name}: pictures are PNG", set(pictures) <= {b"\x89PNG\r\n\x1a\n"}, True)
    for drawn in tree.iter("figure"):
        off = pixels_off(drawn.find("img"), folder / f"{drawn.get('id')[len('picture_'):]}.png")
        check(f"{name}: {drawn.get('id')} looks like its file", off, lambda part: part < 0.01)
    wrong = [data.get("value") for data in tree.iter("data") if not reads(data)]
    check(f"{name}: numbers read as they are", wrong, [])
    return tree, len(pictures)


def pixels_off(image, path):
    """Fraction of pixels where an embedded picture differs from its file by more than a twentieth of the scale."""
    with Image.open(io.BytesIO(base64.b64decode(image.get("src").split(",", 1)[1]))) as embedded, Image.open(path) as file:
        difference = ImageChops.difference(embedded.convert("RGB"), file.convert("RGB"))
    return sum(difference.convert("L").histogram()[13:]) / (difference.width * difference.height)


def reads(data):
    """Whether a text equals the number to its written digits."""
    text, whole = data.text.replace(",", "").replace("\u2212", "-"), re.fullmatch(r"-?[0-9]+", data.get("value"))
    value = float(data.get("value"))
    return float(text) == value if whole else abs(float(text) - value) <= 6e-3 * abs(value)


def numbers(element):
    return [json.loads(data.get("value")) for data in element.iter("data")]


def row(tree, section, first):
    """Numbers in the row of a table whose first cell reads `first`."""
    for line in tree.find(f".//section[@id='{section}']").iter("tr"):
        cells = line.findall("td")
        if cells and "".join(cells[0].itertext()) == first:
            return [number for cell in cells[1:] for number in numbers(cell)]
    return None


def same_numbers(name, tree, summary):
    """Compares the numbers of the page with summary.json, all digits."""
    for key in ("von_mises", "tension", "compression", "displacement", "pressure"):
        known = summary["extremes"][key]
        card = tree.find(f".//div[@id='extreme_{key}']")
        check(f"{name}: extreme {key}", numbers(card) if card is not None else None, [known["value"], *(known["place"] or [])] if known else None)
    for key, found in summary["verification"].items():
        check(f"{name}: check {key}", row(tree, "verdict", key), [found["value"], found["bound"]])
    for key, found in summary["phases"].items():
        check(f"{name}: seconds of {key}", row(tree, "cost", key), [found["min"], found["avg"], found["max"]])
    check(f"{name}: seconds", row(tree, "cost", "total"), [summary["seconds"]])
    for key, found in summary["reactions"]["conditions"].items():
        check(f"{name}: force of {key}", row(tree, "reactions", key), [*found["force"], *found["moment"]])
    for key, found in summary["reactions"]["contacts"].items():
        check(f"{name}: force of {key}", row(tree, "reactions", key),
              [*found["force"], *found["moment"], *(found["centre"] or []), found["closed"], found["whole"]])
    for key, found in summary["contact"]["by_piece"].items():
        check(f"{name}: piece {key}", row(tree, "pieces", key), [found["active"], found["pairs"], found["max_pressure"], found["max_gap"]])
    if summary["outer"]["solver"]:
        check(f"{name}: iterations", (row(tree, "convergence", "outer iterations"), row(tree, "convergence", "total PCG iterations")),
              ([summary["outer"]["iterations"]], [summary["outer"]["pcg_total"]]))
    check(f"{name}: residual", row(tree, "convergence", "final relative residual"), [summary["outer"]["residual"]])


def same_answers(name, tree, summary):
    """The first page: force of every condition and contact, forces between bodies, one sentence on the error, every note of the run."""
    found, answers = summary["reactions"], tree.find(".//section[@id='answers']")
    largest = max(abs(part) for kind in ("conditions", "contacts") for one in found[kind].values() for part in one["force"])

    def agree(cells, force):
        return len(cells) == len(force) and all(abs(a - b) <= 2e-9 * largest for a, b in zip(cells, force))

    size = summary["dimension"]
    for kind in ("conditions", "contacts"):
        for key, one in found[kind].items():
            cells = (row(tree, "answers", key) or [])[:size]
            check(f"{name}: force of {key} on the first page", agree(cells, one["force"]), True)
    between = answers.find(".//table[@id='body_forces']")
    if between is not None:
        pairs = {}
        for one in found["contacts"].values():
            pairs.setdefault(tuple(one["bodies"]), []).append(one["force"])
        sums = [[sum(parts) for parts in zip(*forces)] for forces in pairs.values()]
        shown = [numbers(line)[:size] for line in between.find("tbody").iter("tr")]
        check(f"{name}: forces between bodies", [force for force in sums if not any(agree(cells, force) for cells in shown)], [])
    check(f"{name}: the error in a sentence", "of the energy norm" in "".join(answers.find(".//p[@id='error_sentence']").itertext()), True)
    text = "".join(tree.itertext())
    check(f"{name}: every note of the run", [note for note in summary["notes"] if note.split(": ", 1)[-1][1:60] not in text], [])


def solved(name, scene, code, *more):
    folder = options.work / name
    check(f"{name}: exit code of the run", run(options.solve, 2, scene, "--output", folder, *more)[0], code)
    return folder, json.loads((folder / "summary.json").read_text())


def said(tree, section):
    return " ".join(tree.find(f".//section[@id='{section}']").itertext())


# Successful runs.
HEADER = [*setting("Report/Project", "Pin <7> & lug"), *setting("Report/Author", "N. N."), *setting("Report/Revision", "B")]
for name, more, pictures in (("hertz_sphere", setting("Output/Error Estimate", "true"), 9), ("linear_square", [], 5), ("cattaneo", HEADER, 10)):
    folder, summary = solved(name, scenes / name / f"{name}.xml", 0, *more)
    code, text = started(options.plot, folder)
    check(f"{name}: suture_plot", (code, "report.html" in text), (0, True))
    tree, drawn = page_of(name, folder)
    check(f"{name}: pictures", drawn, pictures)
    check(f"{name}: good", tree.find(".//div[@id='banner']").get("class"), "verdict")
    same_numbers(name, tree, summary)
    given = summary["parameters"]
    for section, keys in (("scene", ("Bodies", "Materials")), ("answers", ("Boundary Conditions", "Contact"))):
        check(f"{name}: {section} in words", [word for key in keys for word in given[key] if word not in said(tree, section)], [])
    check(f"{name}: laws", [law for law in (contact["Law"] for contact in given["Contact"].values()) if law not in said(tree, "answers")], [])
    same_answers(name, tree, summary)
    check(f"{name}: provenance", [word for word in (summary["mesh_hash"], *summary["command_line"], *summary["versions"].values())
                                  if word not in said(tree, "provenance")], [])
    if "load_steps" in summary:
        check(f"{name}: load steps", (row(tree, "path", "load steps"), row(tree, "path", "time at the end of the last step")),
              ([summary["load_steps"]["count"]], [summary["load_steps"]["time"]]))
    if name == "hertz_sphere":
        check(f"{name}: error estimate", row(tree, "error", "discretisation, estimated from recovered stresses, energy norm"),
              [summary["error"]["estimated_energy_norm"], summary["error"]["estimated_energy_norm_relative"]])

# Pictures of large reports are compressed further, without loss.
sys.path.insert(0, str(Path(options.plot).resolve().parent))
from suture_plot_parts.html import embedded  # noqa: E402

form, small = embedded(folder / "von_mises.png", True)
with Image.open(io.BytesIO(base64.b64decode(small))) as image, Image.open(folder / "von_mises.png") as file:
    check("compressed picture: every pixel", (form, image.format, ImageChops.difference(image.convert("RGB"), file.convert("RGB")).getbbox()),
          ("webp", "WEBP", None))

# The header, the factors of load steps, the coefficients of laws: in the last of these runs.
check("header: recorded", summary["parameters"]["Report"], {"Project": "Pin <7> & lug", "Author": "N. N.", "Revision": "B", "Date": ""})
fields = {entry.find("dt").text: entry.find("dd").text for entry in tree.find(".//dl[@id='fields']")}
check("header: fields", (fields.get("Project"), fields.get("Author"), fields.get("Revision"), "Date" in fields), ("Pin <7> & lug", "N. N.", "B", False))
answers = said(tree, "answers")
check("header: factors and coefficients", [words for words in ("min(t, 1)", "{0, 1, 0, -1, 0, 1}", "Coulomb: coefficient 0.3", "t = 1, 2, 3, 4, 5, 6")
                                           if words not in answers], [])
code, text = run(options.solve, 1, scenes / "cattaneo" / "cattaneo.xml", "--output", options.work / "misspelt", *setting("Report/Autor", "N. N."))
check("header: an unknown field", (code, "Report/Autor" in text, "Did you mean 'Author'?" in text), (3, True, True))

# Notes that limit the answers are at the top, those on the solver in the appendix.
noted = options.work / "noted"
shutil.copytree(folder, noted)
summary = json.loads((noted / "summary.json").read_text())
summary["notes"] = ["warning: contact 'touch': pressures alternate", "the largest pressure is at (0, 0), a corner", "Schur complements, chosen automatically: 1 explicit, 2 implicit"]
summary["parameters"]["Output"]["Fields"] = False  # saves the time for pictures
(noted / "summary.json").write_text(json.dumps(summary))
check("notes: suture_plot", plot(noted)[0], 0)
tree, _ = page_of("notes", noted)
check("notes: warnings", [entry.text for entry in tree.find(".//header/div[@id='warnings']").iter("li")],
      ["Contact 'touch': pressures alternate.", "The largest pressure is at (0, 0), a corner."])
check("notes: on the solver", [entry.text for entry in tree.find(".//section[@id='convergence']").iter("li")],
      ["Schur complements, chosen automatically: 1 explicit, 2 implicit."])

summary["notes"] = [f"contact {k}: something" for k in range(30)]
(noted / "summary.json").write_text(json.dumps(summary))
plot(noted)
tree, _ = page_of("many notes", noted)
box = tree.find(".//div[@id='warnings']")
check("many notes: all are there, eight at once", (len(list(box.iter("li"))), len(box.find("ul")), box.find("strong").text), (30, 8, "30 warnings"))

# Safety factors only if the run has them; one below 1 is marked.
check("no safety factors", tree.find(".//table[@id='safety_factors']"), None)
summary["safety"] = {"stresses": "recovered at nodes", "least": 0.75, "body": "lower", "bodies": {
    "lower": {"factor": 0.75, "material": "steel", "criterion": "Von Mises", "place": [1.5, -2.0], "principal_stresses": [3.0, 1.0, 0.0], "unit": "MPa"},
    "upper": {"factor": 2.5, "material": "steel", "criterion": "Von Mises", "place": [0.5, 2.0], "principal_stresses": [1.0, 0.5, 0.0], "unit": "MPa"},
    "pad": {"factor": None, "material": "rubber", "criterion": None, "place": None, "principal_stresses": None, "unit": "MPa"}}}
summary["rigid_groups"] = {"platen": {"point": [1.5, 3.0], "displacement": [4e-17, -0.25], "rotation": [0.125]}}
(noted / "summary.json").write_text(json.dumps(summary))
check("safety: suture_plot", plot(noted)[0], 0)
tree, _ = page_of("safety", noted)
lines = tree.find(".//section[@id='answers']//table[@id='safety_factors']").find("tbody").findall("tr")
check("safety: factors and places", [numbers(line) for line in lines], [[0.75, 1.5, -2.0], [2.5, 0.5, 2.0], []])
rigid = tree.find(".//section[@id='answers']//table[@id='rigid_groups']").find("tbody").findall("tr")
check("rigid groups: point, displacement without round-off, rotation", [numbers(line) for line in rigid], [[1.5, 3.0, 0.0, -0.25, 0.125]])
check("safety: exceeded", [line.find(".//span").get("class") for line in lines], ["fails", "holds", "soft"])
check("safety: the answer is not valid there", "not valid there" in "".join(lines[0].itertext()), True)

# A bound of the error, strict or estimated, in the answers and among the errors.
check("without a bound", (tree.find(".//p[@id='bound_sentence']"), tree.find(".//section[@id='accuracy']")), (None, None))
TOTAL, REASON = "total, energy norm: ", "sides of contact 'touch' do not match"
for strict in (True, False):
    summary["bound"] = {"total": 12.5, "discretisation": 12.0, "algebraic": 3.5, "oscillation": 0.25, "relative": 0.00871, "strict": strict,
                        "reasons": [] if strict else [REASON], "energy_lower": -401.0, "energy_upper": -400.0}
    (noted / "summary.json").write_text(json.dumps(summary))
    check(f"bound, strict {strict}: suture_plot", plot(noted)[0], 0)
    tree, _ = page_of(f"bound, strict {strict}", noted)
    check(f"bound, strict {strict}: rows", (row(tree, "error", TOTAL + ("strict bound" if strict else "estimate")), row(tree, "error", "\u2003of it: mesh"),
                                            row(tree, "error", "\u2003of it: solver"), row(tree, "error", "exact energy lies between")),
          ([12.5, 0.00871], [12.0], [3.5], [-401.0, -400.0] if strict else None))
    answers = said(tree, "answers")
    # 0.871 % is above 0.87 %: the text of a bound is rounded up, that of an estimate to the nearest.
    check(f"bound, strict {strict}: in the answers", ("at most 0.88 %" in answers, "about 0.87 %" in answers, REASON in answers), (strict, not strict, not strict))

# An adaptive run: its picture, a sentence and a table of its meshes.
MESHES = [(1000, 0.2, True, 0.5), (2000, 0.1, False, 1.0), (4000, 0.05, True, 2.0), (8000, 0.025, True, 4.0), (16000, 0.0125, True, 8.0)]
adaptive = {"requested": 0.013, "quantity": "Energy", "reached": 0.0125, "strict": True, "limit": "", "uniform": {"order": 2, "unknowns": 163270, "seconds": 9000},
            "levels": [{"unknowns": n, "elements": n // 4, "error": error, "strict": strict, "seconds": seconds, "iterations": 17, "outer": 2, "energy": -400.5,
                        "refinement": "bisection" if n > 1000 else "start"} for n, error, strict, seconds in MESHES]}


def adapted(name, **changes):
    """Page and sentence of the planted run with changes of its key `accuracy`."""
    summary["accuracy"] = {**adaptive, **changes}
    (noted / "summary.json").write_text(json.dumps(summary))
    check(f"{name}: suture_plot", plot(noted)[0], 0)
    page = page_of(name, noted)[0]
    return page, "".join(page.find(".//p[@id='accuracy_sentence']").itertext())


tree, words = adapted("adaptive")
check("adaptive: sentence", words, "The energy error is at most 1.3 %, reached with 16,000 unknowns on the last of 5 meshes, in 16 s altogether. A uniform mesh "
      "of second order would need about 160,000 unknowns and 2.5 hours for the same error (predicted).")
check("adaptive: the same in the answers", words in said(tree, "answers"), True)
lines = tree.find(".//section[@id='accuracy']//table[@id='levels']").find("tbody").findall("tr")
check("adaptive: one row per mesh", [(numbers(line), "strict bound" in "".join(line.itertext())) for line in lines],
      [([place + 1, n // 4, n, error, 2, 17, seconds], strict) for place, (n, error, strict, seconds) in enumerate(MESHES)])
from suture_plot_parts.accuracy import accuracy_figure, rounded_up  # noqa: E402
from suture_plot_parts.run import RunFolder  # noqa: E402


def points(axis, **look):
    """Points of the markers of an axis with a label or an id."""
    return [list(zip(*(map(float, values) for values in line.get_data()))) for line in axis.lines
            if all(getattr(line, f"get_{key}")() == value for key, value in look.items())]


drawn = accuracy_figure(RunFolder(noted))
spent = [0.5, 1.5, 3.5, 7.5, 15.5]
for axis, cost, uniform in zip(drawn.axes, ([n for n, *_ in MESHES], spent), (163270.0, 9000.0)):
    check(f"adaptive, up to {cost[-1]}: strict bounds are filled", points(axis, label="upper bound (strict)"),
          [[(x, error) for x, (_, error, strict, _) in zip(cost, MESHES) if strict]])
    check(f"adaptive, up to {cost[-1]}: estimates are hollow", points(axis, label="estimate"), [[(cost[1], 0.1)]])
    check(f"adaptive, up to {cost[-1]}: uniform refinement", points(axis, gid="uniform"), [[(uniform, 0.0125)]])
    check(f"adaptive, up to {cost[-1]}: the request", [{y for _, y in line} for line in points(axis, label="requested: 1.3 %")], [{0.013}])
(corners,) = points(drawn.axes[0], gid="rate")  # errors halve where unknowns double: rate 1
check("adaptive: rate", (corners[0][1] / corners[1][1]) / (corners[1][0] / corners[0][0]), lambda ratio: abs(ratio - 1.0) < 1e-9)
check("adaptive: a bound is never rounded down", [value for value in (0.00871, 0.0087, 0.1, 0.99999, 1e-7, 0.0123456, 3.0) for digits in (1, 2, 3)
                                                  if not value * (1 - 1e-9) <= rounded_up(value, digits) <= value * (1 + 2 * 10.0**(1 - digits))], [])

# Estimates beside the bounds, and a second mesh that is a uniform refinement.
measured = [{**level, "estimate": level["error"] / 2, "refinement": "uniform" if place == 1 else level["refinement"]}
            for place, level in enumerate(adaptive["levels"])]
tree, _ = adapted("measured", levels=measured)
for axis, cost in zip(accuracy_figure(RunFolder(noted)).axes, ([1000.0, 2000.0], [0.5, 1.0])):
    check(f"measured, up to {cost[-1]}: uniform meshes that were solved", points(axis, gid="measured"), [list(zip(cost, (0.2, 0.1)))])
    check(f"measured, up to {cost[-1]}: estimates", [[y for _, y in line] for line in points(axis, gid="recovered")], [[error / 2 for _, error, *_ in MESHES]])
# Values of another quantity, one per mesh.
valued = [{**level, "value": 100.0 + place, "energy_error": 4 * level["error"], "strict": False} for place, level in enumerate(adaptive["levels"])]
tree, _ = adapted("valued", levels=valued, quantity="the force of contact 'touch'", strict=False)
lines = tree.find(".//section[@id='accuracy']//table[@id='levels']").find("tbody").findall("tr")
check("valued: values and errors in the table", [numbers(line) for line in lines],
      [[place + 1, n // 4, n, 100.0 + place, error, 4 * error, 2, 17, seconds] for place, (n, error, _, seconds) in enumerate(MESHES)])
for name, changes, expected in (
        ("stopped", {"limit": "unknowns", "requested": 0.001, "uniform": None}, "The requested 0.1 % was not reached: the run ended at its largest number of unknowns."),
        ("of a force", {"quantity": "the force of contact 'touch'", "strict": False}, "The error of the force of contact 'touch' is about 1.2 % (an estimate)"),
        ("one mesh", {"levels": adaptive["levels"][:1], "reached": 0.2}, "at most 20 %, reached with 1,000 unknowns on the first mesh, in 0.5 s."),
        ("error unknown", {"levels": [{"unknowns": 10, "error": None}], "reached": None}, "The energy error is not known.")):
    _, words = adapted(f"adaptive, {name}", **changes)
    check(f"adaptive, {name}: sentence", words, lambda found, expected=expected: expected in found)
check("adaptive: the picture", (noted / "accuracy.png").is_file(), True)

# A valid solution with a larger error than requested, exit code 4: its answers are given, under a banner that states it.
summary["exit_code"] = 4
tree, words = adapted("too coarse", limit="levels", requested=0.001)
banner = tree.find(".//div[@id='banner']")
check("too coarse: banner", (banner.get("class"), "accuracy was not reached" in "".join(banner.itertext()), words in "".join(banner.itertext())),
      ("verdict coarse", True, True))
check("too coarse: the answers are given", ("largest von Mises stress" in said(tree, "answers"), tree.find(".//section[@id='state']")), (True, None))
check("too coarse: stated in the pictures", "ACCURACY NOT\u00a0REACHED" in accuracy_figure(RunFolder(noted))._suptitle.get_text().replace("\n", " "), True)
summary["exit_code"] = 0
del summary["accuracy"]
(noted / "summary.json").write_text(json.dumps(summary))
check("an earlier adaptive run: suture_plot", plot(noted)[0], 0)
check("an earlier adaptive run: its picture is removed", (noted / "accuracy.png").exists(), False)

# A run that did not converge, and one whose solution is not unique.
for name, scene, more in (("not_converged", scenes / "pin" / "pin.xml", setting("Outer Solver/Maximum Iterations", "1")),
                          ("not_determined", Path(__file__).with_name("loose_block.xml"), [])):
    folder, summary = solved(name, scene, 4, *more)
    check(f"{name}: suture_plot", plot(folder)[0], 0)
    tree, drawn = page_of(name, folder)
    banner = tree.find(".//div[@id='banner']")
    check(f"{name}: the failure is reported", (banner.get("class"), summary["failure"][1:] in "".join(banner.itertext())), ("verdict bad", True))
    check(f"{name}: the verdict comes before all else", [child.get("id") for child in tree.find(".//header") if child.get("id")][:2], ["fields", "banner"])
    same_numbers(name, tree, summary)
    # What the user gave is stated; a result is not, and numbers and pictures of the state are marked as none.
    given = summary["parameters"]
    answers = said(tree, "answers")
    check(f"{name}: loads, supports and contacts", [word for word in (*given["Boundary Conditions"], *given["Contact"]) if word not in answers], [])
    check(f"{name}: no answers", (numbers(tree.find(".//section[@id='answers']")), tree.find(".//p[@id='error_sentence']")), ([], None))
    for section in tree.iter("section"):
        results = section.get("id") in ("state", "view", "deformation", "von_mises", "principal", "contact")
        check(f"{name}: {section.get('id')} is marked", "invalid" in (section.get("class") or ""), results)
    check(f"{name}: extremes are in the marked section", tree.find(".//section[@id='state']//div[@id='extreme_von_mises']") is not None, True)

# Without fields: a report without their pictures; fields of an earlier run in the same folder are not used.
folder, summary = solved("linear_square", scenes / "linear_square" / "linear_square.xml", 0, *setting("Output/Fields", "false"))
code, text = plot(folder, "--output", options.work / "elsewhere")
check("without fields: suture_plot", (code, "wrote no fields" in text), (0, True))
tree, drawn = page_of("without fields", options.work / "elsewhere")
check("without fields: pictures", drawn, 0)
same_numbers("without fields", tree, summary)

# Long names, names with markup characters, and nulls for non-finite values.
strange = options.work / "strange"
shutil.copytree(options.work / "not_determined", strange)
summary = json.loads((strange / "summary.json").read_text())
summary["title"] = "<script>alert(1)</script> & \"quotes\" \x01 " + "name_without_an_end_" * 12
summary["verification"]["forces"]["value"] = None
summary["extremes"]["pressure"] = None
for key in ("contacts", "conditions"):
    summary["reactions"][key] = {f"{name} {'long ' * 40}": of for name, of in summary["reactions"][key].items()}
parameters = summary["parameters"]
parameters["Contact"] = {f"{name} {'long ' * 40}": of for name, of in parameters["Contact"].items()}
parameters["Output"]["Fields"] = False  # pictures of long names: picture_labels.py
parameters["Boundary Conditions"]["unknown type <b>"] = {"Group": ["block_top"], "Type": "Magnet", "Value": [1.0]}
(strange / "summary.json").write_text(json.dumps(summary))
check("strange names: suture_plot", plot(strange)[0], 0)
tree, _ = page_of("strange names", strange)
check("strange names: null is reported", "not finite" in said(tree, "verdict") and "FAILS" in said(tree, "verdict"), True)

# Clear errors.
good = (options.work / "not_determined" / "summary.json").read_text()
for name, text, words in (
        ("cut off", good[:len(good) // 2], "summary.json is damaged"), ("no object", "[1, 2]", "instead of an object with keys"),
        ("without a key", json.dumps({k: v for k, v in json.loads(good).items() if k != "phases"}), "phases: missing"),
        ("a text for a number", good.replace('"exit_code": 4', '"exit_code": "four"'), 'exit_code: "four" instead of a whole number'),
        ("a list for an object", json.dumps({**json.loads(good), "reactions": []}), "reactions: [] instead of an object with keys"),
        ("with levels that are no list", json.dumps({**json.loads(good), "accuracy": {"levels": {}}}), "accuracy.levels: {} instead of a list"),
        ("with a level without unknowns", json.dumps({**json.loads(good), "accuracy": {"levels": [{"error": 1}]}}), "accuracy.levels.0.unknowns: missing"),
        ("of another mesh", json.dumps({**json.loads(good), "mesh_hash": "0123"}), "of another mesh")):
    folder = options.work / "damaged"
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(options.work / "not_determined", folder)
    (folder / "summary.json").write_text(text)
    code, said_ = plot(folder)
    check(f"summary {name}", (code, words in said_, "Traceback" in said_), (3, True, False))
empty = options.work / "empty"
empty.mkdir()
code, text = plot(empty)
check("a folder that is not a run", (code, "has no summary.json" in text), (3, True))
(empty / "study.json").write_text("{}")
code, text = plot(empty)
check("a folder of a study that is damaged", (code, "has no study.json of suture_study, or it is damaged" in text, "Traceback" in text), (3, True, False))
(empty / "study.json").rename(empty / "summary.previous.json")
code, text = plot(empty)
check("a folder whose last run did not finish", (code, "did not finish" in text), (3, True))

# Studies with failed runs: one with known columns, one without any.
study = options.work / "study"
study.mkdir()
cells = {("small", "None"): [4.0, 19.0], ("small", "Kernels"): [4.0, 9.0], ("large", "None"): [None, None], ("large", "Kernels"): [16.0, 15.0]}
rows = [{"labels": list(labels), "cells": found, "exit_code": 4 if labels[1] == "None" else 0, "failure": "did <not> converge" if labels[1] == "None" else ""}
        for labels, found in cells.items()]
plots = [{"name": name, "x": x, "y": ["pcg"], "by": ["space"], "logarithmic_x": True, "logarithmic_y": True, "pareto": False}
         for name, x in (("by sweep", "size"), ("by column", "subdomains"))]
planted = {"title": "Failures", "columns": ["subdomains", "pcg"], "rows": rows, "plots": plots,
           "sweeps": [{"name": "size", "labels": ["small", "large"]}, {"name": "space", "labels": ["None", "Kernels"]}]}
(study / "study.json").write_text(json.dumps(planted))
from suture_plot_parts.study import Table, study_figure  # noqa: E402

for plotted, crosses, words in ((plots[0], 2, "no solution: 2 of 4 runs"), (plots[1], 1, "no solution: 2 of 4 runs\n(1 of unknown subdomains)")):
    panel = study_figure(Table(study / "study.json"), plotted).axes[0]
    check(f"study {plotted['name']}: crosses", sum(line.get_gid() == "failed" for line in panel.lines), crosses)
    check(f"study {plotted['name']}: legend", words in [text.get_text() for text in panel.get_legend().get_texts()], True)


def numbers(axis):
    """Numbers shown at an axis within its limits."""
    low, high = axis.get_view_interval()
    return [tick.label1.get_text() for tick in axis.get_major_ticks() if tick.label1.get_text() and low <= tick.get_loc() <= high]


# A logarithmic axis has numbers even if it contains no power of ten.
for least, most in ((2, 9), (2, 60), (2, 900), (101, 109), (15, 17), (0.003, 0.005)):
    ramp = [least * (most / least)**(i / 11) for i in range(12)]
    (study / "ramp.json").write_text(json.dumps({**planted, "sweeps": [], "columns": ["x", "y"], "rows": [
        {"labels": [], "cells": [value, value], "exit_code": 0, "failure": ""} for value in ramp]}))
    figure = study_figure(Table(study / "ramp.json"), {**plots[1], "x": "x", "y": ["y"], "by": []})
    figure.canvas.draw()
    for name, axis in (("x", figure.axes[0].xaxis), ("y", figure.axes[0].yaxis)):
        check(f"study, {name} from {least} to {most}: numbers at the axis", numbers(axis), lambda found: len(found) >= 3)
code, text = plot(study, "--factor", "2")
check("study: an option for runs", (code, "--factor is for runs" in text), (2, True))
code, text = plot(study)
check("study: suture_plot", (code, sorted(path.name for path in study.glob("*.png"))), (0, ["by_column.png", "by_sweep.png"]))
tree = ElementTree.fromstring((study / "report.html").read_text(encoding="utf-8").split("\n", 1)[1])
marked = ["".join(line.itertext()) for line in tree.iter("tr") if any(span.get("class") == "fails" for span in line.iter("span"))]
check("study: failed runs are marked in the table", (len(marked), all("did <not> converge" in text for text in marked)), (2, True))
for row_ in planted["rows"]:
    row_["exit_code"] = 4
(study / "study.json").write_text(json.dumps(planted))
code, text = forked(Path(options.plot).with_name("suture_study_plot"), study)
check("study without any solution", (code, "no run has converged" in text, "Traceback" in text), (3, True, False))
finish()
