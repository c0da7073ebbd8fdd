"""Random 2D scenes for bounds of the energy error: polygons of several materials, contact on matching sides and on rigid obstacles, gaps,
loads that end at corners, mixed supports. The sides are straight, so that a finer mesh has the same geometry and the same exact solution."""
import math

from friction_builder import Law, Scene, fill
from friction_grids import CELLS as CELLS_OF
from friction_grids import straight

# Both kinds of mixed cells: each part of a body has one of them.
MIXED = {"Mixed of order 1": ["Triangle3", "Quadrilateral4"], "Mixed of order 2": ["Triangle6", "Quadrilateral8", "Quadrilateral9"]}
CELLS = ["Triangle3"] * 6 + ["Triangle6"] * 6 + ["Quadrilateral4"] * 3 + ["Quadrilateral8"] * 2 + ["Quadrilateral9"] * 2 + sorted(MIXED) * 2
SIDES = {"left": ("s0", -1, 0), "right": ("s1", 1, 0), "bottom": ("t0", 0, -1), "top": ("t1", 0, 1)}
FLAWED = 0.15  # share of scenes with something that makes a bound an estimate


class Polygon:
    """A body on a grid of rectangles, some of them left out, mapped to a quadrilateral."""

    def __init__(self, scene, name, x, y, absent=(), corners=None):
        """`x`, `y`: ascending bounds of the rectangles; `absent`: {(column, row)}; `corners`: of the body, default: those of the grid."""
        self.name, self.x, self.y = name, x, y
        self.present = {(i, j) for i in range(len(x) - 1) for j in range(len(y) - 1)} - set(absent)
        self.sides = {}
        corners = corners or [(x[0], y[0]), (x[-1], y[0]), (x[-1], y[-1]), (x[0], y[-1])]
        whole, patches = straight(*corners), []
        for i, j in sorted(self.present):
            def place(s, t, i=i, j=j):
                return whole((x[i] + (x[i + 1] - x[i]) * s - x[0]) / (x[-1] - x[0]), (y[j] + (y[j + 1] - y[j]) * t - y[0]) / (y[-1] - y[0]))
            outer = {face: "%s_%d_%d" % (side, i, j) for side, (face, di, dj) in SIDES.items() if (i + di, j + dj) not in self.present}
            for side, (face, _, _) in SIDES.items():
                if face in outer:
                    self.sides.setdefault(side, {})[i, j] = "%s_%s" % (name, outer[face])
            cells = [max(1, round(scene.density * (b - a))) for a, b in ((x[i], x[i + 1]), (y[j], y[j + 1]))]
            patches.append((tuple(cells), place, outer))
        scene.polygon(name, patches)

    def side(self, name, columns=None):
        """Groups of one side, all of it or that of some columns (left, right: rows)."""
        of = self.sides[name]
        at = 1 if name in ("left", "right") else 0
        return [group for key, group in sorted(of.items()) if columns is None or key[at] in columns]

    def outer(self, name):
        """Groups of the outermost side: of an L, the left side of the lowest column only."""
        axis, last = (0, len(self.x) - 2) if name in ("left", "right") else (1, len(self.y) - 2)
        return [group for key, group in sorted(self.sides[name].items()) if key[axis] == (last if name in ("right", "top") else 0)]


