#!/usr/bin/python3
"""report.html of runs with a bound of their error, and of adaptive runs: sentences, tables and accuracy.png.

    report_accuracy.py --solve suture_solve --plot suture_plot --input DIR --work DIR --mpirun "..."
"""
import json
import sys
from pathlib import Path

from harness import arguments, check, finish, setting
from report_page import numbers, page_of, plot, row, said, solved

options = arguments("--solve", "--plot", "--input")
sys.path.insert(0, str(Path(options.plot).resolve().parent))
from suture_plot_parts.accuracy import accuracy_figure, rounded_up  # noqa: E402
from suture_plot_parts.run import RunFolder  # noqa: E402

# Without fields, which saves the time for pictures.
noted, summary = solved("noted", Path(options.input) / "cattaneo" / "cattaneo.xml", 0, *setting("Output/Fields", "false"))
check("without a bound: suture_plot", plot(noted)[0], 0)
tree, _ = page_of("without a bound", noted)

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
finish()
