"""Rasteriser: finds the visible triangle at each sample of a plot."""
import numpy as np

MOST = 2_000_000  # samples at a time, which limits temporary memory


class Raster:
    """A grid of samples with the nearest triangle at each, by the z-buffer algorithm with spans of samples along rows (Catmull 1974).

    `low`, `high`: corners of the plot; `shape`: numbers of rows (the lowest first) and columns. `samples`, `shown`: indices in the flattened
    grid of the samples that show a triangle, and these triangles.
    """

    def __init__(self, low, high, shape):
        self.low, self.shape = np.array(low, dtype=float), tuple(shape)
        self.scale = np.array([shape[1], shape[0]]) / (np.array(high) - self.low)  # samples per length
        self.near = self.triangle = None
        self.corners = np.zeros((0, 3, 2))  # of all triangles, in samples
        self.samples = self.shown = np.zeros(0, dtype=int)
        self._x = self._y = np.zeros(0)

    def _seen(self):
        self.samples = np.flatnonzero(self.triangle.reshape(-1) >= 0)
        self.shown = self.triangle.reshape(-1)[self.samples]
        number, columns = self.samples.astype(np.int32), np.int32(self.shape[1])
        row = number // columns
        self._x, self._y = (number - row * columns) + 0.5, row + 0.5

    def in_samples(self, flat):
        """Converts plot coordinates to samples; the centre of the first sample is at 0.5."""
        return (flat - self.low) * self.scale

    def places(self, some=slice(None)):
        """Plot coordinates of `samples`, or of some of them."""
        return np.column_stack([self._x[some], self._y[some]]) / self.scale + self.low

    def draw(self, flat, nearness, triangles):
        """Adds triangles; only anticlockwise ones are visible. Of equally near triangles the last one is visible.

        \\param nearness  None: the triangles lie in one plane and cover nothing, which saves half of the time
        """
        if self.triangle is None:
            self.near = None if nearness is None else np.full(self.shape, -np.inf, dtype=np.float32)
            self.triangle = np.full(self.shape, -1, dtype=np.int32)
        first, corners = len(self.corners), self.in_samples(flat)[triangles]
        self.corners = np.concatenate([self.corners, corners])
        which, row, start, length = self.spans(corners)
        if nearness is None:
            begins = row * self.shape[1] + start - (np.cumsum(length) - length)
            place = np.repeat(begins, length) + np.arange(length.sum())
            self.triangle.reshape(-1)[place] = np.repeat((which + first).astype(np.int32), length)
            self._seen()
            return
        p, q, value = planes(corners, nearness[triangles])
        base = (value + p * (0.5 - corners[:, 0, 0]) - q * corners[:, 0, 1])[which] + p[which] * start + q[which] * (row + 0.5)
        slope, place = p[which], row * self.shape[1] + start
        begins = np.concatenate([[0], np.cumsum(length)])
        at = 0
        while at < len(which):
            to = max(at + 1, np.searchsorted(begins, begins[at] + MOST, side="right") - 1)
            part, many = slice(at, to), length[at:to]
            step = np.arange(begins[to] - begins[at]) - np.repeat(begins[part] - begins[at], many)
            near = (np.repeat(base[part], many) + np.repeat(slope[part], many) * step).astype(np.float32)
            self._keep(np.repeat(place[part], many) + step, near, np.repeat((which[part] + first).astype(np.int32), many))
            at = to
        self._seen()

    def resampled(self, low, high, shape):
        """The same triangles in another region at about the same scale: each sample shows the triangle of the nearest sample here."""
        other = Raster(low, high, shape)
        columns, rows = (np.floor(((np.arange(count) + 0.5) / scale + start - own) * own_scale).astype(int)
                         for count, scale, start, own, own_scale in zip(shape[::-1], other.scale, other.low, self.low, self.scale))
        inside_rows, inside = (rows >= 0) & (rows < self.shape[0]), (columns >= 0) & (columns < self.shape[1])
        other.triangle = np.full(shape, -1, dtype=np.int32)
        found = np.flatnonzero(inside_rows)
        if len(found) and inside.any():
            part = np.flatnonzero(inside)
            other.triangle[found[0]:found[-1] + 1, part[0]:part[-1] + 1] = self.triangle[rows[found][:, None], columns[part]]
        ratio = other.scale / self.scale
        other.corners = self.corners * ratio + (self.low - other.low) * other.scale
        other._seen()
        return other

    def _keep(self, place, near, owner):
        """Keeps samples unless a nearer one exists. If several have one position, writes any of them, then the nearer ones again."""
        best, triangle = self.near.reshape(-1), self.triangle.reshape(-1)
        ahead = near >= best[place]
        while ahead.any():
            place, near, owner = place[ahead], near[ahead], owner[ahead]
            best[place] = near
            triangle[place] = owner
            ahead = near > best[place]

    def spans(self, corners):
        """(triangle, row, first sample, length): spans of samples whose centres lie in a triangle, for all anticlockwise triangles."""
        turns = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) > 0
        low = np.clip(np.ceil(corners[:, :, 1].min(axis=1) - 0.5), 0, self.shape[0]).astype(int)
        high = np.clip(np.floor(corners[:, :, 1].max(axis=1) - 0.5) + 1, 0, self.shape[0]).astype(int)
        rows = np.where(turns, np.maximum(high - low, 0), 0)
        which = np.repeat(np.arange(len(corners)), rows)
        row = np.arange(len(which)) - np.repeat(np.cumsum(rows) - rows - low, rows)
        left, right = np.zeros(len(which)), np.full(len(which), float(self.shape[1]))
        for k in range(3):
            a, b = corners[:, k], corners[:, (k + 1) % 3]
            # Left of the edge from a to b: p x + q y + r >= 0. Both triangles at an edge use the same numbers with opposite sign: no gap.
            p, q, r = (a[:, 1] - b[:, 1])[which], (b[:, 0] - a[:, 0])[which], (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])[which]
            rest = q * (row + 0.5) + r
            with np.errstate(divide="ignore", invalid="ignore"):
                x = np.where(p == 0, -np.inf, -rest / p)
            np.copyto(left, np.maximum(left, x), where=p > 0)
            np.copyto(right, np.minimum(right, x), where=(p < 0) | (p == 0) & (rest < 0))
        start = np.ceil(left - 0.5)
        length = np.floor(np.maximum(right, -1.0) - 0.5) + 1 - start
        good = length > 0
        return which[good], row[good], start[good].astype(int), length[good].astype(int)

    def interpolate(self, values):
        """Linear interpolation to `samples` of values at the corners of all triangles."""
        p, q, value = planes(self.corners, values)
        constant = value - p * self.corners[:, 0, 0] - q * self.corners[:, 0, 1]
        found = p[self.shown] * self._x + q[self.shown] * self._y + constant[self.shown]
        return np.clip(found, np.nanmin(values), np.nanmax(values)).astype(np.float32) if len(found) else found.astype(np.float32)

    def hidden(self, flat, nearness, slack):
        """True for points behind triangles by more than `slack`, in all nine samples around them."""
        column, row = np.floor(self.in_samples(flat)).astype(int).T
        behind = np.ones(len(flat), dtype=bool)
        for dy in (-1, 0, 1):
            for dx in (-1, 0, 1):
                x, y = np.clip(column + dx, 0, self.shape[1] - 1), np.clip(row + dy, 0, self.shape[0] - 1)
                behind &= self.near[y, x] > nearness + slack
        return behind


