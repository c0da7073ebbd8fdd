"""Tables and text from bench.json."""
import statistics

from figures import verdict

QUIET = 0.1  # cores that others may use
PHASES = ["read", "partition", "assemble", "factor", "solve", "write"]
RATIOS = ["all_phases", "all_phases_cut", "from_assembled", "memory", "two_ranks", "two_copies", "one_rank_all_phases", "one_rank_from_assembled",
          "all_phases_as_run", "multigrid"]


def shown(values, middle="median", scale=1.0):
    if values is None:
        return "-"
    return f"{scale * values[middle]:.2f} ({scale * values['min']:.2f}-{scale * values['max']:.2f})"


def table(rows, markdown):
    width = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    lines = [" | ".join(cell.ljust(width[0]) if i == 0 else cell.rjust(width[i]) for i, cell in enumerate(row)) for row in rows]
    if not markdown:
        return "\n".join(line.replace(" | ", "   ") for line in lines)
    rule = "|".join([":" + "-" * (width[0] + 1)] + ["-" * (n + 1) + ":" for n in width[1:]])
    return "\n".join(f"|{line}|" if line is rule else f"| {line} |" for line in [lines[0], rule, *lines[1:]])


def tables(bench, markdown):
    times = [["scene, unknowns, run", *PHASES, "all phases", "factor + solve", "MB, all ranks", "MB per rank", "outer, PCG"]]
    ratios = [["scene, unknowns", "reference taken", *[key.replace("_", " ") for key in RATIOS]]]
    for name, case in bench["cases"].items():
        scene = name.split("/")[0]
        for run_name, run in case["runs"].items():
            counts = run["counts"]
            times.append([f"{scene}, {run['unknowns']:,}, {run_name}", *[f"{run['phases'][phase]['median']:.2f}" for phase in PHASES],
                          shown(run["seconds"]), shown(run["from_assembled"]), f"{run['memory_mb']['median']:.0f}",
                          f"{run['memory_rank_mb']['median']:.0f}", f"{counts['outer']}, {counts['auxiliary']} + {counts['pcg']}"])
        ratios.append([f"{scene}, {case['runs']['suture_2']['unknowns']:,}", case["ratios"]["reference"] or "-",
                       *[shown(case["ratios"].get(key), "ratio") for key in RATIOS]])
    return table(times, markdown) + "\n\n" + table(ratios, markdown)


def iteration_line(name, found):
    if not found:
        return f"{name}: there was no PCG iteration"
    line = f"{name}: a PCG iteration on two ranks takes {shown(found['seconds'], scale=1e3)} ms"
    if "multiple" in found:
        line += f", {shown(found['multiple'])} times as long as reading its {found['data_mb']:.0f} MB once right afterwards"
        return line + f", {found['multiple_of_best']:.2f} times at the best speed"
    return line + "; summary.json does not report its amount of data"


def report(bench, options):
    """Prints everything and writes bench.md."""
    (options.output / "bench.md").write_text(tables(bench, True) + "\n")
    print(f"\n{tables(bench, False)}\n")
    one, two = bench["bandwidth_gb_s"]["one process"], bench["bandwidth_gb_s"]["two processes"]
    print(f"memory: triad {one['triad']:.1f} GB/s alone, {two['triad']:.1f} by two simultaneous processes; reading {one['read']:.1f}, {two['read']:.1f}")
    for name, case in bench["cases"].items():
        others = statistics.median(run["cores_of_others"]["median"] for run in case["runs"].values())
        if others > QUIET:
            cores = bench["machine"]["cores"]
            print(f"{name}: others used {others:.1f} of {cores} cores during the run: ranks had less than one core each and waited for each other")
        print(iteration_line(name, case["pcg_iteration"]))
        ranks, copies = (shown(case["ratios"][key], "ratio") for key in ("two_ranks", "two_copies"))
        print(f"{name}: two ranks are {ranks} times as fast as one; two simultaneous runs on one rank do {copies} times the work of one alone")
        for found in case.get("multigrid", []):
            print(f"{name}: multigrid takes {found['seconds']:.1f} s after {found['assembly_seconds']:.1f} s of assembly, "
                  f"{found['sets']} sets, {sum(found['iterations'])} CG, {found['peak_memory_mb']:.0f} MB")
        if "explicit_gain" in case["ratios"]:
            gain = shown(case["ratios"]["explicit_gain"], "ratio")
            print(f"{name}: from assembled matrices {gain} times as fast as with implicit Schur complements")
    for scene, found in bench["growth"].items():
        print(f"{scene}: time per unknown changes by a factor of {found['seconds']:.2f}, from assembled matrices {found['from_assembled']:.2f}")
    print(f"\n{verdict(bench)}\n\n{options.output / 'bench.json'}, bench.md")
