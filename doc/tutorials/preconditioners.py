"""Preconditioners and coarse spaces written in Python, on a scene with many subdomains. Guide: doc/python.md."""
import sys

import numpy
from mpi4py import MPI

import suture


@suture.preconditioner("Diagonal In Python")
def diagonal(local):
    return lambda residual: local.weights * residual / local.assembled_diagonal


@suture.preconditioner("Neumann-Neumann In Python")
def neumann(local):
    inverse = local.inverse()
    return lambda residual: local.weights * inverse(local.weights * residual)


@suture.coarse_space("Softest Modes", count=3)
def softest(local, count):
    """The modes of least energy relative to the diagonal of the stiffness: rigid-body modes, then the next ones."""
    scale = 1 / numpy.sqrt(local.stiffness_diagonal)
    vectors = numpy.linalg.eigh(scale[:, None] * local.schur() * scale)[1]
    return scale[:, None] * vectors[:, :int(count)]


def solve(kind, **own):
    changes = {"Partition": {"METIS": {"Subdomains": 12}}, "Preconditioner": {"Type": kind, kind: own}}
    return suture.solve(sys.argv[1], set=changes)


python = "Neumann-Neumann In Python"
choices = [("Diagonal In Python", "None", {}), (python, "None", {}), (python, "Rigid Modes", {}), (python, "Softest Modes", {"Count": 3}),
           (python, "Softest Modes", {"Count": 8}), ("Neumann-Neumann", "Rigid Modes", {})]
for kind, space, own in choices:
    result = solve(kind, **{"Coarse Space": space, space: own})
    if MPI.COMM_WORLD.rank == 0:
        name = space + "".join(" %d" % count for count in own.values())
        print("%-26s %-16s %4d iterations, energy %.6e" % (kind, name, result.summary["outer"]["pcg_total"], result.energy))
