"""Random scenes whose bodies move far on flat sides, with the forces and motions of statics and kinematics."""
import math

from friction_grids import straight

EXACT = 1e-5     # forces of statics, relative to the weight


def near(what, found, expected, tolerance):
    """Text if a value is not as expected."""
    return "" if abs(found - expected) <= tolerance else "%s is %.9g, not %.9g" % (what, found, expected)


def carries(scene, contact, weight, up=1):
    """Checks that a contact carries a weight at each step, on its second side."""
    scene.check(lambda run: next((said for said in (near("normal force of '%s' at step %d over the weight" % (contact, k + 1),
                                                         -run.force(contact, k)[up] / weight, 1.0, EXACT) for k in run.steps) if said), ""))


def obeys(scene, contact, mu, up=1):
    """Checks Coulomb's bound at each step."""
    def within(run):
        for k in run.steps:
            force = run.force(contact, k)
            along = math.sqrt(sum(x * x for i, x in enumerate(force) if i != up))
            # Sides turn by the order of the strain.
            if along > (mu + 1e-4 + 20 * scene.load) * abs(force[up]) + 1e-9 * scene.load:
                return "friction of '%s' at step %d is %.9g, its bound %.9g" % (contact, k + 1, along, mu * abs(force[up]))
        return ""
    scene.check(within)


def rubs(scene, contact, mu, weight, moving, least):
    """Checks that friction on the second side is mu times the weight in the direction of x in which the first side slides. `moving`: its
    position at a step; steps that slide by less than `least` are left out."""
    def full(run):
        for k in run.steps[1:]:
            by = moving(run, k) - moving(run, k - 1)
            said = near("friction of '%s' at step %d over the weight" % (contact, k + 1), run.force(contact, k)[0] / weight,
                        math.copysign(mu, by), 1e-4 + 20 * scene.load) if abs(by) > least else ""
            if said:
                return said
        return ""
    scene.check(full)


def forth_and_back(scene, size):
    """Turning points of a path."""
    r = scene.random
    turns = [r.choice([-1, 1])]
    while len(turns) < 3 and r.random() < 0.4:
        turns.append(r.choice([0.0, -turns[-1], r.uniform(-1, 1)]))
    return [size * t for t in turns]


def base(scene, half, depth, height=0.5, name="base"):
    """A block under the plane y = 0, held below."""
    scene.kind()
    r = scene.random
    scene.box(name, (-half, half), (-height, 0), scene.cells(r.randint(8, 26), r.randint(2, 5)), depth=depth,
              layers=r.randint(3, 5) if scene.d == 3 else None, young=scene.stiffness())
    scene.hold(name + "_bottom")


def brick(scene, name, x, y, depth):
    scene.kind()
    r = scene.random
    scene.box(name, x, y, scene.cells(r.randint(4, 14), r.randint(2, 7)), depth=depth, layers=r.randint(2, 4) if scene.d == 3 else None,
              young=scene.stiffness())


def plain(scene, rotation=0.0):
    """Rotation about z alone, with the other ones held."""
    return rotation if scene.d == 2 else [0.0, 0.0, rotation]


def slide(scene):
    """A block under a weight slides on a base, forth and back; its top is held upright, turned, or free to turn."""
    r = scene.random
    width, height, depth = r.uniform(1, 3), r.uniform(0.4, 2), r.uniform(0.6, 1.5)
    half = r.uniform(1, 2.5) * width
    law = scene.friction(0, r.choice([0.0, 0.6, 0.6, 0.6]))
    turn = r.choice(["held", "turned", "free"])
    if turn == "free" and (law.mu * height > 0.4 * width or scene.d == 3):
        turn = "held"  # it would topple
    scene.turn_axes()
    base(scene, half, depth * r.choice([1.0, 1.5]))
    brick(scene, "block", (-width / 2, width / 2), (0, height), depth)
    weight = scene.load * width * (depth if scene.d == 3 else 1)
    path = scene.steps(forth_and_back(scene, 1.0))
    by = r.uniform(0.1, 0.8) * half
    angle = r.uniform(-0.15, 0.15) if turn == "turned" else 0.0
    upright = r.choice([True, False]) and scene.d == 3 and turn == "turned"
    rotation = None if turn == "free" else plain(scene, angle)
    if upright:
        rotation = [0.0, 10 * angle, 0.0]  # about the normal of the base
    scene.motion("block_top", (0, height), (by, None, 0.0), rotation, path)
    scene.push("block_top", (0, -weight))
    scene.touch("joint", "block_bottom", "base_top", law)
    carries(scene, "joint", weight)
    obeys(scene, "joint", law.mu)
    if turn != "turned":
        rubs(scene, "joint", law.mu, weight, lambda run, k: run.group("block_top", k)[0][0], 30 * scene.load * (height + 1))


