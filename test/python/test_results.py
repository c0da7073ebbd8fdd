"""Results in memory: probes, nodal fields, plots, texts. Runs on any number of ranks. Arguments: test_results.py WORK"""
import csv
import glob
import os
import sys
import tempfile
import unittest

import numpy
from mpi4py import MPI

import suture
from scenes import blocks, bricks, leaning

WORLD = MPI.COMM_WORLD
PROBES = {"Output": {"Nodal Stresses": True, "Probes": {
    "centre": {"Type": "Point", "Place": [0.1, 0.55]}, "cut": {"Type": "Line", "From": [-0.9, 0.3], "To": [0.9, 0.4], "Points": 7},
    "seat": {"Type": "Group", "Group": "upper_bottom"}}}}


class Probes(unittest.TestCase):
    def test_probes_have_the_values_of_the_files(self):
        folder = WORLD.bcast(tempfile.mkdtemp() if WORLD.rank == 0 else None)
        result = suture.solve(leaning(**PROBES), output=folder)
        self.assertEqual(set(result.probes), {"centre", "cut", "seat"})
        WORLD.barrier()
        for name, table in result.probes.items():
            with open(os.path.join(folder, "probe_%s.csv" % name), newline="") as file:
                rows = list(csv.DictReader(file))
            self.assertEqual(list(table["body"]), [row["body"] for row in rows])
            columns = {"x": table["position"][:, 0], "y": table["position"][:, 1], "ux": table["displacement"][:, 0],
                       "uy": table["displacement"][:, 1], "sxx": table["stress"][:, 0], "syy": table["stress"][:, 1],
                       "szz": table["stress"][:, 2], "sxy": table["stress"][:, 3], "von_mises": table["von_mises"],
                       "principal_1": table["principal_1"], "principal_3": table["principal_3"], "arc_length": table["arc_length"],
                       "gap": table["gap"], "pressure": table["pressure"]}
            for column, values in columns.items():
                given = numpy.array([float(row[column]) if row[column] else numpy.nan for row in rows])
                # Files have nine digits of the largest value of a kind: stresses of 1e5, lengths of 1, displacements of .1.
                size = 1e-3 if column.startswith(("s", "von", "prin", "pre")) else 1e-8
                numpy.testing.assert_allclose(values, given, rtol=1e-8, atol=size, err_msg="%s %s" % (name, column))
        self.assertTrue(numpy.isfinite(result.probes["seat"]["pressure"]).all())
        self.assertTrue(numpy.isnan(result.probes["cut"]["gap"]).all())

    def test_points_have_the_values_of_a_constant_strain(self):
        result = suture.solve(blocks())
        points = numpy.array([[-0.3, -0.9], [0.77, 0.123], [1.0, 1.0]])
        numpy.testing.assert_allclose(result.probe(points, "displacement")[:, 1], -0.05 * (points[:, 1] + 1), atol=1e-9)
        numpy.testing.assert_allclose(result.probe(points, "stress"), [[0, -1e5, 0, 0]] * 3, atol=1e-2)
        numpy.testing.assert_allclose(result.probe(points, "von_mises"), 1e5, rtol=1e-6)
        self.assertEqual(result.probe(points)["body"], ["lower", "upper", "upper"])
        self.assertAlmostEqual(result.probe([0.2, 0.5], "principal_3"), -1e5, delta=1e-2)
        self.assertEqual(result.probe([0.2, 0.0], "body", body="lower"), "lower")

    def test_points_do_not_depend_on_the_number_of_ranks(self):
        points = numpy.random.default_rng(1).uniform(-1, 1, (20, 2))
        own = suture.solve(leaning(), comm=MPI.COMM_SELF).probe(points)
        together = suture.solve(leaning()).probe(points)
        for name in ("displacement", "stress", "von_mises", "principal_1"):
            numpy.testing.assert_allclose(together[name], own[name], rtol=1e-5, atol=1e-5 * numpy.abs(own[name]).max())
        self.assertEqual(together["body"], own["body"])

    def test_wrong_points_are_errors_on_all_ranks(self):
        result = suture.solve(blocks())
        self.assertRaisesRegex(suture.InputError, r"the point \(3, 0\) is outside all bodies", result.probe, [3, 0])
        self.assertRaisesRegex(suture.InputError, "Did you mean 'upper'", result.probe, [0, 0.5], body="uper")
        self.assertRaisesRegex(suture.InputError, "3 coordinates per point; expected 2", result.probe, [0, 0.5, 0])
        self.assertRaisesRegex(ValueError, "'presure' is unknown; known are", result.probe, [0, 0.5], "presure")
        self.assertRaises(ValueError, result.probe, "nowhere")
        with self.assertRaises(ValueError):  # only one rank is wrong
            result.probe([0, 0.5] if WORLD.rank < WORLD.size - 1 else [[[0, 0.5]]])


