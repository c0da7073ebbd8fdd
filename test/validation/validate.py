#!/usr/bin/python3
"""Runs the validation cases of input/validation and writes validation.json and one page, validation.md, with pictures.

    validate.py --solve build/drivers/suture_solve --output FOLDER [--only v3_hertz,v7_punch] [--short] [--record]
                [--corpus build/bin/test_corpus] [--scenes 5000]

Every folder input/validation/<case>/ has a checks.json: a table of cases as test/drivers/check_run.py describes it, and more:

    title, source   subject of the validation, and origin of the reference
    cases           of check_run.py; besides: "short": true, also run with --short; "ranks" (2); "size", mesh size for orders (unknowns^-1/2);
                    "about", a short text for the page
    orders          [{"figure" or "key", "options", "cases": [names, coarse to fine], "value" (exact; 0), "min", "today", "source"}]:
                    the slope of log |found - exact| over log size, fitted through all the cases
    pictures        [{"file", "x": "x" or "y" or "arc", "runs": {label: case}, "curve": a function of pictures.py, "options"}]

--corpus also runs --scenes random scenes (corpus.py) on 1 and 2 ranks.
--short runs only the cases marked "short", each folder's smallest. --record writes the values found into checks.json as "today", for
checks with a tolerance, or with a "today", that passed their reference. Exit code: 0, or 1 if a check failed.
"""
import argparse
import contextlib
import datetime
import io
import json
import math
import os
import shutil
import sys
import time

here = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [here, os.path.join(here, "..", "drivers")]

import check_run  # noqa: E402
import corpus  # noqa: E402


def valueIn(run, wanted):
    """Value of a key or figure, also of one without a check."""
    if "key" in wanted:
        return check_run.evaluate(run["summary"], wanted["key"])
    import figures

    return figures.figure(wanted["figure"], run["output"], None, **wanted.get("options", {}))


def order(wanted, table, runs):
    """The fitted order of convergence, evaluated like a check."""
    names = wanted["cases"]
    exact = wanted.get("value", 0.0)
    points = []
    for name in names:
        size = table["cases"][name].get("size") or runs[name]["summary"]["dofs"] ** -0.5
        points.append((math.log(size), math.log(abs(valueIn(runs[name], wanted) - exact))))
    mx, my = (sum(p[i] for p in points) / len(points) for i in (0, 1))
    slope = sum((x - mx) * (y - my) for x, y in points) / sum((x - mx) ** 2 for x, _ in points)
    bounds = {k: wanted[k] for k in ("min", "max", "today", "drift") if k in wanted}
    return {"check": wanted, "value": float(f"{slope:.4g}"), "wrong": check_run.judge({"drift": 1e-3, **bounds}, slope),
            "errors": [math.exp(y) for _, y in points]}


def merge(path, runs, orders):
    """Writes the values found into the table: "today" of every check that compares with a reference to a tolerance."""
    with open(path) as file:
        table = json.load(file)

    def note(check, value):
        banded = check.get("relative", 0) > check_run.DRIFT or "today" in check or "drift" in check
        if isinstance(value, float) and banded and "of" not in check:
            check["today"] = float(f"{value:.10g}")

    for name, run in runs.items():
        for check, result in zip(table["cases"][name].get("checks", []), run["checks"]):
            if not result["wrong"] or "expected" not in result["wrong"]:
                note(check, result["value"])
    for wanted, result in zip(table.get("orders", []), orders):
        if result and result["value"] is not None and "expected" not in result["wrong"]:
            wanted["today"] = float(f"{result['value']:.4g}")
    lines = ["{"]
    for key, value in table.items():
        last = "," if key != list(table)[-1] else ""
        if key == "cases":
            lines.append('  "cases": {')
            for name, case in value.items():
                if "checks" not in case:
                    lines.append(f"    {json.dumps(name)}: {json.dumps(case)}" + ("," if name != list(value)[-1] else ""))
                    continue
                head = {k: v for k, v in case.items() if k != "checks"}
                lines.append(f'    {json.dumps(name)}: {json.dumps(head)[:-1]}{", " if head else ""}"checks": [')
                lines += ["      " + json.dumps(c) + ("," if c is not case["checks"][-1] else "") for c in case["checks"]]
                lines.append("    ]}" + ("," if name != list(value)[-1] else ""))
            lines.append("  }" + last)
        elif isinstance(value, list):
            lines.append(f"  {json.dumps(key)}: [")
            lines += ["    " + json.dumps(c) + ("," if c is not value[-1] else "") for c in value]
            lines.append("  ]" + last)
        else:
            lines.append(f"  {json.dumps(key)}: {json.dumps(value)}{last}")
    with open(path, "w") as file:
        file.write("\n".join(lines) + "\n}\n")


