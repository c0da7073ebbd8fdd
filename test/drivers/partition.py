"""suture_partition as a user runs it: solving on the file that it writes gives the same result as the scene.

partition.py --partition PROGRAM --solve PROGRAM --mpirun "mpirun ..." --work DIR --input FOLDER
"""
import json
import pathlib
import re

from harness import arguments, check, finish, run

options = arguments("--partition", "--solve", "--input")
work = options.work
SCENE = pathlib.Path(options.input) / "two_blocks" / "two_blocks.xml"
METIS = ["--set", "Partition/Type=METIS", "--set", "Partition/METIS/Subdomains=6", "--set", "Outer Solver/Tolerance=1e-10"]


def solve(name, scene, ranks, *words):
    code, text = run(options.solve, ranks, scene, "--output", work / name, *words)
    check(name + ": solved", code, 0)
    return json.loads((work / name / "summary.json").read_text()) if code == 0 else {}


def readingFrom(mesh):
    """The scene with its mesh read from a file, as a user would write it."""
    text = re.sub(r'<ParameterList name="Mesh">.*?</ParameterList>\s*(?=<ParameterList name="Bodies">)',
                  f'<ParameterList name="Mesh"><Parameter name="File" type="string" value="{mesh}"/></ParameterList>\n', SCENE.read_text(), flags=re.S)
    path = work / (mesh.stem + ".xml")
    path.write_text(text)
    return path


whole = solve("whole", SCENE, 2, *METIS)
for ranks in (1, 2, 4):
    mesh = work / f"cut{ranks}.h5"
    code, text = run(options.partition, ranks, SCENE, "--output", mesh, *METIS)
    check(f"np{ranks}: exit code", code, 0)
    check(f"np{ranks}: number of elements", f": {whole['elements']:,} elements, subdomains cut_*" in text, True)
    check(f"np{ranks}: prints what to write into the scene", "Partitioned Mesh" in text and "cut_*" in text, True)
    named = ["--set", "Partition/Type=Named Groups", "--set", "Partition/Named Groups/Pattern=cut_*", "--set", "Outer Solver/Tolerance=1e-10"]
    again = solve(f"again{ranks}", readingFrom(mesh), ranks, *named)
    for key in ("subdomains", "elements", "dofs", "interface_dofs"):
        check(f"np{ranks}: {key}", again[key], whole[key])
    check(f"np{ranks}: closed pairs", again["contact"]["active"], whole["contact"]["active"])
    check(f"np{ranks}: energy", again["energy"] / whole["energy"] - 1, lambda e: abs(e) < 1e-10)
check("the same file on one and on four ranks", (work / "cut1.h5").stat().st_size, (work / "cut4.h5").stat().st_size)

# Each rank reads only its subdomains, with other numbers of ranks than the file was made with; both formulations.
PARTITIONED = ["--set", "Partition/Type=Partitioned Mesh", "--set", "Outer Solver/Tolerance=1e-10"]
GROUPS = ["--set", "Formulation=Condensed Groups", "--set", "Outer Solver/Type=Semismooth Newton", "--set", "Preconditioner/Type=Neumann-Neumann"]
scene = readingFrom(work / "cut2.h5")
# The patch test's exact solution: in a partitioned mesh the sides of the contact line, on which the pressure is measured, are partitioned, too.
EXACT = [word for name, text in (("Displacement x", "0"), ("Displacement y", "-0.05*(1 + y)"), ("Stress xx", "0"), ("Stress yy", "-1e5"),
                                 ("Stress xy", "0"), ("Pressure", "1e5")) for word in ("--set", f"Exact Solution/{name}={text}")]
for ranks in (1, 2, 4):
    for name, words in (("interface", []), ("groups", GROUPS), ("monolithic", ["--set", "Outer Solver/Type=Monolithic"])):
        read = solve(f"read_{name}{ranks}", scene, ranks, *PARTITIONED, *words, *EXACT)
        for key in ("subdomains", "elements", "dofs", "nodes", "mesh_hash"):
            check(f"partitioned, {name}, np{ranks}: {key}", read[key], whole[key])
        check(f"partitioned, {name}, np{ranks}: closed pairs", read["contact"]["active"], whole["contact"]["active"])
        for norm in ("displacement_l2", "energy_norm", "pressure_l2"):
            check(f"partitioned, {name}, np{ranks}: {norm}", read["error"][norm + "_relative"], lambda e: e < 1e-8)
        check(f"partitioned, {name}, np{ranks}: energy", read["energy"] / whole["energy"] - 1, lambda e: abs(e) < 1e-10)
