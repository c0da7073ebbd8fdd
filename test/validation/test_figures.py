#!/usr/bin/python3
"""Figures of 3D scenes and load steps on files of known content: exact for exact fields, off by a planted error, invariant under rotation."""
import math
import os
import sys
import tempfile

import h5py
import numpy as np

import figures

TETRAHEDRON, TRIANGLE, LINE = 10, 5, 3
AXIS, ANGLE = (1, 2, 3), 30.0
wrong = []


def check(name, found, expected, tolerance=1e-12):
    if not (found == expected or abs(found - expected) <= tolerance):
        wrong.append(f"{name}: {found!r} instead of {expected!r}")


def write(path, kind, points, cells, point=None, cell=None):
    """A one-piece file in suture_solve's format."""
    with h5py.File(path, "w") as file:
        root = file.create_group("VTKHDF")
        for name, value in (("NumberOfPoints", len(points)), ("NumberOfCells", len(cells)), ("NumberOfConnectivityIds", np.size(cells))):
            root[name] = np.array([value])
        root["Points"], root["Connectivity"], root["Types"] = points, np.ravel(cells), np.full(len(cells), kind, np.uint8)
        root["Offsets"] = np.arange(len(cells) + 1) * np.shape(cells)[1]
        for group, data in (("PointData", point), ("CellData", cell)):
            for name, values in (data or {}).items():
                root[f"{group}/{name}"] = values


def blocks(random, per=40):
    """Points and cells of two clouds of tetrahedra without common points: the lower and the upper half of a column."""
    points = random.random((2 * per, 3)) * [1, 1, 0.5]
    points[:per, 2] -= 0.5
    cells = np.concatenate([np.arange(per).reshape(-1, 4), per + np.arange(per).reshape(-1, 4)])
    return points, cells, np.repeat([0, 1], per // 4)


def patch(folder, factor=1.0):
    """Uniform contraction of both blocks, E = 2e6 below and 4e6 above, rotated; stresses are wrong by `factor`."""
    r = figures.rotation(3, ANGLE, AXIS)
    points, cells, body = blocks(np.random.default_rng(1))
    young = np.where(points[:, 2] > 0, 4e6, 2e6)
    u = 1e5 / young[:, None] * np.stack([0.3 * points[:, 0], 0.3 * points[:, 1], -points[:, 2]], axis=1)
    u[:, 2] -= 1e5 * 0.5 / 2e6
    sigma = -1e5 * factor * np.outer(r[:, 2], r[:, 2])
    stress = np.tile([sigma[i] for i in ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))], (len(cells), 1))
    write(os.path.join(folder, "fields_0000.vtkhdf"), TETRAHEDRON, points @ r.T, cells, {"Displacement": u @ r.T * factor},
          {"Stress": stress, "Body": body})


def pushed(folder, factor=1.0):
    """Half planes with a = 1, p0 = 1 and mu = 1, that is P = pi / 2 and all modulus / radius = 2: pushed to P / 2 at t = 1, and at t = 2 back to
    -P / 2 and at t = 3 to P. Tractions are exact except for `factor`; the work is that of the full slip from 0 to P at t = 3."""
    normal = math.pi / 2
    x = np.linspace(-1.2, 1.2, 97)
    c = math.sqrt(0.5)
    half = np.sqrt(np.maximum(0, 1 - x ** 2)) - c * np.sqrt(np.maximum(0, 1 - (x / c) ** 2))
    points, cells = np.stack([x, 0 * x, 0 * x], axis=1), np.stack([np.arange(96), np.arange(1, 97)], axis=1)
    for place, traction in enumerate((half, half - 2 * half, np.sqrt(np.maximum(0, 1 - x ** 2)))):
        write(os.path.join(folder, f"contact_{place:04d}.vtkhdf"), LINE, points, cells,
              {"TangentialTraction": factor * np.stack([traction, 0 * x, 0 * x], axis=1)})
    with open(os.path.join(folder, "steps.csv"), "w") as file:
        file.write("step,time,active,sticking,slipping,external_work,stored_energy,dissipated_work,force touch x,force touch y,force touch z\n")
        for time, force, work in ((1, normal / 2, 0.0), (2, -normal / 2, 1.0), (3, normal, math.pi / 16 * factor)):
            file.write(f"{time},{time},3,2,1,{factor * 4.0!r},{factor * 3.0!r},{factor * work!r},{factor * force!r},{-normal!r},0\n")
    with open(os.path.join(folder, "frames.csv"), "w") as file:
        file.write("time,body,displacement_x\n" + "".join(f"{time},a,{factor * time * time!r}\n{time},b,0\n" for time in (1, 2, 3)))
    with open(os.path.join(folder, "summary.json"), "w") as file:
        file.write('{"parameters": {"Load Steps": {"Times": [1.0, 2.0, 3.0]}}}')


