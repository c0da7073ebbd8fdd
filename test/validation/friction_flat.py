"""Random scenes with friction on flat sides, with the outcome that statics predicts."""
import math


def push(scene, area, normal, laws, height, width):
    """A shear traction on a flat pile of bodies, above joints with the given laws, all under the same normal force. Sets the
    outcome known by statics and returns the traction. The push is too small to topple the pile."""
    r = scene.random
    capacity = min(law.capacity(normal, area) for law in laws)
    largest = 0.3 * normal * width / height  # the resultant stays in the central part of the base
    ratio = r.uniform(0.0, 0.95) if r.random() < 0.8 else r.uniform(1.05, 1.5)
    force = ratio * min(capacity, 3 * normal + area)
    if force > largest and not all(law.tension for law in laws):
        force, ratio = largest, largest / capacity if capacity > 0 else 0.0
    if capacity == math.inf:
        ratio = 0.0
    angle = r.uniform(0, 2 * math.pi) if scene.d == 3 else r.choice([0, math.pi])
    if ratio >= 1.0 / 0.98:
        scene.must("none", "pushed by %.3g of what friction holds" % ratio)
    elif ratio <= 0.98:
        scene.must("some", "pushed by %.3g of what friction holds" % ratio)
    return force / area * math.cos(angle), force / area * math.sin(angle)


def moved(scene, side, width, height):
    """Prescribes a rigid motion of the upper side: down, across, tilted, in 3D also rotated about the vertical."""
    r = scene.random
    down, across, tilt = r.uniform(0.3, 3), r.choice([0.0, r.uniform(-3, 3), r.uniform(-0.3, 0.3)]), r.choice([0.0, r.uniform(-1, 1)])
    size = scene.load * height
    if scene.d == 2:
        gradient = [[0, -tilt * size / width], [tilt * size / width, 0]]
        scene.move(side, [across * size, -down * size], gradient if tilt else None, (0, height))
    else:
        spin, along = r.choice([0.0, r.uniform(-3, 3)]) * size / width, r.choice([0.0, r.uniform(-2, 2)])
        gradient = [[0, -tilt * size / width, spin], [tilt * size / width, 0, 0], [-spin, 0, 0]]
        scene.move(side, [across * size, -down * size, along * size], gradient, (r.uniform(-0.2, 0.2) * width, height, 0))
    scene.must("some", "moved")


def floor(scene):
    """One block on a rigid flat: moved, or under loads with its weight."""
    r = scene.random
    width, height, depth = r.uniform(0.5, 3), r.uniform(0.3, 1.2), r.uniform(0.5, 1.5)
    scene.box("block", (-width / 2, width / 2), (0, height), scene.cells(r.randint(6, 24), r.randint(3, 10)), depth=depth)
    law = scene.law()
    scene.flat("block_bottom", (0, 0), (0, 1), law)
    if r.random() < 0.5:
        moved(scene, "block_top", width, height)
        return
    pressure, weight = r.uniform(0.2, 2), r.choice([0.0, r.uniform(0, 2)])
    scene.pressure("block_top", pressure)
    if law.free:
        scene.sideways("block")
        scene.must("some", "rollers")
        tx, tz = r.uniform(-0.3, 0.3) * pressure, 0.0
    else:
        area = width * (depth if scene.d == 3 else 1)
        tx, tz = push(scene, area, area * (pressure + weight * height), [law], height, width if scene.d == 2 else min(width, depth))
    body = weight > 0 and r.random() < 0.5
    if body:
        scene.weight("block", (tx / height, -weight) + ((tz / height,) if scene.d == 3 else ()))
    else:
        scene.weight("block", (0, -weight))
        scene.traction("block_top", (tx, 0) + ((tz,) if scene.d == 3 else ()))


