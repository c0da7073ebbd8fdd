"""Figures of runs with load steps, from steps.csv and the fields of single steps; see figures.py. Times are ends of steps."""
import math

import numpy as np

from runfiles import contact, fields, placeAt, steps, summary


def path_value(folder, _, column, time, since=None):
    """A column of steps.csv at a time, less that at an earlier one."""
    table = steps(folder)
    return float(table[column][placeAt(table, time)] - (table[column][placeAt(table, since)] if since is not None else 0.0))


def path_ratio(folder, _, column, over, time):
    """A column of steps.csv over another one."""
    return path_value(folder, None, column, time) / path_value(folder, None, over, time)


def path_meanDisplacement(folder, _, time, x, component=0):
    """Mean displacement of the nodes with that x."""
    f = fields(folder, placeAt(steps(folder), time))
    return float(f.point["Displacement"][np.abs(f.points[:, 0] - x) < 1e-9 * max(1.0, abs(x)), component].mean())


# --- comparison of two paths, at the Times of both scenes ---

def atTimes(folder, reference):
    a, b = steps(folder), steps(reference)
    times = sorted({*summary(folder)["parameters"]["Load Steps"]["Times"]} & {*summary(reference)["parameters"]["Load Steps"]["Times"]})
    return a, b, [placeAt(a, t) for t in times], [placeAt(b, t) for t in times]


def path_forceDifference(folder, reference, times=1, angle=0):
    """Largest |f - times R f_reference| of the contacts' forces at all Times over the largest |times f_reference|; plane scenes may be turned."""
    a, b, here, there = atTimes(folder, reference)
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    turn = times * np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    worst = largest = 0.0
    for name in {column[:-2] for column in b if column.startswith("force ")}:
        found, expected = (np.stack([table[f"{name} {axis}"][at] for axis in "xyz"], axis=1) for table, at in ((a, here), (b, there)))
        worst = max(worst, np.linalg.norm(found - expected @ turn.T, axis=1).max())
        largest = max(largest, np.linalg.norm(expected @ turn.T, axis=1).max())
    return float(worst / largest)


def path_stateDifference(folder, reference):
    """Largest difference, at all Times, of the numbers of closed, sticking and slipping pairs."""
    a, b, here, there = atTimes(folder, reference)
    return int(max(np.abs(a[name][here] - b[name][there]).max() for name in ("active", "sticking", "slipping")))


def path_workDifference(folder, reference, times=1):
    """Largest difference of external, stored and dissipated work at all Times, over the largest external work of the reference."""
    a, b, here, there = atTimes(folder, reference)
    return float(max(np.abs(a[name][here] - times * b[name][there]).max() for name in ("external_work", "stored_energy", "dissipated_work"))
                 / np.abs(times * b["external_work"][there]).max())


# --- Cattaneo's line contact, pressed, then pushed to and fro (Mindlin and Deresiewicz 1953; Johnson, section 7.4) ---

def touching(table, place, mu, radius, modulus, line):
    """Forces P and Q, half width a and mu p0."""
    normal, tangential = -table[f"force {line} y"][place], table[f"force {line} x"][place]
    a = math.sqrt(4 * normal * radius / (math.pi * modulus))
    return normal, tangential, a, mu * 2 * normal / (math.pi * a)


def mindlin(folder, turns, mu=0.3, modulus=1 / (2 * 0.91), radius=1.0, line="touch"):
    """Places x/a, tractions over mu p0, exact ones, and half widths of stick over a. The last of the turns is the time that is looked at."""
    table = steps(folder)
    place = placeAt(table, turns[-1])
    normal, _, a, most = touching(table, place, mu, radius, modulus, line)
    c = contact(folder, place)
    order = np.argsort(c.points[:, 0])
    x, found = c.points[order, 0] / a, c.point["TangentialTraction"][order, 0] / most
    exact, widths, last = np.zeros(len(x)), [], 0.0
    for turn in turns:
        tangential = table[f"force {line} x"][placeAt(table, turn)]
        times = 2 if widths else 1  # after a turn slip goes against the slip before: twice the traction
        change, last = (tangential - last) / times, tangential
        widths.append(math.sqrt(1 - abs(change) / (mu * normal)))
        exact += times * math.copysign(1, change) * (np.sqrt(np.maximum(0, 1 - x ** 2)) -
                                                     widths[-1] * np.sqrt(np.maximum(0, 1 - (x / widths[-1]) ** 2)))
    return x, found, exact, widths


def path_mindlinError(folder, _, turns, beside=1.5, **options):
    """Largest deviation of the traction over mu p0, but `beside` pairs from the ends of contact and stick, where its slope is infinite.
    \\param turns  ends of the pushes, one after the other in opposite directions"""
    x, found, exact, widths = mindlin(folder, turns, **options)
    step = np.min(np.diff(x))
    far = np.all([np.abs(np.abs(x) - end) > beside * step for end in (1.0, *widths)], axis=0)
    return float(np.abs(found - exact)[far].max())


def path_mindlinTraction(folder, _, turns, at, **options):
    """Traction over mu p0 at a place x/a, linear between pairs."""
    x, found, _, _ = mindlin(folder, turns, **options)
    return float(np.interp(at, x, found))


def path_mindlinDissipation(folder, _, time, since=None, mu=0.3, modulus=1 / (2 * 0.91), radius=1.0, line="touch"):
    """Dissipated work over the integral of mu p times the slip. Slip of a virgin contact where it slips, from the half planes' integral
    equation: (mu / R) (x sqrt(x^2 - c^2) - c^2 arcosh(x / c)) / 2; twice that, of half the change of force, after a turn."""
    table = steps(folder)
    place = placeAt(table, time)
    normal, tangential, a, most = touching(table, place, mu, radius, modulus, line)
    before = table[f"force {line} x"][placeAt(table, since)] if since is not None else 0.0
    times = 2 if since is not None else 1
    c = a * math.sqrt(max(1 - abs(tangential - before) / times / (mu * normal), 1e-24))
    x = c + (a - c) * 0.5 * (1 - np.cos(np.linspace(0, math.pi, 20001)))
    slip = mu / radius * (x * np.sqrt(np.maximum(0, x ** 2 - c ** 2)) - c ** 2 * np.arccosh(np.maximum(1, x / c))) / 2
    exact = 2 * times * np.trapz(most * np.sqrt(np.maximum(0, 1 - (x / a) ** 2)) * slip, x)
    return path_value(folder, None, "dissipated_work", time, since) / exact
