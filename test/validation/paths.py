"""Figures of runs with load steps, from steps.csv and the fields of single steps; see figures.py. Times are ends of steps."""
import math

import numpy as np

from runfiles import contact, fields, motions, placeAt, steps, summary


def path_value(folder, _, column, time, since=None):
    """A column of steps.csv at a time, minus its value at an earlier time."""
    table = steps(folder)
    return float(table[column][placeAt(table, time)] - (table[column][placeAt(table, since)] if since is not None else 0.0))


def path_motion(folder, _, body, column, time, since=None):
    """A column of frames.csv of a body at a time, minus its value at an earlier time."""
    table = motions(folder, body)
    return float(table[column][placeAt(table, time)] - (table[column][placeAt(table, since)] if since is not None else 0.0))


def path_ratio(folder, _, column, over, time):
    """Ratio of two columns of steps.csv."""
    return path_value(folder, None, column, time) / path_value(folder, None, over, time)


def path_largestDisplacement(folder, _, time, over=None):
    """Largest magnitude of a displacement at a time, over that at another time."""
    u = fields(folder, placeAt(steps(folder), time)).point["Displacement"]
    return float(np.linalg.norm(u, axis=1).max() / (path_largestDisplacement(folder, None, over) if over is not None else 1.0))


def path_displacementAt(folder, _, time, x, y, component):
    """Component of the displacement of the node nearest to a point, in 2D."""
    f = fields(folder, placeAt(steps(folder), time))
    return float(f.point["Displacement"][np.argmin(np.hypot(f.points[:, 0] - x, f.points[:, 1] - y)), component])


def path_meanDisplacement(folder, _, time, x, component=0):
    """Mean displacement of the nodes with the given x."""
    f = fields(folder, placeAt(steps(folder), time))
    return float(f.point["Displacement"][np.abs(f.points[:, 0] - x) < 1e-9 * max(1.0, abs(x)), component].mean())


# --- comparison of two paths, at the Times of both scenes ---

def atTimes(folder, reference):
    a, b = steps(folder), steps(reference)
    times = sorted({*summary(folder)["parameters"]["Load Steps"]["Times"]} & {*summary(reference)["parameters"]["Load Steps"]["Times"]})
    return a, b, [placeAt(a, t) for t in times], [placeAt(b, t) for t in times]


def path_forceDifference(folder, reference, times=1, angle=0):
    """Largest |f - times R f_reference| of the contacts' forces at all Times over the largest |times f_reference|; 2D scenes may be rotated."""
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


# --- Cattaneo's contact of half planes of one material, pressed, then pushed to and fro (Mindlin and Deresiewicz 1953; Johnson, sections
# 7.2 and 7.4). With `balls` of half spaces, of which the half y >= 0 is modelled. The gap is x^2 / (2 radius), of balls r^2 / that. ---

def touching(table, place, mu=0.3, modulus=1 / (2 * 0.91), radius=1.0, line="touch", balls=False):
    """Forces P and Q, half width or radius a of the contact, and mu p0."""
    normal, tangential = -table[f"force {line} {'z' if balls else 'y'}"][place], table[f"force {line} x"][place]
    if balls:
        a = (3 * 2 * normal * radius / (4 * modulus)) ** (1 / 3)
        return 2 * normal, 2 * tangential, a, mu * 3 * 2 * normal / (2 * math.pi * a ** 2)
    a = math.sqrt(4 * normal * radius / (math.pi * modulus))
    return normal, tangential, a, mu * 2 * normal / (math.pi * a)


def stuck(share, balls=False):
    """c/a at a share Q / (mu P)."""
    return (1 - abs(share)) ** (1 / 3 if balls else 1 / 2)


class Mindlin:
    """Traction over mu p0 after pushes, in order of x: `x` and `r` over a, `found` along x and y, `exact`, `widths` of stick over a.

    \\param turns  ends of the successive pushes in opposite directions; the last one is the evaluated time
    """

    def __init__(self, folder, turns, mu=0.3, balls=False, **options):
        table = steps(folder)
        place = placeAt(table, turns[-1])
        normal, _, a, most = touching(table, place, mu=mu, balls=balls, **options)
        c = contact(folder, place)
        order = np.argsort(c.points[:, 0], kind="stable")
        places = c.points[order, :c.dimension - 1] / a
        self.x, self.r, self.found = places[:, 0], np.linalg.norm(places, axis=1), c.point["TangentialTraction"][order] / most
        self.middle = np.abs(places[:, 1:]).sum(axis=1) < 1e-9  # on the line of the push
        self.exact, self.widths, last = np.zeros(len(order)), [], 0.0
        for turn in turns:
            tangential = touching(table, placeAt(table, turn), mu=mu, balls=balls, **options)[1]
            times = 2 if self.widths else 1  # after a reversal slip opposes the previous slip: twice the traction
            change, last = (tangential - last) / times, tangential
            k = stuck(change / (mu * normal), balls)
            self.widths.append(k)
            self.exact += times * math.copysign(1, change) * (np.sqrt(np.maximum(0, 1 - self.r ** 2)) -
                                                              k * np.sqrt(np.maximum(0, 1 - (self.r / k) ** 2)))


