"""The corpus of random scenes (test/corpus) as a part of the validation: both formulations and Monolithic on 1 and 2 ranks."""
import os
import subprocess
import time


def run(program, scenes, mpirun, output, ranks=(1, 2), limit=1200):
    """Runs the scenes on each number of ranks; returns {"ranks", "scenes", "seconds", "failures", "table"} for each. The full output is in
    corpus_np<ranks>.txt."""
    results = []
    for n in ranks:
        begin = time.monotonic()
        try:
            done = subprocess.run(mpirun.split() + ["-np", str(n), program, "--count", str(scenes)], stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE, stdin=subprocess.DEVNULL, text=True, timeout=limit,
                                  env={"OMPI_MCA_mpi_yield_when_idle": "1", **os.environ})
            text, code = done.stdout, done.returncode
        except subprocess.TimeoutExpired as expired:
            text, code = (expired.stdout or b"").decode(), f"not done after {limit} s"
        with open(os.path.join(output, f"corpus_np{n}.txt"), "w") as file:
            file.write(text)
        lines = text.splitlines()
        head = next((i for i, line in enumerate(lines) if line.startswith("family ")), len(lines))
        failures = [f"corpus on {n} ranks: {line}" for line in lines[:head] if line.strip()]
        if head == len(lines) or (code != 0 and not failures):
            failures.append(f"corpus on {n} ranks: ended with {code}" + (" before its closing table" if head == len(lines) else ""))
        results.append({"ranks": n, "scenes": scenes, "seconds": time.monotonic() - begin, "failures": failures, "table": lines[head:]})
        print(f"corpus of {scenes} scenes on {n} ranks: {results[-1]['seconds']:.0f} s, {len(failures)} failed", flush=True)
    return results


def section(results):
    """Section of the page."""
    lines = ["## Corpus of random scenes", "",
             "Random contact scenes, each solved by both formulations and by Monolithic, verified by one loop over the elements and compared with each "
             "other (`build/bin/test_corpus`). Neutral: a rigid-body motion is unrestrained at the solution; rounded: forces have fewer "
             "digits than the bound requires, because a body moves far.", ""]
    for result in results:
        lines += [f"{result['scenes']} scenes on {result['ranks']} ranks in {result['seconds']:.0f} s: "
                  + (f"**{len(result['failures'])} failed**" if result["failures"] else "none failed"), "", "```", *result["table"], "```", ""]
    return lines
