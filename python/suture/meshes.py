"""Meshes from arrays, from meshio and from Gmsh, without files."""
import numpy

from .places import module_of_program

# Gmsh's numbers of element types and the names of meshio.
GMSH_KINDS = {1: "line", 8: "line3", 2: "triangle", 9: "triangle6", 3: "quad", 10: "quad9", 16: "quad8", 4: "tetra", 11: "tetra10",
              5: "hexahedron", 12: "hexahedron27", 17: "hexahedron20", 6: "wedge", 7: "pyramid", 15: "vertex"}


class Mesh:
    """A mesh for a scene: {"Mesh": mesh, "Bodies": {...}, ...}. Made by mesh_from_arrays(), mesh_from_meshio(), mesh_from_gmsh(). Only the mesh of
    rank 0 is used; Mesh() without arguments is enough on other ranks.

    `points`: points x dimension [length]; `cells`: Suture's number of each element's shape; `connectivity`, `offsets`: nodes of element e are
    connectivity[offsets[e]:offsets[e + 1]]; `groups`: elements of each body or named part; `side_groups`: element and local side of each
    boundary side; `remarks`: what was repaired or left out."""

    def __init__(self, points=(), cells=(), offsets=(0,), connectivity=(), groups=None, side_groups=None, dimension=2, remarks=()):
        self.points, self.cells = numpy.asarray(points, dtype=float), numpy.asarray(cells, dtype=numpy.int32)
        self.offsets, self.connectivity = numpy.asarray(offsets, dtype=numpy.int32), numpy.asarray(connectivity, dtype=numpy.int32)
        self.groups, self.side_groups, self.dimension, self.remarks = groups or {}, side_groups or {}, dimension, list(remarks)

    def __repr__(self):
        def listed(groups, size):
            return ", ".join("%s (%d)" % (name, size(members)) for name, members in groups.items()) or "none"

        lines = ["suture.Mesh: %dD, %d nodes, %d elements" % (self.dimension, len(self.points), len(self.cells)),
                 "  groups: " + listed(self.groups, len), "  side groups: " + listed(self.side_groups, len)]
        return "\n".join(lines + ["  " + remark for remark in self.remarks])


def _converted(foreign):
    """A Mesh of a Foreign mesh: orientation, node order, boundary sides. ValueError: the mesh cannot be used."""
    formats = module_of_program("suture_convert_formats.mesh")
    cells = module_of_program("suture_convert_formats.cells").CELLS
    try:
        mesh = formats.Mesh(foreign, "the mesh")
    except module_of_program("suture_convert_formats.foreign").ConvertError as error:
        raise ValueError(str(error)) from None
    counts = numpy.concatenate([numpy.full(len(nodes), nodes.shape[1]) for _, nodes in mesh.blocks])
    return Mesh(mesh.points, numpy.concatenate([numpy.full(len(nodes), cells[kind].number) for kind, nodes in mesh.blocks]),
                numpy.concatenate([[0], numpy.cumsum(counts)]), numpy.concatenate([nodes.ravel() for _, nodes in mesh.blocks]),
                {name: numpy.asarray(members) for name, members in mesh.groups.items()},
                {name: rows[:, :2] for name, rows in mesh.side_groups.items()}, mesh.dimension, mesh.remarks)


def _foreign(points):
    points = numpy.asarray(points, dtype=float)
    if points.ndim != 2 or points.shape[1] not in (2, 3):
        raise ValueError("points: an array of the shape %s; expected points x 2 or points x 3" % (points.shape,))
    return module_of_program("suture_convert_formats.foreign").Foreign(points)


def _nearest(name, known):
    import difflib
    near = difflib.get_close_matches(str(name), known, 1)
    return (" Did you mean '%s'?" % near[0] if near else "") + " Known here: " + ", ".join(known)


def _numbers(values, name, limit, what, columns=None):
    """Integers from 0 to limit - 1, as an array of the given number of columns. ValueError: they are not."""
    given = numpy.asarray(values)
    if given.size and not (numpy.issubdtype(given.dtype, numpy.integer) or given.dtype == bool):
        raise ValueError("%s: numbers of the type %s; expected integers" % (name, given.dtype))
    if given.dtype == bool:
        if given.shape != (limit,):
            raise ValueError("%s: a mask of the shape %s; expected one value for each of the %d %s" % (name, given.shape, limit, what))
        given = numpy.flatnonzero(given)
    if columns is not None and (given.ndim != 2 or given.shape[1] not in columns):
        raise ValueError("%s: an array of the shape %s; expected rows of %s nodes" % (name, given.shape, " or ".join(map(str, columns))))
    bad = given[(given < 0) | (given >= limit)] if given.size else given
    if bad.size:
        raise ValueError("%s: number %d; there are %d %s, counted from 0" % (name, bad.ravel()[0], limit, what))
    return given.astype(numpy.int64)


