"""von_mises.png, principal_stress.png and their zooms."""
import math

import matplotlib
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection
from matplotlib.colors import Normalize
from matplotlib.transforms import ScaledTranslation

from .labels import LabelPlacer
from .plane_image import image_of
from .style import COMPRESSION, TENSION, PlotError, canvas, colour_bar
from .units import round_down, scaled

GROUND = (0.957, 0.957, 0.949)  # of bodies behind crosses
ROUNDING = 1e-6  # fraction of the largest stress below which a stress counts as zero
CALLOUT = {"fontsize": 9, "zorder": 9, "bbox": {"boxstyle": "round,pad=0.25", "fc": "white", "ec": "black", "lw": 0.5}}


def extreme(run, name):
    """(value, place) from summary.json, or None."""
    found = run.extremes.get(name)
    if not found or found.get("value") is None or not found.get("place"):
        return None
    return found["value"], np.array(found["place"][:2], dtype=float)


def taken_at(run):
    return run.extremes.get("stresses", "at centroids of elements")


def across(run):
    return "hoop stress" if run.model == "Axisymmetric" else "out-of-plane stress"


def von_mises_caption(run):
    return f"Von Mises stress, {taken_at(run)}. The ring marks the largest value."


def principal_caption(run):
    return (f"In-plane principal stresses, drawn along their directions; tension red, compression blue. The rings mark the largest tension "
            f"and compression in summary.json, {taken_at(run)}, including the {across(run)}.")


def inside(window, points):
    x0, x1, y0, y1 = window[:4]
    return (points[:, 0] >= x0) & (points[:, 0] <= x1) & (points[:, 1] >= y0) & (points[:, 1] <= y1)


def whole(grid):
    low, high = grid.points.min(axis=0), grid.points.max(axis=0)
    return low[0], high[0], low[1], high[1]


def framed(run, window, title):
    x0, x1, y0, y1 = window[:4]
    figure, axes = canvas(np.array([[x0, y0], [x1, y1]]), title, run.length_unit, extra=0.9, room=(0.02, 0.02 if len(window) > 4 else 0.08), names=run.axes)
    return figure, axes


def outline(run, axes, **style):
    segments = run.fields.lines(run.fields.boundary, run.fields.points)
    axes.add_collection(LineCollection(segments, colors="black", linewidths=0.8, **style))
    return segments


def callouts(placer, axes, found):
    """Rings and labels of marked points. `found`: [(point, label)]. All rings are drawn first, so that no label covers one."""
    angles = np.linspace(0, 2 * np.pi, 12, endpoint=False)
    for place, _ in found:
        axes.plot(*place, "o", ms=10, mfc="none", mec="white", mew=2.4, zorder=7)
        axes.plot(*place, "o", ms=10, mfc="none", mec="black", mew=1.1, zorder=8, gid="marked")
        at = axes.transData.transform(place)
        circle = at + 8.0 * np.column_stack([np.cos(angles), np.sin(angles)])
        placer.keep_visible(axes.transData.inverted().transform(np.vstack([circle, [at]])))
    for place, label in found:
        placer.place(label, [place], least=26.0, **CALLOUT)


