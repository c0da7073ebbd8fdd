"""The C++ sources are formatted as .clang-format says.  clang_format.py [--format clang-format] SOURCE"""
import argparse
import pathlib
import subprocess
import sys

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("--format", default="clang-format")
parser.add_argument("source", type=pathlib.Path)
options = parser.parse_args()
files = [str(file) for folder in ("packages", "drivers", "python", "test") for ending in ("hpp", "cpp")
         for file in sorted((options.source / folder).rglob(f"*.{ending}")) if "build" not in file.relative_to(options.source).parts]
found = []
for first in range(0, len(files), 100):
    done = subprocess.run([options.format, "--dry-run", *files[first:first + 100]], capture_output=True, text=True)
    found += [line for line in done.stderr.split("\n") if "[-Wclang-format-violations]" in line]
print("\n".join(found) + f"\n{len(files)} files, {len(found)} places that clang-format would change")
sys.exit(1 if found or not files else 0)
