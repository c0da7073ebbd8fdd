"""Random scenes with friction on several numbers of ranks: the same exit code and solution, no bug (70), no hang. Every second scene has one
subdomain per body, so that some ranks have no subdomain. With the library of test/mpi, as in the tests, it also shows where ranks call
different collectives.

  friction_ranks.py --solve build/drivers/suture_solve --output out --count 40 --first 1 --mpirun "mpirun --oversubscribe"
"""
import collections
import os
import shutil
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import corpus_runs  # noqa: E402
import friction_corpus  # noqa: E402
import friction_scenes  # noqa: E402

RANKS = (1, 2, 3, 5)
ENDS = (0, 3, 4)  # exit codes of sound runs


def several(run):
    """True if the scene may have several solutions, so that runs may differ."""
    return run.summary["outer"].get("estimates", {}).get("contraction", 0.0) >= 1.0


def judge(scene, runs):
    """Class of the runs of a scene, by number of ranks, and a remark."""
    codes = {ranks: run.code for ranks, run in runs.items()}
    if "hang" in codes.values():
        return "hang", str(codes)
    if bad := [ranks for ranks, code in codes.items() if code not in ENDS]:
        return "bug", "%s: %s" % (codes, runs[bad[0]].text[-2500:])
    if len(set(codes.values())) > 1:
        return "exit codes differ", "%s: %s" % (codes, " | ".join(runs[ranks].failure[:200] for ranks, code in codes.items() if code != 0))
    solved = [run for run in runs.values() if run.solved]
    if not solved:
        return "not solved", codes[1]
    negligible = 1e-9 * scene.load * scene.stress * scene.length ** (scene.d - 1)
    energy, contacts, pairs = (max(values) for values in zip(*(friction_corpus.apart(solved[0], other, negligible) for other in solved[1:])))
    remark = "energy %.1e, contacts %.1e, pairs %.1e" % (energy, contacts, pairs)
    if energy > friction_corpus.SAME or contacts > friction_corpus.SAME:
        return ("two solutions" if any(map(several, solved)) else "answers differ"), remark
    return "same", remark


def play(options, seed):
    scene = friction_scenes.scene(seed, options.family, options.dimension)
    folder = os.path.join(options.output, "s%d" % seed)
    scene.write(folder)
    more = ["Partition/METIS/Subdomains=%d" % len(scene.bodies)] if seed % 2 else []
    runs = {}
    for ranks in options.ranks:
        program = [*(options.mpirun.split() + ["-np", str(ranks)] if ranks > 1 else []), options.solve]
        runs[ranks] = friction_corpus.Run(program, folder, "ranks%d" % ranks, more)
    kind, remark = judge(scene, runs)
    result = {"seed": seed, "family": scene.family, "dimension": scene.d, "cell": scene.cell, "class": kind, "remark": remark,
              "codes": {str(ranks): run.code for ranks, run in runs.items()},
              "outer": {str(ranks): run.summary.get("outer", {}).get("iterations") for ranks, run in runs.items()},
              "subdomains": next((run.summary["subdomains"] for run in runs.values() if "subdomains" in run.summary), None)}
    if kind in ("same", "not solved", "two solutions"):
        shutil.rmtree(folder)
    return result


def main():
    parser = corpus_runs.parser(__doc__)
    parser.add_argument("--ranks", type=int, nargs="*", default=RANKS)
    results = []
    for result in corpus_runs.results(parser.parse_args(), play):
        results.append(result)
        print("{seed} {family} {dimension}D {cell}, {subdomains} subdomains: {class}, outer {outer}, {remark}".format(**result), flush=True)
    classes = collections.Counter(result["class"] for result in results)
    print(", ".join("%d %s" % (count, kind) for kind, count in classes.most_common()))
    return 1 if any(kind not in ("same", "not solved", "two solutions") for kind in classes) else 0


if __name__ == "__main__":
    sys.exit(main())
