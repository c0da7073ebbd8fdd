"""Command line and results table of the corpora that run random scenes on several numbers of ranks."""
import argparse
import json
import os


def parser(doc):
    """Common options of these corpora; scenes are `seeds`, or `count` of them from `first` on."""
    made = argparse.ArgumentParser(description=doc.split("\n")[0])
    made.add_argument("--solve", required=True)
    made.add_argument("--output", required=True)
    made.add_argument("--mpirun", default="mpirun --oversubscribe")
    made.add_argument("--count", type=int, default=40)
    made.add_argument("--first", type=int, default=1)
    made.add_argument("--seeds", type=int, nargs="*", help="these scenes only")
    made.add_argument("--family")
    made.add_argument("--dimension", type=int)
    return made


def results(options, play):
    """Yields the result of play(options, seed) for each scene, and writes it as a line of results.jsonl in the output folder."""
    os.makedirs(options.output, exist_ok=True)
    with open(os.path.join(options.output, "results.jsonl"), "w") as file:
        for seed in options.seeds or range(options.first, options.first + options.count):
            result = play(options, seed)
            file.write(json.dumps(result) + "\n")
            file.flush()
            yield result
