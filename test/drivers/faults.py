"""Faults around a run: a full disk, too little memory, signals, a second run into the same folder. The exit code reports the fault, no rank
hangs, and earlier results are neither lost nor mistaken for the new ones.

faults.py --solve PROGRAM --mpirun "mpirun ..." --work DIR --input FOLDER [--all]

Without --all: one case of each kind, with tunnel_open on a coarse mesh; half a minute.
"""
import argparse
import fcntl
import hashlib
import json
import os
import pathlib
import resource
import signal
import subprocess
import sys
import termios
import time

import harness
from harness import SANITIZED, SLOWER, arguments, check, finish, setting

parser = argparse.ArgumentParser()
parser.add_argument("--all", action="store_true", help="every size of a disk and of memory, every signal and number of ranks")
options = arguments("--solve", "--input", parser=parser)
work = options.work
TUNNEL = pathlib.Path(options.input) / "tunnel" / "tunnel.xml"
OPEN = pathlib.Path(options.input) / "tunnel" / "tunnel_open.xml"
# A program has four seconds after a stop request for its iteration, checkpoint and verdict, also with sanitizers.
MESH = setting("Mesh/Constants/scale", 3) if SANITIZED or not options.all else []
# Never reached: a run that ends before the signal would prove nothing.
SLOW = MESH + setting("Outer Solver/Type", "Successive Approximation") + setting("Outer Solver/Maximum Iterations", 100000) + \
    setting("Outer Solver/Tolerance", "1e-17") + setting("Formulation", "Condensed Groups")


def run(ranks, *words, limit=None, timeout=60):
    """Exit code ("no end" if it had to be killed), output and seconds."""
    line = harness.command(options.solve, ranks, *words)
    begin = time.time()
    process = subprocess.Popen(line, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, start_new_session=True, preexec_fn=limit)
    try:
        text, code = process.communicate(timeout=timeout * SLOWER)[0], process.returncode
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        text, code = process.communicate()[0], "no end"
    return code, text, time.time() - begin


def summary(folder):
    return json.loads((work / folder / "summary.json").read_text())


def ended(folder):
    """Exit code and convergence from the summary of a run; None without a summary."""
    return (summary(folder)["exit_code"], summary(folder)["converged"]) if (work / folder / "summary.json").exists() else None


def digest(path):
    return hashlib.sha256(path.read_bytes()).hexdigest()


def until(holds, seconds=60):
    """Waits for a condition. Returns whether it was met in time."""
    end = time.time() + seconds * SLOWER
    while not holds():
        if time.time() > end:
            return False
        time.sleep(0.02)
    return True


def children(process, program):
    """Children that already run the program; before exec they are copies of their parent."""
    found = []
    for task in pathlib.Path(f"/proc/{process.pid}/task").glob("*"):
        for child in (task / "children").read_text().split():
            try:
                if os.readlink(f"/proc/{child}/exe").endswith("/" + program):
                    found.append(int(child))
            except OSError:  # it has ended
                pass
    return found


def start(name, *words, ranks=1, launcher=()):
    """Starts a run in the background and returns once its table has begun."""
    log = work / (name + ".log")
    line = harness.command(options.solve, ranks, *words)
    line[1:1] = launcher
    process = subprocess.Popen(line, stdout=open(log, "w"), stderr=subprocess.STDOUT, start_new_session=True)
    until(lambda: "residual   active" in log.read_text() or process.poll() is not None)
    return process


# A full disk at any moment: while fields, texts or the end of a file are written.
disk = work / "disk"
disk.mkdir()
if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=4m", "none", str(disk)], capture_output=True).returncode == 0:
    try:
        code, _, _ = run(2, TUNNEL, "--quiet", "--output", disk / "out")
        check("a run that fits", code, 0)
        need = sum(f.stat().st_size for f in (disk / "out").iterdir())
        cases = [(ranks, part) for ranks in (1, 2, 4) for part in (0, 0.02, 0.3, 0.6, 0.9, 0.97, 0.995)]
        for ranks, part in cases if options.all else [(1, 0.6), (2, 0.02), (2, 0.97)]:
            subprocess.run(f"rm -rf {disk}/*", shell=True)
            free = int(part * need / 4096) * 4096
            with open(disk / "filler", "wb") as filler:
                os.posix_fallocate(filler.fileno(), 0, os.statvfs(disk).f_bavail * os.statvfs(disk).f_bsize - free)
            code, text, seconds = run(ranks, TUNNEL, "--quiet", "--output", disk / "out")
            what = f"disk with {free} of {need} bytes free, {ranks} ranks: "
            check(what + "exit code", code, 5)
            check(what + "the message says why", text, lambda t: "No space left on device" in t)
            check(what + "no summary", (disk / "out" / "summary.json").exists(), False)
            check(what + "no half a file is left", [f.name for f in (disk / "out").glob("**/*")] if (disk / "out").exists() else [], [])
    finally:
        subprocess.run(["umount", "-l", str(disk)])
