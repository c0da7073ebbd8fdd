#!/usr/bin/python3
"""check_run.py fails when it must: it is run on a false suture_solve whose answer is known."""
import json
import os
import subprocess
import sys
import tempfile

here = os.path.dirname(os.path.abspath(__file__))
FALSE_SOLVE = """#!/bin/sh
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
    "exit_code_expected": ({"arguments": ["--fail"], "exit_code": 3, "message": ["broken"]}, True),
    "exit_code_unexpected": ({"arguments": ["--fail"]}, False),
    "message_missing": ({"message": ["solved"]}, False),
    "message_forbidden": ({"never": ["done"]}, False),
    "message_once": ({"once": ["done"]}, True),
    "message_not_once": ({"once": ["solved"]}, False),
    "edit_out_of_date": ({"edit": [["not there", ""]]}, False),
    "too_slow": ({"arguments": ["--sleep"], "timeout": 1}, False),
}

with tempfile.TemporaryDirectory() as folder:
    solve, mpirun, table = (os.path.join(folder, name) for name in ("solve", "mpirun", "cases.json"))
    for path, text in ((solve, FALSE_SOLVE), (mpirun, FALSE_MPIRUN)):
        with open(path, "w") as file:
            file.write(text)
        os.chmod(path, 0o755)
    open(os.path.join(folder, "scene.xml"), "w").close()
    with open(table, "w") as file:
        json.dump({"defaults": {"scene": "scene.xml"}, "cases": {name: case for name, (case, _) in CASES.items()}}, file)
    wrong = []
    for name, (_, passes) in CASES.items():
        command = [sys.executable, "-B", os.path.join(here, "check_run.py"), table, name, "--solve", solve, "--work",
                   os.path.join(folder, "work"), "--mpirun", mpirun]
        result = subprocess.run(command, capture_output=True, text=True, timeout=50)
        if (result.returncode == 0) != passes:
            wrong.append(f"{name}: returned {result.returncode}\n{result.stdout}{result.stderr}")
    print("\n".join(wrong) or f"{len(CASES)} cases as expected")
    sys.exit(bool(wrong))
