"""groups.png of a 2D scene: the bodies with the names of all side groups."""
import numpy as np
from matplotlib.collections import LineCollection

from .families import families
from .labels import LabelPlacer
from .mesh import anchors_of, inward
from .plane_image import image_of
from .scene import body_colours
from .style import LINES, canvas, halo, shortened
from .words import contacts


def groups_figure(run):
    """A name that finds no clear place lies where it covers least."""
    grid = run.fields
    groups = {name: sides for name, sides in sorted(grid.side_groups.items()) if len(sides)}
    labels = families(groups)
    figure, axes = canvas(grid.points, f"{run.title}: names of the sides", run.length_unit, room=0.16, names=run.axes)
    bodies = grid.names["Bodies"]
    image_of(axes, grid).colour(body_colours(grid))
    outline = grid.lines(grid.boundary, grid.points)
    axes.add_collection(LineCollection(outline, colors="#444444", linewidths=0.6, zorder=2))
    placer = LabelPlacer(figure, axes)
    placer.prefer_outside(grid.centroids[::max(1, grid.count // 4000)])
    placer.keep_off(outline)
    size = np.ptp(grid.points[:, :2], axis=0).max()
    colours = {label: LINES[i % len(LINES)] for i, label in enumerate(labels)}
    for label, members in labels.items():
        for name in members:
            segments = inward(groups[name], 0.003 * size)
            axes.add_collection(LineCollection(segments, colors=[colours[label]], linewidths=2.2, capstyle="round", zorder=3, gid="named"))
            placer.keep_visible_lines(segments)
    # The label of a contact side is placed inside its body, that of any other side outside.
    within = {group for contact in contacts(run) if contact.obstacle == "None" for group in contact.side_a + contact.side_b}
    for label, members in labels.items():
        anchors, toward = anchors_of([groups[name] for name in members])
        placer.place(shortened(label, 40), anchors, toward=-toward if members[0] in within else toward, must=True, color=colours[label], fontsize=8,
                     weight="bold", path_effects=halo(), zorder=5)
    for number, body in enumerate(bodies):
        own = grid.centroids[grid.cell_data["Body"] == number]
        if len(own):
            placer.place_within(shortened(body), own, fontsize=9, style="italic", color="#333333", path_effects=halo())
    return figure
