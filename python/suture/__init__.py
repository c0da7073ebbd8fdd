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
from .coupling import Coupling
from .fields import Fields, gather
from .meshes import Mesh, mesh_from_arrays, mesh_from_gmsh, mesh_from_meshio
from .results import Result
from .scenes import assignments, mesh_of, to_xml
from .strategies import coarse_space, load_plugins, material, preconditioner, weighting

__version__ = _suture.version
__all__ = ["solve", "study", "material", "weighting", "preconditioner", "coarse_space", "load_plugins", "gather", "to_xml", "Result", "Coupling",
           "Fields", "Mesh", "mesh_from_arrays", "mesh_from_meshio", "mesh_from_gmsh", "NotConverged", "Error", "InputError", "NumericalError",
           "EnvironmentError", "InternalError", "OPEN", "SLIP", "STICK"]

OPEN, SLIP, STICK = 0, 1, 2  # Pairs.status; closed pairs without friction slip


class NotConverged(NumericalError):
    """The run ended without a valid solution; `result` contains what it found."""

    def __init__(self, result):
        super().__init__(result.failure)
        self.result = result
        self.code = result.exit_code


def _world(comm):
    return MPI.COMM_WORLD if comm is None else comm


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
    named = (given, "the scene", "") if isinstance(scene, dict) else _scene(given, comm)
    return _suture.Run(comm, *named, changed, show, mesh_of(scene) if isinstance(scene, dict) else None)


def solve(scene, comm=None, set=None, output=None, restart="", show=False, check=True):  # noqa: A002
    """Solves a scene: a file, its text, or a dictionary with the names of a scene file. Collective.

    comm: an mpi4py communicator, default: COMM_WORLD; set: parameters to change, {"Path/To/Parameter": value}; output: folder for the
    files of a run (default: no files); restart: checkpoint to start from; show: prints the table of the run.
    Raises NotConverged if there is no valid solution, unless check is False; InputError, EnvironmentError, ... for other errors."""
    comm = _world(comm)
    run = _run(scene, comm, set, show)
    folder, start = _suture.together(comm, lambda: (None if output is None else os.fspath(output), os.fspath(restart)))
    run.solve(folder, start)
    result = Result(run, comm, folder)
    if check and not result.converged:
        raise NotConverged(result)
    return result


def study(file, comm=None, set=None, only=(), output="", show=False):  # noqa: A002
    """Runs a study file as suture_study does, into its folder. Collective.

    Returns the rows of its table as dictionaries, on all ranks, and the exit code: 0, or 4 if a run failed or a band was missed."""
    comm = _world(comm)
    given = _suture.together(comm, lambda: (os.fspath(file), os.fspath(output), assignments(set), list(only)))
    code, folder = _suture.run_study(comm, *given, not show)

    def read():
        if comm.rank != 0:
            return None
        import csv
        with open(os.path.join(folder, "table.csv"), newline="", encoding="utf-8") as table:
            return list(csv.DictReader(table))

    return comm.bcast(_suture.together(comm, read), root=0), code
