"""Scenes that another program loads or moves."""
from . import _suture
from ._suture import NumericalError


class Coupling:
    """A scene coupled to another program that loads or moves side groups and solves repeatedly: factors are kept, and each solve starts
    from the previous solution.

        coupling = suture.Coupling("block.xml")
        surface = coupling.surface("block_top")     # nodes of this rank: nodes, coordinates, areas, normals
        for step in range(10):
            coupling.set_forces(surface, forces)    # nodes x dimension
            coupling.solve()
            u = coupling.displacements(surface)
    """

    def __init__(self, scene, comm=None, set=None, show=False):  # noqa: A002
        from . import _run, _world
        self.comm = _world(comm)
        self._run = _run(scene, self.comm, set, show)
        self._groups, self._solves, self._is_judged = [], 0, False

    def surface(self, group):
        """Nodes of a side group. Call before the first solve, once per group. Collective, as all following functions."""
        surface = self._run.coupling(group)
        self._groups.append(group)
        return surface

    def set_forces(self, surface, forces):
        """Sets the forces on the nodes, in addition to the loads of the scene: nodes x dimension [force]."""
        self._run.set_forces(surface, forces)

    def set_tractions(self, surface, tractions):
        """Sets the forces on the nodes from tractions at the nodes [stress]."""
        self._run.set_tractions(surface, tractions)

    def set_displacements(self, surface, displacements):
        """Sets the displacements of the nodes, in the components that a condition of the scene prescribes [length]."""
        self._run.set_displacements(surface, displacements)

    def solve(self, verified=True, check=True):
        """Solves with the present loads. Raises NumericalError if the solution is not valid, unless check is False.

        verified: False omits the verdict, for the iterations between two programs."""
        self._run.solve_again(verified)
        self._solves, self._is_judged = self._solves + 1, verified
        if check and verified and not self._run.is_done:
            error = NumericalError(self._run.failure)
            error.code = self._run.exit_code
            raise error

    def advance(self):
        """Accepts the last solution as the end of a step: with friction, slip continues from there."""
        self._run.advance()

    def displacements(self, surface):
        """Displacements of the nodes in the last solution: nodes x dimension [length]."""
        return self._run.displacements(surface)

    @property
    def energy(self):
        return self._run.energy

    @property
    def subdomains(self):
        return self._run.subdomains

    @property
    def pairs(self):
        return self._run.pairs

    def __repr__(self):
        groups = ", ".join("'%s'" % group for group in self._groups) or "no surface yet"
        if self._solves == 0:
            return "<suture.Coupling: %s; not solved yet>" % groups
        state = (self._run.failure or "the last solution is valid") if self._is_judged else "no verdict on the last solution"
        return "<suture.Coupling: %s; %d solve%s, %s; energy %.6g>" % (groups, self._solves, "" if self._solves == 1 else "s", state, self.energy)
