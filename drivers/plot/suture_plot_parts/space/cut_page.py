"""von_mises_cut.png: the von Mises stress in a plane section of the bodies."""
import matplotlib
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection
from matplotlib.colors import Normalize
from matplotlib.lines import Line2D
from matplotlib.patheffects import withStroke
from matplotlib.transforms import ScaledTranslation

from ..stresses import CALLOUT
from ..samples import show
from ..style import TENSION, PlotError, canvas, colour_bar
from ..units import scaled
from .contact_surface import contact_surfaces
from .cut import Cut
from .image import coloured, picture
from .outside import stress
from .page import BESIDE, placer_on, raster_of, ring

CLOSED, OPEN = TENSION, "white"


def cut_figure(run, surface, plane):
    """\\param run  of in_place()  \\param surface  the outside of the bodies"""
    words = plane.words(run.length_unit)
    values, nodal = stress(run, "NodalVonMises", "VonMises")
    cut = Cut(run.fields, plane, {"stress": values} if nodal else {})
    if not len(cut.corners):
        raise PlotError(f"the plane {words} contains no element")
    found = cut.values["stress"] if nodal else np.repeat(values[cut.cells][:, None], 3, axis=1)
    top = np.nanmax(found, initial=0.0)
    factor, unit = scaled(run.stress_unit, top)
    corners = cut.flat.reshape(-1, 2)
    title = f"{run.title}: von Mises stress on the plane {words}, largest {factor * top:.4g} {unit}{run.state}"
    figure, axes = canvas(corners, title, run.length_unit, extra=BESIDE, room=0.05, names=plane.names)
    raster = raster_of(axes)
    raster.draw(corners, np.zeros(len(corners)), np.arange(len(corners)).reshape(-1, 3))
    colours = matplotlib.colormaps["viridis"]
    show(axes, picture(raster, coloured(raster.interpolate(factor * found), 0.0, factor * top or 1.0, colours)))
    colour_bar(axes, ScalarMappable(Normalize(0.0, factor * top or 1.0), colours), f"von Mises stress [{unit}]")
    outline, _ = cut.lines(surface.at(run.fields.points), surface.triangles)
    axes.add_collection(LineCollection(outline, colors="black", linewidths=0.8, capstyle="round", zorder=4))
    touching = contact_lines(run, axes, cut)
    if touching:
        axes.legend(handles=touching, loc="upper center", bbox_to_anchor=(0.5, 0.0), ncol=2,
                    bbox_transform=axes.transAxes + ScaledTranslation(0, -0.45, figure.dpi_scale_trans))
    if top > 0:
        best = np.unravel_index(np.nanargmax(found), found.shape)
        place = cut.flat[best] if nodal else cut.flat[best[0]].mean(axis=0)
        placer = placer_on(figure, axes, raster)
        placer.keep_off(outline)
        ring(axes, placer, place)
        placer.place(f"largest here\n{factor * top:.4g} {unit}", [place], least=26.0, **CALLOUT)
    return figure


def contact_lines(run, axes, cut):
    """Draws the lines of the contact surfaces. \\return handles for the legend"""
    segments, closed = [np.zeros((0, 2, 2))], [np.zeros(0, dtype=bool)]
    for surface in contact_surfaces(run):
        own, crossed = cut.lines(surface.points, surface.triangles)
        segments.append(own)
        closed.append(surface.active[surface.triangles[crossed]].mean(axis=1) >= 0.5)
    segments, closed = np.concatenate(segments), np.concatenate(closed)
    handles = []
    for mask, colour, words in ((~closed, OPEN, "contact, open"), (closed, CLOSED, "contact, closed")):
        if mask.any():
            for wide, shade in ((3.4, "black"), (2.0, colour)):
                axes.add_collection(LineCollection(segments[mask], colors=shade, linewidths=wide, capstyle="round", zorder=5))
            handles.append(Line2D([], [], color=colour, lw=2.0, label=words, path_effects=[withStroke(linewidth=3.4, foreground="black")]))
    return handles
