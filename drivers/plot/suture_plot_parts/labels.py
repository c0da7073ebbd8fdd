"""Places labels in a plot where they cover nothing important."""
import math
from bisect import bisect_left, bisect_right

import matplotlib
import numpy as np
from matplotlib.transforms import Bbox

DISTANCES = (9, 16, 26, 40, 60, 85, 115, 150, 200)  # points from the anchor to the nearest edge of its label
ANGLES = np.radians(np.arange(0, 360, 15))
DIRECTIONS = np.column_stack([np.cos(ANGLES), np.sin(ANGLES)])
# Costs. Avoiding a covered label or mark is worth (nearly) any distance; avoiding covered material is not.
COVERED_LABEL = OUTSIDE = 5000.0
COVERED_MARK = CROSSED_LABEL = 1500.0
WRONG_SIDE = 150.0
COVERED_LINE = 60.0  # per point of it
COVERED_MATERIAL = 45.0
CROSSED_MARK = 40.0  # per point of it
FAR = 0.6  # per point of distance


class Rectangle:
    """A box in pixels, with plain numbers: thousands are compared for each picture."""

    __slots__ = ("x0", "y0", "x1", "y1")

    def __init__(self, x0, y0, x1, y1):
        self.x0, self.y0, self.x1, self.y1 = float(x0), float(y0), float(x1), float(y1)

    def padded(self, by):
        return Rectangle(self.x0 - by, self.y0 - by, self.x1 + by, self.y1 + by)


def around(centre, half):
    """The rectangle with this centre and half size."""
    return Rectangle(centre[0] - half[0], centre[1] - half[1], centre[0] + half[0], centre[1] + half[1])


class Cloud:
    """Points in pixels, sorted by x, so that those in a box are found without comparing all."""

    def __init__(self):
        self.points, self._x = np.zeros((0, 2)), []

    def __len__(self):
        return len(self._x)

    def add(self, points):
        together = np.vstack([self.points, points])
        self.points = together[np.argsort(together[:, 0], kind="stable")]
        self._x = self.points[:, 0].tolist()

    def inside(self, box):
        near = self.points[bisect_right(self._x, box.x0):bisect_left(self._x, box.x1)]
        return near[(near[:, 1] > box.y0) & (near[:, 1] < box.y1)]

    def count(self, box):
        first, end = bisect_right(self._x, box.x0), bisect_left(self._x, box.x1)
        if first >= end:
            return 0
        y = self.points[first:end, 1]
        return np.count_nonzero((y > box.y0) & (y < box.y1))


def area(box):
    return (box.x1 - box.x0) * (box.y1 - box.y0)


