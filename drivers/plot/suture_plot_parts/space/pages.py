"""All pictures of a run in space, with their captions."""
from ..deformation import enlargement
from ..friction import has_friction
from ..picture import Picture, told
from ..stresses import taken_at
from .contact_page import contact_figures
from .contact_surface import contact_names, contact_surfaces
from .cut import chosen_plane
from .cut_page import cut_figure
from .outside import Scene, deformation_figure, mesh_figure, principal_figure, von_mises_figure
from .scene_page import scene_figure
from .surface import Surface
from .view import DEFAULT, view_from


def pages_in_space(run, factor, view, cut):
    """Each picture as soon as it is drawn. \\param view, cut  direction toward the eye, plane as (axis, value); None: chosen here"""
    plane = chosen_plane(run, cut)  # first, since it may be wrong
    scene = Scene(run, Surface(run.fields), enlargement(run, factor), view_from(view or DEFAULT))
    figure, left_out = scene_figure(scene)
    yield Picture("scene", "mesh", "Orange: surfaces of loads. Green: surfaces of supports. Outlines: contact surfaces, dashed where "
                  "bodies hide them. Lengths of arrows mean nothing." + told(left_out), figure)
    figure, left_out = mesh_figure(scene)
    yield Picture("mesh", "mesh", "Subdomains, each in a colour of its own, and the elements' sides." + told(left_out), figure)
    seem = "" if scene.factor == 1 else (f" Displacements are enlarged {scene.factor:g} times, so that bodies may seem to overlap or to "
                                         "part: the gaps are those of the section on contact.")
    figure, drawn_in = deformation_figure(scene)
    touch = " An interference that is drawn or given is not enlarged with them." if drawn_in else ""
    yield Picture("deformation", "deformation", "Deformed bodies, coloured by the norm of the displacement; dashed: undeformed." + seem +
                  touch, figure)
    yield Picture("von_mises", "von_mises", f"Von Mises stress on the outside, {taken_at(run)}. The colours end at the largest value that "
                  f"is seen; the ring marks the largest of all, dashed where bodies hide it.{seem}", von_mises_figure(scene))
    yield Picture("von_mises_cut", "von_mises", f"Von Mises stress in the plane {plane.words(run.length_unit)} of the undeformed bodies. "
                  "The ring marks the largest value there.", cut_figure(scene, plane))
    yield Picture("principal_stress", "principal", f"The principal stress of the largest amount on the outside, {taken_at(run)}; tension "
                  "red, compression blue. The rings mark the largest tension and compression of all, dashed where bodies hide them.",
                  principal_figure(scene))
    single = single_pairs(run)
    rubbing = " Where it rubs: tangential traction, and its part of what the law allows." if run.contact is not None and has_friction(run.contact) else ""
    for number, (part, figure) in enumerate(contact_figures(run)):
        yield Picture("contact" if number == 0 else f"contact_{number + 1}", "contact", "Contact pressure and gap on each contact surface, "
                      f"seen along its mean normal; a surface round an axis is unrolled.{rubbing}{part}{single}", figure)


def single_pairs(run):
    """A sentence on contacts that have no surface."""
    drawn = {surface.name for surface in contact_surfaces(run)}
    left_out = [name for name in contact_names(run) if name not in drawn]
    return f" Not drawn, since their pairs make no surface: {', '.join(left_out)}." if left_out else ""
