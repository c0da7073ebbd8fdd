"""Common tools for the tests of the programs: options, an empty working folder, runs, and counted checks.

    from harness import arguments, check, finish, run
    options = arguments("--solve", "--input")       # both required, as are --mpirun and --work
    code, text = run(options.solve, 2, scene)
    check("exit code", code, 0)
    finish()
"""
import argparse
import functools
import os
import pathlib
import runpy
import shutil
import subprocess
import sys
import tempfile
import traceback

import sentences

SLOWER = float(os.environ.get("SUTURE_TIME_FACTOR", 1))  # factor on time limits, set by the test presets
SANITIZED = "ASAN_OPTIONS" in os.environ  # AddressSanitizer reserves 20 TB of address space: do not limit or measure memory then
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
    """One rank is started without mpirun, as most users do."""
    return [*(options.mpirun.split() + ["-np", str(ranks)] if ranks > 1 else []), str(program), *map(str, words)]


def run(program, ranks, *words, timeout=120):
    """Exit code and output, both streams."""
    done = subprocess.run(command(program, ranks, *words), capture_output=True, text=True, timeout=timeout * SLOWER)
    for fault in sentences.faults(done.stdout + done.stderr):
        check(f"{pathlib.Path(program).name} prints sentences", fault, "")
    return done.returncode, done.stdout + done.stderr


@functools.cache
def load_modules(program):
    """Imports the modules of a Python program into this process."""
    path = list(sys.path)
    try:
        runpy.run_path(str(program), run_name="imported")
    except SystemExit:
        pass  # a module is missing: the program itself reports it
    sys.path[:] = path


def forked(program, *words):
    """Exit code and output of a Python program, run in a fork of this process to reuse its imports."""
    load_modules(program)
    with tempfile.TemporaryFile("w+") as output:
        child = os.fork()
        if child == 0:
            for stream in (1, 2):
                os.dup2(output.fileno(), stream)
            sys.argv, code = [str(program), *map(str, words)], 0
            try:
                runpy.run_path(str(program), run_name="__main__")
            except SystemExit as end:
                code = end.code if isinstance(end.code, int) else int(end.code is not None)
            except BaseException:
                traceback.print_exc()
                code = 1
            sys.stdout.flush()
            sys.stderr.flush()
            os._exit(code)
        code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
        output.seek(0)
        return code, output.read()


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
