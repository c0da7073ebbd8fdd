"""suture_solve --ranks N starts itself under mpirun: results, exit codes, refusals, and the search for mpirun.

own_ranks.py --solve PROGRAM --mpirun "mpirun ..." --launcher MPIEXEC --work DIR --input FOLDER
"""
import json
import os
import pathlib
import subprocess

import sentences
from harness import SLOWER, arguments, check, finish

options = arguments("--solve", "--input", "--launcher")
SCENE = pathlib.Path(options.input) / "two_blocks" / "two_blocks.xml"
SLABS = pathlib.Path(options.input) / "long_contact" / "long_contact.xml"
# The shell of a user, perhaps root in a container: no settings of MPI, except the folder for temporary files.
BARE = {name: value for name, value in os.environ.items() if not name.startswith("OMPI_") or name == "OMPI_MCA_orte_tmpdir_base"}


def run(*words, program=options.solve, environment=None):
    done = subprocess.run([*map(str, words)] if program is None else [str(program), *map(str, words)], capture_output=True, text=True,
                          timeout=60 * SLOWER, env={**BARE, **(environment or {})}, cwd=options.work)
    for fault in sentences.faults(done.stdout + done.stderr):
        check("prints sentences", fault, "")
    return done.returncode, done.stdout, done.stderr


def summary(folder):
    return json.loads((options.work / folder / "summary.json").read_text())


# More ranks than cores, in both forms of the option; the results are those of mpirun.
for ranks, words in ((3, ["--ranks", "3"]), (2, ["--ranks=2"]), (1, ["--ranks", "1"])):
    code, output, error = run(SCENE, "--output", f"own_{ranks}", *words)
    check(f"{ranks} ranks: exit code", code, 0)
    check(f"{ranks} ranks: standard error", error, "")
    check(f"{ranks} ranks: the header", output, lambda text: f"{ranks} rank" in text.splitlines()[0] + text.splitlines()[1])
    check(f"{ranks} ranks: summary", summary(f"own_{ranks}")["ranks"], ranks)
launched = subprocess.run([*options.mpirun.split(), "-np", "3", options.solve, str(SCENE), "--output", "launched", "--quiet"], cwd=options.work,
                          timeout=60 * SLOWER)
check("by mpirun: exit code", launched.returncode, 0)
tables = [(options.work / folder / "reactions.csv").read_bytes() for folder in ("own_3", "launched")]
check("the results are those of mpirun", tables[0], tables[1])
check("the record has the command without --ranks", summary("own_3")["command_line"], lambda words: "--ranks" not in str(words) and "own_3" in str(words))

# Exit codes and messages of the program, without comments of mpirun.
code, output, error = run("none.xml", "--ranks", "2")
check("no scene: exit code", code, 3)
check("no scene: one message", error, lambda text: text.count("none.xml") >= 1 and "mpirun" not in text.lower() and "Primary job" not in text)
code, output, error = run(SLABS, "--ranks", "2", "--output", "few", "--set", "Outer Solver/Maximum Iterations=1")
check("not converged: exit code", code, 4)
code, output, error = run(SCENE, "--ranks", "2", "--wrong")
check("a wrong option: exit code", code, 2)
check("a wrong option: message", error, lambda text: "--wrong" in text)
code, output, error = run("--ranks", "2", "--help")
check("--help needs no ranks", (code, "--ranks" in output), (0, True))

# Refusals.
for number in ("0", "-2", "1.5", "two"):
    code, output, error = run(SCENE, f"--ranks={number}")
    check(f"--ranks={number}: exit code", code, 2)
    check(f"--ranks={number}: message", error, lambda text: "--ranks" in text)
for number in ("1", "2"):
    code, output, error = run(*options.mpirun.split(), "-np", "2", options.solve, SCENE, "--ranks", number, program=None,
                              environment={name: value for name, value in os.environ.items() if name.startswith("OMPI_")})
    check(f"--ranks {number} below mpirun: exit code", code, 2)
    check(f"--ranks {number} below mpirun: one message", error, lambda text: text.count("itself started by an MPI launcher with 2 ranks") == 1)
code, output, error = run(SCENE, "--ranks", "2", environment={"PMI_RANK": "0"})
check("--ranks below another launcher: exit code", code, 2)

# A program whose own mpirun is gone uses that of PATH, with the user's settings, and replaces itself by it.
built = options.launcher.encode()
binary = pathlib.Path(options.solve).read_bytes()
check("the program names its mpirun", binary.count(built + b"\0"), lambda count: count >= 1)
moved = options.work / "suture_solve"
moved.write_bytes(binary.replace(built + b"\0", b"/none" + b"/" * (len(built) - 9) + b"none\0"))
moved.chmod(0o755)
folder = options.work / "bin"
folder.mkdir()
code, output, error = run(SCENE, "--ranks", "2", program=moved, environment={"PATH": str(folder)})
check("no mpirun: exit code", code, 5)
check("no mpirun: message", error, lambda text: "--ranks needs mpirun" in text and "openmpi-bin" in text)
(folder / "mpirun").write_text('#!/bin/sh\necho "$@"\necho "binding $OMPI_MCA_hwloc_base_binding_policy, root $OMPI_ALLOW_RUN_AS_ROOT"\nexit 75\n')
(folder / "mpirun").chmod(0o755)
for settings, binding in (({}, "none"), ({"OMPI_MCA_hwloc_base_binding_policy": "core"}, "core")):
    code, output, error = run("a b.xml", "--ranks", "4", "--set", "A=1", program=moved, environment={"PATH": str(folder), **settings})
    check("mpirun of PATH: arguments", output.splitlines()[0], f"-np 4 {moved} a b.xml --set A=1")
    check("mpirun of PATH: settings", output.splitlines()[1], f"binding {binding}, root {'1' if os.geteuid() == 0 else ''}")
    check("mpirun of PATH: its exit code", code, 75)
finish()