def stack(scene):
    """Two or three blocks one above the other. One is driven; each of the others moves with the neighbour that holds it more."""
    r = scene.random
    n, width, depth = r.choice([2, 2, 3]), r.uniform(1.5, 3), r.uniform(0.8, 1.5)
    scene.turn_axes()
    by = r.uniform(0.1, 0.3) * width * r.choice([-1, 1])
    base(scene, width, depth)
    heights, at, weights, mus = [], 0.0, [], [r.uniform(0.05, 0.6) for _ in range(n)]
    driven = r.randrange(n)
    for k in range(n):
        heights.append(r.uniform(0.15, 0.35) * width)
        side = width * r.uniform(0.8, 1.0)
        brick(scene, "block%d" % k, (-side / 2, side / 2), (at, at + heights[k]), depth)
        weights.append(scene.load * side * heights[k] * r.uniform(0.3, 3) * (depth if scene.d == 3 else 1))
        scene.gravity("block%d" % k, (0, -weights[k] / (side * heights[k] * (depth if scene.d == 3 else 1))))
        at += heights[k]
    normal = [sum(weights[k:]) for k in range(n)]
    # Blocks below the driven one: the joint with the smallest bound slides. Those above move with it.
    bounds = [mus[k] * normal[k] for k in range(driven + 1)]
    slides = min(range(driven + 1), key=lambda k: bounds[k])
    if driven > 0 and sorted(bounds)[1] < 1.1 * bounds[slides]:
        mus[slides] *= 0.8
        bounds[slides] *= 0.8
    for k in range(n):
        scene.touch("joint%d" % k, "block%d_bottom" % k, "block%d_top" % (k - 1) if k else "base_top", scene.friction(mus[k], mus[k]))
        carries(scene, "joint%d" % k, normal[k])
        obeys(scene, "joint%d" % k, mus[k])
    group = "block%d_%s" % (driven, r.choice(["left", "right"]))
    x = width / 2
    path = scene.steps(forth_and_back(scene, 1.0))
    scene.motion(group, (0, sum(heights[:driven]) + 0.5 * heights[driven]), (by, None, 0.0),
                 None if scene.d == 2 else [0.0, 0.0, None], path)
    small = 100 * scene.load * (x + at)

    def moves(run):
        for k in range(n):
            found = run.body("block%d" % k)[0][0]
            said = near("path of block %d" % k, found, path[-1] * by if k >= slides else 0.0, small)
            if said and len(path) <= 2:
                return said
        return ""
    scene.check(moves)
    rubs(scene, "joint%d" % slides, mus[slides], normal[slides], lambda run, k: run.group(group, k)[0][0], small)


def ramp(scene):
    """A wedge with the angle a is pushed under a loaded block, or drawn out: P = W (tan(a + phi) + tan(phi'))."""
    r = scene.random
    a, depth = r.uniform(0.05, 0.4), r.uniform(0.6, 1.2)
    mu, below = r.choice([0.0, r.uniform(0, 0.6)]), r.uniform(0, 0.6)
    if math.tan(a) + mu > 0.7:
        mu = 0.0
    length, thin = r.uniform(2, 4), r.uniform(0.2, 0.4)
    wide, t = r.uniform(0.3, 0.5) * length, math.tan(a)
    scene.turn_axes()
    base(scene, 1.5 * length, depth)
    scene.kind()
    n, m = r.randint(8, 24), r.randint(2, 4)
    # The wedge rises to the right; the block rests on its middle.
    scene.extruded("wedge", [(scene.cells(n, m), straight((-length / 2, 0), (length / 2, 0), (length / 2, thin + length * t), (-length / 2, thin)),
                              {"t0": "bottom", "t1": "slope", "s1": "back"})], depth, r.randint(2, 3), scene.stiffness())
    scene.kind()
    at = lambda x: thin + (x + length / 2) * t
    high = at(wide / 2) + r.uniform(0.3, 0.8)
    scene.extruded("block", [(scene.cells(r.randint(4, 12), r.randint(2, 6)),
                              straight((-wide / 2, at(-wide / 2)), (wide / 2, at(wide / 2)), (wide / 2, high), (-wide / 2, high)),
                              {"t0": "bottom", "t1": "top"})], depth, r.randint(2, 3), scene.stiffness())
    weight = scene.load * wide * (depth if scene.d == 3 else 1)
    way = r.uniform(0.1, 0.45) * (length - wide) * r.choice([-1, 1])
    path = scene.steps([1.0, r.uniform(-0.5, 0.5)] if r.random() < 0.4 else [1.0])
    scene.motion("wedge_back", (length / 2, 0), (-way, None, 0.0), plain(scene), path)
    scene.motion("block_top", (0, high), (0.0, None, 0.0), plain(scene))
    scene.push("block_top", (0, -weight))
    scene.touch("slope", "block_bottom", "wedge_slope", scene.friction(mu, mu))
    scene.touch("floor", "wedge_bottom", "base_top", scene.friction(below, below))
    carries(scene, "floor", weight)
    obeys(scene, "floor", below)
    least = 100 * scene.load * (length + high)

    def holds(run):
        for k in run.steps[1:]:
            here, before = run.group("wedge_back", k)[0], run.group("wedge_back", k - 1)[0]
            by = before[0] - here[0]  # under the block
            if abs(by) < least:
                continue
            sign = math.copysign(1.0, by)
            expected = math.tan(a + sign * math.atan(mu)) + sign * below
            force = run.reaction("wedge_back", k)[0]
            said = near("push of the wedge at step %d over the weight" % (k + 1), -force[0] / weight, expected, 2e-3 + 20 * scene.load)
            lift = run.group("block_top", k)[0][1] - run.group("block_top", k - 1)[0][1]
            said = said or near("lift of the block at step %d" % (k + 1), lift, by * t, least)
            if said:
                return said
        return ""
    scene.check(holds)


