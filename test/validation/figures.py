"""Figures that the tests compute from the files of a run, independently of the program: what summary.json does not say.

figure("hertz.fittedPressure", folder) reads folder/fields_0000.vtkhdf and folder/contact_0000.vtkhdf. Signs as in the files: tension
positive, contact pressure and gap positive as in DESIGN.md.
"""
import json
import math
import os
import sys

import h5py
import numpy as np


class Fields:
    """One VTKHDF file with the pieces of all ranks joined."""

    def __init__(self, path):
        with h5py.File(path, "r") as file:
            root = file["VTKHDF"]
            counts = {name: np.asarray(root[name]) for name in ("NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds")}
            self.points = np.asarray(root["Points"])[:, :2]
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


def fields(folder):
    return Fields(os.path.join(folder, "fields_0000.vtkhdf"))


def contact(folder):
    return Fields(os.path.join(folder, "contact_0000.vtkhdf"))


# --- V1: patch test, sigma_yy = -1e5 everywhere, u_y = -0.05 on the contact line ---

def patch_stressError(folder, _):
    """Largest deviation of any stress component, over the pressure."""
    stress = fields(folder).cell["Stress"]  # XX YY ZZ XY YZ XZ
    expected = np.zeros(stress.shape[1])
    expected[1] = -1e5
    return float(np.abs(stress - expected).max() / 1e5)


def patch_uniformStress(folder, _):
    """Largest deviation of any stress component from its mean, over the largest stress."""
    stress = fields(folder).cell["Stress"]
    return float(np.abs(stress - stress.mean(axis=0)).max() / np.abs(stress).max())


def patch_stressYY(folder, _):
    return float(fields(folder).cell["Stress"][:, 1].mean())


def patch_displacementError(folder, _):
    """Largest deviation of u from (0, -0.05 (1 + y)), over 0.1."""
    f = fields(folder)
    u = f.point["Displacement"]
    return float(max(np.abs(u[:, 0]).max(), np.abs(u[:, 1] + 0.05 * (1 + f.points[:, 1])).max()) / 0.1)


def patch_pressureError(folder, _):
    return float(np.abs(contact(folder).point["ContactPressure"] - 1e5).max() / 1e5)


# --- V2: rings ---

def radial(folder, radius):
    f = fields(folder)
    r = np.hypot(f.points[:, 0], f.points[:, 1])
    at = np.abs(r - radius) < 1e-6
    return (f.point["Displacement"][at, :2] * f.points[at]).sum(axis=1) / r[at]


def rings_displacementOutside(folder, _):
    return float(radial(folder, 1.0).mean())


def rings_displacementJoint(folder, _):
    return float(radial(folder, 0.6).mean())


def rings_displacementBore(folder, _):
    return float(radial(folder, 0.2).mean())


def rings_leastPressure(folder, _):
    return float(contact(folder).point["ContactPressure"].min())


def rings_largestPressure(folder, _):
    return float(contact(folder).point["ContactPressure"].max())


# --- V3: Hertz, fit of p^2 = p0^2 (1 - x^2 / a^2) over |x| < 0.8 a ---

def hertzFit(folder, halfWidth=0.96277):
    c = contact(folder)
    x, p = c.points[:, 0], c.point["ContactPressure"]
    use = np.abs(x) < 0.8 * halfWidth
    slope, constant = np.polyfit(x[use] ** 2, p[use] ** 2, 1)
    return math.sqrt(constant), math.sqrt(-constant / slope)


def hertz_fittedPressure(folder, _):
    return hertzFit(folder)[0]


def hertz_fittedHalfWidth(folder, _):
    return hertzFit(folder)[1]


def hertz_centrePressure(folder, _):
    c = contact(folder)
    return float(c.point["ContactPressure"][np.argmin(np.abs(c.points[:, 0]))])


# The same with nu = 0.4999, which makes the bodies stiffer

def hertzRubber_fittedPressure(folder, _):
    return hertzFit(folder, 0.874097)[0]


def hertzRubber_fittedHalfWidth(folder, _):
    return hertzFit(folder, 0.874097)[1]


# The same of a sphere: p^2 = p0^2 (1 - r^2 / a^2), a = 1 in input/hertz_sphere

def sphere_fittedPressure(folder, _):
    return hertzFit(folder, 1.0)[0]


def sphere_fittedRadius(folder, _):
    return hertzFit(folder, 1.0)[1]


def sphere_centrePressure(folder, _):
    return hertz_centrePressure(folder, _)


# --- V8: the tunnel (centre (60, 39.5), radius 6, fault leaning 25 degrees) ---

