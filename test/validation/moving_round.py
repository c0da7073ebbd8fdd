"""Random scenes of round bodies that roll, turn and slide, with the forces and motions of statics and kinematics."""
import math

from friction_grids import arc
from moving_flat import carries, near, obeys, plain


def ring(scene, name, centre, inside, outside, around, radial, depth=1.0, begin=0.0):
    """A ring with the sides `rim` (outside) and `hub`."""
    scene.extruded(name, [((scene.cells(around, radial)[0], scene.cells(around, radial)[1]),
                           arc(centre, inside, outside, begin, begin + 2 * math.pi), {"t0": "rim", "t1": "hub"})], depth,
                   scene.random.randint(2, 3), scene.stiffness())


def around(scene):
    """Chooses the number of cells around a round body (in 3D halved by cells()), and the load for which the half width of its contact with a
    plane is about that of a cell or two (Hertz): with a single pair in contact a roller is a polygon."""
    r = scene.random
    n = r.randint(60, 110) if scene.d == 2 else r.randint(70, 100)
    cells = scene.cells(n, 1)[0] * scene.order
    half = min(2 * math.pi / cells * r.uniform(0.8, 2.0), 0.15)
    scene.load = math.pi / 8 * half * half
    return n


def half_width(load):
    """Of a contact of a cylinder of radius 1 with a plane (Hertz), for the softest modulus."""
    return math.sqrt(8 * load / math.pi)


def roll(scene):
    """A roller on a plate, turned at its hub under a weight, and drawn by a force that friction can hold: rolls by radius times angle."""
    r = scene.random
    radius, depth = 1.0, r.uniform(0.3, 0.6)
    angle = r.uniform(0.1, 1.0) * r.choice([-1, 1])
    scene.turn_axes()
    scene.kind()
    ring(scene, "roller", (0, radius), r.uniform(0.2, 0.5), radius, around(scene), r.randint(3, 6), depth, r.uniform(0, 1))
    half = abs(angle) + 0.8
    scene.kind()
    scene.box("plate", (-half, half), (-0.6, 0), scene.cells(r.randint(20, 90), r.randint(3, 6)), depth=depth,
              layers=r.randint(2, 3) if scene.d == 3 else None, young=scene.stiffness())
    scene.hold("plate_bottom")
    mu = r.uniform(0.05, 0.6)
    weight = scene.load * (depth if scene.d == 3 else 1)
    drawn = r.choice([0.0, r.uniform(-0.8, 0.8)]) * mu * weight
    path = scene.steps([angle] if r.random() < 0.7 else [angle, r.uniform(-0.5, 0.5) * angle], 12)
    scene.motion("roller_hub", (0, radius), (None, None, 0.0), plain(scene, 1.0), path)
    scene.push("roller_hub", (drawn, -weight))
    scene.touch("joint", "roller_rim", "plate_top", scene.friction(mu, mu))
    carries(scene, "joint", weight)
    obeys(scene, "joint", mu)
    creep = 2 * mu * half_width(scene.load) if drawn else 0.0

    def rolls(run):
        for k in run.steps:
            said = near("friction at step %d over the weight" % (k + 1), run.force("joint", k)[0] / weight, drawn / weight, 1e-5)
            if said:
                return said
        (here, turned), (start, before) = run.group("roller_hub"), run.group("roller_hub", 0)
        angle = turned - before if scene.d == 2 else turned[2] - before[2]
        size = max(map(abs, path))
        return near("path of the roller", here[0] - start[0], -angle * radius, (0.02 + creep) * size + 5 * scene.load)
    scene.check(rolls)


def between(scene):
    """A free roller between two plates; the upper one carries a weight and moves: the roller moves by half of its way, and turns."""
    r = scene.random
    radius, depth = 1.0, r.uniform(0.3, 0.6)
    way = r.uniform(0.1, 1) * r.choice([-1, 1])
    scene.turn_axes()
    scene.kind()
    ring(scene, "roller", (0, radius), r.uniform(0.2, 0.5), radius, around(scene), r.randint(3, 6), depth, r.uniform(0, 1))
    half = abs(way) + 0.8
    for name, y, held in (("plate", (-0.6, 0), "bottom"), ("upper", (2 * radius, 2 * radius + 0.6), "top")):
        scene.kind()
        scene.box(name, (-half, half), y, scene.cells(r.randint(20, 80), r.randint(3, 5)), depth=depth,
                  layers=r.randint(2, 3) if scene.d == 3 else None, young=scene.stiffness())
    scene.hold("plate_bottom")
    mu = r.uniform(0.1, 0.6)
    weight = scene.load * (depth if scene.d == 3 else 1)
    path = scene.steps([way] if r.random() < 0.6 else [way, r.uniform(-0.5, 0.5) * way], 10)
    scene.motion("upper_top", (0, 2 * radius + 0.6), (1.0, None, 0.0), plain(scene), path)
    scene.push("upper_top", (0, -weight))
    scene.touch("below", "roller_rim", "plate_top", scene.friction(mu, mu))
    scene.touch("above", "upper_bottom", "roller_rim", scene.friction(mu, mu))
    for contact in ("below", "above"):
        carries(scene, contact, weight)
        obeys(scene, contact, mu)

    def rolls(run):
        (moved, turn), (first, before) = run.body("roller"), run.body("roller", 0)
        way = run.group("upper_top")[0][0] - run.group("upper_top", 0)[0][0]
        angle = turn - before if scene.d == 2 else turn[2] - before[2]
        tolerance = 0.02 * max(map(abs, path)) + 5 * scene.load
        return (near("path of the roller", moved[0] - first[0], 0.5 * way, tolerance)
                or near("angle of the roller", angle, -0.5 * way / radius, tolerance))
    scene.check(rolls)


