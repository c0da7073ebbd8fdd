#!/usr/bin/python3
"""Scenes pay nothing for what they do not request: without Accuracy and Output/Error Bound, summary.json has no phase and no key of them, on
any number of ranks. With `--bound`: a scene that requests the bound has its phase and its key.

    unrequested.py --solve suture_solve --work DIR --input DIR --mpirun "..." [--bound]
"""
import argparse
import json

from harness import arguments, check, finish, run, setting

parser = argparse.ArgumentParser()
parser.add_argument("--bound", action="store_true")
options = arguments("--solve", "--input", parser=parser)
PHASES = ["assemble", "estimate", "factor", "partition", "read", "solve", "verify", "write"]
REQUESTED = {"accuracy", "bound"}
SCENES = {"tunnel/tunnel.xml": (1, 2), "linear_square/linear_square.xml": (1,), "two_blocks/two_blocks.xml": (1, 4)}


def summary_of(scene, ranks, *more):
    folder = options.work / f"{scene.split('/')[0]}_{ranks}_{len(more)}"
    code, text = run(options.solve, ranks, f"{options.input}/{scene}", "--output", folder, *setting("Output/Fields", "false"), *more)
    check(f"{scene} on {ranks} ranks: exit code", code, 0)
    return json.loads((folder / "summary.json").read_text()), text


for scene, numbers in SCENES.items():
    for ranks in numbers:
        summary, text = summary_of(scene, ranks)
        name = f"{scene} on {ranks} ranks"
        check(f"{name}: phases", sorted(set(summary["phases"]) - {"recover"}), PHASES)
        check(f"{name}: keys", sorted(REQUESTED & set(summary)), [])
        check(f"{name}: errors", sorted(key for key in summary["error"] if "bound" in key or "accuracy" in key), [])
        check(f"{name}: console", [word for word in ("accuracy:", "error bound", "level ") if word in text], [])
if options.bound:
    summary, _ = summary_of("tunnel/tunnel.xml", 2, *setting("Output/Error Bound", "true"))
    check("asked: phases", sorted(set(summary["phases"]) - {"recover"}), sorted([*PHASES, "bound"]))
    check("asked: keys", sorted(REQUESTED & set(summary)), ["bound"])
finish()
