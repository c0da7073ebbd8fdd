"""Exodus (.e, .exo, .ex2; netCDF): blocks, node sets and side sets."""
import pathlib

import numpy as np

from .cells import vertices_of
from .foreign import ConvertError, Foreign

SHAPES = {("TET", 4): "tetra", ("TET", 10): "tetra10", ("HEX", 8): "hexahedron", ("HEX", 20): "hexahedron20", ("HEX", 27): "hexahedron27",
          ("WED", 6): "wedge", ("PYR", 5): "pyramid", ("TRI", 3): "triangle", ("TRI", 6): "triangle6", ("QUA", 4): "quad", ("QUA", 8): "quad8", ("QUA", 9): "quad9", ("SHE", 4): "quad",
          ("SHE", 3): "triangle", ("SHE", 8): "quad8", ("SHE", 9): "quad9", ("SHE", 6): "triangle6"}
LINES = ("BAR", "BEA", "TRU", "EDG", "ROD")
# Sides of solids by the first letters of their shape: vertices of side 1, 2, ...
SIDES = {"tetra": [(0, 1, 3), (1, 2, 3), (0, 3, 2), (0, 2, 1)],
         "hexahedron": [(0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (0, 4, 7, 3), (0, 3, 2, 1), (4, 5, 6, 7)],
         "wedge": [(0, 1, 4, 3), (1, 2, 5, 4), (0, 3, 5, 2), (0, 2, 1), (3, 4, 5)],
         "pyramid": [(0, 1, 4), (1, 2, 4), (2, 3, 4), (0, 4, 3), (0, 3, 2, 1)]}


def names(file, what, ids, default):
    """Names of blocks or sets; "<default> <id>" for unnamed ones."""
    given = [""] * ids
    if what + "_names" in file.variables:
        given = [bytes(np.ma.filled(row, b"\0").tobytes()).split(b"\0")[0].decode("utf-8", "replace").strip() for row in file.variables[what + "_names"][:]]
    numbers = file.variables[what + "_prop1"][:] if what + "_prop1" in file.variables else range(1, ids + 1)
    return [name or f"{default} {number}" for name, number in zip(given, numbers)]


def read(path):
    import netCDF4

    if not pathlib.Path(path).is_file():
        raise ConvertError(f"{path}: No such file")
    try:
        file = netCDF4.Dataset(path)
    except OSError as error:
        raise ConvertError(f"{path}: is not an Exodus file ({error.strerror or error})") from error
    with file:
        file.set_auto_mask(False)
        sizes = {name: len(dimension) for name, dimension in file.dimensions.items()}
        data = file.variables
        if "num_nodes" not in sizes or "num_el_blk" not in sizes:
            raise ConvertError(f"{path}: is a netCDF file, but not an Exodus file (it lacks num_nodes or num_el_blk)")
        if "coord" in data:
            points = data["coord"][:].T
        else:
            points = np.column_stack([data[name][:] for name in ("coordx", "coordy", "coordz") if name in data])
        mesh = Foreign(points)
        rows, sides, offset = [], [], []  # per element: nodes, vertices of each side, number of its first side
        for number, name in enumerate(names(file, "eb", sizes["num_el_blk"], "block"), 1):
            if f"connect{number}" not in data:
                continue
            connect = data[f"connect{number}"]
            shape, nodes = connect.elem_type.upper()[:3], connect[:] - 1
            kind = ("line" if nodes.shape[1] == 2 else "line3") if shape in LINES else SHAPES.get((shape, nodes.shape[1]), connect.elem_type)
            mesh.add_to(mesh.groups, name, mesh.add_block(kind, nodes))
            edges = range(vertices_of(kind)) if kind.startswith(("triangle", "quad")) else ()
            rows += list(nodes)
            sides += [SIDES.get(kind.rstrip("0123456789"), [(k, (k + 1) % len(edges)) for k in edges])] * len(nodes)
            offset += [3 if shape == "SHE" or connect.elem_type.upper().startswith("TRISHELL") else 1] * len(nodes)
        for number, name in enumerate(names(file, "ns", sizes.get("num_node_sets", 0), "nodes"), 1):
            if f"node_ns{number}" in data:
                mesh.add_to(mesh.node_sets, name, data[f"node_ns{number}"][:] - 1)
        for number, name in enumerate(names(file, "ss", sizes.get("num_side_sets", 0), "sides"), 1):
            if f"elem_ss{number}" not in data:
                continue
            found = []
            for element, side in zip(data[f"elem_ss{number}"][:] - 1, data[f"side_ss{number}"][:]):
                own = sides[element]
                side -= offset[element]
                if not 0 <= side < len(own):
                    raise ConvertError(f"{path}: side set '{name}': element {element + 1} has no side {side + offset[element]}")
                found.append(rows[element][list(own[side])])
            mesh.side_sets[name] = found
    return mesh
