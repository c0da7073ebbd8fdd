#!/usr/bin/python3
"""Runs the commands of a documentation page in an empty folder, as a reader would, and compares the results with the page.

run_page.py PAGE --source FOLDER --drivers FOLDER --work DIR [--checkout] [--renew]

- Lines of blocks ```sh are commands, run one after the other; $SUTURE is the source folder. --checkout: the folder looks like a built
  checkout, with input/ and build/drivers/.
- Lines of blocks ```text must be printed by the commands above them: equal words, numbers within one per cent, numbers below 1e-5 (residuals,
  round-off) within a factor of three; ... matches any text.
- Blocks ```xml must occur in a linked scene, blocks ```cpp and ```cmake in a linked source or next to it.
- A picture with a title, ![words](file.png "run_out/mesh.png"), must be written by the commands under that name; its size must be within
  10 % of the picture on the page. --renew copies it to the page instead.
"""
import argparse
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import xml.etree.ElementTree as xml

SLOWER = float(os.environ.get("SUTURE_TIME_FACTOR", 1))  # factor on time limits, set by the test presets
NUMBER = r"(?<![\w.])[-+]?(?:\d{1,3}(?:,\d{3})+|\d+)(?:\.\d+)?(?:[eE][-+]?\d+)?(?![\w])"


def canonical(element):
    return (element.tag, tuple(sorted(element.attrib.items())), tuple(canonical(child) for child in element))


def value(text):
    return float(text.replace(",", ""))


def agree(number, other):
    if 0 < abs(number) < 1e-5:
        return 1 / 3 <= other / number <= 3
    return abs(other - number) <= 0.01 * abs(number)


def stands(segment, text, begin):
    """End of `segment` in `text` if it occurs at `begin`, or None."""
    numbers, pattern, end = [], "", 0
    for found in re.finditer(NUMBER, segment):
        pattern += re.escape(segment[end:found.start()]) + f"({NUMBER})"
        numbers.append(value(found[0]))
        end = found.end()
    pattern = re.sub(r"(?:\\ )+", r"\\s+", pattern + re.escape(segment[end:]))
    found = re.compile(pattern).match(text, begin)
    return found.end() if found and all(agree(number, value(text)) for text, number in zip(found.groups(), numbers)) else None


def continues(segments, text, begin):
    """Whether the segments occur in `text` from `begin` on, the last one at its end, with any text between them."""
    end = stands(segments[0], text, begin)
    if end is None:
        return False
    if len(segments) == 1:
        return end == len(text)
    return any(continues(segments[1:], text, place) for place in range(end, len(text) + 1))


def says(line, printed):
    """Whether one of the printed lines is `line`."""
    return any(continues(line.split("..."), candidate.strip(), 0) for candidate in printed.splitlines())


def pixels(file):
    """Width and height of a PNG."""
    head = file.read_bytes()[:24] if file.is_file() else b""
    return struct.unpack(">II", head[16:24]) if head[:8] == b"\x89PNG\r\n\x1a\n" else None


class Reading:
    def __init__(self, options):
        self.page, self.work = options.page, options.work
        self.text = options.page.read_text()
        self.environment = {**os.environ, "SUTURE": str(options.source), "PATH": f"{options.drivers}:{os.environ['PATH']}"}
        self.printed, self.failures, self.checked = "", [], 0
        shutil.rmtree(self.work, ignore_errors=True)
        self.work.mkdir(parents=True)
        if options.checkout:
            (self.work / "build").mkdir()
            (self.work / "build" / "drivers").symlink_to(options.drivers.resolve())
            (self.work / "input").symlink_to(options.source.resolve() / "input")

    def run(self, command):
        done = subprocess.run(command, shell=True, cwd=self.work, env=self.environment, capture_output=True, text=True, timeout=120 * SLOWER)
        print(f"$ {command}\n{done.stdout}{done.stderr}", flush=True)
        self.printed += done.stdout + done.stderr
        if done.returncode != 0:
            self.failures.append(f"{command}: exit code {done.returncode}")

    def blocks(self):
        known = set()
        for link in re.findall(r"\]\(([^)]+\.xml)\)", self.text):
            known |= {canonical(element) for element in xml.parse(self.page.parent / link).getroot().iter()}
        sources = ""
        for link in re.findall(r"\]\(([^)]+\.cpp)\)", self.text):
            source = self.page.parent / link
            sources += source.read_text() + (source.parent / "CMakeLists.txt").read_text()
        for kind, block in re.findall(r"^```(sh|text|xml|cpp|cmake)\n(.*?)^```", self.text, re.S | re.M):
            self.checked += 1
            if kind == "xml":
                if canonical(xml.fromstring(block)) not in known:
                    self.failures.append(f"no linked scene has this:\n{block}")
                continue
            if kind in ("cpp", "cmake"):
                lines = [line for line in block.splitlines() if line not in sources.splitlines()]
                self.failures += [f"no linked source has the line: {line}" for line in lines]
                continue
            for line in block.replace("\\\n", "").splitlines():
                if line.strip() and kind == "sh":
                    self.run(line)
                elif line.strip() and not says(line.strip(), self.printed):
                    self.failures.append(f"no command above prints: {line.strip()}")

    def pictures(self, renew):
        for link, made in re.findall(r"!\[[^\]]*\]\(([^)\s]+) \"([^\"]+)\"\)", self.text):
            shown, file = self.page.parent / link, self.work / made
            if pixels(file) is None:
                self.failures.append(f"the commands make no picture {made}")
            elif renew:
                shown.parent.mkdir(exist_ok=True)
                shutil.copy(file, shown)
            elif not pixels(shown) or any(abs(a - b) > 0.1 * b for a, b in zip(pixels(file), pixels(shown))):
                self.failures.append(f"{link} is not {made}: {pixels(shown)} and {pixels(file)} pixels; run_page.py --renew copies it")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("page", type=pathlib.Path)
    for option in ("--source", "--drivers", "--work"):
        parser.add_argument(option, type=pathlib.Path, required=True)
    parser.add_argument("--checkout", action="store_true")
    parser.add_argument("--renew", action="store_true")
    options = parser.parse_args()
    reading = Reading(options)
    reading.blocks()
    reading.pictures(options.renew)
    if not reading.checked:
        reading.failures.append(f"{options.page} has nothing to run or to compare")
    sys.exit("failed:\n  " + "\n  ".join(reading.failures) if reading.failures else 0)


if __name__ == "__main__":
    main()
