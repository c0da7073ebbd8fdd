"""Random scene whose bodies move far, for a seed: random family and parameters."""
from moving_builder import Scene, fill
from moving_flat import hop, ramp, rock, slide, stack
from moving_round import between, cam, cap, hollow, pin, roll

FAMILIES = [(slide, 6), (stack, 4), (ramp, 3), (rock, 2), (hop, 3), (roll, 4), (between, 3), (pin, 3), (cam, 2), (hollow, 2), (cap, 2)]


def scene(seed, family=None, dimension=None):
    """Returns the scene for a seed."""
    return fill(Scene(seed, dimension), FAMILIES, family)
