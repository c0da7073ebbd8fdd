"""Random 3D scenes for bounds of the energy error: blocks of hexahedra, wedges or tetrahedra with plane sides and warped cells, contact on
matching sides and on a rigid plane. A finer mesh has the same bodies and the same exact solution."""
import math

from bound_scenes import bounds
from friction_builder import Law, Scene, fill
from friction_grids import CELLS as CELLS_OF
from friction_grids import straight

CELLS = ["Hexahedron8"] * 8 + ["Wedge6"] * 3 + ["Hexahedron27"] * 3 + ["Hexahedron20"] * 2 + ["Tetrahedron4"] * 2
SIDES = {"s0": "left", "s1": "right", "t0": "bottom", "t1": "top", "r0": "front", "r1": "back"}


class Block:
    """A prism over a quadrilateral in the plane of x and y, in parts along x; inside of each part the cells are warped."""

    def __init__(self, scene, name, x, y, corners=None, depth=1.0):
        self.name, self.x, self.y, self.depth = name, x, y, depth
        corners = corners or [(x[0], y[0]), (x[-1], y[0]), (x[-1], y[1]), (x[0], y[1])]
        whole, patches, r = straight(*corners), [], scene.random
        for i in range(len(x) - 1):
            size = 0.12 * min(x[i + 1] - x[i], y[1] - y[0], depth)
            waves = [[r.uniform(-4, 4) for _ in range(3)] for _ in range(3)]

            def place(s, t, u, i=i, size=size, waves=waves):
                flat = whole((x[i] + (x[i + 1] - x[i]) * s - x[0]) / (x[-1] - x[0]), t)
                inside = size * math.sin(math.pi * s) * math.sin(math.pi * t) * math.sin(math.pi * u)
                moved = [inside * math.cos(sum(a * b for a, b in zip(wave, (s, t, u)))) for wave in waves]
                return flat[0] + moved[0], flat[1] + moved[1], depth * u + moved[2]
            sides = {face: side for face, side in SIDES.items() if not (face == "s0" and i > 0 or face == "s1" and i + 2 < len(x))}
            sides = {face: side if side in ("left", "right") else "%s_%d" % (side, i) for face, side in sides.items()}
            cells = [max(1, round(scene.density * (b - a))) for a, b in ((x[i], x[i + 1]), (y[0], y[1]), (0, depth))]
            patches.append((tuple(cells), place, sides))
        scene.solid(name, patches)

    def side(self, name):
        if name in ("left", "right"):
            return ["%s_%s" % (self.name, name)]
        return ["%s_%s_%d" % (self.name, name, i) for i in range(len(self.x) - 1)]


