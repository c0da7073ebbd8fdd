"""Random scenes of all kinds: families of bodies, laws, load cycles, orthotropic and nearly incompressible bodies, jumps of stiffness, units."""
import math

import friction_flat
import friction_round
from friction_builder import Law, Scene, fill

LAWS = ["Coulomb"] * 5 + ["Frictionless"] * 4 + ["Coulomb cohesion", "Tresca", "Tied", "No Separation"]


class WideScene(Scene):
    """A scene with a random material per body: isotropic, nearly incompressible, orthotropic."""

    def __init__(self, seed, dimension=None):
        super().__init__(seed, dimension)
        self.kinds = {}

    def body(self, name, patches, young=None):
        super().body(name, patches, young)
        self.kinds.setdefault(name, self.random.choices(["plain", "soft", "grain"], [6, 1, 2])[0])

    def material(self, name, young):
        kind = self.kinds[name]
        if kind == "soft" and self.cell not in ("Triangle3", "Tetrahedron4", "Wedge6") and self.model != "Plane Stress":
            return ['<Parameter name="Young Modulus" type="double" value="%.17g"/>' % young, '<Parameter name="Poisson Ratio" type="double" value="0.499"/>']
        if kind != "grain" or self.turn != [[float(i == k) for k in range(self.d)] for i in range(self.d)]:
            return super().material(name, young)
        values = {"Young Moduli": (young, young / 3, young / 2), "Poisson Ratios": (0.3, 0.2, 0.25), "Shear Moduli": (young / 4, young / 5, young / 4)}
        own = ['  <Parameter name="%s" type="Array(double)" value="{%s}"/>' % (key, ", ".join("%.17g" % v for v in value)) for key, value in values.items()]
        return ['<Parameter name="Type" type="string" value="Orthotropic"/>', '<ParameterList name="Orthotropic">', *own,
                '  <Parameter name="Angle" type="double" value="%.17g"/>' % (37 * (self.seed % 5)), "</ParameterList>"]

    def cycle(self, place=-1, steps=None):
        """Gives the condition at index `place` random load factors: to and fro, through zero, back to zero."""
        r = self.random
        count = steps or r.randint(3, 5)
        self.times = self.times or [float(k + 1) for k in range(count)]
        values = [r.choice([0.0, 1.0, -1.0, 0.5, r.uniform(-1, 1)]) for _ in self.times]
        if r.random() < 0.3:
            values[-1] = 0.0
        self.factors[place % len(self.conditions)] = values


def stack(scene):
    friction_flat.stack(scene)
    if scene.random.random() < 0.3 and scene.conditions[-1][1] == "Traction":
        scene.cycle()


def cycle(scene):
    """A block between two plates: pressed by a prescribed displacement, then pushed to and fro."""
    r = scene.random
    width, height, depth = r.uniform(0.8, 2), r.uniform(0.4, 1), r.uniform(0.6, 1.2)
    scene.box("base", (-width, width), (-0.5, 0), scene.cells(r.randint(8, 16), r.randint(2, 4)), depth=depth)
    scene.box("block", (-width / 2, width / 2), (0, height), scene.cells(r.randint(5, 12), r.randint(3, 6)), depth=depth)
    scene.fix("base_bottom")
    scene.contact("base_top", "block_bottom", scene.law(["Coulomb", "Coulomb", "Tresca", "Coulomb cohesion"], mu=r.uniform(0.1, 0.9)))
    size = scene.load * height
    scene.move("block_top", scene.vector([r.uniform(-1, 1) * size, -r.uniform(0.5, 2) * size]))
    scene.traction("block_right", (r.uniform(-0.2, 0.2), 0))
    scene.cycle()
    if r.random() < 0.5:
        scene.times = scene.times or [1.0, 2.0, 3.0]
        scene.factors[len(scene.conditions) - 2] = [r.choice([1.0, 1.0, 0.3, 1.5]) for _ in scene.times]


