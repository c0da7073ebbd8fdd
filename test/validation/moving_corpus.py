"""Random scenes of bodies that move far, in 2D and 3D: a block that slides and turns on a base, with friction up to 0.6, on one and on three
ranks. Each path is solved to its end, with the same forces on any number of ranks, and the normal force of statics.

  moving_corpus.py --solve build/drivers/suture_solve --output out --count 40 --first 1 --mpirun "mpirun --oversubscribe"
"""
import csv
import os
import random
import shlex
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import corpus_runs  # noqa: E402
from cyclic_paths import array, inner, parameter, real, text  # noqa: E402

LIMIT = 120   # seconds of a run
SAME = 1e-5   # forces on other numbers of ranks, relative to the weight
STATICS = 1e-5  # normal force against the weight
CELLS = ("Quadrilateral4", "Quadrilateral8", "Triangle3", "Triangle6")


class Scene:
    """A block of width `width` and height `height` under a weight, on a base from -`half` to `half`."""

    def __init__(self, seed):
        random_ = random.Random(seed)
        self.solid = random_.random() < 0.35
        self.friction = random_.choice([0.0, random_.uniform(0.0, 0.6), random_.uniform(0.1, 0.6)])
        self.width, self.height = random_.uniform(1, 3), random_.uniform(0.6, 2)
        self.half = random_.uniform(1.5, 3) * self.width
        self.cells = [random_.randint(3, 5), random_.randint(5, 9)] if self.solid else [random_.randint(4, 12), random_.randint(6, 22)]
        self.cell = ["Hexahedron8"] * 2 if self.solid else [random_.choice(CELLS) if random_.random() < 0.3 else "Quadrilateral4" for _ in range(2)]
        self.young = [10 ** random_.uniform(3, 6)]
        self.young.append(self.young[0] * 10 ** random_.uniform(-1, 1))
        self.poisson = random_.uniform(0, 0.4)
        self.weight = self.young[0] * 10 ** random_.uniform(-4, -2) * self.width
        self.slide = random_.uniform(-0.8, 0.8) * self.half
        self.aside = random_.uniform(-0.5, 0.5) * self.half if self.solid else 0.0
        self.turn = random_.choice(["held", "turned", "free"])
        if self.turn == "free" and self.friction * self.height > 0.4 * self.width:
            self.turn = "held"  # it would topple: the drive pushes at its top
        self.angle = random_.uniform(-2, 2) if self.solid else random_.uniform(-0.15, 0.15)
        self.times = sorted({round(1 + k * random_.uniform(0.5, 1), 3) for k in range(random_.randint(2, 5))})

    def box(self, name, spans, cells, cell):
        axes = [array(axis, span) for axis, span in zip("XYZ", spans)]
        return inner(name, [*axes, array("Cells", cells, "int"), text("Cell", cell)])

    def boxes(self):
        w, h, l, (n, m) = self.width / 2, self.height, self.half, self.cells
        across = [[(-w, w)] * 2, [(-l, l)] * 2] if self.solid else [[(-w, w)], [(-l, l)]]
        counts = [[n] * len(across[0]), [m] * len(across[1])]
        return [*self.box("block", [*across[0], (0, h)], [*counts[0], max(2, n // 2)], self.cell[0]),
                *self.box("base", [*across[1], (-h, 0)], [*counts[1], 3 if self.solid else 4], self.cell[1])]

    def drive(self):
        up = [0.0] * (1 + self.solid)
        lines = [text("Group", "block_top"), text("Type", "Rigid Group"), array("Point", [*up, self.height]), real("Motion x", self.slide)]
        if self.solid:
            lines += [real("Motion y", self.aside), real("Rotation x", 0), real("Rotation y", 0),
                      real("Rotation z", 0 if self.turn == "held" else self.angle)]
        elif self.turn != "free":
            lines.append(real("Rotation z", 0 if self.turn == "held" else self.angle))
        return lines

    def xml(self):
        up = [0.0] * (1 + self.solid)
        law = [] if self.friction == 0 else [text("Law", "Coulomb"), *inner("Coulomb", [text("Coefficient", "%.17g" % self.friction)])]
        material = lambda young: [real("Young Modulus", young), real("Poisson Ratio", self.poisson)]
        end = self.times[-1] - 1 or 1
        return "\n".join(inner("Suture", [
            text("Model", "Solid" if self.solid else "Plane Strain"), text("Motion", "Moving"),
            *inner("Mesh", [text("Generator", "Boxes"), *inner("Boxes", self.boxes())]),
            *inner("Bodies", [*inner("block", [text("Material", "own")]), *inner("base", [text("Material", "other")])]),
            *inner("Materials", [*inner("own", material(self.young[0])), *inner("other", material(self.young[1]))]),
            *inner("Boundary Conditions", [
                *inner("drive", self.drive()),
                *inner("weight", [text("Group", "block_top"), text("Type", "Force"), array("Value", [*up, -self.weight])]),
                *inner("ground", [text("Group", "base_bottom"), text("Type", "Displacement"), array("Value", [0.0] * (2 + self.solid))])]),
            *inner("Load Steps", [array("Times", self.times), *inner("Factors", [text("drive", "(t - 1) / %.17g" % end)])]),
            *inner("Contact", inner("joint", [text("Side A", "block_bottom"), text("Side B", "base_top"), *law]))]))


def last_force(folder):
    """Force of the contact on the base at the end of the path."""
    with open(os.path.join(folder, "steps.csv")) as file:
        row = list(csv.DictReader(file))[-1]
    return [float(row["force joint " + axis]) for axis in "xyz"]


def play(options, seed):
    scene = Scene(seed)
    path = os.path.join(options.output, "%d.xml" % seed)
    with open(path, "w") as file:
        file.write(scene.xml())
    first, problem = None, ""
    for ranks in (1, 3):
        folder = os.path.join(options.output, "%d_%d" % (seed, ranks))
        command = [*(shlex.split(options.mpirun) + ["-np", str(ranks)] if ranks > 1 else []), options.solve, path, "--output", folder, "--set",
                   "Output/Fields=false"]
        try:
            run = subprocess.run(command, capture_output=True, text=True, timeout=LIMIT)
        except subprocess.TimeoutExpired:
            return {"seed": seed, "problem": "hang on %d ranks" % ranks}
        if run.returncode != 0:
            said = [line.strip() for line in (run.stdout + run.stderr).splitlines() if "not converged" in line or "error" in line]
            return {"seed": seed, "problem": "exit code %d on %d ranks: %s" % (run.returncode, ranks, (said or [""])[0])}
        force = last_force(folder)
        normal = -force[2 if scene.solid else 1]
        if abs(normal / scene.weight - 1) > STATICS:
            problem = "the normal force is %.9g, the weight %.9g" % (normal, scene.weight)
        first = first or force
        if max(abs(a - b) for a, b in zip(force, first)) > SAME * scene.weight:
            problem = "forces %s on %d ranks, %s on one" % (force, ranks, first)
    return {"seed": seed, "solid": scene.solid, "friction": scene.friction, "problem": problem}


def main():
    options = corpus_runs.parser(__doc__).parse_args()
    found = list(corpus_runs.results(options, play))
    bad = [one for one in found if one["problem"]]
    for one in bad:
        print("scene %d: %s" % (one["seed"], one["problem"]))
    print("%d scenes, %d in 3D, %d wrong" % (len(found), sum(one.get("solid", False) for one in found), len(bad)))
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
