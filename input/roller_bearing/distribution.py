#!/usr/bin/python3
"""Forces of the rollers by Sjoevall's method, independent of Suture: a rigid shaft sinks, each roller deforms independently.

distribution.py [CLEARANCE]...: prints the forces of rollers 0 to 6 in N/mm for diametral clearances in mm.
The compression of a roller and its raceways is the sum of K. L. Johnson, Contact Mechanics, eq. 5.56 (raceways) and 5.57 (roller).
"""
import math
import sys

COUNT, LOAD, YOUNG, POISSON = 13, 1000.0, 2.08e5, 0.3
ROLLER, INNER, OUTER, INNER_DEPTH, OUTER_DEPTH = 5.0, 30.0, 40.0, 30.0, 10.0
COMPLIANCE = (1 - POISSON**2) / YOUNG


def bisect(increasing, value, low, high):
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (middle, high) if increasing(middle) < value else (low, middle)
    return low


def approach(force):
    """Compression of a roller and its raceways under a force [N/mm]."""
    if force <= 0:
        return 0.0
    total = 0.0
    for curvature, depth in ((1 / ROLLER + 1 / INNER, INNER_DEPTH), (1 / ROLLER - 1 / OUTER, OUTER_DEPTH)):
        width = math.sqrt(8 * force * COMPLIANCE / (math.pi * curvature))  # half width by Hertz
        raceway = math.log(2 * depth / width) - POISSON / (2 * (1 - POISSON))
        roller = math.log(4 * ROLLER / width) - 0.5
        total += 2 * force * COMPLIANCE / math.pi * (raceway + roller)
    return total


def forces(shift, clearance):
    return [bisect(approach, shift * math.cos(2 * math.pi * j / COUNT) - clearance / 2, 0.0, 1e4) for j in range(COUNT)]


def carried(shift, clearance):
    return sum(q * math.cos(2 * math.pi * j / COUNT) for j, q in enumerate(forces(shift, clearance)))


for argument in sys.argv[1:] or ["0.02"]:
    gap = float(argument)
    sunk = bisect(lambda shift: carried(shift, gap), LOAD, 0.0, 1.0)
    rollers = forces(sunk, gap)
    print(f"clearance {gap:g} mm: shaft sinks {sunk:.4f} mm;", ", ".join(f"{q:.1f}" for q in rollers[:7]), f"; 13 Q_0 / F = {COUNT * rollers[0] / LOAD:.2f}")
