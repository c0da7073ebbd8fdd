"""Figures that are not in summary.json, computed from the files of a run independently of the program.

figure("hertz.fittedPressure", folder) reads folder/fields_0000.vtkhdf and folder/contact_0000.vtkhdf. Signs as in the files: tension
positive, contact pressure > 0 where it presses, gap > 0 where open.
"""
import json
import math
import os
import sys

import numpy as np

import comparisons
import curves
import moving_figures
import paths
from runfiles import contact, fields, hooke, linearTriangles, ofBodies, rotation, summary, turned


# --- V1, V14: patch test of two blocks, rotated by `angle` degrees, in 3D about `axis`: sigma = -pressure n x n everywhere, n the
# rotated y axis, in 3D the rotated z axis ---

def patch_stressError(folder, _, pressure=1e5, **turn):
    """Largest deviation of any stress component, over the pressure."""
    f = fields(folder)
    n = np.zeros(3)
    n[:f.dimension] = rotation(f.dimension, **turn)[:, -1]
    expected = -pressure * np.array([n[i] * n[j] for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))])
    return float(np.abs(f.cell["Stress"] - expected).max() / pressure)


def patch_displacementError(folder, _, pressure=1e5, angle=0, youngBelow=2e6, youngAbove=2e6):
    """Largest deviation of u from -n pressure (1 + eta) / E below the joint, n (-0.1 + pressure (1 - eta) / E) above it, over 0.1."""
    f = fields(folder)
    t, n = turned(angle)
    u, eta = f.point["Displacement"][:, :2], f.points @ n
    below, above = -pressure * (1 + eta) / youngBelow, -0.1 + pressure * (1 - eta) / youngAbove
    un = u @ n
    onJoint = np.abs(eta) < 1e-9
    wrong = np.where(onJoint, np.minimum(np.abs(un - below), np.abs(un - above)), np.abs(un - np.where(eta < 0, below, above)))
    return float(max(np.abs(u @ t).max(), wrong.max()) / 0.1)


def patch_contractionError(folder, _, pressure=1e5, below=2e6, above=2e6, poisson=0.3, depth=0.5, **turn):
    """The same for 3D blocks on z = -depth that slide along x = 0 and y = 0 and are free elsewhere (before the rotation), over the
    largest u. `below`, `above`: Young's moduli."""
    f, worst, largest = fields(folder), 0.0, 0.0
    r = rotation(3, **turn)
    for places, u in ofBodies(f, f.point["Displacement"]):
        x = places @ r
        young, under = (above, -pressure * depth / below) if x[:, 2].mean() > 0 else (below, -pressure * depth / below)
        expected = np.stack([poisson * x[:, 0], poisson * x[:, 1], -x[:, 2]], axis=1) * pressure / young
        expected[:, 2] += under
        worst, largest = max(worst, np.abs(u @ r - expected).max()), max(largest, np.linalg.norm(expected, axis=1).max())
    return float(worst / largest)


def patch_pressureError(folder, _, pressure=1e5):
    return float(np.abs(contact(folder).point["ContactPressure"] - pressure).max() / pressure)


# --- V2: rings ---

def radial(folder, radius):
    """Values with every node once, since points written by several ranks would count more in a mean."""
    f = fields(folder)
    r = np.hypot(f.points[:, 0], f.points[:, 1])
    at = np.flatnonzero(np.abs(r - radius) < 1e-6)
    at = at[np.unique(f.point["NodeId"][at], return_index=True)[1]]
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


def exactEnergyError(folder, stressAt):
    """Energy norm of the stress error, by quadrature at the edge midpoints; stressAt(points) gives the exact xx, yy, xy."""
    f = fields(folder)
    area, strain = linearTriangles(f, f.point["Displacement"])
    law = hooke(folder, f)
    computed, compliance = np.einsum("cij,cj->ci", law, strain), np.linalg.inv(law)
    x = f.points[np.array(f.cells)]
    square = 0.0
    for k in range(3):
        e = stressAt(0.5 * (x[:, k] + x[:, (k + 1) % 3])) - computed
        square += np.einsum("c,ci,cij,cj->", area / 3, e, compliance, e)
    return math.sqrt(square)


def rings_effectivity(folder, _):
    """Estimated error over the exact one: two rings of one material in contact are a thick tube under outer pressure (Lame)."""
    def stressAt(points):
        inner, outer, pressure = 0.2, 1.0, 1e7
        r2 = (points ** 2).sum(axis=1)
        mean = -pressure * outer ** 2 / (outer ** 2 - inner ** 2)
        c2, s2 = (points[:, 0] ** 2 - points[:, 1] ** 2) / r2, 2 * points[:, 0] * points[:, 1] / r2
        deviation = -mean * inner ** 2 / r2  # radial minus mean
        return np.stack([mean + deviation * c2, mean - deviation * c2, deviation * s2], axis=1)
    return summary(folder)["error"]["estimated_energy_norm"] / exactEnergyError(folder, stressAt)