def pin(scene):
    """A lug hangs on a pin and is turned: the contact stays at the angle of friction, torque W r sin(atan mu) or more with its arc."""
    r = scene.random
    radius, depth = 1.0, r.uniform(0.2, 0.5)
    clearance = 10 ** r.uniform(-2.3, -0.5)
    mu = r.choice([0.0, r.uniform(0.05, 0.6)])
    scene.turn_freely()
    scene.kind()
    n, begin = around(scene), r.uniform(0, 1)
    ring(scene, "pin", (0, 0), r.uniform(0.2, 0.5), radius, n, r.randint(3, 6), depth, begin)
    scene.kind()
    ring(scene, "lug", (0, 0), radius + clearance, radius + clearance + r.uniform(0.5, 1), n + r.choice([0, r.randint(-6, 9)]), r.randint(3, 5), depth)
    scene.hold("pin_hub")
    weight = scene.load * (depth if scene.d == 3 else 1)
    angle = r.uniform(0.5, 3) * r.choice([-1, 1])
    path = scene.steps([angle] if r.random() < 0.6 else [angle, r.uniform(-0.8, 0.8) * angle], 14)
    scene.turn = scene.turn if scene.d == 2 else [[float(i == k) for k in range(3)] for i in range(3)]
    scene.motion("lug_rim", (0, 0), (None, None, 0.0) if scene.d == 3 else None, plain(scene, 1.0), path)
    scene.push("lug_rim", (0, -weight))
    scene.touch("joint", "lug_hub", "pin_rim", scene.friction(mu, mu) if mu else scene.friction(0, 0))
    carries(scene, "joint", weight)
    slid = len(path) > 1 and path[-1] - path[-2] or path[-1]

    def turns(run):
        for k in run.steps:
            said = near("horizontal force at step %d over the weight" % (k + 1), run.force("joint", k)[0] / weight, 0.0, 1e-5)
            if said:
                return said
        moment = run.reaction("lug_rim")[1]
        torque = (moment if scene.d == 2 else moment[2]) / weight / radius
        if abs(slid) * clearance < 50 * scene.load or abs(slid) < 1.5 * math.atan(mu):
            return ""
        size = mu / math.sqrt(1 + mu * mu)
        side = torque * math.copysign(1, slid)
        # The hub of the group is not at the pin's centre: the lug is displaced by up to the clearance.
        apart = clearance + 20 * scene.load
        if not size * 0.97 - apart <= side <= 1.35 * size + apart:
            return "torque over W r is %.6g, statics %.6g" % (side, size)
        return ""
    scene.check(turns)


def cam(scene):
    """An eccentric disc turns and lifts a follower with a flat face: lift e (1 - cos angle)."""
    r = scene.random
    radius, e, depth = 1.0, r.uniform(0.1, 0.5), r.uniform(0.3, 0.5)
    mu = r.choice([0.0, r.uniform(0, 0.5)])
    scene.turn_axes()
    scene.kind()
    ring(scene, "disc", (0, -e), r.uniform(0.2, 0.45), radius, around(scene), r.randint(3, 6), depth, r.uniform(0, 1))
    half, y = e + 0.7, radius - e
    scene.kind()
    scene.box("follower", (-half, half), (y, y + 0.8), scene.cells(r.randint(12, 60), r.randint(3, 6)), depth=depth,
              layers=r.randint(2, 3) if scene.d == 3 else None, young=scene.stiffness())
    weight = scene.load * (depth if scene.d == 3 else 1)
    angle = r.uniform(0.3, 3) * r.choice([-1, 1])
    path = scene.steps([angle] if r.random() < 0.7 else [angle, r.uniform(-0.6, 0.6) * angle], 12)
    scene.motion("disc_hub", (0, 0), (0.0, 0.0, 0.0), plain(scene, 1.0), path)
    scene.motion("follower_top", (0, y + 0.8), (0.0, None, 0.0), plain(scene))
    scene.push("follower_top", (0, -weight))
    scene.touch("joint", "follower_bottom", "disc_rim", scene.friction(mu, mu) if mu else scene.friction(0, 0))
    carries(scene, "joint", weight)
    obeys(scene, "joint", mu + 0.02)

    def lifts(run):
        start = run.group("follower_top", 0)[0][1]
        first = run.group("disc_hub", 0)[1]
        lift = lambda turn: e * (1 - math.cos(turn if scene.d == 2 else turn[2]))
        for k in run.steps:
            turn = run.group("disc_hub", k)[1]
            said = near("lift at step %d" % (k + 1), run.group("follower_top", k)[0][1] - start, lift(turn) - lift(first), 4e-3 + 6 * scene.load)
            if said:
                return said
        return ""
    scene.check(lifts)