class Fields(unittest.TestCase):
    def test_nodal_fields_of_a_constant_strain(self):
        fields = suture.solve(blocks()).fields(root=None)
        numpy.testing.assert_allclose(fields.nodal_stress, [[0, -1e5, 0, 0]] * 162, atol=1e-2)
        numpy.testing.assert_allclose(fields.nodal_von_mises, 1e5, rtol=1e-6)
        numpy.testing.assert_allclose(fields.nodal_principal, [[0, 0, -1e5]] * 162, atol=1e-2)
        seat = (numpy.abs(fields.coordinates[:, 1]) < 1e-12) & numpy.isfinite(fields.pressure)
        self.assertEqual(seat.sum(), 9)  # nodes of the side that carries the pairs
        numpy.testing.assert_allclose(fields.pressure[seat], 1e5, rtol=1e-6)
        numpy.testing.assert_allclose(fields.gap[seat], 0, atol=1e-9)
        self.assertTrue((fields.status[seat] == suture.SLIP).all())
        self.assertTrue((fields.status[~seat] == -1).all())
        self.assertTrue(numpy.isnan(fields.pressure[~seat]).all())

    def test_fields_do_not_depend_on_the_number_of_ranks(self):
        for scene in (leaning(), bricks("Hexahedron8")):
            own, together = suture.solve(scene, comm=MPI.COMM_SELF).fields(), suture.solve(scene).fields(root=None)
            for name in ("displacement", "nodal_stress", "nodal_principal", "pressure", "gap", "slip", "stress"):
                values = getattr(own, name)
                scale = numpy.nanmax(numpy.abs(values)) if name != "gap" else numpy.abs(own.displacement).max()
                numpy.testing.assert_allclose(getattr(together, name), values, rtol=0, atol=1e-4 * scale, err_msg=name)
            self.assertTrue((together.status == own.status).all())

    def test_invariants_are_those_of_the_library(self):
        result = suture.solve(leaning(**PROBES))
        probe, fields = result.probes["seat"], result.fields(root=None)
        place = {tuple(numpy.round(x, 9)): i for i, x in enumerate(fields.coordinates) if numpy.isfinite(fields.pressure[i]) or x[1] > 0}
        for i, x in enumerate(probe["position"]):
            node = place.get(tuple(numpy.round(x, 9)))
            if node is None:
                continue
            self.assertAlmostEqual(fields.nodal_von_mises[node] / probe["von_mises"][i], 1, places=9)
            self.assertAlmostEqual(fields.nodal_principal[node, 0], probe["principal_1"][i], delta=1e-3)
            self.assertAlmostEqual(fields.nodal_principal[node, 2], probe["principal_3"][i], delta=1e-3)

    def test_only_the_root_has_the_fields(self):
        result = suture.solve(blocks())
        self.assertEqual(result.fields(root=0) is None, WORLD.rank != 0)
        self.assertEqual(len(result.nodal_stresses()), len(result.subdomains))
        for stress, subdomain in zip(result.nodal_stresses(), result.subdomains):
            self.assertEqual(stress.shape, (len(subdomain.nodes), 4))


class Texts(unittest.TestCase):
    def test_a_result_shows_verdict_size_and_extremes(self):
        text = repr(suture.solve(blocks()))
        for part in ("suture.Result: Two blocks", "converged and verified", "128 elements, 162 nodes, 288 unknowns in 8 subdomains on %d rank" % WORLD.size,
                     "9 of 9 pairs closed, largest pressure 1e+05 Pa", "largest displacement 0.1 m in 'upper'", "von Mises stress 1e+05 Pa in"):
            self.assertIn(part, text)

    def test_a_result_that_does_not_hold_says_so(self):
        result = suture.solve(blocks(), set={"Outer Solver/Maximum Iterations": 0}, check=False)
        self.assertIn("NOT CONVERGED", repr(result))

    def test_parts_of_a_result(self):
        result = suture.solve(blocks())
        for subdomain in result.subdomains:
            self.assertRegex(repr(subdomain), r"<suture.Subdomain \d+ 'subdomain_\w+' of body '\w+': 25 nodes, 16 elements, largest displacement 0\.\d+>")
        expected = "9 pairs, 9 closed (0 of them stick), largest gap" if WORLD.rank == 0 else "none on this rank"
        self.assertIn(expected, repr(result.pairs))
        self.assertIn("162 nodes, 128 elements, bodies lower, upper; largest displacement 0.1, largest von Mises stress 1e+05", repr(result.fields(None)))

    def test_a_coupling(self):
        scene = blocks()
        scene["Boundary Conditions"]["press"] = {"Group": "upper_left", "Type": "Bilateral"}
        coupling = suture.Coupling(scene)
        self.assertIn("no surface yet; not solved yet", repr(coupling))
        surface = coupling.surface("upper_top")
        coupling.set_forces(surface, -1e5 * surface.normals)
        coupling.solve()
        self.assertIn("'upper_top'; 1 solve, the last solution is valid; energy -", repr(coupling))


