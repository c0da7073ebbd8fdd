"""Figures that compare two runs: "against" in a case. `folder` and `reference` are their output folders; see figures.py."""
import itertools
import json
import math
import os

import numpy as np

from runfiles import contact, fields, hooke, linearTriangles, rotation, summary


# --- comparison of two runs: "against" in a case ---

def byNode(folder):
    """{node of the mesh: u}; nodes shared by ranks occur on each, with the same u to solver tolerance."""
    f = fields(folder)
    return dict(zip(f.point["NodeId"].tolist(), f.point["Displacement"]))


def difference_displacement(folder, reference):
    """Largest |u - u_reference| over the largest |u_reference|."""
    u, r = byNode(folder), byNode(reference)
    if u.keys() != r.keys():
        return math.inf
    return float(max(np.linalg.norm(u[k] - r[k]) for k in r) / max(np.linalg.norm(v) for v in r.values()))


def difference_energy(folder, reference):
    """Energy norm of u - u_reference over the reference's estimated discretisation error: 0.2 increases the total error by 2 %."""
    f, r = fields(folder), byNode(reference)
    difference = f.point["Displacement"] - np.array([r[node] for node in f.point["NodeId"].tolist()])
    area, strain = linearTriangles(f, difference)
    energy = np.einsum("c,ci,cij,cj->", area, strain, hooke(folder, f), strain)
    return float(math.sqrt(energy) / summary(reference)["error"]["estimated_energy_norm"])


def difference_effectivity(folder, reference):
    """Estimated error over the difference between the stresses and the nodal mean stresses of a reference on a finer mesh, per body."""
    from matplotlib.tri import Triangulation
    f, r = fields(folder), fields(reference)
    area, strain = linearTriangles(f, f.point["Displacement"])
    weight, fineStrain = linearTriangles(r, r.point["Displacement"])
    law, fineStress = hooke(folder, f), np.einsum("cij,cj->ci", hooke(reference, r), fineStrain)
    computed, compliance = np.einsum("cij,cj->ci", law, strain), np.linalg.inv(law)
    square = 0.0
    for body in np.unique(f.cell["Body"]):
        cells, ofBody = np.array(r.cells)[r.cell["Body"] == body], r.cell["Body"] == body
        sums, weights = np.zeros((len(r.points), 3)), np.zeros(len(r.points))
        for k in range(3):
            np.add.at(sums, cells[:, k], weight[ofBody, None] * fineStress[ofBody])
            np.add.at(weights, cells[:, k], weight[ofBody])
        nodal = sums / np.maximum(weights, 1e-300)[:, None]
        find = Triangulation(r.points[:, 0], r.points[:, 1], cells).get_trifinder()
        mine = f.cell["Body"] == body
        x = f.points[np.array(f.cells)[mine]]
        for weightsOf in ((2 / 3, 1 / 6, 1 / 6), (1 / 6, 2 / 3, 1 / 6), (1 / 6, 1 / 6, 2 / 3)):
            p = np.einsum("k,cki->ci", np.array(weightsOf), x)
            at = find(p[:, 0], p[:, 1])
            assert (at >= 0).all(), "points outside of the finer mesh"
            corner = r.points[cells[at]]
            a = np.stack([corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]], axis=2)
            local = np.linalg.solve(a, p - corner[:, 0])
            shape = np.stack([1 - local.sum(axis=1), local[:, 0], local[:, 1]], axis=1)
            e = np.einsum("ck,cki->ci", shape, nodal[cells[at]]) - computed[mine]
            square += np.einsum("c,ci,cij,cj->", area[mine] / 3, e, compliance[mine], e)
    return summary(folder)["error"]["estimated_energy_norm"] / math.sqrt(square)


def difference_pcg(folder, reference):
    """Total PCG iterations over those of the reference."""
    a, b = summary(folder), summary(reference)
    return (a["outer"]["pcg_total"] + a["auxiliary"]["iterations"]) / (b["outer"]["pcg_total"] + b["auxiliary"]["iterations"])


def byPair(folder, name):
    c = contact(folder)
    return dict(zip(c.point["Pair"].tolist(), c.point[name]))


def difference_force(folder, reference):
    """Largest difference of the pair forces over the largest force."""
    a, b = byPair(folder, "ContactForce"), byPair(reference, "ContactForce")
    if a.keys() != b.keys():
        return math.inf
    return float(max(abs(a[k] - b[k]) for k in b) / max(abs(v) for v in b.values()))


def difference_status(folder, reference):
    """Number of pairs with another status."""
    a, b = byPair(folder, "Active"), byPair(reference, "Active")
    return len(a.keys() ^ b.keys()) + sum(int(a[k] != b[k]) for k in a.keys() & b.keys())


# --- V24: partly overlapping sides, with the pressure on either side ---

def overlap_difference(folder, reference, within):
    """Largest deviation of the pressures at |x| < within from the reference, whose pressure is on the other side, at the same places, over
    the reference pressures."""
    a, b = contact(folder), contact(reference)
    order = np.argsort(b.points[:, 0])
    use = np.abs(a.points[:, 0]) < within
    there = np.interp(a.points[use, 0], b.points[order, 0], b.point["ContactPressure"][order])
    return float(np.abs(a.point["ContactPressure"][use] / there - 1).max())


def onPin(folder, line):
    """Places (angle about z, z) of the pairs of a contact, and their pressures."""
    c = contact(folder)
    use = c.point["Line"] == line
    x, y, z = c.points[use].T
    return np.stack([np.arctan2(y, x), z], axis=1), c.point["ContactPressure"][use]


