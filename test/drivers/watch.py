#!/usr/bin/python3
"""suture_solve --watch beside runs that succeed, fail, are killed, restarted, or were over before.

watch.py --solve PROGRAM --work DIR --source ROOT
"""
import argparse
import csv
import os
import pathlib
import pty
import shutil
import subprocess
import sys
import threading
import time

problems = []


def check(holds, what):
    if not holds:
        problems.append(what)
        print("FAILED: " + what)


class Watched:
    """A view in the background, on a pipe or on a terminal."""

    def __init__(self, program, folder, terminal=False):
        self.text = ""
        self.source, sink = pty.openpty() if terminal else os.pipe()
        environment = {name: value for name, value in os.environ.items() if name != "NO_COLOR"}
        self.process = subprocess.Popen([program, "--watch", folder], stdout=sink, stderr=sink, env=environment)
        os.close(sink)
        self.reader = threading.Thread(target=self._read, daemon=True)
        self.reader.start()

    def _read(self):
        try:
            while more := os.read(self.source, 10000):
                self.text += more.decode()
        except OSError:  # the end of a terminal
            pass

    def until(self, part, limit=60):
        """Waits until the view shows a text."""
        end = time.monotonic() + limit
        while part not in self.text and time.monotonic() < end:
            time.sleep(0.05)
        check(part in self.text, f"the view does not show '{part}':\n{self.text}")

    def end(self, limit=120):
        self.process.wait(timeout=limit)
        self.reader.join(timeout=10)
        return self.process.returncode, self.text.replace("\r\n", "\n")


def rows_in(text):
    """Rows of the table of a view: iteration, pcg, residual, active."""
    rows = []
    for line in text.splitlines():
        words = line.split()
        if len(words) in (7, 8) and all(word.lstrip("-").split(".")[0].isdigit() for word in words[:2]):
            rows.append(words)
    return rows


def history(folder):
    with open(folder / "history.csv", newline="") as file:
        return list(csv.DictReader(file))


def same_rows(text, folder, what):
    shown, written = rows_in(text), history(folder)
    check(len(shown) == len(written), f"{what}: {len(shown)} rows shown, {len(written)} in history.csv:\n{text}")
    for one, row in zip(shown, written):
        values = one[-7:]
        check(values[0] == row["iteration"] and values[1] == row["pcg"] and values[3] == row["active"] and
              abs(float(values[2]) / float(row["residual"]) - 1) < 0.06 and (len(one) == 7 or one[0] == row["load_step"]),
              f"{what}: {one} is not {row}")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--solve", required=True)
    parser.add_argument("--work", type=pathlib.Path, required=True)
    parser.add_argument("--source", type=pathlib.Path, required=True)
    options = parser.parse_args()
    solve, work = options.solve, options.work
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    tunnel = options.source / "input/tunnel/tunnel.xml"
    steps = ["--set", "Load Steps/Times={0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1}", "--set", "Load Steps/Factors/push=t"]

    # The view starts first; the run is long enough for several glances.
    folder = work / "steps"
    view = Watched(solve, folder)
    run = subprocess.run([solve, tunnel, "--output", folder, "--quiet", "--set", "Mesh/Constants/scale=0.5", *steps], timeout=200)
    code, text = view.end()
    check((run.returncode, code) == (0, 0), f"exit codes {run.returncode}, {code}:\n{text}")
    check("ended: converged and verified, exit code 0" in text, f"no end of a good run:\n{text}")
    check(" step  k   PCG   residual   active" in text, f"no header:\n{text}")
    same_rows(text, folder, "beside a run")
    check(not (folder / "history.running.csv").exists(), "history.running.csv stays after the run")

    # A finished run.
    code, text = Watched(solve, folder).end()
    check(code == 0 and "ended: converged and verified" in text, f"finished run:\n{text}")
    check(" earlier iterations" in text and len(rows_in(text)) == 20, f"a long table is not cut:\n{text}")

    # A run that does not converge.
    folder = work / "failed"
    run = subprocess.run([solve, tunnel, "--output", folder, "--quiet", "--set", "Outer Solver/Maximum Iterations=0"], stderr=subprocess.DEVNULL)
    code, text = Watched(solve, folder).end()
    check(run.returncode == code == 4 and "ended: NOT CONVERGED" in text and "exit code 4" in text, f"failed run, {code}:\n{text}")
    same_rows(text, folder, "failed run")

    # A run that is killed, then restarted in the same folder: rows appear while it runs.
    folder = work / "killed"
    slow = [solve, tunnel, "--output", folder, "--quiet", "--set", "Mesh/Constants/scale=0.2", *steps]
    run = subprocess.Popen(slow)
    view = Watched(solve, folder)
    live = folder / "history.running.csv"
    for _ in range(600):
        if live.exists() and live.read_text().count("\n") >= 2:
            break
        time.sleep(0.1)
    check(run.poll() is None and live.exists(), "no rows while the run is in progress")
    run.kill()
    run.wait()
    code, text = view.end()
    check(code == 4 and "ended without results" in text, f"killed run, {code}:\n{text}")
    check(len(rows_in(text)) >= 1, f"rows before the end of a killed run:\n{text}")

    # Half-written lines, and another run in the same folder while the view is open: an imitation of a run, with the lock of this process.
    folder = work / "imitated"
    folder.mkdir()
    (folder / ".suture.lock").write_text(f"process {os.getpid()} on {os.uname().nodename}")
    live = folder / "history.running.csv"
    header = "iteration,pcg,condition,residual,euclidean,active,changed,energy,step,seconds,algebraic_error\n"
    row = "%d,4,2.5,%g,1e-3,87,2,-1.5e7,1,0.25,\n"
    view = Watched(solve, folder)
    text = header + row % (1, 1e-2) + row % (2, 1e-4)
    for length in (len(header) // 2, len(header) + 7, len(text) - 9, len(text)):
        live.write_text(text[:length])
        time.sleep(0.3)
    view.until("1.0e-04")
    live.write_text(header + row % (1, 3e-1))  # another run
    view.until("3.0e-01")
    (folder / ".suture.lock").unlink()
    code, shown = view.end()
    check([(words[0], words[2]) for words in rows_in(shown)] == [("1", "1.0e-02"), ("2", "1.0e-04"), ("1", "3.0e-01")], f"half lines:\n{shown}")
    check("another run started in this folder" in shown and code == 4, f"another run:\n{shown}")

    # A damaged summary, and a folder without a run.
    (folder / "summary.json").write_text("{")
    code, shown = Watched(solve, folder).end()
    check(code == 4 and "summary.json is damaged" in shown, f"damaged summary:\n{shown}")
    code, shown = Watched(solve, work / "nothing").end()
    check(code == 3 and "there is no such folder" in shown, f"no folder, {code}:\n{shown}")
    done = subprocess.run([solve, "--watch", folder, tunnel], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    check(done.returncode == 2 and "--watch" in done.stdout, f"with a scene, {done.returncode}:\n{done.stdout}")

    # On a terminal a last line counts the seconds.
    folder = work / "terminal"
    folder.mkdir()
    (folder / ".suture.lock").write_text(f"process {os.getpid()} on {os.uname().nodename}")
    view = Watched(solve, folder, terminal=True)
    view.until("no iteration yet, 2 s")
    (folder / ".suture.lock").unlink()
    code, shown = view.end()
    check("ended without results" in shown, f"terminal: {shown!r}")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
