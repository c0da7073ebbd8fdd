"""Random paths of load steps that pass through zero, reverse and end at zero, with loaded and unloaded bodies: all methods and numbers of
ranks solve and verify each step with the same forces; without friction, forces depend only on the factors and vanish under zero loads.

  cyclic_paths.py --solve build/drivers/suture_solve --mpirun "mpirun --oversubscribe" --output out --count 6 --first 1
"""
import argparse
import csv
import os
import random
import shlex
import subprocess
import sys

METHODS = {"default": [], "Monolithic": ["Outer Solver/Type=Monolithic"], "Condensed": ["Formulation=Condensed Groups"]}
LIMIT = 120      # seconds of a run
SAME = 1e-5      # relative to the largest force on the path: between methods, and between frictionless steps with equal factors
NOTHING = 1e-9   # relative to the largest force on the path: frictionless forces under zero loads
PLACES = 1e-12   # strain due to round-off in the bodies' coordinates
SAID = ("not converged", "NOT VERIFIED", "NOT DETERMINED", "no solution", "equilibrium", "error")
CELLS = ("Quadrilateral4", "Quadrilateral8", "Triangle3", "Triangle6")


def parameter(name, kind, value):
    return '<Parameter name="%s" type="%s" value="%s"/>' % (name, kind, value)


def real(name, value):
    return parameter(name, "double", "%.17g" % value)


def text(name, value):
    return parameter(name, "string", value)


def array(name, values, kind="double"):
    return parameter(name, "Array(%s)" % kind, "{%s}" % ", ".join("%.17g" % v if kind == "double" else str(v) for v in values))


def inner(name, lines):
    return ['<ParameterList name="%s">' % name, *("  " + line for line in lines), "</ParameterList>"]


class Scene:
    """Box-shaped bodies in random units; each is held, so that no load leaves a body loose."""

    def __init__(self, seed):
        self.random = random.Random(seed)
        self.seed = seed
        self.size, self.stress = 10 ** self.random.uniform(-3, 3), 10 ** self.random.uniform(0, 11)
        self.boxes, self.bodies, self.conditions, self.contacts, self.factors = {}, {}, {}, {}, {}
        self.model = "Plane Strain"
        self.law = self.random.choice(["Frictionless", "Coulomb"])
        self.strain = 10 ** self.random.uniform(-6, -3)
        self.force = self.stress * self.strain * self.size  # typical
        self.times = self.random.randint(4, 6)
        self.family = self.random.choice([layers, press, fit])
        self.family(self)

    def box(self, name, x, y, cells):
        scaled = lambda at: [self.size * value for value in at]
        self.boxes[name] = [array("X", scaled(x)), array("Y", scaled(y)), array("Cells", cells, "int"), text("Cell", self.random.choice(CELLS))]
        self.bodies[name] = self.stress * 10 ** self.random.uniform(-1, 1)

    def condition(self, name, kind, group, *more):
        self.conditions[name] = [text("Type", kind), *([text("Group", group)] if group else []), *more]

    def cycle(self):
        """Random factors that pass through zero, may reverse, and end at zero."""
        r = self.random
        kinds = [0.0, 1.0, r.choice([-1.0, 0.5]), r.uniform(0.1, 1.0)]
        return [r.choice(kinds) for _ in range(self.times - 2)] + [r.choice([1.0, r.uniform(0.1, 1.0)]), 0.0]

    def contact(self, name, a, b):
        own = [text("Side A", a), text("Side B", b), text("Law", self.law)]
        if self.law == "Coulomb":
            own += inner("Coulomb", [text("Coefficient", "%.17g" % self.random.uniform(0.05, 0.6))])
        self.contacts[name] = own

    def write(self, path):
        materials = sum((inner("of " + name, [real("Young Modulus", young), real("Poisson Ratio", self.random.choice([0.0, 0.3, 0.45])),
                                              real("Thermal Expansion", 1e-5)]) for name, young in self.bodies.items()), [])
        lists = lambda all_: sum((inner(name, own) for name, own in all_.items()), [])
        lines = [text("Title", "%s %d: %s" % (self.family.__name__, self.seed, self.law)), text("Model", self.model),
                 *inner("Mesh", [text("Generator", "Boxes"), *inner("Boxes", lists(self.boxes))]),
                 *inner("Bodies", lists({name: [text("Material", "of " + name)] for name in self.bodies})),
                 *inner("Materials", materials), *inner("Boundary Conditions", lists(self.conditions)),
                 *inner("Contact", lists(self.contacts)),
                 *inner("Load Steps", [array("Times", range(1, self.times + 1)), parameter("Halvings", "int", 0), *inner(
                     "Factors", [text(name, "{%s}" % ", ".join("%.17g" % f for f in own)) for name, own in self.factors.items()])]),
                 *inner("Partition", [text("Type", "METIS"), *inner("METIS", [parameter("Subdomains", "int", self.random.randint(4, 8))])]),
                 *inner("Output", [parameter("Fields", "bool", "false")])]
        with open(path, "w") as file:
            file.write("\n".join(inner("Suture", lines)) + "\n")


