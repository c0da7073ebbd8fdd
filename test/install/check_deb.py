#!/usr/bin/python3
"""Debian packages.

check_deb.py PREFIX --source ROOT --build DIR --work DIR: makes them by `cpack -G DEB` and prints, and fails for,
- files of PREFIX, a plain installation, that are in no package or in two;
- programs and libraries that are not stripped, or whose library path is not relative to themselves;
- empty fields that users of apt see, and missing dependencies;
- problems of check_python.py with the packages suture and python3-suture in one folder.
"""
import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys

FIELDS = ["Package", "Version", "Architecture", "Maintainer", "Section", "Priority", "Description", "Depends", "Installed-Size"]
# Programs that Suture starts, and linked libraries.
NEEDS = {"suture": ["openmpi-bin", "python3", "python3-numpy", "python3-h5py", "python3-matplotlib", "libc6", "libgmsh4.8", "libcholmod3", "libtrilinos-tpetra-13.2"],
         "suture-dev": ["suture", "libopenmpi-dev", "libeigen3-dev", "libtrilinos-tpetra-dev", "libtrilinos-intrepid2-dev", "libptscotch-dev", "libmumps-dev"],
         "python3-suture": ["suture", "python3", "python3-numpy", "python3-mpi4py"]}


def run(*command):
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout


def checkElf(name, file):
    dynamic = run("readelf", "-d", str(file))
    problems = [f"{name} looks for libraries in {path}" for path in re.findall(r"\((?:RPATH|RUNPATH)\).*\[(.*)\]", dynamic) if not re.fullmatch(r"\$ORIGIN(/[\w./-]+)?", path)]
    if ".symtab" in run("readelf", "-S", "-W", str(file)):
        problems.append(f"{name} is not stripped")
    return problems


def checkPython(options):
    """The Python package as it lies on Python's search path of a system."""
    root = options.work / "root"
    for package in ("suture", "python3-suture"):
        shutil.copytree(options.work / package, root, symlinks=True, dirs_exist_ok=True)
    check = pathlib.Path(__file__).resolve().parent / "check_python.py"
    done = subprocess.run(["/usr/bin/python3", "-B", check, root / "usr", "--build", options.build, "--source", options.source],
                          env=dict(os.environ, PYTHONPATH=str(root / "usr/lib/python3/dist-packages")), stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True)
    return [] if done.returncode == 0 else [f"python3-suture: {line}" for line in done.stdout.splitlines()[-20:]]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("prefix", type=pathlib.Path)
    for name in ("--source", "--build", "--work"):
        parser.add_argument(name, type=pathlib.Path, required=True)
    options = parser.parse_args()
    shutil.rmtree(options.work, ignore_errors=True)
    options.work.mkdir(parents=True)
    subprocess.run(["cpack", "-G", "DEB", "--config", options.build / "CPackConfig.cmake", "-B", options.work / "packages"], check=True, cwd=options.build)

    version = re.search(r"^project\(Suture VERSION ([\d.]+)", (options.source / "CMakeLists.txt").read_text(), flags=re.M)[1]
    problems, owner = [], {}
    for deb in sorted((options.work / "packages").glob("*.deb")):
        control = run("dpkg-deb", "-f", str(deb))
        fields = dict(re.findall(r"^([\w-]+): (.*)$", control, flags=re.M))
        package = fields.get("Package", deb.name)
        problems += [f"{package}: no {field}" for field in FIELDS if not fields.get(field)]
        if fields.get("Version") != version:
            problems.append(f"{package}: version {fields.get('Version')}, CMakeLists.txt has {version}")
        depends = {re.sub(r"[ :(].*", "", word.strip()) for word in re.split(r"[,|]", fields.get("Depends", ""))}
        problems += [f"{package} does not depend on {name}" for name in NEEDS.get(package, []) if name not in depends]
        if len(re.findall(r"^ \S", control, flags=re.M)) < 1:
            problems.append(f"{package}: the description is one line")

        folder = options.work / package
        run("dpkg-deb", "-x", str(deb), str(folder))
        for file in sorted(folder.rglob("*")):
            if file.is_dir() and not file.is_symlink():
                continue
            name = str(file.relative_to(folder / "usr"))
            if name in owner:
                problems.append(f"{name} is in {owner[name]} and in {package}")
            owner[name] = package
            if not file.is_symlink() and file.open("rb").read(4) == b"\x7fELF":
                problems += checkElf(name, file)
        if not (folder / "usr/share/doc" / package / "copyright").is_file():
            problems.append(f"{package} has no copyright")
    if not {"suture", "suture-dev"} <= set(owner.values()):
        problems.append(f"cpack made {sorted(set(owner.values()))}")

    installed = {str(file.relative_to(options.prefix)) for file in options.prefix.rglob("*") if file.is_symlink() or not file.is_dir()}
    problems += [f"{name} is installed and in no package" for name in sorted(installed - set(owner))]
    for name in ("include/suture/Version.hpp", "lib/pkgconfig/suture.pc"):
        if owner.get(name) != "suture-dev":
            problems.append(f"{name} is in {owner.get(name, 'no package')}, not in suture-dev")
    for name in ("bin/suture_solve", "share/suture/input/tunnel/tunnel.xml", "share/suture/materials.xml", "share/doc/suture/README.md"):
        if owner.get(name) != "suture":
            problems.append(f"{name} is in {owner.get(name, 'no package')}, not in suture")
    if "python3-suture" in owner.values():
        problems += checkPython(options)
    for problem in problems:
        print(problem)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
