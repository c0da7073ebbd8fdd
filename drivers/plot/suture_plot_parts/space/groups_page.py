"""groups.png, groups_2.png, ... of a 3D scene: each body from views that together show all its side groups, with their names."""
import math

import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.colors import to_rgb

from ..families import families
from ..labels import LabelPlacer
from ..samples import show
from ..style import LINES, halo, new_figure, shortened, wrapped
from .image import brightness, picture
from .page import bare, raster_of
from .raster import Raster, visible_parts
from .ruler import cross, inches_of, scale
from .surface import normals
from .view import DEFAULT, view_from

MOST_BODIES = 12  # more bodies are drawn together
ACROSS, DOWN = 2, 3  # panels on a page
PANEL = (4.9, 3.4)  # inches, with the space of the labels
SPACE = (0.6, 0.22)  # inches around the body, for the labels
SMALL = 160  # samples along the longer side of a trial
ENOUGH = 60  # samples of a group that is seen
CLEAR = 0.35  # fraction of the largest number of samples of a group in any view
BARE = np.array([0.91, 0.91, 0.89])
VIEWS = [DEFAULT, *((DEFAULT[0] * a, DEFAULT[1] * b, DEFAULT[2] * c) for a in (1, -1) for b in (1, -1) for c in (1, -1) if (a, b, c) != (1, 1, 1)),
         (0.3, -0.4, 2.0), (0.3, -0.4, -2.0), (2.0, 0.3, 0.2), (-2.0, -0.3, 0.2), (0.2, -2.0, 0.3), (-0.2, 2.0, 0.3)]


class Part:
    """A body, or all bodies, with its triangles and those of each of its groups."""

    def __init__(self, name, points, triangles, groups):
        self.name, self.groups = name, groups
        used, inverse = np.unique(triangles, return_inverse=True)
        self.points, self.triangles = points[used], inverse.reshape(-1, 3)

    def samples(self, view, size):
        """Raster of the part alone. \\param size  samples along the longer side"""
        flat = view.flat(self.points)
        low, reach = flat.min(axis=0), np.maximum(np.ptp(flat, axis=0), 1e-300)
        shape = np.maximum(np.ceil(size * reach[::-1] / reach.max()), 1).astype(int)
        raster = Raster(low, low + reach, shape)
        raster.draw(flat, view.nearness(self.points), self.triangles)
        return raster

    def views(self):
        """[(view, names of groups to write in it)]: as few as show all groups, and the names that no view shows."""
        counts = {}
        for direction in VIEWS:
            shown = np.bincount(self.samples(view_from(direction), SMALL).shown, minlength=len(self.triangles))
            counts[direction] = {name: int(shown[own].sum()) for name, own in self.groups.items()}
        best = {name: max(count[name] for count in counts.values()) for name in self.groups}
        missing, chosen = {name for name in self.groups if best[name] > 0}, []

        def is_seen(direction, name):
            return counts[direction][name] >= max(min(ENOUGH, best[name]), CLEAR * best[name])

        while missing or not chosen:
            def gain(direction):
                good = [name for name in missing if is_seen(direction, name)]
                return len(good), direction in VIEWS[:8], sum(counts[direction][name] / best[name] for name in good)
            direction = max(VIEWS, key=gain)
            named = sorted(name for name in missing if is_seen(direction, name))
            chosen.append((direction, named))
            missing -= set(named)
        return chosen, sorted(name for name in self.groups if best[name] == 0)


def parts_of(run, surface):
    points, body, bodies = surface.at(run.fields.points), surface.of_cells("Body").astype(int), run.fields.names["Bodies"]
    groups = {name: surface.of_groups([name]) for name, sides in sorted(run.fields.side_groups.items()) if len(sides)}
    if len(bodies) > MOST_BODIES:
        labels = families(groups)
        return [Part(f"{len(bodies)} bodies", points, surface.triangles,
                     {label: np.concatenate([groups[name] for name in members]) for label, members in labels.items()})]
    place = np.zeros(len(body), dtype=int)
    found = []
    for number, name in enumerate(bodies):
        own = np.flatnonzero(body == number)
        place[own] = np.arange(len(own))
        found.append(Part(name, points, surface.triangles[own],
                          {group: place[t[body[t] == number]] for group, t in groups.items() if (body[t] == number).any()}))
    return found


def groups_figures(run, surface):
    """Yields the pages: (words on groups that no view shows, figure)."""
    panels, hidden = [], []
    colours = {name: LINES[i % len(LINES)] for i, name in enumerate(sorted({name for part in parts_of(run, surface) for name in part.groups}))}
    for part in parts_of(run, surface):
        chosen, never = part.views()
        panels += [(part, direction, named) for direction, named in chosen]
        hidden += never
    pages = math.ceil(len(panels) / (ACROSS * DOWN))
    for page in range(pages):
        some = panels[page * ACROSS * DOWN:(page + 1) * ACROSS * DOWN]
        words = f" Not visible from outside: {', '.join(hidden)}." if hidden else ""
        yield words, page_figure(run, some, colours, f", part {page + 1} of {pages}" if pages > 1 else "")


