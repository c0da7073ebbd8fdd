"""Corpus of random scenes with friction: compares the default solver with Monolithic, the verdict and statics on each.

  friction_corpus.py --solve build/drivers/suture_solve --output out --count 40 --first 1
"""
import argparse
import collections
import concurrent.futures
import csv
import json
import os
import shutil
import statistics
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "drivers"))
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import check_run  # noqa: E402
import friction_scenes  # noqa: E402

LIMIT = 60       # seconds of a run
SAME = 1e-5      # relative, of energies and forces of contacts
FEW = 10         # applications: below, their ratio is meaningless
SAME_PAIR = 1e-4  # forces of pairs, relative to the largest
REFUSED = ("no equilibrium", "push it there", "slides away")  # unless one of them is "an equilibrium need not exist"
FAILED = ("WRONG", "hang", "crash", "input", "default fails", "Monolithic fails", "both fail", "default breaks down",
          "refused, but has a solution", "solved, but has no solution")


class Run:
    def __init__(self, program, folder, name, more=(), limit=LIMIT):
        self.folder, self.summary, self.pairs = os.path.join(folder, name), {}, []
        shutil.rmtree(self.folder, ignore_errors=True)
        sets = [word for each in ["Output/Fields=false", *more] for word in ("--set", each)]
        self.text, code = check_run.run([*program, os.path.join(folder, "scene.xml"), "--output", self.folder, *sets], limit)
        self.code = "hang" if code is None else code
        try:
            with open(os.path.join(self.folder, "summary.json")) as file:
                self.summary = json.load(file)
            if self.code == 0:
                with open(os.path.join(self.folder, "contact.csv")) as file:
                    self.pairs = list(csv.DictReader(file))
        except (OSError, ValueError):
            pass

    @property
    def solved(self):
        return self.code == 0 and self.summary.get("verified") is True

    @property
    def failure(self):
        return self.summary.get("failure") or " ".join(self.text.split("\n")[-6:])

    @property
    def outer(self):
        return self.summary["outer"]

    def forces(self):
        """Force on side B of each pair, by contact and pair."""
        of = lambda row, name: float(row.get(name) or 0.0)
        return {(row["contact"], row["pair"]): tuple(of(row, "force") * of(row, "n" + c) + of(row, "t" + c) for c in "xyz")
                for row in self.pairs}


def apart(one, two, negligible):
    """Largest differences of two runs: energy, forces of contacts, forces of pairs; relative. `negligible`: force at round-off level."""
    size = max(abs(one.summary["energy"]), abs(two.summary["energy"]))
    energy = abs(one.summary["energy"] - two.summary["energy"]) / size if size > 0 else 0.0
    a, b = one.summary["contact"]["force"], two.summary["contact"]["force"]
    f, g = one.forces(), two.forces()
    largest = lambda all_: max((abs(x) for v in all_ for x in v), default=0.0)
    pair = max(largest(f.values()), largest(g.values()), negligible)
    pairs = max((abs(x - y) for k in f.keys() & g.keys() for x, y in zip(f[k], g[k])), default=0.0)
    total = max(largest(a.values()), largest(b.values()), pair)
    contacts = max((abs(x - y) for k in a for x, y in zip(a[k], b[k])), default=0.0)
    return energy, contacts / total, pairs / pair


def judge(scene, one, two):
    """Class of a scene from its run and Monolithic's, and a remark."""
    for run in (one, two):
        if run.code == "hang":
            return "hang", "of " + ("the default" if run is one else "Monolithic")
        if run.code in (2, 3) and not run.summary and "no equilibrium" not in run.text and "push it there" not in run.text:
            return "input", run.text[-600:]
        if run.code not in (0, 3, 4):
            return "crash", "%s: %s" % (run.code, run.text[-300:])
    if one.solved and two.solved:
        energy, contacts, pairs = apart(one, two, 1e-9 * scene.load * scene.stress * scene.length ** (scene.d - 1))
        remark = "energy %.1e, contacts %.1e, pairs %.1e" % (energy, contacts, pairs)
        contraction = max(run.outer.get("estimates", {}).get("contraction", 0.0) for run in (one, two))
        largest = max([c["law"].mu for c in scene.contacts] + [0.0])
        if energy > SAME or contacts > SAME or pairs > SAME_PAIR:
            jumps = any(c["law"].cohesion or c["law"].bound for c in scene.contacts) and any(
                run.summary["contact"]["active"] < run.summary["contact"]["pairs"] for run in (one, two))  # lost where a pair opens
            # The same displacements: a support also holds the node of a pair and may take any part of its force.
            shared = energy < SAME ** 2 and any(kind == "Bilateral" for _, kind, _, _ in scene.conditions)
            if contraction >= 1.0 or largest > 1.0 or jumps or shared:
                return "two solutions", remark + ", contraction %.2g, mu %.2g" % (contraction, largest)
            return "WRONG", remark + ", contraction %.2g, mu %.2g" % (contraction, largest)
        if scene.expected == "none":
            return "solved, but has no solution", scene.why
        return "solved", remark
    if one.solved:
        return "Monolithic fails", "%s: %s" % (two.code, two.failure)
    if two.solved:
        if two.summary["extremes"]["von_mises"]["value"] < 1e-9 * scene.load * scene.stress:
            return "no stress", one.failure  # pure rigid motion: only round-off remains to compare
        return "default fails", "%s: %s" % (one.code, one.failure)
    both = "%s | %s" % (one.failure, two.failure)
    refuses = [any(words in run.failure + run.text for words in REFUSED) for run in (one, two)]
    if scene.expected == "some" and any(refuses):
        return "refused, but has a solution", both
    if all(refuses):
        return "refused", one.failure
    if refuses[1]:
        return "default breaks down", one.failure  # where it should refuse
    unsettled = "not reached within" in one.failure and "found no states" in two.failure
    if unsettled and any(c["law"].cohesion or c["law"].bound for c in scene.contacts):
        return "law jumps", both  # cohesion is lost where a pair opens: a solution need not exist
    return "both fail", both


