#!/usr/bin/python3
"""The target that `bootstrap.sh build` makes has all files that `cmake --install` copies from the build folder: those that Ninja makes are
among its inputs, the others were written when the folder was configured. check_target.py NINJA BUILD BOOTSTRAP"""
import pathlib
import re
import subprocess
import sys

ninja, build, bootstrap = sys.argv[1], pathlib.Path(sys.argv[2]).resolve(), pathlib.Path(sys.argv[3]).read_text()
target = re.search(r"build\) configureAndBuild --target (\w+)", bootstrap).group(1)


def lines(*words):
    return subprocess.run([ninja, "-C", str(build), "-t", *words], capture_output=True, text=True, check=True).stdout.splitlines()


def full(path):
    return str((build / path).resolve())


made = {full(line.split(":")[0]) for line in lines("targets", "all")}
inputs = {full(line) for line in lines("inputs", target)}
wanted = set()
for script in build.rglob("cmake_install.cmake"):
    wanted |= {full(name) for name in re.findall(r'"(/[^"]*)"', script.read_text()) if name.startswith(str(build) + "/") and (build / name).suffix != ".cmake"}
wanted = {name for name in wanted if name in made or not pathlib.Path(name).exists()}
package = {full(f"python/suture/{name}.py") for name in ("__init__", "fields", "scenes")} if any("_suture" in name for name in made) else set()
missing = sorted((wanted | package) - inputs)
print(f"{target}: {len(wanted)} files that Ninja makes are installed, {len(package)} belong to the Python package")
for name in missing:
    print("is not made by " + target + ": " + name)
sys.exit(1 if missing or not any(name.endswith("suture_solve") for name in wanted) else 0)
