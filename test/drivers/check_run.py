#!/usr/bin/python3
"""Runs suture_solve on a scene and checks exit code, messages and figures.

    check_run.py CASES.json CASE --solve build/drivers/suture_solve --work FOLDER [--ranks N] [--mpirun "mpirun --oversubscribe"]
                 [--references FOLDER]

A file of cases is either one case (the expected.json next to a scene; CASE is then "-") or {"defaults": {...}, "cases": {name: {...}}}.
Entries of a case (all except "scene" have a default; arguments from the table's defaults come first):

    from        an expected.json, relative to the file of cases, from which the case is read
    scene       the scene file, relative to the file of cases; or "scene_path", passed unchanged to the program, except that {work} is replaced
    edit        [[old, new], ...]: replacements in a copy of the scene; each must be found; the geometry is copied, too
    arguments   of suture_solve; {work} is the test's folder (emptied first), {scenes} the scene's folder
    files       {name: text}: files written to {work} before the run
    exit_code   expected exit code (0)
    timeout     seconds (100)
    message     texts that must occur in the output;  "never": texts that must not;  "once": texts that must occur exactly once
    against     arguments of a second run on one rank, for the figures difference.*; with --references such runs are made once and
                shared: empty that folder when the program changes (ctest does so before its first test)
    checks      [{"key" or "figure": ..., and "value" with "relative" or "absolute" (neither: exactly), or "min" and "max", "source": ...}]

A check may also have "today": the value found when the check was written, from which the result may differ only by "drift" (relative, 1e-6).
"options" are arguments of the figure. With "of", in test/validation/validate.py, the reference is the run of another case of the table: its
value multiplied by "times", or the figure compares the two runs.

A "key" is a dotted path into summary.json, norm(path) of a vector, abs(path), or a sum of these joined by " + ". A "figure" is a function
of test/validation/figures.py that reads the fields of the run.
"""
import argparse
import contextlib
import fcntl
import glob
import hashlib
import json
import math
import os
import re
import shutil
import signal
import subprocess
import sys
import time

import sentences

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "validation"))


DRIFT = 1e-6  # relative: above the effect of solver tolerances and number of ranks, far below any discretisation error


def lookUp(summary, path):
    value = summary
    for name in path.split("."):
        value = value[int(name)] if isinstance(value, list) else value[name]
    return value


def evaluate(summary, key):
    """Value of a key: figures of the summary, added and subtracted."""
    total, sign = None, 1
    for term in re.split(r" ([+-]) ", key):
        if term in "+-":
            sign = 1 if term == "+" else -1
            continue
        function, path = re.fullmatch(r"(?:(norm|abs)\()?([^()]+?)\)?", term.strip()).groups()
        value = lookUp(summary, path)
        if function == "norm":
            value = math.sqrt(sum(x * x for x in value))
        elif function == "abs":
            value = abs(value)
        total = value if total is None else total + sign * value
    return total


def judge(check, value):
    """Empty if the value passes, else the reason for failure."""
    wrong = []
    if isinstance(value, float) and not math.isfinite(value):
        return "is not finite"
    if "value" in check:
        expected = check["value"]
        if "relative" in check or "absolute" in check:
            band = check.get("relative", 0.0) * abs(expected) + check.get("absolute", 0.0)
            if not abs(value - expected) <= band:
                wrong.append(f"expected {expected:.8g} +- {band:.2g}")
        elif value != expected:
            wrong.append(f"expected {expected!r}")
    if "min" in check and not value >= check["min"]:
        wrong.append(f"expected at least {check['min']:.8g}")
    if "max" in check and not value <= check["max"]:
        wrong.append(f"expected at most {check['max']:.8g}")
    if "today" in check and not abs(value - check["today"]) <= check.get("drift", DRIFT) * abs(check["today"]):
        wrong.append(f"drifted from {check['today']:.10g}")
    if not any(k in check for k in ("value", "min", "max")):
        wrong.append("the check has no reference")
    return ", ".join(wrong)


def run(command, timeout):
    """Output (both streams) and exit code; the code is None after a timeout."""
    process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                               errors="replace", start_new_session=True)
    try:
        output, _ = process.communicate(timeout=timeout * float(os.environ.get("SUTURE_TIME_FACTOR", 1)))
        return output, process.returncode
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGTERM)  # the session started above: mpirun and its ranks
        try:
            output, _ = process.communicate(timeout=5)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            output, _ = process.communicate()
        return output, None


def editedScene(scene, edits, work):
    """Copies the scene and the mesh files next to it into `work`, with replacements."""
    with open(scene) as file:
        text = file.read()
    for old, new in edits:
        if old not in text:
            sys.exit(f"check_run: the scene has no '{old}' to replace: the case is out of date")
        text = text.replace(old, new)
    for pattern in ("*.geo", "*.msh", "*.h5"):
        for name in glob.glob(os.path.join(os.path.dirname(scene), pattern)):
            shutil.copy(name, work)
    copy = os.path.join(work, os.path.basename(scene))
    with open(copy, "w") as file:
        file.write(text)
    return copy