def page_figure(run, panels, colours, part):
    across = min(ACROSS, len(panels))
    down = math.ceil(len(panels) / across)
    size = np.array(PANEL) * (1.5 if len(panels) == 1 else 1.0)
    width, height = size * [across, down] + [0.2, 0.5]
    figure = new_figure(width, height)
    figure.text(0.1 / width, 1 - 0.12 / height, wrapped(f"{run.title}: names of the surfaces{part}{run.state}", int(13 * width)), fontsize=10, va="top")
    for number, panel in enumerate(panels):
        row, column = divmod(number, across)
        corner = np.array([0.1 + column * size[0], height - 0.5 - (row + 1) * size[1]])
        axes = figure.add_axes([*(corner / [width, height]), *(size / [width, height])])
        draw(run, axes, size, panel, colours)
    return figure


def draw(run, axes, size, panel, colours):
    part, direction, named = panel
    view = view_from(direction)
    flat = view.flat(part.points)
    low, high = flat.min(axis=0), flat.max(axis=0)
    room = size - 2 * np.array(SPACE) - [0, 0.35]
    per_length = (room / np.maximum(high - low, 1e-300)).min()  # inches
    middle = 0.5 * (low + high) - [0, 0.1 / per_length]
    axes.set(xlim=middle[0] + np.array([-0.5, 0.5]) * size[0] / per_length, ylim=middle[1] + np.array([-0.5, 0.5]) * size[1] / per_length, aspect="equal")
    bare(axes)
    axes.set_title(shortened(part.name, 40), loc="left", y=0.955, fontsize=9, style="italic")
    raster = raster_of(axes)
    raster.draw(flat, view.nearness(part.points), part.triangles)
    normal = normals(part.points, part.triangles)
    colour, members = np.tile(BARE, (len(part.triangles), 1)), sorted(part.groups, key=lambda name: -len(part.groups[name]))
    owner = np.full(len(part.triangles) + 1, -1)
    for number, name in enumerate(members):  # a group inside another one lies on it
        colour[part.groups[name]] = 0.5 * np.array(to_rgb(colours[name])) + 0.5
        owner[part.groups[name]] = number
    light = raster.interpolate(brightness(view, part.points, part.triangles, normal))
    show(axes, picture(raster, colour[raster.shown], light))
    lines = visible_parts(raster, *edges_of(part, view, normal, owner), 3.0 / raster.scale[0])
    axes.add_collection(LineCollection(lines, colors="#333333", linewidths=0.6, zorder=4))
    cross(axes, inches_of(axes.figure, axes), view, np.array([0.3, 0.28]))
    scale(axes, inches_of(axes.figure, axes), run.length_unit, 0.2, 0.32)
    placer = LabelPlacer(axes.figure, axes)
    placer.prefer_outside(raster.places(slice(None, None, max(1, len(raster.samples) // 3000))))
    style = {"fontsize": 8, "weight": "bold", "path_effects": halo(), "zorder": 6}
    for name in named:
        placer.place(shortened(name, 40), anchors_of(raster, part, name), must=True, centred=True, color=colours[name], **style)


def anchors_of(raster, part, name):
    """Places on the visible part of a group, the middle one first."""
    mine = np.zeros(len(part.triangles), dtype=bool)
    mine[part.groups[name]] = True
    places = raster.places(np.flatnonzero(mine[raster.shown]))
    places = places[::max(1, len(places) // 2000)]
    middle, half = places.mean(axis=0), 0.25 * np.ptp(places, axis=0)
    wanted = middle + half * np.array([[0, 0], [1, 1], [-1, -1], [-1, 1], [1, -1]])
    return np.array([places[np.argmin(np.hypot(*(places - place).T))] for place in wanted])


def edges_of(part, view, normal, owner):
    """(starts, ends) of edges at which the body bends, ends or meets another group: plot coordinates and nearness."""
    ends = np.sort(np.stack([part.triangles, np.roll(part.triangles, -1, axis=1)], axis=-1).reshape(-1, 2), axis=1)
    triangle = np.repeat(np.arange(len(part.triangles)), 3)
    order = np.lexsort((ends[:, 1], ends[:, 0]))
    ends, triangle = ends[order], triangle[order]
    first = np.flatnonzero((ends[1:] == ends[:-1]).all(axis=1))
    left, right = triangle[first], triangle[first + 1]
    facing = normal @ view.toward > 0
    bends = (np.einsum("ij,ij->i", normal[left], normal[right]) < math.cos(math.radians(30.0))) | (owner[left] != owner[right]) | \
        (facing[left] != facing[right])
    chosen = ends[first[bends]]
    place = np.column_stack([view.flat(part.points), view.nearness(part.points)])
    return place[chosen[:, 0]], place[chosen[:, 1]]
