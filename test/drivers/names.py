"""Every registered strategy runs on the tunnel, and none is a duplicate: the iteration histories differ.

names.py --solve PROGRAM --schema PROGRAM --mpirun "mpirun ..." --work DIR --input FOLDER
"""
import csv
import itertools
import json
import pathlib
import re
import subprocess

from harness import arguments, failures, finish, run

options = arguments("--solve", "--schema", "--input")
OPEN = pathlib.Path(options.input) / "tunnel" / "tunnel_open.xml"

INTERFACE = ["--set", "Formulation=Contact On The Interface", "--set", "Outer Solver/Type=Active Set"]
BDDC = [*INTERFACE, "--set", "Preconditioner/Type=BDDC"]
# Parameters whose values are names in a registry, the settings they are tested with, and values that may agree to the last digit.
PARAMETERS = {
    "Outer Solver/Type": ([], set()),
    "Preconditioner/Type": ([], set()),
    # Subdomain interfaces lie within a body, and a body has one material: adjacent subdomains have equal Young's moduli.
    "Preconditioner/Neumann-Neumann/Weighting": ([], {frozenset({"Multiplicity", "Young"})}),
    "Preconditioner/Neumann-Neumann/Coarse Space": ([], set()),
    # Direct solvers: the same iterates up to round-off.
    "Preconditioner/Neumann-Neumann/Coarse Solver": ([], {frozenset({"CHOLMOD", "Amesos2"})}),
    "Preconditioner/BDDC/Weighting": (BDDC, {frozenset({"Multiplicity", "Young"})}),
    "Preconditioner/BDDC/Edge Constraints": (BDDC, set()),
    "Preconditioner/BDDC/Coarse Solver": (BDDC, {frozenset({"CHOLMOD", "Amesos2"})}),
    "Subdomain/Local Solver": ([], {frozenset({"CHOLMOD", "Amesos2"})}),
    # One matrix, stored in two ways.
    "Subdomain/Schur Complement": ([], {frozenset(two) for two in itertools.combinations(("Automatic", "Explicit", "Implicit"), 2)}),
}
EXTRA = {
    "Successive Approximation": ["--set", "Outer Solver/Tolerance=1e-4", "--set", "Outer Solver/Maximum Iterations=200"],
    "Active Set": ["--set", "Formulation=Contact On The Interface"],
}


def names_of(parameter):
    """Read from the schema, so that new strategies are tested automatically. Lists are recognised by indentation."""
    text = subprocess.run([options.schema, "--format", "text"], capture_output=True, text=True, check=True).stdout
    above = []
    for line in text.splitlines():
        indent = len(line) - len(line.lstrip())
        above = [(i, name) for i, name in above if i < indent] + [(indent, line.strip().split("  ")[0].rstrip(":/"))]
        if ("/" + "/".join(name for _, name in above)).endswith("/" + parameter):
            found = re.search(r"\(string, default [^,]*, (.*\|.*?)\)", line)
            return [name.strip() for name in found.group(1).split("|")] if found else []
    return []


for parameter, (settings, alike) in PARAMETERS.items():
    names = names_of(parameter)
    print(f"{parameter}: {names}")
    if len(names) < 2:
        failures.append(f"{parameter}: no names in the schema")
        continue
    histories = {}
    for name in names:
        folder = options.work / re.sub(r"\W", "_", parameter + "_" + name)
        code, text = run(options.solve, 2, OPEN, "--quiet", "--output", folder, *settings, "--set", f"{parameter}={name}", *EXTRA.get(name, []))
        if code != 0:
            failures.append(f"{parameter}={name}: exit code {code}\n{text}")
            continue
        closed = json.loads((folder / "summary.json").read_text())["contact"]["active"]
        if closed != 82:
            failures.append(f"{parameter}={name}: {closed} closed pairs, not 82")
        with open(folder / "history.csv") as file:
            histories[name] = [float(row["residual"]) for row in csv.DictReader(file)]
    for one, other in itertools.combinations(sorted(histories), 2):
        a, b = histories[one], histories[other]
        same = len(a) == len(b) and all(abs(x - y) <= 1e-3 * max(x, y) for x, y in zip(a[:2], b[:2]))
        if same != (frozenset({one, other}) in alike):
            failures.append(f"{parameter}: the histories of {one} and {other} are {'the same' if same else 'not the same'}: {a[:3]} {b[:3]}")

finish()
