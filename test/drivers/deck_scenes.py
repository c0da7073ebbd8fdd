"""suture_convert --scene on decks in several dialects: displacements and contact forces agree with CalculiX within two per cent.

deck_scenes.py --convert PROGRAM --solve PROGRAM --mpirun "mpirun ..." --work DIR [--live]

The results of CalculiX are in decks/reference.json, with the hash of the decks that gave them (decks/ccx.py renews them). --live runs
CalculiX again; exit code 77 if it is not installed.
"""
import argparse
import csv
import json
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE / "decks"))
try:
    import ccx
    import h5py
    import numpy as np
    import samples
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

from harness import arguments, check, finish, forked, run

CLOSE = 0.02  # difference from CalculiX, over the largest displacement of the probes or the largest force
SAME = 1e-4  # of two runs of CalculiX
parser = argparse.ArgumentParser()
parser.add_argument("--live", action="store_true")
options = arguments("--convert", "--solve", parser=parser)
work = options.work
reference = json.loads((HERE / "decks" / "reference.json").read_text())
# Contacts of the scene by the names of CalculiX.
NAMES = {"press": {"s_Surf on m_Surf": "S on M"}}
RANKS = {"press": (1,), "strip": (1, 2), "bolt": (1, 4), "shortened_bolt": (1, 2), "blocks": (1, 2), "rings": (1, 2), "axes": (2,), "release": (1,)}
LEFT = {"rings": ["line 83: 1 element of the type SPRINGA"], "release": ["*BOUNDARY on 'Hold' ends in step 2"]}


def fields_of(folder):
    """Points and displacements by time; a scene without load steps has the time 1"""
    series = folder / "fields.vtkhdf.series"
    files = {"1": "fields_0000.vtkhdf"}
    if series.exists():
        files = {f"{file['time']:g}": file["name"] for file in json.loads(series.read_text())["files"]}
    found = {}
    for time, name in files.items():
        with h5py.File(folder / name) as file:
            found[time] = file["VTKHDF/Points"][:], file["VTKHDF/PointData/Displacement"][:]
    return found


def contact_forces(folder):
    with open(folder / "reactions.csv") as file:
        return {row["name"]: np.array([float(row[f]) for f in ("fx", "fy", "fz")]) for row in csv.DictReader(file) if row["kind"] == "contact"}


def difference(rows, points, displacements):
    """Largest difference of displacements at the probes over the largest one. Two bodies may have a node at one place."""
    rows = np.array(rows)
    size = np.linalg.norm(rows[:, 3:], axis=1).max()
    worst = 0.0
    for row in rows:
        at = np.flatnonzero(np.linalg.norm(points - row[:3], axis=1) < 1e-5)
        worst = max(worst, min((np.linalg.norm(displacements[i] - row[3:]) for i in at), default=np.inf) / size)
    return worst


def compare(name, folder, expected):
    """Results of one run beside those of CalculiX. The last time of CalculiX is the last one of the scene."""
    fields = fields_of(folder)
    last_ccx, last = (max(times, key=float) for times in (expected["times"], fields))
    for time, result in expected["times"].items():
        own = last if time == last_ccx else time
        if own not in fields or not result["displacements"]:
            continue
        away = difference(result["displacements"], *fields[own])
        check(f"{name}: displacements at time {time} differ by {away:.2%}", away, lambda x: x < CLOSE)
    forces = contact_forces(folder)
    for contact, force in expected["times"][last_ccx]["contact"].items():
        names = {own.upper(): value for own, value in forces.items()}
        own = names[next((mine.upper() for mine, other in NAMES.get(name, {}).items() if other == contact), contact.upper())]
        away = np.linalg.norm(np.abs(own) - np.abs(force)) / np.linalg.norm(force)
        check(f"{name}: force of contact '{contact}' differs by {away:.2%}", away, lambda x: x < CLOSE)
    return last


def convert(name):
    source = work / f"{name}.inp"
    source.write_text(samples.SAMPLES[name](False))
    for file, text in samples.INCLUDED.get(name, {}).items():
        (work / file).write_text(text())
    code, text = forked(options.convert, source, "--scene", work / f"{name}.xml", "--units", "mm")
    check(f"{name}: exit code of suture_convert", (code, text if code else ""), (0, ""))
    left = LEFT.get(name, [])
    check(f"{name}: lists what it does not take over", "not taken over:" in text, bool(left))
    for line in left:
        check(f"{name}: lists '{line}'", line in text and line in (work / f"{name}.xml").read_text(), True)


def run_live():
    if ccx.version() is None:
        print("skipped: CalculiX (ccx) is not installed")
        sys.exit(77)
    for name in samples.SAMPLES:
        again = ccx.run(name, work)
        for time, result in again["times"].items():
            old = reference[name]["times"][time]
            if result["displacements"]:
                new, stored = np.array(result["displacements"])[:, 3:], np.array(old["displacements"])[:, 3:]
                away = np.abs(new - stored).max() / np.abs(stored).max()
                check(f"{name}: CalculiX {ccx.version()} gives the stored displacements at time {time}", away, lambda x: x < SAME)
            for contact, force in result["contact"].items():
                away = np.linalg.norm(np.array(force) - old["contact"][contact]) / np.linalg.norm(force)
                check(f"{name}: CalculiX gives the stored force of '{contact}' at time {time}", away, lambda x: x < SAME)


if options.live:
    run_live()
    finish()
for name in samples.SAMPLES:
    check(f"{name}: the reference is that of this deck", reference[name]["sha256"], ccx.digest(samples.SAMPLES[name](True)))
    convert(name)
    for ranks in RANKS[name]:
        folder = work / f"{name}_{ranks}"
        code, text = run(options.solve, ranks, work / f"{name}.xml", "--output", folder)
        check(f"{name}: exit code on {ranks} ranks", (code, text if code else ""), (0, ""))
        if code == 0:
            compare(name, folder, reference[name])
finish()
