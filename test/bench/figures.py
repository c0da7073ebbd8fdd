"""Medians and ratios of repetitions, and the figures that the report compares."""
import statistics

from runs import GEOMETRY, PLANE, PRESS, SIZES, is_bonded, is_reference

# Scenes, figure, size, compared quantity, required value and target (negative: upper limits).
FIGURES = [
    (PLANE, "all phases against the reference", "1M", "all_phases", 2.0, 3.0),
    (PLANE, "all phases against the reference, mesh cut beforehand", "1M", "all_phases_cut", 2.0, 3.0),
    (PLANE, "from assembled matrices against the reference", "1M", "from_assembled", 3.0, 5.0),
    (PLANE, "memory over all ranks against the reference", "1M", "memory", -0.8, -0.5),
    (PLANE, "bonded problem, seconds", "1M", "bonded_seconds", -2.0, -1.3),
    (PLANE, "a PCG iteration against reading its data", "1M", "iteration", -2.0, None),
    (PLANE, "all phases against the reference", "100k", "all_phases", 1.5, None),
    (PLANE, "all phases against the reference, mesh cut beforehand", "100k", "all_phases_cut", 1.5, None),
    (PLANE, "all phases against the reference", "10k", "all_phases", 1 / 1.5, None),
    (PLANE, "two ranks against one", "1M", "two_ranks", 1.7, None),
    (PLANE, "from assembled matrices against the reference", "4M", "from_assembled", 4.0, None),
    (PLANE, "memory over all ranks, GiB", "4M", "memory_gib", -20.0, None),
    (("press",), "all phases, seconds", "110k", "seconds", -4.0, -2.0),
    (("press",), "all phases, seconds", "360k", "seconds", -15.0, -8.0),
    (("press",), "all phases, seconds", "1M", "seconds", -40.0, -20.0),
    (("press",), "memory over all ranks, GiB", "1M", "memory_gib", -3.26, -1.86),  # 3.5 and 2 GB
    (("press",), "from assembled matrices against multigrid", "110k", "multigrid", 3.0, 6.0),
    (("press",), "from assembled matrices against multigrid", "360k", "multigrid", 3.0, 6.0),
    (("press",), "from assembled matrices against multigrid", "1M", "multigrid", 3.0, 6.0),
    (("press",), "all phases against the reference", "360k", "all_phases", 10.0, None),
    (("press",), "two ranks against one", "1M", "two_ranks", 1.7, None),
]
GROWTH = ("60k", "1M", -1.3)  # growth of the time per unknown


def spread(values):
    return {"median": statistics.median(values), "min": min(values), "max": max(values)}


def merged(results, run):
    """Combines the repetitions of one run: median, smallest and largest value of each figure."""
    first = results[0]
    text = ("unknowns", "elements", "pairs", "closed", "force", "counts", "energy", "command")
    figures = [key for key in first if key not in text + ("phases", "versions") and first[key] is not None]
    whole = {key: first[key] for key in text}
    whole["threads"] = run.get("threads", 1)
    whole.update({key: spread([result[key] for result in results]) for key in figures})
    whole["phases"] = {phase: spread([result["phases"][phase] for result in results]) for phase in first["phases"]}
    return whole


def fastest_reference(results):
    """The fastest by the median of all phases, among those repeated to the end; None if there is none."""
    if not any(is_reference(name) for name in results):
        return None
    longest = max(len(results[name]) for name in results if is_reference(name))
    best = [name for name in results if is_reference(name) and len(results[name]) == longest]
    return min(best, key=lambda name: statistics.median(result["charged"] for result in results[name]))


def compared(results, multigrid=()):
    """All ratios of one scene and size, with the spread over the repetitions, each computed from neighbouring runs. `multigrid`: PETSc's
    results in the same repetitions, if any."""
    def values(name, key):
        return [result[key] for result in results[name]]

    def ratio(key, above, below, times=1):
        above, below = values(above, key), values(below, key)
        each = [times * a / b for a, b in zip(above, below)]
        return {"ratio": times * statistics.median(above) / statistics.median(below), "min": min(each), "max": max(each)}

    best = fastest_reference(results)
    ratios = {
        "reference": best,
        "two_ranks": ratio("charged", "suture_1", "suture_2"),
        "two_copies": ratio("charged", "suture_1", "copies_1", times=2),
        "two_ranks_from_assembled": ratio("from_assembled", "suture_1", "suture_2"),
    }
    if best:
        ratios.update({
            "all_phases": ratio("charged", best, "suture_2"),
            "from_assembled": ratio("from_assembled", best, "suture_2"),
            "all_phases_cut": ratio("charged", best, "suture_cut_2"),
            "memory": ratio("memory_mb", "suture_2", best),
            "one_rank_all_phases": ratio("charged", best, "suture_1"),
            "one_rank_from_assembled": ratio("from_assembled", best, "suture_1"),
            "all_phases_as_run": ratio("seconds", best, "suture_2"),
        })
    if multigrid:
        below = values("suture_2", "from_assembled")
        each = [found["seconds"] / own for found, own in zip(multigrid, below)]
        ratios["multigrid"] = {"ratio": statistics.median(found["seconds"] for found in multigrid) / statistics.median(below),
                               "min": min(each), "max": max(each)}
    if "implicit_2" in results:
        ratios["explicit_gain"] = ratio("from_assembled", "implicit_2", "suture_2")
    return ratios


