"""Random scenes with friction on inclined or curved sides."""
import math

from friction_flat import moved
from friction_grids import arc, straight


def groove(scene):
    """A wedge in a groove with two inclined flanks, rigid or elastic."""
    r = scene.random
    alpha, height, tip = r.uniform(0.2, 1.1), r.uniform(0.5, 1), r.uniform(0.1, 0.5)
    wide = tip + height * math.tan(alpha)
    depth = r.uniform(0.7, 1.4)
    first = scene.law()
    second = first if r.random() < 0.6 else scene.law()
    patches = [(scene.cells(r.randint(3, 10), r.randint(5, 14)), straight((-tip, 0), (tip, 0), (wide, height), (-wide, height)),
                {"s0": "left", "s1": "right", "t0": "bottom"})]
    end = height + 0.1
    patches.append(((patches[0][0][0], 1), straight((-wide, height), (wide, height), (wide, end), (-wide, end)), {"t1": "top"}))
    scene.extruded("wedge", patches, depth)
    c, s = math.cos(alpha), math.sin(alpha)
    gap = r.choice([None, None, 10 ** r.uniform(-5, -2)])
    if r.random() < 0.6:
        scene.flat("wedge_left", (-tip, 0), (c, s), first, gap)
        scene.flat("wedge_right", (tip, 0), (-c, s), second, gap)
    else:
        out, n, m = wide + r.uniform(0.3, 0.8), r.randint(5, 14), r.randint(2, 5)
        left, right = ((-out, 0), (-tip, 0), (-wide, height), (-out, height)), ((tip, 0), (out, 0), (out, height), (wide, height))
        scene.extruded("cheek", [(scene.cells(m, n), straight(*left), {"s1": "l", "s0": "outl"}),
                                 (scene.cells(m, n), straight(*right), {"s0": "r", "s1": "outr"})], depth)
        scene.fix("cheek_outl")
        scene.fix("cheek_outr")
        scene.contact("cheek_l", "wedge_left", first, gap)
        scene.contact("cheek_r", "wedge_right", second, gap)
    if r.random() < 0.3:
        scene.move("wedge_top", scene.vector([r.uniform(-0.3, 0.3) * scene.load, -r.uniform(0.3, 2) * scene.load]))
        scene.must("some", "moved")
        return
    lean = r.uniform(-0.6, 0.6) * (math.pi / 2 - alpha)
    if scene.d == 3 and first.free and second.free:
        scene.roller("wedge_front")
    size = r.uniform(0.5, 2)
    if r.random() < 0.5:
        scene.weight("wedge", (size * math.sin(lean), -size * math.cos(lean)))
    else:
        scene.traction("wedge_top", (size * math.sin(lean), -size * math.cos(lean)))
        scene.why = "may turn"
    if not (first.tension or second.tension) and abs(lean) < 0.3 * (math.pi / 2 - alpha) and scene.why == "":
        scene.must("some", "inside the cone of the flanks")


