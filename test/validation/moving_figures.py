"""V23: figures of scenes whose bodies move far, from steps.csv, rigid_groups.csv and the contact files of all steps; see figures.py."""
import csv
import math
import os

import numpy as np

from runfiles import contact, motions, steps


def group(folder, name):
    """Columns of rigid_groups.csv of a rigid group."""
    with open(os.path.join(folder, "rigid_groups.csv"), newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["group"] == name]
    return {column: np.array([float(row[column]) for row in rows]) for column in rows[0] if column != "group"}


def since(table, time):
    return np.flatnonzero(table["time"] > time - 1e-9)


# --- arch of two voussoirs ---

def quarterRing(inner, outer, divisions):
    """Area, and distance of the centroid from both straight sides, of the polygon that a quarter of a ring has in the mesh."""
    angles = 0.5 * math.pi * np.arange(divisions + 1) / divisions
    arc = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    a = np.concatenate([outer * arc, inner * arc[::-1]])
    b = np.roll(a, -1, axis=0)
    cross = a[:, 0] * b[:, 1] - b[:, 0] * a[:, 1]
    area = 0.5 * cross.sum()
    return area, ((a[:, 0] + b[:, 0]) * cross).sum() / (6 * area)


def threeHinge(spread, inner, outer, divisions):
    """Thrust over weight of two rigid voussoirs on hinges at the inner ends of their feet and at the outer end of the crown, whose feet
    have moved apart by `spread`."""
    centre = quarterRing(inner, outer, divisions)[1]
    half = inner + spread / 2
    crown = math.sqrt(inner ** 2 + outer ** 2 - half ** 2)
    turn = math.atan2(outer, inner) - math.atan2(crown, half)  # of the left voussoir, clockwise
    lever = (inner - centre) * math.cos(turn) + centre * math.sin(turn)
    return lever / (2 * crown)


def moving_archThrust(folder, _, speed, begin, inner=9.0, outer=11.0, divisions=24):
    """Largest relative deviation of horizontal force over weight from that of three hinges, at the steps from `begin` on. `speed`: motion of
    the abutment per time, from time 1."""
    table, worst = steps(folder), 0.0
    for k in since(table, begin):
        weight = -sum(table[f"force springing {side} y"][k] for side in ("left", "right"))
        thrust = abs(table["force springing left x"][k]) / weight
        worst = max(worst, abs(thrust / threeHinge(speed * (table["time"][k] - 1), inner, outer, divisions) - 1))
    return float(worst)


def moving_archWeight(folder, _, inner=9.0, outer=11.0, divisions=24):
    """Vertical force of the springings at the last step over the weight of the voussoirs."""
    table = steps(folder)
    found = -sum(table[f"force springing {side} y"][-1] for side in ("left", "right"))
    return float(found / (2 * quarterRing(inner, outer, divisions)[0]))


# --- roller in a hollow ---

def moving_hollowAngle(folder, _, clearance, weight, pull):
    """Largest deviation of the direction from the centre of the hollow to that of the roller from atan(H / W), H = pull (t - 1) [radians].
    Without a load H the elastic approach alone moves the roller."""
    axle, worst = group(folder, "axle"), 0.0
    for k in since(axle, 2):
        angle = math.atan2(axle["displacement_x"][k], clearance - axle["displacement_y"][k])
        worst = max(worst, abs(angle - math.atan2(pull * (axle["time"][k] - 1), weight)))
    return float(worst)


def moving_hollowForce(folder, _, weight, pull):
    """Largest deviation of the direction of the contact force from that of the loads [radians]."""
    table = steps(folder)
    found = np.arctan2(table["force joint x"], -table["force joint y"])
    return float(np.abs(found - np.arctan2(pull * (table["time"] - 1), weight)).max())


# --- roller on a plane ---

def hertz(load, radius, modulus):
    """Half width and largest pressure."""
    half = math.sqrt(4 * load * radius / (math.pi * modulus))
    return half, 2 * load / (math.pi * half)


def moving_rollerPressure(folder, _, extreme, load, width, radius=10.0, modulus=2.1e5 / 0.91 / 2):
    """Largest force of a pair over the undeformed width of an element, over Hertz' pressure; `extreme` of all steps. The pressure in the
    files is the force over the present width, which compression has shortened."""
    table, most = steps(folder), hertz(load, radius, modulus)[1]
    found = [contact(folder, k).point["ContactForce"].max() / width / most for k in range(len(table["time"]))]
    return float(getattr(np, extreme)(found))


def moving_rollerPath(folder, _, angle, radius=10.0):
    """Path of the roller from the first step to that in which it has turned by `angle`, over radius times angle, minus one."""
    roller = motions(folder, "roller")
    turned = roller["rotation_z"][0] - roller["rotation_z"]
    place = int(np.argmin(np.abs(turned - angle)))
    return float((roller["displacement_x"][place] - roller["displacement_x"][0]) / (radius * turned[place]) - 1)


# --- pin in a lug ---

def moving_hingeTorque(folder, _, extreme, begin, load, radius):
    """Torque on the pin about its axis over load times radius: that of the drive, whose point has moved with the lug, and that of the load,
    which acts there; `extreme` of the steps from `begin` on."""
    drive = group(folder, "drive")
    torque = drive["mz"] - drive["displacement_x"] * load
    return float(getattr(np, extreme)(torque[since(drive, begin)]) / (load * radius))


def moving_hingeAngle(folder, _, extreme, begin):
    """Direction of the contact from the axis of the pin, from the vertical, at the steps from `begin` on: of the sum of places times forces."""
    table, found = steps(folder), []
    for k in since(table, begin):
        c = contact(folder, k)
        x, y = (c.points * c.point["ContactForce"][:, None]).sum(axis=0) / c.point["ContactForce"].sum()
        found.append(math.atan2(-x, y))
    return float(getattr(np, extreme)(found))


# --- gears ---

def teeth(folder, module=2.0):
    """Number of pairs of teeth in contact, and sum of the normal forces, at each step. Contacts of two pairs of teeth are farther apart than
    a module."""
    numbers, sums = [], []
    for k in range(len(steps(folder)["time"])):
        c = contact(folder, k)
        force = c.point["ContactForce"]
        across = np.sort(c.points[force > 1e-9 * force.max(), 1])
        numbers.append(1 + int((np.diff(across) > module).sum()))
        sums.append(force.sum())
    return np.array(numbers), np.array(sums)


def moving_gearForce(folder, _, extreme, pairs, moment, base):
    """Sum of the normal forces times the base radius over the moment; `extreme` of the steps with `pairs` pairs of teeth in contact."""
    numbers, sums = teeth(folder)
    return float(getattr(np, extreme)(sums[numbers == pairs]) * base / moment)


def moving_gearShare(folder, _):
    """Part of the angle with two pairs of teeth in contact: of steps of equal length over one pitch, whose last one repeats the first one."""
    return float((teeth(folder)[0][1:] == 2).mean())


def moving_gearWork(folder, _, driving="drive", driven="shaft"):
    """Work of the driving group plus that of the driven one less the change of the stored energy over all steps but the first, over the work
    of the driving group: 0 within the error of the trapezoidal rule."""
    table, one, two = steps(folder), group(folder, driving), group(folder, driven)
    works = [np.trapz(side["mz"], side["rotation_z"]) for side in (one, two)]
    return float((sum(works) - (table["stored_energy"][-1] - table["stored_energy"][0])) / works[0])
