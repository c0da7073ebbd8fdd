"""safety.png of 3D runs: the safety factors on the outside of the bodies."""
import numpy as np

from ..safety import COLOURS, SAFETY_LABEL, TOP, least_place, safety_values
from .outside import on_surface


def safety_figure(scene):
    run = scene.run
    page = scene.page(f"safety factor{scene.enlarged}")
    values = on_surface(scene, safety_values(run))
    page.colour_by(np.minimum(values, TOP), 0.0, TOP, COLOURS, SAFETY_LABEL)
    lines = page.lines(scene.moved, scene.edges[True])
    least = least_place(run)
    if least:
        page.mark(page.placer(lines), [(scene.moved_place(least[1]), f"least safety factor\n{least[0]:.4g}")])
    return page.figure
