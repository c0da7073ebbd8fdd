#!/usr/bin/python3
"""The interactive view in the report of a 3D run: its data against the fields of the run, its size, its absence; what its scripts compute, in
Node.js, and what it draws, in Chromium (view_in_browser.py), if these are installed.

    report_view.py --plot suture_plot --work DIR --mpirun "..."
"""
import base64
import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import h5py
import numpy as np
from harness import SLOWER, arguments, check, finish, forked

options = arguments("--plot")
sys.path.insert(0, str(Path(options.plot).resolve().parent))

import space_scenes  # noqa: E402
from suture_plot_parts.run import RunFolder  # noqa: E402
from suture_plot_parts.space.cells import CELLS, FACES  # noqa: E402
from suture_plot_parts.view.data import view_data  # noqa: E402
from suture_plot_parts.view.library import library  # noqa: E402
from view_in_browser import browser, in_browser, near, on_paper  # noqa: E402

MISSING = 65535
WAY = 9.0  # of the upper block in each step of moving()


def numbers(of):
    """Whole numbers as the page reads them."""
    return np.frombuffer(base64.b64decode(of["data"]), "<u4" if of["bits"] == 32 else "<u2").astype(int)


def values(of, text, columns=None):
    codes = np.frombuffer(base64.b64decode(text), "<u2").astype(float)
    codes = codes.reshape(-1, columns) if columns else codes
    return np.where(codes == MISSING, np.nan, np.array(of["low"]) + np.array(of["step"]) * codes)


def data_of(folder):
    text = (folder / "report.html").read_text(encoding="utf-8")
    found = re.search(r'<script type="application/json" id="view3d_data">(.*?)</script>', text, re.S)
    return json.loads(found.group(1)) if found else None


def same(a, b):
    """For each row of `a`, the index of the equal row of `b`; -1 if there is none."""
    distance = np.abs(a[:, None] - b[None]).max(axis=2)
    return np.where(distance.min(axis=1) < 1e-3, distance.argmin(axis=1), -1)


def normals(points, triangles):
    a, b, c = (points[triangles[:, k]] for k in range(3))
    return 0.5 * np.cross(b - a, c - a)


def geometry(name, data, volumes):
    """Triangles of each body enclose its volume, seen from outside; cells fill it."""
    points, triangles = values(data["points"], data["points"]["data"], 3), numbers(data["triangles"]).reshape(-1, 3)
    for body, volume in enumerate(volumes):
        own = triangles[data["starts"][body]:data["starts"][body + 1]]
        enclosed = (normals(points, own) * points[own].mean(axis=1)).sum() / 3
        check(f"{name}: volume within the surface of {data['bodies'][body]}", enclosed, near(volume, 2e-3 * volume))
    return points, triangles