class LabelPlacer:
    """Finds positions for labels such that none covers another label, a mark or the line that it names.

    Marks are points of the plot that stay visible (`keep_visible`); leaders may cross other lines (`keep_off`); material is covered
    only if necessary (`prefer_outside`).
    Fix the figure's layout before creating a placer.
    """

    def __init__(self, figure, axes):
        self.figure, self.axes, self.taken = figure, axes, []
        self.left_out = []  # labels without a position
        self.marks, self.lines, self.material = Cloud(), Cloud(), Cloud()
        if figure.get_layout_engine() is not None:
            figure.draw_without_rendering()
            figure.set_layout_engine("none")
        self.renderer = figure.canvas.get_renderer()
        self.points = figure.dpi / 72.0
        for label in (*axes.get_xticklabels(), *axes.get_yticklabels(), axes.xaxis.label, axes.yaxis.label, axes.title, axes._left_title):
            if label.get_text():
                self.taken.append(Rectangle(*label.get_window_extent(self.renderer).extents).padded(3))
        if axes.get_legend():
            self.taken.append(Rectangle(*axes.get_legend().get_window_extent(self.renderer).extents))
        # Along the axes' lines.
        frame = axes.get_window_extent(self.renderer)
        self.frame = Rectangle(frame.x0 + 2, frame.y0 + 2, frame.x1 - 2, max(axes.title.get_window_extent(self.renderer).y0, frame.y1) - 2)

    def keep_visible(self, points):
        self.marks.add(self._inside(points))

    def keep_visible_lines(self, segments):
        """`segments`: n x 2 points x 2; sampled densely, so that no label fits between two samples."""
        self.keep_visible(sampled(np.asarray(segments), self._data_length(5.0)))

    def keep_off(self, segments):
        """Lines that leaders may cross, but labels may not cover."""
        self.lines.add(self._inside(sampled(np.asarray(segments), self._data_length(5.0))))

    def prefer_outside(self, points):
        self.material.add(self._inside(points))

    def place(self, label, anchors, toward=None, least=0.0, centred=False, must=False, **style):
        """Annotates one of `anchors` (data coordinates), best first, with a line to it. Returns None and leaves the label out if it would
        cover another label or a mark, or lie outside.

        \\param toward   directions in which the label should lie, one per anchor
        \\param least    distance in points around the anchor that stays visible
        \\param centred  tries the anchor itself first, for names of areas
        \\param must     never leaves the label out: uses the position that covers least
        """
        artist = self.axes.annotate(label, anchors[0], (0, 0), textcoords="offset points", ha="center", va="center",
                                    arrowprops={"arrowstyle": "-", "lw": 0.7, "color": style.get("color", "black"), "shrinkA": 0,
                                                "shrinkB": 0.25 * least + 1.0}, **style)
        size = own_extent(artist, self.renderer)
        width, height = size.width + 6, size.height + 4
        best, half = None, (0.5 * width, 0.5 * height)
        offsets, distances = self._offsets(width, height, centred, least)
        for rank, anchor in enumerate(anchors):
            at = self.axes.transData.transform(anchor)
            costs = FAR * distances + 6 * rank
            if toward is not None:
                costs += WRONG_SIDE * (offsets @ np.asarray(toward[rank]) < 0.35 * np.hypot(*offsets.T))
            for offset, distance, cost in zip(offsets, distances.tolist(), costs.tolist()):
                if best and cost >= best[0]:
                    continue
                box = around(at + offset, half)
                cost += self._cost(box, at if distance > 0 else None, not centred, best[0] - cost if best else math.inf)
                if best is None or cost < best[0]:
                    best = (cost, anchor, offset, box)
        if not must and self._hides(best[3]):
            artist.remove()
            self.left_out.append(label)
            return None
        artist.xy = tuple(best[1])
        artist.set_position(tuple(best[2] / self.points))
        self.taken.append(best[3])
        at = self.axes.transData.transform(best[1])
        self.marks.add(np.linspace(at, at + best[2], 12)[1:9])
        return artist

    def place_within(self, label, cells, **style):
        """Text inside the area of `cells` (given by centroids), without a leader: the name of an area. None if there is not enough space."""
        middle = cells[np.argmin(np.hypot(*(cells - cells.mean(axis=0)).T))]  # the mean may lie outside of a bent area
        artist = self.axes.annotate(label, middle, (0, 0), textcoords="offset points", ha="center", va="center", **style)
        size = own_extent(artist, self.renderer)
        low, high = (self.axes.transData.transform(corner) for corner in (cells.min(axis=0), cells.max(axis=0)))
        if size.width > 1.2 * (high - low)[0] or size.height > 1.2 * (high - low)[1]:
            artist.remove()
            return None
        others = cells[np.linspace(0, len(cells) - 1, min(40, len(cells))).astype(int)]
        others = others[np.argsort(np.hypot(*(others - middle).T), kind="stable")]
        half = 0.5 * np.array([size.width + 2, size.height + 2])
        for at in [middle, *others]:
            centre = self.axes.transData.transform(at)
            box = around(centre, half)
            if self._cost(box, None, False) < 0.5 * COVERED_MARK:
                artist.xy = tuple(at)
                self.taken.append(box)
                return artist
        artist.remove()
        return None

    def _hides(self, box):
        return overlap(box, self.frame) < (1 - 1e-9) * area(box) or any(overlap(box, other) > 0 for other in self.taken) or \
            self.marks.count(box) > 0

    def _offsets(self, width, height, centred, least):
        """(offsets, distances) of a label's centre from the anchor, such that its edge is at the distance, the nearest first."""
        reach = np.minimum(0.5 * width / np.maximum(np.abs(DIRECTIONS[:, 0]), 1e-9), 0.5 * height / np.maximum(np.abs(DIRECTIONS[:, 1]), 1e-9))
        distances = np.repeat([float(distance) for distance in DISTANCES if distance >= least], len(DIRECTIONS))
        offsets = np.tile(DIRECTIONS, (len(distances) // len(DIRECTIONS), 1))
        offsets = offsets * (distances * self.points + np.tile(reach, len(distances) // len(DIRECTIONS)))[:, None]
        if not centred or least > 0:
            return offsets, distances
        return np.vstack([[0.0, 0.0], offsets]), np.concatenate([[0.0], distances])

    def _covered(self, box):
        """Number of labels that the box covers."""
        x0, y0, x1, y1 = box.x0, box.y0, box.x1, box.y1
        return sum([other.x0 < x1 and other.x1 > x0 and other.y0 < y1 and other.y1 > y0 for other in self.taken])

    def _cost(self, box, leader_from, material, limit=math.inf):
        """Cost of a label at this position; evaluation stops above `limit`, which saves most of the work."""
        outside = 1.0 - overlap(box, self.frame) / area(box)
        cost = OUTSIDE * (outside if outside > 1e-9 else 0.0) + COVERED_LABEL * self._covered(box)
        if cost >= limit:
            return cost
        cost += COVERED_MARK * min(self.marks.count(box), 10)
        cost += COVERED_LINE * min(self.lines.count(box), 10)
        if material:
            cost += COVERED_MATERIAL * min(self.material.count(box), 4) / 4
        if cost >= limit or leader_from is None:
            return cost
        centre = np.array([0.5 * (box.x0 + box.x1), 0.5 * (box.y0 + box.y1)])
        way = np.linspace(leader_from, centre, 40)[2:]
        bounds = Rectangle(*way.min(axis=0), *way.max(axis=0))
        cost += CROSSED_LABEL * sum(touch(other, bounds) and bool(within(other, way).any()) for other in self.taken)
        if cost >= limit or len(self.marks) == 0:
            return cost
        near = self.marks.inside(bounds.padded(3))
        near = near[np.hypot(*(near - leader_from).T) > 8]
        if len(near):
            crossed = np.hypot(near[:, None, 0] - way[None, :, 0], near[:, None, 1] - way[None, :, 1]).min(axis=1) < 3
            cost += CROSSED_MARK * min(np.count_nonzero(crossed), 20)
        return cost

    def _inside(self, points):
        points = np.asarray(points, dtype=float).reshape(-1, 2)
        return self.axes.transData.transform(points) if len(points) else np.zeros((0, 2))

    def _data_length(self, pixels):
        a, b = self.axes.transData.inverted().transform([[0, 0], [pixels, 0]])
        return abs(b[0] - a[0])


def own_extent(artist, renderer):
    """Box of the text alone; the box of an annotation also contains its leader."""
    box = matplotlib.text.Text.get_window_extent(artist, renderer)
    patch = artist.get_bbox_patch()
    return Bbox.union([box, patch.get_window_extent(renderer)]) if patch else box


def overlap(a, b):
    width, height = min(a.x1, b.x1) - max(a.x0, b.x0), min(a.y1, b.y1) - max(a.y0, b.y0)
    return width * height if width > 0 and height > 0 else 0.0


def touch(a, b):
    return a.x0 <= b.x1 and a.x1 >= b.x0 and a.y0 <= b.y1 and a.y1 >= b.y0


def within(box, points):
    return (points[:, 0] > box.x0) & (points[:, 0] < box.x1) & (points[:, 1] > box.y0) & (points[:, 1] < box.y1)


def sampled(segments, spacing):
    """Points on the segments including their ends, at most `spacing` apart."""
    if len(segments) == 0:
        return np.zeros((0, 2))
    lengths = np.hypot(*(segments[:, 1] - segments[:, 0]).T)
    parts = np.minimum(np.maximum(1, np.ceil(lengths / spacing)).astype(int), 400)
    which = np.repeat(np.arange(len(parts)), parts + 1)
    step = np.arange(len(which)) - np.repeat(np.cumsum(parts + 1) - (parts + 1), parts + 1)
    return segments[which, 0] + (step / parts[which])[:, None] * (segments[which, 1] - segments[which, 0])


def along(sides, fractions):
    """Points on a side group at fractions of its length: (points, outward normals)."""
    sides = ordered(sides)
    steps = sides[:, 3:5] - sides[:, 0:2]
    lengths = np.hypot(*steps.T)
    ends = np.cumsum(lengths)
    where = np.asarray(fractions) * ends[-1]
    at = np.minimum(np.searchsorted(ends, where), len(sides) - 1)
    part = np.clip((where - (ends[at] - lengths[at])) / np.maximum(lengths[at], 1e-300), 0, 1)
    tangent = steps[at] / np.maximum(lengths[at], 1e-300)[:, None]
    return sides[at, 0:2] + part[:, None] * steps[at], np.column_stack([tangent[:, 1], -tangent[:, 0]])


def ordered(sides):
    """Sides ordered into a chain, as far as possible."""
    start = {tuple(np.round(side[0:2], 12)): i for i, side in enumerate(sides)}
    targets = {tuple(np.round(side[3:5], 12)) for side in sides}
    left, result = dict.fromkeys(range(len(sides))), []
    heads = [i for key, i in start.items() if key not in targets]
    while left:
        at = next((i for i in heads if i in left), next(iter(left)))
        while at is not None and at in left:
            del left[at]
            result.append(at)
            at = start.get(tuple(np.round(sides[at][3:5], 12)))
    return sides[result]
