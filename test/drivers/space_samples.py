"""Writes folders of 3D runs with fields given by formulas: the same files as suture_solve writes, without solving.

    body = brick(12, low=(0, 0, 0), high=(1, 1, 0.5), divisions=(4, 4, 2))
    write_run(folder, [Part("lower", body, subdomain=0), ...], displacement, stress, contacts)
"""
import itertools
import json
from dataclasses import dataclass, field

import h5py
import numpy as np

UNITS = ("mm", "N", "MPa")


@dataclass
class Body:
    """Cells of one kind: `points`, and nodes per cell `cells` in the order of the files."""
    kind: int
    points: np.ndarray
    cells: np.ndarray

    def moved(self, function):
        """The same cells at other places; mid-side nodes move with them."""
        return Body(self.kind, function(self.points), self.cells)


CORNERS = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2)]
EDGES = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
MIDDLES = [tuple((a + b) // 2 for a, b in zip(CORNERS[i], CORNERS[j])) for i, j in EDGES]
CENTRES = [(0, 1, 1), (2, 1, 1), (1, 0, 1), (1, 2, 1), (1, 1, 0), (1, 1, 2), (1, 1, 1)]


def tetrahedra():
    """Kuhn's six tetrahedra of a cube, vertices and edge midpoints."""
    for order in itertools.permutations(range(3)):
        corners = [np.zeros(3, dtype=int)]
        for axis in order:
            corners.append(corners[-1] + 2 * np.eye(3, dtype=int)[axis])
        if np.linalg.det(np.array(corners[1:]) - corners[0]) < 0:
            corners[1], corners[2] = corners[2], corners[1]
        edges = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]
        yield [tuple(c) for c in corners] + [tuple((corners[a] + corners[b]) // 2) for a, b in edges]


def cells_of_cube(kind):
    """Node positions of the cells in one cube of the lattice, 0 to 2 along each axis."""
    if kind in (10, 24):
        return [nodes[:4 if kind == 10 else 10] for nodes in tetrahedra()]
    if kind == 13:
        return [[(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2)],
                [(0, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 2, 2), (0, 2, 2)]]
    if kind == 14:
        sides = [(0, 3, 7, 4), (1, 5, 6, 2), (0, 4, 5, 1), (3, 2, 6, 7), (0, 1, 2, 3), (4, 7, 6, 5)]  # anticlockwise seen from the centre
        return [[CORNERS[i] for i in side] + [(1, 1, 1)] for side in sides]
    return [{12: CORNERS, 25: CORNERS + MIDDLES, 29: CORNERS + MIDDLES + CENTRES}[kind]]


def brick(kind, low, high, divisions):
    """A box of cells of a kind."""
    n = np.array(divisions)
    lattice = 2 * n + 1
    cubes = 2 * np.stack(np.meshgrid(*(np.arange(k) for k in n), indexing="ij"), axis=-1).reshape(-1, 3)
    shapes = np.array(cells_of_cube(kind))
    places = (cubes[:, None, None, :] + shapes[None]).reshape(-1, shapes.shape[1], 3)
    number = (places[..., 0] * lattice[1] + places[..., 1]) * lattice[2] + places[..., 2]
    used, cells = np.unique(number, return_inverse=True)
    index = np.stack(np.unravel_index(used, lattice), axis=-1)
    return Body(kind, np.array(low) + (np.array(high) - low) * index / (2 * n), cells.reshape(number.shape))


def sides(body, faces, where):
    """Rows of a side group: the first two vertices of each face where `where` holds at all vertices. `faces`: faces of a cell."""
    rows = []
    for face in faces:
        corners = body.points[body.cells[:, face[:4 if len(face) in (4, 8, 9) else 3]]]
        rows.append(corners[where(corners.reshape(-1, 3)).reshape(corners.shape[:2]).all(axis=1)][:, :2].reshape(-1, 6))
    return np.concatenate(rows)


def ball(points):
    """The cube from -1 to 1 as the unit ball."""
    x, y, z = points.T
    return np.column_stack([a * np.sqrt(1 - b**2 / 2 - c**2 / 2 + b**2 * c**2 / 3) for a, b, c in ((x, y, z), (y, z, x), (z, x, y))])


@dataclass
class Part:
    name: str
    body: Body
    subdomains: object = None  # function of the cell centres: numbers from 0


@dataclass
class Surface:
    """Contact surface: points, cells of three or four points, and values at the points."""
    name: str
    points: np.ndarray
    cells: np.ndarray
    normal: np.ndarray
    gap: np.ndarray
    pressure: np.ndarray
    given: dict = field(default_factory=dict)


def grid_file(path, points, blocks, point_data, cell_data, record):
    """A VTKHDF file with one partition per list entry. `blocks`: [(kind, cells)] of each."""
    with h5py.File(path, "w") as file:
        root = file.create_group("VTKHDF")
        root.attrs["Version"] = np.array([1, 0])
        root.attrs["Type"] = np.bytes_("UnstructuredGrid")
        counts = [sum(len(cells) for _, cells in own) for own in blocks]
        ids = [sum(cells.size for _, cells in own) for own in blocks]
        root["NumberOfPoints"], root["NumberOfCells"] = np.array([len(p) for p in points]), np.array(counts)
        root["NumberOfConnectivityIds"] = np.array(ids)
        root["Points"] = np.concatenate(points)
        root["Connectivity"] = np.concatenate([cells.reshape(-1) for own in blocks for _, cells in own])
        ends = [np.cumsum([cells.shape[1] for _, cells in own for _ in cells]) for own in blocks]
        root["Offsets"] = np.concatenate([np.concatenate([[0], own]) for own in ends])
        root["Types"] = np.concatenate([np.full(len(cells), kind, dtype=np.uint8) for own in blocks for kind, cells in own])
        for group, data in (("PointData", point_data), ("CellData", cell_data)):
            root.create_group(group)
            for name, (values, unit) in data.items():
                root[group][name] = np.concatenate(values)
                root[group][name].attrs["unit"] = unit
        file.create_group("Record")
        for name, value in record.items():
            if isinstance(value, dict):
                for own, sides in value.items():
                    file[f"Record/{name}/{own}"] = sides
            else:
                file[f"Record/{name}"] = json.dumps(value) if isinstance(value, list) else value


def von_mises(s):
    xx, yy, zz, xy, yz, xz = s.T
    return np.sqrt(0.5 * ((xx - yy)**2 + (yy - zz)**2 + (zz - xx)**2) + 3 * (xy**2 + yz**2 + xz**2))


def principal(s):
    """Largest first; NaN if a component is NaN."""
    tensor = np.nan_to_num(s)[:, [0, 3, 5, 3, 1, 4, 5, 4, 2]].reshape(-1, 3, 3)
    return np.where(np.isnan(s).any(axis=1)[:, None], np.nan, np.linalg.eigvalsh(tensor)[:, ::-1])


def stresses(prefix, found):
    """The fields of stresses, `found` on each rank."""
    return {f"{prefix}Stress": (found, UNITS[2]), f"{prefix}VonMises": ([von_mises(s) for s in found], UNITS[2]),
            f"{prefix}PrincipalStress": ([principal(s) for s in found], UNITS[2])}


def write_run(folder, parts, displacement, stress, contacts=(), ranks=1, nodal=True, side_groups=None, parameters=None, **summary):
    """Writes the files. `displacement`, `stress`: functions of points. With two ranks the cells are cut in the middle of each body."""
    folder.mkdir(parents=True, exist_ok=True)
    points, blocks, ids, data = [], [], [], {"Body": [], "Subdomain": [], "Material": []}
    centres, first, subdomains = [], 0, []
    for number, part in enumerate(parts):
        centre = part.body.points[part.body.cells].mean(axis=1)
        own = part.subdomains(centre).astype(int) if part.subdomains else np.zeros(len(centre), dtype=int)
        for rank in range(ranks):
            mine = (np.arange(len(centre)) * ranks // len(centre)) == rank
            used, local = np.unique(part.body.cells[mine], return_inverse=True)
            points.append(part.body.points[used])
            blocks.append([(part.body.kind, local.reshape(-1, part.body.cells.shape[1]))])
            ids.append(first + used)
            data["Body"].append(np.full(mine.sum(), number))
            data["Material"].append(np.full(mine.sum(), number))
            data["Subdomain"].append(len(subdomains) + own[mine])
            centres.append(centre[mine])
        subdomains += [f"subdomain_{part.name}_{s}" for s in range(own.max() + 1)]
        first += len(part.body.points)
    at_points = {"Displacement": ([displacement(p) for p in points], UNITS[0]), "NodeId": (ids, "1")}
    if nodal:
        at_points.update(stresses("Nodal", [stress(p) for p in points]))
    at_cells = {**stresses("", [stress(c) for c in centres]), **{name: (values, "1") for name, values in data.items()}}
    names = [part.name for part in parts]
    grid_file(folder / "fields_0000.vtkhdf", points, blocks, at_points, at_cells,
              {"Bodies": names, "Subdomains": subdomains, "SideGroups": side_groups or {}, "MeshHash": "abcd", "Input": "<ParameterList/>"})
    if contacts:
        write_contacts(folder / "contact_0000.vtkhdf", contacts)
    at = np.concatenate(points if nodal else centres)
    write_summary(folder, parts, at, np.concatenate(points), displacement, stress, contacts, sum(len(c) for c in centres),
                  parameters or {}, summary)


def write_contacts(path, contacts):
    """contact_0000.vtkhdf: a partition, cells of all surfaces."""
    start = np.cumsum([0] + [len(c.points) for c in contacts])
    count = [len(c.points) for c in contacts]
    joint = {name: np.concatenate([getattr(c, name) for c in contacts]) for name in ("points", "normal", "gap", "pressure")}
    line = np.repeat(np.arange(len(contacts)), count)
    fields = {"Gap": (joint["gap"], UNITS[0]), "InitialGap": (np.maximum(joint["gap"], 0.0), UNITS[0]),
              "ContactPressure": (joint["pressure"], UNITS[2]),
              "ContactForce": (joint["pressure"], UNITS[1]), "ArcLength": (np.zeros(len(line)), UNITS[0]),
              "Active": ((joint["pressure"] > 0).astype(np.uint8), "1"), "Touching": (np.zeros(len(line), dtype=np.uint8), "1"),
              "Displacement": (np.zeros((len(line), 3)), UNITS[0]), "Normal": (joint["normal"], "1"), "Pair": (np.arange(len(line)), "1"),
              "Line": (line, "1"), "Piece": (line, "1")}
    blocks = [({3: 5, 4: 9, 1: 1}[c.cells.shape[1]], c.cells + start[i]) for i, c in enumerate(contacts)]
    grid_file(path, [joint["points"]], [blocks], {name: ([values], unit) for name, (values, unit) in fields.items()}, {},
              {"ContactPieces": [c.name for c in contacts]})


def write_summary(folder, parts, at, points, displacement, stress, contacts, elements, parameters, more):
    def found(values, place, unit):
        best = int(np.nanargmax(np.abs(values)))
        return {"value": float(values[best]), "unit": unit, "body": parts[0].name, "place": place[best].tolist()}

    extremes = {"stresses": "at nodes", "von_mises": found(von_mises(stress(at)), at, UNITS[2]),
                "tension": found(np.maximum(principal(stress(at))[:, 0], 0), at, UNITS[2]),
                "compression": found(np.minimum(principal(stress(at))[:, 2], 0), at, UNITS[2]),
                "displacement": found(np.linalg.norm(displacement(points), axis=1), points, UNITS[0])}
    pieces = {c.name: {"pairs": len(c.points), "active": int((c.pressure > 0).sum()), "max_pressure": float(c.pressure.max()),
                       "max_gap": float(c.gap.max())}
              for c in contacts}
    (folder / "summary.json").write_text(json.dumps({
        "title": "Sample", "units": ", ".join(UNITS), "dimension": 3, "converged": True, "verified": True, "exit_code": 0,
        "elements": elements,
        "nodes": len(points), "dofs": 3 * len(points), "ranks": 1, "subdomains": 1, "mesh_hash": "abcd", "versions": {"suture": "0"},
        "phases": {"solve": {"min": 1.0, "avg": 1.0, "max": 1.0}},
        "outer": {"solver": "Active Set", "iterations": 3, "pcg_total": 20, "residual": 1e-9},
        "contact": {"pairs": sum(len(c.points) for c in contacts), "by_piece": pieces}, "extremes": extremes,
        "parameters": {"Model": "Solid", "Bodies": {part.name: {"Material": "steel"} for part in parts},
                       "Contact": {c.name: c.given for c in contacts}, **parameters}, **more}))
