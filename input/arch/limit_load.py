#!/usr/bin/python3
"""Limit analysis of the arch of arch.geo as rigid voussoirs, by linear programming, independent of Suture. Needs python3-scipy.

limit_load.py [PRESSURE]: prints the largest pressure on the loaded voussoir that equilibrium allows, and, for PRESSURE (200 kPa), the
smallest and largest horizontal thrust. The unknowns are forces >= 0, normal to the face, at both ends of the five faces of each joint.
"""
import math
import sys

import numpy
from scipy.optimize import linprog

COUNT, INNER, OUTER, OPENING, KEY, LOADED, WEIGHT = 21, 4.5, 5.5, 157.5, 0.1, 15, 24.0
FIRST, STEP = math.radians((180 - OPENING) / 2), math.radians(OPENING / COUNT)
PER_JOINT = 10
UNKNOWNS = PER_JOINT * (COUNT + 1) + 1  # the last one: the pressure


def joint(k):
    """The corners of joint k, from the inside of the arch to its back."""
    angle, middle = FIRST + k * STEP, (INNER + OUTER) / 2
    along, across = numpy.array([math.cos(angle), math.sin(angle)]), numpy.array([-math.sin(angle), math.cos(angle)])
    return [INNER * along, (middle - 2 * KEY) * along, (middle - KEY) * along + KEY * across, (middle + KEY) * along + KEY * across,
            (middle + 2 * KEY) * along, OUTER * along]


def arc(radius, begin, end, parts=64):
    return [radius * numpy.array([math.cos(t), math.sin(t)]) for t in numpy.linspace(begin, end, parts + 1)]


def areaAndCentre(points):
    """Area of a polygon and the x of its centroid."""
    area = moment = 0.0
    for (x0, y0), (x1, y1) in zip(points, points[1:] + points[:1]):
        cross = x0 * y1 - x1 * y0
        area += cross / 2
        moment += (x0 + x1) * cross / 6
    return area, moment / area


def unitForces(k):
    """Points and directions of the forces of joint k on the voussoir above it."""
    forces = []
    corners = joint(k)
    for begin, end in zip(corners, corners[1:]):
        tangent = (end - begin) / numpy.linalg.norm(end - begin)
        normal = numpy.array([-tangent[1], tangent[0]])
        forces += [(begin, normal), (end, normal)]
    return forces


def equilibrium():
    """Matrix and right-hand side: three equations per voussoir, moments about the origin."""
    matrix, rhs = numpy.zeros((3 * COUNT, UNKNOWNS)), numpy.zeros(3 * COUNT)
    for voussoir in range(1, COUNT + 1):
        begin, row = FIRST + (voussoir - 1) * STEP, 3 * (voussoir - 1)
        end = begin + STEP
        area, centre = areaAndCentre(joint(voussoir - 1) + arc(OUTER, begin, end)[1:-1] + joint(voussoir)[::-1] + arc(INNER, end, begin)[1:-1])
        rhs[row + 1:row + 3] = WEIGHT * area, WEIGHT * area * centre
        for sign, k in ((1, voussoir - 1), (-1, voussoir)):
            for i, (p, d) in enumerate(unitForces(k)):
                matrix[row:row + 3, PER_JOINT * k + i] = sign * d[0], sign * d[1], sign * (p[0] * d[1] - p[1] * d[0])
        if voussoir == LOADED:
            matrix[row + 1, -1] = -OUTER * STEP
            matrix[row + 2, -1] = -OUTER**2 * (math.sin(end) - math.sin(begin))
    return matrix, rhs


def main():
    pressure = float(sys.argv[1]) if len(sys.argv) > 1 else 200.0
    matrix, rhs = equilibrium()
    cost = numpy.zeros(UNKNOWNS)
    cost[-1] = -1
    largest = linprog(cost, A_eq=matrix, b_eq=rhs, bounds=[(0, None)] * UNKNOWNS, method="highs").x[-1]
    print(f"largest pressure {largest:.2f} kPa, {largest * OUTER * STEP:.2f} kN/m")
    thrust = numpy.zeros(UNKNOWNS)
    for i, (_, d) in enumerate(unitForces(0)):
        thrust[i] = -d[0]
    bounds = [(0, None)] * (UNKNOWNS - 1) + [(pressure, pressure)]
    ends = [linprog(sign * thrust, A_eq=matrix, b_eq=rhs, bounds=bounds, method="highs") for sign in (1, -1)]
    if ends[0].status != 0:
        sys.exit(f"no equilibrium at {pressure} kPa")
    print(f"thrust at {pressure:g} kPa between {ends[0].fun:.2f} and {-ends[1].fun:.2f} kN/m")


main()
