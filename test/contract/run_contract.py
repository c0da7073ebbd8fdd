"""Compares runs that write every kind of key with the contract: exit codes, files, schemas, options of the programs.

run_contract.py --programs FOLDER --plugin LIB.so --work DIR --input FOLDER --mpirun "mpirun ..." [--record]
    --record: replaces the content of contract.json by the results, for an intended change.
"""
import argparse
import json
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "drivers"))
import contract
import harness
from harness import SLOWER, arguments, check, finish, setting

parser = argparse.ArgumentParser()
parser.add_argument("--record", action="store_true")
options = arguments("--programs", "--plugin", "--input", parser=parser)
work, programs, scenes = options.work, pathlib.Path(options.programs), pathlib.Path(options.input)
stored = json.loads((HERE / "contract.json").read_text()) if (HERE / "contract.json").exists() else {}
found = {"runs": {}, "options": {}, "phases": []}
summarySchema = contract.schema("summary")
seen, phases = set(), set()


def scene(name):
    return scenes / name / f"{name}.xml"


def probes(kind, **parameters):
    words = setting("Output/Probes/line/Type", kind)
    for name, value in parameters.items():
        words += setting(f"Output/Probes/line/{name}", value)
    return words


def judge(name, code, text=""):
    """Compares a finished run with its entry in the contract."""
    folder = work / name
    expected = stored.get("runs", {}).get(name, {"exit_code": None, "files": []})
    problems = ([] if options.record else contract.runProblems(expected, code, folder)) + contract.folderProblems(folder)
    if (folder / "summary.json").exists():
        summary = json.loads((folder / "summary.json").read_text())
        seen.update(contract.keysIn(summary, summarySchema, summarySchema))
        phases.update(summary["phases"])
        if not name.startswith("again"):  # the repeated run may agree with itself, but not with its record
            problems += [] if summary["exit_code"] == code else [f"summary.json has exit code {summary['exit_code']}, the program {code}"]
    found["runs"][name] = {"exit_code": code, "files": contract.filesOf(folder)}
    check(name, problems, [])
    if problems:
        print(text)


def solve(name, *words, ranks=1):
    code, text = harness.run(programs / "suture_solve", ranks, *words, "--output", work / name)
    judge(name, code, text)


solve("linear", scene("linear_square"), *setting("Bodies/square/Material", "S355"))
solve("plane", scene("two_blocks"), *setting("Output/Error Estimate", "true"), *setting("Output/Nodal Stresses", "true"),
      *setting("Output/Checkpoint", "true"), *probes("Line", From="{0.1, 0.1}", To="{0.9, 0.9}"))
solve("restart", scene("two_blocks"), "--restart", work / "plane" / "checkpoint.h5", ranks=2)
solve("exact", scene("manufactured"), *setting("Output/Error Estimate", "true"), *setting("Outer Solver/Tolerance", "Automatic"))
solve("bound", scene("tunnel"), *setting("Mesh/Order", "2"), *setting("Mesh/Mesh Size Factor", "3"), *setting("Output/Error Bound", "true"))
solve("accuracy", scene("tunnel"), *setting("Accuracy/Error", "0.03"), *setting("Output/Error Bars", "true"),
      *setting("Output/Strict Error Bars", "{All}"))
solve("force", scenes / "studies" / "punch.xml", *setting("Accuracy/Error", "5e-5"), *setting("Accuracy/Quantity", "Contact Force"),
      *setting("Accuracy/Most Levels", 30), *setting("Output/Strict Error Bars", "{joint}"))
solve("strict", HERE.parent / "drivers" / "pressed_triangles.xml", *setting("Output/Strict Error Bars", "{All}"))
solve("singular", scene("closed_crack"), *setting("Output/Error Bars", "true"))
solve("singular_contact", scene("bolted_joint"), *setting("Output/Error Bars", "true"))
solve("space", scene("patch_3d"), ranks=2)
solve("friction", scene("sliding_pad"))
solve("load_steps", scene("cattaneo"), *setting("Mesh/Mesh Size Factor", "2"), *setting("Materials/unit/Yield Strength", "1"),
      *setting("Output/Displacements Since", "1"))
solve("several_bodies", scene("beam_on_blocks"))
solve("few_files", scene("two_blocks"), *setting("Output/Fields", "false"), *setting("Output/Tables", "false"))
solve("plugin", scene("two_blocks"), "--plugin", options.plugin)
solve("groups", scene("two_blocks"), *setting("Formulation", "Condensed Groups"), *setting("Outer Solver/Type", "Successive Approximation"),
      *setting("Outer Solver/Maximum Iterations", 20), *setting("Preconditioner/Type", "Neumann-Neumann"))
