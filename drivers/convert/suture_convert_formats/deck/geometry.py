"""Integrals over sides of elements, and nearest points on them."""
import numpy as np

CLUSTER = 64  # points that are projected together
AT_3 = np.sqrt(0.6) * np.array([-1, 0, 1]), np.array([5, 8, 5]) / 9
# Second-order side: first-order pieces by its nodes. Vertices come first, then the nodes between them, then the centre.
PIECES = {(2, 2): [(0, 1)], (2, 3): [(0, 2), (2, 1)], (3, 3): [(0, 1, 2)], (3, 4): [(0, 1, 2), (0, 2, 3)],
          (3, 6): [(0, 3, 5), (3, 1, 4), (5, 4, 2), (3, 4, 5)], (3, 8): [(0, 4, 7), (4, 1, 5), (5, 2, 6), (6, 3, 7), (4, 5, 6), (4, 6, 7)],
          (3, 9): [(0, 4, 8), (4, 1, 8), (1, 5, 8), (5, 2, 8), (2, 6, 8), (6, 3, 8), (3, 7, 8), (7, 0, 8)]}


def line_shapes(x, count):
    if count == 2:
        return np.array([(1 - x) / 2, (1 + x) / 2]), np.array([[-0.5, 0.5]])
    return np.array([x * (x - 1) / 2, x * (x + 1) / 2, 1 - x * x]), np.array([[x - 0.5, x + 0.5, -2 * x]])


def triangle_shapes(a, b, count):
    c = 1 - a - b
    if count == 3:
        return np.array([c, a, b]), np.array([[-1, 1, 0], [-1, 0, 1]])
    values = [c * (2 * c - 1), a * (2 * a - 1), b * (2 * b - 1), 4 * c * a, 4 * a * b, 4 * b * c]
    return np.array(values), np.array([[1 - 4 * c, 4 * a - 1, 0, 4 * (c - a), 4 * b, -4 * b], [1 - 4 * c, 0, 4 * b - 1, -4 * a, 4 * a, 4 * (c - b)]])


def square_shapes(x, y, count):
    corners = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])
    one, other = 1 + corners[:, 0] * x, 1 + corners[:, 1] * y
    if count == 4:
        return one * other / 4, np.array([corners[:, 0] * other, corners[:, 1] * one]) / 4
    if count == 8:
        more = corners[:, 0] * x + corners[:, 1] * y - 1
        ends = one * other * more / 4
        slopes = np.array([corners[:, 0] * other * (more + one), corners[:, 1] * one * (more + other)]) / 4
        middle = np.array([(1 - x * x) * (1 - y), (1 + x) * (1 - y * y), (1 - x * x) * (1 + y), (1 - x) * (1 - y * y)]) / 2
        along = np.array([[-2 * x * (1 - y), 1 - y * y, -2 * x * (1 + y), y * y - 1], [x * x - 1, -2 * y * (1 + x), 1 - x * x, -2 * y * (1 - x)]]) / 2
        return np.concatenate([ends, middle]), np.hstack([slopes, along])
    (fx, dx), (fy, dy) = line_shapes(x, 3), line_shapes(y, 3)
    at = [(0, 0), (1, 0), (1, 1), (0, 1), (2, 0), (1, 2), (2, 1), (0, 2), (2, 2)]
    return np.array([fx[i] * fy[j] for i, j in at]), np.array([[dx[0][i] * fy[j] for i, j in at], [fx[i] * dy[0][j] for i, j in at]])


def rule_of(dimension, count):
    """(shape functions, derivatives, weight) at the points of a rule for a side"""
    if dimension == 2:
        return [(*line_shapes(x, count), w) for x, w in zip(*AT_3)]
    if count in (3, 6):
        # Degree 4 on triangles (Dunavant 1985).
        points = [((a, a), w / 2) for a, w in ((0.445948490915965, 0.223381589678011), (0.091576213509771, 0.109951743655322))]
        points += [(p, w) for (a, _), w in list(points) for p in ((1 - 2 * a, a), (a, 1 - 2 * a))]
        return [(*triangle_shapes(*p, count), w) for p, w in points]
    return [(*square_shapes(x, y, count), v * w) for x, v in zip(*AT_3) for y, w in zip(*AT_3)]


def by_count(rows):
    """(number of nodes, their numbers) of the sides with equal numbers of nodes"""
    counts = (rows[:, 2:] >= 0).sum(axis=1)
    for count in np.unique(counts):
        yield int(count), rows[counts == count][:, 2:2 + count]