class BoundScene(Scene):
    """`refine`: factor on all numbers of cells; the rest of the scene does not depend on it. `law`: kind of all contacts of two bodies."""

    def __init__(self, seed, refine=1, law=None):
        super().__init__(seed, 2)
        self.refine, self.regions, self.flaws, self.given = refine, {}, [], law
        self.cell = self.random.choice(CELLS)
        self.cells = MIXED.get(self.cell, [self.cell])
        self.order = CELLS_OF[self.cells[0]][1]
        self.model = self.random.choice(["Plane Strain", "Plane Strain", "Plane Stress"])
        self.load *= 0.1  # no side slides by an element of the finer mesh
        self.density = self.random.uniform(4, 9) * (0.6 if self.order == 2 else 1.0)  # cells per length
        self.soft = self.order == 2 and self.model == "Plane Strain" and self.random.random() < 0.15
        self.flawed = self.random.random() < FLAWED
        self.tolerance = self.random.choice([1e-10, 1e-8, 1e-8, 1e-5])

    def polygon(self, name, patches):
        """A body; some of its patches are regions of another material."""
        young = 10 ** self.random.uniform(0, self.jump)
        first = len(self.mesh.elements)
        index, self.bodies[name] = {}, young
        for number, (cells, place, sides) in enumerate(patches):
            turned = lambda *at, place=place: tuple(self.length * x for x in self.turned(place(*at)))
            cell = self.cells[0] if len(self.cells) == 1 else self.random.choice(self.cells)
            self.mesh.patch(name, cell, [self.refine * n for n in cells], turned, sides, index)
            if len(patches) > 1 and self.random.random() < 0.25:
                region = "%s_part_%d" % (name, number)
                self.regions[region] = name, young * 10 ** self.random.uniform(-1.5, 1.5)
                body, group = self.mesh.group(2, name), self.mesh.group(2, region)
                own = [(kind, group, nodes) for kind, of, nodes in self.mesh.elements[first:] if of == body]
                self.mesh.elements += own
            first = len(self.mesh.elements)
        self.straighten()

    def straighten(self):
        """Puts the middle nodes of edges and elements halfway between their vertices: diagonals of a skewed grid are curves."""
        more = {number: middles for number, _, middles in CELLS_OF.values()}
        for kind, _, nodes in self.mesh.elements:
            vertices = len(nodes) - len(more.get(kind, []))
            for node, of in zip(nodes[vertices:], more.get(kind, [])):
                self.mesh.nodes[node - 1] = tuple(sum(self.mesh.nodes[nodes[k] - 1][c] for k in of) / len(of) for c in range(3))

    def volumes(self):
        """Elements of the scene as it is with refine = 1, so that the number of subdomains is the same; each of a region is listed twice."""
        return super().volumes() // self.refine ** 2

    def body_lines(self, name):
        own = [(region, "m" + region) for region, (body, _) in self.regions.items() if body == name]
        if not own:
            return super().body_lines(name)
        lines = ['<ParameterList name="Regions">']
        for region, material in own:
            lines += ['  <ParameterList name="%s"><Parameter name="Group" type="string" value="%s"/><Parameter name="Material" type="string" value="%s"/>'
                      "</ParameterList>" % (region, region, material)]
        return [*super().body_lines(name), *lines, "</ParameterList>"]

    def materials(self):
        return {**super().materials(), **{region: young for region, (_, young) in self.regions.items()}}

    def material(self, name, young):
        """On the finer mesh elements of displacements only, since the energy of the reference must lie above that of the exact solution."""
        enhanced = self.soft or "Quadrilateral4" in self.cells
        plain = ['<Parameter name="Element" type="string" value="Displacement"/>'] if enhanced and self.refine > 1 else []
        return [*super().material(name, young), *plain]

    @property
    def poisson(self):
        return 0.4999 if self.soft else super().poisson

    # Conditions ------------------------------------------------------------------------------------------------------------------------
    def hold(self, body):
        """Holds a body at its bottom: clamped, partly clamped, or on rollers."""
        r, bottom = self.random, body.side("bottom")
        kind = r.choice(["clamped", "part", "rollers"])
        if kind == "part" and len(bottom) > 1:
            clamped = r.randrange(len(bottom))
            self.fix(bottom.pop(clamped))
            self.roller(bottom)
        elif kind == "rollers":
            self.roller(bottom)
            self.roller(body.outer("left"))
        else:
            self.fix(bottom)

    def press(self, body, tilted=True):
        """Presses a body down at its top: moved, or loaded and held sideways by rollers."""
        r, top = self.random, body.outer("top")
        if r.random() < 0.5:
            size, tilt = self.load * r.uniform(0.5, 3), r.uniform(-0.5, 0.5) * self.load if tilted else 0.0
            self.move(top, [r.uniform(-0.5, 0.5) * size, -size], [[0, -tilt], [tilt, 0]] if tilt else None, (body.x[0], body.y[-1]))
            return
        self.roller(body.outer("left"))
        # Pressure everywhere or from a corner on; it may vary along the side.
        self.pressure(top if r.random() < 0.5 else top[:1], r.uniform(0.3, 2))
        if r.random() < 0.4:
            self.traction(body.outer("right"), (r.uniform(-0.3, 0.3), 0))
        if r.random() < 0.3:
            self.weight(body.name, (0, -r.uniform(0.1, 1)))
        if r.random() < 0.3:
            self.conditions.append((top, "Traction", [0.0, -self.load * r.uniform(0.1, 0.5)], self.wave()))

    def wave(self):
        """A factor that depends on the position and is not a polynomial."""
        r = self.random
        return "(1 + 0.5*sin(%.17g*x + %.17g*y))" % self.turned([r.uniform(-4, 4) / self.length for _ in range(2)])

    def touch(self, below, above):
        """Contact of two sides, sometimes with friction."""
        law = Law("Frictionless")
        if self.flawed and self.random.random() < 0.5:
            law = self.law(["Coulomb", "Tresca"], mu=self.random.uniform(0.1, 0.6))
            self.flaws.append("friction")
        if self.given:
            law = Law(self.given, mu=self.random.uniform(0.1, 0.6)) if self.given == "Coulomb" else Law(self.given, bound=10 ** self.random.uniform(-1, 0.3))
        self.contact(below, above, law)


