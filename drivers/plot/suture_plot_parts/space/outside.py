"""von_mises.png, principal_stress.png, deformation.png, mesh.png: the outside of the bodies in different colours."""
import matplotlib
import numpy as np
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.lines import Line2D

from ..deformation import has_interference, in_words
from ..mesh import MOST_NAMED_SUBDOMAINS, short_names, subdomain_colours
from ..style import COMPRESSION, TENSION, halo, shortened
from ..units import scaled
from .page import Page, Seen, legend_below, raster_of

MOST_LINES = 40000  # with more face sides, the lines would merge into a black area
SIGNED = LinearSegmentedColormap.from_list("signed", [COMPRESSION, "#8fb2dc", "#f4f4f2", "#e59a93", TENSION])


class Scene:
    """Data common to the plots of one run: surface, displacements, view."""

    def __init__(self, run, surface, factor, view):
        self.run, self.surface, self.factor, self.view = run, surface, factor, view
        self.points = surface.at(run.fields.points)
        moved = run.fields.point_data.get("Displacement")  # none before the scene is solved
        self.moved = self.points if moved is None else self.points + factor * surface.at(moved)
        self.creases = surface.edges[surface.creases()]
        # Visible edges of the undeformed and the deformed bodies.
        self.edges = {moved: np.unique(np.vstack([self.creases, surface.contours(points, view.toward)]), axis=0)
                      for moved, points in ((False, self.points), (True, self.moved))}
        self._seen = {}

    def page(self, what, moved=True):
        """A page with the deformed or undeformed bodies. The frame of deformed bodies also contains the undeformed bodies."""
        reach, points = (np.vstack([self.points, self.moved]), self.moved) if moved else (self.points, self.points)
        page = Page(self.run, self.view, reach, self.title(what), room=0.05 if moved else 0.09)
        if moved not in self._seen:
            self._seen[moved] = Seen(self.view, points, self.surface.triangles, raster_of(page.axes))
        page.draw(self._seen[moved])
        return page

    def title(self, what):
        return f"{self.run.title}: {what}{self.run.state}"

    @property
    def enlarged(self):
        return "" if self.factor == 1 else f", displacements enlarged {self.factor:g} times"

    def moved_place(self, place):
        """Position in the deformed body of a place of summary.json: an undeformed point, which moves as the nearest node; if bodies move far, the
        point where it is."""
        if self.run.moving:
            return np.asarray(place)
        nearest = np.argmin(np.linalg.norm(self.run.fields.points - place, axis=1))
        return np.asarray(place) + self.factor * self.run.fields.point_data["Displacement"][nearest]


def stress(run, nodal, centroids):
    """(values, whether they are nodal) of the field that the run has."""
    found = run.fields.point_data.get(nodal)
    return (found, True) if found is not None else (run.fields.cell_data[centroids], False)


def extreme(run, name):
    """(value, 3D position) from summary.json, or None."""
    found = run.extremes.get(name)
    if not found or found.get("value") is None or len(found.get("place") or []) < 3:
        return None
    return found["value"], np.array(found["place"], dtype=float)


def largest_seen(page, values):
    """The largest of `values`, at points or per triangle, over the visible triangles."""
    shown = np.flatnonzero(np.bincount(page.seen.raster.shown))
    found = values[page.seen.triangles[shown]] if len(values) == len(page.seen.points) else values[shown]
    return np.nanmax(found, initial=0.0)


def on_surface(scene, found):
    values, nodal = found
    return scene.surface.at(values) if nodal else values[scene.surface.cells]


def von_mises_figure(scene):
    """The colour scale ends at the largest visible value; the overall maximum may be inside."""
    run = scene.run
    page = scene.page(f"von Mises stress{scene.enlarged}")
    values, known = on_surface(scene, stress(run, "NodalVonMises", "VonMises")), extreme(run, "von_mises")
    top = largest_seen(page, values)
    factor, unit = scaled(run.stress_unit, top)
    page.retitle(scene.title(f"von Mises stress, largest visible {factor * top:.4g} {unit}{scene.enlarged}"))
    page.colour_by(factor * values, 0.0, factor * top or 1.0, matplotlib.colormaps["viridis"], f"von Mises stress [{unit}]")
    lines = page.lines(scene.moved, scene.edges[True])
    if known:
        page.mark(page.placer(lines), [(scene.moved_place(known[1]), f"largest von Mises\n{factor * known[0]:.4g} {unit}")])
    return page.figure