def pushedBalls(folder, factor=1.0):
    """The half of half spaces with a = 1, p0 = 1 and mu = 1, that is P = 2 pi / 3 and radius / modulus = 2 / pi; G = 1, nu = 0. Pushed to
    7/8 P at t = 1 (c = 1/2), at t = 2 back to -7/8 P and at t = 3 to P, by a grip of compliance 0.1. Exact except for
    `factor`; the work is that of the full slip, r^2 / 2 of the approach."""
    normal = 2 * math.pi / 3
    approach = 3 * normal * 2 / 8
    x, y = (a.ravel() for a in np.meshgrid(np.linspace(-1.2, 1.2, 97), np.linspace(0, 1.2, 49)))
    r = np.hypot(x, y)
    half = np.sqrt(np.maximum(0, 1 - r ** 2)) - 0.5 * np.sqrt(np.maximum(0, 1 - (2 * r) ** 2))
    points, triangles = np.stack([x, y, 0 * x], axis=1), np.arange(len(x) - 2)[:, None] + np.arange(3)
    corners = np.array([[0, 0, 1], [1, 0, 1], [0, 1, 1], [0, 0, 0]], dtype=float)
    with open(os.path.join(folder, "steps.csv"), "w") as file:
        file.write("time,dissipated_work,force touch x,force touch y,force touch z\n")
        whole = np.sqrt(np.maximum(0, 1 - r ** 2))
        for place, (share, traction, way) in enumerate(((7 / 8, half, 0.75), (-7 / 8, -half, 0), (1, whole, 1))):
            write(os.path.join(folder, f"contact_{place:04d}.vtkhdf"), TRIANGLE, points, triangles,
                  {"TangentialTraction": factor * np.stack([traction, 0.01 * (r < 1), 0 * x], axis=1)})
            grip = approach * way * factor + 0.1 * share * normal
            write(os.path.join(folder, f"fields_{place:04d}.vtkhdf"), TETRAHEDRON, corners, np.arange(4)[None],
                  {"Displacement": np.array([grip, 0, 0]) * corners[:, 2:]})
            file.write(f"{place + 1},{factor * approach * math.pi / 15!r},{share * normal / 2!r},0,{-normal / 2!r}\n")


def moved(folder, order, length=1.0, times=1.0, shift=(0, 0, 0), angle=0.0):
    """A random solution in a random order, rotated, scaled and moved; forces on a piece of the surface."""
    random = np.random.default_rng(2)
    points, cells, body = blocks(random)
    u, forces = random.standard_normal((len(points), 3)), random.random(len(points))
    r = figures.rotation(3, angle, AXIS)
    at = np.argsort(order.random(len(points)))
    where = np.argsort(at)
    placed = length * points @ r.T + shift
    write(os.path.join(folder, "fields_0000.vtkhdf"), TETRAHEDRON, placed[at], where[cells], {"Displacement": (times * u @ r.T)[at]},
          {"Body": body, "PrincipalStress": np.ones((len(cells), 3))})
    triangles = where[np.arange(len(points) - 2)[:, None] + np.arange(3)]
    write(os.path.join(folder, "contact_0000.vtkhdf"), TRIANGLE, placed[at], triangles,
          {"ContactForce": (times * forces)[at], "Active": (forces > 0.5).astype(np.uint8)[at]})


def hertz(folder, peak, radius):
    """Pressures of Hertz on a quarter disc."""
    x, y = (a.ravel() for a in np.meshgrid(*(np.linspace(0, 1.2 * radius, 21),) * 2))
    pressure = peak * np.sqrt(np.maximum(0, 1 - (x * x + y * y) / radius ** 2))
    triangles = np.arange(len(x) - 2)[:, None] + np.arange(3)
    write(os.path.join(folder, "contact_0000.vtkhdf"), TRIANGLE, np.stack([x, y, 0 * x], axis=1), triangles,
          {"ContactPressure": pressure, "ContactForce": np.ones(len(x))})


