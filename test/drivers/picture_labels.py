#!/usr/bin/python3
"""Labels in the pictures of suture_plot, by matplotlib's own boxes: none covers another, a tick, or anything that it names.

    picture_labels.py --solve suture_solve --plot suture_plot --input DIR --work DIR --mpirun "..."

Text boxes are asked of the renderer; marked places, named lines and signs are the artists with the group ids "marked", "named", "sign".
"""
import sys
from pathlib import Path

from harness import arguments, check, finish, run

SCENES = ("bracket", "tunnel", "pin", "layers", "rings", "hertz_sphere", "linear_square")
options = arguments("--solve", "--plot", "--input")
sys.path.insert(0, str(Path(options.plot).resolve().parent))

import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.collections import LineCollection, PolyCollection  # noqa: E402
from matplotlib.lines import Line2D  # noqa: E402
from matplotlib.text import Annotation, Text  # noqa: E402
from suture_plot_parts.pictures import pictures  # noqa: E402
from suture_plot_parts.run import RunFolder  # noqa: E402


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
    boxes = [(words, text.get_text().replace("\n", " "), box_of(text, renderer)) for words, text in texts(figure)]
    for axes in figure.axes:
        if axes.get_legend():
            boxes.append(("legend", "legend", axes.get_legend().get_window_extent(renderer)))
    found = [f"{a[0]} '{a[1]}' on {b[0]} '{b[1]}'" for i, a in enumerate(boxes) for b in boxes[:i] if overlap(a[2], b[2])]
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


def planted():
    """The check itself: a label on a marked place, and one on another, are found."""
    figure, axes = plt.subplots()
    axes.plot([0.5], [0.5], "o", gid="marked")
    axes.annotate("covers", (0.5, 0.5), (0, 0), textcoords="offset points", ha="center", va="center")
    axes.annotate("covers, too", (0.5, 0.5), (3, 3), textcoords="offset points", ha="center", va="center")
    found = faults(figure)
    plt.close(figure)
    return any("covers what is marked" in fault for fault in found) and any("on label" in fault for fault in found)


check("a label on what it names is found", planted(), True)
for scene in SCENES:
    folder = options.work / scene
    code, said = run(options.solve, 2, Path(options.input) / scene / f"{scene}.xml", "--output", folder)
    check(f"{scene} is solved", code, 0)
    names = []
    for picture in pictures(RunFolder(folder)):
        check(f"{scene}, {picture.name}: labels", faults(picture.figure), [])
        names.append(picture.name)
        if picture.name == "scene":
            labels = {text.get_text() for text in picture.figure.axes[0].texts}
            given = RunFolder(folder).summary["parameters"]
            expected = {*given["Boundary Conditions"], *given["Contact"], *given["Bodies"]}
            check(f"{scene}: conditions, contacts and bodies are named", sorted(name for name in expected if len(name) <= 26 and name not in labels), [])
        plt.close(picture.figure)
    check(f"{scene}: pictures", {"scene", "mesh", "deformation", "von_mises", "principal_stress"} <= set(names), True)
finish()
