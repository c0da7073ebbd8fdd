"""All pictures of a run."""
from .contact import contact_figures
from .curves import convergence_figure, probe_figure
from .deformation import deformation_figure
from .friction import friction_caption
from .mesh import mesh_figure
from .picture import Picture, told
from .region import region_of_interest
from .scene import scene_figure
from .space.pages import pages_in_space
from .steps import steps_figure
from .stresses import crosses_figure, principal_caption, von_mises_caption, von_mises_figure
from .style import PlotError


def pictures(run, factor=None, zoom=None, view=None, cut=None):
    """Each picture as soon as it is drawn: whoever saves it closes it.

    \\param zoom       region of a plane run
    \\param view, cut  direction toward the eye, and plane, of a run in space
    """
    space = run.dimension == 3
    if space and zoom:
        raise PlotError("--zoom is for plane runs; this run is in space, where --view chooses the direction and --cut the plane")
    if not space and (view or cut):
        raise PlotError("--view and --cut are for runs in space; this one is plane")
    if run.fields is not None:
        for picture in pages_in_space(run, factor, view, cut) if space else plane_pages(run, factor, zoom):
            if run.step is not None and picture.section != "mesh":
                picture.caption += (f" At the end of {run.words_of_step}; rings at the extremes of the whole are left out, since summary.json has those "
                                    "of the last step.")
            yield picture
    if run.steps:
        figure, left_out = steps_figure(run)
        yield Picture("steps", "steps", "Contact forces on side B, states of the pairs at the end of each load step, and work from the beginning on, over "
                      "time." + told(left_out), figure)
    if run.history:
        yield Picture("convergence", "convergence", "Residual, conjugate gradient iterations (PCG) and pairs that changed between closed and open, "
                      "in each outer iteration." + (" Lines between them: ends of load steps." if run.steps else ""), convergence_figure(run))
    if run.fields is not None and run.step is None:
        for path in run.probes():
            figure = probe_figure(run, path)
            if figure:
                yield Picture(path.stem, "probes", f"Values along the probe '{path.stem[len('probe_'):]}'.", figure)


def plane_pages(run, factor, zoom):
    figure, left_out = scene_figure(run)
    yield Picture("scene", "mesh", "Orange: loads. Green: supports; open triangles hold one direction and slide along the other, filled ones "
                  "hold both, hollow arrows are given displacements. Thick lines: sides of contacts, each just inside its own body. Lengths of "
                  "arrows mean nothing." + told(left_out), figure)
    figure, left_out = mesh_figure(run)
    yield Picture("mesh", "mesh", "Subdomains, each in a colour of its own, and named sides. Names of subdomains that find no room are left out." +
                  told(left_out), figure)
    figure, used, drawn_in = deformation_figure(run, factor)
    seem = "" if used == 1 else (f" Displacements are enlarged {used:g} times, so that bodies may seem to overlap or to part: the gaps are "
                                 "those of the section on contact.")
    if drawn_in:
        seem += (" An interference that is drawn or given is not enlarged with them: sides that are pressed apart by it seem to part, although they "
                 "touch.")
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
        for number, (part, figure) in enumerate(contact_figures(run)):
            yield Picture("contact" if number == 0 else f"contact_{number + 1}", "contact", "Contact pressure and gap along each contact line. "
                          f"Filled: closed pairs; hollow on grey: open ones.{friction_caption(run)}{part}", figure)


def missing(run):
    """Sentences on pictures that a run of this kind does not have."""
    notes = []
    if run.fields is None:
        notes.append("this run wrote no fields_*.vtkhdf: the pictures of mesh, deformation, stresses and contact are not drawn")
    elif run.contact is None or not len(run.contact.points):
        notes.append("no contact in this scene: contact.png is not drawn")
    if not run.history:
        notes.append("no outer iterations in this run: convergence.png is not drawn")
    return notes
