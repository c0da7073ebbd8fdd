#!/usr/bin/python3
"""Benchmarks: Suture on one and two ranks beside the monolithic reference, in one run and in alternation. README.md explains the figures.

    test/bench/bench.py                                     scenes tunnel and hertz at 10k, 100k and 1M unknowns, five repetitions
    test/bench/bench.py --sizes 10k 100k --scenes tunnel    some of them (there are 60k and 4M, too)
    test/bench/bench.py --check-only                        the figures of the last run again, nothing is run
    test/bench/bench.py --guard test/bench/baseline.json    compare counts, not seconds; returns 1 when one has grown
    test/bench/bench.py --guard test/bench/baseline.json --write-baseline

Results go to build/bench/: bench.json, bench.md, the meshes and the last output of every run. Returns 1 when a run failed or the energies
of one scene and size differ by more than 1e-7; times are never a reason.
"""
import argparse
import datetime
import json
import os
import re
import shutil
import statistics
import subprocess
import sys
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent

# The model scenes that have a geometry, and what refines it.
GEOMETRY = {"tunnel": ("input/tunnel/tunnel_metis.xml", "scale"), "hertz": ("input/hertz/hertz.xml", "resolution")}
# Subdomains of about 1830 unknowns in every size.
SIZES = {
    "10k": {"tunnel": 1.0, "hertz": 26, "subdomains": 6},
    "60k": {"tunnel": 0.4, "hertz": 79, "subdomains": 34},
    "100k": {"tunnel": 0.316, "hertz": 101, "subdomains": 52},
    "1M": {"tunnel": 0.1, "hertz": 336, "subdomains": 512},
    "4M": {"tunnel": 0.05, "hertz": 680, "subdomains": 2048},
}
DEFAULT_SIZES = ["10k", "100k", "1M"]
SAME_ENERGY = 1e-7
QUIET = 0.1  # cores that others may use

# Figures of the issue: what, sizes, quantity of the comparison, floor (-: at most), aim.
FIGURES = [
    ("all phases against the reference", ["1M"], "all_phases", 2.0, 3.0),
    ("from assembled matrices against the reference", ["1M"], "from_assembled", 3.0, 5.0),
    ("memory over all ranks against the reference", ["1M"], "memory", -0.8, -0.5),
    ("bonded problem, seconds", ["1M"], "bonded_seconds", -2.0, -1.3),
    ("all phases against the reference", ["100k"], "all_phases", 1.5, None),
    ("all phases against the reference", ["10k"], "all_phases", 1 / 1.5, None),
    ("two ranks against one", ["1M"], "two_ranks", 1.7, None),
    ("from assembled matrices against the reference", ["4M"], "from_assembled", 4.0, None),
    ("memory over all ranks, GiB", ["4M"], "memory_gib", -20.0, None),
]
GROWTH = -1.3

GUARD_SIZES = ["10k", "100k"]
GUARD_COUNT = 2
GUARD_INSTRUCTIONS = 1.05


def fail(message):
    sys.exit(f"bench.py: {message}")


def environment(threads=1):
    """One thread of OpenBLAS a rank unless told otherwise, whatever the caller's environment says."""
    fixed = {"OPENBLAS_NUM_THREADS": str(threads), "OMP_NUM_THREADS": "1"}
    return {**os.environ, **fixed, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}


def execute(command, threads=1, expected=(0,)):
    done = subprocess.run(command, env=environment(threads), stdin=subprocess.DEVNULL, capture_output=True, text=True)
    if done.returncode not in expected:
        fail(f"exit code {done.returncode} of: {' '.join(command)}\n{done.stdout[-2000:]}{done.stderr[-4000:]}")
    return done.stdout + done.stderr


# Meshes


def mesh_of(scene, size, options):
    source, constant = GEOMETRY[scene]
    value = SIZES[size][scene]
    mesh = options.output / "meshes" / f"{scene}_{constant}{value:g}.h5"
    geometry = (ROOT / source).parent.glob("*.geo")
    if mesh.exists() and all(mesh.stat().st_mtime > file.stat().st_mtime for file in geometry):
        return mesh
    mesh.parent.mkdir(parents=True, exist_ok=True)
    unfinished = mesh.with_name(f"unfinished_{mesh.name}")
    text = execute([str(options.programs / "suture_partition"), "--no-cut", str(ROOT / source), "--output", str(unfinished),
                    "--set", f"Mesh/Constants/{constant}={value}"])
    unfinished.rename(mesh)
    print(f"meshed {text.strip().replace(str(unfinished), str(mesh))}", flush=True)
    return mesh