def layers(scene):
    """Touching layers, each clamped at one end; one is loaded, others may be unloaded."""
    r = scene.random
    count, length, y = r.randint(2, 4), r.uniform(1, 3), 0.0
    for k in range(count):
        height = r.uniform(0.15, 0.4)
        scene.box("l%d" % k, (0, length), (y, y + height), (r.randint(6, 14), r.randint(1, 3)))
        scene.condition("clamp %d" % k, "Displacement", "l%d_left" % k, array("Value", [0, 0]))
        if k > 0:
            scene.contact("joint %d" % k, "l%d_top" % (k - 1), "l%d_bottom" % k)
        y += height
    last = "l%d" % (count - 1)
    size = scene.strain * scene.stress * 0.01
    if r.random() < 0.5:
        scene.condition("load", "Pressure", last + "_top", real("Value", r.choice([-1, 1, 1]) * size))
    else:
        scene.condition("load", "Displacement", last + "_right", text("Components", "y"),
                        array("Value", [r.choice([-1, 1]) * scene.strain * scene.size * 0.3]))
    scene.factors["load"] = scene.cycle()


def press(scene):
    """A die on a base, pressed and released; a block at the side of the base carries no or little force."""
    r = scene.random
    scene.box("base", (0, 2), (0, 1), (r.randint(8, 14), r.randint(4, 6)))
    scene.condition("foot", "Displacement", "base_bottom", array("Value", [0, 0]))
    scene.box("die", (0.6, 1.4), (1, 1.6), (r.randint(4, 7), r.randint(3, 6)))
    scene.contact("under", "base_top", "die_bottom")
    scene.condition("guide", "Displacement", "die_top", text("Components", "x"), array("Value", [0]))
    if r.random() < 0.5:
        scene.condition("press", "Displacement", "die_top", text("Components", "y"), array("Value", [-scene.strain * scene.size]))
    else:  # on soft springs, so that no load leaves it loose
        scene.condition("ground", "Elastic Support", "die_top", real("Normal Stiffness", scene.stress / scene.size))
        scene.condition("press", "Pressure", "die_top", real("Value", scene.strain * scene.stress))
    scene.factors["press"] = scene.cycle()
    scene.box("block", (2, 2.5), (0.2, 0.8), (r.randint(2, 4), r.randint(3, 6)))
    scene.contact("beside", "base_right", "block_left")
    scene.condition("wall", "Displacement", "block_right", array("Value", [0, 0]))
    if r.random() < 0.5:
        scene.condition("a little", "Pressure", "block_top", real("Value", scene.strain * scene.stress * r.choice([1e-3, 1e-6])))
        scene.factors["a little"] = scene.cycle()


def fit(scene):
    """A pin pressed into a bush by a temperature of either sign."""
    r = scene.random
    scene.model = "Axisymmetric"
    gap = r.choice([0.0, 0.0, 1e-6])
    height = r.uniform(0.5, 2)
    scene.box("pin", (0, 1), (0, height), (r.randint(3, 6), r.randint(5, 9)))
    scene.box("bush", (1 + gap, r.uniform(1.3, 2)), (0, height), (r.randint(2, 4), r.randint(5, 9)))
    scene.contact("fit", "pin_right", "bush_left")
    scene.condition("feet", "Bilateral", None, array("Group", ["pin_bottom", "bush_bottom"], "string"))
    scene.condition("hot", "Temperature", None, real("Value", 50.0), text("Body", "pin"))
    scene.factors["hot"] = scene.cycle()


