"""Random scenes of boxes in 2D as XML, for tests of forces."""
import random


def parameter(name, kind, value):
    return f'<Parameter name="{name}" type="{kind}" value="{value}"/>'


def group(name, *contents):
    return f'<ParameterList name="{name}">' + "".join(contents) + "</ParameterList>"


def array(*values):
    return "{" + ", ".join(repr(value) for value in values) + "}"


class RandomBoxes:
    """A random scene. `fine`: factor of the number of cells in each direction. Subclasses choose the cell and whether the load moves."""

    def __init__(self, seed, fine, folder):
        self.random = random.Random(seed)
        self.fine, self.folder = fine, folder
        self.boxes, self.bodies, self.materials, self.conditions, self.contacts = [], [], [], [], []

    def body(self, name, stiffness):
        self.bodies.append(group(name, parameter("Material", "string", "of " + name)))
        self.materials.append(group("of " + name, parameter("Type", "string", "Isotropic"),
                                    parameter("Young Modulus", "double", stiffness),
                                    parameter("Poisson Ratio", "double", self.random.choice([0, 0.2, 0.3, 0.3, 0.45]))))

    def cells(self, name, x, y, cells):
        """A box; `cells` along x and y, on the mesh with fine = 1."""
        self.boxes.append(group(name, parameter("X", "Array(double)", array(*x)), parameter("Y", "Array(double)", array(*y)),
                                parameter("Cells", "Array(int)", array(*(n * self.fine for n in cells))),
                                parameter("Cell", "string", self.cell)))
        self.body(name, 10 ** self.random.uniform(4, 6))

    def condition(self, name, sides, kind, *values):
        self.conditions.append(group(name, parameter("Group", "string", sides), parameter("Type", "string", kind), *values))

    def fix(self, name, sides):
        self.condition(name, sides, "Displacement", parameter("Value", "Array(double)", array(0.0, 0.0)))

    def contact(self, name, a, b):
        self.contacts.append(group(name, parameter("Side A", "string", a), parameter("Side B", "string", b)))
