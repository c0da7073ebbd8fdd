"""Builder of a random scene with friction: bodies, conditions, contacts in its own units, rotated and scaled on writing."""
import math
import os
import random as randoms

from friction_grids import CELLS, Mesh, deep, rotation

PLANE = ["Triangle3", "Triangle6", "Quadrilateral4", "Quadrilateral8", "Quadrilateral9"]
SPACE = ["Tetrahedron4", "Tetrahedron10", "Hexahedron8", "Hexahedron20", "Hexahedron27", "Wedge6"]


def fill(scene, families, family=None):
    """Fills an empty scene from one of the families, a random one if none is given. `families`: [(function, weight)]."""
    chosen = scene.random.choices([f for f, _ in families], [w for _, w in families])[0]
    if family:
        chosen = next(f for f, _ in families if f.__name__ == family)
    scene.family = chosen.__name__
    chosen(scene)
    return scene


class Law:
    """A friction law in units of the scene."""

    def __init__(self, kind, mu=0.0, cohesion=0.0, bound=0.0):
        self.kind, self.mu, self.cohesion, self.bound = kind, mu, cohesion, bound

    @property
    def free(self):
        return self.kind in ("Frictionless", "No Separation") or self.mu + self.cohesion + self.bound == 0.0 and self.kind != "Tied"

    @property
    def tension(self):
        return self.kind in ("Tied", "No Separation")

    def capacity(self, normal, area):
        """Largest tangential force for a normal force."""
        if self.kind == "Tied":
            return math.inf
        return 0.0 if self.free else self.mu * normal + (self.cohesion + self.bound) * area

    def __str__(self):
        return {"Coulomb": "Coulomb %.3g + %.2g" % (self.mu, self.cohesion) if self.cohesion else "Coulomb %.3g" % self.mu,
                "Tresca": "Tresca %.2g" % self.bound}.get(self.kind, self.kind)


