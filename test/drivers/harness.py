"""Tools that the tests of the programs have in common: options, an empty folder to work in, runs, and checks that are counted.

    from harness import arguments, check, finish, run
    options = arguments("--solve", "--input")       # each of them required, and --mpirun and --work
    code, text = run(options.solve, 2, scene)
    check("exit code", code, 0)
    finish()
"""
import argparse
import os
import pathlib
import shutil
import subprocess
import sys

SLOWER = float(os.environ.get("SUTURE_TIME_FACTOR", 1))  # limits of time are multiplied by it: the test presets set it
SANITIZED = "ASAN_OPTIONS" in os.environ  # AddressSanitizer takes 20 TB of addresses: no limit of them then, no measure of memory
failures = []
options = None


def arguments(*names, parser=None):
    """The command line's options; `work` is an empty folder."""
    global options
    parser = parser or argparse.ArgumentParser()
    for name in ("--mpirun", "--work", *names):
        parser.add_argument(name, required=True)
    options = parser.parse_args()
    options.work = pathlib.Path(options.work)
    shutil.rmtree(options.work, ignore_errors=True)
    options.work.mkdir(parents=True)
    return options


def command(program, ranks, *words):
    return [*options.mpirun.split(), "-np", str(ranks), str(program), *map(str, words)]


def run(program, ranks, *words, timeout=120):
    """Exit code and output, both streams."""
    done = subprocess.run(command(program, ranks, *words), capture_output=True, text=True, timeout=timeout * SLOWER)
    return done.returncode, done.stdout + done.stderr


def setting(path, value):
    return ["--set", f"{path}={value}"]


def check(what, found, expected):
    """`expected`: a value, or a function of what was found."""
    good = expected(found) if callable(expected) else found == expected
    print(("ok      " if good else "FAILED  ") + what + ("" if good else ": " + repr(found)), flush=True)
    if not good:
        failures.append(what)


def finish():
    if failures:
        print(f"\n{len(failures)} failed:\n  " + "\n  ".join(failures))
    sys.exit(1 if failures else 0)
