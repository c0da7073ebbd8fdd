#!/usr/bin/python3
"""Solves the scene input/press with PETSc: primal-dual active set, conjugate gradients, smoothed aggregation (GAMG) with rigid-body modes.

    mpirun -np 2 python3 test/bench/petsc_gamg.py 20 32 [--json FILE] [PETSc options, such as -ksp_view]

n x n x n cells (Hexahedron8) in two blocks of half the height, assembled by numpy. For a closed pair, the upper node's normal unknown equals
that of the lower node minus the gap; the set starts with all pairs closed and is updated until it repeats. Prints for each n the closed
pairs, the contact force, the number of sets, the iterations, and the seconds after assembly. Debian: python3-petsc4py. Suture does not need PETSc.
"""
import argparse
import glob
import itertools
import json
import resource
import sys
import time

import numpy as np
from scipy.sparse import bsr_matrix

try:
    import petsc4py
except ImportError:  # Debian finds it through a link that only petsc-dev installs
    sys.path += sorted(glob.glob("/usr/lib/petscdir/*/*-real/lib/python3/dist-packages"))
    import petsc4py
OPTIONS = {"ksp_type": "cg", "ksp_rtol": "1e-8", "ksp_max_it": "500", "pc_type": "gamg", "pc_gamg_type": "agg", "pc_gamg_agg_nsmooths": "1",
           "mg_levels_ksp_type": "chebyshev", "mg_levels_ksp_max_it": "2", "mg_levels_pc_type": "jacobi"}


def words():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("n", nargs="+", type=int, help="cells along a side, even")
    parser.add_argument("--json", help="file for the results, a list with an entry for each n")
    own, others = parser.parse_known_args()
    if any(n < 2 or n % 2 for n in own.n):
        parser.error("n: expected even numbers, 2 or more")
    return own, others


chosen, rest = words()
petsc4py.init([sys.argv[0], *rest])
from petsc4py import PETSc  # noqa: E402

COMM = PETSc.COMM_WORLD
CORNERS = np.array(list(itertools.product((0, 1), repeat=3)))


def stiffness(h, young=1.0, poisson=0.3):
    """Stiffness of a cube of side h, 2 x 2 x 2 Gauss points, as [corner, corner, component, component]."""
    lame, mu = young * poisson / ((1 + poisson) * (1 - 2 * poisson)), young / (2 * (1 + poisson))
    total = np.zeros((8, 8, 3, 3))
    for point in (0.5 + np.array(signs) / np.sqrt(12) for signs in itertools.product((-1, 1), repeat=3)):
        value, slope = np.where(CORNERS == 1, point, 1 - point), 2 * CORNERS - 1
        g = np.stack([slope[:, k] * np.prod(np.delete(value, k, axis=1), axis=1) for k in range(3)], axis=1) / h
        pair = np.einsum("ai,bj->abij", g, g)
        total += (lame * pair + mu * pair.transpose(0, 1, 3, 2) + mu * np.einsum("ak,bk,ij->abij", g, g, np.eye(3))) * h ** 3 / 8
    return total


