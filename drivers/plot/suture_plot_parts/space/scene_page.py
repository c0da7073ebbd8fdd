"""scene.png: bodies with the locations of loads, supports and contacts."""
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import to_rgb
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from ..families import families
from ..scene import grouped, in_common, legend, thinned
from ..step_factors import stated
from ..style import LINES, LOAD, PALETTE, SUPPORT, halo, pale, shortened
from ..words import conditions, contacts
from .contact_surface import contact_surfaces
from .marks import Marks
from .outside import seen_places
from .page import BELOW


def scene_figure(scene):
    """\\return figure, names without enough space"""
    run, bodies = scene.run, scene.run.fields.names["Bodies"]
    given, touching = conditions(run), contacts(run)
    total = len(given) + len(touching) + len(bodies)
    given.sort(key=lambda c: not c.support)  # loads are drawn over supports
    places = {c.name: of_condition(run, scene.surface, c) for c in given}
    page = scene.page("loads, supports and contacts", moved=False)
    body = scene.surface.of_cells("Body").astype(int)
    page.colour(colours_of(body, [(places[c.name], c) for c in given]))
    creases = page.lines(scene.points, scene.edges[False], colors="#444444")
    marks = Marks(page, scene)
    named, handles, texts = [], [], []
    for label, members in grouped(given, total):
        colour = SUPPORT if members[0].support else LOAD
        anchors = [found for found in (marks.condition(c, places[c.name], colour) for c in members) if len(found)]
        if anchors:
            named.append((label, anchors[len(anchors) // 2], colour))
        handles.append(Patch(facecolor=mixed(colour)) if anchors else Patch(facecolor="none", edgecolor="none"))
        texts.append(in_common([stated(run, c) for c in members]) + ("" if anchors else " (not drawn)"))
    borders = contact_borders(scene, touching)
    for number, (label, members) in enumerate(grouped(touching, total)):
        colour = LINES[number % len(LINES)]
        anchors = [marks.outline(*borders[c.name], colour) for c in members if c.name in borders]
        if anchors:
            named.append((label, anchors[len(anchors) // 2], colour))
        handles.append(Line2D([], [], color=colour, lw=1.8, ls="-" if anchors else "none"))
        sentences = [f"{c.name}: {', '.join(c.side_a)} on {c.partner()}" for c in members]
        texts.append(in_common(sentences) + ("" if anchors else " (not drawn)"))
    legend(page.figure, page.axes, handles, texts, 72 * BELOW)
    placer = page.placer(creases)
    if page.axes.get_legend():
        page.axes.get_legend().set_in_layout(True)  # after the layout is fixed, so that the saved image includes the legend
    for segments in marks.drawn:
        placer.keep_visible_lines(segments)
    for label, anchors, colour in named:
        placer.place(shortened(label, 26), anchors, color=colour, fontsize=9, weight="bold", path_effects=halo(), zorder=8)
    shown = dict(seen_places(page, body, len(bodies)))
    for label, members in families(bodies, total).items():
        own = [middle_of(shown[bodies.index(name)]) for name in members if bodies.index(name) in shown]
        if own:
            style = {"fontsize": 9, "style": "italic", "color": "#333333", "path_effects": halo(), "zorder": 7}
            placer.place(shortened(label), own[:5], centred=True, **style)
    return page.figure, placer.left_out


def mixed(colour):
    return 0.55 * np.array(to_rgb(colour)) + 0.45


def colours_of(body, places):
    """Pale colours of the bodies' triangles; triangles of conditions in orange and green."""
    colours = np.array([pale(PALETTE[i % 7]) for i in range(body.max(initial=0) + 1)])[body]
    for triangles, condition in places:
        colours[triangles] = mixed(SUPPORT if condition.support else LOAD)
    return colours


def of_condition(run, surface, condition):
    """Triangles on which the condition acts."""
    return surface.of_groups(condition.groups)


def contact_borders(scene, touching):
    """{contact: (points, edges)}: the borders of the contact surfaces; before the scene is solved, and of bodies that move far, those of sides A."""
    if scene.run.contact is not None and not scene.run.moving:
        return {found.name: border_of(found) for found in contact_surfaces(scene.run)}
    found = {}
    for contact in touching:
        triangles = scene.surface.of_groups(contact.side_a)
        if len(triangles):
            found[contact.name] = scene.points, scene.surface.around(triangles)
    return found


def border_of(contact):
    """(points, edges) of the border of a contact surface."""
    triangle, side = contact.border()
    return contact.points, np.column_stack([contact.triangles[triangle, side], contact.triangles[triangle, (side + 1) % 3]])


def middle_of(places):
    return places[np.argmin(np.hypot(*(places - places.mean(axis=0)).T))]