def principal_figure(scene):
    """The principal stress with the largest magnitude, with its sign."""
    run = scene.run
    page = scene.page(f"principal stress of largest magnitude{scene.enlarged}")
    all_three, nodal = stress(run, "NodalPrincipalStress", "PrincipalStress")
    which = np.argmax(np.nan_to_num(np.abs(all_three), nan=-1.0), axis=1)
    values = on_surface(scene, (all_three[np.arange(len(which)), which], nodal))
    top = largest_seen(page, np.abs(values))
    factor, unit = scaled(run.stress_unit, top)
    page.colour_by(factor * values, -factor * top or -1.0, factor * top or 1.0, SIGNED, f"principal stress [{unit}]")
    found = []
    for name, sign in (("tension", 1), ("compression", -1)):
        known = extreme(run, name)
        if known and sign * known[0] > 1e-6 * top:
            label = f"largest {name}\n{factor * known[0]:.4g} {unit}".replace("-", "\u2212")
            found.append((scene.moved_place(known[1]), label))
    page.mark(page.placer(page.lines(scene.moved, scene.edges[True])), found)
    return page.figure


def deformation_figure(scene):
    """\\return figure, whether bodies overlap as drawn"""
    run, u = scene.run, scene.run.fields.point_data["Displacement"]
    largest = np.linalg.norm(u, axis=1).max()
    factor, unit = scaled(run.length_unit, largest)
    drawn_in = scene.factor != 1 and has_interference(run)
    page = scene.page(f"deformation, {in_words(scene.factor, drawn_in)}")
    page.colour_by(factor * scene.surface.at(np.linalg.norm(u, axis=1)), 0.0, factor * largest or 1.0, matplotlib.colormaps["viridis"],
                   f"|u| [{unit}], largest {factor * largest:.4g}")
    before = {"colors": "#8a8a8a", "linewidths": 0.9, "linestyles": (0, (4, 2))}
    page.lines(scene.points, scene.creases, **before, zorder=3)
    page.lines(scene.moved, scene.edges[True])
    deformed = "deformed" if scene.factor == 1 else f"deformed \u00d7 {scene.factor:g}"
    legend_below(page.figure, page.axes, [Line2D([], [], color="black", lw=0.8, label=deformed),
                                          Line2D([], [], color="#8a8a8a", lw=0.9, ls=(0, (4, 2)), label="undeformed")])
    return page.figure, drawn_in


def mesh_figure(scene):
    """Subdomains, with the sides of the faces. \\return figure, names of subdomains without enough space"""
    grid, surface = scene.run.fields, scene.surface
    names, prefix = short_names(grid.names["Subdomains"])
    title = f"{grid.count:,} elements, {len(names)} subdomain{'s' if len(names) != 1 else ''}" + (f" {prefix}*" if prefix else "")
    page = scene.page(title, moved=False)
    number, colours = surface.of_cells("Subdomain").astype(int), subdomain_colours(grid)
    page.colour(np.array([colours.get(s, (1, 1, 1)) for s in range(max(colours) + 1)])[number])
    if len(surface.edges) <= MOST_LINES:
        page.lines(scene.points, surface.edges, colors="#5b5b5b", linewidths=0.25, zorder=3)
    page.lines(scene.points, surface.edges[surface.borders(number)], linewidths=1.0)
    page.lines(scene.points, scene.edges[False])
    left_out = []
    if len(names) <= MOST_NAMED_SUBDOMAINS:
        placer = page.placer()
        for s, places in seen_places(page, number, len(names)):
            style = {"fontsize": 8 if len(names) <= 40 else 6, "weight": "bold", "path_effects": halo()}
            if placer.place_within(shortened(names[s]), places, **style) is None:
                left_out.append(names[s])
    return page.figure, left_out


def seen_places(page, number, count):
    """[(number, positions in the plot)] of all visible parts, by the numbers of the triangles."""
    raster = page.seen.raster
    some = slice(None, None, max(1, len(raster.samples) // 200000))
    flat, shown = raster.places(some), number[raster.shown[some]]
    order = np.argsort(shown, kind="stable")
    bounds = np.searchsorted(shown[order], np.arange(count + 1))
    return [(s, flat[order[bounds[s]:bounds[s + 1]]]) for s in range(count) if bounds[s + 1] > bounds[s]]