# Runs


def orderings(options):
    """Of the reference's only factorisation, if it lets one choose."""
    text = execute([str(options.programs / "suture_schema")])
    part = re.search(r"^    Monolithic/.*\n((?:      .*\n)*)", text, flags=re.M)
    found = re.search(r"^      Ordering  \(.*", part.group(1), flags=re.M) if part else None
    return [name for name in ("AMD", "METIS") if found and name in found.group(0)]


def configurations(options):
    """By name: ranks, threads of OpenBLAS, what is set beside mesh and subdomains."""
    runs = {f"suture_{ranks}": {"ranks": ranks, "threads": 1, "set": []} for ranks in (1, 2)}
    # Linear, all pairs closed, to the tolerance of the whole: ends, not converged, where contact would begin.
    for name, tolerance in (("bonded_2", "1e-8"), ("bonded_loose_2", "0.5")):
        bonded = ["Outer Solver/Maximum Iterations=0", f"Outer Solver/Active Set/Inner Tolerance={tolerance}"]
        runs[name] = {"ranks": 2, "threads": 1, "set": bonded, "expected": (0, 4)}
    if options.implicit:
        runs["implicit_2"] = {"ranks": 2, "threads": 1, "set": ["Subdomain/Schur Complement=Implicit"]}
    for threads in (1, 2):
        for ordering in orderings(options) or [None]:
            name = f"reference_{threads}" + (f"_{ordering.lower()}" if ordering else "")
            chosen = [f"Outer Solver/Monolithic/Ordering={ordering}"] if ordering else []
            runs[name] = {"ranks": 1, "threads": threads, "set": ["Outer Solver/Type=Monolithic", "Partition/METIS/Subdomains=2"] + chosen}
    return runs


def command_of(run, scene, size, mesh, folder, options):
    settings = [f"Mesh/File={mesh}", f"Partition/METIS/Subdomains={SIZES[size]['subdomains']}"]
    named = {text.split("=")[0] for text in run["set"]}
    settings = [text for text in settings if text.split("=")[0] not in named] + run["set"]
    command = ["mpirun", "--oversubscribe", "-np", str(run["ranks"])] if run["ranks"] > 1 else []
    command += [str(options.programs / "suture_solve"), str(HERE / f"{scene}.xml"), "--output", str(folder)]
    for text in settings:
        command += ["--set", text]
    return command


def busy_seconds():
    """Of all cores, whoever used them."""
    user, nice, system, _, _, irq, softirq, steal = (int(word) for word in Path("/proc/stat").read_text().split("\n")[0].split()[1:9])
    return (user + nice + system + irq + softirq + steal) / os.sysconf("SC_CLK_TCK")


def measure(name, run, scene, size, mesh, options):
    folder = options.output / "runs" / f"{scene}_{size}_{name}"
    shutil.rmtree(folder, ignore_errors=True)
    command = command_of(run, scene, size, mesh, folder, options)
    begin, before, own = time.monotonic(), busy_seconds(), sum(os.times()[2:4])
    execute(command, run["threads"], run.get("expected", (0,)))
    wall, busy, own = time.monotonic() - begin, busy_seconds() - before, sum(os.times()[2:4]) - own
    summary = json.loads((folder / "summary.json").read_text())
    phases = {phase: seconds["max"] for phase, seconds in summary["phases"].items()}
    result = {
        "wall": wall,
        "cpu_seconds": own,
        "cores_of_others": max(0.0, busy - own) / wall,
        "seconds": summary["seconds"],
        "phases": phases,
        "from_assembled": phases["factor"] + phases["solve"],
        "memory_mb": summary["peak_memory_mb"]["sum"],
        "memory_rank_mb": summary["peak_memory_mb"]["max"],
        "energy": summary["energy"],
        "unknowns": summary["dofs"],
        "elements": summary["elements"],
        "pairs": summary["contact"]["pairs"],
        "counts": {
            "outer": summary["outer"]["iterations"],
            "pcg": summary["outer"]["pcg_total"],
            "auxiliary": summary["auxiliary"]["iterations"],
        },
        "versions": summary["versions"],
        "command": " ".join(f'"{word}"' if " " in word else word for word in command),
    }
    if name.startswith("reference"):
        # Not charged for cutting a mesh that need not be cut (README.md, "In good faith").
        result["lean_seconds"] = result["seconds"] - phases["partition"]
        result["lean_from_assembled"] = result["from_assembled"]
    return result


