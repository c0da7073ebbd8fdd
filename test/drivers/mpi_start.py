"""Open MPI settings of a process that was not started by a launcher: they are set during MPI_Init and removed afterwards, settings of the user
take precedence, and under mpirun nothing is set (plugins/MpiProbe.cpp).

mpi_start.py --solve PROGRAM --probe LIBRARY --python FOLDER_OF_THE_PACKAGE --mpirun "mpirun ..." --work DIR --input FOLDER
"""
import os
import pathlib
import subprocess

from harness import SLOWER, arguments, check, finish

options = arguments("--solve", "--probe", "--python", "--input")
SCENE = pathlib.Path(options.input) / "two_blocks" / "two_blocks.xml"
BARE = {name: value for name, value in os.environ.items() if not name.startswith("OMPI_MCA_")}
home = options.work / "home"
(home / ".openmpi").mkdir(parents=True)
(home / ".openmpi" / "mca-params.conf").write_text("# mine\n  pml = ob1\nbtl_base_verbose = 0\n")


def seen(name, words, **environment):
    """Environment at MPI_Init and at the end of the process."""
    file = options.work / (name.replace(" ", "_") + ".txt")
    done = subprocess.run(words, capture_output=True, text=True, timeout=60 * SLOWER,
                          env={**BARE, "SUTURE_TEST_PROBE": str(file), "HOME": str(options.work), **environment})
    check(f"{name}: runs", (done.returncode, done.stderr), (0, ""))
    return file.read_text().splitlines() if file.exists() else []


SET, UNSET = "pml=ob1 isolated=1 folders=0", "pml=- isolated=- folders=-"
WAYS = {"program": ["env", "LD_PRELOAD=" + options.probe, options.solve, str(SCENE), "--check", "--no-drawing"]}
if options.python:
    WAYS["python"] = ["env", "LD_PRELOAD=" + options.probe, "/usr/bin/python3", "-B", "-c", "import suture; from mpi4py import MPI; assert MPI.COMM_WORLD.size > 0"]
for way, words in WAYS.items():
    more = {"PYTHONPATH": options.python} if way == "python" else {}
    check(f"{way}: set when MPI begins, and not after", seen(way, words, **more), ["init " + SET, "after " + UNSET])
    check(f"{way}: the user's environment wins", seen(way + " user", words, OMPI_MCA_pml="^cm", OMPI_MCA_ess_singleton_isolated="0", **more),
          ["init pml=^cm isolated=0 folders=-", "after pml=^cm isolated=0 folders=-"])
    check(f"{way}: the user's file wins", seen(way + " file", words, **{**more, "HOME": str(home)}), ["init pml=- isolated=1 folders=0", "after " + UNSET])
    launched = [*options.mpirun.split(), "-np", "2", *words]
    check(f"{way}: nothing is set under mpirun", [line.split()[1] for line in seen(way + " mpirun", launched, **more)], ["pml=-", "pml=-"])
if options.python:
    early = WAYS["python"][:-1] + ["from mpi4py import MPI; import suture; print(MPI.COMM_WORLD.size)"]
    check("python: nothing is set where MPI has begun before", seen("early", early, PYTHONPATH=options.python), ["init " + UNSET, "after " + UNSET])
finish()
