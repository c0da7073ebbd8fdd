"""All plots of a 3D scene before it is solved."""
from ..picture import Picture, note_on
from .groups_page import groups_figures
from .outside import Scene
from .scene_page import scene_figure
from .seen_from import chosen_view
from .surface import Surface
from .view import view_from


def scene_pages(run, view):
    surface = Surface(run.fields)
    scene = Scene(run, surface, 1.0, view_from(view or chosen_view(run, surface)))
    figure, left_out = scene_figure(scene)
    yield Picture("scene", "mesh", "Loads, supports and contacts." + note_on(left_out), figure)
    for number, (words, figure) in enumerate(groups_figures(run, surface)):
        yield Picture("groups" if number == 0 else f"groups_{number + 1}", "mesh", f"Names of all surfaces.{words}", figure)
