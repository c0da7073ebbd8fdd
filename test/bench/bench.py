#!/usr/bin/python3
"""Benchmarks: Suture on one and two ranks against the monolithic reference, run alternately. README.md explains the figures.

    test/bench/bench.py                                     scenes tunnel and hertz at 10k, 60k, 100k and 1M unknowns, press
                                                            at 30k, 110k, 360k and 1M, five repetitions
    test/bench/bench.py --sizes 10k 100k --scenes tunnel    a part (4M is available for the 2D scenes)
    test/bench/bench.py --check-only                        figures of the last run, without running
    test/bench/bench.py --guard test/bench/baseline.json    compare counts, not seconds; returns 1 if one has grown
    test/bench/bench.py --guard test/bench/baseline.json --write-baseline

Results go to build/bench/: bench.json, bench.md, the meshes and the last output of every run. Returns 1 if a run failed, the energies
of one scene and size differ by more than 1e-7, or the closed pairs or the force of press are wrong, independent of times. If PETSc is
installed (Debian: python3-petsc4py), its multigrid also solves press.
"""
import argparse
import importlib.util
import json
import os
import sys
from pathlib import Path

import guard
from figures import astray, compared, disagreement, fastest_reference, growth, iteration, merged
from machine import bandwidth, machine
from report import report
from runs import GEOMETRY, ROOT, SIZES, configurations, fail, has_mesh, is_bonded, is_reference, measure, mesh_of, multigrid

DEFAULT_SIZES = ["10k", "30k", "60k", "100k", "110k", "360k", "1M"]
SAME_ENERGY = 1e-7


def repeated(runs, scene, size, options):
    """Repetitions of all runs by name, every second one in reverse order to vary the neighbours in time; and those of multigrid."""
    mesh = mesh_of(scene, size, options)
    results, others = {name: [] for name in runs}, []
    for repetition in range(options.repetitions):
        if repetition == 1:  # only the fastest reference continues: references take most of the time
            best = fastest_reference(results)
            runs = {name: run for name, run in runs.items() if name == best or not is_reference(name)}
        for name in runs if repetition % 2 == 0 else reversed(runs):
            results[name].append(measure(name, runs[name], scene, size, mesh, options))
            if is_bonded(name):  # bandwidth reference for its iterations, on the same number of processes, right afterwards
                results[name][-1]["read_gb_s"] = bandwidth(runs[name]["ranks"])["read_median"]
        if scene == "press" and len(others) == repetition:
            others += filter(None, [multigrid(SIZES[size][scene], options)])
        print(f"{scene}/{size}: repetition {repetition + 1} of {options.repetitions}: "
              + ", ".join(f"{name} {results[name][-1]['seconds']:.2f} s" for name in runs)
              + (f", multigrid after assembly {others[-1]['seconds']:.2f} s" if len(others) > repetition else ""), flush=True)
    return results, others


def benchmark(options):
    bench = {"machine": machine(), "repetitions": options.repetitions, "versions": {}, "cases": {}, "growth": {}}
    if bench["machine"]["load_before"] > 0.5:
        print(f"the machine is busy (load {bench['machine']['load_before']:.1f}): times and ratios are unreliable", flush=True)
    bench["bandwidth_gb_s"] = {"one process": bandwidth(1), "two processes": bandwidth(2)}
    differing = []
    for size in options.sizes:
        for scene in (scene for scene in options.scenes if has_mesh(scene, size)):
            runs = configurations(scene, size, options.implicit)
            results, others = repeated(runs, scene, size, options)
            differing += astray(scene, size, results, others)
            difference = disagreement(results)
            if difference > SAME_ENERGY:
                differing.append(f"{scene}/{size}: energies differ by {difference:.1e}, at most {SAME_ENERGY:.0e}")
            bench["versions"] = results["suture_2"][0]["versions"]
            bench["cases"][f"{scene}/{size}"] = {
                "energy_difference": difference,
                "runs": {name: merged(results[name], runs[name]) for name in runs},
                "ratios": compared(results, others),
                "multigrid": others,
                "pcg_iteration": iteration(results["bonded_2"], bench["bandwidth_gb_s"]["two processes"]["read"]),
            }
            bench["growth"] = growth(bench["cases"])
            bench["machine"]["load_after"] = os.getloadavg()[0]
            (options.output / "bench.json").write_text(json.dumps(bench, indent=2) + "\n")  # after each: a long run may be stopped
    report(bench, options)
    for line in differing:
        print(line)
    return 1 if differing else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    defaults = f"default: {' '.join(DEFAULT_SIZES)}; of the guard: {' '.join(guard.SIZES)}"
    parser.add_argument("--sizes", nargs="+", choices=list(SIZES), help=defaults)
    parser.add_argument("--scenes", nargs="+", choices=list(GEOMETRY), default=list(GEOMETRY))
    parser.add_argument("--repetitions", type=int, default=5)
    parser.add_argument("--implicit", action="store_true", help="Suture with implicit Schur complements on two ranks, too")
    parser.add_argument("--programs", type=Path, default=ROOT / "build" / "drivers", help="folder of suture_solve and the others")
    parser.add_argument("--output", type=Path, default=ROOT / "build" / "bench")
    parser.add_argument("--check-only", action="store_true", help="tables and figures of the last run; nothing is run")
    parser.add_argument("--guard", metavar="BASELINE", help="compare counts with this file instead")
    parser.add_argument("--write-baseline", action="store_true", help="with --guard: write the file")
    options = parser.parse_args()
    options.sizes = options.sizes or (guard.SIZES if options.guard else DEFAULT_SIZES)
    options.output, options.programs = options.output.resolve(), options.programs.resolve()
    if options.repetitions < 1:
        fail("--repetitions: expected at least 1")
    if options.write_baseline and not options.guard:
        fail("--write-baseline needs --guard FILE")
    if not options.guard and not options.check_only and not importlib.util.find_spec("numpy"):  # otherwise workers die and the pool hangs
        fail(f"{sys.executable} has no numpy, which the bandwidth measurement needs; /usr/bin/python3 has it after bootstrap.sh")
    if options.check_only:
        path = options.output / "bench.json"
        if not path.exists():
            fail(f"no such file: {path}; create it by a run without --check-only")
        report(json.loads(path.read_text()), options)
        return 0
    options.output.mkdir(parents=True, exist_ok=True)
    return guard.guard(options) if options.guard else benchmark(options)


if __name__ == "__main__":
    sys.exit(main())
