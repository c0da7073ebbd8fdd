#!/usr/bin/python3
"""Recipes of packaging/ against CMake.

check_recipes.py ROOT: prints, and fails for,
- versions of Suture or CMake in a recipe that are not those of CMakeLists.txt;
- dependencies of cmake/dependencies.cmake, and imports of the Python programs, that are missing in a recipe or in cmake/bootstrap.sh;
- a Python recipe that does not compile, a YAML recipe that cannot be read, Trilinos variants without a library that CMake links.
"""
import ast
import pathlib
import re
import subprocess
import sys

import yaml

# Dependencies of CMake or Python: their names in Spack, conda and Debian.
NAMES = {
    "MPI": ("mpi", "openmpi", "libopenmpi-dev"),
    "Trilinos": ("trilinos", "trilinos", "libtrilinos-tpetra-dev"),
    "Eigen3": ("eigen", "eigen", "libeigen3-dev"),
    "CLI11": ("cli11", "cli11", "libcli11-dev"),
    "nlohmann_json": ("nlohmann-json", "nlohmann_json", "nlohmann-json3-dev"),
    "cholmod": ("suite-sparse", "suitesparse", "libsuitesparse-dev"),
    "metis": ("metis", "metis", "libmetis-dev"),
    "muparser": ("muparser", "muparser", "libmuparser-dev"),
    "blas": ("openblas", "openblas", "libopenblas-dev"),
    "gmsh": ("gmsh", "gmsh", "libgmsh-dev"),
    "OpenMP": ("cxx", "libgomp", "g++"),
    "HDF5": ("hdf5", "hdf5", "libhdf5-openmpi-dev"),
    "numpy": ("py-numpy", "numpy", "python3-numpy"),
    "h5py": ("py-h5py", "h5py", "python3-h5py"),
    "matplotlib": ("py-matplotlib", "matplotlib-base", "python3-matplotlib"),
    "PIL": ("py-pillow", "pillow", "python3-pil"),
    "meshio": ("py-meshio", "meshio", "python3-meshio"),
    "netCDF4": ("py-netcdf4", "netcdf4", "python3-netcdf4"),
}


def imports(root):
    """Third-party modules imported by the installed Python programs."""
    own = {path.stem for path in root.glob("drivers/*/*")} | {path.stem for path in root.glob("drivers/*/*/*")}
    found = set()
    for file in [path for folder in ("plot", "convert") for path in (root / "drivers" / folder).rglob("*") if path.is_file() and path.suffix in ("", ".py")]:
        for node in ast.walk(ast.parse(file.read_text())):
            if isinstance(node, ast.Import):
                found |= {alias.name.split(".")[0] for alias in node.names}
            elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
                found.add(node.module.split(".")[0])
    return {name for name in found if name not in sys.stdlib_module_names and name not in own and not name.startswith("suture")}


def spackRecipe(file):
    """Version and dependencies, name -> whole specification."""
    version, needs = None, {}
    for node in ast.walk(ast.parse(file.read_text(), file.name)):
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.args and isinstance(node.args[0], ast.Constant):
            if node.func.id == "version":
                version = node.args[0].value
            elif node.func.id == "depends_on":
                needs[re.split(r"[@ +~]", node.args[0].value)[0]] = node.args[0].value
    return version, needs


def condaRecipe(file):
    text = re.sub(r"{{\s*compiler\(\"(\w+)\"\)\s*}}", r"\1", file.read_text())
    recipe = yaml.safe_load(re.sub(r"#\s*\[.*?\]", "", text))
    needs = {}
    for part in recipe["requirements"].values():
        needs.update({spec.split()[0]: spec for spec in part})
    return str(recipe["package"]["version"]), needs


def main():
    root = pathlib.Path(sys.argv[1])
    cmake = (root / "CMakeLists.txt").read_text()
    version = re.search(r"^project\(Suture VERSION ([\d.]+)", cmake, flags=re.M)[1]
    oldest = re.search(r"^cmake_minimum_required\(VERSION ([\d.]+)", cmake, flags=re.M)[1]
    dependencies = (root / "cmake/dependencies.cmake").read_text()
    wanted = set(re.findall(r"^ *find_package\((\w+)", dependencies, flags=re.M)) | set(re.findall(r"^ *suture_find_library\((\w+)", dependencies, flags=re.M))
    python = imports(root)
    problems = [f"check_recipes.py does not know how '{name}' is called in Spack, conda and Debian" for name in sorted((wanted | python) - set(NAMES))]
    if len(wanted) < 10 or len(python) < 4:
        problems.append(f"only {sorted(wanted)} and {sorted(python)} were found in cmake/dependencies.cmake and drivers/")

    spackVersion, spack = spackRecipe(root / "packaging/spack/package.py")
    condaVersion, conda = condaRecipe(root / "packaging/conda/meta.yaml")
    listed = re.search(r'^packages="(.*?)"', (root / "cmake/bootstrap.sh").read_text(), flags=re.M | re.S)[1].split()
    for recipe, found in (("packaging/spack/package.py", spackVersion), ("packaging/conda/meta.yaml", condaVersion)):
        if found != version:
            problems.append(f"{recipe} has version {found}, CMakeLists.txt {version}")
    for name in sorted((wanted | python) & set(NAMES)):
        for recipe, needs, own in zip(("packaging/spack/package.py", "packaging/conda/meta.yaml", "cmake/bootstrap.sh"), (spack, conda, listed), NAMES[name]):
            if own not in needs:
                problems.append(f"{recipe} does not name {own} ({name})")
    deb = (root / "cmake/cpack.cmake").read_text()
    problems += [f"cmake/cpack.cmake does not name {NAMES[name][2]} ({name})" for name in sorted(python & set(NAMES)) if NAMES[name][2] not in deb]
    if f"@{oldest}:" not in spack.get("cmake", ""):
        problems.append(f"packaging/spack/package.py: CMakeLists.txt wants CMake {oldest}, the recipe '{spack.get('cmake')}'")
    if f">={oldest}" not in conda.get("cmake", ""):
        problems.append(f"packaging/conda/meta.yaml: CMakeLists.txt wants CMake {oldest}, the recipe '{conda.get('cmake')}'")
    for component in re.search(r"find_package\(Trilinos REQUIRED COMPONENTS ([\w ]+)\)", dependencies)[1].split():
        if component != "Teuchos" and f"+{component.lower()}" not in spack.get("trilinos", ""):
            problems.append(f"packaging/spack/package.py: trilinos without +{component.lower()}")

    # The Dockerfile has the guide's text, and scripts have valid sh syntax.
    docker = (root / "packaging/docker/Dockerfile").read_text()
    for words in ("FROM debian:bookworm", "cmake/bootstrap.sh build", "cpack -G DEB", "/suture_*.deb"):
        if words not in docker:
            problems.append(f"packaging/docker/Dockerfile has no '{words}'")
    for script in ("packaging/conda/build.sh", "packaging/deb/check.sh", "packaging/deb/prerm"):
        if subprocess.run(["sh", "-n", root / script]).returncode:
            problems.append(f"{script} is no script of sh")
    for script in ("packaging/docker/run_steps.py", "packaging/spack/package.py"):
        compile((root / script).read_text(), script, "exec")
    for problem in problems:
        print(problem)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
