"""scene.png: bodies, loads, supports and contacts as in an engineering drawing."""
import re

import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.legend_handler import HandlerBase
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.path import Path
from matplotlib.transforms import offset_copy

from .families import families, pattern
from .labels import LabelPlacer, along
from .mesh import inward
from .plane_image import image_of
from .step_factors import stated
from .style import LINES, LOAD, PALETTE, SUPPORT, canvas, halo, pale, shortened, wrapped
from .symbols import Symbols
from .words import conditions, contacts


ARROW = Path([(-1, 0), (0.4, 0), (0.4, 0.35), (1, 0), (0.4, -0.35), (0.4, 0), (-1, 0)])
NUMBER = re.compile(r"(\d+)")
MOST_ROWS = 24


class Drawing:
    """Symbols of the conditions of one scene. Conditions on the same group are drawn in successive rows."""

    def __init__(self, run, axes):
        self.run, self.grid = run, run.fields
        self.extent = np.ptp(self.grid.points[:, :2], axis=0)
        self.signs = Symbols(axes, 0.05 * self.extent.max())
        self.rows = {}

    def row(self, groups, height):
        """Distance from the sides at which the next symbol on these groups begins."""
        start = max((self.rows.get(group, 0.0) for group in groups), default=0.0)
        for group in groups:
            self.rows[group] = start + height
        return start * self.signs.size

    def places(self, condition):
        """Evenly spaced points along the condition's groups, with outward normals."""
        found = []
        for group in condition.groups:
            sides = self.grid.side_groups.get(group)
            if sides is None or len(sides) == 0:
                continue
            length = np.hypot(*(sides[:, 3:5] - sides[:, 0:2]).T).sum()
            count = int(np.clip(round(length / (1.6 * self.signs.size)), 1, 24))
            found.append(along(sides, (np.arange(count) + 0.5) / count))
        if not found:
            return np.zeros((0, 2)), np.zeros((0, 2))
        return np.concatenate([f[0] for f in found]), np.concatenate([f[1] for f in found])

    def on_sides(self, condition):
        """\\return anchors for the label of the condition"""
        points, outward = self.places(condition)
        if len(points) == 0:
            return []
        s = self.signs.size
        direction = condition.direction
        if condition.type == "Pressure":
            pushes = condition.value[0] >= 0 if condition.value else condition.resultant is None or self._pushes(condition, outward)
            foot = points + self.row(condition.groups, 1.2) * outward
            tail, tip = foot + s * outward, foot
            self.signs.arrows(tail if pushes else tip, tip if pushes else tail, LOAD)
            return foot + 0.9 * s * outward
        if condition.type == "Elastic Support":
            foot = points + self.row(condition.groups, 1.0) * outward
            self.signs.springs(foot, outward, SUPPORT)
            return foot + 0.8 * s * outward
        if condition.type == "Bilateral" or (condition.type == "Displacement" and (direction is None or not direction.any())):
            foot = points + self.row(condition.groups, 0.9) * outward
            self._supports(condition, foot, outward)
            return foot + 0.6 * s * outward
        if condition.type == "Moment":
            centre = points.mean(axis=0)
            self.signs.turn(centre, not condition.value or condition.value[0] > 0, LOAD)
            return [centre + s * np.array([0.7, 0.7])]
        if condition.type == "Rigid Group" and condition.support and condition.motions:
            foot = points + self.row(condition.groups, 0.9) * outward
            self.signs.hatches(foot, outward, SUPPORT)
            return foot + 0.6 * s * outward
        if direction is None or not direction.any():
            return points
        # Arrows that press end on the side; arrows that pull start on it.
        unit = direction / np.hypot(*direction)
        presses = outward @ unit <= 1e-9
        foot = points + self.row(condition.groups, 1.2) * outward
        tails = np.where(presses[:, None], foot - s * unit, foot)
        colour = SUPPORT if condition.support else LOAD
        self.signs.arrows(tails, tails + s * unit, colour, filled=not condition.support)
        return tails + np.where(presses, 0.1, 0.9)[:, None] * s * unit

    def _pushes(self, condition, outward):
        return float(np.sum(outward, axis=0) @ np.array(condition.resultant[:2])) <= 0.0

    def _supports(self, condition, foot, outward):
        if condition.type == "Bilateral":
            self.signs.rollers(foot, outward, SUPPORT)
        elif condition.components in ("All", "xy"):
            self.signs.hatches(foot, outward, SUPPORT)
        else:
            axes = condition.axes_at(np.asarray(foot))
            along = np.einsum("ij,ij->i", outward, axes)
            side = np.where(along < -1e-9, -1.0, 1.0)[:, None] * axes
            # Holds the tangential direction: drawn next to the side, not on the body.
            clear = np.where(np.abs(along) < 0.5, 0.35 * self.signs.size, 0.0)[:, None]
            self.signs.rollers(foot + clear * outward, side, SUPPORT)

    def obstacle(self, contact, colour):
        """The rigid partner of a contact, if it is a circle or a line given by numbers."""
        of, step = contact.given.get(contact.obstacle, {}), 0.5 * self.signs.size
        if contact.obstacle == "Circle":
            radius = float(of["Radius"])
            angles = np.linspace(0, 2 * np.pi, int(np.clip(2 * np.pi * radius / step, 24, 2000)) + 1)
            outward = np.column_stack([np.cos(angles), np.sin(angles)])
            self.signs.surface(np.array(of["Centre"][:2], dtype=float) + radius * outward, outward if of.get("Hollow") else -outward, colour)
        elif contact.obstacle == "Line":
            normal = np.array(of["Normal"][:2], dtype=float)
            normal /= np.hypot(*normal)
            middle = 0.5 * (self.grid.points.min(axis=0) + self.grid.points.max(axis=0))[:2]
            foot = middle - normal * (normal @ (middle - np.array(of["Point"][:2], dtype=float)))
            # As long as the side in front of it needs.
            along_it = np.array([-normal[1], normal[0]])
            sides = [self.grid.side_groups[group] for group in contact.side_a if len(self.grid.side_groups.get(group, []))]
            places = (np.concatenate(sides)[:, 0:2] - foot) @ along_it if sides else np.zeros(1)
            beyond = 0.25 * np.ptp(places) + 0.8 * self.signs.size
            reach = np.arange(places.min() - beyond, places.max() + beyond, step)
            self.signs.surface(foot + reach[:, None] * along_it, np.broadcast_to(-normal, (len(reach), 2)), colour)

    def _point_support(self, condition, point):
        """The support of a single node, drawn away from the middle of the scene."""
        s, direction = self.signs.size, condition.direction
        if direction is not None and direction.any():
            step = s * direction / np.hypot(*direction)
            self.signs.arrows(point, point + step, SUPPORT, filled=False)
            return point + 0.5 * step
        middle = 0.5 * (self.grid.points.min(axis=0) + self.grid.points.max(axis=0))[:2]
        axes = condition.axes_at(point)
        outward = np.array([[0.0, 1.0]]) if axes is None else axes
        outward = outward * (1.0 if outward[0] @ (point[0] - middle) > 0 else -1.0)
        self._supports(condition, point, outward)
        return point + 0.6 * s * outward

    def elsewhere(self, condition):
        """Loads on bodies and at points. \\return anchors for the label; none without a symbol"""
        s, direction = self.signs.size, condition.direction
        if condition.type == "Displacement" and condition.at_point:
            return self._point_support(condition, np.array([condition.given["Point"][:2]], dtype=float))
        if condition.type == "Point Force" and direction is not None and direction.any():
            point, unit = np.array(condition.given["Point"][:2], dtype=float), direction / np.hypot(*direction)
            self.signs.arrows([point - 1.4 * s * unit], [point], LOAD)
            return [point - 1.3 * s * unit]
        if condition.type == "Rotation":
            centre = np.array((condition.given.get("Point") or [0.0, 0.0])[:2], dtype=float)
            low, high = self.grid.points.min(axis=0)[:2], self.grid.points.max(axis=0)[:2]
            centre = np.clip(centre, low, high)
            self.signs.turn(centre, not condition.value or condition.value[0] > 0, LOAD)
            return [centre + 0.8 * s * np.array([0.7, 0.7])]
        if condition.type in ("Body Force", "Gravity") and direction is not None and direction.any():
            unit, anchors = direction / np.hypot(*direction), []
            for number, body in enumerate(self.grid.names["Bodies"]):
                own = self.grid.centroids[self.grid.cell_data["Body"] == number]
                if len(own) and condition.body in (None, body):
                    centre = own[np.argmin(np.hypot(*(own - own.mean(axis=0)).T))]
                    self.signs.arrows([centre - 0.8 * s * unit], [centre + 0.8 * s * unit], LOAD)
                    anchors.append(centre - 0.7 * s * unit)
            return anchors
        return []