def table(scene):
    """A plate on more feet than statics needs."""
    r = scene.random
    feet, thick, depth = r.randint(2, 4), r.uniform(0.2, 0.5), r.uniform(0.6, 1.2)
    layers = scene.cells(1, r.randint(5, 8))[1]
    for k in range(feet):
        x = 1.5 * k
        scene.box("foot%d" % k, (x, x + 0.5), (-0.6, 0), scene.cells(r.randint(3, 6), r.randint(3, 5)), depth=depth, layers=layers)
        scene.fix("foot%d_bottom" % k)
    right = 1.5 * (feet - 1) + 0.5
    scene.box("plate", (0, right), (0, thick), scene.cells(r.randint(8, 22), r.randint(2, 4)), depth=depth, layers=layers)
    law = scene.law(LAWS)
    scene.contact("plate_bottom", ["foot%d_top" % k for k in range(feet)], law)
    scene.pressure("plate_top", r.uniform(0.1, 1))
    if law.free:
        scene.sideways("plate")
    if r.random() < 0.3:
        scene.traction("plate_right", (r.uniform(-0.02, 0.02), 0))
        scene.cycle()


def shrink_fit(scene):
    """A quarter of a ring shrunk on an oversized shaft."""
    r = scene.random
    inner, outer, n = r.uniform(0.3, 0.6), r.uniform(1.4, 2.5), r.randint(6, 14)
    sides = {"s0": "inside", "s1": "outside", "t0": "bottom", "t1": "left"}

    def ring(name, a, b, cells):
        at = lambda s, t: ((a + (b - a) * s) * math.cos(math.pi / 2 * t), (a + (b - a) * s) * math.sin(math.pi / 2 * t))
        scene.extruded(name, [(tuple(cells), at, sides)], layers=layers)
    layers = scene.cells(1, r.randint(4, 6))[1]
    across = r.randint(2, 5)
    ring("shaft", inner, 1.0, scene.cells(across, n))
    ring("ring", 1.0, outer, scene.cells(r.randint(2, 5), n if r.random() < 0.5 else r.randint(6, 14)))
    for name in ("shaft", "ring"):
        scene.roller(name + "_bottom")
        scene.roller(name + "_left")
        if scene.d == 3:
            scene.roller(name + "_front")
    scene.contact("shaft_outside", "ring_inside", scene.law(["Frictionless", "Coulomb", "Coulomb"]), gap=-scene.load)
    scene.pressure("ring_outside", r.uniform(0.0, 0.5))
    if r.random() < 0.4:
        scene.cycle()


def bolt(scene):
    """Two adjacent plates under the head of a preloaded bolt, whose shank is glued to the ground."""
    r = scene.random
    head, shank, high, depth = r.uniform(0.8, 1.2), r.uniform(0.3, 0.5), r.uniform(0.5, 1.0), r.uniform(0.6, 1.0)
    layers, n = scene.cells(1, r.randint(5, 7))[1], r.randint(3, 6)
    below = []
    for side, a, b in (("l", -2.2, -shank), ("m", -shank, shank), ("r", shank, 2.2)):
        at = lambda s, t, a=a, b=b: (a + (b - a) * s, -0.8 + 0.8 * t)
        below.append((tuple(scene.cells(n if side == "m" else 2 * n, 3)), at, {"t1": "top_" + side, "t0": "bottom"}))
    scene.extruded("ground", below, depth=depth, layers=layers)
    scene.fix("ground_bottom")
    for name, x in (("left", (-2.0, -shank - 0.1)), ("right", (shank + 0.1, 2.0))):
        scene.box(name, x, (0, high), scene.cells(2 * n, 3), depth=depth, layers=layers)
        scene.roller(name + ("_left" if name == "left" else "_right"))
        if scene.d == 3:
            scene.roller(name + "_front")
    down = lambda s, t: (-shank + 2 * shank * s, high * t)
    parts = [(tuple(scene.cells(n, n)), down, {"t0": "foot"})]
    for side, a, b in (("l", -head, -shank), ("m", -shank, shank), ("r", shank, head)):
        at = lambda s, t, a=a, b=b: (a + (b - a) * s, high + 0.4 * t)
        names = {"t1": "crown"}
        if side != "m":
            names["t0"] = "under_" + side
        cells = scene.cells(n, 2)
        parts.append(((cells[0] if side == "m" else max(2, cells[0] - 1), cells[1]), at, names))
    scene.extruded("bolt", parts, depth=depth, layers=layers)
    law = scene.law(["Frictionless", "Coulomb", "Coulomb", "Tresca"])
    scene.contact("ground_top_m", "bolt_foot", Law("Tied"))
    scene.contact("left_top", "bolt_under_l", law)
    scene.contact("right_top", "bolt_under_r", law)
    scene.contact("ground_top_l", "left_bottom", law)
    scene.contact("ground_top_r", "right_bottom", law)
    area = 2 * shank * (depth if scene.d == 3 else 1)
    scene.conditions.append(("bolt", "Preload", (scene.vector((0, 1)), high, scene.load * area * r.uniform(0.5, 2)), None))
    scene.traction("left_left", (r.uniform(0, 0.05), 0))
    if r.random() < 0.3:
        scene.cycle(steps=3)


