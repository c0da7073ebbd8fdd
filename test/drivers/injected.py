"""Exceptions on one rank of four in every phase of a run (plugins/InjectedFault.cpp). Expected: one message, the exit code of the exception,
less than five seconds, and no output from the launcher.

injected.py --solve PROGRAM --fault LIBRARY --mpirun "mpirun ..." --work DIR --input FOLDER [--places few | all]
"""
import argparse
import json
import os
import pathlib
import signal
import subprocess
import time

from harness import SANITIZED, SLOWER, arguments, check, finish, setting

parser = argparse.ArgumentParser()
parser.add_argument("--places", choices=("few", "all"), default="few")
options = arguments("--solve", "--fault", "--input", parser=parser)
SCENE = pathlib.Path(options.input) / "two_blocks" / "two_blocks.xml"
WORDS = [str(SCENE), "--quiet", *setting("Output/Error Estimate", "true")]
CODES = {"memory": 5, "numerical": 4, "input": 3, "environment": 5, "other": 70}
RANKS = 4


def run(folder, words=WORDS, **environment):
    """Exit code, standard output and error, seconds."""
    line = [*options.mpirun.split(), "-q", "-np", str(RANKS), "env", "LD_PRELOAD=" + options.fault, options.solve, *words, "--output",
            str(options.work / folder)]
    begin = time.time()
    process = subprocess.Popen(line, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True,
                               env={**os.environ, **environment})
    try:
        out, err = process.communicate(timeout=60 * SLOWER)
        code = process.returncode
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        out, err = process.communicate()
        code = "no end"
    return code, out, err, time.time() - begin


code, out, err, usual = run("sound", SUTURE_TEST_COUNTS=str(options.work / "counts"))
check("a run without a fault", (code, err), (0, ""))
counts = [{}, {}, {}, {}]
for file in options.work.glob("counts.*"):
    for rank, phase, messages, works in (line.split() for line in file.read_text().splitlines()):
        counts[int(rank)][phase] = int(messages), int(works)
# With sanitizers the library binds its own functions internally (-Bsymbolic-functions): phases that it begins are not intercepted.
phases = {"read", "partition", "assemble", "factor", "solve", "estimate", "verify"} | (set() if SANITIZED else {"write"})
check("phases", set(counts[0]), lambda names: names >= phases)
print(f"communications and works on rank 0: {counts[0]}; the run took {usual:.2f} s")

# Places: the begin of a phase; its first, middle and last communication; its first and last local work that ends collectively. Only an
# unforeseen exception leaves the other ranks in a communication: NumericalErrors and InputErrors of one rank are thrown in local work, after
# which all ranks learn of them. Few: the last work and the middle communication, alternating.
every = options.places == "all"
places = []
for i, phase in enumerate(counts[0]):
    rank = (i + 1) % RANKS
    messages, works = counts[rank].get(phase, (0, 0))
    middle = [1, (messages + 1) // 2, messages] if every else [(messages + 1) // 2]
    places += [(rank, phase, "phase", 0)] if every or messages == 0 else []
    if messages > 0 and (every or works == 0 or i % 2 == 1):
        places += [(rank, phase, "message", n) for n in sorted(set(middle))]
    if works > 0 and (every or messages == 0 or i % 2 == 0):
        places += [(rank, phase, "work", n) for n in sorted({1, works} if every else {works})]

for number, (rank, phase, place, at) in enumerate(places):
    kinds = [kind for kind in CODES if place == "work" or kind not in ("numerical", "input")]
    for kind in kinds if every else [kinds[number // 2 % len(kinds)]]:
        what = f"{kind} on rank {rank} in {phase}, {place} {at}"
        code, out, err, seconds = run("fault", SUTURE_TEST_FAULT=f"{phase} {place} {at} {rank} {kind}")
        check(what + ": exit code", code, CODES[kind])
        check(what + ": one message, and nothing else", err, lambda t: t.count("suture_solve:") == 1 and "mpirun" not in t and
              "MPI_ABORT" not in t and "-----" not in t and len(t.splitlines()) <= 5)
        check(what + ": nothing on standard output", out, "")
        check(what + ": below five seconds", seconds, lambda s: s < 5 * SLOWER + usual)
        summary = options.work / "fault" / "summary.json"
        check(what + ": no summary, or one with the exit code", json.loads(summary.read_text())["exit_code"] if summary.exists() else CODES[kind], CODES[kind])
        summary.unlink(missing_ok=True)

# Four seconds are for the current iteration: later delays on a busy machine do not cost the checkpoint. Not with sanitizers, where the
# checkpoint itself takes too long.
if not SANITIZED:
    endless = [str(SCENE.parent.parent / "tunnel" / "tunnel_open.xml"), "--quiet", *setting("Mesh/Constants/scale", 3),
               *setting("Formulation", "Condensed Groups"), *setting("Outer Solver/Type", "Successive Approximation"),
               *setting("Outer Solver/Maximum Iterations", 100000), *setting("Outer Solver/Tolerance", "1e-17")]
    code, out, err, seconds = run("late", endless, SUTURE_TEST_FAULT="solve message 100 1 stop")
    summary = options.work / "late" / "summary.json"
    check("SIGTERM, and a verdict that comes late: exit code", code, 75)
    check("SIGTERM, and a verdict that comes late: summary", json.loads(summary.read_text())["exit_code"] if summary.exists() else None, 75)
    check("SIGTERM, and a verdict that comes late: checkpoint", (options.work / "late" / "checkpoint.h5").exists(), True)
finish()
