"""Runs CalculiX on the samples and reads its printed results.

ccx.py WORK > reference.json   renews the reference results
"""
import hashlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

import samples

SECTOR = 180.0  # an axisymmetric model of CalculiX is a sector of two degrees


def digest(text):
    return hashlib.sha256(text.encode()).hexdigest()


def points_of(text):
    """Label -> position of all nodes of a deck without parts"""
    points = {}
    for block in re.findall(r"^\*NODE(?![ A-Z])[^\n]*\n((?:[^*][^\n]*\n)*)", text, re.M | re.I):
        for line in block.splitlines():
            label, *place = line.split(",")
            points[int(label)] = [float(x) for x in place]
    return points


def numbers(line):
    return [float(word) for word in line.split()]


def read_results(dat, points, axisymmetric):
    """By the time at the end of each step: displacements of the probes as rows (position, displacement), and contact forces by 'slave on master'"""
    times = {}
    lines = dat.splitlines()
    for at, line in enumerate(lines):
        found = re.search(r"time +(\S+)$", line)
        if not found:
            continue
        if float(found[1]) % 1:
            continue  # inside a step, whose length is 1
        result = times.setdefault(f"{float(found[1]):g}", {"displacements": [], "contact": {}})
        if line.startswith(" displacements"):
            for row in lines[at + 2:]:
                if not row.strip():
                    break
                label, *u = row.split()
                result["displacements"].append(points[int(label)] + [float(x) for x in u])
        contact = re.search(r"slave set (\S+), master set (\S+) and", line)
        if contact:
            force = numbers(lines[at + 4])[:3]
            result["contact"][f"{contact[1]} on {contact[2]}"] = [SECTOR * x if axisymmetric else x for x in force]
    return times


def version():
    """Version of the installed CalculiX, or None"""
    if shutil.which("ccx") is None:
        return None
    said = subprocess.run(["ccx", "-v"], capture_output=True, text=True, timeout=60).stdout
    return re.search(r"Version (\S+)", said)[1]


def run(name, work):
    """Results of a sample; \\throws RuntimeError  if CalculiX fails"""
    text = samples.SAMPLES[name](True)
    (work / f"{name}.inp").write_text(text)
    done = subprocess.run(["ccx", name], cwd=work, capture_output=True, text=True, timeout=600, env={**os.environ, "OMP_NUM_THREADS": "1"})
    if "*ERROR" in done.stdout or done.returncode:
        raise RuntimeError(f"ccx {name}: {done.stdout[-2000:]}")
    return {"sha256": digest(text), "times": read_results((work / f"{name}.dat").read_text(), points_of(text), "CAX" in text)}


def rounded(value):
    if isinstance(value, dict):
        return {key: rounded(one) for key, one in value.items()}
    if isinstance(value, list):
        return [rounded(one) for one in value]
    return float(f"{value:.7g}") if isinstance(value, float) else value


if __name__ == "__main__":
    place = pathlib.Path(sys.argv[1])
    place.mkdir(parents=True, exist_ok=True)
    results = {name: rounded(run(name, place)) for name in samples.SAMPLES}
    lines = [f' "{name}": {json.dumps(result)}' for name, result in results.items()]
    print("{\n" + f' "ccx": "{version()}",\n' + ",\n".join(lines) + "\n}")