class Scene:
    """`expected`: "some" and "none" follow from statics, "open" is unknown."""

    def __init__(self, seed, dimension=None):
        self.random = r = randoms.Random(seed)
        self.seed, self.expected, self.why = seed, "open", ""
        self.d = dimension or (3 if r.random() < 0.25 else 2)
        self.cell = r.choice(PLANE if self.d == 2 else SPACE)
        self.order = CELLS[self.cell][1]
        self.length = 1.0 if r.random() < 0.5 else 10 ** r.uniform(-3, 2)
        self.stress = 1.0 if r.random() < 0.3 else 10 ** r.uniform(-2, 9)
        self.load = 10 ** r.uniform(-5, -2)  # a typical stress, in units of the softest modulus
        turned = r.random() < 0.3
        self.turn = rotation(r, self.d) if turned else [[float(i == k) for k in range(self.d)] for i in range(self.d)]
        self.mesh, self.bodies, self.conditions, self.contacts = Mesh(), {}, [], []
        self.areas = {}
        self.model = "Solid" if self.d == 3 else r.choice(["Plane Strain", "Plane Strain", "Plane Stress"])
        self.jump = r.uniform(0, 4) if r.random() < 0.4 else 0.0
        self.subdomains = r.randint(4, 16)
        self.times, self.factors = [], {}  # load steps: factors by index of the condition

    # Bodies ----------------------------------------------------------------------------------------------------------------------------
    def cells(self, *numbers):
        """Numbers of cells in this scene for those of a linear 2D mesh."""
        factor = {(2, 1): 1.0, (2, 2): 0.55, (3, 1): 0.5, (3, 2): 0.26}[(self.d, self.order)]
        return [max(2 if k == 0 else 1, round(n * factor)) for k, n in enumerate(numbers)]

    def body(self, name, patches, young=None):
        """`patches`: (cells, map, sides) in 2D; in 3D, 2D maps are extruded over a depth."""
        young = young if young is not None else 10 ** (self.random.uniform(0, self.jump))
        index = {}
        self.bodies[name] = young
        for cells, place, sides in patches:
            turned = lambda *at, place=place: tuple(self.length * x for x in self.turned(place(*at)))
            self.mesh.patch(name, self.cell, cells, turned, sides, index)

    def extruded(self, name, patches, depth=1.0, layers=None, young=None):
        """A 2D body; in 3D a prism."""
        if self.d == 3:
            layers = layers or self.cells(1, self.random.randint(4, 10))[1]
            patches = [((*cells, layers), deep(place, depth), {**sides, "r0": "front", "r1": "back"}) for cells, place, sides in patches]
        self.body(name, patches, young)

    def box(self, name, x, y, cells, bottom=None, top=None, depth=1.0, layers=None, young=None, lean=0.0):
        """A box with sides left, right, bottom, top (in 3D front, back); `bottom`, `top`: heights beyond y, functions of x and z."""
        low, high = bottom or (lambda x, z: 0.0), top or (lambda x, z: 0.0)

        def place(s, t, r=0.5):
            z = depth * (r - 0.5)
            at = x[0] + (x[1] - x[0]) * s
            below, above = y[0] + low(at, z), y[1] + high(at, z)
            return (at + lean * t, below + (above - below) * t) + ((z,) if self.d == 3 else ())
        sides = {"s0": "left", "s1": "right", "t0": "bottom", "t1": "top"}
        if self.d == 3:
            layers = layers or self.cells(1, self.random.randint(6, 10))[1]
            self.body(name, [((*cells, layers), place, {**sides, "r0": "front", "r1": "back"})], young)
        else:
            self.body(name, [(tuple(cells), place, sides)], young)

    def turned(self, vector):
        return tuple(sum(self.turn[i][k] * vector[k] for k in range(self.d)) for i in range(self.d))

    # Conditions ------------------------------------------------------------------------------------------------------------------------
    def vector(self, plane, z=0.0):
        return tuple(plane) + (z,) if self.d == 3 and len(plane) == 2 else tuple(plane)

    def fix(self, group):
        self.conditions.append((group, "Displacement", [0.0] * self.d, None))

    def roller(self, group):
        self.conditions.append((group, "Bilateral", None, None))

    def sideways(self, body, side="left"):
        """Rollers against all motions except the vertical one."""
        self.roller(body + "_" + side)
        if self.d == 3:
            self.roller(body + "_front")

    def move(self, group, by, gradient=None, centre=None):
        """The displacement by + gradient (x - centre)."""
        self.conditions.append((group, "Displacement", by, (gradient, centre) if gradient else None))

    def traction(self, group, value):
        self.conditions.append((group, "Traction", [self.load * v for v in self.vector(value)], None))

    def pressure(self, group, value):
        self.conditions.append((group, "Pressure", self.load * value, None))

    def weight(self, body, value):
        self.conditions.append((body, "Body Force", [self.load * v for v in self.vector(value)], None))

    # Contacts --------------------------------------------------------------------------------------------------------------------------
    def law(self, kinds=None, mu=None):
        r = self.random
        kind = r.choice(kinds or ["Coulomb"] * 8 + ["Coulomb cohesion"] * 3 + ["Tresca"] * 3 + ["Tied", "Frictionless", "No Separation"])
        if mu is None:
            mu = 0.0 if r.random() < 0.05 else r.uniform(0, 1) if r.random() < 0.75 else r.uniform(1, 1.5)
        size = 10 ** r.uniform(-1, 0.7)
        if kind == "Coulomb cohesion":
            return Law("Coulomb", mu, cohesion=size)
        return Law(kind, mu=mu) if kind == "Coulomb" else Law(kind, bound=size) if kind == "Tresca" else Law(kind)

    def contact(self, a, b, law, gap=None):
        if self.random.random() < 0.5:
            a, b = b, a
        self.contacts.append({"a": a, "b": b, "law": law, "gap": gap})

    def flat(self, side, point, normal, law, gap=None):
        self.contacts.append({"a": side, "law": law, "gap": gap, "obstacle": "Line" if self.d == 2 else "Plane",
                              "point": self.vector(point), "normal": self.vector(normal)})

    def round(self, side, centre, radius, law, hollow=False, gap=None):
        self.contacts.append({"a": side, "law": law, "gap": gap, "obstacle": "Circle" if self.d == 2 else "Ball",
                              "centre": self.vector(centre), "radius": radius, "hollow": hollow})

    # Writing ---------------------------------------------------------------------------------------------------------------------------
    def write(self, folder):
        os.makedirs(folder, exist_ok=True)
        self.mesh.write(os.path.join(folder, "mesh.msh"))
        parameter = lambda name, kind, value: '<Parameter name="%s" type="%s" value="%s"/>' % (name, kind, value)
        real = lambda name, value: parameter(name, "double", "%.17g" % value)
        text = lambda name, value: parameter(name, "string", value)
        reals = lambda name, values: parameter(name, "Array(double)", "{%s}" % ", ".join("%.17g" % v for v in values))
        inner = lambda name, lines: ['<ParameterList name="%s">' % name, *("  " + line for line in lines), "</ParameterList>"]
        groups = lambda name, given: text(name, given) if isinstance(given, str) else parameter(name, "Array(string)", "{%s}" % ", ".join(given))
        scaled = lambda factor, vector: [factor * v for v in self.turned(vector)]
        lines = [text("Title", self.title), text("Model", self.model), *inner("Mesh", [text("File", "mesh.msh")])]
        lines += inner("Bodies", sum((inner(name, self.body_lines(name)) for name in self.bodies), []))
        lines += inner("Materials", sum((inner("m" + name, self.material(name, young * self.stress)) for name, young in self.materials().items()), []))
        conditions = []
        for k, (group, kind, value, linear) in enumerate(self.conditions):
            own = [groups("Body" if kind == "Body Force" else "Group", group), text("Type", kind)]
            if kind == "Displacement" and linear:
                own += [text("Expression " + "xyz"[i], e) for i, e in enumerate(self.linear(value, *linear))]
            elif kind == "Displacement":
                own.append(reals("Value", scaled(self.length, value)))
            elif kind == "Pressure":
                own.append(real("Value", self.stress * value))
            elif kind == "Mean Displacement":
                own += [reals("Value", scaled(self.length, value))]
            elif kind == "Preload":
                axis, length, force = value
                own = [text("Body", group), text("Type", kind), reals("Direction", scaled(1.0, axis)), real("Length", length * self.length),
                       reals("Value", [force * self.stress * self.length ** (self.d - 1)])]
            elif kind in ("Traction", "Body Force") and linear:  # a factor, as an expression
                own += [text("Expression " + "xyz"[i], "%.17g*%s" % (v, linear))
                        for i, v in enumerate(scaled(self.stress / (self.length if kind == "Body Force" else 1.0), value))]
            elif kind in ("Traction", "Body Force"):
                own.append(reals("Value", scaled(self.stress / (self.length if kind == "Body Force" else 1.0), value)))
            conditions += inner("c%d" % k, own)
        lines += inner("Boundary Conditions", conditions)
        contacts = []
        for k, c in enumerate(self.contacts):
            law = c["law"]
            own = [groups("Side A", c["a"]), text("Law", law.kind)]
            if law.kind == "Coulomb":
                own += inner("Coulomb", [text("Coefficient", "%.17g" % law.mu)]
                             + ([text("Cohesion", "%.17g" % (law.cohesion * self.load * self.stress))] if law.cohesion else []))
            if law.kind == "Tresca":
                own += inner("Tresca", [text("Bound", "%.17g" % (law.bound * self.load * self.stress))])
            if c["gap"] is not None:
                own.append(text("Initial Gap", "%.17g" % (c["gap"] * self.length)))
            if "b" in c:
                own.append(groups("Side B", c["b"]))
            else:
                own.append(text("Obstacle", c["obstacle"]))
                own += inner(c["obstacle"], [reals("Point", scaled(self.length, c["point"])), reals("Normal", scaled(1.0, c["normal"]))]
                             if "point" in c else
                             [reals("Centre", scaled(self.length, c["centre"])), real("Radius", c["radius"] * self.length),
                              parameter("Hollow", "bool", str(c["hollow"]).lower())])
            contacts += inner("k%d" % k, own)
        lines += inner("Contact", contacts)
        if self.times:
            factors = [text("c%d" % k, "{%s}" % ", ".join("%.17g" % f for f in values)) for k, values in sorted(self.factors.items())]
            lines += inner("Load Steps", [reals("Times", self.times), *inner("Factors", factors)])
        subdomains = max(len(self.bodies), min(self.subdomains, self.volumes() // 8))
        lines += inner("Partition", [text("Type", "METIS"), *inner("METIS", [text("Subdomains", "%d" % subdomains)])])
        with open(os.path.join(folder, "scene.xml"), "w") as file:
            file.write("\n".join(inner("Suture", lines)) + "\n")

    def body_lines(self, name):
        """Lines of a body."""
        return ['<Parameter name="Material" type="string" value="m%s"/>' % name]

    def materials(self):
        """Young moduli, in units of the scene, by the name of a body or of a part of it."""
        return self.bodies

    def material(self, name, young):
        """Lines of a body's material."""
        return ['<Parameter name="Young Modulus" type="double" value="%.17g"/>' % young,
                '<Parameter name="Poisson Ratio" type="double" value="%.17g"/>' % self.poisson]

    def volumes(self):
        names = {number for (dimension, _), number in self.mesh.groups.items() if dimension == self.d}
        return sum(group in names for _, group, _ in self.mesh.elements)

    def linear(self, by, gradient, centre):
        """by + gradient (x - centre) in the scene's axes, as expressions in the rotated and scaled coordinates."""
        d, turn = self.d, self.turn
        full = [[sum(turn[i][a] * gradient[a][b] * turn[k][b] for a in range(d) for b in range(d)) for k in range(d)] for i in range(d)]
        start, origin = self.turned(by), self.turned(centre)
        return [" + ".join(["%.17g" % (self.length * start[i])] + ["%.17g*(%s - %.17g)" % (full[i][k], "xyz"[k], self.length * origin[k])
                                                                 for k in range(d) if abs(full[i][k]) > 1e-14]).replace("- -", "+ ")
                for i in range(d)]

    @property
    def poisson(self):
        return (0.0, 0.2, 0.3, 0.45)[self.seed % 4]

    @property
    def title(self):
        return "%s %d: %s" % (self.family, self.seed, "; ".join(str(c["law"]) for c in self.contacts))

    def must(self, expected, why):
        self.expected, self.why = expected, why
