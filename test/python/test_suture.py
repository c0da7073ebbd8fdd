"""Compares the Python package with the programs, analytic solutions, and the library's own strategies. Runs on any number of ranks; arguments
are folders and programs (CMakeLists.txt)."""
import csv
import glob
import json
import os
import subprocess
import sys
import tempfile
import unittest

import numpy
from mpi4py import MPI

import suture
from scenes import blocks

WORLD = MPI.COMM_WORLD
# This process has MPI's rank variables; a program that it starts must not inherit them.
APART = {name: value for name, value in os.environ.items() if not name.startswith(("PMIX_", "OMPI_COMM", "OMPI_APP", "OMPI_UNIVERSE",
                                                                                    "OMPI_NUM", "OMPI_FIRST", "OMPI_MCA_ess", "OMPI_MCA_orte",
                                                                                    "OMPI_MCA_initial", "OMPI_FILE", "OMPI_ARGV", "OMPI_COMMAND"))}
SOURCE, SOLVED, PROGRAMS = sys.argv.pop(1), sys.argv.pop(1), sys.argv.pop(1)


class Runs(unittest.TestCase):
    def test_tunnel_has_the_energy_of_the_program_to_the_last_bit(self):
        result = suture.solve(os.path.join(SOURCE, "input", "tunnel", "tunnel.xml"), comm=WORLD)
        with open(os.path.join(SOLVED, "summary.json")) as file:
            program = json.load(file)
        self.assertEqual(program["ranks"], WORLD.size)
        self.assertEqual(result.summary["energy"], program["energy"])
        self.assertEqual(result.energy, program["energy"])
        for name in ("contact", "extremes", "equilibrium", "dofs", "mesh_hash"):
            self.assertEqual(result.summary[name], program[name])
        self.assertEqual(result.summary["outer"]["pcg_total"], program["outer"]["pcg_total"])
        if WORLD.rank == 0:
            with open(os.path.join(SOLVED, "contact.csv"), newline="") as table:
                rows = list(csv.DictReader(table))
            self.assertEqual([float(row["force"]) for row in rows], [float("%.9g" % force) for force in result.pairs.force])
            self.assertEqual(numpy.count_nonzero(result.pairs.status), program["contact"]["active"])

    def test_dictionary_gives_the_stress_of_a_strain(self):
        result = suture.solve(blocks())
        self.assertTrue(result.converged)
        for subdomain in result.subdomains:
            x, u = subdomain.coordinates, subdomain.displacement
            numpy.testing.assert_allclose(u[:, 1], -0.05 * (x[:, 1] + 1), atol=1e-9)
            numpy.testing.assert_allclose(subdomain.stress, [[0, -1e5, 0, 0]] * len(subdomain.elements), atol=1e-2)
            numpy.testing.assert_allclose(subdomain.von_mises, 1e5, rtol=1e-6)
        self.assertEqual(len(result.pairs), 9 if WORLD.rank == 0 else 0)
        numpy.testing.assert_allclose(result.pairs.pressure, 1e5, rtol=1e-6)
        numpy.testing.assert_allclose(result.pairs.force, 1e5 * numpy.asarray(result.pairs.tributary), rtol=1e-6)
        self.assertTrue((numpy.asarray(result.pairs.status) == suture.SLIP).all())
        self.assertEqual(result.contacts, ["joint"])
        self.assertEqual(result.history[-1].active, 9)

    def test_fields_of_all_ranks_are_in_the_order_of_the_mesh(self):
        fields = suture.solve(blocks()).gather(root=WORLD.size - 1)
        if WORLD.rank < WORLD.size - 1:
            self.assertIsNone(fields)
            return
        self.assertEqual(list(fields.nodes), list(range(2 * 81)))
        self.assertEqual(list(fields.elements), list(range(2 * 64)))
        numpy.testing.assert_allclose(fields.displacement[:, 1], -0.05 * (fields.coordinates[:, 1] + 1), atol=1e-9)
        self.assertEqual(fields.bodies, ["lower", "upper"])
        middle = numpy.array([fields.coordinates[cell].mean(axis=0) for cell in fields.cells])
        numpy.testing.assert_array_equal(fields.body, (middle[:, 1] > 0).astype(int))

    def test_arrays_show_values_of_the_library(self):
        result = suture.solve(blocks())
        for subdomain in result.subdomains:
            for name in ("coordinates", "nodes", "connectivity"):
                one, other = getattr(subdomain, name), getattr(subdomain, name)
                self.assertEqual(one.ctypes.data, other.ctypes.data)
                self.assertRaises(ValueError, one.__setitem__, 0, 1)
        if WORLD.rank == 0:
            pressure, status = result.pairs.pressure, result.pairs.status
            self.assertGreater(pressure.strides[0], pressure.itemsize)
            del result
            numpy.testing.assert_allclose(pressure, 1e5, rtol=1e-6)  # alive as long as a view of it exists
            self.assertEqual(len(status), 9)

    def test_displacement_is_not_copied_where_bodies_are_held(self):
        scene = blocks()
        scene["Boundary Conditions"]["hold"] = {"Group": "upper_top", "Type": "Displacement", "Value": [0, -0.1]}
        scene["Boundary Conditions"].pop("press")
        for subdomain in suture.solve(scene).subdomains:
            if not subdomain.displacement.flags.writeable:  # a removed rigid-body motion makes it a sum
                self.assertEqual(subdomain.displacement.ctypes.data, subdomain.displacement.ctypes.data)

    def test_every_rank_may_solve_a_scene_of_its_own(self):
        own = suture.solve(blocks(press=-0.1 * (WORLD.rank + 1)), comm=MPI.COMM_SELF)
        self.assertEqual(own.summary["ranks"], 1)
        # E / 2 strain^2 on an area of four
        strain = 0.05 * (WORLD.rank + 1)
        self.assertAlmostEqual(own.energy / (0.5 * 2e6 * strain ** 2 * 4), 1.0, places=7)

    def test_files_are_those_of_a_run(self):
        folder = WORLD.bcast(tempfile.mkdtemp() if WORLD.rank == 0 else None)
        result = suture.solve(blocks(), output=folder)
        WORLD.barrier()
        names = {os.path.basename(name) for name in glob.glob(os.path.join(folder, "*"))}
        self.assertLessEqual({"summary.json", "history.csv", "fields_0000.vtkhdf", "contact.csv"}, names)
        with open(os.path.join(folder, "summary.json")) as file:
            self.assertEqual(json.load(file), result.summary)

    def test_named_materials_come_from_the_built_in_file_and_own_files(self):
        scene = blocks()
        del scene["Materials"]
        with tempfile.TemporaryDirectory() as folder:
            own = os.path.join(WORLD.bcast(folder, root=0), "own.xml")
            if WORLD.rank == 0:
                with open(own, "w", encoding="utf-8") as file:
                    file.write('<ParameterList name="Materials"><ParameterList name="alloy"><Parameter name="Based On" value="S355"/>'
                               '<Parameter name="Yield Strength" value="5e8"/></ParameterList></ParameterList>')
            WORLD.barrier()
            scene["Material Files"] = own
            for body, name in zip(scene["Bodies"].values(), ("S355", "alloy")):
                body["Material"] = name
            result = suture.solve(scene)
            with self.assertRaises(suture.InputError) as caught:
                suture.solve(scene, set={"Bodies/" + next(iter(scene["Bodies"])) + "/Material": "S356"})
            self.assertIn("Did you mean 'S355'?", str(caught.exception))
            WORLD.barrier()  # the folder belongs to rank 0
        materials = result.summary["parameters"]["Materials"]
        self.assertEqual({name: material["Yield Strength"] for name, material in materials.items()}, {"S355": 355e6, "alloy": 5e8})
        factors = [own["factor"] for own in result.summary["safety"]["bodies"].values()]
        self.assertEqual(result.summary["safety"]["least"], min(factors))

    def test_text_of_a_scene_is_a_scene(self):
        self.assertEqual(suture.solve(suture.to_xml(blocks())).energy, suture.solve(blocks()).energy)


