"""A block lies on a cantilever bar and is pushed towards its tip; only friction holds it. How many pairs slip?"""
import numpy
from mpi4py import MPI

import suture


def scene(mu):
    """The names and nesting of a scene file; lengths in mm, stresses in MPa."""
    def box(x, y, cells):
        return {"X": x, "Y": y, "Cells": cells, "Cell": "Quadrilateral4"}

    return {
        "Title": "Block on a bar", "Model": "Plane Strain", "Units": "mm, N, MPa",
        "Mesh": {"Generator": "Boxes", "Boxes": {"bar": box([0, 40], [0, 4], [80, 8]), "block": box([20, 31], [4, 10], [22, 12])}},
        "Bodies": {"bar": {"Material": "stiff"}, "block": {"Material": "stiff"}},
        "Materials": {"stiff": {"Young Modulus": 1e5, "Poisson Ratio": 0.3}},
        "Boundary Conditions": {
            "wall": {"Group": "bar_left", "Type": "Displacement", "Value": [0, 0]},
            "weight": {"Group": "block_top", "Type": "Traction", "Value": [0, -1]},
            "push": {"Group": "block_right", "Type": "Traction", "Value": [0.3, 0]}},
        "Contact": {"seat": {"Side A": "bar_top", "Side B": "block_bottom", "Law": "Coulomb", "Coulomb": {"Coefficient": mu}}},
    }


def say(*words):
    if MPI.COMM_WORLD.rank == 0:
        print(*words)


say("  mu   open  slip  stick   held [N]")
for mu in (0.17, 0.2, 0.3, 0.6):
    result = suture.solve(scene(mu))
    pairs = result.pairs  # on rank 0: its arrays are views of the library's data
    count = [numpy.count_nonzero(pairs.status == status) for status in (suture.OPEN, suture.SLIP, suture.STICK)]
    say("%5.2f %5d %5d %6d %10.4f" % (mu, *count, numpy.sum(pairs.tangential_force, axis=0)[0]))

fields = result.gather()  # the whole mesh, on rank 0
if fields:
    tip = numpy.argmax(fields.coordinates[:, 0])
    print("the tip goes down by %.4f mm" % -fields.displacement[tip, 1])

try:
    suture.solve(scene(0.15))  # 1.8 N are more than 0.15 x 11 N
except suture.InputError as error:
    say(error)
except suture.NumericalError as error:
    say(error)