def iteration(runs, best):
    """Mean PCG iteration of the bonded problem on two ranks, and the time for two simultaneous processes to read its data once: at their
    median speed right after each run, and at their best speed (`best`, GB/s). None if there was no iteration."""
    if runs[0]["iteration_seconds"] is None:
        return None
    found = {"seconds": spread([run["iteration_seconds"] for run in runs]), "iterations": runs[0]["counts"]["auxiliary"]}
    if runs[0]["data_mb"] is not None:
        gigabytes = runs[0]["data_mb"] * 2**20 / 1e9
        found["data_mb"] = runs[0]["data_mb"]
        found["stream_seconds"] = spread([gigabytes / run["read_gb_s"] for run in runs])
        found["multiple"] = spread([run["iteration_seconds"] * run["read_gb_s"] / gigabytes for run in runs])
        found["multiple_of_best"] = found["seconds"]["median"] * best / gigabytes
    return found


def growth(cases):
    """Time per unknown on two ranks, larger size / smaller size."""
    small, large, _ = GROWTH
    found = {}
    for scene in GEOMETRY:
        if f"{scene}/{small}" in cases and f"{scene}/{large}" in cases:
            runs = [cases[f"{scene}/{size}"]["runs"]["suture_2"] for size in (small, large)]
            found[scene] = {key: runs[1][key]["median"] / runs[1]["unknowns"] / (runs[0][key]["median"] / runs[0]["unknowns"])
                            for key in ("seconds", "from_assembled")}
    return found


def disagreement(results):
    """Relative spread of the energies of all runs that solve the contact problem."""
    energies = [result["energy"] for name, repetitions in results.items() if not is_bonded(name) for result in repetitions]
    largest = max(map(abs, energies))
    return (max(energies) - min(energies)) / largest if largest > 0 else 0.0


def astray(scene, size, results, multigrid=()):
    """One line for each run of the scene press whose closed pairs or force are not the known ones."""
    if scene != "press":
        return []
    closed, force = PRESS[SIZES[size][scene]]
    found = [(name, result) for name, repetitions in results.items() if not is_bonded(name) for result in repetitions]
    found += [("multigrid", result) for result in multigrid]
    return [f"{scene}/{size}, {name}: {result['closed']} pairs closed, force {result['force']:.6e}; expected {closed}, {force:.6e}"
            for name, result in found if result["closed"] != closed or abs(result["force"] - force) > 1e-6 * force]


def quantity(case, key):
    """Value of a figure of FIGURES: a ratio of medians, or a median; None if the programs do not report it."""
    if key == "bonded_seconds":
        return case["runs"]["bonded_2"]["from_assembled"]["median"]
    if key == "seconds":
        return case["runs"]["suture_2"]["seconds"]["median"]
    if key == "iteration":
        return (case["pcg_iteration"] or {}).get("multiple", {}).get("median")
    if key == "memory_gib":
        return case["runs"]["suture_2"]["memory_mb"]["median"] / 1024
    return case["ratios"].get(key, {}).get("ratio")


def judged(what, value, floor, aim=None):
    """One line: reached or missed, and by how much."""
    def holds(bound):
        return value <= -bound if bound < 0 else value >= bound

    text = f"{'reached' if holds(floor) else 'MISSED '}  {what}: {value:.2f}, {'at most' if floor < 0 else 'at least'} {abs(floor):.2f}"
    if not holds(floor):
        text += f"; {max(value / abs(floor), abs(floor) / value):.2f} times off"
    if aim is not None:
        text += f" (aim {abs(aim):.2f}{' reached' if holds(aim) else ''})"
    return text


def verdict(bench):
    """One line for each figure that is compared."""
    lines, missing = [], []
    for scenes, what, size, key, floor, aim in FIGURES:
        found = {name: quantity(bench["cases"][name], key) for name in (f"{scene}/{size}" for scene in scenes) if name in bench["cases"]}
        found = {name: value for name, value in found.items() if value is not None}
        lines += [judged(f"{name}, {what}", value, floor, aim) for name, value in found.items()]
        if not found:
            missing.append(f"{what} at {size} ({', '.join(scenes)})")
    small, large, floor = GROWTH
    for scene, found in bench["growth"].items():
        lines.append(judged(f"{scene}, time per unknown, {large} against {small}", found["seconds"], floor))
    if not bench["growth"]:
        missing.append(f"time per unknown, {large} against {small}")
    if missing:
        lines.append("not measured in this run: " + "; ".join(missing))
    return "\n".join(lines)
