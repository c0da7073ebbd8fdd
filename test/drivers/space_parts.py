#!/usr/bin/python3
"""Components of the 3D pictures against geometry: outer surface, edges, projection, rasteriser, cuts, contact surfaces.

    space_parts.py --plot suture_plot --work DIR --mpirun "..."
"""
import sys
from pathlib import Path

import numpy as np
from PIL import Image

from harness import arguments, check, finish

options = arguments("--plot")
sys.path.insert(0, str(Path(options.plot).resolve().parent))

import space_scenes  # noqa: E402
from space_samples import Part, ball, brick, write_run  # noqa: E402
from suture_plot_parts.labels import Cloud, Rectangle  # noqa: E402
from suture_plot_parts.png import write_png  # noqa: E402
from suture_plot_parts.run import RunFolder  # noqa: E402
from suture_plot_parts.space.cells import CELLS, FACES  # noqa: E402
from suture_plot_parts.space.contact_surface import Chart, contact_surfaces  # noqa: E402
from suture_plot_parts.space.cut import Cut, Plane, chosen_plane  # noqa: E402
from suture_plot_parts.space.image import coloured, picture  # noqa: E402
from suture_plot_parts.space.raster import Raster, visible_parts  # noqa: E402
from suture_plot_parts.space.surface import Surface  # noqa: E402
from suture_plot_parts.space.view import DEFAULT, view_from  # noqa: E402

SIZES = np.array([4.0, 3.0, 2.0])
DIVISIONS = (2, 3, 4)
SQUARES = 2 * (2 * 3 + 3 * 4 + 2 * 4)  # faces of small boxes on the outer surface of the box
OUTSIDE = {12: SQUARES, 25: SQUARES, 29: SQUARES, 14: SQUARES, 10: 2 * SQUARES, 24: 2 * SQUARES, 13: SQUARES + 2 * 2 * 3}
close = 1e-9


def near(expected, slack=close):
    return lambda found: bool(np.all(np.abs(np.asarray(found) - expected) <= slack))


def no_displacement(points):
    return np.zeros((len(points), 3))


def no_stress(points):
    return np.zeros((len(points), 6))


def run_of(name, *bodies, **more):
    write_run(options.work / name, [Part(f"body_{i}", body) for i, body in enumerate(bodies)], no_displacement, no_stress, **more)
    return RunFolder(options.work / name)


def areas(points, triangles):
    a, b, c = (points[triangles[:, k]] for k in range(3))
    return 0.5 * np.cross(b - a, c - a)


def volume(points, triangles):
    """Volume by the divergence theorem: positive if the triangles are anticlockwise seen from outside."""
    return np.einsum("ij,ij->", areas(points, triangles), points[triangles].mean(axis=1)) / 3


def linear(points):
    return 1.5 * points[:, 0] - 2.0 * points[:, 1] + 0.5 * points[:, 2] + 3.0


def outside():
    for kind, faces in OUTSIDE.items():
        run = run_of(f"box_{kind}", brick(kind, (0, 0, 0), SIZES, DIVISIONS), ranks=2)
        surface = Surface(run.fields)
        points = surface.at(run.fields.points)
        check(f"cells {kind}: faces outside", surface.faces, faces)
        check(f"cells {kind}: area", np.linalg.norm(areas(points, surface.triangles), axis=1).sum(), near(2 * (4 * 3 + 3 * 2 + 4 * 2)))
        check(f"cells {kind}: seen from outside anticlockwise", volume(points, surface.triangles), near(4 * 3 * 2))
        creases = points[surface.edges[surface.creases()]]
        check(f"cells {kind}: length of the edges of a box", np.linalg.norm(creases[:, 1] - creases[:, 0], axis=1).sum(),
              near(4 * (4 + 3 + 2)))
        check(f"cells {kind}: values at vertices", surface.at(linear(run.fields.points)) - linear(points), near(0.0))
        view = view_from(DEFAULT)
        flat, outline = view.flat(points), view.flat(np.array([[0, 0, 0], [4, 0, 0], [4, 3, 0], [4, 3, 2], [0, 3, 2], [0, 0, 2.0]]))
        around = np.linalg.norm(np.roll(outline, -1, axis=0) - outline, axis=1).sum()
        contour = flat[surface.contours(points, view.toward)]
        check(f"cells {kind}: the contour of a box is a hexagon", np.linalg.norm(contour[:, 1] - contour[:, 0], axis=1).sum(), near(around))
        check(f"cells {kind}: on which one looks once", np.maximum(areas(points, surface.triangles) @ view.toward, 0).sum(),
              near(0.5 * np.cross(outline, np.roll(outline, -1, axis=0)).sum()))
    two = run_of("two", brick(12, (0, 0, 0), (1, 1, 1), (2, 2, 2)), brick(12, (0, 0, 1), (1, 1, 2), (2, 2, 2)))
    check("bodies without common nodes: both sides are on the surface", Surface(two.fields).faces, 2 * 6 * 4)
    for kind, slack in ((25, 5e-3), (29, 5e-3), (24, 1e-2)):
        run = run_of(f"ball_{kind}", brick(kind, (-1, -1, -1), (1, 1, 1), (8, 8, 8)).moved(ball))
        surface = Surface(run.fields)
        points = surface.at(run.fields.points)
        check(f"ball of cells {kind}: area", np.linalg.norm(areas(points, surface.triangles), axis=1).sum() / (4 * np.pi), near(1.0, slack))
        check(f"ball of cells {kind}: no edges", len(surface.creases()), 0)


