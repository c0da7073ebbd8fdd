"""Suture's own HDF5 mesh (packages/reader/Hdf5Mesh.hpp) and Gmsh's format 4.1."""
import numpy as np

from .cells import CELLS, SIDE_KINDS
from .mesh import MOST

LINES = {"line": 1, "line3": 8}  # Gmsh's types of 2D sides


def write_h5(mesh, path):
    import h5py

    with h5py.File(path, "w") as file:
        file.attrs["SutureMesh"] = np.bytes_("1")

        def put(name, data, kind=np.int32):
            some = len(data) > 0
            return file.create_dataset(name, data=np.asarray(data, dtype=kind), fletcher32=some, chunks=True if some else None)

        put("Dimension", [mesh.dimension])
        put("Coordinates", mesh.points, np.float64)
        counts = np.concatenate([np.full(len(nodes), nodes.shape[1]) for _, nodes in mesh.blocks])
        put("Cells", np.concatenate([np.full(len(nodes), CELLS[kind].number) for kind, nodes in mesh.blocks]))
        put("Offsets", np.concatenate([[0], np.cumsum(counts)]))
        put("Connectivity", np.concatenate([nodes.ravel() for _, nodes in mesh.blocks]))
        sides = {name: rows[:, :2] for name, rows in mesh.side_groups.items()}
        for folder, groups in (("ElementGroups", mesh.groups), ("SideGroups", sides)):
            file.create_group(folder)
            for number, (name, members) in enumerate(sorted(groups.items())):
                put(f"{folder}/{number:06d}", members).attrs["Name"] = np.bytes_(name.encode())


def entities_of(count, groups):
    """Entities, i.e. sets of members with equal groups. \\return list of (group numbers, members), and the names in the order of the numbers"""
    names = sorted(groups)
    member = np.zeros((count, len(names)), dtype=bool)
    for column, name in enumerate(names):
        member[groups[name], column] = True
    rows, which = np.unique(member, axis=0, return_inverse=True)
    which = which.ravel()
    return [(np.flatnonzero(row) + 1, np.flatnonzero(which == i)) for i, row in enumerate(rows)], names


def write_msh(mesh, path):
    dimension = mesh.dimension
    sides = np.unique(np.vstack([np.zeros((0, 2 + MOST), dtype=int), *mesh.side_groups.values()]), axis=0)
    place = {tuple(row): i for i, row in enumerate(sides[:, :2].tolist())}
    members_of = {name: [place[tuple(row)] for row in rows[:, :2].tolist()] for name, rows in mesh.side_groups.items()}
    lower, lower_names = entities_of(len(sides), members_of)
    kinds = np.concatenate([np.full(len(nodes), b) for b, (_, nodes) in enumerate(mesh.blocks)])
    first = np.concatenate([[0], np.cumsum([len(nodes) for _, nodes in mesh.blocks])])
    upper, upper_names = entities_of(first[-1], mesh.groups)
    low, high = ([*map(float, corner), 0.0][:3] for corner in (mesh.points.min(axis=0), mesh.points.max(axis=0)))
    box = " ".join(f"{x!r}" for x in (*low, *high))

    blocks = []  # (dimension, entity, type, nodes)
    widths = (sides[:, 2:] >= 0).sum(axis=1)
    for entity, (_, members) in enumerate(lower, 1):
        for width in np.unique(widths[members]):
            kind = SIDE_KINDS[dimension, width]
            rows = sides[members][widths[members] == width]
            blocks.append((dimension - 1, entity, LINES[kind] if kind in LINES else CELLS[kind].gmsh, rows[:, 2:2 + width]))
    for entity, (_, members) in enumerate(upper, 1):
        for b, (kind, nodes) in enumerate(mesh.blocks):
            own = members[kinds[members] == b] - first[b]
            if len(own):
                blocks.append((dimension, entity, CELLS[kind].gmsh, nodes[own][:, CELLS[kind].gmsh_order]))

    count, total = len(mesh.points), sum(len(nodes) for *_, nodes in blocks)
    entities = [0, 0, 0, 0]
    entities[dimension - 1], entities[dimension] = len(lower), len(upper)
    with open(path, "w", encoding="utf-8", newline="\n") as out:
        out.write("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n")
        out.write(f"{len(lower_names) + len(upper_names)}\n")
        for of, names in ((dimension - 1, lower_names), (dimension, upper_names)):
            for number, name in enumerate(names, 1):
                out.write(f'{of} {number} "{name}"\n')
        out.write(f"$EndPhysicalNames\n$Entities\n{' '.join(map(str, entities))}\n")
        for some in (lower, upper):
            for entity, (groups, _) in enumerate(some, 1):
                out.write(" ".join(map(str, [entity, box, len(groups), *groups, 0])) + "\n")
        out.write(f"$EndEntities\n$Nodes\n1 {count} 1 {count}\n{dimension} 1 0 {count}\n")
        np.savetxt(out, np.arange(1, count + 1), fmt="%d")
        np.savetxt(out, mesh.points, fmt="%.17g %.17g 0" if dimension == 2 else "%.17g")
        out.write(f"$EndNodes\n$Elements\n{len(blocks)} {total} 1 {total}\n")
        tag = 1
        for of, entity, kind, nodes in blocks:
            out.write(f"{of} {entity} {kind} {len(nodes)}\n")
            np.savetxt(out, np.column_stack([np.arange(tag, tag + len(nodes)), nodes + 1]), fmt="%d")
            tag += len(nodes)
        out.write("$EndElements\n")