def wallStress(folder, side):
    """Least principal stress of the elements that have a side on the tunnel wall, of the right (side 1) or the left body (0)."""
    f = fields(folder)
    onWall = np.abs(np.hypot(f.points[:, 0] - 60, f.points[:, 1] - 39.5) - 6) < 1e-4
    right = f.centroids()
    right = (right[:, 0] - 60) + (right[:, 1] - 39.5) * math.tan(math.radians(25)) > 0
    use = np.array([onWall[cell].sum() >= 2 for cell in f.cells]) & (right == bool(side))
    return float(f.cell["PrincipalStress"][use, 1].min())


def tunnel_rightWall(folder, _):
    return wallStress(folder, 1)


def tunnel_leftWall(folder, _):
    return wallStress(folder, 0)


def tunnel_rightOverLeft(folder, _):
    return wallStress(folder, 1) / wallStress(folder, 0)


def tunnel_openAboveFoot(folder, _):
    """Number of open pairs with a closed one below them: 0 when all that is open is the foot of the lower piece."""
    c = contact(folder)
    y, active = c.points[:, 1], c.point["Active"] != 0
    lowestClosed = y[active].min()
    return int((y[~active] > lowestClosed).sum())


# --- comparison of two runs: "against" in a case ---

def byNode(folder):
    """{node of the mesh: u}; ranks repeat the nodes of their seams, with the same u to solver tolerance."""
    f = fields(folder)
    return dict(zip(f.point["NodeId"].tolist(), f.point["Displacement"]))


def difference_displacement(folder, reference):
    """Largest |u - u_reference| over the largest |u_reference|."""
    u, r = byNode(folder), byNode(reference)
    if u.keys() != r.keys():
        return math.inf
    return float(max(np.linalg.norm(u[k] - r[k]) for k in r) / max(np.linalg.norm(v) for v in r.values()))


def byPair(folder, name):
    c = contact(folder)
    return dict(zip(c.point["Pair"].tolist(), c.point[name]))


def difference_force(folder, reference):
    """Largest difference of the pair forces over the largest force."""
    a, b = byPair(folder, "ContactForce"), byPair(reference, "ContactForce")
    if a.keys() != b.keys():
        return math.inf
    return float(max(abs(a[k] - b[k]) for k in b) / max(abs(v) for v in b.values()))


def difference_status(folder, reference):
    """Number of pairs with another status."""
    a, b = byPair(folder, "Active"), byPair(reference, "Active")
    return len(a.keys() ^ b.keys()) + sum(int(a[k] != b[k]) for k in a.keys() & b.keys())


def history_energyIncrease(folder, _):
    """Largest increase of the energy from one outer iteration to the next, over |energy|; 0 or less when it never increases."""
    with open(os.path.join(folder, "history.csv")) as file:
        lines = [line.strip().split(",") for line in file if line.strip()]
    column = lines[0].index("energy")
    energy = np.array([float(line[column]) for line in lines[1:]])
    return float((np.diff(energy) / np.abs(energy[:-1])).max()) if len(energy) > 1 else 0.0


def vtk_quadrilateralArea(folder, _):
    """Area of all quadrilaterals that VTK's own reader finds, each by the order of its corners."""
    from vtkmodules.vtkCommonDataModel import VTK_QUAD
    from vtkmodules.vtkIOHDF import vtkHDFReader

    reader = vtkHDFReader()
    reader.SetFileName(os.path.join(folder, "fields_0000.vtkhdf"))
    reader.Update()
    grid, total = reader.GetOutput(), 0.0
    for cell in (grid.GetCell(i) for i in range(grid.GetNumberOfCells()) if grid.GetCellType(i) == VTK_QUAD):
        x = np.array([cell.GetPoints().GetPoint(k) for k in range(4)])
        total += 0.5 * float(np.cross(x[2] - x[0], x[3] - x[1])[2])
    return total


def iterations_overReference(folder, reference):
    """PCG iterations of all, the auxiliary problem's included."""
    both = []
    for one in (folder, reference):
        with open(os.path.join(one, "summary.json")) as file:
            summary = json.load(file)
        both.append(summary["auxiliary"]["iterations"] + summary["outer"]["pcg_total"])
    return both[0] / both[1]


# --- memory of a run on several ranks against that of one rank ---

def peaks(folder):
    with open(os.path.join(folder, "summary.json")) as file:
        return json.load(file)["peak_memory_mb"]


def memory_largestOverReference(folder, reference):
    """Largest peak of a rank over that of the reference run (on one rank)."""
    return peaks(folder)["max"] / peaks(reference)["max"]


def memory_largestOverSmallest(folder, _):
    """Largest peak of a rank over the smallest: rank 0, which read the mesh, against the others."""
    return peaks(folder)["max"] / peaks(folder)["min"]


def figure(name, folder, reference=None):
    """The figure "case.name" of the run in `folder`."""
    function = getattr(sys.modules[__name__], name.replace(".", "_"), None)
    if function is None:
        raise KeyError(f"figures.py has no {name}")
    return function(folder, reference)
