"""Random kills: a run that writes checkpoints gets SIGKILL, SIGTERM or SIGUSR1 on one or all of its ranks at a random moment; another number
of ranks continues and is sometimes killed, too. No file is corrupt, and the final result is that of an uninterrupted run.

kills.py --solve PROGRAM --mpirun "mpirun ..." --work DIR --input FOLDER [--count N] [--seed S] [--first I]
"""
import argparse
import json
import os
import pathlib
import random
import shutil
import signal
import subprocess
import time

import harness
from harness import SLOWER, arguments, check, finish, setting

parser = argparse.ArgumentParser()
parser.add_argument("--count", type=int, default=10)
parser.add_argument("--seed", type=int, default=1)
parser.add_argument("--first", type=int, default=0)
options = arguments("--solve", "--input", parser=parser)
work = options.work
SCENE = pathlib.Path(options.input) / "tunnel" / "tunnel_open.xml"
COARSE = setting("Mesh/Constants/scale", 3) + ["--quiet"]
# Slow: these runs last until a signal ends them, or almost.
SLOW = setting("Formulation", "Condensed Groups") + setting("Outer Solver/Type", "Successive Approximation") + \
    setting("Outer Solver/Maximum Iterations", 100000) + setting("Outer Solver/Tolerance", "1e-17") + setting("Output/Checkpoint Every", 1e-4)
SIGNALS = [signal.SIGKILL, signal.SIGTERM, signal.SIGUSR1]


def line(ranks, folder, *words):
    words = [SCENE, *COARSE, "--output", folder, *words]
    return harness.command(options.solve, ranks, *words) if ranks > 1 else [str(options.solve), *map(str, words)]


def summary(folder):
    path = folder / "summary.json"
    return json.loads(path.read_text()) if path.exists() else None


def processes(launcher):
    """The ranks: children of mpirun, or the process itself."""
    try:
        children = [int(c) for c in pathlib.Path(f"/proc/{launcher.pid}/task/{launcher.pid}/children").read_text().split()]
        # Before exec a child is a copy of mpirun with its arguments: a signal would not reach the program.
        return [c for c in children if pathlib.Path(os.readlink(f"/proc/{c}/exe")).name == pathlib.Path(options.solve).name]
    except (FileNotFoundError, ProcessLookupError, PermissionError):
        return []


def kill_one(rng, what, ranks, folder, restart, longest):
    """Starts a run and kills it. Returns a description for messages."""
    how, delay = rng.choice(SIGNALS), rng.uniform(0, longest)
    born = time.time()
    process = subprocess.Popen(line(ranks, folder, *SLOW, *restart), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    # Half of the kills come once the run iterates and writes checkpoints, the others at any time.
    if rng.random() < 0.5:
        checkpoint, until = folder / "checkpoint.h5", time.time() + 30 * SLOWER
        while process.poll() is None and time.time() < until and not (checkpoint.exists() and checkpoint.stat().st_mtime > born):
            time.sleep(0.01)
        delay /= 8
    time.sleep(delay)
    hit = [process.pid] if ranks == 1 else processes(process)
    if rng.random() < 0.5:
        hit = hit[-1:]
    for pid in hit:
        try:
            os.kill(pid, how)
        except ProcessLookupError:
            pass
    if not hit:  # mpirun had not started them yet
        process.send_signal(signal.SIGTERM)
    try:
        text = process.communicate(timeout=120 * SLOWER)[0]
        code = process.returncode
    except subprocess.TimeoutExpired:
        # Open MPI 4.1's mpirun may deadlock if a rank dies while it is still being started (futex, all ranks gone).
        alone = ranks > 1 and not processes(process)
        process.kill()
        text, code = process.communicate()[0], "no end"
        if alone:
            return what + f"{how.name} after {delay:.2f} s, of which mpirun did not wake up"
    what += f"{how.name} after {delay:.2f} s to {len(hit)} of {ranks} ranks"
    # Before the program installs its handlers, a signal has its default effect.
    unheard = {-how, 128 + how, 1, -signal.SIGTERM, 128 + signal.SIGTERM}
    left = summary(folder)
    if (code == 0 or not hit) and left and left["converged"]:
        return what + " (too late)"
    check(what + ": exit code", code, lambda c: c in unheard or c == 75 and how != signal.SIGKILL)
    check(what + ": no summary, or one of a run that was stopped", left and (left["exit_code"], left["converged"]), lambda s: s in (None, (75, False)))
    if code == 75:
        check(what + ": a checkpoint, or a message why there is none", (folder / "checkpoint.h5").exists() or "no new checkpoint" in text, True)
    return what


begin = time.time()
done = subprocess.run(line(2, work / "whole"), capture_output=True, text=True)
usual = time.time() - begin
whole = summary(work / "whole")
check("the reference", (done.returncode, whole["converged"]), (0, True))
checkpoints = 0
for i in range(options.first, options.first + options.count):
    rng = random.Random(f"{options.seed}/{i}")
    folder = work / f"kill{i:04d}"
    what, ranks, restart = f"kill {i}: ", rng.choice([1, 2, 3]), []
    for again in range(rng.choice([1, 1, 2])):
        what = kill_one(rng, what, ranks, folder, restart, min(2 * usual, 5.0)) + "; "
        restart = ["--restart", str(folder / "checkpoint.h5")] if (folder / "checkpoint.h5").exists() else []
        ranks = rng.choice([r for r in (1, 2, 3) if r != ranks])
    checkpoints += bool(restart)
    done = subprocess.run(line(ranks, folder, *restart), capture_output=True, text=True, timeout=120 * SLOWER)
    what += f"then {ranks} ranks" + (" from its checkpoint" if restart else "")
    last = summary(folder)
    check(what + ": exit code", (done.returncode, done.stderr if done.returncode else ""), (0, ""))
    if last is None:
        check(what + ": a summary", False, True)
        continue
    check(what + ": closed pairs", last["contact"]["active"], whole["contact"]["active"])
    check(what + ": energy", last["energy"] / whole["energy"] - 1, lambda e: abs(e) < 1e-9)
    check(what + ": largest displacement", last["max_displacement"] / whole["max_displacement"] - 1, lambda e: abs(e) < 1e-6)
    check(what + ": forces", max(abs(a - b) for piece, force in whole["contact"]["force"].items() for a, b in zip(force, last["contact"]["force"][piece]))
          / max(abs(f) for force in whole["contact"]["force"].values() for f in force), lambda e: e < 1e-6)
    shutil.rmtree(folder)
check("some went on from a checkpoint, and not all", checkpoints, lambda n: options.count < 10 or 0 < n)
print(f"{options.count} kills, {checkpoints} of which went on from a checkpoint")
finish()