def bounds(random, low, high, parts):
    """Ascending numbers from low to high; no part is shorter than a quarter of the average."""
    cuts = sorted(random.uniform(0, 1) for _ in range(parts - 1))
    even = [k / parts for k in range(parts + 1)]
    return [low + (high - low) * (0.75 * e + 0.25 * c) for e, c in zip(even, [0, *cuts, 1])]


def below(scene, x, margin, height):
    """A block below y = 0 with the columns `x`, wider by `margin` on both sides; returns it and the groups of its top below x."""
    wide = [x[0] - margin, *x, x[-1] + margin] if margin else list(x)
    base = Polygon(scene, "base", wide, bounds(scene.random, -height, 0.0, scene.random.randint(1, 2)))
    columns = range(1, len(x)) if margin else range(len(x) - 1)
    scene.hold(base)
    return base, base.side("top", columns)


def pile(scene):
    """A body on a block, of equal width or narrower; its outer corners may be skewed."""
    r = scene.random
    width, height = r.uniform(0.8, 2), r.uniform(0.5, 1.2)
    x, y = bounds(r, 0.0, width, r.randint(1, 3)), bounds(r, 0.0, height, r.randint(1, 2))
    _, top = below(scene, x, r.choice([0.0, r.uniform(0.3, 0.8)]), r.uniform(0.4, 1))
    lean = r.uniform(-0.2, 0.3) * height
    upper = Polygon(scene, "upper", x, y, corners=[(0, 0), (width, 0), (width + lean, height), (0, height)])
    scene.touch(top, upper.side("bottom"))
    scene.press(upper)


def angle(scene):
    """A body with a re-entrant corner on a block, which it may leave."""
    r = scene.random
    width, height = r.uniform(1, 2), r.uniform(0.8, 1.6)
    x, y = bounds(r, 0.0, width, 2), bounds(r, 0.0, height, 2)
    _, top = below(scene, x, r.choice([0.0, r.uniform(0.3, 0.6)]), r.uniform(0.4, 0.8))
    upper = Polygon(scene, "upper", x, y, absent=[(1, 1)])
    scene.touch(top, upper.side("bottom"))
    scene.press(upper)
    if r.random() < 0.5:
        scene.traction(upper.side("top", [1]), (0, r.uniform(-0.6, 0.2)))


def wedge(scene):
    """Sides with a gap that grows along them: closed at one end, open at the other."""
    r = scene.random
    width, height = r.uniform(0.8, 2), r.uniform(0.5, 1)
    x = bounds(r, 0.0, width, r.randint(1, 2))
    _, top = below(scene, x, r.choice([0.0, 0.4]), r.uniform(0.4, 1))
    rise = scene.load * r.uniform(0.2, 4)
    ends = (0.0, rise) if r.random() < 0.5 else (rise, 0.0)
    upper = Polygon(scene, "upper", x, [0.0, height], corners=[(0, ends[0]), (width, ends[1]), (width, height), (0, height)])
    scene.touch(top, upper.side("bottom"))
    size = scene.load * r.uniform(1, 3)
    scene.move(upper.side("top"), [0.0, -size])