class Run:
    def __init__(self, command, scene, folder, sets):
        words = [word for each in sets for word in ("--set", each)]
        try:
            done = subprocess.run([*command, scene, "--output", folder, *words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                  stdin=subprocess.DEVNULL, text=True, timeout=LIMIT)
            self.code, self.text = done.returncode, done.stdout
        except subprocess.TimeoutExpired as expired:
            self.code, self.text = "hang", (expired.stdout or b"").decode(errors="replace")
        errors = [line.strip() for line in self.text.split("\n") if any(words in line for words in SAID)]
        self.failure = " | ".join(errors[:2]) or self.text[-400:]
        self.forces = []  # of each step, of all contacts
        if self.code == 0:
            with open(os.path.join(folder, "steps.csv")) as file:
                self.forces = [[float(row[name]) for name in row if name.startswith("force ")] for row in csv.DictReader(file)]


def furthest(one, other):
    return max((abs(a - b) for a, b in zip(one, other)), default=0.0)


def faults(scene, runs):
    """Failures of the runs of a scene, as texts."""
    wrong = ["%s: exit code %s: %s" % (name, run.code, run.failure) for name, run in runs.items() if run.code != 0]
    if wrong:
        return wrong
    largest = max([abs(value) for run in runs.values() for step in run.forces for value in step] + [1e-4 * scene.force])
    first = next(iter(runs.values())).forces
    alike = list(zip(*scene.factors.values()))
    for name, run in runs.items():
        if len(run.forces) != scene.times:
            wrong.append("%s: %d steps of %d" % (name, len(run.forces), scene.times))
            continue
        for step, own in enumerate(run.forces):
            if furthest(own, first[step]) > SAME * largest:
                wrong.append("%s: step %d: forces differ by %.1e" % (name, step + 1, furthest(own, first[step]) / largest))
            if scene.law != "Frictionless":
                continue
            if not any(alike[step]) and furthest(own, [0.0] * len(own)) > max(NOTHING, PLACES / scene.strain) * largest:
                wrong.append("%s: step %d: forces of %.1e without loads" % (name, step + 1, furthest(own, [0.0] * len(own)) / largest))
            same = alike.index(alike[step])
            if furthest(own, run.forces[same]) > SAME * largest:
                wrong.append("%s: steps %d and %d: the same loads, other forces" % (name, same + 1, step + 1))
    return wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--solve", required=True)
    parser.add_argument("--mpirun", required=True, help="takes -np and the number of ranks")
    parser.add_argument("--output", required=True)
    parser.add_argument("--count", type=int, default=6)
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--seeds", type=int, nargs="*", help="these scenes only")
    parser.add_argument("--ranks", type=int, nargs="*", default=[1, 3])
    options = parser.parse_args()
    bad = 0
    seeds = options.seeds or range(options.first, options.first + options.count)
    for seed in seeds:
        scene = Scene(seed)
        folder = os.path.join(options.output, "s%d" % seed)
        os.makedirs(folder, exist_ok=True)
        path = os.path.join(folder, "scene.xml")
        scene.write(path)
        runs = {}
        for method, sets in METHODS.items():
            for ranks in options.ranks if method != "Monolithic" else options.ranks[:1]:
                command = [options.solve] if ranks == 1 else [*shlex.split(options.mpirun), "-np", str(ranks), options.solve]
                runs["%s on %d" % (method, ranks)] = Run(command, path, os.path.join(folder, "%s_%d" % (method, ranks)), sets)
        found = faults(scene, runs)
        bad += bool(found)
        for fault in found:
            print("%s %d (%s): %s" % (scene.family.__name__, seed, scene.law, fault), flush=True)
    print("%d scenes, %d with faults" % (len(seeds), bad))
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
