"""Suture's own HDF5 mesh (packages/mesh/Hdf5Mesh.hpp) and Gmsh's format 4.1."""
import numpy as np

from .plane import CELLS


def write_h5(plane, path):
    import h5py

    with h5py.File(path, "w") as file:
        file.attrs["SutureMesh"] = np.bytes_("1")

        def put(name, data, kind=np.int32):
            return file.create_dataset(name, data=np.asarray(data, dtype=kind), fletcher32=len(data) > 0, chunks=True if len(data) > 0 else None)

        put("Dimension", [2])
        put("Coordinates", plane.points, np.float64)
        counts = np.concatenate([np.full(len(nodes), nodes.shape[1]) for _, nodes in plane.blocks])
        put("Cells", np.concatenate([np.full(len(nodes), CELLS[kind][0]) for kind, nodes in plane.blocks]))
        put("Offsets", np.concatenate([[0], np.cumsum(counts)]))
        put("Connectivity", np.concatenate([nodes.ravel() for _, nodes in plane.blocks]))
        for folder, groups in (("ElementGroups", plane.groups), ("SideGroups", {name: rows[:, :2] for name, rows in plane.side_groups.items()})):
            file.create_group(folder)
            for number, (name, members) in enumerate(sorted(groups.items())):
                put(f"{folder}/{number:06d}", members).attrs["Name"] = np.bytes_(name.encode())


def entities_of(count, groups):
    """Entities: members with the same groups. \\return list of (numbers of groups, members), and the names in the order of the numbers"""
    names = sorted(groups)
    member = np.zeros((count, len(names)), dtype=bool)
    for column, name in enumerate(names):
        member[groups[name], column] = True
    rows, which = np.unique(member, axis=0, return_inverse=True)
    which = which.ravel()
    return [(np.flatnonzero(row) + 1, np.flatnonzero(which == i)) for i, row in enumerate(rows)], names


def write_msh(plane, path):
    sides = np.unique(np.vstack([np.zeros((0, 5), dtype=int), *plane.side_groups.values()]), axis=0)
    place = {tuple(row): i for i, row in enumerate(sides[:, :2].tolist())}
    curves, curve_names = entities_of(len(sides), {name: [place[tuple(row)] for row in rows[:, :2].tolist()] for name, rows in plane.side_groups.items()})
    kinds = np.concatenate([np.full(len(nodes), b) for b, (_, nodes) in enumerate(plane.blocks)])
    first = np.concatenate([[0], np.cumsum([len(nodes) for _, nodes in plane.blocks])])
    surfaces, surface_names = entities_of(first[-1], plane.groups)
    low, high = plane.points.min(axis=0), plane.points.max(axis=0)
    box = f"{low[0]!r} {low[1]!r} 0 {high[0]!r} {high[1]!r} 0"

    blocks = []  # (dimension, entity, type, nodes)
    for entity, (_, members) in enumerate(curves, 1):
        for middle, kind in ((False, 1), (True, 8)):
            rows = sides[members]
            rows = rows[(rows[:, 4] >= 0) == middle]
            if len(rows):
                blocks.append((1, entity, kind, rows[:, 2:5 if middle else 4]))
    for entity, (_, members) in enumerate(surfaces, 1):
        for b, (kind, nodes) in enumerate(plane.blocks):
            own = members[kinds[members] == b] - first[b]
            if len(own):
                blocks.append((2, entity, CELLS[kind][1], nodes[own]))

    count, total = len(plane.points), sum(len(nodes) for *_, nodes in blocks)
    with open(path, "w", encoding="utf-8", newline="\n") as out:
        out.write("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n")
        out.write(f"{len(curve_names) + len(surface_names)}\n")
        for dimension, names in ((1, curve_names), (2, surface_names)):
            for number, name in enumerate(names, 1):
                out.write(f'{dimension} {number} "{name}"\n')
        out.write(f"$EndPhysicalNames\n$Entities\n0 {len(curves)} {len(surfaces)} 0\n")
        for entities in (curves, surfaces):
            for entity, (groups, _) in enumerate(entities, 1):
                out.write(" ".join(map(str, [entity, box, len(groups), *groups, 0])) + "\n")
        out.write(f"$EndEntities\n$Nodes\n1 {count} 1 {count}\n2 1 0 {count}\n")
        np.savetxt(out, np.arange(1, count + 1), fmt="%d")
        np.savetxt(out, plane.points, fmt="%.17g %.17g 0")
        out.write(f"$EndNodes\n$Elements\n{len(blocks)} {total} 1 {total}\n")
        tag = 1
        for dimension, entity, kind, nodes in blocks:
            out.write(f"{dimension} {entity} {kind} {len(nodes)}\n")
            np.savetxt(out, np.column_stack([np.arange(tag, tag + len(nodes)), nodes + 1]), fmt="%d")
            tag += len(nodes)
        out.write("$EndElements\n")