def number(value):
    if isinstance(value, bool) or value is None:
        return str(value)
    return f"{value:.7g}" if isinstance(value, float) else str(value)


def referenceText(check):
    """Reference and tolerance of a check."""
    bands = []
    if "value" in check:
        value, tolerance = number(check["value"]), ""
        if "relative" in check:
            relative = check["relative"]
            tolerance = f"{100 * relative:g} %" if relative >= 1e-5 else f"{relative:g}, relative"
        elif "absolute" in check:
            tolerance = f"{check['absolute']:g}"
        return value, tolerance or "equal"
    if "min" in check:
        bands.append(f"at least {number(check['min'])}")
    if "max" in check:
        bands.append(f"at most {number(check['max'])}")
    return "", ", ".join(bands)


def errorText(check, value):
    if not isinstance(value, (int, float)) or isinstance(value, bool) or not isinstance(check.get("value"), (int, float)):
        return ""
    if check["value"] == 0:
        return f"{abs(value):.2g}"
    error = value / check["value"] - 1
    return f"{100 * error:+.3f} %" if abs(error) >= 1e-7 else f"{error:+.1g}"


def rows(table):
    width = [max(len(row[i]) for row in table) for i in range(len(table[0]))]
    out = ["| " + " | ".join(cell.ljust(n) for cell, n in zip(row, width)) + " |" for row in table]
    return [out[0], "|" + "|".join("-" * (n + 2) for n in width) + "|", *out[1:]]


def section(folder, report, scenes):
    """Section of the page for one folder; `scenes`: path to the folder, relative to the page."""
    lines = [f"## {report['title']}", "", f"Reference: {report['source']} ([{folder}]({scenes}/{folder}/README.md))", ""]
    table = [["case", "figure", "value", "reference", "tolerance", "error", "unknowns", "ranks", "seconds", ""]]
    for name, run in report["cases"].items():
        first = True
        for check in run["checks"]:
            reference, tolerance = referenceText(check)
            table.append([name if first else "", check["name"], number(check["found"]), reference, tolerance, errorText(check, check["found"]),
                          f"{run['unknowns']:,}" if first and run["unknowns"] else "", str(run["ranks"]) if first else "",
                          f"{run['seconds']:.1f}" if first else "", "**failed**: " + check["wrong"] if check["wrong"] else "ok"])
            first = False
        if first:  # did not reach its checks
            table.append([name, "", "", "", "", "", "", str(run["ranks"]), f"{run['seconds']:.1f}", "**failed**: " + "; ".join(run["failures"])])
    lines += rows(table) + [""]
    if report["orders"]:
        table = [["order of the error of", "cases", "errors", "order", "wanted", ""]]
        for found in report["orders"]:
            table.append([found["name"], ", ".join(found["cases"]), ", ".join(f"{e:.3g}" for e in found["errors"]), number(found["order"]),
                          f"at least {found['min']:g}", "**failed**: " + found["wrong"] if found["wrong"] else "ok"])
        lines += rows(table) + [""]
    lines += [f"![{file}]({folder}/{file})" for file in report["pictures"]] + ([""] if report["pictures"] else [])
    return lines


