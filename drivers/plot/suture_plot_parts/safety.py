"""safety.png of 2D runs; colours and values of safety factors, also for 3D runs."""
import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.colors import ListedColormap
from matplotlib.tri import Triangulation

from .labels import LabelPlacer
from .stresses import callouts, framed, outline, taken_at, visible, whole

# Red below 1, blue above, also if red and green look alike.
COLOURS = ListedColormap(["#b2182b", "#d6604d", "#fddbc7", "#d1e5f0", "#67a9cf", "#2166ac"])
TOP = 3.0  # end of the scale: 1 is between two colours
SAFETY_LABEL = f"safety factor (dark blue: {TOP - 0.5:g} and more)"


def has_safety(run):
    return run.fields is not None and "SafetyFactor" in run.fields.cell_data and bool(run.summary.get("safety"))


def least_place(run):
    """(factor, place) of the least safety factor, or None; of a run with load steps only if it is in the step that is drawn."""
    safety = run.summary["safety"]
    own = safety["bodies"].get(safety.get("body") or "", {})
    step = own.get("step")
    if not own.get("place") or run.step is not None or (step is not None and step != len(run.steps.get("time", []))):
        return None
    return own["factor"], np.array(own["place"], dtype=float)


def safety_values(run):
    """(values, at nodes)"""
    nodal = run.fields.point_data.get("NodalSafetyFactor")
    return (nodal, True) if nodal is not None else (run.fields.cell_data["SafetyFactor"], False)


def safety_caption(run):
    bodies = run.summary["safety"]["bodies"]
    named = "; ".join(f"{name}: {own['material']}, {own['criterion']}, at least {own['factor']:.3g}" for name, own in bodies.items()
                      if own.get("factor") is not None and own.get("criterion"))
    later = " The least factors are those of all load steps." if run.steps else ""
    return (f"Safety factor by the strength of the materials, {taken_at(run)}; red: below 1, where the linear elastic answer is not valid; grey: "
            f"no strength given. The ring marks the least factor. {named}.{later}")


def safety_figure(run):
    grid = run.fields
    window = whole(grid)
    values, nodal = safety_values(run)
    figure, axes = framed(run, window, f"{run.title}: safety factor{run.state}", extra=0.9)
    axes.add_collection(PolyCollection(grid.outlines, facecolors="#d9d9d9", edgecolors="none", zorder=0))
    limits = {"cmap": COLOURS, "vmin": 0.0, "vmax": TOP}
    if nodal:
        triangles = grid.triangles()
        triangles = triangles[np.isfinite(values[triangles]).all(axis=1)]
        # The least of the corners: the mean would hide a factor below 1.
        drawn = axes.tripcolor(Triangulation(*grid.points[:, :2].T, triangles), facecolors=np.minimum(values[triangles].min(axis=1), TOP),
                               rasterized=True, **limits)
    else:
        known = np.isfinite(values)
        drawn = PolyCollection([outline for outline, use in zip(grid.outlines, known) if use], array=np.minimum(values[known], TOP), edgecolors="face",
                               linewidths=0.35, cmap=COLOURS)
        drawn.set_clim(0.0, TOP)
        axes.add_collection(drawn)
    axes.set_xlim(*axes.get_xlim())
    edges = outline(run, axes, zorder=4)
    bar = figure.colorbar(drawn, ax=axes, shrink=0.8, pad=0.02)
    bar.set_label(SAFETY_LABEL)
    bar.outline.set_linewidth(0.4)
    least = least_place(run)
    if least:
        placer = LabelPlacer(figure, axes)
        placer.prefer_outside(visible(run, window))
        placer.keep_off(edges)
        callouts(placer, axes, [(least[1][:2], f"least safety factor\n{least[0]:.4g}")])
    return figure