def planes(corners, values):
    """(p, q, value) of each triangle: value + p (x - x0) + q (y - y0) interpolates the values at its corners; (x0, y0) is the first."""
    b, c = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    twice = np.cross(b, c)
    inverse = np.where(np.abs(twice) > 1e-12, 1.0 / np.where(twice == 0, 1.0, twice), 0.0)
    vb, vc = values[:, 1] - values[:, 0], values[:, 2] - values[:, 0]
    return (vb * c[:, 1] - vc * b[:, 1]) * inverse, (vc * b[:, 0] - vb * c[:, 0]) * inverse, values[:, 0]


def visible_parts(raster, starts, ends, slack):
    """The visible parts of segments, in plot coordinates. `starts`, `ends`: rows of two coordinates and a nearness."""
    length = np.hypot(*((ends - starts)[:, :2] * raster.scale).T)
    parts = np.clip(np.ceil(length / 2.0), 1, 4000).astype(int)
    which = np.repeat(np.arange(len(parts)), parts + 1)
    step = np.arange(len(which)) - np.repeat(np.cumsum(parts + 1) - (parts + 1), parts + 1)
    t = (step / parts[which])[:, None]
    points = (1 - t) * starts[which] + t * ends[which]
    clear = ~raster.hidden(points[:, :2], points[:, 2], slack)
    both = clear[1:] & clear[:-1] & (which[1:] == which[:-1])
    change = np.diff(np.concatenate([[0], both.astype(int), [0]]))  # no run continues into the next segment
    return np.stack([points[np.flatnonzero(change > 0)][:, :2], points[np.flatnonzero(change < 0)][:, :2]], axis=1)