def fields(name, data, folder, frames=1):
    """All values equal those of the files at the same places, to the 16 bits of the page."""
    points = values(data["points"], data["points"]["data"], 3)
    check(f"{name}: frames", (len(data["frames"]), len(data["displacement"]["frames"])), (frames, frames))
    for k in range(frames):
        with h5py.File(folder / f"fields_{k:04d}.vtkhdf") as file:
            root = file["VTKHDF"]
            place, own = root["Points"][:], {key: values_[:] for key, values_ in root["PointData"].items()}
        found = same(points, place)
        check(f"{name}: vertices are nodes", int((found < 0).sum()), lambda count: count < len(points) // 2)  # the rest are centres of faces
        there = found >= 0
        # Where bodies touch, two nodes share a place: the values of one of them.
        twins = [np.flatnonzero(np.abs(place - place[i]).max(axis=1) < 1e-9) for i in found[there]]
        for key, columns, of, texts in (("Displacement", 3, data["displacement"], data["displacement"]["frames"]),
                                        *((source, None, field, field["frames"]) for source, label in
                                          (("NodalVonMises", "von_mises"),) for field in data["fields"] if field["name"] == label)):
            shown, slack = values(of, texts[k], columns)[there], 0.51 * np.max(of["step"])
            worst = max(np.min(np.abs(own[key][twin] - row).reshape(len(twin), -1).max(axis=1)) for row, twin in zip(shown, twins))
            check(f"{name}, frame {k + 1}: {key}", worst, lambda worst, slack=slack: worst <= slack)
        for field in data["fields"]:
            if field["name"] in ("tension", "compression"):
                column = {"tension": 0, "compression": 2}[field["name"]]
                shown = values(field, field["frames"][k])[there]
                worst = max(np.min(np.abs(own["NodalPrincipalStress"][twin, column] - value)) for value, twin in zip(shown, twins))
                check(f"{name}, frame {k + 1}: {field['name']}", worst, lambda worst, step=field["step"]: worst <= 0.51 * np.max(step))


def blocks():
    """Two blocks on two ranks: places, values and ranges; contact surface."""
    folder = options.work / "blocks"
    space_scenes.blocks(folder, CELLS[12].faces, n=4)
    check("blocks: suture_plot", forked(options.plot, folder)[0], 0)
    data = data_of(folder)
    text = (folder / "report.html").read_text(encoding="utf-8")
    check("blocks: enlarged as in the pictures", f"Displacements are enlarged {data['enlargement']:g} times" in text, True)
    points, _ = geometry("blocks", data, [500.0, 500.0])
    check("blocks: box", (points.min(axis=0).tolist(), points.max(axis=0).tolist()), near(([0, 0, 0], [10, 10, 10]), 1e-9))
    fields("blocks", data, folder)
    with h5py.File(folder / "fields_0000.vtkhdf") as file:
        own = file["VTKHDF/PointData"]
        for name, found in (("displacement", np.linalg.norm(own["Displacement"][:], axis=1)), ("von_mises", own["NodalVonMises"][:]),
                            ("tension", own["NodalPrincipalStress"][:, 0]), ("compression", own["NodalPrincipalStress"][:, 2])):
            field = next(field for field in data["fields"] if field["name"] == name)
            check(f"blocks: range of {name}", (field["least"], field["largest"]), near((found.min(), found.max()), 1e-12 * np.abs(found).max()))
    check("blocks: the inside is there", (data["inside"], data["reduced"], sum(len(numbers(block["owners"])) for block in data["cells"])),
          (True, False, 2 * 4 * 4 * 2))
    contacts = data["contacts"]
    (shape,) = contacts["shapes"]
    places, triangles = values(shape["points"], shape["points"]["data"], 3), numbers(shape["triangles"]).reshape(-1, 3)
    check("blocks: area of the contact", np.linalg.norm(normals(places, triangles), axis=1).sum(), near(100.0, 1e-2))
    run = RunFolder(folder)
    pressure = next(field for field in contacts["fields"] if field["name"] == "pressure")
    check("blocks: contact pressure", values(pressure, pressure["frames"][0])[:len(run.contact.points)],
          near(run.contact.point_data["ContactPressure"], 0.51 * np.max(pressure["step"])))
    return folder


def steps(source):
    """Load steps: one frame each, at most as many as have room, always the last."""
    folder = options.work / "steps"
    shutil.copytree(source, folder)
    count = 6
    for k in range(1, count):
        for kind in ("fields", "contact"):
            shutil.copy(source / f"{kind}_0000.vtkhdf", folder / f"{kind}_{k:04d}.vtkhdf")
        with h5py.File(folder / f"fields_{k:04d}.vtkhdf", "a") as file:
            for name in ("Displacement", "NodalVonMises", "NodalPrincipalStress"):
                file[f"VTKHDF/PointData/{name}"][...] *= 1 + k
    columns = "step,time,length,active,sticking,slipping,external_work,stored_energy,dissipated_work"
    rows = "\n".join(f"{k + 1},{0.5 * (k + 1)},0.5,1,0,0,1,1,0" for k in range(count))
    (folder / "steps.csv").write_text(f"{columns}\n{rows}\n")
    summary = json.loads((folder / "summary.json").read_text())
    summary["load_steps"] = {"count": count, "time": 0.5 * count}
    (folder / "summary.json").write_text(json.dumps(summary))
    check("steps: suture_plot", forked(options.plot, folder)[0], 0)
    data = data_of(folder)
    fields("steps", data, folder, count)
    check("steps: names", (data["frames"][0], data["frames"][-1], data["first"]), ("load step 1 of 6, t = 0.5", "load step 6 of 6, t = 3", count - 1))
    run = RunFolder(folder)
    whole = len(json.dumps(view_data(run, 10**7)))
    less = view_data(run, whole // 2)
    check("steps: less room, fewer frames or no inside", (len(json.dumps(less)) < 0.6 * whole, less["frames"][-1]), (True, data["frames"][-1]))
    return folder


def moving(source):
    """Bodies that move far: the box contains them at all steps, normals turn with them, contact surfaces are those of the step."""
    folder = options.work / "moving"
    shutil.copytree(source, folder, ignore=shutil.ignore_patterns("*.png"))
    count, angle, centre = 3, 0.5, np.array([5.0, 5.0, 7.5])
    for k in range(count):
        for kind in ("fields", "contact")[:2 if k < 2 else 1]:  # no pairs are left at the end
            if k:
                shutil.copy(source / f"{kind}_0000.vtkhdf", folder / f"{kind}_{k:04d}.vtkhdf")
        cosine, sine = np.cos(k * angle), np.sin(k * angle)
        turn = np.array([[cosine, -sine, 0], [sine, cosine, 0], [0, 0, 1]])
        with h5py.File(folder / f"fields_{k:04d}.vtkhdf", "a") as file:
            place, ends = file["VTKHDF/Points"][:], np.cumsum(file["VTKHDF/NumberOfPoints"][:])
            upper = np.arange(len(place)) >= ends[1]  # the parts of the lower block come first
            motion = (place - centre) @ turn.T + centre + [WAY * k, 0, 0] - place
            file["VTKHDF/PointData/Displacement"][...] = np.where(upper[:, None], motion, 0.0)
        if k < 2:
            with h5py.File(folder / f"contact_{k:04d}.vtkhdf", "a") as file:
                file["VTKHDF/Points"][...] += [WAY * k, 0, 0]
    rows = "\n".join(f"{k + 1},{k + 1},1,1,0,0,1,1,0" for k in range(count))
    (folder / "steps.csv").write_text(f"step,time,length,active,sticking,slipping,external_work,stored_energy,dissipated_work\n{rows}\n")
    summary = json.loads((folder / "summary.json").read_text())
    summary["load_steps"], summary["parameters"]["Motion"] = {"count": count, "time": float(count)}, "Moving"
    (folder / "summary.json").write_text(json.dumps(summary))
    check("moving: suture_plot", forked(options.plot, folder)[0], 0)
    data = data_of(folder)
    check("moving: as they are", data["enlargement"], 1.0)
    # The corners of the upper block: half a diagonal of 10 x 10 around the centre, at angles of 45 degrees and that of the step.
    half = [5 * np.sqrt(2) * np.cos(np.pi / 4 - k * angle) for k in range(count)]
    check("moving: box of all steps", data["reach"]["high"][:2], near([5 + 2 * WAY + half[2], 5 + max(half)], 1e-2))
    check("moving: box of the drawn bodies", data["reach"]["low"], near([min(0, *(5 + WAY * k - half[k] for k in range(count))), 5 - max(half), 0], 1e-2))
    turns = np.array(data["turns"])
    check("moving: the lower block does not turn", turns[:, 0], near(np.tile(np.eye(3).reshape(-1), (count, 1)), 1e-3))
    check("moving: the upper one does", np.arctan2(turns[:, 1, 3], turns[:, 1, 0]), near(angle * np.arange(count), 1e-3))
    contacts = data["contacts"]
    middles = [values(shape["points"], shape["points"]["data"], 3).mean(axis=0)[:1].tolist() for shape in contacts["shapes"][:2]]
    check("moving: contact surfaces of each step", (len(contacts["shapes"]), middles), lambda found: found[0] == count and near([[5.0], [5.0 + WAY]], 1e-2)(found[1]))
    check("moving: none at the end", ([len(numbers(shape["triangles"])) > 0 for shape in contacts["shapes"]], contacts["fields"][0]["frames"][2]),
          ([True, True, False], ""))
    check("moving: no picture of an earlier contact", (folder / "contact.png").exists(), False)
    check("small motions: normals as drawn", data_of(source)["turns"], None)
    if shutil.which("node"):
        without_browser(folder, angle)


def removed(source):
    """Steps before a body was removed have another mesh: the view shows the others."""
    folder = options.work / "removed"
    shutil.copytree(source, folder, ignore=shutil.ignore_patterns("*.png"))
    last = folder / "fields_0001.vtkhdf"
    space_scenes.blocks(folder, CELLS[12].faces, n=2)
    (folder / "fields_0000.vtkhdf").rename(last)
    (folder / "contact_0000.vtkhdf").unlink()
    shutil.copy(source / "fields_0000.vtkhdf", folder)
    shutil.copy(last, folder / "fields_0002.vtkhdf")
    rows = "\n".join(f"{k + 1},{k + 1},1,0,0,0,1,1,0" for k in range(3))
    (folder / "steps.csv").write_text(f"step,time,length,active,sticking,slipping,external_work,stored_energy,dissipated_work\n{rows}\n")
    summary = json.loads((folder / "summary.json").read_text())
    summary["load_steps"] = {"count": 3, "time": 3.0}
    (folder / "summary.json").write_text(json.dumps(summary))
    check("removed: suture_plot", forked(options.plot, folder)[0], 0)
    check("removed: steps on the last mesh", data_of(folder)["frames"], ["load step 2 of 3, t = 2", "load step 3 of 3, t = 3"])
    check("removed: the report says so", "Load steps with other bodies" in (folder / "report.html").read_text(encoding="utf-8"), True)


def without_browser(folder, angle):
    """What the page would draw of moving(), computed by its own scripts in Node.js. `angle`: of the upper block in each step"""
    done = subprocess.run(["node", str(Path(__file__).with_name("view_without_browser.js")), str(folder / "report.html")], capture_output=True, text=True,
                          timeout=100 * SLOWER)
    check("node: the page runs", (done.returncode, done.stderr), (0, ""))
    if done.returncode:
        return
    for k, frame in enumerate(json.loads(done.stdout)):
        lower, upper = frame["bodies"]
        check(f"node, frame {k + 1}: places", [lower["centre"], upper["centre"]], near([[5, 5, 2.5], [5 + WAY * k, 5, 7.5]], 1e-2))
        check(f"node, frame {k + 1}: normals after {k * angle:g} rad", max(lower["normals"], upper["normals"]), lambda off: off < 2e-3)
        check(f"node, frame {k + 1}: nothing outside of the canvas", max(lower["edge"], upper["edge"]), lambda edge: 0.2 < edge < 1)
        (joint,) = frame["contacts"]
        if k < 2:
            check(f"node, frame {k + 1}: contact surface", (joint["drawn"], joint["low"] + joint["high"]),
                  lambda found, k=k: found[0] and near([WAY * k, 0, 5, 10 + WAY * k, 10, 5], 1e-2)(found[1]))
        else:
            check(f"node, frame {k + 1}: no contact surface", joint["count"], 0)


def curved():
    """Second-order cells, and a surface with less room: coarser, of the same shape, with the largest displacement."""
    folder = options.work / "ball"
    space_scenes.ball_on_block(folder, CELLS[24].faces, FACES[6].triangles, n=6)
    check("ball: suture_plot", forked(options.plot, folder)[0], 0)
    data = data_of(folder)
    volumes = [4 / 3 * np.pi * 8**3, 24 * 20 * 8]
    points, triangles = values(data["points"], data["points"]["data"], 3), numbers(data["triangles"]).reshape(-1, 3)
    for body, volume in enumerate(volumes):
        own = triangles[data["starts"][body]:data["starts"][body + 1]]
        check(f"ball: volume of body {body}", (normals(points, own) * points[own].mean(axis=1)).sum() / 3, near(volume, 0.03 * volume))
    fields("ball", data, folder)
    run = RunFolder(folder)
    import suture_plot_parts.view.data as view
    plans, view.PLANS = view.PLANS, [(False, 1, 1500)]
    coarse = view_data(run, 10**7)
    view.PLANS = plans
    found = numbers(coarse["triangles"]).reshape(-1, 3)
    check("ball, coarser: triangles", (coarse["reduced"], 300 < len(found) <= 1500 < len(triangles)), (True, True))
    at = values(coarse["points"], coarse["points"]["data"], 3)
    own = found[:coarse["starts"][1]]
    check("ball, coarser: volume", (normals(at, own) * at[own].mean(axis=1)).sum() / 3, near(volumes[0], 0.15 * volumes[0]))
    check("ball, coarser: largest displacement", coarse["fields"][0]["largest"], near(data["fields"][0]["largest"], 1e-12))
    check("ball: no room", view_data(run, 1000), None)


def safety(source):
    """Safety factors of nodes become a field; NaN, without strength, stays without value."""
    folder = options.work / "safety"
    shutil.copytree(source, folder)
    with h5py.File(folder / "fields_0000.vtkhdf", "a") as file:
        points = file["VTKHDF/Points"][:]
        factor = np.where(points[:, 2] > 7.6, np.nan, 1 + points[:, 0])
        file["VTKHDF/PointData/NodalSafetyFactor"] = factor
    found = view_data(RunFolder(folder), 10**7)
    field = next(field for field in found["fields"] if field["name"] == "safety")
    at, shown = values(found["points"], found["points"]["data"], 3), values(field, field["frames"][0])
    low = at[:, 2] < 7.4
    check("safety: values", shown[low], near(1 + at[low, 0], 1e-3))
    check("safety: without strength", bool(np.isnan(shown[at[:, 2] > 7.7]).all()), True)
    check("safety: range", (field["least"], field["largest"], field["reversed"]), (1.0, 11.0, True))


def without_library(source):
    """Without three.js the report has still pictures and says how to get it."""
    (options.work / "no_library").mkdir()
    os.environ["SUTURE_THREE"] = str(options.work / "no_library")
    out = options.work / "still"
    check("no library: suture_plot", forked(options.plot, source, "--output", out)[0], 0)
    del os.environ["SUTURE_THREE"]
    text = (out / "report.html").read_text(encoding="utf-8")
    check("no library: a sentence, and pictures", ("apt-get install libjs-three" in text, "<script" in text, text.count("<img ") > 5), (True, False, True))


def size_and_licence(folder):
    text = (folder / "report.html").read_text(encoding="utf-8")
    check("size of the report", len(text.encode()), lambda size: size <= 10_000_000)
    check("the licence of the library", text.count("Permission is hereby granted, free of charge") >= 1, True)


if library() is None:
    print("three.js is not installed (Debian: libjs-three): nothing to compare")
    folder = options.work / "blocks"
    space_scenes.blocks(folder, CELLS[12].faces, n=4)
    without_library(folder)
    finish()
source = blocks()
folder = steps(source)
moving(source)
removed(source)
curved()
safety(source)
without_library(source)
size_and_licence(source)
if browser():
    in_browser(folder)
    on_paper(folder)
else:
    print("Chromium is not installed: the page is not drawn")
finish()
