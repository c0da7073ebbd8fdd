"""Rotations of the bodies of the interactive view, which their normals follow."""
import numpy as np

SMALL = 0.02  # radians that the shading does not show
RIGID = 0.2  # largest deviation from a rigid motion, as a fraction of the size of the body


def turns_of(solid, body, moved, factor):
    """The rotation matrix of each body in each frame, by rows; None if no body turns.

    \\param body   number of the body of each cell  \\param moved  displacements of the vertices in each frame, drawn `factor` times as large
    """
    found = []
    for shift in moved:
        found.append([])
        for number in range(int(body.max(initial=-1)) + 1):
            vertices = np.unique(solid.triangles[body[solid.owners] == number])
            place = solid.points[vertices]
            found[-1].append(rotation(place, place + factor * shift[vertices]))
    angles = [angle_of(turn) for frame in found for turn in frame]
    return [[turn.reshape(-1).tolist() for turn in frame] for frame in found] if max(angles, default=0.0) > SMALL else None


def rotation(before, after):
    """The rotation that fits best (Kabsch 1976); none for bodies that deform too much, or are in several parts. Points in 2D or 3D"""
    if len(before) < 3:
        return np.eye(before.shape[1])
    a, b = before - before.mean(axis=0), after - after.mean(axis=0)
    left, _, right = np.linalg.svd(b.T @ a)
    left[:, -1] *= np.sign(np.linalg.det(left @ right))  # no reflection
    turn = left @ right
    return turn if np.abs(a @ turn.T - b).max() <= RIGID * np.ptp(a, axis=0).max() else np.eye(len(turn))


def angle_of(turn):
    """Radians, from 0 to pi."""
    cosine = turn[0, 0] if len(turn) == 2 else 0.5 * (np.trace(turn) - 1)
    return float(np.arccos(np.clip(cosine, -1, 1)))
