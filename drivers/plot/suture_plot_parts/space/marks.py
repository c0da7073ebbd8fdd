"""Symbols of loads and supports on a page with 3D bodies."""
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection

from ..scene import thinned
from ..stresses import thin_out
from ..symbols import Symbols
from .surface import normals

ARROWS = 12  # at most per condition
SUPPORTS = 8
SEEN = 50  # samples of a surface that is seen
LENGTH = 0.07  # of an arrow, as a fraction of the plot's width
SHORT = 0.3  # projected length of a unit vector below which its arrow would be a point
HIDDEN = (0, (2.5, 1.8))


class Marks:
    """Draws conditions and contacts on a page, and records arrows and lines, so that labels avoid them.

    Symbols of surfaces that bodies hide are drawn through the bodies, with dashed lines.
    """

    def __init__(self, page, scene):
        self.page, self.scene, self.drawn = page, scene, []
        self.length = LENGTH * np.ptp(page.axes.get_xlim())

    def condition(self, condition, triangles, colour):
        """Symbols, and the border of the surface. \\return anchors for the label, none if nothing is drawn"""
        if not len(triangles):
            return np.zeros((0, 2)) if condition.groups else self._elsewhere(condition, colour)
        on_border = self.outline(self.scene.points, self.scene.surface.around(triangles), colour)
        places, points, outward, hidden = self._places(triangles)
        if condition.support and not moves(condition):
            self._supports(condition, places, points, outward, colour, hidden)
        else:
            self._arrows(condition, places, outward, colour, hidden)
        if hidden:
            return on_border
        wanted = places.mean(axis=0) + 0.25 * np.ptp(places, axis=0) * np.array([[0, 0], [1, 1], [-1, -1], [-1, 1], [1, -1]])
        return np.array([places[np.argmin(np.hypot(*(places - place).T))] for place in wanted])

    def _places(self, triangles):
        """(positions in the plot, in 3D, outward normals, whether bodies hide the surface) of many points on it."""
        surface, raster = self.scene.surface, self.page.seen.raster
        mine = np.zeros(len(surface.triangles), dtype=bool)
        mine[triangles] = True
        samples = np.flatnonzero(mine[raster.shown])
        hidden = len(samples) < SEEN
        if hidden:
            owner = triangles[::max(1, len(triangles) // 4000)]
            places = None
        else:
            samples = samples[::max(1, len(samples) // 4000)]
            places, owner = raster.places(samples), raster.shown[samples]
        points = self.scene.points[surface.triangles[owner]].mean(axis=1)
        return self.page.view.flat(points) if hidden else places, points, normals(self.scene.points, surface.triangles[owner]), hidden

    def outline(self, points, edges, colour):
        """Lines, dashed where bodies hide them. \\return some positions on them in the plot, the middle first"""
        if not len(edges):
            return np.zeros((0, 2))
        flat = self.page.view.flat(points)[edges]
        self.page.axes.add_collection(LineCollection(flat, colors=colour, linewidths=0.9, linestyles=(0, (3, 2)), alpha=0.7, zorder=5))
        self.drawn.append(self.page.lines(points, edges, colors=colour, linewidths=1.8, zorder=5, gid="named"))
        middles = flat.mean(axis=1)
        return thinned(middles[np.argsort(middles[:, 0], kind="stable")])

    def _chosen(self, places, most):
        """Numbers of some evenly spaced places, away from the border of the surface."""
        spacing = max(np.sqrt(np.prod(np.maximum(np.ptp(places, axis=0), 0.02 * np.ptp(places))) / most), 1e-300)
        chosen = thin_out(places, spacing)
        whole = np.abs(places[chosen] / spacing % 1.0 - 0.5).max(axis=1) < 0.2
        chosen = chosen[whole] if whole.any() else chosen
        return chosen[::max(1, -(-len(chosen) // (2 * most)))]

    def _arrows(self, condition, places, outward, colour, hidden):
        """Arrows along given forces and displacements; a pressure acts against the outward normal, a moment turns about its arrow."""
        direction = condition.direction
        if condition.type != "Pressure" and (direction is None or len(direction) < 3 or not direction.any()):
            return
        if condition.type == "Moment":
            self._moment(places.mean(axis=0)[None], direction, colour, hidden)
            return
        chosen = self._chosen(places, ARROWS)
        places, outward = places[chosen], outward[chosen]
        if condition.type == "Pressure":
            way = -outward * (np.sign(condition.value[0]) if condition.value else 1.0)
        else:
            way = np.tile(direction / np.linalg.norm(direction), (len(chosen), 1))
        step = self.length * self.page.view.flat(way)
        # Arrows that press end on the surface; arrows that pull start on it.
        tails = np.where((np.einsum("ij,ij->i", way, outward) <= 1e-9)[:, None], places - step, places)
        self._draw(tails, tails + step, colour, not condition.support, hidden)

    def _moment(self, centre, direction, colour, hidden):
        """An arrow with two heads along the axis of the moment."""
        step = 1.4 * self.length * self.page.view.flat(direction / np.linalg.norm(direction))
        for end in (1.0, 0.7):
            self._draw(centre - 0.5 * step, centre + (end - 0.5) * step, colour, True, hidden)

    def _supports(self, condition, places, points, outward, colour, hidden):
        """Triangles with their tips on the surface: filled if all directions are held, on rollers if one is; springs."""
        chosen = self._chosen(places, SUPPORTS)
        self._support_signs(condition, places[chosen], points[chosen], outward[chosen], colour, hidden)

    def _support_signs(self, condition, places, points, outward, colour, hidden):
        """\param places  positions in the plot \param points  in 3D"""
        axes = condition.axes_at(points)
        if axes is not None:
            outward = np.where(np.einsum("ij,ij->i", outward, axes) < -1e-9, -1.0, 1.0)[:, None] * axes
        way = self.page.view.flat(outward)
        size = np.hypot(*way.T)
        clear = size > SHORT
        signs = Symbols(self.page.axes, 0.6 * self.length)
        style = {"linestyles": HIDDEN} if hidden else {}
        if clear.any():
            symbol = signs.springs if condition.type == "Elastic Support" else \
                signs.hatches if condition.type == "Displacement" and condition.components == "All" else signs.rollers
            symbol(places[clear], way[clear] / size[clear, None], colour, **style)
            self.drawn.append(signs.everything())
        if (~clear).any():  # seen along the direction that is held
            self.page.axes.plot(*places[~clear].T, "^", ms=5, color=colour, mfc=colour if condition.components == "All" else "white", zorder=6, gid="sign")

    def _elsewhere(self, condition, colour):
        """Loads on bodies and at points."""
        run, view, direction = self.scene.run, self.page.view, condition.direction
        if condition.type == "Displacement" and condition.at_point and not moves(condition):
            place = np.array([condition.given["Point"]], dtype=float)
            below = place[0, 2] < 0.5 * (self.scene.points.min(axis=0) + self.scene.points.max(axis=0))[2]
            self._support_signs(condition, view.flat(place), place, np.array([[0.0, 0.0, -1.0 if below else 1.0]]), colour, False)
            return view.flat(place)
        if direction is None or len(direction) < 3 or not direction.any():
            return np.zeros((0, 2))
        unit = direction / np.linalg.norm(direction)
        if condition.at_point:
            point = view.flat(np.array([condition.given["Point"]], dtype=float))
            step = 1.4 * self.length * view.flat(unit)
            self._draw(point - step, point, colour, not condition.support, False)
            return point - 0.9 * step
        if condition.type == "Rotation":
            point = view.flat(np.array([condition.given.get("Point") or [0.0, 0.0, 0.0]], dtype=float))
            low, high = view.flat(self.scene.points).min(axis=0), view.flat(self.scene.points).max(axis=0)
            point = np.clip(point, low, high)
            self._moment(point, direction, colour, True)
            return point
        if condition.type not in ("Body Force", "Gravity"):
            return np.zeros((0, 2))
        body, centres = self.scene.surface.of_cells("Body").astype(int), []
        corners = self.scene.points[self.scene.surface.triangles].mean(axis=1)
        for number, name in enumerate(run.fields.names["Bodies"]):
            own = corners[body == number]
            if len(own) and condition.body in (None, "", name):
                centres.append(0.5 * (own.min(axis=0) + own.max(axis=0)))
        if not centres:
            return np.zeros((0, 2))
        centre, step = view.flat(np.array(centres)), 1.3 * self.length * view.flat(unit)
        self._draw(centre - 0.5 * step, centre + 0.5 * step, colour, True, True)  # through the bodies
        return centre[:5] - 0.4 * step

    def _draw(self, tails, tips, colour, filled, hidden):
        size = np.hypot(*(tips - tails).T)
        tails, tips, size = (rows[size > 0.5 * SHORT * self.length] for rows in (tails, tips, size))  # others would be points
        if not len(tails):
            return
        along, head = (tips - tails) / size[:, None], np.minimum(0.3 * self.length, 0.7 * size)[:, None]
        neck, across = tips - head * along, 0.36 * head * np.column_stack([-along[:, 1], along[:, 0]])
        self.page.axes.add_collection(LineCollection(np.stack([tails, neck], axis=1), colors=colour, linewidths=1.1, zorder=6, gid="sign",
                                                     linestyles=HIDDEN if hidden else "-"))
        heads = np.stack([tips, neck + across, neck - across], axis=1)
        self.page.axes.add_collection(PolyCollection(heads, facecolors=colour if filled else "white", edgecolors=colour, linewidths=0.9,
                                                     zorder=6, gid="sign"))
        self.drawn.append(np.stack([tails, tips], axis=1))


def moves(condition):
    """True if a support prescribes a displacement other than zero."""
    return condition.direction is not None and bool(condition.direction.any())
