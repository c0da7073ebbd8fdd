"""User functions that fail on some rank, Ctrl-C, and objects that outlive the interpreter. Runs on any number of ranks; child processes run on
one. Arguments: test_callbacks.py SOURCE"""
import os
import signal
import subprocess
import sys
import textwrap
import time
import unittest

import numpy
from mpi4py import MPI

import suture

WORLD = MPI.COMM_WORLD
SOURCE = sys.argv.pop(1)
APART = {name: value for name, value in os.environ.items() if not name.startswith(("PMIX_", "OMPI_COMM", "OMPI_APP", "OMPI_UNIVERSE",
                                                                                    "OMPI_NUM", "OMPI_FIRST", "OMPI_MCA_ess", "OMPI_MCA_orte",
                                                                                    "OMPI_MCA_initial", "OMPI_FILE", "OMPI_ARGV", "OMPI_COMMAND"))}


class Unpicklable(Exception):
    def __init__(self, one, two):
        super().__init__(one)
        self.two = (lambda: two)


def scene(material=None, **settings):
    square = {"Cells": [8, 8], "Cell": "Quadrilateral4", "Blocks": [2, 2]}
    return {"Model": "Plane Strain", "Mesh": {"Generator": "Boxes", "Boxes": {"a": square}}, "Bodies": {"a": {"Material": "m"}},
            "Materials": {"m": {"Type": material} if material else {"Young Modulus": 1.0, "Poisson Ratio": 0.0}},
            "Boundary Conditions": {"h": {"Type": "Displacement", "Group": "a_bottom", "Value": [0.0, 0.0]},
                                    "p": {"Type": "Pressure", "Group": "a_top", "Value": 1e-3}},
            "Partition": {"Type": "Named Groups", "Named Groups": {"Pattern": "subdomain_*"}}, **settings}


def interrupt():
    os.kill(os.getpid(), signal.SIGINT)
    for _ in range(1000):  # Python raises KeyboardInterrupt between two bytecode instructions
        time.sleep(0.001)


# Fault of a function, and the exception that all ranks get: class and part of the message.
FAULTS = {"raises": (lambda: 1 / 0, ZeroDivisionError, "division by zero"),
          "raises its own": (lambda: (_ for _ in ()).throw(Unpicklable("mine", 2)), RuntimeError, "Unpicklable: mine"),
          "exits": (lambda: sys.exit(3), SystemExit, "3"),
          "is interrupted": (interrupt, KeyboardInterrupt, ""),
          "returns None": (lambda: None, suture.InputError, "returned None; expected "),
          "returns a text": (lambda: "stiff", suture.InputError, "the type str; expected "),
          "returns NaN": (lambda: numpy.full((6, 6), numpy.nan), suture.InputError, "finite")}


def caught(work):
    """The exception raised by `work`, of any kind."""
    try:
        work()
    except BaseException as error:
        return error
    return None


class Callbacks(unittest.TestCase):
    def same_everywhere(self, work, kind, text):
        """All ranks get the same exception, and can continue together."""
        error = caught(work)
        errors = WORLD.allgather((type(error).__name__, str(error)))
        self.assertEqual(set(errors), {errors[0]}, errors)
        self.assertIsInstance(error, kind, error)
        self.assertIn(text, str(error))
        self.assertAlmostEqual(suture.solve(scene()).energy, -0.5e-6, 12)
        return error

    def test_a_material_that_fails_on_one_rank_fails_on_all(self):
        for name, (fault, kind, text) in FAULTS.items():
            for failing in {0, WORLD.size - 1, -1}:  # -1: all of them
                @suture.material("Failing")
                def law():
                    return fault() if failing in (WORLD.rank, -1) else numpy.eye(6)
                with self.subTest(name, rank=failing):
                    self.same_everywhere(lambda: suture.solve(scene("Failing")), kind, text)

    def test_a_weighting_that_fails_on_one_rank_fails_on_all(self):
        changes = {"Preconditioner/Type": "Neumann-Neumann", "Preconditioner/Neumann-Neumann/Weighting": "Failing"}
        for name, (fault, kind, text) in FAULTS.items():
            for failing in {0, WORLD.size - 1}:
                @suture.weighting("Failing")
                def weights(local):
                    found = fault() if failing == WORLD.rank else local.stiffness_diagonal
                    return numpy.full(local.size, numpy.nan) if name == "returns NaN" and failing == WORLD.rank else found
                with self.subTest(name, rank=failing):
                    self.same_everywhere(lambda: suture.solve(scene(), set=changes), kind, "not numbers" if name == "returns NaN" else text)

    def test_the_exception_of_a_rank_keeps_its_traceback_there(self):
        @suture.material("Failing")
        def law():
            raise KeyError("here") if WORLD.rank == 0 else ValueError("there")
        error = self.same_everywhere(lambda: suture.solve(scene("Failing")), KeyError, "here")
        if WORLD.rank == 0:
            names = []
            trace = error.__traceback__
            while trace:
                names.append(trace.tb_frame.f_code.co_name)
                trace = trace.tb_next
            self.assertIn("law", names)

    def test_a_dictionary_that_is_wrong_on_one_rank_is_wrong_on_all(self):
        self.same_everywhere(lambda: suture.solve(scene(**({"Title": object()} if WORLD.rank == WORLD.size - 1 else {}))), TypeError, "Title")

    def test_values_that_are_wrong_on_one_rank_are_wrong_on_all(self):
        coupling = suture.Coupling(scene())
        surface = coupling.surface("a_right")
        for wrong, kind, text in (("text", ValueError, "could not convert"), (numpy.zeros(1), suture.InputError, "values")):
            given = wrong if WORLD.rank == 0 else numpy.zeros(surface.coordinates.shape)
            self.same_everywhere(lambda: coupling.set_forces(surface, given), kind, text)
        coupling.solve()

    def test_paths_that_are_wrong_on_one_rank_are_wrong_on_all(self):
        wrong = 1 if WORLD.rank == WORLD.size - 1 else None
        self.same_everywhere(lambda: suture.solve(scene(), output=wrong), TypeError, "")
        self.same_everywhere(lambda: suture.study("none.xml", output=wrong or ""), TypeError, "")
        self.same_everywhere(lambda: suture.solve(wrong or "none.xml"), TypeError, "")

    def test_a_wrong_order_is_an_error(self):
        coupling = suture.Coupling(scene())
        surface = coupling.surface("a_right")
        self.same_everywhere(coupling.advance, suture.InternalError, "advance() before")
        self.same_everywhere(lambda: coupling.energy, suture.InternalError, "solution() before")
        other = suture.Coupling(scene())
        self.same_everywhere(lambda: other.set_forces(surface, surface.coordinates), suture.InternalError, "not from surface()")

    def test_numbers_are_texts_where_a_text_is_wanted(self):
        given = scene()
        given["Boundary Conditions"]["p"] = {"Type": "Traction", "Group": "a_top", "Expression x": 0, "Expression y": -1e-3}
        self.assertAlmostEqual(suture.solve(given).energy, -0.5e-6, 12)
        given["Load Steps"] = {"Times": [1.0], "Factors": {"p": 2}}
        self.assertAlmostEqual(suture.solve(given).energy, -2e-6, 12)


