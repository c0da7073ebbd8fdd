"""Suture from Python: scenes of elastic bodies in contact, solved on the communicator of the caller.

    import suture
    result = suture.solve("tunnel.xml", set={"Outer Solver/Tolerance": 1e-10})
    print(result.summary["energy"], result.pairs.pressure.max())

All functions are collective over the communicator. What is wrong is an exception, on all ranks, with the text that the programs print.
"""
import json
import os

os.environ.setdefault("HWLOC_HIDE_ERRORS", "2")  # MPI asks hwloc, which prints where a machine has no /sys

from . import _suture  # noqa: E402  (begins MPI, if nobody has: before mpi4py)
from mpi4py import MPI  # noqa: E402

from ._suture import EnvironmentError, Error, InputError, InternalError, NumericalError  # noqa: A004
from .fields import Fields, gather
from .scenes import assignments, to_xml

__version__ = _suture.version
__all__ = ["solve", "study", "material", "weighting", "load_plugins", "gather", "to_xml", "Result", "Coupling", "Fields", "NotConverged", "Error",
           "InputError", "NumericalError", "EnvironmentError", "InternalError", "OPEN", "SLIP", "STICK"]

OPEN, SLIP, STICK = 0, 1, 2  # Pairs.status; closed pairs without friction slip


class NotConverged(NumericalError):
    """The run ended without an answer that holds; `result` has what it found."""

    def __init__(self, result):
        super().__init__(result.failure)
        self.result = result
        self.code = result.exit_code


class Result:
    """The answer of a run. Arrays show the values of the library itself: they are there as long as one of them is, and are not written to.

    `summary`: what summary.json holds, on all ranks; `converged`, `exit_code`, `failure`; `energy`; `notes`;
    `subdomains`: meshes, displacements and stresses of this rank; `pairs`: all contact pairs, on rank 0; `contacts`: their names;
    `history`: the outer iterations; `gather(root)`: fields of the whole mesh."""

    def __init__(self, run, comm):
        self._run, self.comm = run, comm
        self.summary = json.loads(comm.bcast(run.summary_text or None, root=0))
        self.converged, self.exit_code, self.failure = run.is_done, run.exit_code, run.failure
        self.energy, self.notes, self.contacts, self.history = run.energy, run.notes, run.contacts, run.history
        self.subdomains, self.pairs = run.subdomains, run.pairs

    def gather(self, root=0):
        return gather(self, root)


def _scene(scene, comm):
    """Text, name and folder of a scene that is no dictionary, the same on all ranks. An error of one rank is one of all."""
    if scene.lstrip().startswith("<"):
        return scene, "the scene", ""
    path, text, problem = scene, None, None
    if comm.rank == 0:
        try:
            with open(path, encoding="utf-8", errors="surrogateescape") as file:
                text = file.read()
        except OSError as error:
            problem = "%s: cannot be read: %s" % (path, error.strerror)
    text, problem = comm.bcast((text, problem), root=0)
    if problem:
        error = InputError(problem)
        error.code, error.problems = 3, [(path, problem.split(": ", 1)[1])]
        raise error
    return text, path, os.path.dirname(path)


def _run(scene, comm, changes, show):
    given, changed = _suture.together(comm, lambda: (to_xml(scene) if isinstance(scene, dict) else os.fspath(scene), assignments(changes)))
    return _suture.Run(comm, *((given, "the scene", "") if isinstance(scene, dict) else _scene(given, comm)), changed, show)


def solve(scene, comm=None, set=None, output=None, restart="", show=False, check=True):  # noqa: A002
    """Solves a scene: a file, the text of one, or a dictionary with its names. Collective.

    comm: an mpi4py communicator, by default the world; set: parameters to change, {"Path/To/Parameter": value}; output: folder for the
    files of a run (none are written without one); restart: a checkpoint to begin with; show: prints the table of the run.
    Raises NotConverged where the answer does not hold, unless check is False; InputError, EnvironmentError, ... as they are met."""
    comm = MPI.COMM_WORLD if comm is None else comm
    run = _run(scene, comm, set, show)
    run.solve(*_suture.together(comm, lambda: (None if output is None else os.fspath(output), os.fspath(restart))))
    result = Result(run, comm)
    if check and not result.converged:
        raise NotConverged(result)
    return result