def pin(scene):
    """A pin in the hole of a ring, with clearance: it lies or rolls, moved or loaded, held only by contact."""
    r = scene.random
    clearance = r.choice([0.0, 10 ** r.uniform(-5, -2), 10 ** r.uniform(-3, -1.3), -10 ** r.uniform(-5, -3)])
    around, radial = r.randint(16, 36), r.randint(2, 4)
    if scene.order == 2 or scene.d == 3:
        around = max(12, around * 2 // 3)
    layers = r.randint(2, 3)
    outer, inner = 1 + clearance + r.uniform(0.3, 1), r.uniform(0.2, 0.6)
    begin = r.uniform(0, 1)
    n = around if r.random() < 0.4 else around + r.randint(-4, 4)
    scene.extruded("ring", [((around, scene.cells(1, radial)[1]), arc((0, 0), 1 + clearance, outer, 0, 2 * math.pi),
                             {"t0": "outer", "t1": "hole"})], 0.5, layers)
    scene.extruded("pin", [((n, scene.cells(1, radial + 1)[1]), arc((0, 0), inner, 1, begin, begin + 2 * math.pi),
                            {"t0": "skin", "t1": "bore"})], 0.5, layers)
    scene.fix("ring_outer")
    law = scene.law(["Coulomb", "Coulomb", "Coulomb", "Coulomb cohesion", "Tresca", "Frictionless"])
    scene.contact("ring_hole", "pin_skin", law)
    if scene.d == 3:
        scene.roller("ring_front")
        scene.roller("pin_front")
    angle, kind = r.uniform(0, 2 * math.pi), r.random()
    if kind < 0.45 and not law.free:
        scene.weight("pin", (math.cos(angle), math.sin(angle)))
        scene.must("some", "it lies in the hole")
        return
    by = max(clearance, 0.0) * r.uniform(1.05, 1.5) + scene.load * r.uniform(0.1, 2)
    spin = r.choice([0.0, r.uniform(-2, 2)]) * scene.load
    gradient = [[0, -spin, 0], [spin, 0, 0], [0, 0, 0]]
    scene.move("pin_bore", scene.vector([by * math.cos(angle), by * math.sin(angle)]), [row[:scene.d] for row in gradient[:scene.d]],
               [0.0] * scene.d)
    scene.must("some", "moved")


def cylinder(scene):
    """Half a cylinder, in 3D also a spherical cap, on a block or a rigid flat: pressed, then sheared or rotated (Cattaneo)."""
    r = scene.random
    law, depth = scene.law(), 0.6
    cap = scene.d == 3 and r.random() < 0.5
    if cap:
        curvature = 3 * scene.load / r.uniform(0.1, 0.4) ** 2  # the radius of the contact
        n = scene.cells(r.randint(8, 12), r.randint(3, 6))
        scene.box("round", (-0.5, 0.5), (0, 0.5), n, bottom=lambda x, z: curvature * (x * x + z * z), layers=n[0])
        width = 1.2
    else:
        scene.load = 10 ** r.uniform(-3, -1.7)  # the contact covers part of the side
        n = r.randint(10, 24)
        n = max(8, n * 2 // 3) if scene.order == 2 else n
        rows = scene.cells(1, r.randint(3, 6))[1]
        scene.extruded("round", [((n, rows), arc((0, 1), r.uniform(0.2, 0.5), 1, -0.9 * math.pi, -0.1 * math.pi),
                                  {"t0": "bottom", "t1": "top", "s0": "l", "s1": "r"})], depth)
        width = 2.4
    if r.random() < 0.3:
        scene.flat("round_bottom", (0, 0), (0, 1), law)
    else:
        scene.box("block", (-width / 2, width / 2), (-0.8, 0), scene.cells(r.randint(8, 24), r.randint(3, 6)),
                  depth=width if cap else depth * r.choice([1.0, 1.2]))
        scene.fix("block_bottom")
        scene.contact("block_top", "round_bottom", law)
    size = scene.load * 3
    if r.random() < 0.7:
        gradient = None
        if scene.d == 3:
            spin = r.uniform(-2, 2) * size
            gradient = [[0, 0, spin], [0, 0, 0], [-spin, 0, 0]]
        scene.move("round_top", scene.vector([r.uniform(-1, 1) * size, -r.uniform(0.3, 2) * size], r.uniform(-1, 1) * size), gradient,
                   [0.0] * scene.d)
        scene.must("some", "moved")
    else:
        scene.sideways("round", "l" if not cap else "left") if law.free or r.random() < 0.5 else None
        scene.traction("round_top", (r.uniform(-0.1, 0.1), -r.uniform(0.3, 1)))


def dovetail(scene):
    """A root with two inclined flanks, pulled out of a slot."""
    r = scene.random
    neck, foot, height, wide = r.uniform(0.3, 0.6), r.uniform(0.7, 1.2), r.uniform(0.4, 0.9), r.uniform(1.5, 2.2)
    low, depth, n = 0.15, r.uniform(0.6, 1.2), r.randint(4, 14)
    first = scene.law()
    second = first if r.random() < 0.6 else scene.law()
    m = n if r.random() < 0.4 else r.randint(4, 14)
    inner = foot + (neck - foot) * low / height
    a, b = r.randint(4, 8), r.randint(2, 5)
    scene.extruded("slot", [
        (scene.cells(b, 2), straight((-wide, -0.5), (-foot, -0.5), (-foot, 0), (-wide, 0)), {"t0": "ground"}),
        (scene.cells(a, 2), straight((-foot, -0.5), (foot, -0.5), (foot, 0), (-foot, 0)), {"t0": "ground"}),
        (scene.cells(b, 2), straight((foot, -0.5), (wide, -0.5), (wide, 0), (foot, 0)), {"t0": "ground"}),
        (scene.cells(b, n), straight((-wide, 0), (-foot, 0), (-neck, height), (-wide, height)), {"s1": "l"}),
        (scene.cells(b, n), straight((foot, 0), (wide, 0), (wide, height), (neck, height)), {"s0": "r"})], depth)
    scene.extruded("root", [
        (scene.cells(a, m), straight((-inner, low), (inner, low), (neck, height), (-neck, height)), {"s0": "l", "s1": "r"}),
        (scene.cells(a, 3), straight((-neck, height), (neck, height), (neck, height + 0.5), (-neck, height + 0.5)), {"t1": "top"})], depth)
    scene.fix("slot_ground")
    scene.contact("slot_l", "root_l", first)
    scene.contact("slot_r", "root_r", second)
    if scene.d == 3 and (first.free or second.free or r.random() < 0.3):
        scene.roller("root_front")
    lean = r.uniform(-0.15, 0.15) if r.random() < 0.6 else 0.0
    if r.random() < 0.7:
        scene.traction("root_top", (lean, 1))
    else:
        scene.move("root_top", scene.vector([lean * scene.load, scene.load]))
    scene.must("some", "held by both flanks")


def ball(scene):
    """A body with a flat or round lower side on or in a rigid circle or ball."""
    r = scene.random
    law, radius, height = scene.law(), r.uniform(0.8, 4), r.uniform(0.4, 1)
    scene.load = 10 ** r.uniform(-3, -1.7) if r.random() < 0.8 else scene.load
    hollow = r.random() < 0.4
    curvature = (1 / radius) * r.uniform(1.0, 2.0) / 2 if hollow else 0.0 if r.random() < 0.6 else -0.4 / radius
    n = scene.cells(r.randint(6, 20), r.randint(3, 8))
    scene.box("body", (-0.5, 0.5), (0, height), n, bottom=lambda x, z: curvature * (x * x + z * z), layers=min(n[0], 8))
    scene.round("body_bottom", (0, radius if hollow else -radius), radius, law, hollow, None)
    kind = r.random()
    if kind < 0.5:
        moved(scene, "body_top", 1, height)
    elif kind < 0.75 or law.free:
        scene.sideways("body")
        scene.traction("body_top", (r.uniform(-0.3, 0.3), -1))
        scene.must("some", "rollers")
    else:
        scene.traction("body_top", (r.uniform(-0.2, 0.2) * min(law.mu, 1), -1))


def wave(scene):
    """Two blocks with a wavy joint, sheared."""
    r = scene.random
    width, height, depth = r.uniform(1, 3), r.uniform(0.5, 1), r.uniform(0.6, 1.2)
    number, amplitude, phase = r.randint(1, 2), r.uniform(0.005, 0.06), r.uniform(0, 6)
    shape = lambda x, z: amplitude * math.sin(2 * math.pi * number * x / width + phase)
    across, deep_cells, matching = r.randint(10, 24), scene.cells(1, r.randint(5, 8))[1], r.random() < 0.5
    apart = r.choice([0.0, 0.0, 10 ** r.uniform(-6, -3)])
    scene.box("lower", (0, width), (-height, 0), scene.cells(across, r.randint(3, 6)), top=shape, depth=depth, layers=deep_cells)
    scene.box("upper", (0, width), (apart, height), scene.cells(across if matching else r.randint(10, 24), r.randint(3, 6)), bottom=shape,
              depth=depth, layers=deep_cells)
    scene.fix("lower_bottom")
    scene.contact("lower_top", "upper_bottom", scene.law())
    if r.random() < 0.6:
        moved(scene, "upper_top", width, height)
    else:
        scene.sideways("upper", "right")
        scene.pressure("upper_top", r.uniform(0.3, 2))
        scene.must("some", "rollers")


def arch(scene):
    """Stones of an arch between rigid springers, held only by friction in the joints."""
    r = scene.random
    count = r.randint(2, 4)
    begin = r.uniform(0.1, 0.6)
    step = (math.pi - 2 * begin) / count
    inner, thick = r.uniform(1, 2), r.uniform(0.4, 0.9)
    matching, n = r.random() < 0.5, r.randint(3, 7)
    law = scene.law(["Coulomb", "Coulomb", "Coulomb", "Coulomb cohesion", "Tresca"])
    for k in range(count):
        a = begin + k * step
        cells = scene.cells(r.randint(3, 7), n if matching else r.randint(3, 7))
        scene.extruded("s%d" % k, [(cells, arc((0, 0), inner, inner + thick, a, a + step),
                                    {"s0": "first", "s1": "last", "t0": "back", "t1": "face"})], 0.6)
        scene.weight("s%d" % k, (0, -1))
        if k > 0:
            scene.contact("s%d_last" % (k - 1), "s%d_first" % k, law)
    if r.random() < 0.4:
        for k in range(count):
            scene.pressure("s%d_back" % k, r.uniform(0.5, 1))
    scene.flat("s0_first", (0, 0), (-math.sin(begin), math.cos(begin)), law)
    scene.flat("s%d_last" % (count - 1), (0, 0), (math.sin(begin), math.cos(begin)), law)
