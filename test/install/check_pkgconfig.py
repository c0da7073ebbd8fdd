#!/usr/bin/python3
"""Use of Suture by pkg-config alone, and consistent versions.

check_pkgconfig.py PREFIX --source ROOT --work DIR --compiler "c++ ..." [--libdir lib] [--bindir bin]: compiles test/install/pkgconfig/versions.cpp and the example
embedding with what `pkg-config --cflags --libs suture` prints, runs both, and compares the versions of CMakeLists.txt, CITATION.cff, headers, library, suture_solve,
find_package and pkg-config. Prints, and fails for, each that differs.
"""
import argparse
import os
import pathlib
import re
import subprocess
import sys


def run(command, **more):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **more)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, command))}: exit code {done.returncode}\n{done.stdout}")
    return done.stdout


def found(pattern, text, what):
    match = re.search(pattern, text, flags=re.M)
    return match[1] if match else f"none in {what}"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("prefix", type=pathlib.Path)
    parser.add_argument("--source", type=pathlib.Path, required=True)
    parser.add_argument("--work", type=pathlib.Path, required=True)
    parser.add_argument("--compiler", required=True)
    parser.add_argument("--libdir", default="lib")
    parser.add_argument("--bindir", default="bin")
    options = parser.parse_args()
    options.work.mkdir(parents=True, exist_ok=True)
    lib = options.prefix / options.libdir
    environment = dict(os.environ, PKG_CONFIG_PATH=str(lib / "pkgconfig"))

    def pkgConfig(*words):
        return run(["pkg-config", *words, "suture"], env=environment).strip()

    headers = pkgConfig("--cflags").split()
    libraries = pkgConfig("--libs").split() + ["-Wl,-rpath," + pkgConfig("--variable=libdir")]

    def compiled(file):
        program = options.work / file.stem
        run([*options.compiler.split(), "-std=c++17", "-c", file, "-o", f"{program}.o", *headers])
        run([*options.compiler.split(), f"{program}.o", "-o", program, *libraries])
        return run([program])

    numbers, text, library = compiled(options.source / "test/install/pkgconfig/versions.cpp").split()
    cmake = (options.source / "CMakeLists.txt").read_text()
    citation = (options.source / "CITATION.cff").read_text()
    package = (lib / "cmake/Suture/SutureConfigVersion.cmake").read_text()
    versions = {
        "project() of CMakeLists.txt": found(r"^project\(Suture VERSION ([\d.]+)", cmake, "CMakeLists.txt"),
        "CITATION.cff": found(r"^version: *([\d.]+)$", citation, "CITATION.cff"),
        "SUTURE_VERSION_MAJOR, _MINOR, _PATCH": numbers,
        "SUTURE_VERSION": text,
        "suture::version()": library,
        "suture_solve --version": found(r"suture_solve ([\d.]+)", run([options.prefix / options.bindir / "suture_solve", "--version"]), "its output"),
        "find_package(Suture)": found(r'set\(PACKAGE_VERSION "([\d.]+)"\)', package, "SutureConfigVersion.cmake"),
        "pkg-config --modversion suture": pkgConfig("--modversion"),
    }
    if len(set(versions.values())) != 1:
        sys.exit("versions differ:\n" + "\n".join(f"  {version:8} {what}" for what, version in versions.items()))

    # Two blocks pressed together, strain .05: 1e5 Pa everywhere.
    printed = compiled(options.prefix / "share/suture/drivers/examples/embedding/TwoBlocks.cpp").strip()
    if printed != "17 pairs, pressures from 100000 to 100000 Pa":
        sys.exit(f"the example embedding prints '{printed}'")
    print(f"version {text} everywhere; by pkg-config: {printed}")


if __name__ == "__main__":
    main()
