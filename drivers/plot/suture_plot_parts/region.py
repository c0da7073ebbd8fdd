"""The region of a 2D scene shown in *_zoom.png."""
import numpy as np


def region_of_interest(run):
    """(x0, x1, y0, y1, words) around the hole with the most stressed wall, else around the largest contact pressure, else None."""
    grid = run.fields
    low, high = grid.points.min(axis=0)[:2], grid.points.max(axis=0)[:2]

    def box(centre, half):
        # At least about two hundred elements even in a coarse mesh, since a few crosses would show nothing.
        near = np.sort(np.abs(grid.centroids - centre).max(axis=1))
        half = max(half, 0.04 * (high - low).max(), near[min(200, len(near) - 1)])
        (x0, y0), (x1, y1) = np.maximum(centre - half, low), np.minimum(centre + half, high)
        return x0, x1, y0, y1

    found = hole(grid)
    if found:
        a, b = found
        return (*box(0.5 * (a + b), 1.4 * (b - a).max()), "around the hole")
    if run.contact is not None and len(run.contact.points):
        pressure = run.contact.point_data["ContactPressure"]
        if np.nanmax(pressure) > 0:
            peak = int(np.nanargmax(pressure))
            line = run.contact.point_data["Line"] == run.contact.point_data["Line"][peak]
            pressed = run.contact.points[line & (pressure > 0.02 * pressure[peak]), :2]
            return (*box(0.5 * (pressed.min(axis=0) + pressed.max(axis=0)), 0.75 * np.ptp(pressed, axis=0).max()), "around the contact")
    return None


def hole(grid):
    """Corners of the box of the hole with the most stressed wall, or None."""
    edges = grid.silhouette
    parent = {}

    def root(a):
        while parent.setdefault(a, a) != a:
            parent[a] = parent[parent[a]]
            a = parent[a]
        return a

    for a, b in edges[:, 2:4].tolist():
        parent[root(a)] = root(b)
    loops = {}
    for row, a in enumerate(edges[:, 2].tolist()):
        loops.setdefault(root(a), []).append(row)
    # The outer contour of a part is not a hole: the box of a hole lies inside the box of another contour.
    boxes = {}
    for key, rows in loops.items():
        points = grid.points[edges[rows, :2].reshape(-1), :2]
        boxes[key] = (points.min(axis=0), points.max(axis=0))
    holes = [k for k in loops if any(j != k and np.all(boxes[j][0] < boxes[k][0]) and np.all(boxes[j][1] > boxes[k][1]) for j in loops)]
    # A gap between two sides of a contact line is not a hole either: it is far longer than wide.
    holes = [k for k in holes if (boxes[k][1] - boxes[k][0]).min() > 0.05 * (boxes[k][1] - boxes[k][0]).max() > 0]
    if not holes:
        return None
    largest = np.abs(grid.cell_data["PrincipalStress"][:, :2]).max(axis=1)
    return boxes[max(holes, key=lambda k: largest[edges[loops[k], 4]].max())]
