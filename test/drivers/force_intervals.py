"""Strict bounds of forces and displacements (Output/Strict Error Bars) against meshes four times finer, on random scenes in 2D.

The bounds must contain the values of the finer mesh in every scene, up to the accuracy of its solver, and must not be useless: half of those
of forces that are not zero are narrower than 40 % of the force.
"""
import argparse
import json
import math
import pathlib
import subprocess
import sys

from random_boxes import RandomBoxes, array, group, parameter

SLACK = 1e-6  # accuracy of the finer solution, of the largest force or displacement


class Scene(RandomBoxes):
    """A random scene whose contact sides match. `fine`: factor of the number of cells in each direction."""

    def __init__(self, seed, fine, folder):
        super().__init__(seed, fine, folder)
        kind = self.random.choice(["stack", "pillars", "beam"])
        self.cell = self.random.choice(["Triangle3", "Triangle6", "Triangle6"])
        self.moved = self.random.choice([True, False])  # prescribed displacement or pressure
        self.h = self.random.choice([0.25, 0.2, 0.125])
        self.solver = self.random.choice(["Active Set", "Active Set", "Monolithic"])
        self.title = f"{kind} {self.cell} {'moved' if self.moved else 'pressed'} {self.solver} {seed}"
        getattr(self, kind)()

    def box(self, name, left, right, y, rows):
        """`left`, `right`: in cells of size h."""
        self.cells(name, (left * self.h, right * self.h), y, (right - left, rows))

    def push(self, sides, aside=0.0):
        if self.moved:
            self.condition("push", sides, "Displacement",
                           parameter("Value", "Array(double)", array(aside, -self.random.uniform(0.002, 0.01))))
        else:
            self.condition("push", sides, "Pressure", parameter("Value", "double", self.random.uniform(20, 100)))

    def stack(self):
        y, cells, count = 0.0, self.random.choice([7, 8, 9]), self.random.choice([2, 2, 3])
        for i in range(count):
            rows = self.random.choice([3, 4])
            self.box(f"b{i}", 0, cells, (y, y + rows * self.h), rows)
            self.condition(f"axis {i}", f"b{i}_left", "Bilateral")
            if i > 0:
                self.contact(f"joint {i}", f"b{i}_bottom", f"b{i - 1}_top")
            y += rows * self.h
            cells -= self.random.choice([0, 1, 2, 3])
        self.condition("ground", "b0_bottom", "Bilateral")
        self.push(f"b{count - 1}_top")

    def pillars(self):
        at = 0
        for i in range(self.random.choice([2, 3])):
            width = self.random.choice([2, 3, 4])
            self.box(f"p{i}", at, at + width, (0.0, 1.0 - (self.random.uniform(0, 0.001) if i > 0 else 0.0)), 4)
            self.fix(f"ground {i}", f"p{i}_bottom")
            self.contact(f"joint {i}", "beam_bottom", f"p{i}_top")
            at += width + self.random.choice([2, 3, 4])
        self.box("beam", 0, at, (1.0, 1.0 + 3 * self.h), 3)
        if not self.moved:
            self.condition("axis", "beam_left", "Bilateral")
        self.push("beam_top", self.random.choice([0.0, 0.002]))

    def beam(self):
        self.moved = False
        cells = self.random.choice([10, 12])
        self.box("beam", 0, cells, (1.0, 1.4), 2)
        self.fix("clamp", "beam_left")
        at = self.random.choice([5, 6, 7])
        self.box("stop", at, at + 2, (0.0, 1.0 - self.random.uniform(0, 0.001)), 4)
        self.fix("ground", "stop_bottom")
        self.contact("joint", "beam_bottom", "stop_top")
        self.condition("push", "beam_top", "Pressure", parameter("Value", "double", self.random.uniform(0.5, 3)))

    def text(self, strict):
        return group("Suture", parameter("Title", "string", self.title), parameter("Model", "string", "Plane Strain"),
                     group("Mesh", parameter("Generator", "string", "Boxes"), group("Boxes", *self.boxes)), group("Bodies", *self.bodies),
                     group("Materials", *self.materials), group("Boundary Conditions", *self.conditions), group("Contact", *self.contacts),
                     group("Outer Solver", parameter("Type", "string", self.solver), parameter("Tolerance", "double", 1e-10)),
                     group("Output", parameter("Strict Error Bars", "Array(string)", "{" + strict + "}"),
                           parameter("Fields", "bool", "false"), parameter("Folder", "string", str(self.folder))))