def stack(scene):
    """Stack of two to four blocks, the lowest held."""
    r = scene.random
    count, width, depth, matching = r.randint(2, 4), r.uniform(0.6, 2.5), r.uniform(0.6, 1.4), r.random() < 0.4
    across, layers = r.randint(5, 16), scene.cells(1, r.randint(6, 10))[1]
    if scene.d == 3 and count == 4:
        count = 3
    crown = 0.0 if r.random() < 0.7 else r.uniform(0.0005, 0.02)
    pressure, weights, heights, laws = r.uniform(0.2, 2), [], [], []
    y, half = 0.0, width / 2
    for k in range(count):
        name, height = "b%d" % k, r.uniform(0.3, 1)
        bulge = (lambda x, z, c=crown, w=width: c * (x * x / w / w)) if k > 0 and crown else None
        cells = scene.cells(across if matching else r.randint(5, 16), r.randint(2, 6))
        scene.box(name, (-half, half), (y, y + height), cells, bottom=bulge, depth=depth, layers=layers if matching else None)
        weights.append(r.choice([0.0, r.uniform(0, 1)]))
        scene.weight(name, (0, -weights[-1]))
        heights.append(height)
        if k > 0:
            laws.append(scene.law())
            scene.contact("b%d_top" % (k - 1), name + "_bottom", laws[-1])
        y += height
    scene.fix("b0_bottom")
    last = "b%d" % (count - 1)
    if r.random() < 0.3:
        moved(scene, last + "_top", width, y)
        for k in range(1, count - 1):
            if laws[k - 1].free or laws[k].free:
                scene.sideways("b%d" % k)
        return
    scene.pressure(last + "_top", pressure)
    held = [k for k in range(1, count) if laws[k - 1].free]
    for k in held:
        scene.sideways("b%d" % k)
    above = held[-1] if held else 0  # joints above the last rollers carry the push
    area = width * (depth if scene.d == 3 else 1)
    normal = area * pressure  # of the highest joint, the least
    joints = laws[above:]
    base = min(width, depth) if scene.d == 3 else width
    if joints:
        tx, tz = push(scene, area, normal, joints, sum(heights[above + 1:]), base)
        if scene.expected == "none" and (any(weights) or crown):
            scene.must("open", "weights help")
        if crown and scene.expected == "some":
            scene.must("open", "crowned")
    else:
        tx, tz = r.uniform(-0.2, 0.2), 0.0
        scene.must("some", "rollers")
    scene.traction(last + "_top", (tx, 0) + ((tz,) if scene.d == 3 else ()))


def incline(scene):
    """A block on a slope, elastic or rigid: it sticks up to the friction angle."""
    r = scene.random
    width, height = r.uniform(0.6, 2), r.uniform(0.3, 0.8)
    law = scene.law(["Coulomb", "Coulomb", "Coulomb", "Coulomb cohesion", "Tresca"])
    slope = r.uniform(0.05, 1.0)
    depth = r.uniform(0.7, 1.4)
    scene.box("block", (-width / 2, width / 2), (0, height), scene.cells(r.randint(5, 18), r.randint(3, 8)), depth=depth)
    if r.random() < 0.5:
        scene.flat("block_bottom", (0, 0), (0, 1), law)
    else:
        scene.box("ground", (-width * r.choice([0.5, 0.8]), width * 0.7), (-0.6, 0), scene.cells(r.randint(6, 20), r.randint(2, 5)),
                  depth=depth * r.choice([1.0, 1.3]))
        scene.fix("ground_bottom")
        scene.contact("ground_top", "block_bottom", law)
    area = width * (depth if scene.d == 3 else 1)
    weight = r.uniform(0.5, 2)
    angle = 0.0 if scene.d == 2 else r.uniform(0, 2 * math.pi)
    if math.tan(slope) * height / 2 > 0.3 * min(width, depth if scene.d == 3 else width):
        slope = math.atan(0.6 * min(width, depth if scene.d == 3 else width) / height)
    normal, tangential = weight * height * area * math.cos(slope), weight * height * area * math.sin(slope)
    ratio = tangential / max(law.capacity(normal, area), 1e-30)
    along = (weight * math.sin(slope) * math.cos(angle), -weight * math.cos(slope))
    scene.weight("block", along + ((weight * math.sin(slope) * math.sin(angle),) if scene.d == 3 else ()))
    if ratio < 0.98 or ratio > 1.02:
        scene.must("some" if ratio < 1 else "none", "slope %.3g of what friction holds" % ratio)


