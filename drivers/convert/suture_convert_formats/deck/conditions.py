"""Boundary conditions of a scene, with names that are not repeated."""
import dataclasses

LETTERS = "xyz"


@dataclasses.dataclass
class Condition:
    """
    name     as in the scene
    type     as in the scene
    values   parameter -> number, list of numbers, or text
    factors  values at the times of the load steps, or None
    """
    name: str
    type: str
    values: dict
    factors: tuple = None


class Conditions:
    def __init__(self, dimension):
        self.dimension, self.all, self.names = dimension, [], set()

    def add(self, name, type_, factors=None, **values):
        """Parameters with underscores for blanks: Reference_Temperature=20. \\return the condition"""
        from .solids import clean

        name = free = clean(name).replace("/", "_")
        count = 1
        while free in self.names:
            count += 1
            free = f"{name} {count}"
        self.names.add(free)
        self.all.append(Condition(free, type_, {key.replace("_", " "): value for key, value in values.items()}, factors))
        return self.all[-1]

    def vector(self, members):
        """All components of a vector from {number from 0: value}"""
        return [float(members.get(k, 0.0)) for k in range(self.dimension)]
