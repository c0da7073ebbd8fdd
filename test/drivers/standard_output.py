"""Programs whose standard output is closed or full: a result that could not be printed is an error, reported once; a closed output is
intentional and not an error. standard_output.py --solve PROGRAM --new ... --mpirun "mpirun ..." --work DIR --input FOLDER"""
import json
import pathlib
import subprocess
import time

from harness import SLOWER, arguments, check, command, finish

PROGRAMS = ("solve", "new", "partition", "schema", "study", "plot", "convert")
options = arguments("--input", *(f"--{name}" for name in PROGRAMS))
INPUT = pathlib.Path(options.input)
SCENE = INPUT / "two_blocks" / "two_blocks.xml"
STUDY = pathlib.Path(__file__).resolve().parent / "study" / "tiny.xml"


def redirected(streams, ranks, program, *words):
    """Exit code, standard error and seconds of a program behind a shell's redirections."""
    begin = time.time()
    try:
        done = subprocess.run(["sh", "-c", f'exec "$@" {streams}', "sh", *command(program, ranks, *words)], stdin=subprocess.DEVNULL,
                              stderr=subprocess.PIPE, text=True, timeout=60 * SLOWER)
    except subprocess.TimeoutExpired:
        return "no end", "", 60.0
    return done.returncode, done.stderr, time.time() - begin


solved = options.work / "solved"
code, _, _ = redirected(">/dev/null", 1, options.solve, SCENE, "--output", solved)
check("a run to draw", code, 0)
mesh = options.work / "triangle.inp"
mesh.write_text("*NODE\n1, 0, 0\n2, 1, 0\n3, 0, 1\n*ELEMENT, TYPE=CPS3, ELSET=a\n1, 1, 2, 3\n")
CASES = {
    "solve": (options.solve, SCENE, "--output", options.work / "out"),
    "check": (options.solve, SCENE, "--check", "--no-drawing"),
    "defaults": (options.solve, SCENE, "--print-defaults"),
    "help": (options.solve, "--help"),
    "version": (options.solve, "--version"),
    "schema": (options.schema,),
    "new": (options.new, INPUT / "pin" / "pin.geo", "--output", options.work / "pin.xml", "--force"),
    "partition": (options.partition, SCENE, "--output", options.work / "mesh.h5"),
    "study": (options.study, STUDY, "--check"),
    "plot": (options.plot, solved),
    "convert": (options.convert, mesh, options.work / "triangle.h5"),
}
for name, words in CASES.items():
    program = pathlib.Path(words[0]).name
    code, text, _ = redirected(">/dev/full", 1, *words)
    check(f"{name}, a full device: exit code", code, 5)
    check(f"{name}, a full device: said once", text, f"{program}: standard output cannot be written: No space left on device\n")
    code, text, seconds = redirected(">&-", 1, *words)
    check(f"{name}, closed: exit code", (code, text), (0, ""))
check("the results are there all the same", json.loads((options.work / "out" / "summary.json").read_text())["verified"], True)
# All three streams closed: no file of the run may get the descriptor of a stream and receive its output.
code, _, _ = redirected("<&- >&- 2>&-", 1, options.solve, SCENE, "--output", options.work / "none")
check("all closed: exit code", code, 0)
files = {path.name: path.read_bytes() for path in (options.work / "none").iterdir() if path.is_file()}
check("all closed: the console's text is in no file", [name for name, data in files.items() if b"verified:" in data or b"on the interface" in data], [])
check("all closed: files of a run", {"summary.json", "history.csv", "fields_0000.vtkhdf"} <= set(files), True)
# An error of the run keeps its exit code; the output error is reported after it.
code, text, _ = redirected(">/dev/full", 1, options.solve, options.work / "nothing.xml")
check("an error without any output is reported alone", (code, text.count("cannot be")), (3, 1))
code, text, _ = redirected(">&-", 2, options.solve, SCENE, "--output", options.work / "two")
check("closed, two ranks", (code, text), (0, ""))
finish()
