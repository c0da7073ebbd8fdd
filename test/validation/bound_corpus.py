"""V22: bounds of the energy error of random scenes (bound_scenes.py) against the same scenes on meshes four times finer.

The energy J of the finer solution lies above that of the exact one, so that a strict bound of the coarse solution must satisfy

    bound.total^2 >= 2 (J(coarse) - J(fine)),     bound.energy_lower <= J(exact) <= J(fine).

With friction J includes the integral of g |slip|, g the bound of the friction stress. For friction that depends on pressures the bound is
that of the Tresca problem with the bounds g of the coarse solution, in which the finer solution is admissible: 2 (J(coarse) - J(fine)) with
this g is compared too (kind "friction"), up to the interpolation of g.

Every fourth scene runs on three ranks. Estimates are counted: they need not hold.

  bound_corpus.py --solve build/drivers/suture_solve --output out --count 40 --first 1 --mpirun "mpirun --oversubscribe"

With --solids the scenes are in 3D (bound_solids.py), and their finer meshes have a third of the element size.
"""
import bisect
import collections
import math
import os
import re
import shutil
import statistics
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import bound_scenes  # noqa: E402
import bound_solids  # noqa: E402
import corpus_runs  # noqa: E402
import friction_corpus  # noqa: E402

LIMIT = 120        # seconds of a run
FINER = 4          # elements of the finer mesh along an edge of the coarse one
FINER_SOLIDS = 3   # likewise in 3D
ROUND_OFF = 1e-9   # of the energies, in their difference
INTERPOLATED = 0.02  # of the bound: effect of the interpolation of g
ENDS = (0, 3, 4)   # exit codes of sound runs
GIVEN = re.compile(r"^friction: proved for given bounds .* by (\S+) of their sum$")
FAILED = ("VIOLATED", "TRESCA VIOLATED", "WRONG INTERVAL", "no bound", "hang", "bug")
LEAST_STRICT = 0.3  # of the scenes that are solved: with fewer the test would show little


class Bounded:
    """A run with its energy and its bound; `total` is None if the run has neither a bound nor an estimate."""

    def __init__(self, run):
        self.run, bound = run, run.summary.get("bound") or {}
        self.energy, self.iterations = run.summary.get("energy"), run.summary.get("outer", {}).get("pcg_total")
        self.total, self.strict, self.reasons = bound.get("total"), bound.get("strict") is True, bound.get("reasons") or []
        self.lower, self.upper = bound.get("energy_lower"), bound.get("energy_upper")
        given = [GIVEN.search(reason) for reason in self.reasons]
        self.change, self.pairs = next((float(found.group(1)) for found in given if found), None), pairs_of(run.pairs)

    def friction(self):
        """True if friction that depends on the solution is the only reason for an estimate."""
        return self.change is not None and len(self.reasons) == 1 and self.upper is not None


def pairs_of(rows):
    """Pairs by contact: place along it, length, slip and bound of friction, in the order of the places. `rows`: of contact.csv"""
    contacts = collections.defaultdict(list)
    for row in rows:
        if "bound" in row:
            value = {key: float(row[key] or 0) for key in ("x", "y", "nx", "ny", "length", "slip_x", "slip_y", "bound")}
            place = value["nx"] * value["y"] - value["ny"] * value["x"]
            contacts[row["contact"]].append((place, value["length"], math.hypot(value["slip_x"], value["slip_y"]), value["bound"]))
    return {name: sorted(own) for name, own in contacts.items()}


def friction_energy(bounds, slips):
    """Sum of length times g times slip over the pairs `slips`, g interpolated between the pairs `bounds`."""
    total = 0.0
    for name, rows in slips.items():
        known = [(place, bound / length) for place, length, _, bound in bounds.get(name, []) if length > 0]
        places = [place for place, _ in known]
        for place, length, slip, _ in rows:
            at = min(max(bisect.bisect(places, place), 1), len(known) - 1)
            (x, g), (y, h) = known[at - 1], known[at]
            part = min(max((place - x) / (y - x), 0.0), 1.0) if y > x else 0.0
            total += length * slip * (g + part * (h - g))
    return total


def judge(coarse, fine):
    """Class of a scene, a remark, and the bound divided by the error against the finer mesh, if there is an error."""
    for name, one in (("coarse", coarse.run), ("fine", fine.run)):
        if one.code == "hang":
            return "hang", name, None
        if one.code not in ENDS:
            return "bug", "%s: %s: %s" % (name, one.code, one.text[-600:]), None
    if not (coarse.run.solved and fine.run.solved):
        codes = coarse.run.code, fine.run.code
        return ("refused" if codes == (3, 3) else "not solved"), "%s | %s" % (coarse.run.failure[:200], fine.run.failure[:200]), None
    if coarse.total is None:
        return ("not computed", "; ".join(coarse.reasons), None) if coarse.reasons else ("no bound", coarse.run.text[-600:], None)
    # An admissible displacement of the finer run, if its own violates a contact between nodes: the exact energy lies below.
    known = fine.upper if fine.strict and fine.upper is not None else fine.energy
    slack = ROUND_OFF * max(abs(coarse.energy), abs(known))
    # Where the coarse solution penetrates, its energy may be too low for a test.
    square = 2 * (coarse.energy - known)
    remark = "bound^2 %.4e, 2 (J - J_fine) %.4e, J %.6e" % (coarse.total ** 2, square, coarse.energy)
    ratio = coarse.total / math.sqrt(square) if square > 100 * slack else None
    if coarse.friction():
        exact = fine.energy + friction_energy(coarse.pairs, fine.pairs)
        square = 2 * (coarse.upper - exact)
        remark = "bound^2 %.4e, 2 (J - J_fine) %.4e, change %.1e" % (coarse.total ** 2, square, coarse.change)
        ratio = coarse.total / math.sqrt(square) if square > 100 * slack else None
        holds = coarse.lower <= exact + INTERPOLATED * coarse.total ** 2 / 2 + slack
        return ("friction" if holds else "TRESCA VIOLATED"), remark, ratio
    if not coarse.strict:
        return "estimate", "; ".join(coarse.reasons), ratio
    if coarse.total ** 2 < square - slack:
        return "VIOLATED", remark, ratio
    if coarse.lower is not None and coarse.lower > known + slack:
        return "WRONG INTERVAL", "energy_lower %.9e above J_fine %.9e" % (coarse.lower, known), ratio
    if fine.strict and fine.lower is not None and coarse.upper is not None and fine.lower > coarse.upper + slack:
        return "WRONG INTERVAL", "energy_lower of the finer mesh %.9e above energy_upper %.9e" % (fine.lower, coarse.upper), ratio
    return ("holds" if ratio else "holds, no error"), remark, ratio