# Medians and ratios


def spread(values):
    return {"median": statistics.median(values), "min": min(values), "max": max(values)}


def merged(results, run):
    first = results[0]
    text = ("unknowns", "elements", "pairs", "counts", "energy", "command")
    figures = [key for key in first if key not in text + ("phases", "versions")]
    whole = {key: first[key] for key in text}
    whole["threads"] = run["threads"]
    whole.update({key: spread([result[key] for result in results]) for key in figures})
    whole["phases"] = {phase: spread([result["phases"][phase] for result in results]) for phase in first["phases"]}
    return whole


def seconds_of_an_iteration(loose, tight):
    """Bonded runs to two tolerances differ in iterations only. None when they do not, or when the noise is larger."""
    iterations = tight[0]["counts"]["auxiliary"] - loose[0]["counts"]["auxiliary"]
    if iterations < 5:
        return None
    seconds = spread([(b["phases"]["solve"] - a["phases"]["solve"]) / iterations for a, b in zip(loose, tight)])
    return {**seconds, "iterations": iterations} if seconds["min"] > 0 else None


def ratio(above, below, medians):
    """Of medians; the spread is that of the repetitions, each with its own neighbours in time."""
    each = [a / b for a, b in zip(above, below)]
    return {"ratio": medians[0] / medians[1], "min": min(each), "max": max(each)}


def compared(results, runs):
    """All ratios of one scene and size. `results`: by name, the repetitions."""
    def ratio_of(name_above, key_above, name_below, key_below):
        above, below = [r[key_above] for r in results[name_above]], [r[key_below] for r in results[name_below]]
        return ratio(above, below, (statistics.median(above), statistics.median(below)))

    references = [name for name in runs if name.startswith("reference")]
    best = min(references, key=lambda name: statistics.median(r["lean_seconds"] for r in results[name]))
    ratios = {
        "reference": best,
        "all_phases": ratio_of(best, "lean_seconds", "suture_2", "seconds"),
        "from_assembled": ratio_of(best, "lean_from_assembled", "suture_2", "from_assembled"),
        "memory": ratio_of("suture_2", "memory_mb", best, "memory_mb"),
        "two_ranks": ratio_of("suture_1", "seconds", "suture_2", "seconds"),
        "two_ranks_from_assembled": ratio_of("suture_1", "from_assembled", "suture_2", "from_assembled"),
        "one_rank_all_phases": ratio_of(best, "lean_seconds", "suture_1", "seconds"),
        "one_rank_from_assembled": ratio_of(best, "lean_from_assembled", "suture_1", "from_assembled"),
        "all_phases_as_run": ratio_of(best, "seconds", "suture_2", "seconds"),
        "from_assembled_as_run": ratio_of(best, "from_assembled", "suture_2", "from_assembled"),
    }
    if "implicit_2" in results:
        ratios["explicit_gain"] = ratio_of("implicit_2", "from_assembled", "suture_2", "from_assembled")
    bonded = [r["from_assembled"] for r in results["bonded_2"]]
    memory = [r["memory_mb"] / 1024 for r in results["suture_2"]]
    ratios["bonded_seconds"] = {"ratio": statistics.median(bonded), "min": min(bonded), "max": max(bonded)}
    ratios["memory_gib"] = {"ratio": statistics.median(memory), "min": min(memory), "max": max(memory)}
    return ratios


def growth(cases):
    """Time per unknown on two ranks, from about 60k (100k where that was not run) to the largest size up to 1M."""
    found = {}
    for scene in GEOMETRY:
        sizes = [size for size in ("60k", "100k", "1M") if f"{scene}/{size}" in cases]
        if len(sizes) < 2 or sizes[-1] != "1M":
            continue
        times = {}
        for size in (sizes[0], "1M"):
            run = cases[f"{scene}/{size}"]["runs"]["suture_2"]
            times[size] = {key: run[key]["median"] / run["unknowns"] for key in ("seconds", "from_assembled")}
        found[scene] = {"from": sizes[0], "to": "1M", "ratio": times["1M"]["seconds"] / times[sizes[0]]["seconds"],
                        "from_assembled": times["1M"]["from_assembled"] / times[sizes[0]]["from_assembled"]}
    return found


