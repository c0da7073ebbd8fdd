"""Parallel projection onto the plot plane."""
import argparse
from dataclasses import dataclass

import numpy as np

DEFAULT = (1.0, -1.4, 0.9)


@dataclass(frozen=True)
class View:
    """A parallel view: unit vectors to the right, upward and towards the viewer."""
    right: np.ndarray
    up: np.ndarray
    toward: np.ndarray
    given: tuple  # the requested direction towards the viewer

    def flat(self, points):
        """Plot coordinates, in the length unit of the points."""
        return points @ np.column_stack([self.right, self.up])

    def nearness(self, points):
        return points @ self.toward

    def words(self):
        return "({})".format(", ".join(f"{value:.3g}".replace("-", "\u2212") for value in self.given))

    def axes(self):
        """Names of the coordinate axes along those of the plot, or None if it is not aligned."""
        names = [[name for name, along in zip("xyz", vector) if along > 1 - 1e-9] for vector in (self.right, self.up)]
        return (names[0][0], names[1][0]) if all(names) else None


def view_from(direction):
    """The view from a direction; z points upward, or y if the view is along z."""
    toward = np.array(direction, dtype=float)
    toward /= np.linalg.norm(toward)
    upward = np.array([0.0, 0.0, 1.0]) if np.hypot(*toward[:2]) > 1e-6 else np.array([0.0, 1.0, 0.0])
    right = np.cross(upward, toward)
    right /= np.linalg.norm(right)
    return View(right, np.cross(toward, right), toward, tuple(direction))


def turned_to_eye(normal):
    """The normal or its opposite, whichever points to the viewer of the default view: plots along it have the usual axes."""
    normal = np.asarray(normal, dtype=float)
    return normal if normal @ np.array(DEFAULT) >= 0 else -normal


def three_numbers(text):
    """Parses a direction of the command line."""
    try:
        found = tuple(float(part) for part in text.split(","))
    except ValueError:
        found = ()
    if len(found) != 3 or not np.isfinite(found).all() or not any(found):
        raise argparse.ArgumentTypeError(f"'{text}' is not a direction x,y,z")
    return found