def play(program, output, seed, family=None, dimension=None, cost=True):
    scene = friction_scenes.scene(seed, family, dimension)
    folder = os.path.join(output, "s%d" % seed)
    scene.write(folder)
    one, two = Run([program], folder, "default"), Run([program], folder, "monolithic", ["Outer Solver/Type=Monolithic"])
    kind, remark = judge(scene, one, two)
    result = {"seed": seed, "family": scene.family, "dimension": scene.d, "cell": scene.cell, "expected": scene.expected,
              "title": scene.title, "class": kind, "remark": remark, "dofs": one.summary.get("dofs"),
              "subdomains": one.summary.get("subdomains"),
              "contraction": one.summary.get("outer", {}).get("estimates", {}).get("contraction"), "codes": [one.code, two.code]}
    if one.solved:
        result["cost"] = [one.outer["iterations"], one.outer["pcg_total"]]
    if cost and kind == "solved" and any(c["law"].kind in ("Coulomb", "Tresca") for c in scene.contacts):
        free = ["Contact/k%d/Law=Frictionless" % k for k, c in enumerate(scene.contacts) if c["law"].kind in ("Coulomb", "Tresca")]
        without = Run([program], folder, "frictionless", free)
        if without.solved:
            result["free"] = [without.outer["iterations"], without.outer["pcg_total"]]
            result["mu"] = max(c["law"].mu for c in scene.contacts)
    if kind not in FAILED:
        shutil.rmtree(folder)
    return result


def table(results):
    """Classes by family, and the costs."""
    classes = sorted({r["class"] for r in results}, key=lambda c: (c in FAILED, c))
    lines = ["family    scenes" + "".join("  %s" % c for c in classes)]
    for name in [f.__name__ for f, _ in friction_scenes.FAMILIES] + ["all"]:
        own = [r for r in results if name in (r["family"], "all")]
        if own:
            count = collections.Counter(r["class"] for r in own)
            lines.append("%-9s %6d" % (name, len(own)) + "".join("  %*d" % (len(c), count[c]) for c in classes))
    costs = [r for r in results if "free" in r and r["mu"] <= 1.0]
    if costs:
        steps = [r["cost"][0] - r["free"][0] for r in costs]
        ratios = [(r["cost"][1] / r["free"][1], r["seed"]) for r in costs if r["free"][1] >= FEW]
        lines.append("costs against the same scene without friction, mu <= 1, %d scenes: outer steps more: median %g, largest %d (seed %d)"
                     % (len(costs), statistics.median(steps), max(steps), costs[steps.index(max(steps))]["seed"]))
        if ratios:
            lines.append("  applications: median ratio %.2f, largest %.2f (seed %d), above 2: %d of %d; steps above 4 more: %d"
                         % (statistics.median(x for x, _ in ratios), *max(ratios), sum(x > 2 for x, _ in ratios), len(ratios),
                            sum(s > 4 for s in steps)))
    return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--solve", required=True)
    parser.add_argument("--output", required=True)
    parser.add_argument("--count", type=int, default=40)
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--seeds", type=int, nargs="*", help="these scenes only")
    parser.add_argument("--family")
    parser.add_argument("--dimension", type=int)
    parser.add_argument("--workers", type=int, default=1)
    parser.add_argument("--no-costs", action="store_true")
    options = parser.parse_args()
    os.makedirs(options.output, exist_ok=True)
    results = []
    with concurrent.futures.ThreadPoolExecutor(options.workers) as pool:
        jobs = [pool.submit(play, options.solve, options.output, seed, options.family, options.dimension, not options.no_costs)
                for seed in options.seeds or range(options.first, options.first + options.count)]
        with open(os.path.join(options.output, "results.jsonl"), "w") as file:
            for job in jobs:
                result = job.result()
                results.append(result)
                file.write(json.dumps(result) + "\n")
                file.flush()
                if result["class"] in FAILED or result["class"] == "two solutions":
                    print("{class}: {title}, {dimension}D {cell}, {dofs} unknowns, {subdomains} subdomains, {expected}: {remark}"
                          .format(**result), flush=True)
    print("\n".join(table(results)))
    return 1 if any(r["class"] in FAILED for r in results) else 0


if __name__ == "__main__":
    sys.exit(main())
