#!/usr/bin/python3
"""The installed Python package, found by PYTHONPATH.

check_python.py PREFIX --build DIR --source ROOT: imports the package, solves a scene from arrays, plots it, and prints, and fails for,
- modules, libraries or programs' modules that are loaded from the build folder or the sources instead of PREFIX;
- source modules that are not installed;
- a result that is not the exact one.
"""
import argparse
import pathlib
import sys


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("prefix", type=pathlib.Path)
    parser.add_argument("--build", type=pathlib.Path, required=True)
    parser.add_argument("--source", type=pathlib.Path, required=True)
    options = parser.parse_args()
    prefix, problems = options.prefix.resolve(), []

    import suture

    package = pathlib.Path(suture.__file__).resolve().parent
    if prefix not in package.parents:
        problems.append(f"suture is imported from {package}")
    there = {file.name for file in package.glob("*.py")}
    problems += [f"{file.name} is not installed" for file in (options.source / "python/suture").glob("*.py") if file.name not in there]

    # A square under tension, u_y = p / E y.
    mesh = suture.mesh_from_arrays([[0, 0], [1, 0], [1, 1], [0, 1]], {"triangle": [[0, 1, 2], [0, 2, 3]]}, {"square": [0, 1]},
                                   {"bottom": [[0, 1]], "left": [[3, 0]], "top": [[2, 3]]})
    result = suture.solve({
        "Mesh": mesh, "Bodies": {"square": {"Material": "rubber"}}, "Materials": {"rubber": {"Young Modulus": 2e6, "Poisson Ratio": 0}},
        "Boundary Conditions": {"ground": {"Group": "bottom", "Type": "Bilateral"}, "wall": {"Group": "left", "Type": "Bilateral"},
                                "pull": {"Group": "top", "Type": "Traction", "Value": [0, 1e4]}}})
    if abs(result.probe([0.5, 1.0], "displacement")[1] - 0.005) > 1e-10:
        problems.append(f"displacement {result.probe([0.5, 1.0], 'displacement')}, expected 0.005")
    if not result.plot("scene")._repr_png_().startswith(b"\x89PNG"):
        problems.append("the plot is no PNG")

    loaded = {str(module.__file__) for module in sys.modules.values() if getattr(module, "__file__", None)}
    loaded |= {line.split()[-1] for line in pathlib.Path("/proc/self/maps").read_text().splitlines() if "suture" in line and "/" in line}
    for file in sorted(loaded):
        path = pathlib.Path(file).resolve()
        ours = [name for name in (*path.parts, path.name) if name.startswith(("suture", "_suture", "libsuture"))]
        if ours and path != pathlib.Path(__file__).resolve() and prefix not in path.parents:
            problems.append(f"{file} is loaded, which is not installed")
    for problem in problems:
        print(problem)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
