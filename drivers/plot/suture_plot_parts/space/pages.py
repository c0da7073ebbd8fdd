"""All plots of a 3D run, with their captions."""
from ..deformation import is_given, seeming
from ..enlarged import enlargement
from ..friction import has_friction
from ..picture import Picture, note_on
from ..placed import in_place
from ..safety import has_safety, safety_caption
from ..stresses import taken_at
from .contact_page import contact_figures
from .contact_surface import contact_names, contact_surfaces
from .cut import chosen_plane
from .cut_page import cut_figure
from .outside import Scene, deformation_figure, mesh_figure, principal_figure, von_mises_figure
from .safety_page import safety_figure
from .scene_page import scene_figure
from .gaps import gaps_of_surface
from .seen_from import chosen_view
from .surface import Surface
from .view import view_from


def pages_in_space(run, factor, view, cut):
    """Yields each plot as soon as it is drawn. \\param view, cut  direction towards the viewer, plane as (axis, value); None: default"""
    placed = in_place(run)
    plane = chosen_plane(placed, cut)  # first, since it may be invalid
    surface = Surface(run.fields)
    used, limited = enlargement(run, factor, lambda: gaps_of_surface(surface.at(run.fields.points), surface.at(run.fields.point_data["Displacement"]),
                                                                     surface.triangles))
    scene = Scene(run, surface, used, view_from(view or chosen_view(run, surface)))
    figure, left_out = scene_figure(scene)
    yield Picture("scene", "mesh", "Orange: surfaces of loads. Green: surfaces of supports. Outlines: contact surfaces, dashed where "
                  "bodies hide them. The length of arrows has no meaning." + note_on(left_out), figure)
    figure, left_out = mesh_figure(scene)
    yield Picture("mesh", "mesh", "Subdomains in different colours, and the sides of the elements." + note_on(left_out), figure)
    seem = seeming(used, limited, is_given(run, factor))
    figure, drawn_in = deformation_figure(scene)
    touch = " An interference, drawn or given, is not enlarged." if drawn_in else ""
    yield Picture("deformation", "deformation", "Deformed bodies, coloured by the norm of the displacement; dashed: undeformed." + seem +
                  touch, figure)
    yield Picture("von_mises", "von_mises", f"Von Mises stress on the outside, {taken_at(run)}. The colour scale ends at the largest "
                  f"visible value; the ring marks the overall maximum, dashed if bodies hide it.{seem}", von_mises_figure(scene))
    yield Picture("von_mises_cut", "von_mises", f"Von Mises stress on the plane {plane.words(run.length_unit)} of the "
                  f"{'bodies where they are' if run.moving else 'undeformed bodies'}. The ring marks the largest value there.",
                  cut_figure(placed, surface, plane))
    yield Picture("principal_stress", "principal", f"The principal stress of largest magnitude on the outside, {taken_at(run)}; tension "
                  "red, compression blue. The rings mark the overall maxima of tension and compression, dashed if bodies hide them.",
                  principal_figure(scene))
    if has_safety(run):
        yield Picture("safety", "von_mises", safety_caption(run), safety_figure(scene))
    single = single_pairs(run)
    rubbing = " With friction: tangential traction, and its ratio to the limit of the law." if run.contact is not None and has_friction(run.contact) else ""
    for number, (part, figure) in enumerate(contact_figures(run)):
        yield Picture("contact" if number == 0 else f"contact_{number + 1}", "contact", "Contact pressure and gap on each contact surface, "
                      f"viewed along its mean normal; a surface around an axis is unrolled.{rubbing}{part}{single}", figure)


def single_pairs(run):
    """A sentence on contacts without a surface."""
    drawn = {surface.name for surface in contact_surfaces(run)}
    left_out = [name for name in contact_names(run) if name not in drawn]
    return f" Not plotted, since their pairs form no surface: {', '.join(left_out)}." if left_out else ""
