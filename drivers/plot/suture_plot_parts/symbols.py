"""Symbols of engineering drawings: arrows, triangles, hatches, springs. All lengths are in data coordinates."""
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection


class Symbols:
    """Draws symbols on axes and records their positions, so that labels avoid them."""

    def __init__(self, axes, size):
        self.axes, self.size = axes, size
        self.segments = []

    def lines(self, segments, colour, width=1.0, linestyles="-"):
        segments = np.asarray(segments, dtype=float).reshape(-1, 2, 2)
        self.axes.add_collection(LineCollection(segments, colors=[colour], linewidths=width, capstyle="round", zorder=6, gid="sign",
                                                linestyles=linestyles))
        self.segments.append(segments)

    def polygons(self, corners, colour, filled, linestyles="-"):
        corners = np.asarray(corners, dtype=float)
        self.axes.add_collection(PolyCollection(corners, facecolors=colour if filled else "white", edgecolors=colour, linewidths=0.9, zorder=6,
                                                gid="sign", linestyles=linestyles))
        self.segments.append(np.stack([corners, np.roll(corners, -1, axis=1)], axis=2).reshape(-1, 2, 2))

    def arrows(self, tails, tips, colour, filled=True):
        tails, tips = np.asarray(tails, dtype=float), np.asarray(tips, dtype=float)
        way = tips - tails
        along = way / np.maximum(np.hypot(*way.T), 1e-300)[:, None]
        across = np.column_stack([-along[:, 1], along[:, 0]])
        neck = tips - 0.38 * self.size * along
        self.lines(np.stack([tails, neck], axis=1), colour, 1.1)
        self.polygons(np.stack([tips, neck + 0.15 * self.size * across, neck - 0.15 * self.size * across], axis=1), colour, filled)

    def rollers(self, points, outward, colour, **style):
        """A triangle with its tip on the side, and the plane on which it rolls."""
        across = np.column_stack([-outward[:, 1], outward[:, 0]])
        s = self.size
        base = points + 0.5 * s * outward
        self.polygons(np.stack([points, base + 0.27 * s * across, base - 0.27 * s * across], axis=1), colour, False, **style)
        rail = points + 0.64 * s * outward
        self.lines(np.stack([rail + 0.32 * s * across, rail - 0.32 * s * across], axis=1), colour, **style)

    def hatches(self, points, outward, colour, **style):
        """A triangle on hatched ground: held in all directions."""
        across = np.column_stack([-outward[:, 1], outward[:, 0]])
        s = self.size
        base = points + 0.5 * s * outward
        self.polygons(np.stack([points, base + 0.27 * s * across, base - 0.27 * s * across], axis=1), colour, True, **style)
        self.lines(np.stack([base + 0.36 * s * across, base - 0.36 * s * across], axis=1), colour, **style)
        for shift in (-0.3, -0.1, 0.1, 0.3):
            root = base + shift * s * across
            self.lines(np.stack([root, root + 0.2 * s * outward - 0.16 * s * across], axis=1), colour, 0.8, **style)

    def springs(self, points, outward, colour, **style):
        across = np.column_stack([-outward[:, 1], outward[:, 0]])
        s = self.size
        reach = (0.0, 0.12, 0.2, 0.35, 0.5, 0.65, 0.72, 0.85)
        swing = (0.0, 0.0, 0.16, -0.16, 0.16, -0.16, 0.0, 0.0)
        corners = [points + r * s * outward + w * s * across for r, w in zip(reach, swing)]
        self.lines(np.concatenate([np.stack(pair, axis=1) for pair in zip(corners[:-1], corners[1:])]), colour, **style)
        ground = points + 0.85 * s * outward
        self.lines(np.stack([ground + 0.3 * s * across, ground - 0.3 * s * across], axis=1), colour, **style)

    def surface(self, points, into, colour):
        """Hatched edge of a rigid obstacle; `into`: unit vectors into it."""
        self.lines(np.stack([points[:-1], points[1:]], axis=1), colour, 1.4)
        across = np.column_stack([-into[:, 1], into[:, 0]])
        self.lines(np.stack([points, points + 0.3 * self.size * (into - 0.6 * across)], axis=1), colour, 0.7)

    def turn(self, centre, counterclockwise, colour, radius=1.0):
        """An arrow around `centre`."""
        angles = np.radians(np.linspace(-60, 200, 40))
        circle = np.column_stack([np.cos(angles), np.sin(angles)]) * radius * self.size
        if not counterclockwise:
            circle = circle * [-1, 1]
        arc = np.asarray(centre) + circle
        self.lines(np.stack([arc[:-1], arc[1:]], axis=1), colour, 1.1)
        self.arrows(arc[-3:-2], arc[-1:] + 2.0 * (arc[-1:] - arc[-2:-1]), colour)

    def everything(self):
        return np.concatenate(self.segments) if self.segments else np.zeros((0, 2, 2))