def wall(scene):
    """Bricks in running bond, each of the upper row on two others; loads are weight and a small push."""
    r = scene.random
    rows, across, depth = 2, r.randint(2, 4), 0.8
    cells, layers = scene.cells(r.choice([4, 6]), r.randint(2, 3)), 2
    law = scene.law(["Coulomb"], mu=r.uniform(0.4, 0.9))
    bricks = {}
    for j in range(rows):
        for i in range(across - j % 2):
            x = i + (0.5 if j % 2 else 0.0)
            name = bricks[j, i] = "b%d_%d" % (j, i)
            scene.box(name, (x, x + 1.0), (0.5 * j, 0.5 * j + 0.5), cells, depth=depth, layers=layers, young=1.0)
            scene.weight(name, (0, -1.0))
            if j == 0:
                scene.fix(name + "_bottom")
    heads = r.random() < 0.5
    for (j, i), name in bricks.items():
        if heads and (j, i + 1) in bricks:
            scene.contact(name + "_right", bricks[j, i + 1] + "_left", law)
    for j in range(1, rows):
        scene.contact([name + "_top" for (k, _), name in bricks.items() if k == j - 1], [name + "_bottom" for (k, _), name in bricks.items() if k == j], law)
    scene.traction(bricks[rows - 1, 0] + "_top", (r.uniform(-0.1, 0.1), -r.uniform(0, 0.3)))


def glued(scene):
    """Layers glued to each other, clamped at one end or both."""
    r = scene.random
    count, length, depth, both = r.randint(2, 4), r.uniform(1.5, 4), r.uniform(0.5, 1), r.random() < 0.5
    layers, n, y = scene.cells(1, r.randint(4, 6))[1], r.randint(8, 16), 0.0
    for k in range(count):
        height = r.uniform(0.2, 0.5)
        scene.box("l%d" % k, (0, length), (y, y + height), scene.cells(n if r.random() < 0.5 else r.randint(8, 16), r.randint(2, 3)), depth=depth, layers=layers)
        scene.fix("l%d_left" % k)
        if both:
            scene.fix("l%d_right" % k)
        if k > 0:
            scene.contact("l%d_top" % (k - 1), "l%d_bottom" % k, Law(r.choice(["Tied", "Tied", "No Separation"])))
        y += height
    scene.pressure("l%d_top" % (count - 1), r.uniform(0.1, 1))
    if r.random() < 0.3:
        scene.cycle()


def mean(scene):
    """A block on another; its top has a prescribed mean displacement."""
    r = scene.random
    width, height, depth = r.uniform(0.6, 1.5), r.uniform(0.4, 0.9), r.uniform(0.6, 1)
    scene.box("base", (-1.2, 1.2), (-0.6, 0), scene.cells(r.randint(8, 16), r.randint(2, 4)), depth=depth)
    scene.box("block", (-width / 2, width / 2), (0, height), scene.cells(r.randint(5, 12), r.randint(3, 6)), depth=depth)
    scene.fix("base_bottom")
    law = scene.law(["Coulomb", "Coulomb", "Tresca", "Tied"], mu=r.uniform(0.2, 0.9))
    scene.contact("base_top", "block_bottom", law)
    size = scene.load * height
    scene.conditions.append(("block_top", "Mean Displacement", scene.vector([r.uniform(-0.2, 0.2) * size, -size]), None))


def groove(scene):
    friction_round.groove(scene)


def ball(scene):
    (friction_round.ball if scene.d == 3 else friction_round.cylinder)(scene)


FAMILIES = [(stack, 3), (cycle, 2), (table, 2), (shrink_fit, 2), (bolt, 2), (wall, 2), (glued, 2), (mean, 2), (groove, 2), (ball, 2)]


def scene(seed, family=None, dimension=None):
    """Returns the scene for a seed."""
    return fill(WideScene(seed, dimension), FAMILIES, family)
