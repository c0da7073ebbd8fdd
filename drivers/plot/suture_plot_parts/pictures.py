"""All plots of a run."""
from .accuracy import accuracy_caption, accuracy_figure, has_levels
from .contact import contact_figures
from .curves import convergence_figure, probe_figure
from .deformation import deformation_figure, is_given, seeming
from .friction import friction_caption
from .mesh import mesh_figure
from .picture import Picture, note_on
from .placed import in_place
from .region import region_of_interest
from .safety import has_safety, safety_caption, safety_figure
from .scene import scene_figure
from .space.pages import pages_in_space
from .steps import steps_figure
from .stresses import crosses_figure, principal_caption, von_mises_caption, von_mises_figure
from .style import PlotError


def pictures(run, factor=None, zoom=None, view=None, cut=None):
    """Yields each plot as soon as it is drawn; the caller saves and closes it.

    \\param zoom       region of a 2D run
    \\param view, cut  direction towards the viewer, and plane, of a 3D run
    """
    space = run.dimension == 3
    if space and zoom:
        raise PlotError("--zoom is for 2D runs; this run is 3D, use --view for the direction and --cut for the plane")
    if not space and (view or cut):
        raise PlotError("--view and --cut are for 3D runs; this run is 2D")
    if run.fields is not None:
        for picture in pages_in_space(run, factor, view, cut) if space else plane_pages(run, factor, zoom):
            if run.step is not None and picture.section != "mesh":
                picture.caption += (f" Shown at the end of {run.words_of_step}, without rings at the global extremes, which summary.json contains "
                                    "for the last step only.")
            yield picture
    if run.steps:
        figure, left_out = steps_figure(run)
        of_groups = (" rotation and moment of rigid groups that turn, travel and force of those that move along (the component with the largest value),"
                     if run.groups else "") + (" transmission errors," if run.transmissions else "")
        yield Picture("steps", "steps", f"Contact forces on side B,{of_groups} states of the pairs at the end of each load step, and accumulated work, over "
                      "time." + note_on(left_out), figure)
    if has_levels(run):
        yield Picture("accuracy", "accuracy", accuracy_caption(run), accuracy_figure(run))
    if run.history:
        yield Picture("convergence", "convergence", "Residual, conjugate gradient iterations (PCG) and pairs that changed between open and closed, "
                      "for each outer iteration." + (" Vertical lines: ends of load steps." if run.steps else ""), convergence_figure(run))
    if run.fields is not None and run.step is None:
        for path in run.probes():
            figure = probe_figure(run, path)
            if figure:
                yield Picture(path.stem, "probes", f"Values along the probe '{path.stem[len('probe_'):]}'.", figure)


def plane_pages(run, factor, zoom):
    figure, left_out = scene_figure(run)
    yield Picture("scene", "mesh", "Orange: loads. Green: supports; an open triangle holds the displacement in one direction, a filled one in "
                  "both; hollow arrows are prescribed displacements. Thick lines: contact sides, each drawn just inside its own body. The length "
                  "of arrows has no meaning." + note_on(left_out), figure)
    figure, left_out = mesh_figure(run)
    yield Picture("mesh", "mesh", "Subdomains in different colours, and named sides. Subdomain names without enough space are left out." +
                  note_on(left_out), figure)
    figure, used, limited, drawn_in = deformation_figure(run, factor)
    seem = seeming(used, limited, is_given(run, factor))
    if drawn_in:
        seem += (" An interference, drawn or given, is not enlarged: sides that it presses apart seem to separate, although they "
                 "touch.")
    yield Picture("deformation", "deformation", f"Deformed bodies, coloured by the norm of the displacement; dashed: undeformed.{seem}", figure)
    # Stresses of bodies that move far are drawn where the contacts are.
    placed = in_place(run)
    where = " The bodies are where they are at the end of the step." if run.moving else ""
    yield Picture("von_mises", "von_mises", von_mises_caption(run) + where, von_mises_figure(placed))
    region = (*zoom, f"x {zoom[0]:g} to {zoom[1]:g}, y {zoom[2]:g} to {zoom[3]:g}") if zoom else region_of_interest(placed)
    if region:
        yield Picture("von_mises_zoom", "von_mises", f"Detail {'for' if zoom else ''} {region[4]}.".replace("  ", " "), von_mises_figure(placed, region))
    yield Picture("principal_stress", "principal", principal_caption(run) + where, crosses_figure(placed))
    if region:
        yield Picture("principal_stress_zoom", "principal", f"Detail {'for' if zoom else ''} {region[4]}.".replace("  ", " "),
                      crosses_figure(placed, region))
    if has_safety(run):
        yield Picture("safety", "von_mises", safety_caption(run) + where, safety_figure(placed))
    if run.contact is not None and len(run.contact.points):
        for number, (part, figure) in enumerate(contact_figures(run)):
            yield Picture("contact" if number == 0 else f"contact_{number + 1}", "contact", "Contact pressure and gap along each contact line. "
                          f"Filled: closed pairs; hollow on grey: open pairs.{friction_caption(run)}{part}", figure)


def missing(run):
    """Sentences on plots that do not exist for a run of this kind."""
    notes = []
    if run.fields is None:
        notes.append("this run wrote no fields_*.vtkhdf: mesh, deformation, stresses and contact are not plotted")
    elif run.contact is None or not len(run.contact.points):
        notes.append(f"no contact {'pairs at this step' if run.parameter('Contact', default={}) else 'in this scene'}: no contact.png")
    if not run.history:
        notes.append("no outer iterations in this run: no convergence.png")
    return notes
