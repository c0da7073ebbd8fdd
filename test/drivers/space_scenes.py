"""3D runs for the picture tests: two blocks, a ball on a block, a pin in an eye. Fields are formulas, not solutions."""
import numpy as np

from space_samples import Body, Part, Surface, ball, brick, sides, write_run

WIDE = 3.0  # radius of the closed part of both contacts


def bump(points, centre, width):
    return np.exp(-(((points - centre) / width)**2).sum(axis=1))


def lattice(u, v, place):
    """(points, quadrilaterals) of a grid; `place` maps both coordinates to points."""
    a, b = np.meshgrid(u, v, indexing="ij")
    i = np.arange(a.size).reshape(a.shape)
    return place(a.ravel(), b.ravel()), np.stack([i[:-1, :-1], i[1:, :-1], i[1:, 1:], i[:-1, 1:]], axis=-1).reshape(-1, 4)


def blocks(folder, faces, n=8, **more):
    """Two stacked blocks of hexahedra with eight subdomains on two ranks. `faces`: faces of a hexahedron."""
    lower, upper = brick(12, (0, 0, 0), (10, 10, 5), (n, n, n // 2)), brick(12, (0, 0, 5), (10, 10, 10), (n, n, n // 2))
    centre, place = np.array([4.5, 5.5, 5.0]), np.linspace(0, 10, n + 1)

    def displacement(p):
        e = bump(p, centre, [WIDE, WIDE, 2])
        return np.column_stack([2e-4 * (p[:, 0] - 5) * p[:, 2], 2e-4 * (p[:, 1] - 5) * p[:, 2], -1e-3 * p[:, 2] - 4e-3 * e])

    def stress(p):
        e = bump(p, centre, [WIDE, WIDE, 2])
        return np.column_stack([p[:, 0] - 5 - 20 * e, -25 * e, -120 * e - 10, 10 * e * (p[:, 0] - 4.5), 8 * e * (p[:, 1] - 5.5), 5 * e])

    points, cells = lattice(place, place, lambda x, y: np.column_stack([x, y, np.full(len(x), 5.0)]))
    r2 = ((points[:, :2] - centre[:2])**2).sum(axis=1) / WIDE**2
    contact = Surface("joint", points, cells, np.tile([0.0, 0, 1], (len(points), 1)), 0.01 * np.maximum(r2 - 1, 0),
                      120 * np.sqrt(np.maximum(1 - r2, 0)),
                      {"Side A": ["lower_top"], "Side B": ["upper_bottom"]})
    groups = {name: sides(body, faces, lambda p, axis=axis, at=at: np.abs(p[:, axis] - at) < 1e-9)
              for name, body, axis, at in (("top", upper, 2, 10), ("bottom", lower, 2, 0), ("east", upper, 0, 10), ("south", lower, 1, 0))}
    given = {"press down": {"Type": "Displacement", "Value": [0, 0, -0.01], "Group": ["top"]},
             "clamp": {"Type": "Displacement", "Value": [0, 0, 0], "Group": ["bottom"]},
             "wind": {"Type": "Pressure", "Value": [3.0], "Group": ["east"]},
             "pull": {"Type": "Traction", "Value": [1.0, -2.0, 0.0], "Group": ["south"]},
             "weight": {"Type": "Gravity", "Value": [0, 0, -9.81]}}

    def quarter(c):
        return (c[:, 0] > 5) + 2 * (c[:, 1] > 5)

    write_run(folder, [Part("lower", lower, quarter), Part("upper", upper, quarter)], displacement, stress, [contact], ranks=2,
              side_groups=groups,
              parameters={"Boundary Conditions": given}, title="Two blocks", **more)


def ball_on_block(folder, faces, triangles, n=4, **more):
    """A curved ball of second-order tetrahedra on a block of 20-node hexahedra.

    `faces`: faces of the tetrahedron, `triangles`: triangles of each face.
    """
    radius = 8.0
    sphere = brick(24, (-1, -1, -1), (1, 1, 1), (n, n, n)).moved(lambda p: radius * ball(p) + [0, 0, radius])
    block = brick(25, (-12, -10, -8), (12, 10, 0), (6, 5, 2))
    nodes = np.concatenate([sphere.cells[:, face] for face in faces])
    place = sphere.points[nodes]
    on = (np.abs(np.linalg.norm(place - [0, 0, radius], axis=2) - radius) < 1e-6).all(axis=1) & (place[:, :, 2].max(axis=1) < 0.6 * radius)
    used, cells = np.unique(nodes[on][:, triangles].reshape(-1, 3), return_inverse=True)
    points = sphere.points[used]
    r2 = (points[:, :2]**2).sum(axis=1) / WIDE**2
    contact = Surface("ball on block with a name that is long", points, cells.reshape(-1, 3), np.tile([0.0, 0, -1], (len(points), 1)),
                      0.4 * np.maximum(r2 - 1, 0), 900 * np.sqrt(np.maximum(1 - r2, 0)), {"Side A": ["ball_low"], "Side B": ["block_top"]})

    def displacement(p):
        e = bump(p, 0, 4)
        return np.column_stack([0.02 * p[:, 0] * e, 0.02 * p[:, 1] * e, np.where(p[:, 2] > 1e-9, 0.15 * e - 0.25, -0.1 * e)])

    def stress(p):
        e, wide = bump(p, 0, 2.5), bump(p, [0, 0, -2], 5)
        return np.column_stack([-300 * e - 40 * wide, -300 * e - 40 * wide, -900 * e - 100 * wide, 0 * e, 80 * e * p[:, 1],
                                80 * e * p[:, 0] + 10])

    write_run(folder, [Part("ball", sphere, lambda c: c[:, 0] > 0), Part("block", block, lambda c: (c[:, 0] > -3) + 1 * (c[:, 0] > 3))],
              displacement,
              stress, [contact], title="Ball on a block", **more)


def ring(kind, inner, outer, low, high, divisions):
    """A hollow cylinder about z. `divisions`: across, around, along."""
    def bent(p):
        return np.column_stack([p[:, 0] * np.cos(p[:, 1]), p[:, 0] * np.sin(p[:, 1]), p[:, 2]])

    body = brick(kind, (inner, 0, low), (outer, 2 * np.pi, high), divisions).moved(bent)
    _, first, number = np.unique(np.round(body.points, 9) + 0.0, axis=0, return_index=True, return_inverse=True)
    return Body(kind, body.points[first], number.reshape(-1)[body.cells])


def pin_in_eye(folder, around=24, **more):
    """An eye of 27-node hexahedra around a pin of wedges, with cell stresses only.

    Contacts around the pin, on an inclined plane, and at x = 0 (without a gap).
    """
    eye, pin = ring(29, 5, 10, 0, 6, (2, around, 2)), ring(13, 1.5, 5, -4, 10, (2, around, 5))
    angle = np.arange(2 * around + 1) * np.pi / around
    points, cells = lattice(angle, np.linspace(0, 6, 7), lambda a, z: np.column_stack([5 * np.cos(a), 5 * np.sin(a), z]))
    points, cells = points[:-7], cells % (len(points) - 7)
    load = np.maximum(points[:, 0] * np.cos(0.4) + points[:, 1] * np.sin(0.4) - 1, 0)
    bearing = Surface("bearing", points, cells, points / [5, 5, 1] * [1, 1, 0], np.where(load > 0, 0.0, 0.02), load * (30 + points[:, 2]))
    along, across = np.array([0.8, 0, 0.6]), np.array([0.0, 1, 0])
    points, cells = lattice(np.linspace(0, 20, 31), np.linspace(0, 4, 7), lambda u, v: u[:, None] * along + v[:, None] * across)
    wave = np.sin(points @ along / 3)
    fault = Surface("fault", points, cells, np.tile(np.cross(along, across), (len(points), 1)), 1e-3 * np.maximum(-wave, 0),
                    5 * np.maximum(wave, 0))
    upright = Surface("closed", points[:, ::-1] * [0, 1, 1], cells, np.tile([1.0, 0, 0], (len(points), 1)), 0 * wave, 5 + wave)

    def stress(p):
        s = 100 * (5 / np.hypot(p[:, 0], p[:, 1]))**2
        return np.column_stack([-s, s, 0 * s, 0.3 * s * p[:, 0] / 10, 0 * s, 0 * s])

    def displacement(p):
        return np.column_stack([5e-4 * p[:, 2]**2, 0 * p[:, 0], 0 * p[:, 0]])

    write_run(folder, [Part("eye", eye, lambda c: (c[:, 0] > 0) + 2 * (c[:, 1] > 0)), Part("pin", pin)], displacement, stress,
              [bearing, fault, upright], title="Pin in an eye", nodal=False, **more)
