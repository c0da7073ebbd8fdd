"""*SYSTEM and *NODE, SYSTEM=C or S: coordinates of nodes in local systems, as Cartesian ones."""
import numpy as np

from .cards import numbers_in


def cartesian(points, kind):
    """Positions from cylindrical (radius, angle, z) or spherical coordinates (radius, longitude, latitude), angles in degrees"""
    points = np.array(points, dtype=float)
    if kind.startswith("R"):
        return points
    radius, turn, third = points[:, 0], np.radians(points[:, 1]), points[:, 2]
    if kind.startswith("C"):
        return np.column_stack([radius * np.cos(turn), radius * np.sin(turn), third])
    up = np.radians(third)
    return np.column_stack([radius * np.cos(up) * np.cos(turn), radius * np.cos(up) * np.sin(turn), radius * np.sin(up)])


class LocalSystem:
    """x -> axes x + origin: a *SYSTEM, which holds for the following *NODE cards"""

    def __init__(self, origin=(0, 0, 0), axes=None):
        self.origin, self.axes = np.array(origin, dtype=float), np.eye(3) if axes is None else axes

    def placed(self, points):
        return np.asarray(points) @ self.axes.T + self.origin

    @staticmethod
    def of(card, findings):
        """Data lines: the origin and a point on axis x, then a point in the plane of x and y; no data line: the global system"""
        rows = [[value or 0.0 for value in numbers_in(words, place, findings)] for place, words in card.rows]
        if not rows:
            return LocalSystem()
        origin = np.array((rows[0] + [0.0] * 3)[:3])
        if len(rows[0]) < 4:
            return LocalSystem(origin)
        first = np.array((rows[0][3:] + [0.0] * 3)[:3]) - origin
        second = np.array((rows[1] + [0.0] * 3)[:3]) - origin if len(rows) > 1 else np.array([-first[1], first[0], 0.0])
        third = np.cross(first, second)
        if not np.linalg.norm(third):
            findings.error(card.place, f"{card.title}: the three points are on a line")
            return LocalSystem(origin)
        axes = [first, np.cross(third, first), third]
        return LocalSystem(origin, np.column_stack([axis / np.linalg.norm(axis) for axis in axes]))