else:
    print("skipped: no right to mount a small disk")

def limited_to(size):
    """Limits the address space of a process, which makes its mesh itself."""
    os.environ["SUTURE_MESH_CACHE"] = "off"
    resource.setrlimit(resource.RLIMIT_AS, (size, size))


# Too little address space is refused; the program never retries endlessly.
for megabytes in () if SANITIZED else (500, 700, 900, 1200, 1600, 2400) if options.all else (500, 2400):
    size = megabytes << 20
    code, text, seconds = run(1, OPEN, "--quiet", *setting("Mesh/Constants/scale", 0.35 if options.all else 0.6), "--output", work / "little",
                              limit=lambda: limited_to(size))
    check(f"{megabytes} MB of address space: exit code", code, lambda c: c in (0, 5) and (megabytes < 2400 or c == 0))
    if code != 0:
        check(f"{megabytes} MB of address space: message", text, lambda t: "memory" in t or "ulimit -v" in t)

# SIGTERM and SIGINT: finish the current step, write a checkpoint, exit code 75. A batch system signals all ranks; one signalled rank also stops the others.
signals = [("SIGTERM", 1, 1), ("SIGTERM", 2, 1)]
for name, ranks, hit in signals + ([("SIGINT", 1, 1), ("SIGTERM", 2, 2), ("SIGINT", 4, 4)] if options.all else []):
    what = f"{name} to {hit} of {ranks} ranks"
    folder = f"{name}_{hit}_{ranks}"
    process = start(folder, OPEN, *SLOW, "--output", work / folder, ranks=ranks)
    pids = children(process, "suture_solve") if ranks > 1 else [process.pid]
    check(what + ": they run", len(pids), ranks)
    begin = time.time()
    for pid in pids[-hit:]:
        os.kill(pid, getattr(signal, name))
    until(lambda: process.poll() is not None or not any(pathlib.Path(f"/proc/{pid}/exe").exists() for pid in pids), 30)
    check(what + ": the ranks end below five seconds", time.time() - begin, lambda s: s < 5 * SLOWER)
    code = process.wait(timeout=60 * SLOWER)
    check(what + ": exit code", code, 75)
    check(what + ": summary", ended(folder), (75, False))
    code, _, _ = run(3 - min(ranks, 2), OPEN, *MESH, "--quiet", "--restart", work / folder / "checkpoint.h5", "--output", work / (folder + "_resumed"))
    check(what + ": restart", (code, ended(folder + "_resumed")), (0, (0, True)))

# By default, mpirun kills its ranks a second after it receives SIGTERM; it no longer reads their output.
process = start("launcher", OPEN, *SLOW, "--output", work / "launcher", ranks=2, launcher=("--mca", "odls_base_sigkill_timeout", "3"))
process.send_signal(signal.SIGTERM)
process.wait(timeout=60 * SLOWER)
check("SIGTERM to mpirun: a checkpoint", (work / "launcher" / "checkpoint.h5").exists(), True)
check("SIGTERM to mpirun: a summary", ended("launcher"), (75, False))

# A run blocked on its console, because nobody reads the output, stops all the same.
reader, writer = os.pipe()
fcntl.fcntl(writer, fcntl.F_SETPIPE_SZ, 8192)  # two pages; one of them is full before the run blocks
process = subprocess.Popen([options.solve, str(OPEN), *SLOW, "--output", str(work / "unread")], stdout=writer)
os.close(writer)
waiting = lambda: int.from_bytes(fcntl.ioctl(reader, termios.FIONREAD, bytes(4)), sys.byteorder)
check("a run that nobody reads fills its pipe", until(lambda: waiting() > 4000), True)
time.sleep(0.5)
begin = time.time()
process.terminate()
code = process.wait(timeout=60 * SLOWER)
check("SIGTERM to it", (code, time.time() - begin < 5 * SLOWER, ended("unread"), (work / "unread" / "checkpoint.h5").exists()),
      (75, True, (75, False), True))