# --- V3: Hertz, fit of p^2 = p0^2 (1 - x^2 / a^2) over |x| < 0.8 a ---

def fromTheMiddle(c):
    """Distance of the points of a contact from x = 0, in 3D from the axis x = y = 0."""
    return np.linalg.norm(c.points[:, :c.dimension - 1], axis=1)


def hertzFit(folder, halfWidth=0.96277):
    c = contact(folder)
    x, p = fromTheMiddle(c), c.point["ContactPressure"]
    use = x < 0.8 * halfWidth
    slope, constant = np.polyfit(x[use] ** 2, p[use] ** 2, 1)
    return math.sqrt(constant), math.sqrt(-constant / slope)


def hertz_fittedPressure(folder, _, **options):
    return hertzFit(folder, **options)[0]


def hertz_fittedHalfWidth(folder, _, **options):
    return hertzFit(folder, **options)[1]


def hertz_centrePressure(folder, _):
    c = contact(folder)
    return float(c.point["ContactPressure"][np.argmin(fromTheMiddle(c))])


# The same with nu = 0.4999, which makes the bodies stiffer

def hertzRubber_fittedPressure(folder, _):
    return hertzFit(folder, 0.874097)[0]


def hertzRubber_fittedHalfWidth(folder, _):
    return hertzFit(folder, 0.874097)[1]


# --- V18: Cattaneo's line contact of two bodies of one material, gap x^2 / (2 R), under the computed forces P and Q ---

def cattaneo(folder, mu=0.3, modulus=1 / (2 * 0.91), radius=1.0, line="touch"):
    """Points, tangential tractions, their maximum mu p0, half widths of contact and stick."""
    with open(os.path.join(folder, "summary.json")) as file:
        tangential, normal = (abs(v) for v in json.load(file)["contact"]["force"][line])
    a = math.sqrt(4 * normal * radius / (math.pi * modulus))
    c = contact(folder)
    return c.points[:, 0], np.abs(c.point["TangentialTraction"][:, 0]), mu * 2 * normal / (math.pi * a), a, a * math.sqrt(1 - tangential / (mu * normal))


def cattaneo_halfWidth(folder, _, **options):
    """Half width of the contact after Hertz."""
    return cattaneo(folder, **options)[3]


def cattaneo_stickRatio(folder, _, **options):
    """c / a from the traction at the centre, q(0) = mu p0 (1 - c/a)."""
    x, q, most, _, _ = cattaneo(folder, **options)
    return float(1 - q[np.argmin(np.abs(x))] / most)


def cattaneo_stickRatioError(folder, _, **options):
    """Relative deviation of c / a from sqrt(1 - Q / (mu P))."""
    _, _, _, a, c = cattaneo(folder, **options)
    return abs(cattaneo_stickRatio(folder, None, **options) * a / c - 1)


def cattaneo_tractionError(folder, _, beside=1.5, **options):
    """Largest deviation of the traction over mu p0, except within `beside` pairs of the ends of contact and stick, where its slope is infinite."""
    x, q, most, a, c = cattaneo(folder, **options)
    step = np.min(np.diff(np.sort(x)))
    exact = most * (np.sqrt(np.maximum(0, 1 - (x / a) ** 2)) - c / a * np.sqrt(np.maximum(0, 1 - (x / c) ** 2)))
    far = np.minimum(np.abs(np.abs(x) - a), np.abs(np.abs(x) - c)) > beside * step
    return float(np.max(np.abs(q - exact)[far]) / most)


# The same for a sphere: p^2 = p0^2 (1 - r^2 / a^2), a = 1 in input/hertz_sphere

def sphere_fittedPressure(folder, _, radius=1.0):
    return hertzFit(folder, radius)[0]


def sphere_fittedRadius(folder, _, radius=1.0):
    return hertzFit(folder, radius)[1]


def sphere_centrePressure(folder, _):
    return hertz_centrePressure(folder, _)


# --- V4: roller ---

def roller_displacement(folder, _):
    """u_y of the block under the centre of the contact."""
    f = fields(folder)
    return float(f.point["Displacement"][np.hypot(f.points[:, 0], f.points[:, 1]) < 1e-9, 1].min())


# --- V7: rigid flat punch of half width 1, half of it ---

def punch_pressureError(folder, _, within=0.8):
    """Largest deviation of the nodal pressure from P / (pi sqrt(1 - x^2)) for x < within, relative; P is the computed force."""
    c = contact(folder)
    force = 2 * c.point["ContactForce"].sum()
    use = c.points[:, 0] < within
    return float(np.abs(c.point["ContactPressure"][use] / curves.punch(c.points[use, 0], force, 1.0) - 1).max())


