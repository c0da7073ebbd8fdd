"""All other formats, through meshio: .med, .vtu, .vtk, .msh (versions that Suture does not read), .bdf and others."""
import contextlib
import io
import pathlib

import numpy as np

from .cells import KINDS
from .foreign import ConvertError, Foreign

MOST_GROUPS = 1000  # an array with more values is a numbering and not a set of groups


def read(path):
    import meshio

    if not pathlib.Path(path).is_file():
        raise ConvertError(f"{path}: No such file")
    said = io.StringIO()
    try:
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
            read_mesh = meshio.read(path)
    except (Exception, SystemExit) as error:  # meshio exits if it has no reader
        text = " ".join((str(error) if not isinstance(error, SystemExit) else said.getvalue()).split())
        raise ConvertError(f"{path}: meshio cannot read it: {text or type(error).__name__}") from error
    return of_meshio(read_mesh)


def of_meshio(read_mesh):
    """\\return the Foreign mesh of a meshio.Mesh"""
    mesh = Foreign(read_mesh.points)
    rows = [mesh.add_block(block.type, block.data) for block in read_mesh.cells]
    for name, blocks in read_mesh.cell_sets.items():
        for own, members in zip(rows, blocks):
            if members is not None and len(members) and not name.startswith("gmsh:"):
                mesh.add_to(mesh.groups, name, own[np.asarray(members, dtype=np.int64)])
    take_families(mesh, rows, read_mesh)
    take_arrays(mesh, rows, read_mesh)
    for name, members in read_mesh.point_sets.items():
        mesh.add_to(mesh.node_sets, name, members)
    return mesh


def take_families(mesh, rows, source):
    """Groups of .med: a family of elements or nodes may belong to several groups."""
    for tags, arrays, numbers, sets in ((getattr(source, "cell_tags", {}), source.cell_data.get("cell_tags", []), rows, mesh.groups),
                                        (getattr(source, "point_tags", {}), [source.point_data.get("point_tags", np.zeros(0))],
                                         [np.arange(len(source.points))], mesh.node_sets)):
        for family, names in tags.items():
            for array, own in zip(arrays, numbers):
                members = own[:len(array)][np.asarray(array) == family]
                for name in names:
                    if len(members):
                        mesh.add_to(sets, name.strip("\0 "), members)


def take_arrays(mesh, rows, source):
    """Groups by integers on elements, "<array> <number>", or "<array>" for zeros and ones; uses names if the file contains them."""
    called = ("point", "curve", "surface", "volume")
    names = {(int(tag), int(dimension)): name for name, (tag, dimension) in ((n, d[:2]) for n, d in source.field_data.items() if len(d) == 2)}
    for array, blocks in source.cell_data.items():
        if array in ("cell_tags", "gmsh:geometrical") or not all(np.issubdtype(np.asarray(b).dtype, np.integer) and np.ndim(b) == 1 for b in blocks):
            continue
        values = np.unique(np.concatenate([np.asarray(b) for b in blocks]))
        if len(values) > MOST_GROUPS:
            mesh.remarks.append(f"array '{array}' left out: it has {len(values)} values")
            continue
        for block, own, numbers in zip(source.cells, rows, blocks):
            for value in np.unique(numbers):
                dimension = KINDS.get(block.type, (2,))[0]
                name = names.get((int(value), dimension), array if set(values) <= {0, 1} else f"{array} {value}")
                if value != 0 and name not in source.cell_sets:
                    mesh.add_to(mesh.groups, name.replace("gmsh:physical", called[dimension]), own[np.asarray(numbers) == value])
    for array, values in source.point_data.items():
        values = np.asarray(values)
        if array != "point_tags" and values.ndim == 1 and np.issubdtype(values.dtype, np.integer) and set(np.unique(values)) <= {0, 1}:
            mesh.add_to(mesh.node_sets, array, np.flatnonzero(values))