os.close(reader)

# The run also stops during mesh generation, before any iteration.
geometry = work / "endless.geo"
geometry.write_text("DefineConstant[ scale = 1 ];\nFor i In {1:1e12}\n x = i;\nEndFor\n")
process = subprocess.Popen([options.solve, str(OPEN), "--set", f"Mesh/File={geometry}", "--output", str(work / "endless")], stderr=subprocess.PIPE, text=True)
check("its mesher runs", until(lambda: children(process, "suture_mesher")), True)
begin = time.time()
process.terminate()
text = process.communicate(timeout=60 * SLOWER)[1]
check("SIGTERM while the mesh is read", (process.returncode, time.time() - begin < 5 * SLOWER, "no new checkpoint" in text), (75, True, True))

# SIGKILL: the earlier result is set aside, the run's own checkpoint exists, the lock disappears with the process.
code, _, _ = run(1, OPEN, *MESH, "--quiet", "--output", work / "killed")
check("a first run", (code, ended("killed")), (0, (0, True)))
fields = digest(work / "killed" / "fields_0000.vtkhdf")
process = start("killed", OPEN, *SLOW, *setting("Output/Checkpoint Every", 1e-3), "--output", work / "killed")
check("its checkpoint", until((work / "killed" / "checkpoint.h5").exists), True)
code, text, _ = run(2, OPEN, *MESH, "--quiet", "--output", work / "killed")
check("a second run into the folder", code, 5)
check("it names the first", text, lambda t: f"process {process.pid}" in t and "another run is writing" in t)
process.kill()
process.wait()
check("killed: no summary to be taken for that of the run", (work / "killed" / "summary.json").exists(), False)
check("killed: the earlier result is there", (json.loads((work / "killed" / "summary.previous.json").read_text())["converged"],
                                             digest(work / "killed" / "fields_0000.vtkhdf")), (True, fields))
half = [work / "killed" / name for name in ("checkpoint.h5.part", "summary.json.part12345")]  # files that a kill may leave
users = work / "killed" / "engine.part1"
for path in (*half, users):
    path.write_text("half")
code, _, _ = run(2, OPEN, *MESH, "--quiet", "--restart", work / "killed" / "checkpoint.h5", "--output", work / "killed")
check("killed: restart on two ranks, into the folder of the dead", (code, ended("killed")), (0, (0, True)))
check("a user's file is untouched", users.exists(), True)
users.unlink()
check("nothing else is left", sorted(f.name for f in (work / "killed").iterdir() if f.name != "checkpoint.h5"),
      ["contact.csv", "contact_0000.vtkhdf", "fields_0000.vtkhdf", "history.csv", "reactions.csv", "summary.json"])

# A run that fails on its input keeps the earlier result, without a summary.
code, _, _ = run(2, OPEN, *MESH, "--quiet", "--output", work / "killed", *setting("Contact/fault above/Side A", "none"))
check("a run that fails", code, 3)
check("it leaves the earlier result beside", [(work / "killed" / f).exists() for f in ("summary.json", "summary.previous.json", "fields_0000.vtkhdf")],
      [False, True, True])

# Corrupt numbers in a checkpoint are reported as an error in the file.
sound = (work / "SIGTERM_1_1" / "checkpoint.h5").read_bytes()
changed = 0
for at in range(len(sound) // 2, len(sound) // 2 + 3):
    damaged = bytearray(sound)
    damaged[at] ^= 0x10
    (work / "damaged.h5").write_bytes(damaged)
    code, text, _ = run(1, OPEN, *MESH, "--quiet", "--restart", work / "damaged.h5", "--output", work / "damaged")
    check(f"a checkpoint with byte {at} changed", (code, "damaged.h5" in text and "checksum" in text), (3, True))

# All ranks end with the same exit code; a quiet launcher adds no output.
quiet = subprocess.run([*options.mpirun.split(), "-q", "-np", "2", options.solve, str(OPEN), "--set", "Outer Solver/Tolerence=1"],
                       capture_output=True, text=True)
check("a refusal under mpirun -q", (quiet.returncode, quiet.stdout), (3, ""))
check("is our message alone", quiet.stderr, lambda t: t.startswith("suture_solve: 1 error in") and "mpirun" not in t and "-----" not in t)

finish()