def disagreement(results):
    energies = {name: result["energy"] for name, repetitions in results.items() if not name.startswith("bonded") for result in repetitions}
    largest = max(abs(energy) for energy in energies.values())
    return (max(energies.values()) - min(energies.values())) / largest if largest > 0 else 0.0


# The machine


def triad(barrier, queue, entries):
    import numpy
    b, c, a = numpy.full(entries, 1.0), numpy.full(entries, 2.0), numpy.zeros(entries)
    numpy.dot(b[:1000], c[:1000])
    best = {"triad": 0.0, "read": 0.0}
    for _ in range(5):
        barrier.wait()
        begin = time.perf_counter()
        numpy.multiply(c, 3.0, out=a)  # one read, one write
        numpy.add(a, b, out=a)         # two reads, one write
        best["triad"] = max(best["triad"], 5 * 8 * entries / (time.perf_counter() - begin) / 1e9)
        barrier.wait()
        begin = time.perf_counter()
        numpy.dot(b, c)                # two reads
        best["read"] = max(best["read"], 2 * 8 * entries / (time.perf_counter() - begin) / 1e9)
    queue.put(best)


def bandwidth(processes, entries=20_000_000):
    """GB/s of all processes at once, the best of five."""
    import multiprocessing
    os.environ.update({"OPENBLAS_NUM_THREADS": "1"})  # before numpy is loaded
    context = multiprocessing.get_context("spawn")
    barrier, queue = context.Barrier(processes), context.Queue()
    workers = [context.Process(target=triad, args=(barrier, queue, entries)) for _ in range(processes)]
    for worker in workers:
        worker.start()
    results = [queue.get(timeout=300) for _ in workers]
    for worker in workers:
        worker.join()
    return {key: sum(result[key] for result in results) for key in results[0]}


def machine():
    cpu = re.search(r"model name\s*:\s*(.*)", Path("/proc/cpuinfo").read_text())
    memory = re.search(r"MemTotal:\s*(\d+)", Path("/proc/meminfo").read_text())
    return {"cores": len(os.sched_getaffinity(0)), "cpu": cpu.group(1) if cpu else "unknown", "memory_gib": int(memory.group(1)) / 2**20,
            "date": datetime.date.today().isoformat(), "load_before": os.getloadavg()[0]}


# Tables


def shown(quantity, digits=2):
    return f"{quantity['median']:.{digits}f} ({quantity['min']:.{digits}f}-{quantity['max']:.{digits}f})"


def ranged(quantity):
    return f"{quantity['ratio']:.2f} ({quantity['min']:.2f}-{quantity['max']:.2f})"


def table(rows, markdown):
    width = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    lines = [" | ".join(cell.ljust(width[0]) if i == 0 else cell.rjust(width[i]) for i, cell in enumerate(row)) for row in rows]
    if not markdown:
        return "\n".join(line.replace(" | ", "   ") for line in lines)
    rules = [":" + "-" * width[0]] + ["-" * n + ":" for n in width[1:]]
    lines.insert(1, "|".join(f"{rule[:-1]}-{rule[-1]}" if i else f"{rule}-" for i, rule in enumerate(rules)))
    return "\n".join(f"|{line}|" if i == 1 else f"| {line} |" for i, line in enumerate(lines))


def tables(bench, markdown):
    phases = ["read", "partition", "assemble", "factor", "solve", "write"]
    times = [["scene, unknowns, run", *phases, "all phases", "factor + solve", "MB, all ranks", "outer, PCG"]]
    columns = ["all_phases", "from_assembled", "memory", "two_ranks", "all_phases_as_run", "from_assembled_as_run"]
    ratios = [["scene, unknowns", "reference taken", *[column.replace("_", " ") for column in columns]]]
    for name, case in bench["cases"].items():
        for run_name, run in case["runs"].items():
            counts = run["counts"]
            times.append([f"{name.split('/')[0]}, {run['unknowns']:,}, {run_name}", *[f"{run['phases'][p]['median']:.2f}" for p in phases],
                          shown(run["seconds"]), shown(run["from_assembled"]), f"{run['memory_mb']['median']:.0f}",
                          f"{counts['outer']}, {counts['auxiliary']} + {counts['pcg']}"])
        ratio_of = case["ratios"]
        ratios.append([f"{name.split('/')[0]}, {case['runs']['suture_2']['unknowns']:,}", ratio_of["reference"],
                       *[ranged(ratio_of[key]) for key in columns]])
    return table(times, markdown) + "\n\n" + table(ratios, markdown)