def groups():
    space_scenes.blocks(options.work / "blocks", CELLS[12].faces, n=4)
    run = RunFolder(options.work / "blocks")
    surface = Surface(run.fields)
    points = surface.at(run.fields.points)
    for name, axis, at, area in (("top", 2, 10, 100), ("bottom", 2, 0, 100), ("east", 0, 10, 50), ("south", 1, 0, 50)):
        own = surface.triangles[surface.of_group(run.fields.side_groups[name])]
        check(f"group {name}: place", points[own][:, :, axis], near(at))
        check(f"group {name}: area", np.linalg.norm(areas(points, own), axis=1).sum(), near(area))


def projection():
    view = view_from(DEFAULT)
    check("the eye's direction is a point", view.flat(np.array([DEFAULT])), near(0.0))
    check("the view is a rotation", np.stack([view.right, view.up, view.toward]) @ np.stack([view.right, view.up, view.toward]).T,
          near(np.eye(3)))
    check("x points to the right, z upward", (view.flat(np.eye(3))[0, 0] > 0, view.flat(np.eye(3))[2, 1] > 0), (True, True))
    expected = [1.4 / np.sqrt(1 + 1.96), -0.9 / np.sqrt((1 + 1.96) * (1 + 1.96 + 0.81))]
    check("x in the picture, by hand", view.flat(np.array([[1.0, 0, 0]]))[0], near(expected))
    for toward, right, up in (((0, 0, 1), 0, 1), ((1, 0, 0), 1, 2), ((0, -1, 0), 0, 2)):
        view = view_from(toward)
        check(f"seen from {toward}", (view.right, view.up), lambda found, right=right, up=up: np.array_equal(found, np.eye(3)[[right, up]]))
        check(f"seen from {toward}: names", view.axes(), ("xyz"[right], "xyz"[up]))


def patch(rng, n):
    """A triangulated square with randomly moved nodes."""
    points, cells = space_scenes.lattice(np.linspace(0, 1, n), np.linspace(0, 1, n), lambda a, b: np.column_stack([a, b]))
    inner = (points > 0).all(axis=1) & (points < 1).all(axis=1)
    points[inner] += rng.uniform(-0.3, 0.3, (inner.sum(), 2)) / n
    return points, np.concatenate([cells[:, [0, 1, 2]], cells[:, [0, 2, 3]]])


def rasteriser():
    rng = np.random.default_rng(4)
    points, triangles = patch(rng, 14)
    raster = Raster((-0.1, -0.1), (1.1, 1.1), (240, 360))
    raster.draw(points, np.zeros(len(points)), triangles)
    check("a square without gaps", len(raster.samples), 200 * 300)
    values = 2 * points[:, 0] - 3 * points[:, 1] + 1
    places = raster.places()
    off = raster.interpolate(values[triangles]) - (2 * places[:, 0] - 3 * places[:, 1] + 1)
    check("a linear function is reproduced", off, near(0.0, 1e-6))
    corners = points[triangles[raster.shown]]
    inside = np.stack([np.cross(corners[:, (k + 1) % 3] - corners[:, k], places - corners[:, k]) for k in range(3)])
    check("each sample is in its triangle", inside.min(), lambda found: found > -1e-12)
    # Two intersecting squares: the nearer one is visible, independent of the drawing order.
    square, two = np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]]), np.array([[0, 1, 2], [0, 2, 3]])
    for flipped in (False, True):
        raster = Raster((0, 0), (1, 1), (100, 100))
        slopes = [square[:, 0] - 0.5, 0.5 - square[:, 0]]
        for slope in slopes[::-1] if flipped else slopes:
            raster.draw(square, slope, two)
        left = (raster.triangle[:, :50] >= 2) == (not flipped)
        check(f"the nearer is seen, {'second' if flipped else 'first'} drawn first", (left.mean(), raster.near.min() > 0), (1.0, True))
    raster = Raster((0, 0), (1, 1), (10, 20))
    raster.draw(square, square @ [2.0, 3.0], two)
    check("nearness at the middles of samples", raster.near.reshape(-1) - raster.places() @ [2.0, 3.0], near(0.0, 1e-6))
    raster = Raster((0, 0), (1, 1), (50, 50))
    raster.draw(square, np.zeros(4), two[:, ::-1])
    check("faces that point away are not seen", len(raster.samples), 0)
    # A segment behind a square with sides of 0.5, and one in front of it.
    raster = Raster((-1, -1), (1, 1), (400, 400))
    raster.draw(0.5 * square - 0.25, np.zeros(4), two)
    for depth, length in ((-0.5, 1.5), (0.5, 2.0)):
        parts = visible_parts(raster, np.array([[-1.0, 0, depth]]), np.array([[1.0, 0, depth]]), 0.02)
        check(f"a line at {depth:+}", np.linalg.norm(parts[:, 1] - parts[:, 0], axis=1).sum(), near(length, 0.03))