solve("rigid_group", HERE.parent / "drivers" / "rigid_end.xml")
solve("moving", scene("screw"), *setting("Load Steps/Times", "{1, 2}"))
solve("bodies_loose", HERE.parent / "drivers" / "unloaded_pad.xml")
solve("shared_forces", HERE.parent / "drivers" / "bond.xml")
solve("not_converged", scene("friction_block"), *setting("Outer Solver/Maximum Iterations", 2))
solve("refused_parameter", scene("two_blocks"), *setting("Outer Solver/Tolerence", "1e-8"))
solve("refused_missing", work / "nothing.xml")
solve("checked_only", scene("two_blocks"), "--check")
solve("printed_only", scene("two_blocks"), "--print-defaults")
solve("wrong_option", scene("two_blocks"), "--cheque")
(work / "file").write_text("in the way")
code, text = harness.run(programs / "suture_solve", 1, scene("two_blocks"), "--output", work / "file" / "below")
judge("no_folder", code, text)

# Stopped on request once its table has begun.
with open(work / "stopped.log", "w") as log:
    process = subprocess.Popen(harness.command(programs / "suture_solve", 1, scenes / "tunnel" / "tunnel_open.xml", "--output", work / "stopped",
                                               *setting("Outer Solver/Type", "Successive Approximation"),
                                               *setting("Outer Solver/Maximum Iterations", 100000), *setting("Outer Solver/Tolerance", "1e-14")),
                               stdout=log, stderr=log)
    until = time.time() + 60 * SLOWER
    while time.time() < until and "residual   active" not in (work / "stopped.log").read_text():
        time.sleep(0.02)
    process.send_signal(signal.SIGUSR1)
    judge("stopped", process.wait(timeout=60 * SLOWER), (work / "stopped.log").read_text())

# Repeated: agrees, disagrees (with another run's record), is refused.
solve("again", "--again", work / "plane" / "summary.json")
solve("again_not_converged", "--again", work / "not_converged")
changed = json.loads((work / "plane" / "summary.json").read_text())
changed["energy"] *= 1 + 1e-3
(work / "changed").mkdir()
(work / "changed" / "summary.json").write_text(json.dumps(changed))
solve("again_differs", "--again", work / "changed")
shutil.copy(scene("two_blocks"), work / "scene.xml")
solve("before_the_change", work / "scene.xml")
(work / "scene.xml").write_text((work / "scene.xml").read_text().replace("{16, 8}", "{16, 6}"))
solve("again_other_scene", "--again", work / "before_the_change")
solve("again_stopped", "--again", work / "stopped")

# The other programs: exit codes and files. suture_partition writes only the requested file.
(work / "partition").mkdir()
judge("partition", harness.run(programs / "suture_partition", 1, scene("two_blocks"), "--output", work / "partition" / "mesh.h5")[0])
judge("study", harness.run(programs / "suture_study", 1, HERE.parent / "drivers" / "study" / "tiny.xml", "--output", work / "study",
                           "--only", "small")[0])
for program in ("suture_solve", "suture_study", "suture_partition", "suture_schema", "suture_new", "suture_plot", "suture_study_plot",
                "suture_convert"):
    code, text = harness.run(programs / program, 1, "--help")
    found["options"][program] = contract.optionsOf(text)
    problems = [] if options.record else contract.optionProblems(program, stored.get("options", {}).get(program, []), text)
    check(f"options of {program}", (code, problems), (0, []))
    check(f"{program}: exit codes in --help", re.findall(r"Exit codes: 0 |, 3 input, ", text), lambda found: len(found) == 2)
    code, text = harness.run(programs / program, 1, "--version")
    check(f"{program} --version", (code, re.fullmatch(program + r" \d+\.\d+\.\d+( \(.*\))?\n", text) is not None), (0, True))
    check(f"{program}: an unknown option", harness.run(programs / program, 1, "--no-such-option")[0], 2)

found["phases"] = sorted(phases)
if options.record:
    (HERE / "contract.json").write_text(json.dumps(found, indent=1) + "\n")
check("phases", sorted(phases), found["phases"] if options.record else stored.get("phases"))
check("every exit code that a user can meet", {run["exit_code"] for run in found["runs"].values()}, {0, 2, 3, 4, 5, 75})
check("the schema describes each key and each unit", contract.undescribed(summarySchema, summarySchema), [])
check("every key of the schema is written by some run", sorted(contract.keysOf(summarySchema, summarySchema) - seen), [])
finish()