def clamp(scene):
    """A body between two jaws, one of which presses: only friction carries its weight."""
    r = scene.random
    height, thick, depth = r.uniform(0.6, 1.2), r.uniform(0.4, 1), r.uniform(0.6, 1.2)
    n = r.randint(4, 12)
    m = n if r.random() < 0.4 else r.randint(4, 12)
    laws = [scene.law(["Coulomb", "Coulomb", "Coulomb", "Coulomb cohesion", "Tresca", "Tied"]) for _ in range(2)]
    pressure, layers = r.uniform(0.5, 2), scene.cells(1, r.randint(6, 9))[1]
    scene.box("middle", (0, thick), (0, height), scene.cells(r.randint(3, 8), n), depth=depth, layers=layers)
    scene.box("right", (thick, thick + 0.5), (0, height), scene.cells(r.randint(2, 5), m), depth=depth, layers=layers)
    if r.random() < 0.4:
        scene.flat("middle_left", (0, 0), (1, 0), laws[0])
    else:
        scene.box("left", (-0.5, 0), (0, height), scene.cells(r.randint(2, 5), m), depth=depth, layers=layers)
        scene.fix("left_left")
        scene.contact("left_right", "middle_left", laws[0])
    scene.contact("right_left", "middle_right", laws[1])
    for side in ["right_top", "right_bottom"] + (["right_front"] if scene.d == 3 else []):
        scene.roller(side)
    scene.pressure("right_right", pressure)
    area = height * (depth if scene.d == 3 else 1)
    capacities = [law.capacity(pressure * area, area) for law in laws]
    ratio = r.uniform(0, 0.9) if r.random() < 0.8 else r.uniform(1.1, 1.5)
    total = ratio * min(sum(capacities), 2 * min(capacities), 3 * pressure * area)
    total = min(total, 0.5 * pressure * area * height / thick)
    scene.weight("middle", (0, -total / (area * thick)))
    if total > 1.05 * sum(capacities):
        scene.must("none", "heavier than friction holds")
    elif total < 0.95 * 2 * min(capacities):
        scene.must("some", "friction holds its weight")


def layers(scene):
    """Stacked beams, clamped at one end and bent at the other: they slide on each other."""
    r = scene.random
    count, length, depth = r.randint(2, 4), r.uniform(2, 6), r.uniform(0.4, 1)
    across, matching, deep_cells = r.randint(10, 24), r.random() < 0.5, scene.cells(1, r.randint(4, 6))[1]
    y = 0.0
    for k in range(count):
        height = r.uniform(0.2, 0.6)
        cells = scene.cells(across if matching else r.randint(8, 24), r.randint(2, 4))
        scene.box("l%d" % k, (0, length), (y, y + height), cells, depth=depth, layers=deep_cells)
        scene.fix("l%d_left" % k)
        if k > 0:
            scene.contact("l%d_top" % (k - 1), "l%d_bottom" % k, scene.law())
        scene.weight("l%d" % k, (0, -r.choice([0.0, r.uniform(0, 0.1)])))
        y += height
    last = "l%d" % (count - 1)
    kind = r.random()
    if kind < 0.4:
        scene.move(last + "_right", scene.vector([0.0, -scene.load * r.uniform(0.5, 3)]))
    elif kind < 0.8:
        scene.pressure(last + "_top", r.uniform(0.02, 0.3))
    else:
        scene.traction(last + "_right", (0, r.uniform(-0.3, 0.3)))
    scene.must("some", "each beam is clamped")
