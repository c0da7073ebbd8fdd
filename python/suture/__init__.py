"""Suture from Python: solves scenes of elastic bodies in contact on an MPI communicator of the caller.

    import suture
    result = suture.solve("tunnel.xml", set={"Outer Solver/Tolerance": 1e-10})
    print(result.summary["energy"], result.pairs.pressure.max())

All functions are collective over the communicator. Errors are raised as exceptions on all ranks, with the text that the programs print.
"""
import json
import os

os.environ.setdefault("HWLOC_HIDE_ERRORS", "2")  # MPI uses hwloc, which prints errors on machines without /sys

from . import _suture  # noqa: E402  (initialises MPI if necessary, therefore before mpi4py)
from mpi4py import MPI  # noqa: E402

from ._suture import EnvironmentError, Error, InputError, InternalError, NumericalError  # noqa: A004
from .fields import Fields, gather
from .scenes import assignments, to_xml

__version__ = _suture.version
__all__ = ["solve", "study", "material", "weighting", "load_plugins", "gather", "to_xml", "Result", "Coupling", "Fields", "NotConverged", "Error",
           "InputError", "NumericalError", "EnvironmentError", "InternalError", "OPEN", "SLIP", "STICK"]

OPEN, SLIP, STICK = 0, 1, 2  # Pairs.status; closed pairs without friction slip


class NotConverged(NumericalError):
    """The run ended without a valid solution; `result` contains what it found."""

    def __init__(self, result):
        super().__init__(result.failure)
        self.result = result
        self.code = result.exit_code


class Result:
    """The solution of a run. Arrays are read-only and expose the values of the library, which live as long as any of the arrays.

    `summary`: content of summary.json, on all ranks; `converged`, `exit_code`, `failure`; `energy`; `notes`;
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
    """Text, name and folder of a scene that is not a dictionary, the same on all ranks. An error on rank 0 is raised on all."""
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
    """Solves a scene: a file, its text, or a dictionary with the names of a scene file. Collective.

    comm: an mpi4py communicator, default: COMM_WORLD; set: parameters to change, {"Path/To/Parameter": value}; output: folder for the
    files of a run (default: no files); restart: checkpoint to start from; show: prints the table of the run.
    Raises NotConverged if there is no valid solution, unless check is False; InputError, EnvironmentError, ... for other errors."""
    comm = MPI.COMM_WORLD if comm is None else comm
    run = _run(scene, comm, set, show)
    run.solve(*_suture.together(comm, lambda: (None if output is None else os.fspath(output), os.fspath(restart))))
    result = Result(run, comm)
    if check and not result.converged:
        raise NotConverged(result)
    return result


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
        self.comm = MPI.COMM_WORLD if comm is None else comm
        self._run = _run(scene, self.comm, set, show)

    def surface(self, group):
        """Nodes of a side group. Call before the first solve, once per group. Collective, as all following functions."""
        return self._run.coupling(group)

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
        """Solves with the present loads. Raises NumericalError if the solution is not valid, unless check is False."""
        self._run.solve_again(verified)
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


def study(file, comm=None, set=None, only=(), output="", show=False):  # noqa: A002
    """Runs a study file as suture_study does, into its folder. Collective.

    Returns the rows of its table as dictionaries, on all ranks, and the exit code: 0, or 4 if a run failed or a band was missed."""
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
    """Loads libraries with user-defined strategies, like --plugin."""
    _suture.load_plugins([os.fspath(path) for path in paths])


def _register(register, name, parameters):
    def decorate(function):
        register(name, function, {key.replace("_", " ").title(): float(value) for key, value in parameters.items()})
        return function
    return decorate


def _named(function):
    """Passes parameters of a scene ("Young Modulus") as arguments of a function (young_modulus)."""
    import functools

    @functools.wraps(function)
    def called(*values, **own):
        return function(*values, **{key.lower().replace(" ", "_"): value for key, value in own.items()})
    return called


def weighting(name, **parameters):
    """Registers a function as a weighting, `Weighting` = name: positive weights of a subdomain's interface unknowns. For experiments.

        @suture.weighting("Tempered", exponent=0.5)
        def tempered(local, exponent):
            return local.stiffness_diagonal ** exponent

    local: size, stiffness_diagonal, young_modulus (None if undefined). Parameters are read from the scene ("Exponent") and have the
    defaults given here. If a name is registered again, the last function is used."""
    return lambda function: _register(_suture.register_weighting, name, parameters)(_named(function)) and function


def material(name, **parameters):
    """Registers a function as a material law, `Type` = name: its 6 x 6 stiffness in the order xx, yy, zz, xy, yz, xz. For experiments.

        @suture.material("Isotropic By Shear", shear_modulus=1.0, bulk_modulus=2.0)
        def law(shear_modulus, bulk_modulus): ...
    """
    return lambda function: _register(_suture.register_material, name, parameters)(_named(function)) and function
