"""Meshes from arrays, meshio and Gmsh, compared with the same meshes from files and generators. Runs on any number of ranks."""
import os
import sys
import tempfile
import unittest

import numpy
from mpi4py import MPI

import suture
from scenes import blocks, bricks

try:
    import meshio
except ImportError:
    meshio = None
try:
    import gmsh
except ImportError:
    gmsh = None

WORLD = MPI.COMM_WORLD
# Suture's names of shapes and meshio's.
KINDS = {"Triangle3": "triangle", "Triangle6": "triangle6", "Quadrilateral4": "quad", "Quadrilateral8": "quad8", "Quadrilateral9": "quad9",
         "Tetrahedron4": "tetra", "Tetrahedron10": "tetra10", "Hexahedron8": "hexahedron", "Hexahedron20": "hexahedron20",
         "Hexahedron27": "hexahedron27", "Wedge6": "wedge", "Pyramid5": "pyramid"}


def faces(kind, space):
    """Local vertices of the sides of a shape; any order is enough to find a side."""
    sides = {"triangle": [(0, 1), (1, 2), (2, 0)], "quad": [(0, 1), (1, 2), (2, 3), (3, 0)],
             "tetra": [(0, 1, 2), (0, 1, 3), (1, 2, 3), (0, 2, 3)], "wedge": [(0, 1, 2), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)],
             "pyramid": [(0, 1, 2, 3), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)],
             "hexahedron": [(0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]}
    return next(own for name, own in sides.items() if kind.startswith(name))


def sides_at(points, cells, kind, body, axis, value):
    """Vertices of the sides of some elements that lie in a plane."""
    rows = [cell[list(face)] for cell in cells[body] for face in faces(kind, points.shape[1] == 3)]
    found = [row for row in rows if (numpy.abs(points[row, axis] - value) < 1e-9).all()]
    widths = {len(row) for row in found}
    return numpy.array(found) if len(widths) == 1 else None


def as_arrays(scene, cell):
    """The mesh of a generator as arrays, taken from the fields of a solution; and the scene with this mesh."""
    fields = suture.solve(scene).fields(root=None)
    kind, cells, points = KINDS[cell], numpy.array(fields.cells), fields.coordinates
    body = {name: numpy.flatnonzero(fields.body == number) for number, name in enumerate(fields.bodies)}
    last = points.shape[1] - 1
    top, bottom = points[:, last].max(), points[:, last].min()
    middle = (top + bottom) / 2
    sides = {"upper_top": sides_at(points, cells, kind, body["upper"], last, top),
             "upper_bottom": sides_at(points, cells, kind, body["upper"], last, middle),
             "lower_top": sides_at(points, cells, kind, body["lower"], last, middle),
             "lower_bottom": sides_at(points, cells, kind, body["lower"], last, bottom),
             "upper_left": sides_at(points, cells, kind, body["upper"], 0, points[:, 0].min()),
             "upper_right": sides_at(points, cells, kind, body["upper"], 0, points[:, 0].max())}
    if last == 2:
        sides["upper_front"] = sides_at(points, cells, kind, body["upper"], 1, points[:, 1].min())
    return points, {kind: cells}, body, sides


def solved(scene, mesh):
    scene = {name: value for name, value in scene.items() if name not in ("Mesh", "Partition")}
    return suture.solve(dict(scene, Mesh=mesh))