class Plots(unittest.TestCase):
    def test_plot_of_a_run_without_files(self):
        for scene, kinds in ((leaning(), ("von_mises",)), (bricks("Hexahedron8"), ("deformation",))):
            result = suture.solve(scene)
            for kind in kinds:
                file = WORLD.bcast(os.path.join(tempfile.mkdtemp(), kind + ".png") if WORLD.rank == 0 else None)
                figure = result.plot(kind, file=file)
                self.assertEqual(figure is None, WORLD.rank != 0)
                if WORLD.rank == 0:
                    with open(file, "rb") as image:
                        self.assertEqual(image.read(4), b"\x89PNG")
                    self.assertGreater(os.path.getsize(file), 5000)
                    self.assertEqual(figure._repr_png_()[:4], b"\x89PNG")  # shown by notebooks
                    self.assertGreater(len(figure.caption), 20)

    def test_plot_with_load_steps(self):
        steps = {"Load Steps": {"Times": [0.5, 1]}}
        result = suture.solve(leaning(**steps))
        figure = result.plot("steps")
        self.assertEqual(figure is None, WORLD.rank != 0)

    def test_plot_uses_the_files_of_the_run(self):
        folder = WORLD.bcast(tempfile.mkdtemp() if WORLD.rank == 0 else None)
        result = suture.solve(leaning(), output=folder)
        before = set(glob.glob(os.path.join(tempfile.gettempdir(), "suture_*")))
        result.plot("convergence")
        WORLD.barrier()
        self.assertEqual(set(glob.glob(os.path.join(tempfile.gettempdir(), "suture_*"))) - before, set())

    @unittest.skipIf("DISPLAY" in os.environ or "WAYLAND_DISPLAY" in os.environ, "there is a display")
    def test_show_needs_a_display(self):
        self.assertRaisesRegex(RuntimeError, "there is no display; pass file=", suture.solve(blocks()).plot, "scene", show=True)

    def test_unknown_plots_are_errors_on_all_ranks(self):
        self.assertRaisesRegex(ValueError, "no plot 'van_mises'; it has .*von_mises", suture.solve(blocks()).plot, "van_mises")

    def test_settings_of_matplotlib_stay(self):
        result = suture.solve(blocks())
        if WORLD.rank == 0:
            import matplotlib
            matplotlib.use("svg")
            from matplotlib import pyplot
            pyplot.rcParams["font.size"] = 17
            mine = pyplot.figure()
        result.plot("mesh")
        if WORLD.rank == 0:
            self.assertEqual((matplotlib.get_backend(), pyplot.rcParams["font.size"]), ("svg", 17))
            self.assertEqual(pyplot.get_fignums(), [mine.number])


