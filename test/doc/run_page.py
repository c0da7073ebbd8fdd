"""Runs the commands of a page of doc/ as a reader would, one after the other in an empty folder: all of its blocks ```sh. Its blocks ```xml must
stand in a scene that the page links to. run_page.py PAGE --source FOLDER --drivers FOLDER --work DIR"""
import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as xml

parser = argparse.ArgumentParser()
parser.add_argument("page", type=pathlib.Path)
for option in ("--source", "--drivers", "--work"):
    parser.add_argument(option, type=pathlib.Path, required=True)
options = parser.parse_args()
shutil.rmtree(options.work, ignore_errors=True)
options.work.mkdir(parents=True)
text = options.page.read_text()
environment = {**os.environ, "SUTURE": str(options.source), "PATH": f"{options.drivers}:{os.environ['PATH']}"}
failures = []


def canonical(element):
    return (element.tag, tuple(sorted(element.attrib.items())), tuple(canonical(child) for child in element))


commands = [line for block in re.findall(r"^```sh\n(.*?)^```", text, re.S | re.M) for line in block.splitlines() if line.strip()]
for command in commands:
    done = subprocess.run(command, shell=True, cwd=options.work, env=environment, capture_output=True, text=True, timeout=120)
    print(f"$ {command}\n{done.stdout}{done.stderr}", flush=True)
    if done.returncode != 0:
        failures.append(f"{command}: exit code {done.returncode}")

known = set()
for link in re.findall(r"\]\(([^)]+\.xml)\)", text):
    known |= {canonical(element) for element in xml.parse(options.page.parent / link).getroot().iter()}
for block in re.findall(r"^```xml\n(.*?)^```", text, re.S | re.M):
    if canonical(xml.fromstring(block)) not in known:
        failures.append(f"no linked scene has this:\n{block}")

if not commands:
    failures.append(f"{options.page} has no commands")
sys.exit("failed:\n  " + "\n  ".join(failures) if failures else 0)
