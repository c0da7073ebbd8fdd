"""mesh.png: elements, subdomains and named sides."""
import numpy as np
from matplotlib.collections import LineCollection

from .families import families
from .labels import LabelPlacer, along
from .plane_image import image_of
from .style import LINES, PALETTE, canvas, halo, pale, shortened
from .words import contacts

MOST_NAMED_SUBDOMAINS = 150
MOST_NAMED_GROUPS = 40


def subdomain_colours(grid):
    """A pale colour for each subdomain, different from those of its neighbours."""
    number = grid.merged(None)
    count = int(grid.cell_data["Subdomain"].max(initial=0)) + 1
    pairs = [number[nodes] * count + grid.cell_data["Subdomain"][own].astype(np.int64)[:, None] for _, own, nodes in grid.blocks]
    node, subdomain = np.divmod(np.unique(np.concatenate([pair.reshape(-1) for pair in pairs])), count)
    shared = np.diff(node, prepend=-1) * np.diff(node, append=-1) == 0  # an adjacent list entry is the same node
    at_point = {}
    for n, s in zip(node[shared].tolist(), subdomain[shared].tolist()):
        at_point.setdefault(n, []).append(s)
    neighbours = {int(s): set() for s in np.unique(grid.cell_data["Subdomain"])}
    for met in at_point.values():
        for s in met:
            neighbours[s].update(t for t in met if t != s)
    chosen = {}
    usable = len(PALETTE) - 1  # not black
    use = [0] * usable
    for s in sorted(neighbours, key=lambda s: -len(neighbours[s])):
        taken = [chosen[n] for n in neighbours[s] if n in chosen]
        chosen[s] = min(range(usable), key=lambda c: (taken.count(c), use[c], c))
        use[chosen[s]] += 1
    return {s: pale(PALETTE[c]) for s, c in chosen.items()}


def short_names(names):
    """Names without a common prefix ("subdomain_"), cut at a word."""
    if len(names) < 2:
        return names, ""
    prefix = names[0]
    for name in names[1:]:
        while not name.startswith(prefix):
            prefix = prefix[:-1]
    while prefix and prefix[-1] not in "_ -.":
        prefix = prefix[:-1]
    return [name[len(prefix):] for name in names], prefix


def inward(sides, distance):
    """Sides shifted into their own body (on the left), since the two sides of a contact line would coincide."""
    way = sides[:, 3:5] - sides[:, 0:2]
    shift = np.column_stack([-way[:, 1], way[:, 0]]) * (distance / np.maximum(np.hypot(*way.T), 1e-300))[:, None]
    return np.stack([sides[:, 0:2] + shift, sides[:, 3:5] + shift], axis=1)


def mesh_figure(run):
    """\\return figure, names of side groups without enough space"""
    grid = run.fields
    names, prefix = short_names(grid.names["Subdomains"])
    if len(names) > 1 and all(name.endswith(" 1") for name in names):  # one per body
        names = [name[:-2] for name in names]
    groups = {name: sides for name, sides in sorted(grid.side_groups.items()) if len(sides)}
    labels = families(groups)
    few = len(labels) <= MOST_NAMED_GROUPS
    title = f"{run.title}: {grid.count:,} elements, {len(names)} subdomain{'s' if len(names) != 1 else ''}" + (f" {prefix}*" if prefix else "")
    figure, axes = canvas(grid.points, title, run.length_unit, room=0.14 if few else 0.05, names=run.axes)
    colours = subdomain_colours(grid)
    image = image_of(axes, grid)
    image.colour(np.array([colours.get(s, (1, 1, 1)) for s in range(max(colours) + 1)])[grid.cell_data["Subdomain"].astype(int)])
    image.edges(grid.points, colors="#00000038")
    placer = LabelPlacer(figure, axes)
    placer.prefer_outside(grid.centroids[::max(1, grid.count // 4000)])
    size = np.ptp(grid.points[:, :2], axis=0).max()
    colours = {}
    for i, (label, members) in enumerate(labels.items()):
        colours[label] = LINES[i % len(LINES)]
        for name in members:
            segments = inward(groups[name], 0.0022 * size)
            axes.add_collection(LineCollection(segments, colors=[colours[label]], linewidths=1.8, capstyle="round", zorder=3, gid="named"))
            placer.keep_visible_lines(segments)
    # The label of a contact side is placed inside its body, that of any other side outside.
    within = {group for contact in contacts(run) if contact.obstacle == "None" for group in contact.side_a + contact.side_b}
    if few:
        for label, members in labels.items():
            anchors, toward = anchors_of([groups[name] for name in members])
            placer.place(shortened(label), anchors, toward=-toward if members[0] in within else toward, color=colours[label], fontsize=8, weight="bold",
                         path_effects=halo(), zorder=5)
    if len(names) <= MOST_NAMED_SUBDOMAINS:
        subdomain = grid.cell_data["Subdomain"].astype(int)
        for s, name in enumerate(names):
            own = grid.centroids[subdomain == s]
            if len(own) == 0:
                continue
            placer.place_within(shortened(name), own, fontsize=8 if len(names) <= 40 else 6, weight="bold", path_effects=halo())
    return figure, placer.left_out if few else list(labels)


def anchors_of(members):
    """Positions for the label of side groups, best first, with outward normals: five on one, or the middles of some of many."""
    if len(members) == 1:
        return along(members[0], [0.5, 0.35, 0.65, 0.2, 0.8])
    order = np.unique(np.linspace(0, len(members) - 1, 7).astype(int))
    points, normals = zip(*(along(members[i], [0.5]) for i in sorted(order, key=lambda i: abs(i - len(members) // 2))))
    return np.concatenate(points), np.concatenate(normals)
