"""Checks labels in the pictures of suture_plot by matplotlib's bounding boxes: none covers another label, a tick, or a marked object.

The renderer computes the text boxes; marked places, named lines and signs are the artists with the group ids "marked", "named", "sign".
"""
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.lines import Line2D
from matplotlib.text import Annotation, Text

MOST_PIXELS = 1800  # height of a saved picture


def box_of(text, renderer):
    """Box of the text alone; the box of an annotation includes its leader."""
    return Text.get_window_extent(text, renderer)


def ticks(axes):
    """Tick labels within the limits of both axes."""
    frame = axes.get_window_extent().padded(0.5)
    for axis, low, high in ((axes.xaxis, frame.x0, frame.x1), (axes.yaxis, frame.y0, frame.y1)):
        for tick in (*axis.get_major_ticks(), *axis.get_minor_ticks()):
            place = axes.transData.transform([tick.get_loc()] * 2)[0 if axis is axes.xaxis else 1] if tick.get_loc() is not None else -1.0
            if low <= place <= high:
                yield from (label for label in (tick.label1, tick.label2) if label.get_visible() and label.get_text())


def texts(figure):
    """All free texts: [(words, text)]. matplotlib lays out the texts of legends."""
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
    """Whether two texts, rotated by the same angle, lie on lines far enough apart, although their upright boxes may overlap."""
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