for ranks in (1, 2):
    other = [*PARTITIONED, "--set", "Boundary Conditions/press/Value={0.0, -0.2}"]
    code, text = run(options.solve, ranks, scene, "--output", work / "other", *other)
    check(f"np{ranks}: cut for other prescribed values: exit code", code, 3)
    check(f"np{ranks}: cut for other prescribed values: names the list, and no other",
          ("Boundary Conditions: changed since" in text, "Contact: changed" in text, "Bodies: changed" in text), (True, False, False))
    code, text = run(options.solve, ranks, scene, "--output", work / "other", *PARTITIONED, "--set", "Materials/rubber/Young Modulus=1e9")
    check(f"np{ranks}: cut for other materials, which share a curve otherwise: exit code and list", (code, "Materials: changed since" in text),
          (3, True))
    code, text = run(options.solve, ranks, SCENE, "--output", work / "other", *PARTITIONED)
    check(f"np{ranks}: a scene that generates its mesh: exit code and why", (code, "needs a Mesh/File written by suture_partition" in text), (3, True))
    (work / "short.h5").write_bytes((work / "cut2.h5").read_bytes()[:-3000])
    code, text = run(options.solve, ranks, readingFrom(work / "short.h5"), "--output", work / "other", *PARTITIONED)
    check(f"np{ranks}: a truncated file: exit code and name", (code, "short.h5" in text), (3, True))

mesh = work / "uncut.h5"
code, text = run(options.partition, 2, SCENE, "--output", mesh, "--no-cut", "--quiet")
check("--no-cut --quiet: exit code and silence", (code, text), (0, ""))
code, text = run(options.solve, 2, readingFrom(mesh), "--output", work / "other", *PARTITIONED)
check("--no-cut is not partitioned: exit code and what to do", (code, "run suture_partition, or choose" in text), (3, True))
again = solve("uncut", readingFrom(mesh), 2, *METIS)
check("--no-cut: energy", again["energy"] / whole["energy"] - 1, lambda e: abs(e) < 1e-10)

# Errors are reported on any number of ranks.
for ranks in (1, 2):
    # More subdomains than elements: cutting would fail if it were tried.
    impossible = ["--set", "Partition/Type=METIS", "--set", "Partition/METIS/Subdomains=1000000"]
    code, text = run(options.partition, ranks, SCENE, "--output", work / "again.h5", "--groups", "subdomain", *impossible)
    check(f"np{ranks}: a name that the mesh has: exit code", code, 3)
    check(f"np{ranks}: a name that the mesh has: refused before cutting", (text.count("  --groups: "), "Subdomains" in text), (1, False))
    check(f"np{ranks}: a name that the mesh has: writes nothing", (work / "again.h5").exists(), False)
    code, text = run(options.partition, ranks, SCENE, "--output", work / "no" / "such" / "folder.h5", *METIS)
    check(f"np{ranks}: cannot be written: exit code", code, 5)
    for name in ("again.xml", "again"):
        code, text = run(options.partition, ranks, SCENE, "--output", work / name)
        check(f"np{ranks}: output {name}: exit code", code, 2)
        check(f"np{ranks}: output {name}: prints what was found and expected", f"{name}', expected a file name that ends in .h5" in text, True)
        check(f"np{ranks}: output {name}: writes nothing", (work / name).exists(), False)
    code, text = run(options.partition, ranks, SCENE, "--output", work / "again.h5", "--set", "Partition/Type")
    check(f"np{ranks}: --set without a value: exit code and form", (code, "not of the form Path/To/Parameter=value" in text), (2, True))
    code, text = run(options.partition, ranks, SCENE, "--output", work / "again.h5", "--set", "Partition/Type=Partitioned Mesh")
    check(f"np{ranks}: already cut in this way: exit code and alternatives", (code, "choose METIS or Named Groups" in text), (3, True))
    check(f"np{ranks}: already cut in this way: writes nothing", (work / "again.h5").exists(), False)
    code, text = run(options.partition, ranks, SCENE, "--outptu", "x.h5")
    check(f"np{ranks}: misspelt option: exit code", code, 2)
    code, text = run(options.partition, ranks, SCENE, "--output", work / "again.h5", "--set", "Partition/METIS/Subdomian=6")
    check(f"np{ranks}: misspelt parameter: exit code and nearest name", (code, "Did you mean 'Subdomains'?" in text), (3, True))

finish()
