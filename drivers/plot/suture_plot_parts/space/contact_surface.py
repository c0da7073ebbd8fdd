"""Contact surfaces of a 3D run, and their flat charts."""
import numpy as np

from ..friction import has_friction
from .cells import FACES, with_centres
from .view import turned_to_eye, view_from

ONE_SIDE = 0.5  # length of the mean normal above which a surface is viewed from one side
BENT = 0.9  # length of the mean normal below which a part of a cylinder is unrolled: arcs of more than 90 degrees
CIRCLE = 0.02  # fraction of the radius by which points of a cylinder are off its circle
ROUND = 0.03  # variance of the normals along an axis below which a surface is a cylinder about it
ALIGNED = np.cos(np.radians(4.0))  # a view closer to an axis is aligned with it


class ContactSurface:
    """The surface of one contact of the scene: points are its pairs, and the centres of quadrilaterals between them."""

    def __init__(self, grid, line, name):
        own = np.flatnonzero(grid.point_data["Line"] == line)
        self.name, self.pairs = name, len(own)
        place = np.full(len(grid.points), -1)
        place[own] = np.arange(len(own))
        triangles, centres, count = [np.zeros((0, 3), dtype=int)], [], len(own)
        for _, _, nodes in grid.blocks:
            shape, mine = FACES[nodes.shape[1]], place[nodes]
            mine = mine[mine[:, 0] >= 0]
            if shape.centre is not None:
                centres.append((mine, shape.centre))
                mine = np.column_stack([mine, count + np.arange(len(mine))])
                count += len(mine)
            triangles.append(mine[:, shape.triangles].reshape(-1, 3))
        self.triangles = np.concatenate(triangles)
        self.points, self.active, self.pressure, self.gap, self.normal = (
            with_centres(values[own].astype(float), centres)
            for values in (grid.points, *(grid.point_data[name] for name in ("Active", "ContactPressure", "Gap", "Normal"))))
        self.open = int((self.active[:self.pairs] < 0.5).sum())
        self.rubs = has_friction(grid)
        if self.rubs:
            size, bound = np.linalg.norm(grid.point_data["TangentialTraction"][own], axis=1), grid.point_data["FrictionBound"][own]
            used = np.divide(size, bound, out=np.zeros(len(own)), where=bound > 0)
            stick = grid.point_data["Stick"][own]
            bounded = grid.point_data["Active"][own] * (bound > 0)  # pairs whose mobilisation is defined
            self.tangential, self.used, self.sticks, self.bounded = (with_centres(values.astype(float), centres)
                                                                     for values in (size, used, stick == 1, bounded))
            self.sticking, self.slipping = np.count_nonzero(stick == 1), np.count_nonzero(stick == 0)

    def border(self):
        """(triangle, side) of triangle sides without a neighbour."""
        ends = np.sort(np.stack([self.triangles, np.roll(self.triangles, -1, axis=1)], axis=-1).reshape(-1, 2), axis=1)
        _, inverse, count = np.unique(ends[:, 0] * len(self.points) + ends[:, 1], return_inverse=True, return_counts=True)
        return np.divmod(np.flatnonzero(count[inverse] == 1), 3)


def contact_names(run):
    """{name: number} of the scene's contacts with pairs."""
    names = list(run.parameter("Contact", default={}))
    lines = np.unique(run.contact.point_data["Line"]).astype(int).tolist() if run.contact is not None else []
    return {names[line] if 0 <= line < len(names) else f"contact {line}": line for line in lines}


def contact_surfaces(run):
    """The surfaces of all contacts with faces."""
    found = [ContactSurface(run.contact, line, name) for name, line in contact_names(run).items()]
    return [surface for surface in found if len(surface.triangles)]


class Chart:
    """Flat chart of a contact surface: `flat` (triangles x 3 x 2) and `near` (triangles x 3).

    The view is along its mean normal; a surface around an axis is unrolled. A surface around a point is viewed along the normal at the
    largest pressure, and its far side is hidden. `names`: of the chart's axes, if they can have ticks; else None, with a `view`.
    """

    def __init__(self, surface):
        points, triangles = surface.points, surface.triangles
        a, b, c = (points[triangles[:, k]] for k in range(3))
        area = 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1)
        normal = surface.normal[triangles].mean(axis=1)
        weight = area / max(area.sum(), 1e-300)
        mean = weight @ normal
        spread, directions = np.linalg.eigh((normal * weight[:, None]).T @ normal)
        self.view = self.names = None
        if spread[0] < ROUND and (np.linalg.norm(mean) < ONE_SIDE or np.linalg.norm(mean) < BENT and is_round(points, directions[:, 0])):
            self._unroll(surface, directions[:, 0])
            return
        along = mean if np.linalg.norm(mean) >= ONE_SIDE else surface.normal[np.argmax(np.nan_to_num(surface.pressure))]
        self.view = view_from(aligned(turned_to_eye(along)))
        self.names = self.view.axes()
        self.words = ""
        self.flat, self.near = self.view.flat(points)[triangles], self.view.nearness(points)[triangles]

    def _unroll(self, surface, axis):
        axis = turned_to_eye(aligned(axis))
        view = view_from(axis)
        flat = view.flat(surface.points)
        centre, radius = circle(flat)
        x, y = (flat - centre).T
        peak = np.argmax(np.nan_to_num(surface.pressure))
        angle = np.angle((x + 1j * y) / (x[peak] + 1j * y[peak]))[surface.triangles]  # the cut is opposite to the largest pressure
        last = angle[:, 2:]  # centre of a quadrilateral, all of whose triangles lie on one side of the cut
        angle = last + (angle - last + np.pi) % (2 * np.pi) - np.pi
        along = view.nearness(surface.points)[surface.triangles]
        self.flat, self.near = np.stack([radius * angle, along], axis=-1), np.zeros(angle.shape)
        at = np.abs(axis).max() > 1 - 1e-9
        self.names = ("arc length", "xyz"[np.argmax(np.abs(axis))] if at else "along the axis")
        self.words = ", unrolled; 0: largest pressure"


def circle(flat):
    """(centre, radius) of the circle through the points: x^2 + y^2 = 2 a x + 2 b y + c."""
    middle = flat.mean(axis=0)
    shifted = flat - middle
    fitted = np.linalg.lstsq(np.column_stack([2 * shifted, np.ones(len(flat))]), (shifted**2).sum(axis=1), rcond=None)[0]
    return middle + fitted[:2], np.sqrt(max(fitted[2] + fitted[:2] @ fitted[:2], 0.0))


def is_round(points, axis):
    """True if the points lie on a cylinder about the axis."""
    flat = view_from(axis).flat(points)
    centre, radius = circle(flat)
    return bool(np.abs(np.hypot(*(flat - centre).T) - radius).max() < CIRCLE * radius)


def aligned(direction):
    """The unit vector along `direction`, or the coordinate axis if nearly aligned with it."""
    direction = np.asarray(direction, dtype=float) / np.linalg.norm(direction)
    largest = int(np.argmax(np.abs(direction)))
    return np.sign(direction[largest]) * np.eye(3)[largest] if abs(direction[largest]) > ALIGNED else direction