def figures(bench):
    """One line for each figure of the issue."""
    lines = []

    def judge(what, value, floor, aim):
        reached = value <= -floor if floor < 0 else value >= floor
        word = "at most" if floor < 0 else "at least"
        text = f"{'reached' if reached else 'MISSED '}  {what}: {value:.2f}, {word} {abs(floor):.2f}"
        if not reached:
            text += f"; {max(value / abs(floor), abs(floor) / value):.2f} times off"
        if aim is not None:
            attained = value <= -aim if aim < 0 else value >= aim
            text += f" (aim {abs(aim):.2f}{' reached' if attained else ''})"
        lines.append(text)

    missing = []
    for what, sizes, key, floor, aim in FIGURES:
        for size in sizes:
            cases = [name for name in bench["cases"] if name.endswith(f"/{size}")]
            for name in cases:
                judge(f"{name}, {what}", bench["cases"][name]["ratios"][key]["ratio"], floor, aim)
            if not cases:
                missing.append(f"{what} at {size}")
    for scene, found in bench["growth"].items():
        judge(f"{scene}, time per unknown, {found['to']} against {found['from']}", found["ratio"], GROWTH, None)
    if not bench["growth"]:
        missing.append("growth of the time per unknown (needs 1M and 60k or 100k)")
    if missing:
        lines.append("not measured in this run: " + "; ".join(missing))
    lines.append("not measured at all: a PCG iteration as a multiple of streaming its data (summary.json does not say how much data it is)")
    return "\n".join(lines)


# The guard


def counts_now(options):
    """Iterations of every scene on one and two ranks, and the elements they belong to."""
    runs = {name: run for name, run in configurations(options).items() if name.startswith("suture")}
    counts = {}
    for scene in options.scenes:
        for size in options.sizes:
            mesh = mesh_of(scene, size, options)
            for name, run in runs.items():
                result = measure(name, run, scene, size, mesh, options)
                counts[f"{scene}/{size}/{name}"] = {"elements": result["elements"], **result["counts"]}
    return counts


def instructions_now(options):
    """Instructions of one small run within solveScene (loading libraries would be half of all), by callgrind; None without valgrind."""
    if not shutil.which("valgrind"):
        return None
    mesh = mesh_of("tunnel", "10k", options)
    command = command_of({"ranks": 1, "set": []}, "tunnel", "10k", mesh, options.output / "runs" / "callgrind", options)
    os.environ["OPENBLAS_CORETYPE"] = "Haswell"  # the same kernels on every machine that has AVX2
    text = execute(["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", "--toggle-collect=suture::solveScene*", *command])
    del os.environ["OPENBLAS_CORETYPE"]
    found = re.search(r"Collected\s*:\s*(\d+)", text)
    return int(found.group(1)) if found and found.group(1) != "0" else fail(f"callgrind says no count:\n{text[-2000:]}")


def guard(options):
    path = Path(options.guard)
    now = {"counts": counts_now(options), "instructions": instructions_now(options)}
    if options.write_baseline:
        path.write_text(json.dumps(now, indent=2) + "\n")
        print(f"{path}: written")
        return 0
    if not path.exists():
        fail(f"no such baseline: {path}; --write-baseline makes it")
    before = json.loads(path.read_text())
    wrong = []
    for name, counts in now["counts"].items():
        old = before["counts"].get(name)
        if old is None:
            wrong.append(f"{name}: not in the baseline")
        elif old["elements"] != counts["elements"]:
            wrong.append(f"{name}: another mesh ({counts['elements']} elements, were {old['elements']}): renew the baseline")
        else:
            wrong += [f"{name}: {counts[key]} iterations ({key}), were {old[key]}" for key in counts
                      if key != "elements" and abs(counts[key] - old[key]) > GUARD_COUNT]
    old, new = before["instructions"], now["instructions"]
    if not (old and new):
        print("instructions: not compared, " + ("the baseline has none" if new else "there is no valgrind"))
    else:
        print(f"instructions: {new:,}, {new / old:.4f} of the baseline's")
        if new > GUARD_INSTRUCTIONS * old:
            wrong.append(f"instructions: {new / old:.3f} times the baseline's, at most {GUARD_INSTRUCTIONS}")
    print(f"{len(now['counts'])} runs compared, {len(wrong)} wrong")
    for line in wrong:
        print(f"  {line}")
    return 1 if wrong else 0


