"""Random scenes of all kinds (wide_scenes.py) on one rank and on three, and by Monolithic: no hang, no bug, the same exit code, energy
and forces on any number of ranks. A scene that one solver cannot solve is lost: counted, but not a failure.

  wide_corpus.py --solve build/drivers/suture_solve --output out --count 40 --first 1 --mpirun "mpirun --oversubscribe"
"""
import collections
import os
import shutil
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import corpus_runs  # noqa: E402
import friction_corpus  # noqa: E402
import wide_scenes  # noqa: E402

LIMIT = 300   # seconds of a run: Monolithic takes 170 for seed 765
SAME = 1e-6   # relative: energy, forces of contacts and of pairs
ENDS = (0, 3, 4)
FAILED = ("hang", "bug", "exit codes differ", "WRONG")


def judge(scene, one, three, reference):
    """Class of a scene from its runs, and a remark."""
    runs = {"1 rank": one, "3 ranks": three, "Monolithic": reference}
    for name, run in runs.items():
        if run.code == "hang":
            return "hang", name
        if run.code not in ENDS:
            return "bug", "%s: %s: %s" % (name, run.code, run.text[-600:])
    if one.code != three.code:
        return "exit codes differ", "%s %s | %s %s" % (one.code, one.failure[:200], three.code, three.failure[:200])
    solved = [run for run in runs.values() if run.solved]
    if not solved:
        return ("refused" if one.code == 3 else "not determined" if "NOT DETERMINED" in one.text else "no solver"), one.failure[:200]
    negligible = 1e-9 * scene.load * scene.stress * scene.length ** (scene.d - 1)
    worst = [max(values) for values in zip(*(friction_corpus.apart(solved[0], run, negligible) for run in solved))]
    remark = "energy %.1e, contacts %.1e, pairs %.1e" % tuple(worst)
    if max(worst) > SAME:
        # A step that is not solved is halved; the solution with friction depends on the steps of the path.
        if len({tuple(step["time"] for step in (run.summary.get("load_steps") or {"steps": []})["steps"]) for run in solved}) > 1:
            return "other load steps", remark
        # Bounds without pressure are lost where a pair opens, and large coefficients allow several solutions.
        laws = [contact["law"] for contact in scene.contacts]
        opens = any(run.summary["contact"]["active"] < run.summary["contact"]["pairs"] for run in solved)
        several = (max(run.outer.get("estimates", {}).get("contraction", 0.0) for run in solved) >= 1.0 or max(law.mu for law in laws) > 1.0
                   or opens and any(law.cohesion or law.bound for law in laws))
        return ("two solutions" if several else "WRONG"), remark
    if not one.solved:
        return "default fails", "%s: %s" % (one.code, one.failure[:200])
    return ("solved" if reference.solved else "Monolithic fails"), remark


def play(options, seed):
    scene = wide_scenes.scene(seed, options.family, options.dimension)
    folder = os.path.join(options.output, "s%d" % seed)
    scene.write(folder)
    run = lambda name, ranks, more=(): friction_corpus.Run(
        [*(options.mpirun.split() + ["-np", str(ranks)] if ranks > 1 else []), options.solve], folder, name,
        ["Outer Solver/Tolerance=1e-10", *more], LIMIT)
    one, three = run("one", 1), run("three", 3)
    reference = run("monolithic", 1, ["Outer Solver/Type=Monolithic"])
    kind, remark = judge(scene, one, three, reference)
    result = {"seed": seed, "family": scene.family, "dimension": scene.d, "cell": scene.cell, "class": kind, "remark": remark,
              "outer": [each.summary.get("outer", {}).get("iterations") for each in (one, three, reference)],
              "shared": len(one.summary.get("undetermined_forces", []))}
    if kind in ("solved", "refused", "not determined"):
        shutil.rmtree(folder)
    return result


def main():
    counted = collections.Counter()
    for result in corpus_runs.results(corpus_runs.parser(__doc__).parse_args(), play):
        counted[result["class"]] += 1
        if result["class"] != "solved":
            print("%(seed)d %(family)s %(dimension)dD %(cell)s: %(class)s: %(remark)s" % result, flush=True)
    print(", ".join("%s %d" % each for each in sorted(counted.items())))
    return 1 if any(counted[kind] for kind in FAILED) else 0


if __name__ == "__main__":
    sys.exit(main())