@contextlib.contextmanager
def shared(references, scene, arguments):
    """Folder of a shared reference run, locked by one test at a time. A run writes summary.json last."""
    with open(scene, "rb") as file:
        name = hashlib.sha1(b"\0".join([file.read(), *(a.encode() for a in arguments)])).hexdigest()[:16]
    os.makedirs(references, exist_ok=True)
    with open(os.path.join(references, name + ".lock"), "w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield os.path.join(references, name)


def caseOf(table, name, folder="."):
    """A case of a table, with the table's defaults; `folder` contains the table."""
    defaults, own = table.get("defaults", {}), table["cases"][name]
    if "from" in own:
        path = os.path.join(folder, own["from"])
        with open(path) as file:
            case = json.load(file)
        return {**case, **own, "scene": os.path.join(os.path.dirname(own["from"]), case["scene"])}
    return {**defaults, **own, "arguments": defaults.get("arguments", []) + own.get("arguments", [])}


def perform(case, folder, work, program, ranks=1, references=None, others=None):
    """Runs a case and checks it. Returns a dictionary: "failures" (texts), "checks" ({"check", "value", "wrong"} of each), "summary",
    "output" (folder of the run), "seconds" (of the run as a whole).

    folder      base of the relative path "scene"
    work        folder for the run; emptied first
    program     command line without the scene, as a function of the number of ranks
    references  folder of shared runs for "against"
    others      {case: result of perform()}, for checks with "of"
    """
    work = os.path.abspath(work)
    shutil.rmtree(work, ignore_errors=True)
    os.makedirs(work)

    scene = os.path.normpath(os.path.join(folder, case["scene"]))

    def fill(text):
        return text.replace("{work}", work).replace("{scenes}", os.path.dirname(scene))

    for name, text in case.get("files", {}).items():
        with open(os.path.join(work, name), "w") as file:
            file.write(text)
    if "scene_path" in case:
        scene = fill(case["scene_path"])
    if "edit" in case:
        scene = editedScene(scene, [[fill(a), fill(b)] for a, b in case["edit"]], work)

    def solve(ranks, arguments, output):
        command = program(ranks) + [scene]
        if "--output" not in arguments:
            command += ["--output", output]
        command += [fill(a) for a in arguments]
        print("$", " ".join(f"'{c}'" if " " in c else c for c in command), flush=True)
        text, code = run(command, case.get("timeout", 100))
        print(text, flush=True)
        return text, code

    failures = []
    output = os.path.join(work, "out")
    begin = time.monotonic()
    text, code = solve(ranks, case.get("arguments", []), output)
    outcome = {"failures": failures, "checks": [], "summary": {}, "output": output, "seconds": time.monotonic() - begin}
    expectedCode = case.get("exit_code", 0)
    if code != expectedCode:
        failures.append("no end within the time" if code is None else f"exit code {code}, expected {expectedCode}")
    failures += [f"a sentence has {fault}" for fault in sentences.faults(text)]
    for fragment in case.get("message", []):
        if fill(fragment) not in text:
            failures.append(f"the output does not say: {fill(fragment)}")
    for fragment in case.get("once", []):
        if text.count(fill(fragment)) != 1:
            failures.append(f"the output says {text.count(fill(fragment))} times instead of once: {fill(fragment)}")
    for fragment in case.get("never", []):
        if fill(fragment) in text:
            failures.append(f"the output says: {fill(fragment)}")

    reference = os.path.join(work, "reference")
    if "against" in case and not failures:
        with contextlib.ExitStack() as stack:
            if references:
                reference = stack.enter_context(shared(references, scene, [fill(a) for a in case["against"]]))
            if not os.path.exists(os.path.join(reference, "summary.json")):
                _, code = solve(1, case["against"], reference)
                if code != 0:
                    failures.append(f"the run to compare with returned {code}")

    if case.get("checks") and not failures:
        with open(os.path.join(output, "summary.json")) as file:
            outcome["summary"] = json.load(file)
        for check in case["checks"]:
            result = examine(check, outcome, reference, others or {})
            outcome["checks"].append(result)
            if result["wrong"]:
                failures.append(f"{nameOf(check)} = {result['shown']}: {result['wrong']}")
    return outcome


def nameOf(check):
    """The key or figure of a check, with its options."""
    options = ", ".join(f"{name} {value}" for name, value in check.get("options", {}).items())
    return (check.get("key") or check["figure"]) + (f" ({options})" if options else "")


def examine(check, outcome, reference, others):
    """Evaluates one check: the check with the value of "of" filled in, the value found, and the reason for failure."""
    value = None
    try:
        if "of" in check:
            other = others[check["of"]]
            reference = other["output"]
        if "key" in check:
            value = evaluate(outcome["summary"], check["key"])
            if "of" in check:
                check = {**check, "value": check.get("times", 1) * evaluate(other["summary"], check["key"])}
        else:
            import figures  # takes 0.2 s; only where needed

            value = figures.figure(check["figure"], outcome["output"], reference, **check.get("options", {}))
            if "of" in check and "times" in check:
                check = {**check, "value": check["times"] * figures.figure(check["figure"], reference, None, **check.get("options", {}))}
        wrong = judge(check, value)
    except (KeyError, IndexError, TypeError, ValueError, OSError) as error:
        wrong = f"cannot be evaluated: {error!r}"
    shown = f"{value:.9g}" if isinstance(value, float) else value
    print(f"{'FAIL' if wrong else ' ok '} {nameOf(check)} = {shown}" + (f"   {wrong}; source: {check.get('source', 'own')}" if wrong else ""))
    return {"check": check, "value": value, "shown": shown, "wrong": wrong}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("file")
    parser.add_argument("case")
    parser.add_argument("--solve", required=True)
    parser.add_argument("--work", required=True)
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--mpirun", default="mpirun --oversubscribe")
    parser.add_argument("--references")
    options = parser.parse_args()

    with open(options.file) as file:
        table = json.load(file)
    folder = os.path.dirname(os.path.abspath(options.file))
    case = table if options.case == "-" else caseOf(table, options.case, folder)

    def program(ranks):
        return options.mpirun.split() + ["-np", str(ranks), os.path.abspath(options.solve)]

    failures = perform(case, folder, options.work, program, options.ranks, options.references)["failures"]
    if failures:
        print("\n".join(["", f"{len(failures)} failed:"] + ["  " + f for f in failures]))
        sys.exit(1)
    print("passed")


if __name__ == "__main__":
    main()