def benchmark(options):
    runs = configurations(options)
    bench = {"machine": machine(), "repetitions": options.repetitions, "versions": {}, "cases": {}}
    if bench["machine"]["load_before"] > 0.5:
        print(f"the machine is not quiet (load {bench['machine']['load_before']:.1f}): times and ratios will be off", flush=True)
    bench["bandwidth_gb_s"] = {"one process": bandwidth(1), "two processes": bandwidth(2)}
    differing = []
    for size in options.sizes:
        for scene in options.scenes:
            name, mesh = f"{scene}/{size}", mesh_of(scene, size, options)
            results = {run: [] for run in runs}
            for repetition in range(options.repetitions):
                order = list(runs)
                for run in order if repetition % 2 == 0 else reversed(order):
                    results[run].append(measure(run, runs[run], scene, size, mesh, options))
                print(f"{name}: repetition {repetition + 1} of {options.repetitions}: "
                      + ", ".join(f"{run} {results[run][-1]['seconds']:.2f} s" for run in order), flush=True)
            difference = disagreement(results)
            if difference > SAME_ENERGY:
                differing.append(f"{name}: energies differ by {difference:.1e}, at most {SAME_ENERGY:.0e}")
            bench["versions"] = results["suture_2"][0]["versions"]
            bench["cases"][name] = {"energy_difference": difference, "runs": {run: merged(results[run], runs[run]) for run in runs},
                                    "ratios": compared(results, runs)}
            iteration = seconds_of_an_iteration(results["bonded_loose_2"], results["bonded_2"])
            if iteration:
                bench["cases"][name]["pcg_iteration_seconds"] = iteration
            bench["growth"] = growth(bench["cases"])
            bench["machine"]["load_after"] = os.getloadavg()[0]
            (options.output / "bench.json").write_text(json.dumps(bench, indent=2) + "\n")  # after each: a long run may be stopped
    report(bench, options)
    for line in differing:
        print(line)
    return 1 if differing else 0


def report(bench, options):
    (options.output / "bench.md").write_text(tables(bench, True) + "\n")
    print(f"\n{tables(bench, False)}\n")
    one, two = bench["bandwidth_gb_s"]["one process"], bench["bandwidth_gb_s"]["two processes"]
    print(f"memory: triad {one['triad']:.1f} GB/s alone, {two['triad']:.1f} by two at once; reading {one['read']:.1f}, {two['read']:.1f}")
    for name, case in bench["cases"].items():
        others = statistics.median(run["cores_of_others"]["median"] for run in case["runs"].values())
        if others > QUIET:
            cores = bench["machine"]["cores"]
            print(f"{name}: others used {others:.1f} of {cores} cores meanwhile: ranks had less than a core each and waited for each other")
        iteration = case.get("pcg_iteration_seconds")
        if iteration:
            low, high = 1e3 * iteration["min"], 1e3 * iteration["max"]
            print(f"{name}: a PCG iteration on two ranks takes {1e3 * iteration['median']:.2f} ({low:.2f}-{high:.2f}) ms")
        else:
            print(f"{name}: the time of a PCG iteration drowns in the noise of this run")
    print(f"\n{figures(bench)}\n\n{options.output / 'bench.json'}, bench.md")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    defaults = f"default: {' '.join(DEFAULT_SIZES)}; of the guard: {' '.join(GUARD_SIZES)}"
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
    options.sizes = options.sizes or (GUARD_SIZES if options.guard else DEFAULT_SIZES)
    options.output, options.programs = options.output.resolve(), options.programs.resolve()
    if options.repetitions < 1:
        fail("--repetitions: expected at least 1")
    if options.write_baseline and not options.guard:
        fail("--write-baseline needs --guard FILE")
    if options.check_only:
        path = options.output / "bench.json"
        if not path.exists():
            fail(f"no such file: {path}; a run without --check-only makes it")
        report(json.loads(path.read_text()), options)
        return 0
    options.output.mkdir(parents=True, exist_ok=True)
    return guard(options) if options.guard else benchmark(options)


if __name__ == "__main__":
    sys.exit(main())
