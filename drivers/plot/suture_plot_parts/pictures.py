"""All pictures of a run."""
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from .curves import contact_figure, convergence_figure, probe_figure
from .deformation import deformation_figure
from .mesh import mesh_figure
from .scene import scene_figure
from .stresses import crosses_figure, principal_caption, region_of_interest, von_mises_caption, von_mises_figure


@dataclass
class Picture:
    name: str  # of its file, without .png
    section: str  # of the report
    caption: str
    figure: Any = None
    path: Path = None


def pictures(run, factor=None, zoom=None):
    """Each picture as soon as it is drawn: whoever saves it closes it."""
    if run.fields is not None:
        yield Picture("scene", "mesh", "Orange: loads. Green: supports; open triangles hold one direction and slide along the other, filled ones "
                      "hold both, hollow arrows are given displacements. Thick lines: sides of contacts, each just inside its own body. Lengths of "
                      "arrows mean nothing.", scene_figure(run))
        yield Picture("mesh", "mesh", "Subdomains, each in a colour of its own, and named sides. Names that find no room are left out.",
                      mesh_figure(run))
        figure, used = deformation_figure(run, factor)
        seem = "" if used == 1 else (f" Displacements are enlarged {used:g} times, so that bodies may seem to overlap or to part: the gaps are "
                                     "those of the section on contact.")
        yield Picture("deformation", "deformation", f"Deformed bodies, coloured by the norm of the displacement; dashed: undeformed.{seem}", figure)
        yield Picture("von_mises", "von_mises", von_mises_caption(run), von_mises_figure(run))
        region = (*zoom, f"x {zoom[0]:g} to {zoom[1]:g}, y {zoom[2]:g} to {zoom[3]:g}") if zoom else region_of_interest(run)
        if region:
            yield Picture("von_mises_zoom", "von_mises", f"The same {'in' if zoom else ''} {region[4]}.".replace("  ", " "), von_mises_figure(run, region))
        yield Picture("principal_stress", "principal", principal_caption(run), crosses_figure(run))
        if region:
            yield Picture("principal_stress_zoom", "principal", f"The same {'in' if zoom else ''} {region[4]}.".replace("  ", " "),
                          crosses_figure(run, region))
        if run.contact is not None and len(run.contact.points):
            yield Picture("contact", "contact", "Contact pressure and gap along each contact line. Filled: closed pairs; hollow on grey: open ones.",
                          contact_figure(run))
    if run.history:
        yield Picture("convergence", "convergence", "Residual, conjugate gradient iterations (PCG) and pairs that changed between closed and open, "
                      "in each outer iteration.", convergence_figure(run))
    if run.fields is not None:
        for path in run.probes():
            figure = probe_figure(run, path)
            if figure:
                yield Picture(path.stem, "probes", f"Values along the probe '{path.stem[len('probe_'):]}'.", figure)


def missing(run):
    """Sentences on pictures that a run of this kind does not have."""
    notes = []
    if run.fields is None:
        notes.append("this run wrote no fields_*.vtkhdf: the pictures of mesh, deformation, stresses and contact are not drawn")
    elif run.contact is None or not len(run.contact.points):
        notes.append("no contact lines in this scene: contact.png is not drawn")
    if not run.history:
        notes.append("no outer iterations in this run: convergence.png is not drawn")
    return notes
