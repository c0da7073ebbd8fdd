"""Many subdomains on many ranks: iterations and messages do not grow with the number of subdomains or ranks.

scale.py --solve PROGRAM --count LIBRARY --mpirun "mpirun ..." --work DIR --input FOLDER [--long]

Iterations: a clamped square of 64 x 64 subdomains on 1, 4 and 8 ranks (--long: 1 to 32), and METIS subdomains of few elements. Messages: the
same square with 256 subdomains per rank on 4 and on 16 ranks, and two slabs with 64 subdomains and 128 pairs per rank on 2 and on 8 ranks,
counted by test/mpi/Count.cpp: each rank's own share is the same, so that messages which grow depend on all subdomains or all pairs. They must
be in the list KNOWN, and not be larger than it says.
"""
import argparse
import json
import pathlib
import re
import subprocess

from harness import SLOWER, arguments, check, finish, setting

parser = argparse.ArgumentParser()
parser.add_argument("--long", action="store_true")
options = arguments("--solve", "--count", "--input", parser=parser)
INPUT = pathlib.Path(options.input)
SQUARE, SLABS = INPUT / "linear_square" / "linear_square.xml", INPUT / "long_contact" / "long_contact.xml"
LEAST = 2.0  # bytes per subdomain or pair: a number has four

# Function that sends -> bytes per subdomain or pair that it may send, the point of issue 54 that removes the message, and
# what it contains. A function is found among the four innermost callers of a message.
KNOWN = {
    "findParts": (110, 5, "extents and neighbours of all subdomains, to find the parts of bodies"),
    "gatherCoarseElements": (1000, 4, "the last coarse level, gathered on all ranks"),
    "DirectCoarse::solve": (40, 4, "vectors of the last coarse level, summed over all ranks"),
    "numberSubdomainsAlongCurve": (36, 2, "centres of the subdomains to rank 0, numbers to all"),
    "expectedCosts": (14, 2, "sizes of the subdomains to rank 0"),
    "makePartition": (62, 5, "names, bodies, costs and ranks of all subdomains"),
    "gatherSubdomains": (140, 2, "the subdomain of each element to rank 0"),
    "shareBodies": (210, 2, "a whole body to the rank that cuts it"),
    "distribute": (640, 2, "subdomains from the rank that cut the body"),
    "gatherHolders": (22, 3, "holders of the nodes in contact to rank 0"),
    "Search::gather": (590, 3, "outlines of all bodies, to find overlaps"),
    "gatherPairs": (200, 3, "rows of all pairs on all ranks"),
    "takeOutRigidMotions": (320, 3, "rows of all pairs, for the motions of bodies"),
    "adopt": (125, 3, "pairs to rank 0, for the motions of bodies"),
    "pairResults": (200, 3, "results of all pairs to rank 0"),
    "broadcastPairs": (36, 3, "results of all pairs to all ranks"),
    "InterfaceRows::everywhere": (62, 3, "values of all pairs on all ranks"),
    "unionOverRanks": (8, 3, "numbers of the pairs that changed"),
    "ranksOfSubdomains": (5, 5, "the rank of each subdomain; runs of numbers make intervals possible"),
    "nodalForces": (105, 3, "forces of pairs for the verdict"),
    "verify": (460, 3, "names of subdomains and pairs for the verdict"),
    "verifyLift": (265, 3, "pairs for the verdict"),
    "writeNames": (40, 5, "names of all subdomains in the file of fields"),
    "findExtremes": (20, 5, "candidates of each rank"),
}

# Functions that only transport what others give them.
TRANSPORT = ("allGather", "broadcast", "broadcastBytes", "gatherOn", "gatherOnRoot", "joinEverywhere", "joinOnRoot", "receiveMemory", "scatterFromRoot",
             "sendMemory", "swapWithNeighbours")


def run(name, ranks, scene, words):
    """Summary of a run, and the counts of each rank."""
    folder = options.work / name
    count = ["-x", "LD_PRELOAD=" + options.count, "-x", f"SUTURE_TEST_COUNT={folder}.count"]
    done = subprocess.run([*options.mpirun.split(), *count, "-np", str(ranks), options.solve, str(scene), "--output", str(folder), "--quiet", *words],
                          capture_output=True, text=True, timeout=240 * SLOWER)
    check(f"{name}: exit code", (done.returncode, done.stderr), (0, ""))
    counts = [json.loads(pathlib.Path(f"{folder}.count.{rank}.json").read_text()) for rank in range(ranks)]
    return json.loads((folder / "summary.json").read_text()), counts


def box(name, **values):
    return [word for key, value in values.items() for word in setting(f"Mesh/Boxes/{name}/{key}", value)]


def square(blocks):
    return [*box("square", Blocks=f"{{{blocks}, {blocks}}}", Cells=f"{{{2 * blocks}, {2 * blocks}}}"),
            *setting("Preconditioner/BDDC/Coarse Level Above", 500)]