def integrals(mesh, rows, axisymmetric=False):
    """Integrals over sides. \\return node -> integral of its shape function, area, centroid; axisymmetric: times 2 pi r"""
    weights, area, moment = np.zeros(len(mesh.points)), 0.0, np.zeros(mesh.dimension)
    for count, nodes in by_count(rows):
        points = mesh.points[nodes]
        for shapes, slopes, weight in rule_of(mesh.dimension, count):
            tangents = np.einsum("kc,ecd->ekd", slopes, points)
            size = np.linalg.norm(tangents[:, 0], axis=1) if mesh.dimension == 2 else np.linalg.norm(np.cross(tangents[:, 0], tangents[:, 1]), axis=1)
            place = np.einsum("c,ecd->ed", shapes, points)
            size = size * weight * (2 * np.pi * place[:, 0] if axisymmetric else 1.0)
            np.add.at(weights, nodes.ravel(), np.outer(size, shapes).ravel())
            area += size.sum()
            moment += size @ place
    return weights, float(area), moment / area


def mean_edge(mesh, rows):
    """Mean length of the edges of sides"""
    lengths = []
    for count, nodes in by_count(rows):
        vertices = nodes[:, :2 if mesh.dimension == 2 else {3: 3, 6: 3}.get(count, 4)]
        edges = mesh.points[vertices] - mesh.points[np.roll(vertices, -1, axis=1)]
        lengths.append(np.linalg.norm(edges, axis=2).ravel())
    return float(np.concatenate(lengths).mean())


def nearest_on_segments(points, a, b):
    along = b - a
    share = np.einsum("psd,sd->ps", points[:, None] - a, along) / np.einsum("sd,sd->s", along, along)
    return a + np.clip(share, 0, 1)[..., None] * along


def nearest_on_triangles(points, a, b, c):
    """Nearest point of each triangle to each point"""
    u, v = b - a, c - a
    normal = np.cross(u, v)
    square = np.einsum("td,td->t", normal, normal)
    away = points[:, None] - a
    s = np.einsum("ptd,td->pt", away, np.cross(v, normal)) / square
    t = np.einsum("ptd,td->pt", away, np.cross(normal, u)) / square
    best = a + s[..., None] * u + t[..., None] * v
    inside = (s >= 0) & (t >= 0) & (s + t <= 1)
    distance = np.where(inside, np.linalg.norm(points[:, None] - best, axis=2), np.inf)
    for one, other in ((a, b), (b, c), (c, a)):
        edge = nearest_on_segments(points, one, other)
        far = np.linalg.norm(points[:, None] - edge, axis=2)
        closer = far < distance
        best[closer], distance[closer] = edge[closer], far[closer]
    return best


def project(mesh, points, rows):
    """Nearest points on sides. \\return points, distances: negative for points behind the side, inside the material"""
    pieces = [nodes[:, list(piece)] for count, nodes in by_count(rows) for piece in PIECES[mesh.dimension, count]]
    corners = mesh.points[np.concatenate(pieces)]
    if mesh.dimension == 2:
        along = corners[:, 1] - corners[:, 0]
        normals = np.column_stack([along[:, 1], -along[:, 0]])
    else:
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    centres = corners.mean(axis=1)
    radii = np.linalg.norm(corners - centres[:, None], axis=2).max(axis=1)
    nearest, distances = np.zeros_like(points), np.zeros(len(points))
    for some in clusters(points, np.arange(len(points))):
        own = points[some]
        centre = own.mean(axis=0)
        size = np.linalg.norm(own - centre, axis=1).max()
        away = np.linalg.norm(centres - centre, axis=1)
        close = np.flatnonzero(away - radii <= away.min() + 2 * size)  # no other piece is nearest to any of these points
        found = (nearest_on_segments if mesh.dimension == 2 else nearest_on_triangles)(own, *np.moveaxis(corners[close], 1, 0))
        far = np.linalg.norm(own[:, None] - found, axis=2)
        at = far.argmin(axis=1)
        here = np.arange(len(own))
        nearest[some] = found[here, at]
        sign = np.einsum("pd,pd->p", own - found[here, at], normals[close[at]])
        distances[some] = np.where(sign < 0, -1, 1) * far[here, at]
    return nearest, distances


def clusters(points, numbers):
    """Numbers of points in groups of at most CLUSTER neighbours, by halving along the longest edge"""
    if len(numbers) <= CLUSTER:
        return [numbers]
    own = points[numbers]
    order = numbers[np.argsort(own[:, np.ptp(own, axis=0).argmax()], kind="stable")]
    half = len(order) // 2
    return clusters(points, order[:half]) + clusters(points, order[half:])