class Arrays(unittest.TestCase):
    def test_all_shapes_give_the_energy_of_the_generator(self):
        for cell in KINDS:
            space = cell[:3] in ("Tet", "Hex", "Wed", "Pyr")
            scene = bricks(cell, (2, 1, 2)) if space else blocks(cell=cell, cells=4, law={"Young Modulus": 2e6, "Poisson Ratio": 0.3})
            points, cells, body, sides = as_arrays(scene, cell)
            sides = {name: rows for name, rows in sides.items() if rows is not None}
            mesh = suture.mesh_from_arrays(points, cells, body, sides)
            self.assertEqual(mesh.remarks, [])
            reference, own = suture.solve(scene), solved(scene, mesh)
            self.assertAlmostEqual(own.energy / reference.energy, 1, places=8, msg=cell)
            self.assertEqual(own.summary["dofs"], reference.summary["dofs"])

    def test_two_triangles_by_hand(self):
        # A square of two triangles under tension p on its top: u_y = p / E y with nu = 0, energy -p^2 / (2 E).
        points = [[0, 0], [1, 0], [1, 1], [0, 1]]
        mesh = suture.mesh_from_arrays(points, {"triangle": [[0, 1, 2], [0, 3, 2]]}, {"square": [True, True]},
                                       {"bottom": [[0, 1]], "top": [[2, 3]], "left": [[3, 0]]})
        self.assertIn("1 clockwise elements reversed", mesh.remarks[0])
        self.assertIn("suture.Mesh: 2D, 4 nodes, 2 elements\n  groups: square (2)\n  side groups: bottom (1), top (1), left (1)", repr(mesh))
        scene = {"Mesh": mesh if WORLD.rank == 0 else suture.Mesh(), "Bodies": {"square": {"Material": "rubber"}},
                 "Materials": {"rubber": {"Young Modulus": 2e6, "Poisson Ratio": 0}},
                 "Boundary Conditions": {"ground": {"Group": "bottom", "Type": "Bilateral"}, "wall": {"Group": "left", "Type": "Bilateral"},
                                         "pull": {"Group": "top", "Type": "Traction", "Value": [0, 1e4]}}}
        result = suture.solve(scene)
        self.assertAlmostEqual(result.energy / (-1e4 ** 2 / (2 * 2e6)), 1, places=9)
        self.assertAlmostEqual(result.probe([0.3, 0.8], "displacement")[1] / (0.8 * 1e4 / 2e6), 1, places=9)

    def test_a_coupling_takes_a_mesh(self):
        points, cells, body, sides = as_arrays(blocks(), "Quadrilateral4")
        scene = dict(blocks(), Mesh=suture.mesh_from_arrays(points, cells, body, sides))
        scene.pop("Partition")
        scene["Boundary Conditions"]["press"] = {"Group": "upper_left", "Type": "Bilateral"}
        coupling = suture.Coupling(scene)
        surface = coupling.surface("upper_top")
        coupling.set_forces(surface, -1e5 * surface.normals)
        coupling.solve()
        numpy.testing.assert_allclose(coupling.displacements(surface)[:, 1], -0.1, rtol=1e-6)

    def test_wrong_arrays_are_named(self):
        square, triangle = [[0, 0], [1, 0], [1, 1], [0, 1]], {"triangle": [[0, 1, 2], [0, 2, 3]]}
        make = suture.mesh_from_arrays
        self.assertRaisesRegex(ValueError, "unknown kind 'triangles'. Did you mean 'triangle'", make, square, {"triangles": [[0, 1, 2]]}, {})
        self.assertRaisesRegex(ValueError, "cells: triangle: number 4; there are 4 points, counted from 0", make, square, {"triangle": [[0, 1, 4]]}, {})
        self.assertRaisesRegex(ValueError, "cells: triangle: an array of the shape .2, 2.; expected rows of 3 nodes", make, square, {"triangle": [[0, 1], [1, 2]]}, {})
        self.assertRaisesRegex(ValueError, "groups: a: number 2; there are 2 elements", make, square, triangle, {"a": [2]})
        self.assertRaisesRegex(ValueError, "groups: a: a mask of the shape", make, square, triangle, {"a": [True]})
        self.assertRaisesRegex(ValueError, "sides: s: some of the sides are not on the boundary", make, square, triangle, {"a": [0, 1]}, {"s": [[0, 2]]})
        self.assertRaisesRegex(ValueError, "points: an array of the shape", make, [0, 1, 2], triangle, {})
        self.assertRaisesRegex(ValueError, "expected integers", make, square, {"triangle": [[0, 1, 2.5]]}, {})
        mesh = make(square, triangle, {"a": [0], "b": [1]})
        scene = dict(blocks(), Mesh=mesh, Bodies={"a": {"Material": "rubber"}, "b": {"Material": "rubber"}})
        with self.assertRaises(suture.InputError) as caught:  # as for a file
            suture.solve(scene)
        self.assertIn("share", str(caught.exception))
        self.assertRaisesRegex(suture.InputError, "Given, but no program gave a mesh|has no suture.Mesh", suture.solve, dict(blocks(), Mesh={"Generator": "Given"}))
        self.assertRaisesRegex(TypeError, "a suture.Mesh belongs in Mesh", suture.solve, dict(blocks(), Materials=mesh))


