"""Random scene for a seed: random family and parameters."""
from friction_builder import Scene, fill
from friction_flat import clamp, floor, incline, layers, stack
from friction_round import arch, ball, cylinder, dovetail, groove, pin, wave

FAMILIES = [(floor, 4), (stack, 5), (incline, 3), (groove, 3), (pin, 3), (cylinder, 4), (dovetail, 3), (ball, 3), (clamp, 3), (layers, 2),
            (wave, 3), (arch, 2)]


def scene(seed, family=None, dimension=None):
    """Returns the scene for a seed."""
    return fill(Scene(seed, dimension), FAMILIES, family)
