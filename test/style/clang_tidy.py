"""Runs clang-tidy with the checks of .clang-tidy on the sources and headers of packages/ and reports what it finds.

    clang_tidy.py --source DIR --build DIR --work DIR [--tidy clang-tidy] [PACKAGE ...]

PACKAGE: these packages only; without names all. The build folder must have compile_commands.json, and its library must have been built
once, since a header is written then. The sources of a package are checked as one, as their common headers take longer to read than the
sources. Exit code 1 where a check fires.
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


def joined(units, work):
    """One unit for all that are compiled by the same command."""
    groups = {}
    for unit in units:
        groups.setdefault((unit["directory"], re.sub(r" -o \S+ -c \S+$", "", unit["command"])), []).append(unit["file"])
    units = []
    for (directory, command), files in groups.items():
        source = work / f"joined_{len(units)}.cpp"
        source.write_text("".join(f'#include "{file}"\n' for file in sorted(set(files))))
        units.append({"directory": directory, "command": f"{command} -c {source}", "file": str(source)})
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
    wanted = "|".join(options.packages) if options.packages else "[a-z]+"
    units = [unit for unit in commands(options.build, options.work.resolve()) if re.search(rf"/packages/({wanted})/", unit["file"])]
    if not units:
        print("no sources found")
        return 1
    units = joined(units, options.work.resolve())
    (options.work / "compile_commands.json").write_text(json.dumps(units))

    def tidy(file):
        run = subprocess.run([options.tidy, "-p", str(options.work), "--quiet", f"--config-file={options.source / '.clang-tidy'}",
                              "--extra-arg=-Wno-everything", file], capture_output=True, text=True)
        # Headers are reached through links in the build folder: findings name the file itself.
        lines = re.finditer(r"^(/[^:\n]+)(:.*(?:warning|error): .*\[[\w.,-]+\])$", run.stdout, re.M)
        found = {os.path.realpath(line[1]) + line[2] for line in lines}
        if run.returncode and not found:
            found = {f"{file}: clang-tidy ended with {run.returncode}: {(run.stderr + run.stdout).strip()[-400:]}"}
        return found

    with concurrent.futures.ThreadPoolExecutor(int(os.environ.get("JOBS", os.cpu_count()))) as pool:
        found = sorted(set().union(*pool.map(tidy, [unit["file"] for unit in units])))
    for line in found:
        print(line)
    print(f"{len(units)} units, {len(found)} findings")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
