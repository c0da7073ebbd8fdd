"""suture_partition in 3D: scenes solved on the files that it writes give the exact solution, on any number of ranks, in both formulations.

partition_in_space.py --partition PROGRAM --solve PROGRAM --mpirun "mpirun ..." --work DIR --input FOLDER
"""
import json
import math
import pathlib
import re

import h5py

from harness import arguments, check, finish, run, setting

options = arguments("--partition", "--solve", "--input")
work, INPUT = options.work, pathlib.Path(options.input)
PATCH = INPUT / "patch_3d" / "patch_3d.xml"
BALLS = INPUT / "spheres" / "spheres.xml"
TIGHT = setting("Outer Solver/Tolerance", "1e-12")
PARTITIONED = setting("Partition/Type", "Partitioned Mesh")
GROUPS = setting("Formulation", "Condensed Groups") + setting("Outer Solver/Type", "Semismooth Newton") + \
    setting("Preconditioner/Type", "Neumann-Neumann")


def reading(scene, mesh):
    """The scene with its mesh read from a file, as a user would write it."""
    text = re.sub(r'<ParameterList name="Mesh">.*?</ParameterList>\s*(?=<ParameterList name="Bodies">)',
                  f'<ParameterList name="Mesh"><Parameter name="File" type="string" value="{mesh}"/></ParameterList>\n',
                  scene.read_text(), flags=re.S)
    path = work / (mesh.stem + ".xml")
    path.write_text(text)
    return path


def cut(name, ranks, scene, *words):
    mesh = work / f"{name}.h5"
    code, text = run(options.partition, ranks, scene, "--output", mesh, *words)
    check(f"{name}: cut on {ranks} ranks", (code, "Partitioned Mesh" in text), (0, True))
    return reading(scene, mesh)


def solve(name, ranks, scene, *words):
    code, text = run(options.solve, ranks, scene, "--output", work / name, *words)
    check(f"{name} on {ranks} ranks: solved", code, 0)
    return json.loads((work / name / "summary.json").read_text()) if code == 0 else {}


# The patch test: sigma_zz = -p everywhere, energy -p^2 / 2 E over 1 m3, linear displacement.
EXACT = [word for name, text in (("Displacement x", "0.3*x/20"), ("Displacement y", "0.3*y/20"), ("Displacement z", "-(z + 0.5)/20"), ("Stress xx", "0"),
                                 ("Stress yy", "0"), ("Stress zz", "-1e5"), ("Stress xy", "0"), ("Stress yz", "0"), ("Stress xz", "0"), ("Pressure", "1e5"))
         for word in setting(f"Exact Solution/{name}", text)]
for cells, ranks in ((("Hexahedron8", "Tetrahedron10"), 2), (("Tetrahedron4", "Hexahedron27"), 1)):
    name = "_on_".join(cells)
    mesh = [word for box, cell, size in (("lower", cells[0], 4), ("upper", cells[1], 3))
            for word in setting(f"Mesh/Boxes/{box}/Cell", cell) + setting(f"Mesh/Boxes/{box}/Cells", f"{{{size}, {size}, 2}}")
            + setting(f"Mesh/Boxes/{box}/Blocks", "{1, 1, 1}")]
    scene = cut(name, ranks, PATCH, *mesh, *setting("Partition/Type", "METIS"), *setting("Partition/METIS/Subdomains", 6))
    with h5py.File(work / f"{name}.h5") as file:
        groups = [group[:] for group in file["ElementGroups"].values() if group.attrs["Name"].startswith("cut_")]
        elements = len(file["Cells"])
    check(f"{name}: six groups of elements, each element in one", (len(groups), sorted(e for group in groups for e in group) == list(range(elements))),
          (6, True))
    for run_ranks, way in ((1, []), (2, []), (2, GROUPS), (2, setting("Outer Solver/Type", "Monolithic"))):
        found = solve(f"{name}_{len(way)}", run_ranks, scene, *PARTITIONED, *TIGHT, *way, *EXACT)
        check("   subdomains", found["subdomains"], 6)
        check("   energy", found["energy"], lambda e: abs(e / -2500 - 1) < 1e-9)
        check("   force", abs(found["contact"]["force"]["joint"][2]), lambda f: abs(f / 1e5 - 1) < 1e-9)
        for norm in ("displacement_l2", "energy_norm", "pressure_l2"):
            check(f"   {norm}", found["error"][norm + "_relative"], lambda e: e < 1e-8)
    code, text = run(options.solve, 2, scene, "--output", work / "other", *PARTITIONED, *setting("Model", "Plane Strain"))
    check(f"{name}: another model is refused by name", (code, "Model: changed since" in text), (3, True))

# Curved non-matching sides from Gmsh: same result as without the file; the contact carries a quarter of the force F = 586080.6 N. (Second-order
# sides enclose a slightly smaller area than the circle.)
COARSE = setting("Mesh/Constants/resolution", 2)
METIS = setting("Partition/Type", "METIS") + setting("Partition/METIS/Subdomains", 5)
code, text = run(options.solve, 1, BALLS, "--check", "--no-drawing", *COARSE)
check("balls drawn to touch do not overlap", (code, "interference" in text), (0, False))
whole = solve("balls", 2, BALLS, *COARSE, *METIS)
scene = cut("balls_cut", 2, BALLS, *COARSE, *METIS)
for ranks, way in ((1, PARTITIONED), (2, PARTITIONED), (2, setting("Partition/Type", "Named Groups") + setting("Partition/Named Groups/Pattern", "cut_*"))):
    found = solve(f"balls_{len(way)}", ranks, scene, *way)
    for key in ("subdomains", "elements", "dofs", "interface_dofs"):
        check(f"   {key}", found[key], whole[key])
    check("   closed pairs", found["contact"]["active"], whole["contact"]["active"])
    check("   energy", found["energy"] / whole["energy"] - 1, lambda e: abs(e) < 1e-10)
    check("   force", found["contact"]["force"]["footprint"][2], lambda f: math.isclose(f, -586080.6 / 4, rel_tol=1e-3))
finish()
