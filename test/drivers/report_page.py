"""Common tools for the tests of report.html: pages of runs as trees, with the checks that hold for all of them; numbers against summary.json."""
import base64
import io
import json
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from html.parser import HTMLParser

import h5py  # noqa: F401, here and below: imported once for all forks
import harness
import matplotlib.pyplot  # noqa: F401
from harness import check, forked, run
from PIL import Image, ImageChops

SECTIONS = ["answers", "mesh", "deformation", "von_mises", "principal", "contact", "scene", "reactions", "verdict", "error", "convergence", "cost", "provenance"]
SOMETIMES = ["state", "view", "animation", "steps", "probes", "accuracy", "pieces", "path"]
EMPTY = {"area", "base", "br", "col", "embed", "hr", "img", "input", "link", "meta", "source", "track", "wbr"}


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
    return forked(harness.options.plot, folder, *more)


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
    folder = harness.options.work / name
    check(f"{name}: exit code of the run", run(harness.options.solve, 2, scene, "--output", folder, *more)[0], code)
    return folder, json.loads((folder / "summary.json").read_text())


def said(tree, section):
    return " ".join(tree.find(f".//section[@id='{section}']").itertext())