def ground(scene):
    """A polygon on a rigid half-plane, with a gap that may grow along its side."""
    r = scene.random
    width, height = r.uniform(0.8, 2), r.uniform(0.6, 1.4)
    x, y = bounds(r, 0.0, width, r.randint(1, 3)), bounds(r, 0.0, height, r.randint(1, 2))
    absent = [(r.randrange(1, len(x) - 1), len(y) - 2)] if len(x) > 2 and len(y) > 2 and r.random() < 0.6 else []
    rise = r.choice([0.0, scene.load * r.uniform(0.2, 2)])
    body = Polygon(scene, "body", x, y, absent, [(0, 0), (width, rise), (width * r.uniform(0.8, 1.2), height), (0, height)])
    law = Law("Frictionless")
    scene.flat(body.side("bottom"), (0, -r.choice([0.0, 0.3]) * scene.load), (0, 1), law)
    if rise:
        scene.move(body.outer("top"), [0.0, -scene.load * r.uniform(1, 3)])
    else:
        scene.press(body)


def disc(scene):
    """A straight side on a rigid circle."""
    r = scene.random
    width, height = r.uniform(0.8, 2), r.uniform(0.6, 1.4)
    radius = width * width / (8 * scene.load * r.uniform(0.5, 5))  # contact over a good part of the side
    body = Polygon(scene, "body", bounds(r, -width / 2, width / 2, r.randint(1, 3)), [0.0, height])
    scene.round(body.side("bottom"), (r.uniform(-0.2, 0.2) * width, -radius), radius, Law("Frictionless"))
    scene.press(body, tilted=False)


def window(scene):
    """A clamped plate with a hole or a notch, without contact; a load that ends at a corner."""
    r = scene.random
    width, height = r.uniform(1, 2), r.uniform(0.8, 1.6)
    x, y = bounds(r, 0.0, width, 3), bounds(r, 0.0, height, 3)
    skew = lambda: r.uniform(-0.15, 0.15)
    plate = Polygon(scene, "plate", x, y, [(1, 1)] + ([(1, 2)] if r.random() < 0.4 else []),
                    [(0, 0), (width, 0), (width + skew(), height + skew()), (skew(), height + skew())])
    scene.hold(plate)
    scene.traction(r.choice(plate.outer("right")), (r.uniform(-1, 1), r.uniform(-1, 1)))
    scene.pressure(r.choice(plate.side("top")), r.uniform(-1, 1))
    if r.random() < 0.3:
        scene.conditions.append(("plate", "Body Force", [0.0, -scene.load], scene.wave()))


def shelves(scene):
    """Stacked beams, each clamped at its left end, pressed together."""
    r = scene.random
    width, level = r.uniform(1.5, 3), 0.0
    x, count = bounds(r, 0.0, width, r.randint(1, 2)), r.randint(2, 3)
    below_ = None
    for k in range(count):
        height = r.uniform(0.3, 0.6)
        beam = Polygon(scene, "beam%d" % k, x, [level, level + height])
        scene.fix(beam.outer("left"))
        if below_:
            scene.touch(below_.side("top"), beam.side("bottom"))
        level, below_ = level + height, beam
    scene.pressure(below_.side("top")[-1:], r.uniform(0.5, 3) * (height / width) ** 3)


FAMILIES = [(pile, 4), (angle, 3), (wedge, 2), (ground, 3), (disc, 2), (window, 2), (shelves, 2)]


def scene(seed, refine=1, family=None, law=None):
    """The scene of a seed. `law`: with this law in contacts of two bodies, in families that have some."""
    families = [one for one in FAMILIES if one[0] in (pile, angle, wedge, shelves)] if law else FAMILIES
    return fill(BoundScene(seed, refine, law), families, family)
