"""Bounds of the energy error do not depend on the orientation of a scene: random scenes (bound_scenes.py), rotated by several angles.

  bound_rotations.py --solve build/drivers/suture_solve --output out --seeds 373 14
"""
import math
import os
import shutil
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import bound_scenes  # noqa: E402
import corpus_runs  # noqa: E402
import friction_builder  # noqa: E402
import friction_corpus  # noqa: E402

ANGLES = (0, 10, 60, 142, 200, 218)  # degrees
REFINE = 2
SAME = 0.01  # relative: the sweeps over the stars depend on round-off only, their number does not change


def rotated(seed, angle, family):
    """The scene of a seed, rotated by `angle` where its own angle is random."""
    a, own = math.radians(angle), friction_builder.rotation

    def rotation(random, dimension):
        own(random, dimension)  # the same random numbers
        return [[math.cos(a), -math.sin(a)], [math.sin(a), math.cos(a)]]
    friction_builder.rotation = rotation
    try:
        return bound_scenes.scene(seed, REFINE, family)
    finally:
        friction_builder.rotation = own


def play(options, seed):
    bounds = {}
    for angle in ANGLES:
        folder = os.path.join(options.output, "s%d_%d" % (seed, angle))
        rotated(seed, angle, options.family).write(folder)
        run = friction_corpus.Run([options.solve], folder, "run", ["Output/Error Bound=true", "Outer Solver/Tolerance=1e-13"])
        bounds[angle] = (run.summary.get("bound") or {}).get("relative") if run.solved else None
        shutil.rmtree(folder)
    known = [value for value in bounds.values() if value is not None]
    same = len(known) in (0, len(bounds)) and (not known or max(known) - min(known) <= SAME * max(known))
    return {"seed": seed, "same": same, "bounds": bounds}


def main():
    differ = 0
    for result in corpus_runs.results(corpus_runs.parser(__doc__).parse_args(), play):
        if not result["same"]:
            differ += 1
            print("%d: %s" % (result["seed"], {angle: value and float("%.4g" % value) for angle, value in result["bounds"].items()}), flush=True)
    print("%d scenes depend on their orientation" % differ)
    return 1 if differ else 0


if __name__ == "__main__":
    sys.exit(main())