def hollow(scene):
    """A roller that cannot turn in a hollow, without friction, pushed aside: it climbs to the angle whose tangent is H / W."""
    r = scene.random
    radius, depth = 1.0, r.uniform(0.2, 0.4)
    large = radius + r.uniform(0.3, 1.0)
    scene.turn_axes()
    scene.kind()
    ring(scene, "roller", (0, 0), r.uniform(0.2, 0.5), radius, around(scene), r.randint(3, 6), depth, r.uniform(0, 1))
    scene.kind()
    centre = (0, large - radius)
    scene.extruded("track", [(scene.cells(r.randint(24, 70), r.randint(3, 5)), arc(centre, large, large + 0.6, -math.pi, 0),
                              {"t0": "back", "t1": "face"})], depth, r.randint(2, 3), scene.stiffness())
    scene.hold("track_back")
    weight = scene.load * (depth if scene.d == 3 else 1)
    ratio = r.uniform(0.2, 1.5) * r.choice([-1, 1])
    path = scene.steps([1.0] if r.random() < 0.7 else [1.0, r.uniform(-0.5, 0.5)], 8)
    scene.motion("roller_hub", (0, 0), (None, None, 0.0), plain(scene))
    scene.push("roller_hub", (0, -weight))
    scene.push("roller_hub", (ratio * weight, 0), path, "aside")
    scene.touch("joint", "roller_rim", "track_face", scene.friction(0, 0))
    carries(scene, "joint", weight)

    def climbs(run):
        factors = dict(zip(scene.times, path))
        for k, time in enumerate(run.times):
            if time not in factors:
                continue
            moved = run.group("roller_hub", k)[0]
            found = math.atan2(moved[0], large - radius - moved[1])
            said = near("angle of the roller at step %d" % (k + 1), found, math.atan(ratio * factors[time]),
                        0.03 + 20 * scene.load / (large - radius))
            if said:
                return said
        return ""
    scene.check(climbs)


def cap(scene):
    """A body with a round lower side is drawn over a base or along a groove under a weight."""
    r = scene.random
    scene.load = 10 ** r.uniform(-4, -2.5)
    depth = r.uniform(0.8, 1.2)
    curvature = r.uniform(0.15, 0.6)
    hollow_ = r.choice([0.0, r.uniform(0, 0.8) * curvature])
    scene.turn_axes()
    half = r.uniform(1, 2)
    law = scene.friction(0, r.choice([0.0, 0.6, 0.6]))
    scene.kind()
    n = scene.cells(r.randint(10, 24), r.randint(3, 6))
    scene.box("base", (-half, half), (-0.5, 0), scene.cells(r.randint(16, 40), r.randint(3, 5)), top=lambda x, z: hollow_ * z * z, depth=1.3 * depth,
              layers=r.randint(4, 8) if scene.d == 3 else None, young=scene.stiffness())
    scene.hold("base_bottom")
    scene.kind()
    scene.box("slider", (-0.5, 0.5), (0, 0.5), scene.cells(r.randint(8, 20), r.randint(3, 5)), bottom=lambda x, z: curvature * (x * x + z * z),
              depth=depth, layers=r.randint(4, 8) if scene.d == 3 else None, young=scene.stiffness())
    weight = scene.load * (depth if scene.d == 3 else 1)
    by, n = r.uniform(0.2, 0.9) * half, None
    path = scene.steps([1.0] if r.random() < 0.5 else [1.0, r.uniform(-1, 0.5)])
    scene.motion("slider_top", (0, 0.5), (by, None, 0.0), plain(scene), path)
    scene.push("slider_top", (0, -weight))
    scene.touch("joint", "slider_bottom", "base_top", law)
    carries(scene, "joint", weight)
    obeys(scene, "joint", law.mu + 0.02)