def mesh_from_arrays(points, cells, groups, sides=None):
    """A Mesh from arrays. Local; call it on rank 0, or on all ranks.

    points: points x 2, or points x 3 [length]
    cells: {kind: elements x nodes}, with the kinds and node orders of meshio and VTK: triangle, triangle6, quad, quad8, quad9, tetra, tetra10,
        hexahedron, hexahedron20, hexahedron27, wedge, pyramid. Elements are numbered from 0 through all kinds, in the order of the dictionary.
    groups: {name: numbers of elements, or a mask}: the bodies of the scene, parts of bodies, named subdomains
    sides: {name: nodes of each side}, vertices first: rows of 2 (or 3) nodes in 2D, of 3, 4, 6, 8 or 9 in 3D. Contacts, loads and supports.

    Inverted elements are reversed. Raises ValueError for arrays that do not fit together."""
    kinds = module_of_program("suture_convert_formats.cells").CELLS
    foreign = _foreign(points)
    for kind, nodes in cells.items():
        if kind not in kinds:
            raise ValueError("cells: unknown kind '%s'.%s" % (kind, _nearest(kind, list(kinds))))
        foreign.add_block(kind, _numbers(nodes, "cells: " + kind, len(foreign.points), "points", (kinds[kind].nodes,)))
    for name, members in groups.items():
        foreign.add_to(foreign.groups, str(name), _numbers(members, "groups: %s" % name, foreign.elements(), "elements").ravel())
    space = any(kinds[kind].dimension == 3 for kind in cells)
    for name, nodes in (sides or {}).items():
        rows = _numbers(nodes, "sides: %s" % name, len(foreign.points), "points", (3, 4, 6, 8, 9) if space else (2, 3))
        vertices = {3: 3, 4: 4, 6: 3, 8: 4, 9: 4}[rows.shape[1]] if space else 2
        foreign.side_sets[str(name)] = rows[:, :vertices]
    mesh = _converted(foreign)
    lost = [name for name in (sides or {}) if len(mesh.side_groups.get(str(name), ())) < len(numpy.asarray(sides[name]))]
    if lost:
        raise ValueError("sides: %s: some of the sides are not on the boundary of a body, or occur twice" % lost[0])
    return mesh


def mesh_from_meshio(source):
    """A Mesh of a meshio.Mesh, with the groups that suture_convert makes of a file: cell sets and physical groups; sets of lines (3D: surface
    elements) become side groups, and sets of nodes those sides whose nodes all belong to the set. Local. Raises ValueError."""
    return _converted(module_of_program("suture_convert_formats.through_meshio").of_meshio(source))


def mesh_from_gmsh():
    """A Mesh of the current model of the Gmsh API (import gmsh), which has been meshed; elements of order 1 or 2. Groups are the physical groups;
    without a name they are called "volume 2", "surface 7" or "curve 3", as in files. Local; call it where the model is. Raises ValueError."""
    import gmsh

    tags, coordinates, _ = gmsh.model.mesh.getNodes()
    if not len(tags):
        raise ValueError("the current model of Gmsh has no mesh: call gmsh.model.mesh.generate()")
    order = numpy.argsort(tags, kind="stable")
    place = numpy.full(int(tags.max()) + 1, -1, dtype=numpy.int64)
    place[tags[order]] = numpy.arange(len(tags))
    foreign = _foreign(coordinates.reshape(-1, 3)[order])
    elements_of = {}  # by entity
    for entity in gmsh.model.getEntities():
        kinds, _, nodes = gmsh.model.mesh.getElements(*entity)
        for kind, own in zip(kinds, nodes):
            if kind not in GMSH_KINDS:
                raise ValueError("the model of Gmsh has elements of the type %d (%s), which are unknown to Suture; known are %s"
                                 % (kind, gmsh.model.mesh.getElementProperties(kind)[0], ", ".join(GMSH_KINDS.values())))
            count = gmsh.model.mesh.getElementProperties(kind)[3]
            elements_of.setdefault(entity, []).append(foreign.add_block(GMSH_KINDS[kind], place[own.reshape(-1, count)]))
    for dimension, tag in gmsh.model.getPhysicalGroups():
        name = gmsh.model.getPhysicalName(dimension, tag) or "%s %d" % (("point", "curve", "surface", "volume")[dimension], tag)
        for entity in gmsh.model.getEntitiesForPhysicalGroup(dimension, tag):
            for own in elements_of.get((dimension, int(entity)), []):
                foreign.add_to(foreign.groups, name, own)
    return _converted(foreign)
