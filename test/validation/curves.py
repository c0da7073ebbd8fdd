"""Analytic pressures along contact lines, for the figures and the pictures."""
import math

import numpy as np


def along(c, name):
    """Coordinate of the points of a contact file: x, y, the angle about the origin in degrees, the radius there, or the arc length."""
    if name == "angle":
        return np.degrees(np.arctan2(c.points[:, 1], c.points[:, 0]))
    if name == "radius":
        return np.hypot(c.points[:, 0], c.points[:, 1])
    return c.point["ArcLength"] if name == "arc" else c.points[:, "xy".index(name)]


def hertz(x, peak, halfWidth):
    return peak * np.sqrt(np.maximum(0, 1 - (x / halfWidth) ** 2))


def uniform(x, pressure):
    return np.full_like(x, pressure)


def punch(x, force, halfWidth):
    """Pressure under a rigid flat punch with `force`; NaN at the edges, where it is infinite, and beyond."""
    inside = np.abs(x) < halfWidth
    return np.where(inside, force / (math.pi * np.sqrt(np.where(inside, halfWidth ** 2 - x ** 2, 1))), np.nan)


def squareRoot(x, factor, origin=0):
    return factor * np.sqrt(np.maximum(0, x - origin))


def parabola(x, constant, factor, origin=0):
    return constant + factor * (x - origin) ** 2