def page(result, scenes):
    failed = result["failed"]
    lines = ["# Validation", "",
             f"{result['checks']} checks of {result['runs']} runs in {result['seconds']:.0f} s, {result['date']}, Suture {result['version']}: "
             + ("all passed." if not failed else f"**{failed} failed.**"), "",
             "Every check compares with a reference that does not come from Suture, except where it says own; a value that passes but differs by more "
             "than 1e-6 from what it was when the check was written fails as drifted. Seconds: wall time of the run, reading and writing included.", ""]
    table = [["", "runs", "checks", "failed", "orders fitted", "seconds", "largest, unknowns"]]
    for folder, report in result["folders"].items():
        cases, orders = report["cases"].values(), report["orders"]
        failed = sum(bool(c["wrong"]) for run in cases for c in run["checks"]) + sum(bool(o["wrong"]) for o in orders)
        table.append([f"[{folder}]({scenes}/{folder}/README.md)", str(len(cases)), str(sum(len(run["checks"]) for run in cases)),
                      str(failed or sum(bool(run["failures"]) for run in cases)), ", ".join(f"{o['order']:.2f}" for o in orders if o["order"]),
                      f"{sum(run['seconds'] for run in cases):.0f}", f"{max((run['unknowns'] or 0 for run in cases), default=0):,}"])
    lines += rows(table) + [""]
    for folder, report in result["folders"].items():
        lines += section(folder, report, scenes)
    if result["corpus"]:
        lines += corpus.section(result["corpus"])
    return "\n".join(lines)


def validate(folder, options, counter):
    """Runs all cases of one folder, prints one line each, and returns their entry of validation.json."""
    path = os.path.join(options.input, folder, "checks.json")
    with open(path) as file:
        table = json.load(file)
    names = [n for n, case in table["cases"].items() if case.get("short") or not options.short]
    runs, report = {}, {"title": table["title"], "source": table["source"], "cases": {}, "orders": [], "pictures": []}

    for name in names:
        case = check_run.caseOf(table, name, os.path.dirname(path))
        ranks = case.get("ranks", 2)
        counter["now"] += 1
        print(f"[{counter['now']:3}/{counter['all']}] {folder:18} {name:28}", end="", flush=True)
        log = io.StringIO()
        with contextlib.redirect_stdout(log):
            run = check_run.perform(case, os.path.join(options.input, folder), os.path.join(options.output, folder, name),
                                    lambda n: options.mpirun.split() + ["-np", str(n), os.path.abspath(options.solve)], ranks, None, runs)
        with open(os.path.join(options.output, folder, name, "log.txt"), "w") as file:
            file.write(log.getvalue())
        if not run["summary"] and os.path.exists(os.path.join(run["output"], "summary.json")):
            with open(os.path.join(run["output"], "summary.json")) as file:
                run["summary"] = json.load(file)
        runs[name] = run
        report["cases"][name] = {
            "about": case.get("about", ""), "ranks": ranks, "seconds": run["seconds"], "unknowns": run["summary"].get("dofs"),
            "phases": {k: v["max"] for k, v in run["summary"].get("phases", {}).items()}, "failures": run["failures"],
            "checks": [{"name": check_run.nameOf(r["check"]), **r["check"], "found": r["value"], "wrong": r["wrong"]} for r in run["checks"]]}
        good = f"{len(run['checks'])} checks passed" if run["checks"] else "nothing to check"
        print(f"{run['seconds']:7.1f} s   " + ("; ".join(run["failures"]) or good), flush=True)

    found = []
    for wanted in table.get("orders", []):
        if not all(n in runs for n in wanted["cases"]):
            found.append(None)
            continue
        try:
            result = order(wanted, table, runs)
        except (KeyError, OSError, ValueError) as error:
            result = {"value": None, "wrong": f"cannot be evaluated: {error!r}", "errors": []}
        found.append(result)
        name = check_run.nameOf(wanted)
        report["orders"].append({"name": name, "cases": wanted["cases"], "order": result["value"], "errors": result["errors"],
                                 "min": wanted["min"], "source": wanted.get("source", ""), "wrong": result["wrong"]})
        print(f"{'':9} {folder:18} order of {name}: {number(result['value'])}" + (f"   {result['wrong']}" if result["wrong"] else ""), flush=True)
    for picture in table.get("pictures", []):
        if all(n in runs and not runs[n]["failures"] for n in picture["runs"].values()):
            import pictures  # importing matplotlib takes a second

            pictures.draw(picture, runs, os.path.join(options.output, folder, picture["file"]))
            report["pictures"].append(picture["file"])
    if options.record:
        merge(path, runs, found)
    return report


