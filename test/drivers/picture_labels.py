#!/usr/bin/python3
"""Labels in the pictures of suture_plot, checked by picture_faults.py on scenes with many labels.

    picture_labels.py --solve suture_solve --plot suture_plot --input DIR --work DIR --mpirun "..." [--full]
"""
import argparse
import json
import re
import shutil
import sys
import warnings
from pathlib import Path

from harness import arguments, check, finish, run

SCENES = {"hertz_sphere": [], "bolted_joint": [], "arch": ["--set", "Mesh/Constants/h=.2"]}
CROWDED = {"arch": {"joint *", "voussoir_*"}, "roller_bearing": {"inner *", "outer *", "pocket before *", "roller_*"}}  # families in scene.png
OTHERS = {"roller_bearing": ["--set", "Mesh/Constants/fine=.2"], **{scene: [] for scene in ("bracket", "tunnel", "pin", "layers", "rings", "linear_square")}}  # --full
parser = argparse.ArgumentParser()
parser.add_argument("--full", action="store_true")
options = arguments("--solve", "--plot", "--input", parser=parser)
if options.full:
    SCENES.update(OTHERS)
sys.path.insert(0, str(Path(options.plot).resolve().parent))

import matplotlib.pyplot as plt  # noqa: E402
from picture_faults import faults, shape  # noqa: E402
from suture_plot_parts.pictures import pictures  # noqa: E402
from suture_plot_parts.run import RunFolder  # noqa: E402
from suture_plot_parts.study import Table, study_figure  # noqa: E402


def planted():
    """The check itself finds a label on a marked place and one on another label."""
    figure, axes = plt.subplots()
    axes.plot([0.5], [0.5], "o", gid="marked")
    axes.annotate("covers", (0.5, 0.5), (0, 0), textcoords="offset points", ha="center", va="center")
    axes.annotate("covers, too", (0.5, 0.5), (3, 3), textcoords="offset points", ha="center", va="center")
    found = faults(figure)
    plt.close(figure)
    return any("covers what is marked" in fault for fault in found) and any("on label" in fault for fault in found)


def crowded(folder, source):
    """A run whose summary has long names and one condition of every kind with a symbol."""
    shutil.copytree(source, folder)
    summary = json.loads((folder / "summary.json").read_text())
    given = summary["parameters"]
    summary["title"] = "A title that is longer than any title ought to be, so that it must be broken into several lines of text, twice at least"
    for key in ("Boundary Conditions", "Contact"):
        given[key] = {f"{name} which has a very long name that goes on and on": of for name, of in given[key].items()}
    given["Boundary Conditions"].update({
        "own weight": {"Type": "Gravity", "Value": [0.0, -9.81]}, "spin": {"Type": "Rotation", "Value": [3.0], "Point": [4.0, 4.0]},
        "poke": {"Type": "Point Force", "Value": [-2.0, -3.0], "Point": [32.0, 0.0]},
        "bed": {"Type": "Elastic Support", "Group": ["block_bottom"], "Normal Stiffness": 3e4}, "heat": {"Type": "Temperature", "Value": [80.0]},
        "wring": {"Type": "Moment", "Value": [-5.0], "Group": ["cylinder_top"]}, "lift": {"Type": "Force", "Value": [0.0, 7.0], "Group": ["cylinder_top"]},
        "hold": {"Type": "Displacement", "Value": [0.0, 0.0], "Group": ["block_axis"]}})
    given["Contact"]["round"] = {"Side A": ["block_axis"], "Obstacle": "Circle", "Circle": {"Centre": [-9.0, -9.0], "Radius": 5.0}}
    given["Contact"]["wall"] = {"Side A": ["block_axis"], "Obstacle": "Line", "Line": {"Point": [-3.0, 0.0], "Normal": [1.0, 0.0]}}
    (folder / "summary.json").write_text(json.dumps(summary))
    return RunFolder(folder)


def study_table(folder, labels, logarithmic):
    """A study of one sweep with these labels; its last run failed."""
    rows = [{"labels": [str(label)], "cells": [10.0 + i], "exit_code": 4 if i == len(labels) - 1 else 0, "failure": ""} for i, label in enumerate(labels)]
    plot = {"name": "n", "x": "sweep", "y": ["pcg", "pcg"], "by": [], "logarithmic_x": logarithmic, "logarithmic_y": logarithmic}
    (folder / "study.json").write_text(json.dumps({"title": "T", "sweeps": [{"name": "sweep", "labels": list(map(str, labels))}], "columns": ["pcg"],
                                                   "rows": rows, "plots": [plot]}))
    return Table(folder / "study.json"), plot


check("a label on the object that it names is found", planted(), True)
warnings.simplefilter("error")  # raw text of a library
for scene, words in SCENES.items():
    folder = options.work / scene
    code, said = run(options.solve, 2, Path(options.input) / scene / f"{scene}.xml", *words, "--output", folder)
    check(f"{scene} is solved", code, 0)
    names = []
    for picture in pictures(RunFolder(folder)):
        check(f"{scene}, {picture.name}: labels", faults(picture.figure), [])
        check(f"{scene}, {picture.name}: shape", shape(picture) if picture.name != "convergence" else [], [])
        names.append(picture.name)
        if picture.name == "deformation":
            stated = "(interference is not)" in picture.figure.axes[0]._left_title.get_text()
            check(f"{scene}: a drawn interference is stated", (stated, "is not enlarged" in picture.caption), (scene == "bolted_joint",) * 2)
        if picture.name == "mesh":
            labels = {text.get_text() for text in picture.figure.axes[0].texts}
            missing = [name for name in RunFolder(folder).fields.side_groups if not {name, re.sub(r"\d+", "*", name)} & labels]
            check(f"{scene}: sides are named, or the caption says which are not", [name for name in missing if name not in picture.caption], [])
        if picture.name == "scene" and scene in CROWDED:
            check(f"{scene}: families are named", CROWDED[scene] - {text.get_text() for text in picture.figure.axes[0].texts}, set())
        if picture.name == "scene" and scene not in CROWDED:
            labels = {text.get_text() for text in picture.figure.axes[0].texts}
            given = RunFolder(folder).summary["parameters"]
            expected = {*given["Boundary Conditions"], *given["Contact"], *given["Bodies"]}
            check(f"{scene}: conditions, contacts and bodies are named", sorted(name for name in expected if len(name) <= 26 and name not in labels), [])
        plt.close(picture.figure)
    check(f"{scene}: pictures", {"scene", "mesh", "deformation", "von_mises", "principal_stress"} <= set(names), True)
    check(f"{scene}: pages of contact lines", sum(name.startswith("contact") for name in names), {"arch": 2, "roller_bearing": 3, "linear_square": 0}.get(scene, 1))
for picture in pictures(crowded(options.work / "crowded", options.work / "hertz_sphere")):
    check(f"crowded, {picture.name}: labels", faults(picture.figure), [])
    plt.close(picture.figure)
for name, labels, logarithmic in (("names", ["Stiffness Diagonal", "Multiplicity", "Young", "Deluxe", "Rigid Modes with Averages"], False),
                                  ("close numbers", [1000, 1100, 1200, 1300, 1400, 1500, 20000], True), ("numbers", [1, 10, 100, 1000], True),
                                  ("many", list(range(0, 90000, 1000)), False)):
    figure = study_figure(*study_table(options.work, labels, logarithmic))
    check(f"study, {name}: labels", faults(figure), [])
    plt.close(figure)
finish()
