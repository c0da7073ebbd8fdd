#!/usr/bin/python3
"""validate.py fails when it must: it runs a fake suture_solve whose result depends on a known step."""
import json
import os
import subprocess
import sys
import tempfile

here = os.path.dirname(os.path.abspath(__file__))
FALSE_SOLVE = """#!/usr/bin/python3
import json, os, sys
words = sys.argv[1:]
out = words[words.index("--output") + 1]
h = float(words[words.index("--step") + 1])
os.makedirs(out)
json.dump({"u": 2 + 3 * h * h, "dofs": 100}, open(os.path.join(out, "summary.json"), "w"))
"""
FALSE_MPIRUN = """#!/bin/sh
shift 2  # -np N
exec "$@"
"""


def case(h, **more):
    return {"size": h, "arguments": ["--step", str(h)], "checks": [{"key": "u", "value": 2.0, "absolute": 4 * h * h}], **more}


def table(order=1.9, **more):
    return {"title": "T", "source": "S", "defaults": {"scene": "scene.xml"},
            "cases": {"A": case(0.4, short=True), "B": case(0.2), "C": case(0.1), **more},
            "orders": [{"key": "u", "value": 2.0, "cases": ["A", "B", "C"], "min": order}]}


TABLES = {
    "passes": (table(), [], True),
    "order_too_low": (table(order=2.1), [], False),
    "order_not_wanted_when_short": (table(order=2.1), ["--short"], True),
    "wrong_value": (table(D=case(1, checks=[{"key": "u", "value": 2.0, "relative": 0.1}])), [], False),
    "of_another": (table(D=case(0.2, checks=[{"key": "u", "of": "B"}])), [], True),
    "of_another_times": (table(D=case(0.2, checks=[{"key": "u", "of": "B", "times": 1.01}])), [], False),
    "drifted": (table(D=case(1, checks=[{"key": "u", "min": 0.0, "today": 5.1}])), [], False),
    "nothing_short": ({**table(), "cases": {"B": case(0.2)}, "orders": []}, ["--short"], False),
    "no_such_folder": (table(), ["--only", "w"], False),
}

wrong = []
with tempfile.TemporaryDirectory() as folder:
    solve, mpirun, cases, output = (os.path.join(folder, name) for name in ("solve", "mpirun", "input/v1_test", "out"))
    os.makedirs(cases)
    for path, text in ((solve, FALSE_SOLVE), (mpirun, FALSE_MPIRUN)):
        with open(path, "w") as file:
            file.write(text)
        os.chmod(path, 0o755)
    open(os.path.join(cases, "scene.xml"), "w").close()
    checks = os.path.join(cases, "checks.json")

    def run(content, words):
        if content:
            with open(checks, "w") as file:
                json.dump(content, file)
        result = subprocess.run([sys.executable, "-B", os.path.join(here, "validate.py"), "--solve", solve, "--mpirun", mpirun, "--output", output,
                                 "--input", os.path.dirname(cases), *words], capture_output=True, text=True, timeout=60)
        return result.returncode, result.stdout + result.stderr

    for name, (content, words, passes) in TABLES.items():
        code, text = run(content, words)
        if (code == 0) != passes:
            wrong.append(f"{name}: returned {code}\n{text}")
    # The table from --record passes unchanged, and fails when the numbers change.
    banded = table(D=case(0.2, checks=[{"key": "u", "value": 2.0, "relative": 0.1}]))
    code, text = run(banded, ["--record"])
    with open(checks) as file:
        recorded = json.load(file)
    if code or recorded["cases"]["D"]["checks"][0].get("today") != 2.12 or recorded["orders"][0].get("today") != 2.0:
        wrong.append(f"record: returned {code}\n{text}\n{recorded}")
    for words, passes in (([], True), (["--only", "v1"], True)):
        code, text = run(None, words)
        if (code == 0) != passes:
            wrong.append(f"as recorded: returned {code}\n{text}")
    recorded["cases"]["D"]["arguments"] = ["--step", "0.21"]
    code, text = run(recorded, [])
    if code == 0:
        wrong.append(f"changed after recording: returned {code}\n{text}")
    with open(os.path.join(output, "validation.json")) as file:
        if json.load(file)["failed"] != 1 or "drifted" not in open(os.path.join(output, "validation.md")).read():
            wrong.append("the page does not report the drift")

    # The corpus: success, a scene that failed, a program that ends early, one that crashes after its table.
    corpora = {"well": ("family method\nall groups", 0, True), "lost": ("7 tray groups lost\n\nfamily method", 1, False),
               "silent": ("", 0, False), "crash": ("family method", 139, False)}
    for name, (printed, code, passes) in corpora.items():
        program = os.path.join(folder, name)
        with open(program, "w") as file:
            file.write(f"#!/bin/sh\necho '{printed}'\nexit {code}\n")
        os.chmod(program, 0o755)
        found, text = run(table(), ["--corpus", program, "--scenes", "3"])
        if (found == 0) != passes:
            wrong.append(f"corpus {name}: returned {found}\n{text}")

print("\n".join(wrong) or f"{len(TABLES)} tables as expected, and recorded")
sys.exit(bool(wrong))
