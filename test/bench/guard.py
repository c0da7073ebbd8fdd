"""Counts instead of seconds: iterations, instructions and allocations, compared with a file. A busy machine does not change them."""
import json
import re
import shutil
from pathlib import Path

from runs import ROOT, command_of, configurations, execute, fail, has_mesh, measure, mesh_of

SIZES = ["10k", "100k"]
COUNT = 2  # allowed difference of iterations
INSTRUCTIONS = 1.03
CELLS = (48, 384)
ALLOCATIONS, VIEWS = 1.1, 512  # of the smaller problem's bytes, and bytes: a vector of the larger one has 40,000
SQUARE = ("input/studies/square.xml", ["square"], "Outer Solver/Tolerance")
GROUPS = ("input/long_contact/long_contact.xml", ["upper", "lower"], "Outer Solver/Semismooth Newton/Inner Tolerance")
COUNTED = {  # scene, boxes, tolerance of the linear problem; settings
    "BDDC": (*SQUARE, []),
    "coarse level": (*SQUARE, ["Preconditioner/BDDC/Coarse Level Above=1", "Preconditioner/BDDC/Coarse Clusters=4"]),
    "Neumann-Neumann": (*SQUARE, ["Preconditioner/Type=Neumann-Neumann"]),
    "implicit": (*SQUARE, ["Subdomain/Schur Complement=Implicit"]),
    "contact groups": (*GROUPS, ["Formulation=Condensed Groups", "Outer Solver/Type=Semismooth Newton", "Outer Solver/Start=Bilateral",
                                 "Outer Solver/Maximum Iterations=0", "Partition/Type=Named Groups", "Partition/Named Groups/Pattern=subdomain_*"]),
}


def counts_now(options):
    """Iterations of every scene on one and two ranks, with the number of elements."""
    runs = {name: run for name, run in configurations().items() if name.startswith("suture")}
    counts = {}
    for scene in options.scenes:
        for size in (size for size in options.sizes if has_mesh(scene, size)):
            mesh = mesh_of(scene, size, options)
            for name, run in runs.items():
                result = measure(name, run, scene, size, mesh, options)
                counts[f"{scene}/{size}/{name}"] = {"elements": result["elements"], **result["counts"]}
    return counts


def instructions_now(options):
    """Instructions of one small run within solveScene (loading libraries would double them), by callgrind; None without valgrind."""
    if not shutil.which("valgrind"):
        return None
    mesh = mesh_of("tunnel", "10k", options)
    command = command_of({"ranks": 1, "set": []}, "tunnel", mesh, options.output / "runs" / "callgrind", options)
    kernels = {"OPENBLAS_CORETYPE": "Haswell"}  # the same on every machine that has AVX2
    text = execute(["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", "--toggle-collect=suture::solveScene*", *command],
                   extra=kernels)
    found = re.search(r"Collected\s*:\s*(\d+)", text)
    return int(found.group(1)) if found and found.group(1) != "0" else fail(f"callgrind reports no count:\n{text[-2000:]}")


def allocations_now(options):
    """Heap bytes per conjugate gradient iteration in addition to the one vector that it keeps (InterfaceOperator::record), for linear problems
    with few and with many cells in the same number of subdomains: two runs, one of which ends earlier, under glibc's counting library."""
    folder = options.output / "runs" / "allocations"
    taken = {}
    for name, (scene, boxes, tolerance, chosen) in COUNTED.items():
        for cells in CELLS:
            found = []
            for value in ("1e-5", "1e-10"):
                command = [str(options.programs / "suture_solve"), str(ROOT / scene), "--output", str(folder)]
                meshed = [f"Mesh/Boxes/{box}/{key}" for box in boxes for key in (f"Cells={{{cells}, {cells}}}", "Blocks={6, 6}")]
                for assignment in (*meshed, f"{tolerance}={value}", *chosen):
                    command += ["--set", assignment]
                text = execute(command, extra={"LD_PRELOAD": "libmemusage.so", "MEMUSAGE_NO_TIMER": "1"}, expected=(0, 4))
                total = re.search(r"heap total: (\d+)", text)
                if not total:
                    fail(f"libmemusage.so reports no count:\n{text[-2000:]}")
                summary = json.loads((folder / "summary.json").read_text())
                found.append((int(total.group(1)), summary["auxiliary"]["iterations"]))
            (few, first), (many, last) = found
            if first >= last:
                fail(f"allocations: {name}, {first} and {last} iterations to 1e-5 and 1e-10")
            taken[name, cells] = round((many - few) / (last - first)) - 8 * summary["interface_dofs"]
    return taken


def grown(allocations):
    """One line for each case whose iteration takes more memory in the larger problem: some work array is not kept."""
    wrong = []
    for name in COUNTED:
        small, large = (allocations[name, cells] for cells in CELLS)
        print(f"allocations: {name}, {small} and {large} bytes per iteration with {CELLS[0]} and {CELLS[1]} cells per side")
        if not 0 < large <= ALLOCATIONS * small + VIEWS:  # zero: nothing was counted
            wrong.append(f"allocations: {name}, {large} bytes per iteration, {small} in the smaller problem")
    return wrong


def differences(now, before):
    """One line for each changed count."""
    wrong = []
    for name, counts in now["counts"].items():
        old = before["counts"].get(name)
        if old is None:
            wrong.append(f"{name}: not in the baseline")
        elif old["elements"] != counts["elements"]:
            wrong.append(f"{name}: another mesh ({counts['elements']} elements, was {old['elements']}): write a new baseline")
        else:
            wrong += [f"{name}: {counts[key]} iterations ({key}), were {old[key]}" for key in counts
                      if key != "elements" and abs(counts[key] - old[key]) > COUNT]
    old, new = before["instructions"], now["instructions"]
    if not (old and new):
        print("instructions: not compared, " + ("the baseline has none" if new else "valgrind is not installed"))
    else:
        print(f"instructions: {new:,}, {new / old:.4f} of the baseline's")
        if new > INSTRUCTIONS * old:
            wrong.append(f"instructions: {new / old:.3f} times the baseline's, at most {INSTRUCTIONS}")
    return wrong


def guard(options):
    """Compares with the baseline, or writes it; returns 1 if a count differs."""
    path = Path(options.guard)
    if not options.write_baseline and not path.exists():
        fail(f"no such baseline: {path}; create it with --write-baseline")
    now = {"counts": counts_now(options), "instructions": instructions_now(options)}
    if options.write_baseline:
        path.write_text(json.dumps(now, indent=2) + "\n")
        print(f"{path}: written")
        return 0
    wrong = differences(now, json.loads(path.read_text())) + grown(allocations_now(options))
    print(f"{len(now['counts'])} runs compared, {len(wrong)} wrong")
    for line in wrong:
        print(f"  {line}")
    return 1 if wrong else 0
