#!/usr/bin/python3
"""Hard cases (doc/validation.md): every formulation must match the monolithic reference, or refuse the case with a reason.

    hard_cases.py --list                                          the tests: one line "<variant>.<case> <ranks> [long]" each
    hard_cases.py <variant>.<case> --solve ... --work ... [--ranks N] [--mpirun ...]     one of them, by test/drivers/check_run.py

To test a new formulation or solver on all cases, add a line to VARIANTS.
"""
import json
import os
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
SOURCE = "doc/validation.md, hard cases: as the monolithic reference"

VARIANTS = {
    "condensed_groups": ["Formulation=Condensed Groups", "Outer Solver/Type=Semismooth Newton"],
    "condensed_groups_neumann_neumann": ["Formulation=Condensed Groups", "Outer Solver/Type=Semismooth Newton",
                                         "Preconditioner/Type=Neumann-Neumann"],
    "contact_on_the_interface": ["Formulation=Contact On The Interface", "Outer Solver/Type=Active Set"],
}
# Not in the default run, which has the formulation with its default preconditioner.
LONG = ["condensed_groups_neumann_neumann"]


def young(material, value):
    return [f"Materials/{material}/Young Modulus={value}"]


def each(name, value):
    return [f"Materials/{material}/{name}={value}" for material in ("soft", "hard")]


def poisson(value):
    return each("Poisson Ratio", value)


def boxes(name, value):
    return [f"Mesh/Boxes/{box}/{name}={value}" for box in ("lower", "upper")]


def bricks(*bodies):
    """Makes every second brick of these bodies hard."""
    return [f"Bodies/{body}/Regions/bricks/{name}" for body in bodies for name in (f"Group={body}_bricks_odd", "Material=hard")]


def metis(subdomains, seed=1):
    return ["Partition/Type=METIS", f"Partition/METIS/Subdomains={subdomains}", f"Partition/METIS/Seed={seed}"]


# Message of the Neumann problem of a group whose stiffness has eigenvalues at round-off level, whose kernel is therefore uncertain.
ILL = ["more mechanisms than", "known rigid modes"]
QUADS = boxes("Cell", "Quadrilateral4")
HANG = ["Boundary Conditions/wall/Type=Displacement", "Boundary Conditions/wall/Value={0.0, 0.1}"]
NOISE = [f"Boundary Conditions/noise/{setting}" for setting in ("Type=Random Load", "Amplitude=1e-5", "Seed=3")]