def main():
    parser = argparse.ArgumentParser(description="Runs the validation cases; see the head of this file.")
    parser.add_argument("--solve", required=True)
    parser.add_argument("--output", required=True)
    parser.add_argument("--input", default=os.path.join(here, "..", "..", "input", "validation"))
    parser.add_argument("--mpirun", default="mpirun --oversubscribe")
    parser.add_argument("--only", help="folders, with commas between them; a beginning is enough")
    parser.add_argument("--short", action="store_true")
    parser.add_argument("--record", action="store_true")
    parser.add_argument("--corpus", help="the program test_corpus")
    parser.add_argument("--scenes", type=int, default=5000)
    options = parser.parse_args()
    options.input = os.path.abspath(options.input)

    folders = sorted((f for f in os.listdir(options.input) if os.path.exists(os.path.join(options.input, f, "checks.json"))),
                     key=lambda f: int("".join(c for c in f.split("_")[0] if c.isdigit()) or 0))
    if options.only:
        wanted = options.only.split(",")
        unknown = [w for w in wanted if not any(f.startswith(w) for f in folders)]
        if unknown:
            parser.error(f"no such folder: {', '.join(unknown)}; there are {', '.join(folders)}")
        folders = [f for f in folders if any(f == w or f.startswith(w) for w in wanted)]
    os.makedirs(options.output, exist_ok=True)
    for folder in folders:
        shutil.rmtree(os.path.join(options.output, folder), ignore_errors=True)

    count = 0
    for folder in folders:
        with open(os.path.join(options.input, folder, "checks.json")) as file:
            cases = json.load(file)["cases"].values()
        count += sum(1 for case in cases if case.get("short") or not options.short)
    counter = {"now": 0, "all": count}
    begin = time.monotonic()
    reports = {folder: validate(folder, options, counter) for folder in folders}

    failures = [f"{folder} {name}: {text}" for folder, r in reports.items() for name, run in r["cases"].items() for text in run["failures"]]
    random = corpus.run(os.path.abspath(options.corpus), options.scenes, options.mpirun, options.output) if options.corpus else []
    failures += [failure for result in random for failure in result["failures"]]
    failures += [f"{folder} order of {o['name']}: {o['wrong']}" for folder, r in reports.items() for o in r["orders"] if o["wrong"]]
    checks = sum(len(run["checks"]) for r in reports.values() for run in r["cases"].values()) + sum(len(r["orders"]) for r in reports.values())
    result = {"date": datetime.datetime.now(datetime.timezone.utc).isoformat(timespec="seconds"), "version": versionOf(options.output, reports),
              "seconds": time.monotonic() - begin, "runs": count, "checks": checks, "failed": len(failures), "failures": failures,
              "corpus": random, "folders": reports}
    with open(os.path.join(options.output, "validation.json"), "w") as file:
        json.dump(result, file, indent=1)
    with open(os.path.join(options.output, "validation.md"), "w") as file:
        file.write(page(result, os.path.relpath(options.input, options.output)))
    print(f"\n{checks} checks of {count} runs in {result['seconds']:.0f} s: "
          + ("all passed" if not failures else f"{len(failures)} failed:\n  " + "\n  ".join(failures)))
    print(os.path.join(options.output, "validation.json") + ", validation.md")
    sys.exit(bool(failures) or not checks)


def versionOf(output, reports):
    for folder, report in reports.items():
        for name in report["cases"]:
            path = os.path.join(output, folder, name, "out", "summary.json")
            if os.path.exists(path):
                with open(path) as file:
                    versions = json.load(file).get("versions", {"suture": "?", "commit": "?"})
                return f"{versions['suture']} ({versions['commit']})"
    return "?"


if __name__ == "__main__":
    main()