def overlap_differenceOnPin(folder, reference, line, least, begin, end):
    """The same on a pin about z, begin < z < end, where the reference pressure exceeds `least`: root mean square of the deviation over that
    of the pressures."""
    from scipy.interpolate import LinearNDInterpolator
    places, pressures = onPin(folder, line)
    others = LinearNDInterpolator(*onPin(reference, line))(places)
    use = (places[:, 1] > begin) & (places[:, 1] < end) & (others > least)  # excludes NaN, beyond the reference's pairs
    return float(np.linalg.norm(pressures[use] - others[use]) / np.linalg.norm(others[use]))


def overlap_beyond(folder, _, line, end):
    """Largest z of a pair with pressure, less `end`."""
    places, pressures = onPin(folder, line)
    return float(places[pressures > 0, 1].max() - end)


# --- V10: effect of transforming the scene. A point x of the reference is now at length R(angle, axis) x + shift. ---

def located(points, length=1, shift=0, **turn):
    """Points as keys: mapped back to the reference's coordinates and rounded to 1e-6 of the scene."""
    back = (points - np.asarray(shift)) / length @ rotation(points.shape[1], **turn)
    step = 1e-6 * np.ptp(back, axis=0).max()
    return [tuple(k) for k in np.round(back / step).astype(int).tolist()]


def matched(found, expected, dimension):
    """Pairs of values of both runs at equal keys, or none if the keys differ; a key represents all values within one step."""
    if len(found) != len(expected):
        return None
    pairs = []
    steps = list(itertools.product((0, -1, 1), repeat=dimension))
    for key, value in expected.items():
        near = ((*(k + i for k, i in zip(key, step)), *key[dimension:]) for step in steps)
        other = next((found[k] for k in near if k in found), None)
        if other is None:
            return None
        pairs.append((other, value))
    return pairs


def worst(pairs):
    if not pairs:
        return math.inf
    a, b = (np.array(x, dtype=float).reshape(len(pairs), -1) for x in zip(*pairs))
    return float(np.linalg.norm(a - b, axis=1).max() / np.linalg.norm(b, axis=1).max())


def byPlaceAndBody(f, values, **motion):
    bodies = [set() for _ in f.points]
    for cell, body in zip(f.cells, f.cell["Body"].tolist()):
        for node in cell:
            bodies[node].add(body)
    return {(*place, *bodies[i]): values[i] for i, place in enumerate(located(f.points, **motion))}


def metamorphic_displacement(folder, reference, times=1, length=1, shift=0, **turn):
    """Largest |u - times R u_reference| over the largest |times u_reference|."""
    a, b = fields(folder), fields(reference)
    d = a.dimension
    found = byPlaceAndBody(a, a.point["Displacement"][:, :d], length=length, shift=shift, **turn)
    return worst(matched(found, byPlaceAndBody(b, times * b.point["Displacement"][:, :d] @ rotation(d, **turn).T), d))


def metamorphic_principalStress(folder, reference, times=1, **motion):
    """The same for the principal stresses, at the elements' centres."""
    a, b = fields(folder), fields(reference)
    found = dict(zip(located(a.centroids(), **motion), a.cell["PrincipalStress"]))
    return worst(matched(found, dict(zip(located(b.centroids()), times * b.cell["PrincipalStress"])), a.dimension))


def metamorphic_force(folder, reference, times=1, **motion):
    """The same for the pair forces."""
    a, b = contact(folder), contact(reference)
    found = dict(zip(located(a.points, **motion), a.point["ContactForce"]))
    return worst(matched(found, dict(zip(located(b.points), times * b.point["ContactForce"])), a.dimension))


def metamorphic_status(folder, reference, **motion):
    """Number of pairs with another status."""
    a, b = contact(folder), contact(reference)
    pairs = matched(dict(zip(located(a.points, **motion), a.point["Active"])), dict(zip(located(b.points), b.point["Active"])), a.dimension)
    return sum(int(x != y) for x, y in pairs) if pairs else max(len(a.points), len(b.points))


def metamorphic_tangential(folder, reference, times=1, length=1, shift=0, **turn):
    """Largest |t - times R t_reference| of the tangential tractions, over the largest |times t_reference|."""
    a, b = contact(folder), contact(reference)
    d = a.dimension
    found = dict(zip(located(a.points, length=length, shift=shift, **turn), a.point["TangentialTraction"][:, :d]))
    expected = times * b.point["TangentialTraction"][:, :d] @ rotation(d, **turn).T
    return worst(matched(found, dict(zip(located(b.points), expected)), d))


def metamorphic_sticking(folder, reference, **motion):
    """Number of pairs that stick in one of the runs and not in the other."""
    a, b = contact(folder), contact(reference)
    pairs = matched(dict(zip(located(a.points, **motion), a.point["Stick"])), dict(zip(located(b.points), b.point["Stick"])), a.dimension)
    return sum(int(x != y) for x, y in pairs) if pairs else max(len(a.points), len(b.points))


def iterations_overReference(folder, reference):
    """Total PCG iterations, including the auxiliary problem."""
    both = []
    for one in (folder, reference):
        with open(os.path.join(one, "summary.json")) as file:
            summary = json.load(file)
        both.append(summary["auxiliary"]["iterations"] + summary["outer"]["pcg_total"])
    return both[0] / both[1]


# --- memory of a run on several ranks against that of one rank ---

def peaks(folder):
    with open(os.path.join(folder, "summary.json")) as file:
        return json.load(file)["peak_memory_mb"]


def memory_largestOverReference(folder, reference):
    """Largest peak of a rank over that of the reference run (on one rank)."""
    return peaks(folder)["max"] / peaks(reference)["max"]


def memory_largestOverSmallest(folder, _):
    """Largest peak of a rank over the smallest: rank 0, which reads the mesh, against the others."""
    return peaks(folder)["max"] / peaks(folder)["min"]
