"""Random scenes of bodies that move far, in 2D and 3D, on one and on three ranks: blocks that slide, stacks, wedges, rocking blocks, rollers,
pins, cams. Each path is solved to its end, with the same forces on any number of ranks, and the forces and motions of statics and kinematics.

  moving_corpus.py --solve build/drivers/suture_solve --output out --count 40 --first 1 --mpirun "mpirun --oversubscribe" --family slide
"""
import collections
import os
import shlex
import subprocess
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import corpus_runs  # noqa: E402
import moving_scenes  # noqa: E402
from moving_run import MovingRun  # noqa: E402

LIMIT = 120  # seconds of a run
SAME = 1e-5  # forces on other numbers of ranks, relative to the largest one of the path


def problem_of(options, scene, folder, ranks, first):
    """Text of what is wrong, and the run."""
    output = os.path.join(folder, "out_%d" % ranks)
    command = [*(shlex.split(options.mpirun) + ["-np", str(ranks)] if ranks > 1 else []), options.solve, os.path.join(folder, "scene.xml"),
               "--output", output, "--set", "Output/Fields=false"]
    with open(os.path.join(folder, "log_%d.txt" % ranks), "w") as log:
        try:
            code = subprocess.run(command, stdout=log, stderr=subprocess.STDOUT, timeout=LIMIT).returncode
        except subprocess.TimeoutExpired:
            return "hang on %d ranks" % ranks, None
    if code != 0:
        with open(log.name) as file:
            said = [line.strip() for line in file if any(word in line for word in ("not converged", "errors in", "cannot", "Sorry", "suture_solve:"))]
        return "exit code %d on %d ranks: %s" % (code, ranks, (said or [""])[0]), None
    run = MovingRun(scene, output)
    if not run.summary.get("verified") or abs(run.times[-1] - scene.times[-1]) > 1e-9:
        return "the path ends at %s on %d ranks" % (run.times[-1:], ranks), run
    for check in scene.checks:
        said = check(run)
        if said:
            return said + " on %d ranks" % ranks, run
    for contact in scene.contacts if first else []:
        mine, other = run.force(contact["name"]), first.force(contact["name"])
        size = max(max(map(abs, first.force(contact["name"], k))) for k in first.steps)
        if max(abs(a - b) for a, b in zip(mine, other)) > SAME * size:
            return "forces %s of '%s' on %d ranks, %s on one" % (mine, contact["name"], ranks, other), run
    return "", run


def play(options, seed):
    scene = moving_scenes.scene(seed, options.family, options.dimension)
    folder = os.path.join(options.output, str(seed))
    scene.write(folder)
    first, problem, began = None, "", time.time()
    for ranks in (1, 3):
        problem, run = problem_of(options, scene, folder, ranks, first)
        if problem:
            break
        first = first or run
    return {"seed": seed, "family": scene.family, "dimension": scene.d, "title": scene.title, "seconds": round(time.time() - began, 2),
            "steps": len(first.rows) if first else 0, "given up": sum(int(row["given_up"]) for row in first.rows) if first else 0,
            "problem": problem}


def main():
    options = corpus_runs.parser(__doc__).parse_args()
    found = list(corpus_runs.results(options, play))
    bad = [one for one in found if one["problem"]]
    for one in bad:
        print("scene %d (%s, %dD): %s" % (one["seed"], one["family"], one["dimension"], one["problem"]))
    families = collections.Counter(one["family"] for one in found)
    print("; ".join("%s %d" % pair for pair in sorted(families.items())))
    print("%d scenes, %d in 3D, %d wrong" % (len(found), sum(one["dimension"] == 3 for one in found), len(bad)))
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