def inSpace():
    """Cases of lifted_block_3d.xml, in the form of cases(); "long": not in the default run."""
    def wall(z):
        return ["Boundary Conditions/wall/Type=Displacement", f"Boundary Conditions/wall/Value={{0.0, 0.0, {z}}}"]

    def cells(cell, number):
        return boxes("Cell", cell) + boxes("Cells", f"{{{number}}}") + boxes("Blocks", "{3, 1, 1}")

    all = {"plain": {"set": [], "ranks": [1, 2]}}
    for jump in ("1e4", "1e8"):
        own = {
            "bricks_across_subdomains": bricks("lower", "upper"),
            "bricks_within_subdomains": bricks("lower", "upper") + boxes("Bricks", "{6, 2, 4}"),
            "bricks_metis": bricks("lower", "upper") + metis(16),
            "upper_harder": ["Bodies/upper/Material=hard"],
            "lower_harder": ["Bodies/lower/Material=hard"],
        }
        for name, settings in own.items():
            all[f"{name}_{jump}"] = {"set": settings + young("hard", jump), "long": jump == "1e4" or "within" in name}
            if jump == "1e8":
                all[f"{name}_{jump}"].update(floor=4e-6, displacement=4e-6, force=4e-6)
    for cell, number in (("Hexahedron8", "12, 4, 4"), ("Tetrahedron4", "9, 3, 3"), ("Tetrahedron10", "6, 2, 2")):
        all[f"poisson_0.4999_{cell}"] = {"set": poisson("0.4999") + cells(cell, number)}
    all["poisson_0.4999_locking_Tetrahedron4"] = {**all["poisson_0.4999_Tetrahedron4"]}
    all["poisson_0.4999_locking_Tetrahedron4"]["set"] = all["poisson_0.4999_Tetrahedron4"]["set"] + each("Allow Locking", "true")
    all["poisson_0.4999_Tetrahedron4"].update(ranks=[1], refused=["with 4-node tetrahedra", "they lock"])
    mortar = ["Mesh/Boxes/upper/Cells={9, 3, 3}", "Mesh/Boxes/upper/Blocks={3, 1, 1}"]
    all["mortar"] = {"set": mortar, "ranks": [1, 2]}
    all["mortar_Tetrahedron10"] = {"set": boxes("Cell", "Tetrahedron10") + boxes("Blocks", "{3, 1, 1}") +
                                   ["Mesh/Boxes/lower/Cells={6, 2, 2}", "Mesh/Boxes/upper/Cells={3, 3, 2}"], "ranks": [1, 2]}
    all["mortar_upper_harder_1e8"] = {"set": mortar + ["Bodies/upper/Material=hard"] + young("hard", "1e8"),
                                      "floor": 4e-6, "displacement": 4e-6, "force": 4e-6}
    # Cells of aspect ratio 1e3: layers in compact blocks, columns, plates.
    all["slivers"] = {"set": boxes("Cells", "{2, 1, 500}") + boxes("Blocks", "{2, 1, 2}")}
    # Bending sheets: elements without locking give the condition number of thin sheets, 5e7.
    all["slivers_upright"] = {"set": boxes("X", "{0, 0.012}") + ["Boundary Conditions/press/Value=1.0", "Outer Solver/Maximum Inner Iterations=5000"]}
    flat = boxes("X", "{0, 1000}") + boxes("Y", "{0, 250}")
    # Bending plates: round-off due to the condition number of thin plates.
    all["slivers_flat"] = {"set": flat + boxes("Blocks", "{3, 1, 1}"), "displacement": 1e-6}
    unreached = {variant: ILL if variant.startswith("condensed") else ["did not reach its tolerance"] for variant in VARIANTS}
    all["slivers_flat_in_layers"] = {"set": flat, "refuses": unreached, "long": True}
    all["one_subdomain_a_body"] = {"set": metis(2), "ranks": [1, 2]}
    all["more_ranks_than_subdomains"] = {"set": metis(3), "ranks": [6]}
    all["subdomains_of_one_cell"] = {"set": boxes("Cells", "{4, 1, 2}") + boxes("Blocks", "{1, 1, 1}") + boxes("Bricks", "{1, 1, 1}") +
                                    metis(16)}
    all["complete_loss_of_contact"] = {
        "set": wall(0.1) + ["Boundary Conditions/press/Value=0.0"], "ranks": [1, 2],
        "force": None, "checks": [{"key": "contact.active", "value": 0, "source": "lifted by its walls, and at its end"}]}
    all["hangs_on_one_end"] = {"set": wall(0.1) + ["Boundary Conditions/wall/Group=upper_left"]}
    all["interference"] = {"set": ["Contact/joint/Initial Gap=-1e-3"], "ranks": [1, 2]}
    all["wedge_of_gap"] = {"set": ["Contact/joint/Initial Gap=1e-3*(x - 2)"]}
    all["grazing"] = {
        "set": wall(0.0) + ["Boundary Conditions/press/Value=0.0", "Boundary Conditions/lift/Value={0.0, 0.0, 0.0}"],
        "displacement": None, "force": None,  # zero, both
        "checks": [{"key": key, "value": 0.0, "absolute": 1e-14, "source": "no load"}
                   for key in ("max_displacement", "contact.max_pressure")]}
    all["random_load_on_bricks"] = {"set": bricks("lower", "upper") + young("hard", "1e4") + NOISE + metis(16)}
    all["pushed_away"] = {"set": ["Boundary Conditions/press/Value=-1e-3"], "refused": ["Bodies/upper: body 'upper' can move up"]}
    all["slides_freely"] = {"set": ["Boundary Conditions/wall/Group=upper_left"], "refused": ["Bodies/upper"]}
    return {f"space_{name}": {"scene": "lifted_block_3d.xml", **own} for name, own in all.items()}