def colours():
    raster = Raster((0, 0), (4, 4), (4, 4))
    raster.draw(np.array([[0, 0], [2.6, 0], [2.6, 4], [0, 4.0]]), np.zeros(4), np.array([[0, 1, 2], [0, 2, 3]]))
    import matplotlib
    viridis = matplotlib.colormaps["viridis"]
    image = picture(raster, coloured(np.full(len(raster.samples), 7.0), 0.0, 7.0, viridis))
    check("opacity: the sample in the middle of a pixel", image[1, :, 3].tolist(), [255, 255, 255, 0])
    check("colour of the largest value", image[1, 1, :3] / 255, near(viridis(1.0)[:3], 1 / 255))
    half = raster.resampled((0, 0), (8, 4), (4, 8))
    check("another region: the same samples, then none", (half.triangle[:, :4].tolist(), (half.triangle[:, 4:] < 0).all()), (raster.triangle.tolist(), True))
    check("another region: a linear function", half.interpolate(np.array([[0, 2.6, 2.6], [0, 2.6, 0]])) - half.places()[:, 0], near(0.0, 1e-6))
    check("an unknown value is grey", coloured(np.array([np.nan]), 0.0, 1.0, viridis)[0], near(0.75, 1e-6))


def cuts():
    for kind in OUTSIDE:
        run = run_of(f"cut_{kind}", brick(kind, (0, 0, 0), SIZES, DIVISIONS), ranks=2)
        grid = run.fields
        for axis, value in ((0, 1.3), (0, 2.0), (1, 0.0), (2, 2.0), (2, 1.0)):  # between nodes, on nodes, on the boundary
            cut = Cut(grid, Plane(axis, value), {"linear": linear(grid.points)})
            flat = cut.corners.reshape(-1, 3)
            own = 0.5 * np.cross(cut.flat[:, 1] - cut.flat[:, 0], cut.flat[:, 2] - cut.flat[:, 0])
            name = f"cells {kind}, {'xyz'[axis]} = {value}"
            check(f"{name}: on the plane", flat[:, axis], near(value, 1e-6))
            check(f"{name}: area, anticlockwise", own.sum(), near(np.prod(SIZES) / SIZES[axis], 1e-5))
            check(f"{name}: none turns clockwise", own.min(), lambda found: found >= -1e-15)
            check(f"{name}: a linear field", cut.values["linear"].reshape(-1) - linear(flat), near(0.0))
    run = run_of("cut_ball", brick(29, (-1, -1, -1), (1, 1, 1), (6, 6, 6)).moved(ball))
    for value in (0.0, 0.37, -0.8):
        cut = Cut(run.fields, Plane(1, value), {})
        own = 0.5 * np.cross(cut.flat[:, 1] - cut.flat[:, 0], cut.flat[:, 2] - cut.flat[:, 0]).sum()
        check(f"ball, y = {value}: area of the circle", own / (np.pi * (1 - value**2)), near(1.0, 0.02))
        surface = Surface(run.fields)
        lines, _ = cut.lines(surface.at(run.fields.points), surface.triangles)
        around = np.linalg.norm(lines[:, 1] - lines[:, 0], axis=1).sum()
        check(f"ball, y = {value}: length of the circle", around / (2 * np.pi * np.sqrt(1 - value**2)), near(1.0, 0.01))