def play(options, seed):
    ranks = 3 if seed % 4 == 0 else 1
    program = [*(options.mpirun.split() + ["-np", str(ranks)] if ranks > 1 else []), options.solve]
    folders, runs = [], []
    for name, refine in (("coarse", 1), ("fine", FINER_SOLIDS if options.solids else FINER)):
        scene = (bound_solids if options.solids else bound_scenes).scene(seed, refine, options.family, options.law)
        folders.append(os.path.join(options.output, "s%d_%s" % (seed, name)))
        scene.write(folders[-1])
        tolerance = (options.tolerance or "%g" % scene.tolerance) if refine == 1 else "1e-10"
        runs.append(Bounded(friction_corpus.Run(program, folders[-1], "run", ["Output/Error Bound=true", "Outer Solver/Tolerance=" + tolerance], LIMIT)))
    # The energy of enhanced elements lies below that of their displacements.
    if {"Quadrilateral4", "Hexahedron8"} & set(scene.cells) and runs[0].upper is not None:
        runs[0].energy = runs[0].upper
    kind, remark, ratio = judge(*runs)
    coarse = runs[0].run.summary
    result = {"seed": seed, "family": scene.family, "cell": scene.cell, "class": kind, "remark": remark, "ratio": ratio, "ranks": ranks,
              "flaws": scene.flaws, "change": runs[0].change, "dofs": coarse.get("dofs"), "bound": coarse.get("bound"), "tolerance": scene.tolerance,
              "seconds": {name: (one.run.summary.get("phases", {}).get("bound") or {}).get("max") for name, one in zip(("coarse", "fine"), runs)}}
    if kind not in FAILED:
        for folder in folders:
            shutil.rmtree(folder)
    return result


def kind_of(reason):
    """A reason without its names, numbers and places."""
    return re.sub(r"'[^']*'", "'...'", re.sub(r"\(?-?[0-9][-0-9.e+, ]*\)?", "# ", reason)).strip()


def table(results):
    """Classes, and bound over error by element."""
    lines = [", ".join("%s %d" % each for each in sorted(collections.Counter(r["class"] for r in results).items()))]
    for cell in sorted({r["cell"] for r in results}):
        for kind in ("holds", "friction", "estimate"):
            ratios = [(r["ratio"], r["seed"]) for r in results if r["cell"] == cell and r["class"] == kind and r["ratio"]]
            if ratios:
                lines.append("  %s, %s: bound over error against the finer mesh: least %.3f (seed %d), median %.2f, largest %.2f (seed %d), of %d"
                             % (cell, {"holds": "strict", "friction": "Tresca problem"}.get(kind, kind), *min(ratios), statistics.median(x for x, _ in ratios), *max(ratios), len(ratios)))
    reasons = collections.Counter(kind_of(reason) for r in results if r["class"] in ("estimate", "not computed") for reason in (r["bound"] or {}).get("reasons", []))
    changes = [r["change"] for r in results if r["class"] == "friction"]
    if changes:
        lines.append("  changes of the friction bounds: median %.1e, largest %.1e" % (statistics.median(changes), max(changes)))
    return lines + ["  %d estimates: %s" % (count, reason) for reason, count in reasons.most_common()]


def main():
    results = []
    parser = corpus_runs.parser(__doc__)
    parser.add_argument("--law", choices=["Tresca", "Coulomb", "Tied", "No Separation"], help="law of all contacts of two bodies")
    parser.add_argument("--solids", action="store_true", help="scenes in 3D")
    parser.add_argument("--tolerance", help="of the solver on the coarse meshes, or Automatic, instead of that of each scene")
    for result in corpus_runs.results(parser.parse_args(), play):
        results.append(result)
        if result["class"] in FAILED:
            print("%(seed)d %(family)s %(cell)s: %(class)s: %(remark)s" % result, flush=True)
    print("\n".join(table(results)))
    solved = [r for r in results if r["class"] in ("holds", "holds, no error", "friction", "estimate", "not computed")]
    strict = sum(r["class"].startswith("holds") or r["class"] == "friction" for r in solved)
    few = strict < LEAST_STRICT * len(solved) or not solved
    if few:
        print("only %d of %d bounds are strict" % (strict, len(solved)))
    return 1 if few or any(r["class"] in FAILED for r in results) else 0


if __name__ == "__main__":
    sys.exit(main())
