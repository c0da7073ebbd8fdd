"""Numbers and units."""
import math


def scaled(unit, largest):
    """(factor, name) that make the largest value readable; unknown units are kept."""
    steps = {"Pa": [(1e9, "GPa"), (1e6, "MPa"), (1e3, "kPa"), (1.0, "Pa")], "m": [(1.0, "m"), (1e-3, "mm"), (1e-6, "µm")]}.get(unit)
    if not steps or not largest > 0:
        return 1.0, unit
    for factor, name in steps:
        if largest >= (0.5 if unit == "m" else 1.0) * factor:
            return 1.0 / factor, name
    return 1.0 / steps[-1][0], steps[-1][1]


def round_down(value):
    """The largest of 1, 2, 5 times a power of ten that is not above `value`."""
    power = 10.0**math.floor(math.log10(value))
    return max(step * power for step in (1, 2, 5) if step * power <= value * (1 + 1e-9))


def vector(values):
    """Numbers of a scene as given: (0, -5), or -5 for a single value."""
    values = values if isinstance(values, list) else [values]
    texts = [f"{value:.6g}".replace("-", "\u2212", 1) if isinstance(value, (int, float)) else str(value) for value in values]
    return texts[0] if len(texts) == 1 else f"({', '.join(texts)})"
