"""Values of the interactive view at each load step, or at the end of a run without steps."""
import h5py
import numpy as np

from ..grid import Grid
from ..style import PlotError


class Field:
    """A field to choose in the view. `read`: values from the groups of points and cells of a file; `place`: point, cell or pair"""

    def __init__(self, name, label, unit, place, read, signed=False, reversed_colours=False):
        self.name, self.label, self.unit, self.place, self.read = name, label, unit, place, read
        self.signed, self.reversed_colours = signed, reversed_colours


def at(kind, name, column=None):
    """Reads a data set, or one of its columns."""
    return lambda points, cells: (points if kind == "point" else cells)[name][(slice(None), column) if column is not None else ()]


def fields_of_bodies(run):
    """The fields that the files have, stresses at nodes before those of elements."""
    points, cells = run.fields.point_data, run.fields.cell_data
    found = [Field("displacement", "displacement", run.length_unit, "point", lambda p, c: np.linalg.norm(p["Displacement"][()], axis=1))]
    stress = run.stress_unit
    place, names = ("point", ("NodalVonMises", "NodalPrincipalStress")) if "NodalVonMises" in points else ("cell", ("VonMises", "PrincipalStress"))
    data = points if place == "point" else cells
    if names[0] in data:
        found.append(Field("von_mises", "von Mises stress", stress, place, at(place, names[0])))
    if names[1] in data:
        last = data[names[1]].shape[1] - 1
        found += [Field("tension", "largest principal stress", stress, place, at(place, names[1], 0), signed=True),
                  Field("compression", "smallest principal stress", stress, place, at(place, names[1], last), signed=True)]
    for where, known in (("point", points), ("cell", cells)):
        name = next((name for name in known if name.endswith("SafetyFactor")), None)
        if name and not any(field.name == "safety" for field in found):
            found.append(Field("safety", "safety factor", "", where, at(where, name), reversed_colours=True))
    return found


def fields_of_contacts(run, grid):
    """The fields of the contact pairs of a grid."""
    found = [Field("pressure", "contact pressure", run.stress_unit, "pair", at("point", "ContactPressure")),
             Field("gap", "gap", run.length_unit, "pair", at("point", "Gap"))]
    if "TangentialTraction" in grid.point_data:
        found.append(Field("tangential", "tangential traction", run.stress_unit, "pair",
                           lambda p, c: np.linalg.norm(p["TangentialTraction"][()], axis=1)))
    return found


class Frames:
    """The files of a run, of bodies and of contacts, for each frame of the view. `chosen`: indices of load steps, from 0; None without load steps"""

    def __init__(self, run, chosen):
        self.run, self.chosen = run, chosen
        self.labels = [f"load step {k + 1} of {len(run.steps['time'])}, t = {run.steps['time'][k]:g}" for k in chosen] if chosen else ["result"]

    def contacts(self):
        """The grid of contacts of each frame; None for a frame without pairs."""
        if not self.chosen:
            return [self.run.contact]
        paths = [self.run.folder / f"contact_{k:04d}.vtkhdf" for k in self.chosen]
        return [Grid(path) if path.is_file() else None for path in paths]

    def read(self, readers):
        """For each frame, the values of each reader in the fields of the bodies."""
        found = []
        for path in [self.run.folder / f"fields_{k:04d}.vtkhdf" for k in self.chosen] if self.chosen else [self.run.fields.path]:
            try:
                with h5py.File(path, "r") as file:
                    root = file["VTKHDF"]
                    found.append([np.asarray(reader(root["PointData"], root["CellData"]), dtype=float) for reader in readers])
            except (OSError, KeyError, ValueError) as error:
                raise PlotError(f"{path} is not a field file of this run, or is damaged: {error}") from error
        return found


def chosen_steps(run, most):
    """At most `most` load steps at nearly equal distances, with the first and the last."""
    count = len(run.steps.get("time", []))
    if count == 0:
        return None
    if most < 2:
        return [count - 1]
    return sorted({int(round(k)) for k in np.linspace(0, count - 1, min(most, count))})


class SameMesh:
    """Finds the load steps whose fields are on the mesh of run.fields: between steps bodies may be removed or placed."""

    def __init__(self, run):
        self.run, self._known = run, {}

    def __call__(self, step):
        if step not in self._known:
            path = self.run.folder / f"fields_{step:04d}.vtkhdf"
            try:
                with h5py.File(path, "r") as file:
                    points = file["VTKHDF/Points"]
                    self._known[step] = points.shape == self.run.fields.points.shape and np.array_equal(points[:], self.run.fields.points)
            except (OSError, KeyError, ValueError) as error:
                raise PlotError(f"{path} is not a field file of this run, or is damaged: {error}") from error
        return self._known[step]