class Errors(unittest.TestCase):
    def test_input_errors_have_all_problems_on_all_ranks(self):
        wrong = {"Outer Solver/Tolerence": 1e-3, "Outer Solver/Maximum Iterations": -1}
        with self.assertRaises(suture.InputError) as caught:
            suture.solve(blocks(), set=wrong)
        self.assertEqual(caught.exception.code, 3)
        self.assertEqual([path for path, _ in caught.exception.problems], ["Outer Solver/Tolerence", "Outer Solver/Maximum Iterations"])
        self.assertIn("Did you mean 'Tolerance'?", str(caught.exception))

    @unittest.skipIf(WORLD.size > 1, "the program is started without MPI")
    def test_texts_are_those_of_the_program(self):
        scene = os.path.join(SOURCE, "input", "two_blocks", "two_blocks.xml")
        ends = [({"Materials/rubber/Poisson Ratio": 0.7, "Bodies/uper/Material": "steel"}, suture.InputError),
                ({"Boundary Conditions/ground/Group": "lower_botom"}, suture.InputError),
                ({"Outer Solver/Maximum Iterations": 0}, suture.NotConverged)]
        for wrong, kind in ends:
            words = [word for pair in suture.assignments(wrong) for word in ("--set", pair)]
            with tempfile.TemporaryDirectory() as folder:
                program = subprocess.run([os.path.join(PROGRAMS, "suture_solve"), scene, "--output", folder, *words], text=True, env=APART,
                                         stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
            with self.assertRaises(kind) as caught:
                suture.solve(scene, set=wrong)
            self.assertEqual(caught.exception.code, program.returncode)
            for line in str(caught.exception).split("\n"):
                self.assertIn(" ".join(line.split()), " ".join(program.stdout.split()))

    def test_answers_that_do_not_hold_are_no_answers(self):
        with self.assertRaises(suture.NotConverged) as caught:
            suture.solve(blocks(), set={"Outer Solver/Maximum Iterations": 0})
        self.assertEqual(caught.exception.code, 4)
        self.assertIsInstance(caught.exception, suture.NumericalError)
        self.assertFalse(suture.solve(blocks(), set={"Outer Solver/Maximum Iterations": 0}, check=False).converged)

    def test_values_that_are_no_parameters_are_named(self):
        scene = blocks()
        scene["Materials"]["rubber"]["Young Modulus"] = 1j
        self.assertRaisesRegex(TypeError, "Materials/rubber/Young Modulus: .*complex", suture.solve, scene)
        self.assertRaisesRegex(suture.InputError, "nowhere.xml: cannot be read: No such file", suture.solve, "nowhere.xml")


class Strategies(unittest.TestCase):
    def test_weighting_by_a_function_is_the_one_of_the_library(self):
        @suture.weighting("Tempered", exponent=1.0)
        def tempered(local, exponent):
            self.assertEqual(len(local.stiffness_diagonal), local.size)
            return local.stiffness_diagonal ** exponent

        jump = {"Preconditioner/Type": "Neumann-Neumann", "Formulation": "Contact On The Interface", "Outer Solver/Type": "Active Set"}
        scene = os.path.join(SOURCE, "input", "tunnel", "tunnel_metis.xml")

        def solve(**own):
            name = "Preconditioner/Neumann-Neumann/"
            return suture.solve(scene, set=dict(jump, **{name + key: value for key, value in own.items()})).summary["outer"]["pcg_total"]
        ours, theirs = solve(**{"Weighting": "Tempered"}), solve(**{"Weighting": "Stiffness Diagonal"})
        self.assertEqual(ours, theirs)
        self.assertEqual(solve(**{"Weighting": "Tempered", "Tempered/Exponent": 0.0}), solve(**{"Weighting": "Multiplicity"}))

    def test_material_by_a_function_is_the_one_of_the_library(self):
        @suture.material("By Function", young_modulus=1.0, poisson_ratio=0.0)
        def law(young_modulus, poisson_ratio):
            mu = young_modulus / (2 * (1 + poisson_ratio))
            c = numpy.diag([2 * mu] * 3 + [mu] * 3)
            c[:3, :3] += young_modulus * poisson_ratio / ((1 + poisson_ratio) * (1 - 2 * poisson_ratio))
            return c

        own = suture.solve(blocks(law={"Type": "By Function", "By Function": {"Young Modulus": 2e6, "Poisson Ratio": 0.3}}))
        library = suture.solve(blocks(law={"Young Modulus": 2e6, "Poisson Ratio": 0.3}))
        self.assertAlmostEqual(own.energy / library.energy, 1.0, places=10)
        suture.material("By Function", young_modulus=1.0, poisson_ratio=0.0)(lambda **own: numpy.eye(5))
        self.assertRaisesRegex(suture.InputError, "5 x 5; a stiffness is 6 x 6", suture.solve, blocks(law={"Type": "By Function"}))


class Couplings(unittest.TestCase):
    def test_forces_from_outside_are_those_of_a_traction(self):
        scene = blocks()
        scene["Boundary Conditions"]["press"] = {"Group": "upper_left", "Type": "Bilateral"}
        coupling = suture.Coupling(scene)
        surface = coupling.surface("upper_top")
        self.assertAlmostEqual(WORLD.allreduce(surface.areas.sum()), 2.0, places=12)
        for pressure in (1e5, 2e5, 0.5e5):
            coupling.set_forces(surface, -pressure * surface.normals)
            coupling.solve()
            # strain p / E on a height of two
            numpy.testing.assert_allclose(coupling.displacements(surface)[:, 1], -2 * pressure / 2e6, rtol=1e-6)
            if WORLD.rank == 0:
                numpy.testing.assert_allclose(coupling.pairs.pressure, pressure, rtol=1e-6)
        self.assertRaisesRegex(suture.InputError, "", coupling.set_forces, surface, numpy.zeros(3 + 2 * len(surface.nodes)))


class Studies(unittest.TestCase):
    def test_rows_are_those_of_the_table(self):
        folder = WORLD.bcast(tempfile.mkdtemp() if WORLD.rank == 0 else None)
        rows, code = suture.study(os.path.join(SOURCE, "test", "python", "study.xml"), output=folder)
        self.assertEqual(code, 0)
        self.assertEqual([row["modulus"] for row in rows], ["1e6", "4e6"])
        for row in rows:
            self.assertAlmostEqual(float(row["pressure"]) / (0.05 * float(row["modulus"])), 1.0, places=6)

    def test_changes_of_the_study_are_those_of_the_program(self):
        folder = WORLD.bcast(tempfile.mkdtemp() if WORLD.rank == 0 else None)
        rows, code = suture.study(os.path.join(SOURCE, "test", "python", "study.xml"), output=folder, only=["modulus=4e6"],
                                  set={"Boundary Conditions/press/Value": [0.0, -0.2]})
        self.assertEqual((code, len(rows)), (0, 1))
        self.assertAlmostEqual(float(rows[0]["pressure"]) / 4e5, 1.0, places=6)


if __name__ == "__main__":
    unittest.main(verbosity=2 if WORLD.rank == 0 else 0)
