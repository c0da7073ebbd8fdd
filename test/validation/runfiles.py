"""Contents of the files of a run: fields of bodies and contact, summary.json; and rotations of scenes."""
import csv
import glob
import json
import math
import os

import h5py
import numpy as np


VTK_DIMENSIONS = {1: 0, 3: 1, 21: 1, 5: 2, 9: 2, 22: 2, 23: 2, 28: 2}  # VTK cell types; all others are solids


class Fields:
    """One VTKHDF file with the pieces of all ranks joined. `dimension` of the scene: dimension of the cells or, for contact, one more."""

    def __init__(self, path, codimension=0):
        with h5py.File(path, "r") as file:
            root = file["VTKHDF"]
            counts = {name: np.asarray(root[name]) for name in ("NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds")}
            self.dimension = max([2, *(VTK_DIMENSIONS.get(t, 3) + codimension for t in np.unique(root["Types"]).tolist())])
            self.points = np.asarray(root["Points"])[:, :self.dimension]
            self.point = {name: np.asarray(data) for name, data in root.get("PointData", {}).items()}
            self.cell = {name: np.asarray(data) for name, data in root.get("CellData", {}).items()}
            offsets, ids = np.asarray(root["Offsets"]), np.asarray(root["Connectivity"])
        self.cells = []
        o = p = c = 0
        for points, cells, entries in zip(*counts.values()):
            for k in range(cells):
                self.cells.append(ids[c + offsets[o + k]:c + offsets[o + k + 1]] + p)
            o, p, c = o + cells + 1, p + points, c + entries

    def centroids(self):
        return np.array([self.points[cell].mean(axis=0) for cell in self.cells])


def ofStep(folder, kind, place):
    """Path of the fields of a load step, by index from 0, or of the last one."""
    return os.path.join(folder, f"{kind}_{place:04d}.vtkhdf") if place is not None else max(glob.glob(os.path.join(folder, f"{kind}_*.vtkhdf")))


def fields(folder, place=None):
    return Fields(ofStep(folder, "fields", place))


def contact(folder, place=None):
    return Fields(ofStep(folder, "contact", place), codimension=1)


def steps(folder):
    """Columns of steps.csv."""
    with open(os.path.join(folder, "steps.csv"), newline="") as file:
        rows = list(csv.DictReader(file))
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


def motions(folder, body):
    """Columns of frames.csv (Motion = Moving) of a body of one connected part."""
    with open(os.path.join(folder, "frames.csv"), newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["body"] == body]
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0] if name != "body"}


def placeAt(table, time):
    """Index of the load step that ends at a time."""
    at = int(np.argmin(np.abs(table["time"] - time)))
    if abs(table["time"][at] - time) > 1e-9 * abs(time):
        raise ValueError(f"no load step ends at {time}")
    return at


def ofBodies(f, values):
    """[(points, values)] of the nodes of each body; bodies share no node."""
    body = f.cell["Body"].astype(int)
    return [(f.points[nodes], values[nodes]) for nodes in
            (np.unique(np.concatenate([f.cells[i] for i in np.flatnonzero(body == b)])) for b in np.unique(body))]


def rotation(dimension, angle=0, axis=(0, 0, 1)):
    """Rotation matrix for an angle in degrees, in 3D about an axis of any length (Rodrigues)."""
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    if dimension == 2:
        return np.array([[c, -s], [s, c]])
    x, y, z = k = np.asarray(axis, dtype=float) / np.linalg.norm(axis)
    return c * np.eye(3) + (1 - c) * np.outer(k, k) + s * np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])


def turned(angle):
    """Unit vectors along and across the joint."""
    return rotation(2, angle).T


def summary(folder):
    with open(os.path.join(folder, "summary.json")) as file:
        return json.load(file)


def hooke(folder, f):
    """Matrix D of every cell in plane strain or plane stress, from the scene's materials (Regions are ignored)."""
    scene = summary(folder)["parameters"]
    sheet = scene["Model"] == "Plane Stress"
    laws = []
    for body in scene["Bodies"].values():
        material = scene["Materials"][body["Material"]]
        e, nu = material["Young Modulus"], material["Poisson Ratio"]
        mu = e / (2 * (1 + nu))
        lame = e * nu / (1 - nu * nu) if sheet else e * nu / ((1 + nu) * (1 - 2 * nu))
        laws.append(np.array([[lame + 2 * mu, lame, 0], [lame, lame + 2 * mu, 0], [0, 0, mu]]))
    return np.array(laws)[f.cell["Body"]]


def linearTriangles(f, displacement):
    """Area and strain (xx, yy, engineering xy) of every cell; cells are triangles of three nodes."""
    cells = np.array(f.cells)
    assert cells.shape[1] == 3, "cells of three nodes are expected"
    x, u = f.points[cells], displacement[:, :2][cells]
    turned = np.array([[0, 1], [-1, 0]])
    edges = np.stack([x[:, 2] - x[:, 1], x[:, 0] - x[:, 2], x[:, 1] - x[:, 0]], axis=1)
    area = 0.5 * (edges[:, 0, 0] * edges[:, 1, 1] - edges[:, 0, 1] * edges[:, 1, 0])
    gradient = -edges @ turned.T / (2 * area[:, None, None])  # gradients of the shape functions
    h = np.einsum("cak,cai->cik", gradient, u)
    return area, np.stack([h[:, 0, 0], h[:, 1, 1], h[:, 0, 1] + h[:, 1, 0]], axis=1)