with tempfile.TemporaryDirectory() as exact, tempfile.TemporaryDirectory() as wrongly:
    pushed(exact)
    pushed(wrongly, 0.9)
    unit = {"mu": 1, "modulus": 2.0, "radius": 1.0}
    check("traction of a push", figures.figure("path.mindlinError", exact, turns=[1], **unit), 0.0)
    check("traction after a turn", figures.figure("path.mindlinError", exact, turns=[1, 2], **unit), 0.0)
    check("traction in the middle", figures.figure("path.mindlinTraction", exact, turns=[1, 2], at=0, **unit), math.sqrt(0.5) - 1)
    check("work of full slip", figures.figure("path.mindlinDissipation", exact, time=3, **unit), 1.0, 1e-6)
    check("a value", figures.figure("path.value", exact, column="force touch x", time=2, since=1), -math.pi / 2)
    check("a motion", figures.figure("path.motion", exact, body="a", column="displacement_x", time=3, since=1), 8)
    check("a ratio", figures.figure("path.ratio", exact, column="external_work", over="stored_energy", time=2), 4 / 3)
    for name in ("forceDifference", "stateDifference", "workDifference"):
        check(f"{name} of a path to itself", figures.figure(f"path.{name}", exact, exact), 0)
    check("a wrong traction is found", figures.figure("path.mindlinError", wrongly, turns=[1], **unit) > 0.01, True)
    check("other forces are found", figures.figure("path.forceDifference", wrongly, exact), 0.1 / math.sqrt(2))
    check("other works are found", figures.figure("path.workDifference", wrongly, exact), 0.1)
    try:
        figures.figure("path.value", exact, column="time", time=1.5)
        wrong.append("a time at which no step ends has a value")
    except ValueError:
        pass

with tempfile.TemporaryDirectory() as exact, tempfile.TemporaryDirectory() as wrongly:
    pushedBalls(exact)
    pushedBalls(wrongly, 0.9)
    unit = {"mu": 1, "modulus": 1.0, "radius": 2 / math.pi, "balls": True}
    check("traction of balls", figures.figure("path.mindlinError", exact, turns=[1], beside=0, **unit), 0.0, 1e-7)
    check("traction of balls after a turn", figures.figure("path.mindlinError", exact, turns=[1, 2], beside=0, **unit), 0.0, 1e-7)
    check("traction across", figures.figure("path.mindlinAcross", exact, turns=[1], **unit), 0.01)
    check("stick of balls", figures.figure("path.mindlinStick", exact, turn=1, **unit), 1.0)
    elastic = {"shear": 1, "poisson": 0}
    check("work of full slip of balls", figures.figure("path.mindlinDissipation", exact, time=3, **elastic, **unit), 1.0, 1e-6)
    check("approach of balls", figures.figure("path.mindlinApproach", exact, times=[1, 3], **elastic, **unit), 0.0)
    check("a wrong stick is found", figures.figure("path.mindlinStick", wrongly, turn=1, **unit), 1.1)
    check("a wrong approach is found", figures.figure("path.mindlinApproach", wrongly, times=[1, 3], **elastic, **unit) > 5e-3, True)

with tempfile.TemporaryDirectory() as one, tempfile.TemporaryDirectory() as two:
    turn = {"angle": ANGLE, "axis": AXIS}
    patch(one)
    check("exact stress", figures.figure("patch.stressError", one, **turn), 0)
    check("exact displacement", figures.figure("patch.contractionError", one, below=2e6, above=4e6, **turn), 0)
    patch(one, factor=1.01)
    largest = np.abs(np.outer(*[figures.rotation(3, **turn)[:, 2]] * 2)).max()
    check("stress wrong by a hundredth", figures.figure("patch.stressError", one, **turn), 0.01 * largest)
    if not figures.figure("patch.contractionError", one, below=2e6, above=4e6, **turn) > 1e-3:
        wrong.append("a displacement with an error of 1 % passes")

    moved(one, np.random.default_rng(3))
    moved(two, np.random.default_rng(4), length=1000.0, times=7.0, shift=(1700, -500, 900), angle=ANGLE)
    motion = {"length": 1000, "shift": (1700, -500, 900), **turn}
    for name in ("displacement", "force"):
        check(f"metamorphic {name}", figures.figure(f"metamorphic.{name}", two, one, times=7, **motion), 0, 1e-10)
        if not figures.figure(f"metamorphic.{name}", two, one, times=7.001, **motion) > 1e-5:
            wrong.append(f"metamorphic {name} does not detect 0.1 %")
    check("metamorphic status", figures.figure("metamorphic.status", two, one, **motion), 0)
    check("places that were not turned back", figures.figure("metamorphic.displacement", two, one, times=7, length=1000), math.inf)

    hertz(one, 3.0, 0.1)
    check("fitted pressure", figures.figure("sphere.fittedPressure", one, radius=0.1), 3.0, 1e-9)
    check("fitted radius", figures.figure("sphere.fittedRadius", one, radius=0.1), 0.1, 1e-9)
    check("pressure on the axis", figures.figure("sphere.centrePressure", one), 3.0)
    check("forces of a half", figures.figure("statics.force", one, along="x", above=0.05), 21 * 12)

    r = figures.rotation(3, 90, (0, 0, 2))
    check("a quarter turn about z", float(np.abs(r - [[0, -1, 0], [1, 0, 0], [0, 0, 1]]).max()), 0)

print("\n".join(wrong) or "figures in 3D and of paths as expected")
sys.exit(bool(wrong))