def cases():
    """name -> settings ("set"), "ranks", the solver's "tolerance", its own checks; tolerances of the differences "displacement" and
    "force" (1e-7, 1e-6) and "status" (0) from the reference, or None; "refused": message of all variants, with exit code 3, or "refuses":
    {variant: message, with exit code 4}."""
    all = {"plain": {"set": [], "ranks": [1, 2, 4]}}
    for jump in ("1e4", "1e6", "1e8"):
        own = {
            "bricks_across_subdomains": bricks("lower", "upper"),
            "bricks_within_subdomains": bricks("lower", "upper") + boxes("Bricks", "{6, 3}"),
            "bricks_of_one_cell": bricks("lower", "upper") + boxes("Bricks", "{1, 1}") + QUADS,
            "bricks_metis": bricks("lower", "upper") + metis(40),
            "upper_harder": ["Bodies/upper/Material=hard"],
            "lower_harder": ["Bodies/lower/Material=hard"],
        }
        for name, settings in own.items():
            all[f"{name}_{jump}"] = {"set": settings + young("hard", jump)}
    # Stiffness times displacement loses as many digits as the jump has, which bounds the residual from below.
    all["bricks_within_subdomains_1e6"]["tolerance"] = all["bricks_metis_1e6"]["tolerance"] = 1e-9
    # Round-off leaves 1e-10 to 1e-7 of the residual, varying per step: 1e-10 would be met only by chance (once in 47 steps).
    all["upper_harder_1e8"]["tolerance"] = 1e-12
    all["bricks_within_subdomains_1e8"]["refuses"] = {"condensed_groups_neumann_neumann": ILL}
    # Accuracy limit of double precision, at any tolerance. In hard bricks within a subdomain, rigid motion and deformation cannot be
    # distinguished.
    for name, floor in (("upper_harder_1e8", 1e-6), ("bricks_within_subdomains_1e8", 4e-6)):
        all[name].update(floor=floor, displacement=floor, force=floor)
    all["bricks_metis_1e8"]["refuses"] = {"condensed_groups_neumann_neumann": ILL}
    for ratio in ("0.49", "0.4999"):
        all[f"poisson_{ratio}"] = {"set": poisson(ratio) + each("Allow Locking", "true")}
        all[f"poisson_{ratio}_quadrilaterals"] = {"set": poisson(ratio) + QUADS}
        for cell in ("Quadrilateral4", "Quadrilateral9", "Triangle6"):
            all[f"poisson_{ratio}_mixed_{cell}"] = {"set": poisson(ratio) + each("Element", "Mixed") + boxes("Cell", cell)}
    # Elements of aspect ratio 1e3: in compact blocks, in columns, in strips too slender to resist bending.
    all["slivers"] = {"set": boxes("Cells", "{4, 1000}")}
    all["slivers_upright"] = {"set": boxes("X", "{0, 0.004}") + ["Boundary Conditions/press/Value=0.1", "Boundary Conditions/lift/Value={0, 1e-4}"]}
    all["slivers_flat"] = {"set": boxes("X", "{0, 4000}")}
    all["quadrilaterals"] = {"set": QUADS, "ranks": [1, 2, 4]}
    all["quadrilaterals_random_load"] = {"set": QUADS + NOISE, "ranks": [1, 2, 4]}
    all["random_load_on_bricks"] = {"set": bricks("lower", "upper") + young("hard", "1e4") + NOISE + metis(40), "ranks": [1, 2, 4]}
    all["one_subdomain_a_body"] = {"set": metis(2), "ranks": [1, 4]}
    all["more_ranks_than_subdomains"] = {"set": metis(3), "ranks": [6]}
    few = boxes("Cells", "{9, 2}") + boxes("Bricks", "{9, 1}") + boxes("Blocks", "{1, 1}")
    all["subdomains_of_one_quadrilateral"] = {"set": few + QUADS + metis(36)}
    all["subdomains_of_one_triangle"] = {"set": few + metis(72)}
    all["complete_loss_of_contact"] = {
        "set": HANG + ["Boundary Conditions/press/Value=0.0"],
        "force": None, "checks": [{"key": "contact.active", "value": 0, "source": "lifted by its wall, and at its end"}]}
    all["hangs_on_one_end"] = {"set": HANG}
    all["grazing"] = {
        "set": ["Boundary Conditions/wall/Type=Displacement", "Boundary Conditions/wall/Value={0.0, 0.0}",
                "Boundary Conditions/press/Value=0.0", "Boundary Conditions/lift/Value={0.0, 0.0}"],
        "displacement": None, "force": None,  # zero, both
        "checks": [{"key": key, "value": 0.0, "absolute": 1e-14, "source": "no load"}
                   for key in ("max_displacement", "contact.max_pressure")]}
    # No solution, or more than one: refused by all variants before solving.
    all["pushed_away"] = {"set": ["Boundary Conditions/press/Value=-1e-3"], "refused": ["Bodies/upper: body 'upper' can move up"]}
    all["slides_freely"] = {"set": ["Boundary Conditions/wall/Group=upper_top"], "refused": ["Bodies/upper"]}
    return {**all, **inSpace()}


