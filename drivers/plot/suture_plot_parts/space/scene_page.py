"""scene.png: bodies with the locations of loads, supports and contacts."""
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import to_rgb
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from ..families import families
from ..scene import grouped, in_common, legend, thinned
from ..stresses import thin_out
from ..style import LINES, LOAD, PALETTE, SUPPORT, halo, pale, shortened
from ..words import conditions, contacts
from .contact_surface import contact_surfaces
from .outside import seen_places
from .page import BELOW
from .surface import normals

ARROWS = 12  # at most per group


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
        anchors = [marks.condition(c, places[c.name], colour) for c in members if len(places[c.name])]
        if anchors:
            named.append((label, anchors[len(anchors) // 2], colour))
        handles.append(Patch(facecolor=mixed(colour)) if anchors else Patch(facecolor="none", edgecolor="none"))
        texts.append(in_common([c.sentence(short=True) for c in members]) + ("" if anchors else " (not drawn)"))
    drawn = {found.name: found for found in contact_surfaces(run)}
    for number, (label, members) in enumerate(grouped(touching, total)):
        colour = LINES[number % len(LINES)]
        anchors = [marks.outline(*border_of(drawn[c.name]), colour) for c in members if c.name in drawn]
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
    sides = [run.fields.side_groups[group] for group in condition.groups if len(run.fields.side_groups.get(group, []))]
    return surface.of_group(np.concatenate(sides)) if sides else np.zeros(0, dtype=int)


def border_of(contact):
    """(points, edges) of the border of a contact surface."""
    triangle, side = contact.border()
    return contact.points, np.column_stack([contact.triangles[triangle, side], contact.triangles[triangle, (side + 1) % 3]])


def middle_of(places):
    return places[np.argmin(np.hypot(*(places - places.mean(axis=0)).T))]


class Marks:
    """Draws conditions and contacts on a page, and records arrows and lines, so that labels avoid them."""

    def __init__(self, page, scene):
        self.page, self.scene, self.drawn = page, scene, []

    def condition(self, condition, triangles, colour):
        """Arrows, and the border of its surface. \\return anchors for its label: on the visible part of the surface, else on its border"""
        surface, mine = self.scene.surface, np.zeros(len(self.scene.surface.triangles) + 1, dtype=bool)
        mine[triangles] = True  # the last entry means no triangle
        on_border = self.outline(self.scene.points, surface.edges[mine[surface.beside[:, 0]] != mine[surface.beside[:, 1]]], colour)
        raster = self.page.seen.raster
        samples = np.flatnonzero(mine[raster.shown])
        if len(samples) < 50:
            return on_border
        places = raster.places(samples[::max(1, len(samples) // 2000)])
        middle, half = places.mean(axis=0), 0.25 * np.ptp(places, axis=0)
        self._arrows(condition, samples[::max(1, len(samples) // 20000)], colour)
        wanted = middle + half * np.array([[0, 0], [1, 1], [-1, -1], [-1, 1], [1, -1]])
        return np.array([places[np.argmin(np.hypot(*(places - place).T))] for place in wanted])

    def outline(self, points, edges, colour):
        """Lines, dashed where bodies hide them. \\return some positions on them in the plot, the middle first"""
        flat = self.page.view.flat(points)[edges]
        self.page.axes.add_collection(LineCollection(flat, colors=colour, linewidths=0.9, linestyles=(0, (3, 2)), alpha=0.7, zorder=5))
        self.drawn.append(self.page.lines(points, edges, colors=colour, linewidths=1.8, zorder=5, gid="named"))
        middles = flat.mean(axis=1)
        return thinned(middles[np.argsort(middles[:, 0], kind="stable")])

    def _arrows(self, condition, samples, colour):
        """Arrows along given forces and displacements; a pressure acts against the outward normal."""
        direction, raster = condition.direction, self.page.seen.raster
        if condition.type != "Pressure" and (direction is None or len(direction) < 3 or not direction.any()):
            return
        places = raster.places(samples)
        spacing = max(np.sqrt(np.prod(np.ptp(places, axis=0)) / ARROWS), 1e-300)
        chosen = thin_out(places, spacing)
        whole = np.abs(places[chosen] / spacing % 1.0 - 0.5).max(axis=1) < 0.2  # away from the surface's border
        chosen = chosen[whole] if whole.any() else chosen
        corner = self.scene.points[self.scene.surface.triangles[raster.shown[samples[chosen]]]]
        outward = normals(corner.reshape(-1, 3), np.arange(3 * len(corner)).reshape(-1, 3))
        if condition.type == "Pressure":
            way = -outward * (np.sign(condition.value[0]) if condition.value else 1.0)
        else:
            way = np.tile(direction / np.linalg.norm(direction), (len(chosen), 1))
        length = 0.07 * np.ptp(self.page.axes.get_xlim())
        step = length * self.page.view.flat(way)
        # Arrows that press end on the surface; arrows that pull start on it.
        tails = np.where((np.einsum("ij,ij->i", way, outward) <= 1e-9)[:, None], places[chosen] - step, places[chosen])
        self._draw(tails, tails + step, 0.3 * length, colour, filled=not condition.support)

    def _draw(self, tails, tips, head, colour, filled):
        size = np.hypot(*(tips - tails).T)
        tails, tips, size = (rows[size > 0.5 * head] for rows in (tails, tips, size))  # arrows along the viewing direction would be points
        if not len(tails):
            return
        along, head = (tips - tails) / size[:, None], np.minimum(head, 0.7 * size)[:, None]
        neck, across = tips - head * along, 0.36 * head * np.column_stack([-along[:, 1], along[:, 0]])
        self.page.axes.add_collection(LineCollection(np.stack([tails, neck], axis=1), colors=colour, linewidths=1.1, zorder=6, gid="sign"))
        heads = np.stack([tips, neck + across, neck - across], axis=1)
        self.page.axes.add_collection(PolyCollection(heads, facecolors=colour if filled else "white", edgecolors=colour, linewidths=0.9,
                                                     zorder=6, gid="sign"))
        self.drawn.append(np.stack([tails, tips], axis=1))
