"""The solution of a run."""
import json

import numpy

from . import fields as _fields
from .plots import Plots


def _place(extreme, model_bodies):
    where = ", ".join("%.4g" % x for x in extreme.get("position", extreme.get("place", [])))
    return " in '%s'" % extreme["body"] + (" at (%s)" % where if where else "")


class Result:
    """The solution of a run. Arrays are read-only and expose the values of the library, which live as long as any of the arrays.

    `summary`: content of summary.json, on all ranks; `converged`, `exit_code`, `failure`; `energy`; `notes`;
    `subdomains`: meshes, displacements and stresses of this rank; `pairs`: all contact pairs, on rank 0; `contacts`: their names;
    `history`: the outer iterations; `probes`: values that Output/Probes requests. Methods are collective: all ranks call them."""

    def __init__(self, run, comm, output=None):
        self._run, self.comm = run, comm
        self.summary = json.loads(comm.bcast(run.summary_text or None, root=0))
        self.converged, self.exit_code, self.failure = run.is_done, run.exit_code, run.failure
        self.energy, self.notes, self.contacts, self.history = run.energy, run.notes, run.contacts, run.history
        self.subdomains, self.pairs = run.subdomains, run.pairs
        self._plots = Plots(self, output)
        self._probes = None

    def gather(self, root=0):
        """Displacements at nodes and stresses at centroids of the whole mesh on one rank, None on other ranks (root=None: on all). Collective."""
        return _fields.gather(self, root)

    def fields(self, root=0):
        """All fields of the whole mesh (Fields) on one rank, None on other ranks; root=None: on all ranks. Adds to gather() the recovered
        stresses at nodes and the contact state. Collective."""
        return _fields.fields(self, root)

    def nodal_stresses(self):
        """Recovered stresses at the nodes of this rank's subdomains: for each, nodes x 4 or 6, as in Fields. Computed at the first call.
        Collective."""
        return self._run.nodal_stresses()

    @property
    def probes(self):
        """Values that the scene's Output/Probes writes to files: {name: {column: array}}, on all ranks. Columns: position, arc_length,
        displacement, stress, von_mises, principal_1, principal_3, body, gap, pressure (NaN where there is no pair). Stresses are recovered ones
        with Output/Nodal Stresses, otherwise those at centroids. Collective."""
        if self._probes is None:
            self._probes = self.comm.bcast(self._run.probes(), root=0)
        return self._probes

    def probe(self, points, field=None, body=None):
        """Values at points of the undeformed bodies, on all ranks: an array for one of the columns of `probes`, or a dictionary of all of them.

        points: points x dimension, or a single point; the points of rank 0 count. body: name; by default a point on a contact belongs to the
        first body there. Stresses are recovered at nodes and interpolated. Raises InputError for points outside, ValueError for an unknown field.
        Collective."""
        from . import _suture

        def checked():
            given = numpy.asarray(points, dtype=float)
            if given.ndim not in (1, 2):
                raise ValueError("points: an array of %d dimensions; expected points x dimension" % given.ndim)
            return given, "" if body is None else str(body)

        given, name = self.comm.bcast(_suture.together(self.comm, checked), root=0)
        table = self.comm.bcast(self._run.probe(numpy.atleast_2d(given), name), root=0)
        if given.ndim == 1:
            table = {key: values[0] for key, values in table.items()}
        if field is None:
            return table
        if field not in table:
            raise ValueError("field: '%s' is unknown; known are %s" % (field, ", ".join(table)))
        return table[field]

    def write(self, folder):
        """Writes the files of a run into a folder; with load steps only the fields of the last step. Collective."""
        import os
        from . import _suture
        self._run.write(_suture.together(self.comm, lambda: os.fspath(folder)))

    def plot(self, kind="von_mises", file=None, show=False, factor=None, zoom=None, view=None, cut=None):
        """Draws one of the plots of suture_plot: "scene", "mesh", "deformation", "von_mises", "principal_stress", "contact", "convergence", ...
        (in 3D also "von_mises_cut"). Collective; needs matplotlib and h5py on rank 0.

        file: also saves the plot there; show: displays it, in a notebook or in a window; factor, zoom, view, cut: as in suture_plot.
        Returns a matplotlib figure on rank 0, None on other ranks; a notebook shows the figure if it is the last value of a cell. Raises
        ValueError for an unknown kind, with the kinds of this run."""
        return self._plots.plot(kind, file, show, factor, zoom, view, cut)

    def __repr__(self):
        return "\n".join(self._lines())

    def _lines(self):
        summary = self.summary
        units = ([unit.strip() for unit in summary.get("units", "").split(",")] + ["", "", ""])[:3]
        length, stress = (" " + unit if unit else "" for unit in (units[0], units[2]))
        yield "suture.Result: " + (summary.get("title") or "untitled")
        state = "converged" if summary["converged"] else "NOT CONVERGED"
        verdict = "" if not summary["converged"] else " and verified" if summary["verified"] else ", NOT VERIFIED"
        yield "  %s%s%s" % (state, verdict, ": " + self.failure if self.failure else "")
        yield "  %s elements, %s nodes, %s unknowns in %s on %s" % (
            *("{:,}".format(summary[key]) for key in ("elements", "nodes", "dofs")), _counted(summary["subdomains"], "subdomain"),
            _counted(summary["ranks"], "rank"))
        if summary.get("load_steps"):
            yield "  " + _counted(len(summary["load_steps"].get("steps", [])) or summary["load_steps"].get("count", 0), "load step")
        contact = summary.get("contact") or {}
        if contact.get("pairs"):
            yield "  contact: %d of %s closed, largest pressure %.4g%s, largest gap %.4g%s" % (
                contact["active"], _counted(contact["pairs"], "pair"), contact["max_pressure"], stress, contact["max_gap"], length)
        extremes = summary.get("extremes") or {}
        for key, words, unit in (("displacement", "largest displacement", length), ("von_mises", "largest von Mises stress", stress)):
            found = extremes.get(key)
            if found:
                yield "  %s %.4g%s%s" % (words, found["value"], unit, _place(found, None))
        for note in self.notes:
            if note.startswith("warning: "):
                yield "  " + note


def _counted(number, noun):
    return "{:,} {}{}".format(number, noun, "" if number == 1 else "s")