class Press:
    """Both blocks on one lattice of (n + 1)^2 columns of n + 2 nodes: layer n / 2 is the lower block's top, the next the upper's bottom.

    A rank owns whole planes of equal x, and thus both nodes of its pairs. Unknowns are ordered node by node.
    """

    def __init__(self, n):
        self.n, self.shape = n, np.array([n + 1, n + 1, n + 2])
        ranks, rank = COMM.getSize(), COMM.getRank()
        self.planes = [(n + 1) * r // ranks for r in (rank, rank + 1)]
        at = np.indices((self.planes[1] - self.planes[0], n + 1, n + 2)).reshape(3, -1).T
        self.at = at + [self.planes[0], 0, 0]
        self.first = 3 * self.planes[0] * (n + 1) * (n + 2)
        x = self.at / n
        x[:, 2] -= (self.at[:, 2] > n // 2) / n
        self.held = (self.at[:, 2] == 0) | (self.at[:, 2] == n + 1)
        self.lower = np.flatnonzero(self.at[:, 2] == n // 2)
        self.gap = 0.02 * ((x[self.lower, 0] - 0.45) ** 2 + (x[self.lower, 1] - 0.55) ** 2)
        self.matrix = self.assembled()
        self.given = np.zeros(3 * len(x))
        self.given[2::3][self.at[:, 2] == n + 1] = -0.004
        self.points = self.vector(x.ravel())
        self.points.setBlockSize(3)

    def assembled(self):
        """Blocks of each node and its 27 neighbours, from the adjacent cells; blocks without a cell are omitted."""
        n, k = self.n, stiffness(1 / self.n)
        block, there = np.zeros((len(self.at), 27, 3, 3)), np.zeros((len(self.at), 27), bool)
        for a, own in enumerate(CORNERS):
            cell = self.at - own
            present = ((cell >= 0) & (cell < [n, n, n + 1])).all(axis=1) & (cell[:, 2] != n // 2)
            for b, other in enumerate(CORNERS):
                neighbour = np.dot(other - own + 1, [9, 3, 1])
                block[present, neighbour] += k[a, b]
                there[present, neighbour] = True
        offsets = np.array(list(itertools.product((-1, 0, 1), repeat=3)))
        strides = np.array([self.shape[1] * self.shape[2], self.shape[2], 1])
        columns = ((self.at @ strides)[:, None] + offsets @ strides)[there]
        ends = np.concatenate([[0], np.cumsum(there.sum(axis=1))])
        rows = bsr_matrix((block[there], columns, ends), shape=(3 * len(self.at), 3 * int(np.prod(self.shape)))).tocsr()
        del block
        local = 3 * len(self.at)
        matrix = PETSc.Mat().createAIJ(((local, rows.shape[1]),) * 2, bsize=3, comm=COMM,
                                       csr=(rows.indptr.astype(PETSc.IntType), rows.indices.astype(PETSc.IntType), rows.data))
        matrix.setOption(PETSc.Mat.Option.SYMMETRIC, True)
        return matrix

    def reduced(self, closed):
        """T, the shift and 1 at given unknowns: u = T x + shift; x at a closed pair's upper node is its distance from the lower one."""
        local, upper = 3 * len(self.at), 3 * (self.lower[closed] + 1) + 2
        shift, given = self.given.copy(), np.repeat(self.held, 3).astype(float)
        shift[upper], given[upper] = -self.gap[closed], 1
        count = np.ones(local + 1, PETSc.IntType)
        count[0], count[upper + 1] = 0, 2
        rows = np.cumsum(count, dtype=PETSc.IntType)
        columns = np.repeat(self.first + np.arange(local, dtype=PETSc.IntType), count[1:])
        columns[rows[upper]] = self.first + 3 * self.lower[closed] + 2
        to = PETSc.Mat().createAIJ(self.matrix.getSizes(), bsize=3, comm=COMM, csr=(rows, columns, np.ones(len(columns))))
        return to, self.vector(shift), self.vector(given)

    def vector(self, values):
        found = self.matrix.createVecRight()
        found.setArray(values)
        return found

    def solve(self, closed, start):
        """Displacements for the closed pairs, and the iterations; `start` is the initial guess of conjugate gradients."""
        to, shift, given = self.reduced(closed)
        matrix = self.matrix.ptap(to)
        free = self.vector(1 - given.getArray())
        matrix.diagonalScale(free, free)
        matrix.setDiagonal(given, addv=PETSc.InsertMode.ADD_VALUES)
        matrix.setBlockSize(3)
        matrix.setNearNullSpace(PETSc.NullSpace().createRigidBody(self.points))
        force, right = shift.duplicate(), shift.duplicate()
        self.matrix.mult(shift, force)
        to.multTranspose(force, right)
        right.pointwiseMult(right, free)
        right.scale(-1)
        x = shift.duplicate()
        x.pointwiseMult(start, free)
        solver = PETSc.KSP().create(COMM)
        solver.setOperators(matrix)
        solver.setInitialGuessNonzero(True)
        solver.setFromOptions()
        solver.solve(right, x)
        if solver.getConvergedReason() < 0:
            raise RuntimeError(f"conjugate gradients ended with {solver.getConvergedReason()}")
        u = shift.copy()
        to.multAdd(x, shift, u)
        iterations = solver.getIterationNumber()
        for each in (solver, matrix, to):
            each.destroy()
        return u, iterations


def total(value):
    return COMM.tompi4py().allreduce(value)


def run(n):
    begin = time.perf_counter()
    press = Press(n)
    COMM.barrier()
    assembled, cpu = time.perf_counter(), time.process_time()
    closed, u, iterations = np.ones(len(press.lower), bool), press.vector(press.given), []
    force = press.matrix.createVecLeft()
    while True:
        u, done = press.solve(closed, u)
        iterations.append(done)
        press.matrix.mult(u, force)
        pressing = force.getArray().reshape(-1, 3)[press.lower + 1, 2]  # of the lower block on the upper one
        value = u.getArray().reshape(-1, 3)
        gap = press.gap + value[press.lower + 1, 2] - value[press.lower, 2]
        new = np.where(closed, pressing > 0, gap < 0)
        if not total(int((new != closed).sum())):
            break
        closed = new
    COMM.barrier()
    end = time.perf_counter()
    return {"n": n, "unknowns": 3 * int(np.prod(press.shape)), "ranks": COMM.getSize(), "pairs": total(len(closed)),
            "closed": total(int(closed.sum())), "force": total(float(pressing[closed].sum())), "sets": len(iterations),
            "iterations": iterations, "assembly_seconds": assembled - begin, "seconds": end - assembled,
            "cpu_seconds": total(time.process_time() - cpu),
            "peak_memory_mb": total(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024)}


def line(found):
    return (f"n = {found['n']}: {found['unknowns']:,} unknowns, {found['ranks']} ranks: {found['closed']} of {found['pairs']} closed, "
            f"force {found['force']:.6e}; {found['sets']} sets, {'+'.join(map(str, found['iterations']))} CG; assembly "
            f"{found['assembly_seconds']:.1f} s, after it {found['seconds']:.1f} s ({found['cpu_seconds']:.1f} s of all cores), "
            f"{found['peak_memory_mb']:.0f} MB")


if __name__ == "__main__":
    for option, value in OPTIONS.items():
        if not PETSc.Options().hasName(option):
            PETSc.Options()[option] = value
    results = []
    for cells in chosen.n:
        results.append(run(cells))
        if COMM.getRank() == 0:
            print(line(results[-1]), flush=True)
    if chosen.json and COMM.getRank() == 0:
        with open(chosen.json, "w") as file:
            json.dump(results, file, indent=1)
