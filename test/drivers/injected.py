"""Exceptions of one rank of four in every phase of a run, as the phase begins and before a communication in it (plugins/InjectedFault.cpp):
one message, the exit code of the exception, below five seconds, nothing from the launcher.

injected.py --solve PROGRAM --fault LIBRARY --mpirun "mpirun ..." --work DIR --input FOLDER [--places few | all]
"""
import argparse
import os
import pathlib
import signal
import subprocess
import time

from harness import arguments, check, finish, setting

parser = argparse.ArgumentParser()
parser.add_argument("--places", choices=("few", "all"), default="few")
options = arguments("--solve", "--fault", "--input", parser=parser)
SCENE = pathlib.Path(options.input) / "two_blocks" / "two_blocks.xml"
WORDS = [str(SCENE), "--quiet", *setting("Output/Error Estimate", "true")]
CODES = {"memory": 5, "numerical": 4, "input": 3, "environment": 5, "other": 70}
RANKS = 4


def run(folder, **environment):
    """Exit code, standard output and error, seconds."""
    line = [*options.mpirun.split(), "-q", "-np", str(RANKS), "env", "LD_PRELOAD=" + options.fault, options.solve, *WORDS, "--output",
            str(options.work / folder)]
    begin = time.time()
    process = subprocess.Popen(line, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True,
                               env={**os.environ, **environment})
    try:
        out, err = process.communicate(timeout=60)
        code = process.returncode
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        out, err = process.communicate()
        code = "no end"
    return code, out, err, time.time() - begin


code, out, err, usual = run("sound", SUTURE_TEST_COUNTS=str(options.work / "counts"))
check("a run without a fault", (code, err), (0, ""))
counts = {phase: int(count) for phase, count in (line.split() for line in (options.work / "counts").read_text().splitlines())}
check("phases", set(counts), lambda names: names >= {"read", "partition", "assemble", "factor", "solve", "estimate", "verify", "write"})
print(f"communications: {counts}; the run took {usual:.2f} s")

number = 0
for phase, count in counts.items():
    # As it begins, and at its first, middle and last communication.
    places = [0] + sorted({1, (count + 1) // 2, count} - {0})
    if options.places == "few":
        places = places[:1] + places[2:3]
    for place in places:
        kinds = list(CODES)
        for kind in kinds if options.places == "all" else [kinds[number % len(kinds)]]:
            rank = number % RANKS
            number += 1
            what = f"{kind} on rank {rank} in {phase}, " + (f"communication {place} of {count}" if place else "as it begins")
            code, out, err, seconds = run("fault", SUTURE_TEST_FAULT=f"{phase} {place} {rank} {kind}")
            check(what + ": exit code", code, CODES[kind])
            check(what + ": one message, and nothing else", err, lambda t: t.count("suture_solve:") == 1 and "mpirun" not in t and
                  "MPI_ABORT" not in t and "-----" not in t and len(t.splitlines()) <= 5)
            check(what + ": nothing on standard output", out, "")
            check(what + ": below five seconds", seconds, lambda s: s < 5 + usual)
            check(what + ": no summary", (options.work / "fault" / "summary.json").exists(), False)
finish()
