"""V22: bounds of the energy error of random scenes (bound_scenes.py) against the same scenes on meshes four times finer.

The energy J of the finer solution lies above that of the exact one, so that a strict bound of the coarse solution must satisfy

    bound.total^2 >= 2 (J(coarse) - J(fine)),     bound.energy_lower <= J(exact) <= J(fine).

Every fourth scene runs on three ranks. Estimates are counted: they need not hold.

  bound_corpus.py --solve build/drivers/suture_solve --output out --count 40 --first 1 --mpirun "mpirun --oversubscribe"
"""
import collections
import math
import os
import re
import shutil
import statistics
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import bound_scenes  # noqa: E402
import corpus_runs  # noqa: E402
import friction_corpus  # noqa: E402

LIMIT = 120        # seconds of a run
FINER = 4          # elements of the finer mesh along an edge of the coarse one
ROUND_OFF = 1e-9   # of the energies, in their difference
ENDS = (0, 3, 4)   # exit codes of sound runs
FAILED = ("VIOLATED", "WRONG INTERVAL", "no bound", "hang", "bug")
LEAST_STRICT = 0.3  # of the scenes that are solved: with fewer the test would show little


class Bounded:
    """A run with its energy and its bound; `total` is None if the run has neither a bound nor an estimate."""

    def __init__(self, run):
        self.run, bound = run, run.summary.get("bound") or {}
        self.energy, self.iterations = run.summary.get("energy"), run.summary.get("outer", {}).get("pcg_total")
        self.total, self.strict, self.reasons = bound.get("total"), bound.get("strict") is True, bound.get("reasons") or []
        self.lower, self.upper = bound.get("energy_lower"), bound.get("energy_upper")


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
    # Likewise the energy of an admissible displacement of the coarse run; that of mixed elements is not a potential energy.
    square = 2 * (max(coarse.energy, coarse.upper) if coarse.strict and coarse.upper is not None else coarse.energy) - 2 * known
    remark = "bound^2 %.4e, 2 (J - J_fine) %.4e, J %.6e" % (coarse.total ** 2, square, coarse.energy)
    ratio = coarse.total / math.sqrt(square) if square > 100 * slack else None
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
    for name, refine in (("coarse", 1), ("fine", FINER)):
        scene = bound_scenes.scene(seed, refine, options.family)
        folders.append(os.path.join(options.output, "s%d_%s" % (seed, name)))
        scene.write(folders[-1])
        tolerance = (options.tolerance or "%g" % scene.tolerance) if refine == 1 else "1e-10"
        runs.append(Bounded(friction_corpus.Run(program, folders[-1], "run", ["Output/Error Bound=true", "Outer Solver/Tolerance=" + tolerance], LIMIT)))
    kind, remark, ratio = judge(*runs)
    coarse = runs[0].run.summary
    result = {"seed": seed, "family": scene.family, "cell": scene.cell, "class": kind, "remark": remark, "ratio": ratio, "ranks": ranks,
              "flaws": scene.flaws, "dofs": coarse.get("dofs"), "bound": coarse.get("bound"), "tolerance": scene.tolerance,
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
        for kind in ("holds", "estimate"):
            ratios = [(r["ratio"], r["seed"]) for r in results if r["cell"] == cell and r["class"] == kind and r["ratio"]]
            if ratios:
                lines.append("  %s, %s: bound over error against the finer mesh: least %.3f (seed %d), median %.2f, largest %.2f (seed %d), of %d"
                             % (cell, "strict" if kind == "holds" else kind, *min(ratios), statistics.median(x for x, _ in ratios), *max(ratios), len(ratios)))
    reasons = collections.Counter(kind_of(reason) for r in results if r["class"] in ("estimate", "not computed") for reason in (r["bound"] or {}).get("reasons", []))
    return lines + ["  %d estimates: %s" % (count, reason) for reason, count in reasons.most_common()]


def main():
    results = []
    parser = corpus_runs.parser(__doc__)
    parser.add_argument("--tolerance", help="of the solver on the coarse meshes, or Automatic, instead of that of each scene")
    for result in corpus_runs.results(parser.parse_args(), play):
        results.append(result)
        if result["class"] in FAILED:
            print("%(seed)d %(family)s %(cell)s: %(class)s: %(remark)s" % result, flush=True)
    print("\n".join(table(results)))
    solved = [r for r in results if r["class"] in ("holds", "holds, no error", "estimate", "not computed")]
    strict = sum(r["class"].startswith("holds") for r in solved)
    few = strict < LEAST_STRICT * len(solved) or not solved
    if few:
        print("only %d of %d bounds are strict" % (strict, len(solved)))
    return 1 if few or any(r["class"] in FAILED for r in results) else 0


if __name__ == "__main__":
    sys.exit(main())
