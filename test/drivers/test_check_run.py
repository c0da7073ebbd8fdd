#!/usr/bin/python3
"""check_run.py fails when it must: it runs a fake suture_solve with a known result."""
import glob
import json
import os
import subprocess
import sys
import tempfile

here = os.path.dirname(os.path.abspath(__file__))
FALSE_SOLVE = """#!/bin/sh
echo run >> "$(dirname "$0")/runs"
while [ $# -gt 0 ]; do [ "$1" = --output ] && out=$2; [ "$1" = --sleep ] && sleep 30; [ "$1" = --fail ] && { echo broken; exit 3; }; shift; done
mkdir -p "$out"; echo done
echo '{"contact": {"pairs": 89, "force": {"fault above": [3.0, 4.0]}}, "equilibrium": {"imbalance": NaN}}' > "$out/summary.json"
"""
FALSE_MPIRUN = """#!/bin/sh
shift 2  # -np N
exec "$@"
"""
GOOD = {"key": "contact.pairs", "value": 89}
CASES = {
    "passes": ({"checks": [GOOD, {"key": "norm(contact.force.fault above) + abs(contact.pairs)", "value": 94.0, "relative": 1e-12}]}, True),
    "wrong_value": ({"checks": [{"key": "contact.pairs", "value": 90}]}, False),
    "outside_band": ({"checks": [{"key": "norm(contact.force.fault above)", "value": 5.1, "relative": 0.01}]}, False),
    "above_max": ({"checks": [{"key": "contact.pairs", "max": 88}]}, False),
    "below_min": ({"checks": [{"key": "contact.pairs", "min": 90}]}, False),
    "missing_key": ({"checks": [{"key": "contact.pears", "value": 89}]}, False),
    "missing_figure": ({"checks": [{"figure": "no.such", "value": 89}]}, False),
    "not_a_number": ({"checks": [{"key": "equilibrium.imbalance", "max": 1e9}]}, False),
    "compares_nothing": ({"checks": [{"key": "contact.pairs"}]}, False),
    "as_before": ({"checks": [{"key": "contact.pairs", "value": 90, "relative": 0.1, "today": 89}]}, True),
    "drifted": ({"checks": [{"key": "contact.pairs", "value": 90, "relative": 0.1, "today": 89.001}]}, False),
    "drift_allowed": ({"checks": [{"key": "contact.pairs", "value": 90, "relative": 0.1, "today": 89.001, "drift": 1e-3}]}, True),
    "from_another_file": ({"from": "scene.expected.json"}, True),
    "from_another_file_arguments": ({"from": "scene.expected.json", "checks": [{"key": "contact.pairs", "value": 90}]}, False),
    "of_no_other_case": ({"checks": [{"key": "contact.pairs", "of": "passes"}]}, False),
    "exit_code_expected": ({"arguments": ["--fail"], "exit_code": 3, "message": ["broken"]}, True),
    "exit_code_unexpected": ({"arguments": ["--fail"]}, False),
    "message_missing": ({"message": ["solved"]}, False),
    "message_forbidden": ({"never": ["done"]}, False),
    "message_once": ({"once": ["done"]}, True),
    "message_not_once": ({"once": ["solved"]}, False),
    "edit_out_of_date": ({"edit": [["not there", ""]]}, False),
    "too_slow": ({"arguments": ["--sleep"], "timeout": 1}, False),
    "against": ({"against": ["--tight"], "checks": [GOOD]}, True),
    "against_again": ({"arguments": ["--loose"], "against": ["--tight"], "checks": [GOOD]}, True),
    "against_another": ({"against": ["--tighter"], "checks": [GOOD]}, True),
    "against_failing": ({"against": ["--fail"], "checks": [GOOD]}, False),
}
# With --references: how often the program runs, in this order.
SHARED = [("against", 2), ("against", 1), ("against_again", 1), ("against_another", 2)]

with tempfile.TemporaryDirectory() as folder:
    solve, mpirun, table = (os.path.join(folder, name) for name in ("solve", "mpirun", "cases.json"))
    for path, text in ((solve, FALSE_SOLVE), (mpirun, FALSE_MPIRUN)):
        with open(path, "w") as file:
            file.write(text)
        os.chmod(path, 0o755)
    open(os.path.join(folder, "scene.xml"), "w").close()
    with open(os.path.join(folder, "scene.expected.json"), "w") as file:
        json.dump({"scene": "scene.xml", "checks": [GOOD]}, file)
    with open(table, "w") as file:
        json.dump({"defaults": {"scene": "scene.xml"}, "cases": {name: case for name, (case, _) in CASES.items()}}, file)
    wrong = []

    def run(name, *words):
        """Exit code and output of check_run.py, and how often it ran the program."""
        runs = os.path.join(folder, "runs")
        open(runs, "w").close()
        command = [sys.executable, "-B", os.path.join(here, "check_run.py"), table, name, "--solve", solve, "--work",
                   os.path.join(folder, "work"), "--mpirun", mpirun, *words]
        result = subprocess.run(command, capture_output=True, text=True, timeout=50 * float(os.environ.get("SUTURE_TIME_FACTOR", 1)))
        with open(runs) as file:
            return result.returncode, result.stdout + result.stderr, len(file.readlines())

    for name, (_, passes) in CASES.items():
        code, text, _ = run(name)
        if (code == 0) != passes:
            wrong.append(f"{name}: returned {code}\n{text}")

    references = os.path.join(folder, "references")
    for name, expected in SHARED:
        code, text, count = run(name, "--references", references)
        if code != 0 or count != expected:
            wrong.append(f"{name} with shared references: returned {code}, {count} runs instead of {expected}\n{text}")
    # A reference run that failed or was stopped is repeated by every test that needs it.
    for name in ("against_failing", "against_failing"):
        code, text, count = run(name, "--references", references)
        if code == 0 or count != 2:
            wrong.append(f"{name} with shared references: returned {code}, {count} runs instead of 2\n{text}")
    for summary in glob.glob(os.path.join(references, "*", "summary.json")):
        os.remove(summary)
    code, text, count = run("against", "--references", references)
    if code != 0 or count != 2:
        wrong.append(f"unfinished reference: returned {code}, {count} runs instead of 2\n{text}")

    print("\n".join(wrong) or f"{len(CASES)} cases as expected, and references shared")
    sys.exit(bool(wrong))