class SolidScene(Scene):
    """`refine`: factor on all numbers of cells; the rest of the scene does not depend on it."""

    def __init__(self, seed, refine=1):
        super().__init__(seed, 3)
        self.refine, self.flaws = refine, []
        self.cell = self.random.choice(CELLS)
        self.cells, self.order = [self.cell], CELLS_OF[self.cell][1]
        self.load *= 0.1
        self.density = self.random.uniform(2.5, 4) * (0.6 if self.order == 2 else 1.0)  # cells per length
        self.tolerance = self.random.choice([1e-10, 1e-8, 1e-5])

    def solid(self, name, patches):
        young = 10 ** self.random.uniform(0, self.jump)
        index, self.bodies[name] = {}, young
        for cells, place, sides in patches:
            turned = lambda *at, place=place: tuple(self.length * x for x in self.turned(place(*at)))
            self.mesh.patch(name, self.cell, [self.refine * n for n in cells], turned, sides, index)
        more = {number: middles for number, _, middles in CELLS_OF.values()}
        for kind, _, nodes in self.mesh.elements:
            vertices = len(nodes) - len(more.get(kind, []))
            for node, of in zip(nodes[vertices:], more.get(kind, [])):
                self.mesh.nodes[node - 1] = tuple(sum(self.mesh.nodes[nodes[k] - 1][c] for k in of) / len(of) for c in range(3))

    def volumes(self):
        return super().volumes() // self.refine ** 3

    def material(self, name, young):
        """On the finer mesh and with contacts elements of displacements only, since the energies of the displacements are compared."""
        enhanced = self.cell == "Hexahedron8" and self.refine == 1 and not self.contacts
        plain = ['<Parameter name="Element" type="string" value="Displacement"/>'] if self.cell == "Hexahedron8" and not enhanced else []
        return [*super().material(name, young), *plain]

    @property
    def poisson(self):
        return (0.0, 0.2, 0.3, 0.4)[self.seed % 4]

    def hold(self, block):
        kind = self.random.choice(["clamped", "rollers"])
        if kind == "clamped":
            self.fix(block.side("bottom"))
            return
        self.roller(block.side("bottom"))
        self.roller(block.side("left"))
        self.roller(block.side("front"))

    def press(self, block):
        r, top = self.random, block.side("top")
        if r.random() < 0.4:
            self.move(top, [r.uniform(-0.3, 0.3) * self.load, -self.load * r.uniform(0.5, 2), 0.0])
            return
        self.roller(block.side("left"))
        self.roller(block.side("front"))
        self.pressure(top if r.random() < 0.5 else top[:1], r.uniform(0.3, 2))
        if r.random() < 0.4:
            self.traction(block.side("right"), (r.uniform(-0.3, 0.3), 0))
        if r.random() < 0.4:
            self.weight(block.name, (0, -r.uniform(0.1, 1)))


def column(scene):
    """A block without contact."""
    r = scene.random
    width, height, lean = r.uniform(0.8, 1.6), r.uniform(0.6, 1.4), r.uniform(-0.2, 0.2)
    block = Block(scene, "block", bounds(r, 0.0, width, r.randint(1, 2)), [0.0, height],
                  [(0, 0), (width, 0), (width * r.uniform(0.8, 1.1), height), (lean if r.random() < 0.5 else 0.0, height)])
    scene.fix(block.side("bottom"))
    scene.pressure(block.side("top"), r.uniform(-1, 1))
    scene.traction(block.side("right"), (r.uniform(-1, 1), r.uniform(-1, 1)))
    if r.random() < 0.5:
        scene.weight("block", (0, -r.uniform(0.1, 1)))


def pile(scene):
    """A block on a block of the same or a larger width."""
    r = scene.random
    width, height, low = r.uniform(0.8, 1.5), r.uniform(0.5, 1.0), r.uniform(0.4, 0.8)
    margin, x = r.choice([0.0, 0.5]), bounds(r, 0.0, width, r.randint(1, 2))
    base = Block(scene, "base", [x[0] - margin, *x, x[-1] + margin] if margin else x, [-low, 0.0])
    upper = Block(scene, "upper", x, [0.0, height], [(0, 0), (width, 0), (width * r.uniform(0.85, 1.1), height), (0, height)])
    scene.hold(base)
    top = base.side("top")
    scene.contact(top[1:-1] if margin else top, upper.side("bottom"), Law("Frictionless"))
    scene.press(upper)


def ground(scene):
    """A block on a rigid plane, with a gap that may grow along its side."""
    r = scene.random
    width, height = r.uniform(0.8, 1.5), r.uniform(0.6, 1.2)
    rise = r.choice([0.0, scene.load * r.uniform(0.2, 2)])
    block = Block(scene, "block", bounds(r, 0.0, width, r.randint(1, 2)), [0.0, height], [(0, 0), (width, rise), (width, height), (0, height)])
    scene.flat(block.side("bottom"), (0, 0), (0, 1), Law("Frictionless"))
    if rise:
        scene.move(block.side("top"), [0.0, -scene.load * r.uniform(1, 3), 0.0])
    else:
        scene.press(block)


FAMILIES = [(column, 2), (pile, 4), (ground, 3)]


def scene(seed, refine=1, family=None, law=None):
    """The scene of a seed."""
    return fill(SolidScene(seed, refine), FAMILIES, family)