class Values(unittest.TestCase):
    """Values of a dictionary where the scene file has texts."""

    def energy(self, change, **settings):
        scene = leaning(**settings)
        change(scene)
        return suture.solve(scene).energy

    def test_numbers_are_texts(self):
        def texts(scene):
            scene["Contact"]["joint"].update({"Coulomb": {"Coefficient": "0.4", "Cohesion": "10"}, "Initial Gap": "0.001"})
            scene["Outer Solver"] = {"Tolerance": "1e-10"}
            scene["Constants"] = {"q": 2e4}
            scene["Functions"] = {"f": "3"}
            scene["Title"] = "2024"
            scene["Boundary Conditions"]["wind"] = {"Group": "upper_left", "Type": "Pressure", "Expression": "20000"}
            scene["Boundary Conditions"]["drag"] = {"Group": "upper_right", "Type": "Traction", "Expression x": "5", "Expression y": "0"}

        def numbers(scene):
            scene["Contact"]["joint"].update({"Coulomb": {"Coefficient": numpy.float32(0.4), "Cohesion": 10}, "Initial Gap": 0.001})
            scene["Contact"]["joint"]["Coulomb"]["Coefficient"] = 0.4
            scene["Outer Solver"] = {"Tolerance": 1e-10}
            scene["Constants"] = {"q": numpy.float64(2e4)}
            scene["Functions"] = {"f": 3}
            scene["Title"] = 2024
            scene["Boundary Conditions"]["wind"] = {"Group": ["upper_left"], "Type": "Pressure", "Expression": numpy.array(20000)}
            scene["Boundary Conditions"]["drag"] = {"Group": "upper_right", "Type": "Traction", "Expression x": 5, "Expression y": 0.0}

        self.assertEqual(self.energy(texts), self.energy(numbers))

    def test_lists_of_numbers_are_texts(self):
        def path(values):
            return {"Load Steps": {"Times": [0.5, 1], "Factors": {"wind": values}}}

        self.assertEqual(self.energy(lambda scene: None, **path("{0.5, 2}")), self.energy(lambda scene: None, **path([0.5, 2])))
        self.assertEqual(self.energy(lambda scene: None, **path("2")), self.energy(lambda scene: None, **path(2)))

    def test_changes_may_be_numbers_lists_bools_and_nested(self):
        flat = {"Outer Solver/Tolerance": 1e-9, "Boundary Conditions/press/Value": numpy.array([0.0, -0.2]), "Output/Nodal Stresses": True,
                "Contact/joint/Coulomb/Coefficient": 1, "Contact/joint/Side A": ["upper_bottom"]}
        nested = {"Outer Solver": {"Tolerance": 1e-9}, "Boundary Conditions": {"press": {"Value": (0, -0.2)}}, "Output/Nodal Stresses": True,
                  "Contact/joint": {"Coulomb": {"Coefficient": "1"}, "Side A": "upper_bottom"}}
        energies = [suture.solve(leaning(), set=values).energy for values in (flat, nested)]
        self.assertEqual(*energies)

    def refused(self, place, value, error, message):
        scene = leaning()
        at = scene
        *lists, name = place.split("/")
        for one in lists:
            at = at.setdefault(one, {})
        at[name] = value
        self.assertRaisesRegex(error, message, suture.solve, scene)

    def test_wrong_types_are_named_with_their_place(self):
        self.refused("Contact/joint/Coulomb/Coefficient", True, suture.InputError, "Contact/joint/Coulomb/Coefficient: is of type bool .'true'., expected type string")
        self.refused("Contact/joint/Coulomb/Coefficient", {"value": 1}, suture.InputError, "Contact/joint/Coulomb/Coefficient: is a parameter, not a list")
        self.refused("Contact/joint/Law", 3, suture.InputError, "Contact/joint/Law: is of type int .'3'., expected type string: one of: Coulomb")
        self.refused("Model", 2.0, suture.InputError, "Model: is of type double")
        self.refused("Contact/joint/Initial Gap", float("nan"), suture.InputError, "Contact/joint/Initial Gap: 'nan' is not of its type double")
        self.refused("Materials/rubber/Young Modulus", "stiff", suture.InputError, "Materials/rubber/Young Modulus: ")
        self.refused("Materials/rubber", 3, suture.InputError, "Materials/rubber: is a list of parameters, not a parameter|Materials/rubber: ")
        self.refused("Boundary Conditions/wind/Value", [1, "two"], suture.InputError, "Boundary Conditions/wind/Value: ")
        self.refused("Boundary Conditions/wind/Value", [1, [2]], TypeError, "Boundary Conditions/wind/Value: a list must contain only numbers or only texts")
        self.refused("Boundary Conditions/wind/Value", [1, None], TypeError, "Boundary Conditions/wind/Value, entry 2: .*not NoneType")
        self.refused("Boundary Conditions/wind/Group", ["upper_left, upper_right"], ValueError, "Group, entry 1: 'upper_left, upper_right' cannot be an entry")
        self.refused("Title", {1, 2}, TypeError, "Title: .*not set")
        self.assertRaisesRegex(TypeError, "Outer Solver/Tolerance: .*not NoneType", suture.solve, leaning(), set={"Outer Solver": {"Tolerance": None}})


if __name__ == "__main__":
    unittest.main(verbosity=2 if WORLD.rank == 0 else 0)