def path_mindlinError(folder, _, turns, beside=1.5, **options):
    """Largest deviation of the traction along x over mu p0, except within `beside` pairs of the ends of contact and stick, where its slope
    is infinite."""
    m = Mindlin(folder, turns, **options)
    step = np.min(np.diff(m.x[m.middle]))
    far = np.all([np.abs(m.r - end) > beside * step for end in (1.0, *m.widths)], axis=0)
    return float(np.abs(m.found[:, 0] - m.exact)[far].max())


def path_mindlinAcross(folder, _, turns, **options):
    """Largest traction across the push over mu p0, which Cattaneo neglects."""
    return float(np.abs(Mindlin(folder, turns, **options).found[:, 1]).max())


def path_mindlinTraction(folder, _, turns, at, **options):
    """Traction over mu p0 at x/a on the line of the push, interpolated linearly between pairs."""
    m = Mindlin(folder, turns, **options)
    return float(np.interp(at, m.x[m.middle], m.found[m.middle, 0]))


def path_mindlinStick(folder, _, turn, **options):
    """c/a after the first push from the traction at the centre, q(0) = mu p0 (1 - c/a), over the formula's value at the computed forces."""
    m = Mindlin(folder, [turn], **options)
    return float((1 - m.found[np.argmin(m.r), 0]) / m.widths[0])


def path_mindlinDissipation(folder, _, time, since=None, mu=0.3, balls=False, shear=1 / 2.6, poisson=0.3, radius=1.0, **options):
    """Dissipated work over the integral of mu p times the slip. Slip of a virgin contact where it slips: of half planes, from the
    integral equation, (mu / R) (x sqrt(x^2 - c^2) - c^2 arcosh(x / c)) / 2; of half spaces, the mean around a circle, from the
    superposition of two fully slipping contacts. After a reversal: twice the slip for half the change of force."""
    table = steps(folder)
    place = placeAt(table, time)
    normal, tangential, a, most = touching(table, place, mu=mu, balls=balls, radius=radius, **options)
    before = touching(table, placeAt(table, since), mu=mu, balls=balls, radius=radius, **options)[1] if since is not None else 0.0
    times = 2 if since is not None else 1
    c = a * stuck(min(abs(tangential - before) / times / (mu * normal), 1 - 1e-12), balls)
    x = c + (a - c) * 0.5 * (1 - np.cos(np.linspace(0, math.pi, 20001)))
    root = np.sqrt(np.maximum(0, x ** 2 - c ** 2))
    if balls:
        inside = np.arcsin(np.minimum(1, c / x))
        slip = 3 * mu * normal * (2 - poisson) / (16 * shear * a ** 3) * (
            (x ** 2 - 2 * c ** 2) * (1 - 2 / math.pi * inside) + 2 / math.pi * c * root)
        around = math.pi * x / 2  # half of the circle is modelled
    else:
        slip = mu / radius * (x * root - c ** 2 * np.arccosh(np.maximum(1, x / c))) / 2
        around = 1
    exact = 2 * times * np.trapz(around * most * np.sqrt(np.maximum(0, 1 - (x / a) ** 2)) * slip, x)
    return path_value(folder, None, "dissipated_work", time, since) / exact


def path_mindlinApproach(folder, _, times, mu=0.3, balls=True, shear=1 / 2.6, poisson=0.3, **options):
    """Largest relative deviation of the approach of two balls along the push from Mindlin's formula, for first pushes: 3 mu P (2 - nu) / (8 G a)
    (1 - (1 - Q / mu P)^(2/3)). The grip's displacement has an additional part proportional to Q, because bodies are finite; it is fitted by least squares."""
    table = steps(folder)
    places = [placeAt(table, time) for time in times]
    forces, expected, ways = [], [], []
    for place in places:
        normal, tangential, a, _ = touching(table, place, mu=mu, balls=balls, **options)
        forces.append(tangential)
        expected.append(3 * mu * normal * (2 - poisson) / (8 * shear * a) * (1 - stuck(tangential / (mu * normal), balls) ** 2))
        f = fields(folder, place)
        ways.append(f.point["Displacement"][f.points[:, 2] > f.points[:, 2].max() * (1 - 1e-6), 0].mean())
    forces, expected, ways = np.array(forces), np.array(expected), np.array(ways)
    part = np.dot(forces / expected, ways / expected - 1) / np.dot(forces / expected, forces / expected)
    return float(np.abs((ways - part * forces) / expected - 1).max())
