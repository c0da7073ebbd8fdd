"""Counts instead of seconds: iterations and instructions, compared with a file. A busy machine does not change them."""
import json
import re
import shutil
from pathlib import Path

from runs import command_of, configurations, execute, fail, measure, mesh_of

SIZES = ["10k", "100k"]
COUNT = 2  # iterations more or less
INSTRUCTIONS = 1.05


def counts_now(options):
    """Iterations of every scene on one and two ranks, and the elements they belong to."""
    runs = {name: run for name, run in configurations().items() if name.startswith("suture")}
    counts = {}
    for scene in options.scenes:
        for size in options.sizes:
            mesh = mesh_of(scene, size, options)
            for name, run in runs.items():
                result = measure(name, run, scene, size, mesh, options)
                counts[f"{scene}/{size}/{name}"] = {"elements": result["elements"], **result["counts"]}
    return counts


def instructions_now(options):
    """Instructions of one small run within solveScene (loading libraries would be half of all), by callgrind; None without valgrind."""
    if not shutil.which("valgrind"):
        return None
    mesh = mesh_of("tunnel", "10k", options)
    command = command_of({"ranks": 1, "set": []}, "tunnel", mesh, options.output / "runs" / "callgrind", options)
    kernels = {"OPENBLAS_CORETYPE": "Haswell"}  # the same on every machine that has AVX2
    text = execute(["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", "--toggle-collect=suture::solveScene*", *command],
                   extra=kernels)
    found = re.search(r"Collected\s*:\s*(\d+)", text)
    return int(found.group(1)) if found and found.group(1) != "0" else fail(f"callgrind says no count:\n{text[-2000:]}")


def differences(now, before):
    """One line for each count that is not what it was."""
    wrong = []
    for name, counts in now["counts"].items():
        old = before["counts"].get(name)
        if old is None:
            wrong.append(f"{name}: not in the baseline")
        elif old["elements"] != counts["elements"]:
            wrong.append(f"{name}: another mesh ({counts['elements']} elements, were {old['elements']}): renew the baseline")
        else:
            wrong += [f"{name}: {counts[key]} iterations ({key}), were {old[key]}" for key in counts
                      if key != "elements" and abs(counts[key] - old[key]) > COUNT]
    old, new = before["instructions"], now["instructions"]
    if not (old and new):
        print("instructions: not compared, " + ("the baseline has none" if new else "there is no valgrind"))
    else:
        print(f"instructions: {new:,}, {new / old:.4f} of the baseline's")
        if new > INSTRUCTIONS * old:
            wrong.append(f"instructions: {new / old:.3f} times the baseline's, at most {INSTRUCTIONS}")
    return wrong


def guard(options):
    """Compares with the baseline, or writes it; 1 when something differs."""
    path = Path(options.guard)
    if not options.write_baseline and not path.exists():
        fail(f"no such baseline: {path}; --write-baseline makes it")
    now = {"counts": counts_now(options), "instructions": instructions_now(options)}
    if options.write_baseline:
        path.write_text(json.dumps(now, indent=2) + "\n")
        print(f"{path}: written")
        return 0
    wrong = differences(now, json.loads(path.read_text()))
    print(f"{len(now['counts'])} runs compared, {len(wrong)} wrong")
    for line in wrong:
        print(f"  {line}")
    return 1 if wrong else 0