def slabs(ranks):
    size = {"Cells": f"{{{128 * ranks}, 8}}", "X": f"{{0, {16 * ranks}}}"}
    return [*box("upper", **size), *box("lower", **size), *setting("Partition/METIS/Subdomains", 64 * ranks), *setting("Outer Solver/Tolerance", "1e-6")]


def names(place):
    plain = [re.sub(r"<.*", "", re.sub(r"\[abi.*?\]", "", name)).split(" ")[-1].replace("suture::", "") for name in place]
    return [name for name in plain if name not in TRANSPORT and not name.startswith("Belos")]


def largest(counts):
    """(message or the collective, callers) -> bytes of the largest one of any rank."""
    sizes = {}
    for rank in counts:
        for count in rank["counts"]:
            kind = "message" if "send" in count["function"].lower() else count["function"]
            key = (kind, tuple(names(count["place"])[:4]))
            sizes[key] = max(sizes.get(key, 0.0), count["most"])
    return sizes


def known(callers):
    """The entry of KNOWN for the innermost caller that has one."""
    for caller in callers:
        for name in KNOWN:
            if caller == name or caller.endswith("::" + name):
                return name
    return None


def growing(few, many, more, what):
    """Checks the messages that grow by LEAST bytes or more per additional subdomain or pair, and at least to twice the size; their functions."""
    small, met = largest(few), set()
    for (kind, callers), size in sorted(largest(many).items(), key=lambda item: -item[1]):
        # The compiler may inline a caller further out in one run of the program and not in another: compare with the same two innermost ones.
        before = max([bytes for other, bytes in small.items() if other == (kind, callers)]
                     or [bytes for other, bytes in small.items() if other[0] == kind and other[1][:2] == callers[:2]] or [0.0])
        slope = (size - before) / more
        if slope < LEAST or size < 2.0 * before:
            continue
        name = known(callers)
        where = f"{kind} of {size:.0f} bytes in {' < '.join(callers)}"
        if name is None:
            check(f"{where}: grows by {slope:.1f} bytes per {what} and is not in the list", True, False)
            continue
        met.add(name)
        bound, point, reason = KNOWN[name]
        check(f"{where}: {slope:.1f} bytes per {what}, at most {bound} (54.{point}: {reason})", slope, lambda found: found <= bound)
    return met


def neighbours(counts):
    """Ranks to which a rank sends interface values, at most."""
    return max(count["peers"] for rank in counts for count in rank["counts"] if "InterfaceOperator::apply" in names(count["place"]))


# Iterations on one mesh. Before the numbers along a curve, each rank had columns of subdomains one block wide: 11 PCG on 8 ranks.
for ranks in (1, 2, 4, 8, 16, 32) if options.long else (1, 4, 8):
    summary, counts = run(f"square_{ranks}", ranks, SQUARE, square(64))
    check(f"{ranks} ranks: 6 PCG, one more or less", summary["auxiliary"]["iterations"], lambda found: 5 <= found <= 7)
    check(f"{ranks} ranks: no note on Chebyshev steps", [note for note in summary["notes"] if "Chebyshev" in note], [])
    if ranks > 1:
        check(f"{ranks} ranks: neighbours", neighbours(counts), lambda found: 1 <= found <= (8 if ranks <= 16 else 10))

# METIS subdomains of 16 to 43 squares: condition numbers of 68 to 90 where METIS may not exceed the mean by one element.
for subdomains in (600, 1100, 1200, 1600) if options.long else (1100, 1600):
    summary, _ = run(f"metis_{subdomains}", 1, SQUARE,
                     [*box("square", Cells="{160, 160}", Blocks="{1, 1}", Cell="Quadrilateral4"), *setting("Partition/Type", "METIS"),
                      *setting("Partition/METIS/Subdomains", subdomains), *setting("Preconditioner/BDDC/Coarse Level Above", 100000)])
    check(f"{subdomains} METIS subdomains: condition", summary["auxiliary"]["condition"], lambda found: 1.0 < found < 6.0)
    check(f"{subdomains} METIS subdomains: PCG", summary["auxiliary"]["iterations"], lambda found: found <= 14)

few, many = run("messages_4", 4, SQUARE, square(32)), run("messages_16", 16, SQUARE, square(64))
met = growing(few[1], many[1], 64 * 64 - 32 * 32, "subdomain")
peaks = sorted(rank["peak_kb"] for rank in many[1])
check("peak memory of rank 0 over the median", many[1][0]["peak_kb"] / peaks[len(peaks) // 2], lambda found: found <= 1.2)
few, many = run("contact_2", 2, SLABS, slabs(2)), run("contact_8", 8, SLABS, slabs(8))
met |= growing(few[1], many[1], 128 * (8 - 2), "pair")
check("the list names only messages that grow", sorted(set(KNOWN) - met), [])
finish()