def visible(run, window):
    """Points that labels should avoid: cells in the window."""
    near = run.fields.centroids[inside(window, run.fields.centroids)]
    return near[::max(1, len(near) // 3000)]


def von_mises_figure(run, region=None):
    grid = run.fields
    window = region or whole(grid)
    nodal = grid.point_data.get("NodalVonMises")
    values = nodal if nodal is not None else grid.cell_data["VonMises"]
    known = values[np.isfinite(values)]
    largest = extreme(run, "von_mises")
    top = largest[0] if largest else known.max(initial=0.0)
    factor, unit = scaled(run.stress_unit, top)
    title = f"{run.title}: von Mises stress" + (f" {region[4]}" if region else "") + run.state
    figure, axes = framed(run, window, title)
    high = factor * top or 1.0
    image_of(axes, grid).colour_by(factor * values, nodal is not None, 0.0, high, matplotlib.colormaps["viridis"])
    edges = outline(run, axes, zorder=4)
    colour_bar(axes, ScalarMappable(Normalize(0.0, high), "viridis"), f"von Mises stress [{unit}]")
    if largest and inside(window, largest[1][None])[0]:
        placer = LabelPlacer(figure, axes)
        placer.prefer_outside(visible(run, window))
        placer.keep_off(edges)
        callouts(placer, axes, [(largest[1], f"largest von Mises\n{factor * largest[0]:.4g} {unit}")])
    return figure


def thin_out(centroids, spacing):
    """One cell per square of the given size, the one nearest to its centre. Gives an even density on graded meshes."""
    keys = np.floor(centroids / spacing).astype(np.int64)
    distance = np.hypot(*(centroids - (keys + 0.5) * spacing).T)
    order = np.argsort(distance, kind="stable")
    _, first = np.unique(keys[order], axis=0, return_index=True)
    return np.sort(order[first])


def crosses_figure(run, region=None):
    grid = run.fields
    window = region or whole(grid)
    stress, centroids = grid.cell_data["PrincipalStress"], grid.centroids
    within = np.flatnonzero(inside(window, centroids) & np.isfinite(stress[:, :2]).all(axis=1))
    x0, x1, y0, y1 = window[:4]
    if len(within) == 0:
        raise PlotError(f"no element lies in the region x {x0:g} .. {x1:g}, y {y0:g} .. {y1:g}; the mesh reaches from "
                        f"{tuple(grid.points.min(axis=0)[:2].tolist())} to {tuple(grid.points.max(axis=0)[:2].tolist())}")
    spacing = math.sqrt((x1 - x0) * (y1 - y0) / min(1100, len(within)))
    chosen = within[thin_out(centroids[within], spacing)]
    # Always draw the cells with the largest stresses, since they matter most.
    chosen = np.union1d(chosen, within[[np.argmin(stress[within, 1]), np.argmax(stress[within, 0])]])
    typical = np.percentile(np.abs(stress[chosen, :2]).max(axis=1), 97) or 1.0
    reach = 0.5 * spacing / typical
    title = f"{run.title}: principal stresses" + (f" {region[4]}" if region else "") + run.state
    figure, axes = framed(run, window, title)
    image_of(axes, grid).colour(GROUND)
    edges = outline(run, axes, zorder=1)
    bars_of = {}
    for which, direction in ((0, "PrincipalDirection1"), (1, "PrincipalDirection2")):
        value = stress[chosen, which]
        # Longer than 1.5 typical bars would cross the neighbours.
        half = grid.cell_data[direction][chosen, :2] * (np.minimum(np.abs(value), 1.6 * typical) * reach)[:, None]
        bars = np.stack([centroids[chosen] - half, centroids[chosen] + half], axis=1)
        pulls = value > ROUNDING * typical
        for colour, mask in ((COMPRESSION, ~pulls), (TENSION, pulls)):
            axes.add_collection(LineCollection(bars[mask], colors=colour, linewidths=0.9, capstyle="butt", zorder=2 if colour == COMPRESSION else 3))
            bars_of.setdefault(colour, []).append(mask.any())
    scale_bar(figure, axes, run, typical, 2 * reach / (x1 - x0) / 1.04, any(bars_of[TENSION]))
    placer = LabelPlacer(figure, axes)
    placer.prefer_outside(visible(run, window))
    placer.keep_off(edges)
    found = extremes_in(run, window, within, stress)
    largest = max((abs(value) for _, value, _ in found), default=0.0)
    factor, unit = scaled(run.stress_unit, largest)
    callouts(placer, axes, [(place, f"{words}\n{factor * value:.4g} {unit}".replace("-", "\u2212")) for place, value, words in found])
    return figure


def extremes_in(run, window, within, stress):
    """[(place, value, words)]: both extremes of summary.json; if a region does not contain them, those of its cells."""
    found, least = [], ROUNDING * np.abs(stress[within, :2]).max()
    for name, column, pick, sign in (("tension", 0, np.argmax, 1), ("compression", 1, np.argmin, -1)):
        known = extreme(run, name)
        if known and inside(window, known[1][None])[0]:
            place, value, where = known[1], known[0], ""
            cell = np.argmin(np.hypot(*(run.fields.centroids - place).T))
            if len(run.fields.cell_data["PrincipalStress"][cell]) > 2 and \
                    sign * stress[cell, 2] > sign * stress[cell, column] + 1e-6 * abs(value):
                where = f", {across(run)}"
        else:
            cell = within[pick(stress[within, column])]
            place, value, where = run.fields.centroids[cell], stress[cell, column], " here"
        if sign * value > least:
            found.append((place, value, f"largest {name}{where}"))
    return found


def scale_bar(figure, axes, run, typical, length_of_one, tension):
    """Below the axes: the scale of stresses, and the meaning of the colours."""
    factor, unit = scaled(run.stress_unit, typical)
    reference = round_down(factor * typical)
    length = reference / factor * length_of_one  # in units of the axes' width
    width = axes.get_window_extent().width / figure.dpi  # inches
    if not width * length > 0.12:
        length = 0.12 / width
    below = axes.transAxes + ScaledTranslation(0, -0.62, figure.dpi_scale_trans)
    shift = ScaledTranslation(0.12, 0, figure.dpi_scale_trans)
    axes.plot([0.5 - 0.5 * length, 0.5 + 0.5 * length], [0, 0], transform=below, color="black", lw=1.4, clip_on=False)
    axes.text(0.5 - 0.5 * length, 0, "compression  ", color=COMPRESSION, weight="bold", transform=below, va="center", ha="right")
    axes.annotate(f"{reference:g} {unit}", (0.5 + 0.5 * length, 0), (5, 0), xycoords=below, textcoords="offset points", va="center", ha="left")
    axes.text(0.5 + 0.5 * length, 0, "tension" if tension else "(no tension here)", color=TENSION, weight="bold",
              transform=below + shift + ScaledTranslation(0.75, 0, figure.dpi_scale_trans), va="center", ha="left")
