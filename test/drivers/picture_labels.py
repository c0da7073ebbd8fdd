#!/usr/bin/python3
"""Labels in the pictures of suture_plot, by matplotlib's own boxes: none covers another, a tick, or anything that it names.

    picture_labels.py --solve suture_solve --plot suture_plot --input DIR --work DIR --mpirun "..." [--full]

Text boxes are asked of the renderer; marked places, named lines and signs are the artists with the group ids "marked", "named", "sign".
"""
import argparse
import json
import re
import shutil
import sys
import warnings
from pathlib import Path

from harness import arguments, check, finish, run

SCENES = {"bracket": [], "tunnel": [], "hertz_sphere": [], "bolted_joint": [], "arch": ["--set", "Mesh/Constants/h=.2"], "roller_bearing": ["--set", "Mesh/Constants/fine=.2"]}
CROWDED = {"arch": {"joint *", "voussoir_*"}, "roller_bearing": {"inner *", "outer *", "pocket before *", "roller_*"}}  # families in scene.png
MOST_PIXELS = 1800  # height of a picture as it is saved
OTHERS = ("pin", "layers", "rings", "linear_square")  # with --full
parser = argparse.ArgumentParser()
parser.add_argument("--full", action="store_true")
options = arguments("--solve", "--plot", "--input", parser=parser)
if options.full:
    SCENES.update({scene: [] for scene in OTHERS})
sys.path.insert(0, str(Path(options.plot).resolve().parent))

import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.collections import LineCollection, PolyCollection  # noqa: E402
from matplotlib.lines import Line2D  # noqa: E402
from matplotlib.text import Annotation, Text  # noqa: E402
from suture_plot_parts.pictures import pictures  # noqa: E402
from suture_plot_parts.run import RunFolder  # noqa: E402
from suture_plot_parts.study import Table, study_figure  # noqa: E402


def box_of(text, renderer):
    """The text's own box: that of an annotation would hold its leader, too."""
    return Text.get_window_extent(text, renderer)


def ticks(axes):
    """Labels of ticks within the limits, of both axes."""
    frame = axes.get_window_extent().padded(0.5)
    for axis, low, high in ((axes.xaxis, frame.x0, frame.x1), (axes.yaxis, frame.y0, frame.y1)):
        for tick in (*axis.get_major_ticks(), *axis.get_minor_ticks()):
            place = axes.transData.transform([tick.get_loc()] * 2)[0 if axis is axes.xaxis else 1] if tick.get_loc() is not None else -1.0
            if low <= place <= high:
                yield from (label for label in (tick.label1, tick.label2) if label.get_visible() and label.get_text())


def texts(figure):
    """All that is to be read and stands on its own: [(words, text)]. Texts of legends are laid out by matplotlib."""
    found = []
    for axes in figure.axes:
        if not axes.get_visible():
            continue
        found += [("tick", label) for label in ticks(axes)]
        found += [("axis", axes.xaxis.label), ("axis", axes.yaxis.label), ("title", axes._left_title), ("title", axes.title)]
        found += [("label", text) for text in axes.texts]
    if figure._suptitle:
        found.append(("title", figure._suptitle))
    return [(words, text) for words, text in found if text.get_visible() and text.get_text().strip()]


def overlap(a, b):
    return min(a.x1, b.x1) - max(a.x0, b.x0) > 1.0 and min(a.y1, b.y1) - max(a.y0, b.y0) > 1.0


def beside(a, b, dpi):
    """Whether two texts, turned by the same angle, lie on lines far enough apart: their upright boxes may overlap."""
    angle = np.radians(a.get_rotation())
    if a.get_rotation() != b.get_rotation() or a.get_rotation() % 90 == 0:
        return False
    shift = a.get_transform().transform(a.get_position()) - b.get_transform().transform(b.get_position())
    return abs(shift @ [-np.sin(angle), np.cos(angle)]) > 1.1 * max(a.get_fontsize(), b.get_fontsize()) * dpi / 72


def points_of(artist, axes):
    """Points of a marked place, a named line or a sign, in pixels and at most two pixels apart."""
    if isinstance(artist, Line2D):
        return axes.transData.transform(np.column_stack(artist.get_data()).astype(float))
    dense = []
    for path in artist.get_paths():
        vertices = axes.transData.transform(path.vertices[:, :2])
        for a, b in zip(vertices[:-1], vertices[1:]):
            dense.append(np.linspace(a, b, 2 + min(int(np.hypot(*(b - a)) / 2), 1000)))
    return np.concatenate(dense) if dense else np.zeros((0, 2))


def faults(figure):
    figure.canvas.draw()
    renderer = figure.canvas.get_renderer()
    boxes = [(words, text.get_text().replace("\n", " "), box_of(text, renderer), text) for words, text in texts(figure)]
    for axes in figure.axes:
        if axes.get_legend():
            boxes.append(("legend", "legend", axes.get_legend().get_window_extent(renderer), None))
    found = [f"{a[0]} '{a[1]}' on {b[0]} '{b[1]}'" for i, a in enumerate(boxes) for b in boxes[:i]
             if overlap(a[2], b[2]) and not (a[3] and b[3] and beside(a[3], b[3], figure.dpi))]
    for axes in figure.axes:
        own = [text for text in axes.texts if isinstance(text, Annotation) and text.get_text().strip()]
        for artist in axes.get_children():
            if not isinstance(artist, (Line2D, LineCollection, PolyCollection)) or artist.get_gid() not in ("marked", "named", "sign"):
                continue
            points = points_of(artist, axes)
            for text in own:
                box = box_of(text, renderer).padded(-1.0)
                if np.any((points[:, 0] > box.x0) & (points[:, 0] < box.x1) & (points[:, 1] > box.y0) & (points[:, 1] < box.y1)):
                    found.append(f"label '{text.get_text()}' covers what is {artist.get_gid()}")
    return found


def shape(picture):
    """Faults of a picture as a whole: its height, and a title wider than its axes."""
    found = []
    picture.figure.canvas.draw()
    height = picture.figure.get_tightbbox().height * plt.rcParams["savefig.dpi"]
    if height > MOST_PIXELS:
        found.append(f"{height:.0f} pixels high")
    axes = picture.figure.axes[0]
    if axes._left_title.get_text():
        wide, room = box_of(axes._left_title, picture.figure.canvas.get_renderer()).width, axes.get_window_extent().width
        if wide > 1.02 * room and " " in axes._left_title.get_text():
            found.append(f"title of {wide:.0f} pixels over axes of {room:.0f}")
    return found


def planted():
    """The check itself: a label on a marked place, and one on another, are found."""
    figure, axes = plt.subplots()
    axes.plot([0.5], [0.5], "o", gid="marked")
    axes.annotate("covers", (0.5, 0.5), (0, 0), textcoords="offset points", ha="center", va="center")
    axes.annotate("covers, too", (0.5, 0.5), (3, 3), textcoords="offset points", ha="center", va="center")
    found = faults(figure)
    plt.close(figure)
    return any("covers what is marked" in fault for fault in found) and any("on label" in fault for fault in found)


def crowded(folder, source):
    """A run whose summary has long names and one condition of every kind that has a sign."""
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


check("a label on what it names is found", planted(), True)
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
            told = "(interference is not)" in picture.figure.axes[0]._left_title.get_text()
            check(f"{scene}: an interference that is drawn is told", (told, "is not enlarged" in picture.caption), (scene == "bolted_joint",) * 2)
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
