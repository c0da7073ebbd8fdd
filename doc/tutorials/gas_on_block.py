"""Gas in a chamber presses a block onto another one: a coupling of Suture with a program of ten lines. Guide: doc/python_coupling.md."""
import sys

from mpi4py import MPI

import suture

E, P0, CHAMBER, KAPPA = 2e6, 1e4, 0.1, 1.4  # modulus and first pressure [Pa], height of the chamber [m], exponent of the gas
side = {"Cells": [8, 8], "Cell": "Quadrilateral4", "X": [-1, 1]}
scene = {
    "Title": "Gas on a block", "Model": "Plane Strain",
    "Mesh": {"Generator": "Boxes", "Boxes": {"upper": dict(side, Y=[0, 1]), "lower": dict(side, Y=[-1, 0])}},
    "Bodies": {"upper": {"Material": "rubber"}, "lower": {"Material": "rubber"}},
    "Materials": {"rubber": {"Young Modulus": E, "Poisson Ratio": 0}},
    "Boundary Conditions": {"guide": {"Group": "upper_left", "Type": "Bilateral"},
                            "ground": {"Group": "lower_bottom", "Type": "Displacement", "Value": [0, 0]}},
    "Contact": {"joint": {"Side A": "upper_bottom", "Side B": "lower_top"}}}


def gas(stroke, way):
    """Pressure of the gas when its piston has moved down by `stroke` and the block by `way`."""
    return P0 * (CHAMBER / (CHAMBER - stroke + way)) ** KAPPA


def exact(stroke):
    """The pressure at equilibrium, by bisection: the blocks are a column of height two, so that way = 2 p / E."""
    low, high = 0.0, 100 * P0
    for _ in range(200):
        p = (low + high) / 2
        low, high = (p, high) if gas(stroke, 2 * p / E) > p else (low, p)
    return p


comm = MPI.COMM_WORLD
coupling = suture.Coupling(scene, comm)
top = coupling.surface("upper_top")


def way():
    """Mean downward displacement of the block's top in the last solution."""
    u = coupling.displacements(top)
    return -comm.allreduce((top.areas * u[:, 1]).sum()) / 2


def way_at(pressure):
    coupling.set_forces(top, -pressure * top.normals)
    coupling.solve(verified=False)
    return way()


if comm.rank == 0:
    print("stroke [m]  solves  pressure [Pa]      exact  way [mm]")
pressure = P0
for stroke in (0.02, 0.05, 0.08, 0.03):
    before = None
    for solves in range(1, 50):
        miss = gas(stroke, way_at(pressure)) - pressure
        if abs(miss) < 1e-6 * pressure:
            break
        # Secant method, after a first careful step.
        step = 0.3 * miss if before is None else miss * (pressure - before[0]) / (before[1] - miss)
        before, pressure = (pressure, miss), pressure + step
    else:
        sys.exit("gas and block do not agree after 49 solves")
    coupling.solve()  # with the verdict, once per step
    coupling.advance()
    down = 1000 * way()
    if comm.rank == 0:
        print("%10.2f  %6d  %13.1f  %9.1f  %8.3f" % (stroke, solves, pressure, exact(stroke), down))
if comm.rank == 0:
    print(coupling)