# --- the pressure as a function on the contact line ---

def line_pressureAt(folder, _, x):
    """Nodal pressure at the point of the contact lines with the given x."""
    c = contact(folder)
    return float(c.point["ContactPressure"][np.argmin(np.abs(c.points[:, 0] - x))])


def line_largestSlip(folder, _):
    """Largest magnitude of the slip of a pair."""
    return float(np.linalg.norm(contact(folder).point["Slip"], axis=1).max())


def line_pressureL2(folder, _, curve, along="x", within=None, **options):
    """L2 norm along the contact lines of the nodal pressure's deviation from a curve of curves.py, over that of the curve."""
    c = contact(folder)
    errors = norms = 0.0
    for line in np.unique(c.point["Line"]):
        use = np.flatnonzero(c.point["Line"] == line)
        use = use[np.argsort(c.point["ArcLength"][use])]
        x = curves.along(c, along)[use]
        exact = getattr(curves, curve)(x, **options)
        error = (c.point["ContactPressure"][use] - exact) ** 2
        if within is not None:
            error, exact = error[np.abs(x) < within], exact[np.abs(x) < within]
            use = use[np.abs(x) < within]
        errors += np.trapz(error, c.point["ArcLength"][use])
        norms += np.trapz(exact ** 2, c.point["ArcLength"][use])
    return float(math.sqrt(errors / norms))


# --- statics: forces of contact pairs, for any bodies ---

def statics_moment(folder, _):
    """Moment about the origin of the contact forces on side B."""
    c = contact(folder)
    f = c.point["ContactForce"][:, None] * c.point["Normal"]
    return float(np.sum(c.points[:, 0] * f[:, 1] - c.points[:, 1] * f[:, 0]))


def statics_force(folder, _, along, above=-math.inf, below=math.inf):
    """Sum of the pair forces at points whose coordinate `along` (x, y, z) lies between two values."""
    c = contact(folder)
    at = c.points[:, "xyz".index(along)]
    return float(c.point["ContactForce"][(at > above) & (at < below)].sum())


# --- V8: the tunnel (centre (60, 39.5), radius 6, fault leaning 25 degrees) ---

def wallStress(folder, side):
    """Smallest principal stress of the elements at the tunnel wall, of the right (side 1) or the left body (0)."""
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
    """Number of open pairs above a closed pair: 0 if only the foot of the lower piece is open."""
    c = contact(folder)
    y, active = c.points[:, 1], c.point["Active"] != 0
    lowestClosed = y[active].min()
    return int((y[~active] > lowestClosed).sum())


def history_energyIncrease(folder, _):
    """Largest increase of the energy from one outer iteration to the next, over |energy|; 0 or less when it never increases."""
    with open(os.path.join(folder, "history.csv")) as file:
        lines = [line.strip().split(",") for line in file if line.strip()]
    column = lines[0].index("energy")
    energy = np.array([float(line[column]) for line in lines[1:]])
    return float((np.diff(energy) / np.abs(energy[:-1])).max()) if len(energy) > 1 else 0.0


# --- V21: bounds of the error in the energy norm ---

def bound_overError(folder, _):
    """The bound divided by the error against the scene's exact solution."""
    s = summary(folder)
    return s["bound"]["total"] / s["error"]["energy_norm"]


def bound_effectivity(folder, _, energy):
    """The bound divided by the error |u - u_h|, where |u - u_h|^2 = 2 (J(u_h) - J(u)). energy: the potential energy J(u)."""
    s = summary(folder)
    return s["bound"]["total"] / math.sqrt(2 * (s["energy"] - energy))


def bound_overLifted(folder, _, energy):
    """The bound of |u - u_h| divided by the error |u - v| of the displacement v whose energy is energy_upper: v is u_h, lifted where it
    penetrates. |u - v|^2 = 2 (J(v) - J(u)). energy: the potential energy J(u)."""
    s = summary(folder)
    return s["bound"]["total"] / math.sqrt(2 * (s["bound"]["energy_upper"] - energy))


def vtk_quadrilateralArea(folder, _):
    """Area of all quadrilaterals from VTK's own reader, computed in the order of their corners."""
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


def figure(name, folder, reference=None, **options):
    """The figure "case.name" of the run in `folder`."""
    own = name.replace(".", "_")
    places = (sys.modules[__name__], comparisons, paths, moving_figures)
    function = next((getattr(place, own) for place in places if hasattr(place, own)), None)
    if function is None:
        raise KeyError(f"none of figures.py, comparisons.py, paths.py and moving_figures.py has {name}")
    return function(folder, reference, **options)
