"""Builder of a random scene whose bodies move far: bodies with meshes of their own kinds, driven groups, contacts, a path, and checks of the
results. Scenes are described in their own axes and units; on writing they are rotated and scaled."""
import math
import os

import friction_builder
from cyclic_paths import array, inner, real, text
from friction_builder import PLANE, SPACE, fill  # noqa: F401
from friction_grids import CELLS, rotation


class Scene(friction_builder.Scene):
    """`checks`: functions of a MovingRun that return what is wrong, or an empty text."""

    def __init__(self, seed, dimension=None):
        super().__init__(seed, dimension)
        self.load = 10 ** self.random.uniform(-4, -2)
        self.jump = 0.0
        self.turn = [[float(i == k) for k in range(self.d)] for i in range(self.d)]
        self.model = "Solid" if self.d == 3 else self.random.choice(["Plane Strain", "Plane Strain", "Plane Stress"])
        self.lines, self.paths, self.checks = [], {}, []
        self.times = [1.0]

    # Axes ------------------------------------------------------------------------------------------------------------------------------
    def turn_freely(self):
        """Any rotation: for scenes that prescribe all or no translations of a group."""
        if self.random.random() < 0.4:
            self.turn = rotation(self.random, self.d)

    def turn_axes(self):
        """Axes onto axes: for scenes that leave some motions of a driven group free."""
        if self.d == 2:
            c, s = self.random.choice([(1.0, 0.0), (1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)])
            self.turn = [[c, -s], [s, c]]
        else:
            k = self.random.choice([0, 0, 1, 2])
            self.turn = [[float((i + k) % 3 == j) for j in range(3)] for i in range(3)]

    def back(self, vector):
        """A vector of a result in the axes of the scene."""
        return [sum(self.turn[k][i] * vector[k] for k in range(self.d)) for i in range(self.d)]

    @property
    def force(self):
        """Unit of force; in 2D per thickness."""
        return self.stress * self.length ** (self.d - 1)

    # Bodies ----------------------------------------------------------------------------------------------------------------------------
    def kind(self, kinds=None):
        """Chooses the element of the next bodies."""
        self.cell = self.random.choice(kinds or ((["Quadrilateral4"] * 4 + PLANE) if self.d == 2 else (["Hexahedron8"] * 6 + SPACE)))
        self.order = CELLS[self.cell][1]

    def stiffness(self):
        """Young's modulus of the next body, in units of the softest one."""
        return 10 ** self.random.uniform(0, 1) if self.random.random() < 0.5 else 1.0

    def friction(self, least=0.0, most=0.6):
        return friction_builder.Law("Coulomb", self.random.uniform(least, most)) if most > 0 else friction_builder.Law("Frictionless")

    # Conditions ------------------------------------------------------------------------------------------------------------------------
    def motion(self, group, point, shift=None, rotation=None, path=None, force=None):
        """A rigid group. `shift`, `rotation`: prescribed components, None where free; in 2D `rotation` is an angle. `path`: factors."""
        free = [None] * 3
        shift, turn = list(shift or free)[:self.d], rotation if self.d == 3 else [None, None, rotation]
        lines = [text("Group", group), text("Type", "Rigid Group"), array("Point", [self.length * x for x in self.turned(self.vector(point))])]
        lines += [real("Motion " + "xyz"[i], self.length * value) for i, value in self.along(shift)]
        lines += [real("Rotation " + "xyz"[i], value) for i, value in (self.along(turn or free) if self.d == 3 else [(2, rotation)])
                  if value is not None]
        if force:
            lines.append(array("Force", [self.force * x for x in self.turned(self.vector(force))]))
        self.add(group, lines, path)

    def along(self, values):
        """Prescribed components in the axes of the file: [(axis, value)]."""
        if all(value is not None for value in values):
            return list(enumerate(self.turned(values)))
        found = []
        for i in range(self.d):
            k = next(k for k in range(self.d) if abs(self.turn[i][k]) > 0.5)
            if values[k] is not None:
                found.append((i, self.turn[i][k] * values[k]))
        return found

    def push(self, group, force, path=None, name=None):
        """A dead force, distributed over a group."""
        self.add(name or "force on " + group, [text("Group", group), text("Type", "Force"),
                                       array("Value", [self.force * x for x in self.turned(self.vector(force))])], path)

    def gravity(self, body, force):
        """A weight by volume."""
        self.add("weight of " + body, [text("Body", body), text("Type", "Body Force"),
                                       array("Value", [self.force / self.length ** self.d * x for x in self.turned(self.vector(force))])])

    def hold(self, group):
        self.add("support of " + group, [text("Group", group), text("Type", "Displacement"), array("Value", [0.0] * self.d)])

    def add(self, name, lines, path=None):
        self.lines += inner(name, lines)
        if path is not None:
            self.paths[name] = path

    def touch(self, name, a, b, law):
        """A contact; the side that carries the pairs is a random one, but forces of results act on `b`."""
        swapped = self.random.random() < 0.5
        self.contacts.append({"name": name, "a": b if swapped else a, "b": a if swapped else b, "law": law, "sign": -1.0 if swapped else 1.0})

    def steps(self, turns, most=8, starts=True):
        """Times and factors of a path through the values `turns`, each reached in a random number of steps. `starts`: a first step with
        the loads alone, mostly."""
        r, values = self.random, []
        if starts and r.random() < 0.8:
            values.append(0.0)
        before = 0.0
        for value in turns:
            n = r.choice([1, 2, r.randint(1, max(1, most // len(turns)))])
            values += [before + (value - before) * (k + 1) / n for k in range(n)]
            before = value
        self.times = [1.0]
        while len(self.times) < len(values):
            self.times.append(round(self.times[-1] + r.choice([1.0, r.uniform(0.5, 1.5)]), 3))
        return values

    def check(self, function):
        self.checks.append(function)

    # Writing ---------------------------------------------------------------------------------------------------------------------------
    def write(self, folder):
        os.makedirs(folder, exist_ok=True)
        self.mesh.write(os.path.join(folder, "mesh.msh"))
        lines = [text("Title", self.title), text("Model", self.model), text("Motion", "Moving"), *inner("Mesh", [text("File", "mesh.msh")])]
        lines += inner("Bodies", sum((inner(name, [text("Material", "of " + name)]) for name in self.bodies), []))
        lines += inner("Materials", sum((inner("of " + name, [real("Young Modulus", young * self.stress), real("Poisson Ratio", self.poisson)])
                                         for name, young in self.bodies.items()), []))
        lines += inner("Boundary Conditions", self.lines)
        lines += inner("Contact", sum((inner(c["name"], contact(c)) for c in self.contacts), []))
        factors = [text(name, "{%s}" % ", ".join("%.17g" % f for f in values)) for name, values in self.paths.items()]
        lines += inner("Load Steps", [array("Times", self.times), *inner("Factors", factors)])
        if self.subdomains > 6:
            lines += inner("Partition", [text("Type", "METIS"), *inner("METIS", ['<Parameter name="Subdomains" type="int" value="%d"/>' % self.subdomains])])
        with open(os.path.join(folder, "scene.xml"), "w") as file:
            file.write("\n".join(inner("Suture", lines)) + "\n")


def contact(c):
    law = c["law"]
    return [text("Side A", c["a"]), text("Side B", c["b"]), text("Law", law.kind),
            *(inner("Coulomb", [text("Coefficient", "%.17g" % law.mu)]) if law.kind == "Coulomb" else [])]