class Coupling:
    """A scene that another program loads or moves at side groups, and solves again and again: every factor is kept, and the last answer is
    the start of the next.

        coupling = suture.Coupling("block.xml")
        surface = coupling.surface("block_top")     # nodes of this rank: nodes, coordinates, areas, normals
        for step in range(10):
            coupling.set_forces(surface, forces)    # nodes x dimension
            coupling.solve()
            u = coupling.displacements(surface)
    """

    def __init__(self, scene, comm=None, set=None, show=False):  # noqa: A002
        self.comm = MPI.COMM_WORLD if comm is None else comm
        self._run = _run(scene, self.comm, set, show)

    def surface(self, group):
        """Nodes of a side group. Before the first solve; for as many groups as there are. Collective, as all that follow."""
        return self._run.coupling(group)

    def set_forces(self, surface, forces):
        """Forces on the nodes from now on, beside the loads of the scene: nodes x dimension [force]."""
        self._run.set_forces(surface, forces)

    def set_tractions(self, surface, tractions):
        """The same from tractions at the nodes [stress]."""
        self._run.set_tractions(surface, tractions)

    def set_displacements(self, surface, displacements):
        """Displacements of the nodes from now on, along what a condition of the scene prescribes there [length]."""
        self._run.set_displacements(surface, displacements)

    def solve(self, verified=True, check=True):
        """Solves with the loads as they are now. Raises NumericalError where the answer does not hold, unless check is False."""
        self._run.solve_again(verified)
        if check and verified and not self._run.is_done:
            error = NumericalError(self._run.failure)
            error.code = self._run.exit_code
            raise error

    def advance(self):
        """Takes the last answer as the end of a step: with friction, pairs slip on from there."""
        self._run.advance()

    def displacements(self, surface):
        """Displacements of the nodes at the last answer: nodes x dimension [length]."""
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


def study(file, comm=None, set=None, only=(), output="", show=False):  # noqa: A002
    """Runs a study file as suture_study does, into its folder. Collective.

    Returns the rows of its table, as dictionaries, on all ranks, and the exit code: 0, or 4 where a run failed or a band is missed."""
    comm = MPI.COMM_WORLD if comm is None else comm
    given = _suture.together(comm, lambda: (os.fspath(file), os.fspath(output), assignments(set), list(only)))
    code, folder = _suture.run_study(comm, *given, not show)

    def read():
        if comm.rank != 0:
            return None
        import csv
        with open(os.path.join(folder, "table.csv"), newline="", encoding="utf-8") as table:
            return list(csv.DictReader(table))

    return comm.bcast(_suture.together(comm, read), root=0), code


def load_plugins(*paths):
    """Loads libraries with strategies of one's own, as --plugin does."""
    _suture.load_plugins([os.fspath(path) for path in paths])


def _register(register, name, parameters):
    def decorate(function):
        register(name, function, {key.replace("_", " ").title(): float(value) for key, value in parameters.items()})
        return function
    return decorate


def _named(function):
    """Parameters of a scene ("Young Modulus") as arguments of a function (young_modulus)."""
    import functools

    @functools.wraps(function)
    def called(*values, **own):
        return function(*values, **{key.lower().replace(" ", "_"): value for key, value in own.items()})
    return called


def weighting(name, **parameters):
    """Makes a function a weighting, `Weighting` = name: weights of a subdomain's unknowns on the interface, positive. For experiments.

        @suture.weighting("Tempered", exponent=0.5)
        def tempered(local, exponent):
            return local.stiffness_diagonal ** exponent

    local: size, stiffness_diagonal, young_modulus (None where there is none). Parameters, with their defaults, are read from the scene
    ("Exponent"). A name may be given again: the last function counts."""
    return lambda function: _register(_suture.register_weighting, name, parameters)(_named(function)) and function


def material(name, **parameters):
    """Makes a function the law of a material, `Type` = name: its stiffness, 6 x 6, in the order xx, yy, zz, xy, yz, xz. For experiments.

        @suture.material("Isotropic By Shear", shear_modulus=1.0, bulk_modulus=2.0)
        def law(shear_modulus, bulk_modulus): ...
    """
    return lambda function: _register(_suture.register_material, name, parameters)(_named(function)) and function