def case(variant, name):
    own = cases()[name]
    settings = [argument for setting in own["set"] for argument in ("--set", setting)]
    mine = [argument for setting in VARIANTS[variant] for argument in ("--set", setting)]
    tolerance = f"Outer Solver/Tolerance={own.get('tolerance', 1e-10)}"
    settings += ["--set", tolerance]
    made = {"scene": os.path.join(HERE, own.get("scene", "lifted_block.xml")), "timeout": 120, "arguments": settings + mine}
    if "refused" in own:
        return {**made, "exit_code": 3, "message": own["refused"]}
    if variant in own.get("refuses", {}):
        return {**made, "exit_code": 4, "message": own["refuses"][variant]}
    # Monolithic needs no tolerance; its verdict uses the default.
    made["against"] = [*settings[:settings.index(tolerance) - 1], *settings[settings.index(tolerance) + 1:], "--set", "Outer Solver/Type=Monolithic"]
    made["checks"] = [{"key": "converged", "value": True, "source": SOURCE},
                      {"key": "equilibrium.imbalance", "max": max(1e-8, 20 * own.get("tolerance", 0.0), own.get("floor", 0.0)),
                       "source": "balance of forces, to the tolerance or the round-off of a jump by 1e6"}]
    # On the interface hard subdomains keep their fluxes in equilibrium: the residual falls below the round-off level of groups.
    if "floor" in own and variant != "contact_on_the_interface" and not name.startswith("space_"):
        made["message"] = ["the residual stagnates at round-off"]
    made["checks"] += own.get("checks", [])
    for figure, default in (("displacement", 1e-7), ("force", 1e-6), ("status", 0)):
        tolerance = own.get(figure, default)
        if tolerance is not None:
            made["checks"].append({"figure": "difference." + figure, "max": tolerance, "source": SOURCE})
    return made


def isLong(variant, name, own):
    return variant in LONG or own.get("long", False) or (name.startswith("space_") and variant != "contact_on_the_interface")


if __name__ == "__main__":
    if sys.argv[1] == "--list":
        for variant in VARIANTS:
            for name, own in cases().items():
                print(f"{variant}.{name}", ",".join(map(str, own.get("ranks", [2]))), "long" if isLong(variant, name, own) else "")
        sys.exit(0)
    work = sys.argv[sys.argv.index("--work") + 1]
    os.makedirs(os.path.dirname(os.path.abspath(work)), exist_ok=True)
    with open(work + ".case.json", "w") as file:
        json.dump(case(*sys.argv[1].split(".", 1)), file, indent=1)
    check = os.path.join(HERE, "..", "drivers", "check_run.py")
    sys.exit(subprocess.run([sys.executable, "-B", check, work + ".case.json", "-"] + sys.argv[2:]).returncode)
