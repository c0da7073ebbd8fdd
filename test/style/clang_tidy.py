"""Runs clang-tidy with the checks of .clang-tidy on the sources of packages/ and reports what it finds.

    clang_tidy.py --source DIR --build DIR --work DIR [--tidy clang-tidy] [PACKAGE ...]

PACKAGE: these packages only; without names all. The build folder must have compile_commands.json. Exit code 1 where a check fires.
"""
import argparse
import concurrent.futures
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys


def commands(build, work):
    """compile_commands.json without the precompiled header of GCC, which Clang cannot read: its text is included instead."""
    copies = {}

    def plain(match):
        header = match[1]
        if header not in copies:
            copies[header] = work / f"headers_{len(copies)}.hxx"
            text = pathlib.Path(header).read_text() if os.path.exists(header) else ""
            copies[header].write_text(re.sub(r"^#pragma GCC system_header.*$", "", text, flags=re.M))
        return f"-include {copies[header]}"

    units = json.loads((build / "compile_commands.json").read_text())
    for unit in units:
        unit["command"] = re.sub(r"-include (\S+cmake_pch\.hxx)", plain, unit["command"]).replace("-Winvalid-pch", "")
    return units


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--source", type=pathlib.Path, required=True)
    parser.add_argument("--build", type=pathlib.Path, required=True)
    parser.add_argument("--work", type=pathlib.Path, required=True)
    parser.add_argument("--tidy", default="clang-tidy")
    parser.add_argument("packages", nargs="*")
    options = parser.parse_args()
    shutil.rmtree(options.work, ignore_errors=True)
    options.work.mkdir(parents=True)
    units = commands(options.build, options.work)
    (options.work / "compile_commands.json").write_text(json.dumps(units))
    wanted = "|".join(options.packages) if options.packages else "[a-z]+"
    files = sorted({unit["file"] for unit in units if re.search(rf"/packages/({wanted})/", unit["file"])})
    if not files:
        print("no sources found")
        return 1

    def tidy(file):
        return subprocess.run([options.tidy, "-p", str(options.work), "--quiet", f"--config-file={options.source / '.clang-tidy'}",
                               "--extra-arg=-Wno-everything", file], capture_output=True, text=True).stdout

    with concurrent.futures.ThreadPoolExecutor(int(os.environ.get("JOBS", os.cpu_count()))) as pool:
        found = sorted({line for text in pool.map(tidy, files) for line in text.split("\n") if re.search(r"(warning|error): .*\[[\w.,-]+\]$", line)})
    for line in found:
        print(line)
    print(f"{len(files)} units, {len(found)} findings")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