class SignHandler(HandlerBase):
    """A small arrow or triangle in the legend."""

    def create_artists(self, legend, handle, x, y, width, height, size, transform):
        marker = Line2D([x + 0.5 * width - x], [0.5 * height], marker=handle.marker, ms=7, color=handle.colour, mfc=handle.fill, ls="none")
        marker.set_transform(transform)
        return [marker]


class Sign:
    def __init__(self, condition):
        self.colour = SUPPORT if condition.support else LOAD
        moved = condition.support and condition.direction is not None and condition.direction.any()
        self.marker = ARROW if moved or not condition.support else "^"
        held = condition.support and condition.type == "Displacement" and condition.components == "All"
        self.fill = self.colour if held or not condition.support else "white"

    def get_label(self):
        return ""


def scene_figure(run):
    """\\return figure, names without enough space"""
    grid = run.fields
    given, touching, bodies = conditions(run), contacts(run), grid.names["Bodies"]
    total = len(given) + len(touching) + len(bodies)
    longest = max((len(shortened(name, 26)) for name in families([c.name for c in given], total)), default=0)
    figure, axes = canvas(grid.points, f"{run.title}: loads, supports and contacts", run.length_unit, room=(0.12 + 0.012 * longest, 0.17),
                          names=run.axes)
    size = np.ptp(grid.points[:, :2], axis=0).max()
    image_of(axes, grid).colour(body_colours(grid))
    outline = grid.lines(grid.boundary, grid.points)
    axes.add_collection(LineCollection(outline, colors="#444444", linewidths=0.8, zorder=2))
    drawing = Drawing(run, axes)
    named, handles, texts = [], [], []  # named: label, anchors, colour
    given.sort(key=lambda c: not c.support)  # supports are drawn at the side, loads behind them
    for label, members in grouped(given, total):
        anchors = [thinned(found) for found in (drawing.on_sides(c) if c.groups else drawing.elsewhere(c) for c in members) if len(found)]
        if anchors:
            named.append((label, anchors[len(anchors) // 2], SUPPORT if members[0].support else LOAD))
        handles.append(Sign(members[0]) if anchors else Patch(facecolor="none", edgecolor="none"))
        texts.append(in_common([stated(run, c) for c in members]) + ("" if anchors else " (not drawn)"))
    lines = []
    for number, (label, members) in enumerate(grouped(touching, total)):
        colour = LINES[number % len(LINES)]
        anchors = []
        for contact in members:
            drawing.obstacle(contact, colour)
            for side, strength in ((contact.side_a, 1.0), (contact.side_b, 0.55)):
                for sides in (grid.side_groups.get(group, []) for group in side):
                    if len(sides) == 0:
                        continue
                    segments = inward(sides, 0.004 * size)
                    axes.add_collection(LineCollection(segments, colors=[colour], linewidths=2.4, alpha=strength, zorder=5, gid="named"))
                    lines.append(segments)
                    anchors.append(along(sides, [0.5, 0.3, 0.7, 0.15, 0.85])[0])
        if anchors:
            some = anchors if len(members) == 1 else thinned([found[0] for found in anchors])[:, None]
            named.append((label, np.concatenate(list(some))[:5], colour))
        handles.append(Line2D([], [], color=colour, lw=2.4))
        texts.append(in_common([f"{c.name}: A {', '.join(c.side_a)} (strong), " + (f"B {c.partner()} (pale)" if c.obstacle == "None" else c.partner())
                                for c in members]))
    legend(figure, axes, handles, texts)
    placer = LabelPlacer(figure, axes)
    if axes.get_legend():
        axes.get_legend().set_in_layout(True)  # after the layout is fixed, so that the saved image includes the legend
    for segments in (drawing.signs.everything(), *lines):
        placer.keep_visible_lines(segments)
    placer.prefer_outside(grid.centroids[::max(1, grid.count // 3000)])
    placer.keep_off(outline)
    for name, anchors, colour in named:
        placer.place(shortened(name, 26), anchors, color=colour, fontsize=9, weight="bold", path_effects=halo(), zorder=8)
    for label, members in families(bodies, total).items():
        parts = [grid.centroids[grid.cell_data["Body"] == bodies.index(body)] for body in members]
        parts = [own for own in parts if len(own)]
        if len(parts) == 1:
            own = parts[0]
            anchors = [own[np.argmin(np.hypot(*(own - own.mean(axis=0) - shift).T))]
                       for shift in np.array([[0, 0], [0.2, 0.2], [-0.2, -0.2], [-0.2, 0.2], [0.2, -0.2]]) * np.ptp(own, axis=0)]
        else:
            anchors = thinned([own[np.argmin(np.hypot(*(own - own.mean(axis=0)).T))] for own in parts]) if parts else []
        if len(anchors):
            placer.place(shortened(label), anchors, centred=True, fontsize=9, style="italic", color="#333333", path_effects=halo(), zorder=7)
    return figure, placer.left_out


def body_colours(grid):
    """A pale colour for each cell, by its body."""
    return np.array([pale(PALETTE[i % 7]) for i in range(len(grid.names["Bodies"]))])[grid.cell_data["Body"].astype(int)]


def grouped(things, total):
    """[(label, things)]: families of conditions or contacts of one kind."""
    named = {thing.name: thing for thing in things}
    return [(label, [named[name] for name in names]) for label, names in families(named, total).items()]


def in_common(sentences):
    """One sentence for all members of a family: * replaces numbers that differ, and long lists are abbreviated."""
    if len(sentences) == 1:
        return sentences[0]
    first = sentences[0]
    if len({pattern(sentence) for sentence in sentences}) > 1:
        return f"{pattern(first.split(':')[0])}: {len(sentences)} of them, such as {first}"
    words = [list(row) for row in zip(*(NUMBER.split(sentence) for sentence in sentences))]
    return "".join(row[0] if len(set(row)) == 1 else "*" for row in words)


def thinned(anchors):
    """At most five anchors, the middle one first."""
    anchors = np.asarray(anchors)
    order = [len(anchors) // 2, len(anchors) // 4, 3 * len(anchors) // 4, 0, len(anchors) - 1]
    return anchors[list(dict.fromkeys(order))]


def legend(figure, axes, handles, texts, distance=30.0):
    """A legend below the axes in one column, since names are long; it does not shrink the axes."""
    if not handles:
        return
    if len(texts) > MOST_ROWS:
        left = len(texts) - MOST_ROWS + 1
        handles = [*handles[:MOST_ROWS - 1], Patch(facecolor="none", edgecolor="none")]
        texts = [*texts[:MOST_ROWS - 1], f"and {left} more, listed in report.html"]
    width = int(max(figure.get_figwidth(), 5.0) * 13.5)
    drawn = axes.legend(handles, [wrapped(text, width) for text in texts], handler_map={Sign: SignHandler()}, loc="upper left",
                        bbox_to_anchor=(0.0, 0.0), bbox_transform=offset_copy(axes.transAxes, fig=figure, y=-distance, units="points"), fontsize=8,
                        borderaxespad=0.0, handlelength=1.8, labelspacing=0.35)
    drawn.set_in_layout(False)
