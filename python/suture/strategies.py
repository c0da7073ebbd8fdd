"""Strategies written in Python, for experiments."""
import functools
import os

from . import _suture


def load_plugins(*paths):
    """Loads libraries with user-defined strategies, like --plugin."""
    _suture.load_plugins([os.fspath(path) for path in paths])


def _named(function):
    """Passes parameters of a scene ("Young Modulus") as arguments of a function (young_modulus)."""
    @functools.wraps(function)
    def called(*values, **own):
        return function(*values, **{key.lower().replace(" ", "_"): value for key, value in own.items()})
    return called


def _decorator(register, name, parameters):
    """The decorator that registers a function and returns it unchanged."""
    defaults = {key.replace("_", " ").title(): float(value) for key, value in parameters.items()}

    def decorate(function):
        register(name, _named(function), defaults)
        return function
    return decorate


def weighting(name, **parameters):
    """Registers a function as a weighting, `Weighting` = name: positive weights of a subdomain's interface unknowns. For experiments.

        @suture.weighting("Tempered", exponent=0.5)
        def tempered(local, exponent):
            return local.stiffness_diagonal ** exponent

    local: size, stiffness_diagonal, young_modulus (None if undefined), kernel, rigid_modes, schur(), inverse(). Parameters are read from the scene
    ("Exponent") and have the defaults given here. If a name is registered again, the last function is used. An exception is raised on all ranks."""
    return _decorator(_suture.register_weighting, name, parameters)


def coarse_space(name, **parameters):
    """Registers a function as a coarse space of balancing preconditioners, `Coarse Space` = name: traces of a subdomain, size x k, linearly
    dependent ones allowed. For experiments.

        @suture.coarse_space("All Rigid Modes")
        def modes(local):
            return local.rigid_modes

    local and parameters: as for weighting()."""
    return _decorator(_suture.register_coarse_space, name, parameters)


def preconditioner(name, **parameters):
    """Registers a function as a preconditioner, `Preconditioner/Type` = name: the sum over the subdomains of R_i^T A_i R_i. The function is called
    once per subdomain at each set-up, and returns A_i: a function of the residual on the subdomain's unknowns. For experiments.

        @suture.preconditioner("Diagonal Scaling In Python")
        def diagonal_scaling(local):
            return lambda residual: local.weights * residual / local.assembled_diagonal

    local: as for weighting(), with weights (shares of the subdomain in each unknown, by the parameter `Weighting` of the preconditioner's list) and
    assembled_diagonal. The parameter `Coarse Space` adds a coarse problem, as in Neumann-Neumann; default None. A_i must be symmetric, and the sum
    positive definite: otherwise conjugate gradients stop with an error. Functions must not communicate; an exception is raised on all ranks."""
    return _decorator(_suture.register_preconditioner, name, parameters)


def material(name, **parameters):
    """Registers a function as a material law, `Type` = name: its 6 x 6 stiffness in the order xx, yy, zz, xy, yz, xz. For experiments.

        @suture.material("Isotropic By Shear", shear_modulus=1.0, bulk_modulus=2.0)
        def law(shear_modulus, bulk_modulus): ...
    """
    return _decorator(_suture.register_material, name, parameters)
