#!/usr/bin/python3
"""report.html of suture_plot: complete, without network access, with the numbers of summary.json; clear errors for folders that are not runs.

    report.py --solve suture_solve --plot suture_plot --input DIR --work DIR --mpirun "..."
"""
import base64
import io
import json
import shutil
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

from harness import arguments, check, finish, forked, run, setting
from PIL import Image, ImageChops
from report_page import numbers, page_of, plot, row, said, same_answers, same_numbers, solved, started

options = arguments("--solve", "--plot", "--input")
scenes = Path(options.input)

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


def shown(axis):
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
        check(f"study, {name} from {least} to {most}: numbers at the axis", shown(axis), lambda found: len(found) >= 3)
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
