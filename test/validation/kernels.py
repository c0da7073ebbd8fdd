"""Random scenes with OpenBLAS kernels for several processors: round-off must not decide whether a scene is solved.

  kernels.py --solve build/drivers/suture_solve --output out --seeds 97 977
  kernels.py --solve build/drivers/suture_solve --corpus build/bin/test_corpus --output out --count 200

OPENBLAS_CORETYPE selects the kernels; those that this processor cannot run are skipped. Each scene with friction must end with the same
exit code and, if solved, with the same energy and contact forces; each frictionless scene must pass the corpus' own check.
"""
import argparse
import concurrent.futures
import os
import shutil
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import friction_corpus  # noqa: E402
import friction_scenes  # noqa: E402

KERNELS = {"Prescott": {"pni"}, "Haswell": {"avx2", "fma"}, "Zen": {"avx2", "fma"}, "SkylakeX": {"avx512f", "avx512dq", "avx512bw", "avx512vl"}}


def flags():
    """Features of this processor; None if unknown."""
    try:
        with open("/proc/cpuinfo") as file:
            return next((set(line.split(":")[1].split()) for line in file if line.startswith("flags")), None)
    except OSError:
        return None


def runnable(have):
    return [name for name, needs in KERNELS.items() if have is not None and needs <= have]


def play(program, output, seed, kernels):
    """Differences between the kernels; empty if none."""
    scene = friction_scenes.scene(seed)
    folder = os.path.join(output, "s%d" % seed)
    scene.write(folder)
    runs = {kernel: friction_corpus.Run(["env", "OPENBLAS_CORETYPE=" + kernel, program], folder, kernel) for kernel in kernels}
    codes = {kernel: run.code for kernel, run in runs.items()}
    if len(set(codes.values())) > 1:
        return "exit codes differ: %s" % codes
    first, *others = runs.values()
    if first.solved:
        negligible = 1e-9 * scene.load * scene.stress * scene.length ** (scene.d - 1)
        for other, kernel in zip(others, kernels[1:]):
            if not other.solved:
                return "verified with %s only" % kernels[0]
            energy, contacts, _ = friction_corpus.apart(first, other, negligible)
            if energy > friction_corpus.SAME or contacts > friction_corpus.SAME:
                return "%s and %s differ: energy %.1e, contacts %.1e" % (kernels[0], kernel, energy, contacts)
    shutil.rmtree(folder)
    return ""


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--solve", required=True)
    parser.add_argument("--corpus", help="test_corpus: the frictionless scenes, too")
    parser.add_argument("--output", required=True)
    parser.add_argument("--count", type=int, default=0)
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--seeds", type=int, nargs="*", default=[])
    parser.add_argument("--workers", type=int, default=1)
    options = parser.parse_args()
    kernels = runnable(flags())
    print("kernels: " + (", ".join(kernels) or "none known for this processor"))
    failed = 0
    seeds = options.seeds or range(options.first, options.first + options.count)
    with concurrent.futures.ThreadPoolExecutor(options.workers) as pool:
        for seed, remark in zip(seeds, pool.map(lambda seed: play(options.solve, options.output, seed, kernels), seeds)):
            if remark:
                failed += 1
                print("friction %d: %s" % (seed, remark), flush=True)
    print("%d scenes with friction, %d differ" % (len(seeds), failed))
    for kernel in kernels if options.corpus else []:
        done = subprocess.run([options.corpus, "--count", "300"], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, env={**os.environ, "OPENBLAS_CORETYPE": kernel})
        print("frictionless, %s: exit code %d" % (kernel, done.returncode), flush=True)
        if done.returncode != 0:
            failed += 1
            print(done.stdout[:2000])
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