def child(text, *words, folder=None, **more):
    return subprocess.Popen([sys.executable, "-B", *words, "-c", textwrap.dedent(text)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                            env={**APART, "PYTHONPATH": os.environ["PYTHONPATH"]}, cwd=SOURCE, **more)


@unittest.skipIf(WORLD.size > 1, "processes of one rank")
class Processes(unittest.TestCase):
    def ends(self, text, code, said):
        process = child(text)
        out, err = process.communicate(timeout=60)
        self.assertEqual((process.returncode, out.strip()), (code, said), err)
        return err

    def test_objects_in_global_variables_do_not_abort_at_the_end(self):
        self.assertEqual(self.ends("""
            import suture
            c = suture.Coupling("input/bracket/bracket.xml")
            s = c.surface("roller_top")
            c.solve()
            result = suture.solve("input/two_blocks/two_blocks.xml")
            gap, u = result.pairs.gap, c.displacements(s)
            class Late:
                def __del__(self): print(len(gap) > 0, gap[0] == gap[0])
            late = Late()
            """, 0, "True True"), "")

    def test_sys_exit_in_a_function_ends_the_program_with_its_code(self):
        self.ends("""
            import sys, suture
            @suture.material("M")
            def law(): sys.exit(3)
            suture.solve({"Model": "Plane Strain", "Mesh": {"Generator": "Boxes", "Boxes": {"a": {"Cells": [2, 2]}}}, "Bodies": {"a": {"Material": "m"}},
              "Materials": {"m": {"Type": "M"}}, "Boundary Conditions": {"h": {"Type": "Displacement", "Group": "a_bottom", "Value": [0., 0.]}}})
            print("not reached")
            """, 3, "")

    def test_a_closed_standard_output_is_no_error(self):
        process = subprocess.run(["sh", "-c", 'exec "$@" >&-', "sh", sys.executable, "-B", "-c",
                                  'import suture; suture.solve("input/two_blocks/two_blocks.xml", show=True)'], capture_output=True, text=True,
                                 env={**APART, "PYTHONPATH": os.environ["PYTHONPATH"]}, cwd=SOURCE, timeout=60)
        self.assertEqual((process.returncode, process.stderr), (0, ""))

    def interrupted(self, text):
        """Output of a child process that gets Ctrl-C after it has printed "now"."""
        process = child(text)
        self.assertEqual(process.stdout.readline().strip(), "now")
        time.sleep(0.3)
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=60)
        return process.returncode, out.split(), err

    ENDLESS = """
        import signal, suture
        @suture.weighting("Slow")
        def slow(local):
            return local.stiffness_diagonal
        print("now", flush=True)
        try:
            while True: %s
        except KeyboardInterrupt:
            print("interrupted", signal.getsignal(signal.SIGINT) is signal.default_int_handler, flush=True)
        print(abs(suture.solve("input/two_blocks/two_blocks.xml").energy) > 0)
        """

    def test_ctrl_c_ends_a_run_and_is_a_keyboard_interrupt(self):
        code, said, err = self.interrupted(self.ENDLESS % 'suture.solve("input/two_blocks/two_blocks.xml")')
        self.assertEqual((code, said), (0, ["interrupted", "True", "True"]), err)

    def test_ctrl_c_ends_a_study_and_leaves_the_handlers_alone(self):
        import tempfile
        with tempfile.TemporaryDirectory() as folder:
            work = 'suture.study("test/drivers/study/tiny.xml", output="%s")' % folder
            code, said, err = self.interrupted(self.ENDLESS % work)
            self.assertEqual((code, said), (0, ["interrupted", "True", "True"]), err)

    def test_an_interrupt_long_after_a_study_still_reaches_python(self):
        import tempfile
        with tempfile.TemporaryDirectory() as folder:
            self.ends("""
                import os, signal, time, suture
                suture.study("test/drivers/study/tiny.xml", output="%s", only=["small", "coarse space=None"])
                try:
                    os.kill(os.getpid(), signal.SIGINT)
                    time.sleep(5)
                except KeyboardInterrupt:
                    print("interrupted")
                """ % folder, 0, "interrupted")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "-v"] if WORLD.rank == 0 else [sys.argv[0]])