def solve(program, scene, strict):
    """The resultants of a scene, {} if it was not solved: some bodies move too far for small strains."""
    scene.folder.mkdir(parents=True, exist_ok=True)
    path = scene.folder / "scene.xml"
    path.write_text(scene.text(strict))
    done = subprocess.run([program, str(path)], capture_output=True, text=True)
    if done.returncode == 3:
        sys.exit(f"refused: {path}\n{done.stderr}")
    if done.returncode != 0:
        return {}
    reactions = json.loads((scene.folder / "summary.json").read_text())["reactions"]
    return {(kind, name): one for kind in ("conditions", "contacts") for name, one in reactions[kind].items()}


def bounds_of(program, seed, work):
    """[(low, value of the finer mesh, high, largest, name)] of a scene, and the reasons of missing bounds."""
    coarse_scene = Scene(seed, 1, work / f"{seed}_coarse")
    coarse = solve(program, coarse_scene, "All")
    fine = solve(program, Scene(seed, 4, work / f"{seed}_fine"), "" if coarse_scene.moved else "push") if coarse else {}
    if not fine:
        return [], []
    largest = max(math.hypot(*one["force"]) for one in fine.values())
    found, reasons = [], []
    for (kind, name), one in coarse.items():
        if "not_bounded" in one:
            reasons.append(f"{name}: {one['not_bounded']}")
        for k, (low, high) in enumerate(zip(one.get("force_low", []), one.get("force_high", []))):
            if low is not None:
                found.append((low, fine[kind, name]["force"][k], high, largest, f"{seed} {name} {'xy'[k]}"))
        if one.get("displacement_low") is not None:
            value = fine[kind, name]["displacement"]
            found.append((one["displacement_low"], value, one["displacement_high"], abs(value), f"{seed} {name} displacement"))
    return found, reasons


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--solve", required=True, help="suture_solve")
    parser.add_argument("--work", required=True, type=pathlib.Path, help="folder for the runs")
    parser.add_argument("--scenes", type=int, required=True, help="number of scenes")
    parser.add_argument("--verbose", action="store_true")
    arguments = parser.parse_args()
    bounds, reasons, solved = [], [], 0
    for seed in range(3000, 3000 + arguments.scenes):
        more, why = bounds_of(arguments.solve, seed, arguments.work)
        solved += bool(more)
        bounds += more
        reasons += [f"{seed} {one}" for one in why]
        if arguments.verbose:
            for low, value, high, largest, name in more:
                print(f"{name}: {low:.6g} {value:.6g} {high:.6g}   width {(high - low) / largest:.2e}")
    missed = [one for one in bounds if not one[0] - SLACK * one[3] <= one[1] <= one[2] + SLACK * one[3]]
    widths = sorted((high - low) / abs(value) for low, value, high, largest, _ in bounds if abs(value) > 0.01 * largest)
    middle = widths[len(widths) // 2] if widths else math.inf
    print(f"{solved} of {arguments.scenes} scenes, {len(bounds)} values: {len(missed)} outside of their bounds; half of the bounds are narrower "
          f"than {100 * middle:.2g} % of the value; {len(reasons)} conditions and contacts without all bounds")
    for low, value, high, largest, name in missed:
        print(f"   missed: {name}: {value:.9g} is not in [{low:.9g}, {high:.9g}]")
    if arguments.verbose:
        print(*reasons, sep="\n")
    if 2 * solved < arguments.scenes or missed or middle > 0.4:
        sys.exit(1)


if __name__ == "__main__":
    main()