def contacts():
    run = RunFolder(options.work / "blocks")
    plane = chosen_plane(run, None)
    largest = run.contact.points[np.argmax(run.contact.point_data["ContactPressure"])]
    check("the plane passes through the largest pressure", (plane.axis, plane.value), (0, largest[0]))
    check("the requested plane", vars(chosen_plane(run, (2, 7.5)))["value"], 7.5)
    flat = Chart(contact_surfaces(run)[0])
    lengths = np.ptp(flat.flat.reshape(-1, 2), axis=0).round(9).tolist()
    check("a horizontal contact is seen from above", (flat.names, lengths), (("x", "y"), [10.0, 10.0]))
    space_scenes.pin_in_eye(options.work / "pin", around=12)
    bearing, fault, closed = contact_surfaces(RunFolder(options.work / "pin"))
    chart = Chart(bearing)
    width, height = np.ptp(chart.flat.reshape(-1, 2), axis=0)
    check("unrolled: the whole way round", width / (2 * np.pi * 5), near(1.0, 1e-2))
    check("unrolled: along the axis", (height, chart.names), (6.0, ("arc length", "z")))
    sizes = 0.5 * np.abs(np.cross(chart.flat[:, 1] - chart.flat[:, 0], chart.flat[:, 2] - chart.flat[:, 0])).sum()
    check("unrolled: no triangle lies twice", sizes / (2 * np.pi * 5 * 6), near(1.0, 1e-2))
    peak = chart.flat.reshape(-1, 2)[np.argmax(bearing.pressure[bearing.triangles].reshape(-1)), 0]
    check("unrolled: the largest pressure is at zero", peak, near(0.0))
    ends = bearing.points[bearing.triangles[bearing.border()[0]]][:, :2, 2]
    check("a surface all round has its border at both ends only", np.unique(ends), near([0, 6]))
    chart = Chart(fault)
    lengths = sorted(np.ptp(chart.flat.reshape(-1, 2), axis=0).round(9).tolist())
    check("inclined: no ruled axes, lengths as they are", (chart.names, lengths), (None, [4.0, 20.0]))
    check("a closed contact", (closed.open, closed.pairs, Chart(closed).names), (0, 217, ("y", "z")))
    bearing.points += [3, -2, 1]
    check("unrolled: about an axis elsewhere", np.ptp(Chart(bearing).flat.reshape(-1, 2), axis=0), near([width, height]))


def centres():
    """Values at midpoints are exact for functions that the shape can represent."""
    for kind, shape in CELLS.items():
        body, second = brick(kind, (0, 0, 0), (1, 1, 1), (1, 1, 1)), kind in (24, 25, 29)
        nodes = body.points[body.cells]

        def function(p):
            return linear(p) + second * (p[..., 0] * p[..., 1] - 2 * p[..., 2]**2)

        def linear(p):
            return p @ [1.5, -2.0, 0.5] + 3.0

        middle = nodes[:, :shape.vertices].mean(axis=1)
        check(f"cells {kind}: value in the middle", function(nodes) @ shape.centre - function(middle), near(0.0))
        for face in shape.faces:
            if FACES[len(face)].centre is not None:
                own = nodes[:, face]
                found = function(own) @ FACES[len(face)].centre
                check(f"cells {kind}: value in the middle of a face", found - function(own[:, :4].mean(axis=1)), near(0.0))


def image_files():
    """Another program reads the same picture; the odd width leaves no multiple of four bytes in a row."""
    random = np.random.default_rng(1)
    drawn = np.repeat(random.integers(0, 256, (31, 19, 4), dtype=np.uint8), 3, axis=1)
    for name, rows in (("whole", slice(None)), ("part", slice(3, 20))):
        path = write_png(options.work / f"{name}.png", drawn[rows, 5:50, :3], 170)
        with Image.open(path) as read:
            check(f"png {name}: pixels", read.mode == "RGB" and np.array_equal(np.array(read), drawn[rows, 5:50, :3]), True)
            check(f"png {name}: pixels per inch", read.info["dpi"], near((170.0, 170.0), 0.02))


def points_in_boxes():
    random = np.random.default_rng(2)
    cloud, points = Cloud(), np.zeros((0, 2))
    check("no points", (cloud.count(Rectangle(0, 0, 1, 1)), len(cloud)), (0, 0))
    for count in (1, 200, 30):
        added = np.round(random.random((count, 2)), 1)  # many on the edges of boxes
        cloud.add(added)
        points = np.vstack([points, added])
        for _ in range(50):
            (x0, x1), (y0, y1) = np.round(np.sort(random.random((2, 2)), axis=1), 1)
            expected = points[(points[:, 0] > x0) & (points[:, 0] < x1) & (points[:, 1] > y0) & (points[:, 1] < y1)]
            box = Rectangle(x0, y0, x1, y1)
            if cloud.count(box) != len(expected) or sorted(map(tuple, cloud.inside(box))) != sorted(map(tuple, expected)):
                check(f"points in a box of {len(points)}", (x0, y0, x1, y1), "the same points as by comparing all")
    check("points in all boxes", len(cloud), 231)


for part in (image_files, points_in_boxes, centres, outside, groups, projection, rasteriser, colours, cuts, contacts):
    part()
finish()