def gmsh_model(order, space, hexahedra):
    """Two blocks in the current model of Gmsh, with contact between them; curved on top in 2D."""
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.model.add("blocks")
    kernel = gmsh.model.occ
    dimension = 3 if space else 2
    for name, low in (("upper", 1.0), ("lower", 0.0)):
        tag = kernel.addBox(0, 0, low, 1, 1, 1) if space else kernel.addRectangle(0, low, 0, 1, 1)
        kernel.synchronize()
        gmsh.model.setPhysicalName(dimension, gmsh.model.addPhysicalGroup(dimension, [tag]), name)
        for side, axis, value in (("top", dimension - 1, low + 1), ("bottom", dimension - 1, low), ("left", 0, 0), ("right", 0, 1), ("front", 1, 0)):
            if side == "front" and not space:
                continue
            found = []
            for entity in gmsh.model.getBoundary([(dimension, tag)], oriented=False):
                box = gmsh.model.getBoundingBox(*entity)
                if abs(box[axis] - value) < 1e-6 and abs(box[axis + 3] - value) < 1e-6:
                    found.append(entity[1])
            gmsh.model.setPhysicalName(dimension - 1, gmsh.model.addPhysicalGroup(dimension - 1, found), "%s_%s" % (name, side))
    gmsh.option.setNumber("Mesh.MeshSizeMax", 0.5)
    gmsh.option.setNumber("Mesh.MeshSizeMin", 0.5)
    if hexahedra:
        for curve in gmsh.model.getEntities(1):
            gmsh.model.mesh.setTransfiniteCurve(curve[1], 3)
        for surface in gmsh.model.getEntities(2):
            gmsh.model.mesh.setTransfiniteSurface(surface[1])
            gmsh.model.mesh.setRecombine(2, surface[1])
        for volume in gmsh.model.getEntities(3):
            gmsh.model.mesh.setTransfiniteVolume(volume[1])
    gmsh.option.setNumber("Mesh.SecondOrderIncomplete", 1 if hexahedra == "incomplete" else 0)
    gmsh.model.mesh.generate(dimension)
    gmsh.model.mesh.setOrder(order)


@unittest.skipIf(gmsh is None, "python3-gmsh is not installed")
class Gmsh(unittest.TestCase):
    def compared(self, order, space, hexahedra):
        """Energies by the file, by the model, and by meshio."""
        scene = bricks("Hexahedron8") if space else blocks(law={"Young Modulus": 2e6, "Poisson Ratio": 0.3})
        if not space:
            scene["Boundary Conditions"]["press"] = {"Group": "upper_top", "Type": "Pressure", "Value": 1e4}
            scene["Boundary Conditions"]["hold"] = {"Group": "upper_left", "Type": "Bilateral"}
        path, meshes = None, [None, None]
        if WORLD.rank == 0:
            gmsh_model(order, space, hexahedra)
            path = os.path.join(tempfile.mkdtemp(), "blocks.msh")
            gmsh.write(path)
            meshes[0] = suture.mesh_from_gmsh()
            gmsh.finalize()
            if meshio is not None:
                meshes[1] = suture.mesh_from_meshio(meshio.read(path))
        by_file = solved(scene, {"File": WORLD.bcast(path, root=0)})
        for number in range(1 if meshio is None else 2):
            by_arrays = solved(scene, meshes[number] or suture.Mesh())
            self.assertEqual(by_arrays.summary["dofs"], by_file.summary["dofs"])
            self.assertEqual(by_arrays.summary["contact"]["pairs"], by_file.summary["contact"]["pairs"])
            self.assertAlmostEqual(by_arrays.energy / by_file.energy, 1, places=8, msg="%d %s %s" % (order, space, hexahedra))

    def test_plane_meshes(self):
        for order, hexahedra in ((1, False), (2, False), (2, True), (2, "incomplete")):
            self.compared(order, False, hexahedra)

    def test_solid_meshes(self):
        for order, hexahedra in ((1, False), (2, False), (2, True), (2, "incomplete")):
            self.compared(order, True, hexahedra)

    @unittest.skipIf(WORLD.size > 1, "the model is on one rank")
    def test_a_model_without_mesh_is_an_error(self):
        gmsh.initialize()
        gmsh.option.setNumber("General.Terminal", 0)
        self.assertRaisesRegex(ValueError, "has no mesh", suture.mesh_from_gmsh)
        gmsh.finalize()


if __name__ == "__main__":
    unittest.main(verbosity=2 if WORLD.rank == 0 else 0)