def rock(scene):
    """A block is tilted about its edge by a force at the height of its centre: H / W = tan(alpha - angle)."""
    r = scene.random
    scene.load = 10 ** r.uniform(-6, -4)
    b, h, depth = 1.0, r.uniform(1.8, 3.5), r.uniform(0.6, 1.2)
    scene.turn_axes()
    base(scene, 2.2, depth)
    scene.kind()
    scene.box("block", (-b, b), (0, 2 * h), scene.cells(r.randint(4, 12), r.randint(6, 20)), depth=depth, layers=2, young=scene.stiffness())
    mu = r.uniform(1.2 * b / h, max(0.6, 1.3 * b / h))
    size = 2 * b * 2 * h * (depth if scene.d == 3 else 1)
    scene.gravity("block", (0, -scene.load))
    alpha, weight = math.atan(b / h), scene.load * size
    way = r.uniform(0.2, 1.2) * b * r.choice([-1, 1])
    path = scene.steps([1.0] if r.random() < 0.6 else [1.0, r.choice([0.2, 0.5])], 10)
    scene.motion("block_top", (0, h), (way, None, 0.0), None if scene.d == 2 else [0.0, 0.0, None], path)
    scene.touch("joint", "block_bottom", "base_top", scene.friction(mu, mu))
    carries(scene, "joint", weight)
    obeys(scene, "joint", mu)

    def tilts(run):
        for k in run.steps:
            moved, turn = run.group("block_top", k)
            angle = abs(turn if scene.d == 2 else turn[2])
            if abs(moved[0]) < 0.05 * b:
                continue
            force = run.force("joint", k)
            said = near("force over the weight at step %d, %.3g rad" % (k + 1, angle), math.copysign(1, way) * force[0] / weight,
                        math.tan(alpha - angle), 2e-3 + 200 * scene.load)
            said = said or near("angle at step %d" % (k + 1), math.hypot(b, h) * math.sin(alpha - angle), b - abs(moved[0]), 0.02 * b)
            if said:
                return said
        return ""
    scene.check(tilts)


def hop(scene):
    """A stamp presses a base, is lifted, the base moves away and back, and the stamp presses again: the same force without friction."""
    r = scene.random
    width, height, depth = r.uniform(0.8, 2), r.uniform(0.4, 1), r.uniform(0.6, 1.2)
    law = scene.friction(0, r.choice([0.0, 0.6]))
    half = r.uniform(1, 2) * width
    scene.turn_freely()
    scene.kind()
    scene.box("base", (-half, half), (-0.5, 0), scene.cells(r.randint(8, 20), r.randint(2, 4)), depth=depth,
              layers=r.randint(2, 4) if scene.d == 3 else None, young=scene.stiffness())
    brick(scene, "stamp", (-width / 2, width / 2), (0, height), depth)
    down, up, away = r.uniform(0.3, 3) * scene.load * height, r.choice([0.01, r.uniform(0.1, 1)]), r.uniform(-1.5, 1.5) * half
    angle = r.choice([0.0, r.uniform(-1, 1)])
    if angle:  # the base turns below the stamp
        up = 3 * half + width
    heights, places, closed = [0.0, -down], [0.0, 0.0], [None, True]
    for k in range(r.choice([1, 1, 2])):
        heights += [up, up, -down] if r.random() < 0.7 else [up, -down]
        places += [0.0, away, 0.0] if len(heights) - len(places) == 3 else [away, 0.0]
        closed += [False, False, True] if len(closed) + 3 == len(heights) else [False, True]
    scene.times = [float(k + 1) for k in range(len(heights))]
    scene.motion("stamp_top", (0, height), (0.0, 1.0, 0.0), plain(scene), heights)
    scene.motion("base_bottom", (0, -0.5), (1.0, 0.0, 0.0), plain(scene, angle / (1.5 * half)), places)
    scene.touch("joint", "stamp_bottom", "base_top", law)

    def returns(run):
        forces = {round(t, 9): run.force("joint", k) for k, t in enumerate(run.times)}
        first = forces[2.0]
        for time, state in zip(scene.times, closed):
            force = forces[time]
            if state is False and max(map(abs, force)) > 1e-9 * abs(first[1]):
                return "force %s of open sides at t = %g" % (force, time)
            if state and (law.mu == 0) and max(abs(a - b) for a, b in zip(force, first)) > EXACT * abs(first[1]):
                return "force %s at t = %g, %s at first" % (force, time, first)
            if state and not 0.7 < force[1] / first[1] < 1.4:
                return "normal force %.6g at t = %g, %.6g at first" % (force[1], time, first[1])
        return ""
    scene.check(returns)
    obeys(scene, "joint", law.mu)
