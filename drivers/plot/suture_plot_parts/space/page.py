"""A page with 3D bodies: image, visible lines, axes, scale, colours."""
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection
from matplotlib.colors import Normalize
from matplotlib.transforms import ScaledTranslation

from ..labels import LabelPlacer
from ..stresses import CALLOUT
from ..samples import Samples, show
from ..style import box_in_pixels, canvas, colour_bar, fitted
from .image import brightness, coloured, picture
from .raster import Raster, visible_parts
from .ruler import axes_and_scale
from .surface import normals

BESIDE = 0.9  # inches beside the plot, for the colour bar
BELOW = 0.85  # inches below the plot, for axes and scale


class Seen:
    """Visibility of triangles in a view, seen from outside; shared by all plots of the same bodies in the same frame."""

    def __init__(self, view, points, triangles, raster):
        self.view, self.points, self.triangles, self.raster = view, points, triangles, raster
        raster.draw(view.flat(points), view.nearness(points), triangles)
        self.light = raster.interpolate(brightness(view, points, triangles, normals(points, triangles)))
        self.slack = 2.0 / raster.scale[0]  # points closer to a surface lie on it

    def hides(self, point):
        return bool(self.raster.hidden(self.view.flat(point[None]), self.view.nearness(point[None]), self.slack)[0])

    def parts(self, points, edges):
        """The visible parts of the edges, as 2D segments."""
        place = np.column_stack([self.view.flat(points), self.view.nearness(points)])
        return visible_parts(self.raster, place[edges[:, 0]], place[edges[:, 1]], self.slack)


class Page:
    """Figure with the plot of a view. `reach`: points that the frame must contain; `more`: of canvas()"""

    def __init__(self, run, view, reach, title, room=0.05, **more):
        self.view = view
        self.figure, self.axes = canvas(view.flat(reach), title, run.length_unit, extra=BESIDE, room=room, **more)
        bare(self.axes)
        axes_and_scale(self.figure, self.axes, view, run.length_unit)

    def retitle(self, title):
        self.axes.set_title(fitted(self.figure, title, self.figure.get_figwidth() - BESIDE - 1.0), loc="left", y=1.0)

    def draw(self, seen):
        """Draws the bodies; `seen` belongs to this page's frame."""
        self.seen = seen

    def colour(self, colours):
        """`colours`: red, green, blue per triangle."""
        show(self.axes, picture(self.seen.raster, colours[self.seen.raster.shown], self.seen.light))

    def colour_by(self, values, low, high, colours, label):
        """Colours by values, with a colour bar. `values`: at the points, or per triangle."""
        self.paint(values, low, high, colours)
        self.bar(low, high, colours, label)

    def paint(self, values, low, high, colours):
        seen = self.seen
        found = seen.raster.interpolate(values[seen.triangles]) if len(values) == len(seen.points) else values[seen.raster.shown]
        show(self.axes, picture(seen.raster, coloured(found, low, high, colours), seen.light))

    def bar(self, low, high, colours, label):
        colour_bar(self.axes, ScalarMappable(Normalize(low, high), colours), label)

    def lines(self, points, edges, **style):
        """Draws the visible parts of edges."""
        parts = self.seen.parts(points, edges)
        self.axes.add_collection(LineCollection(parts, **{"colors": "black", "linewidths": 0.8, "capstyle": "round", "zorder": 4, **style}))
        return parts

    def placer(self, *lines):
        """A placer of labels: outside the bodies if there is space, not on `lines`."""
        placer = placer_on(self.figure, self.axes, self.seen.raster)
        for segments in lines:
            placer.keep_off(segments)
        return placer

    def mark(self, placer, found):
        """Rings at 3D points, dashed if bodies hide them, with labels. `found`: [(point, label)]"""
        hidden = [self.seen.hides(place) for place, _ in found]
        for (place, _), behind in zip(found, hidden):
            ring(self.axes, placer, self.view.flat(place), behind)
        for (place, label), behind in zip(found, hidden):
            placer.place(label + ("\n(hidden, or inside)" if behind else ""), [self.view.flat(place)], least=26.0, **CALLOUT)


def placer_on(figure, axes, raster):
    """A placer of labels outside the image content, if there is space."""
    images = axes.findobj(Samples, include_self=False)
    for image in images:
        image.set_visible(False)  # saves the time to draw it
    placer = LabelPlacer(figure, axes)
    for image in images:
        image.set_visible(True)
    placer.prefer_outside(raster.places(slice(None, None, max(1, len(raster.samples) // 3000))))
    return placer


def bare(axes):
    axes.set(xticks=[], yticks=[], xlabel="", ylabel="")
    axes.set_axis_off()


def raster_of(axes):
    """Samples for the region of the axes, one per pixel of the saved page."""
    (x0, x1), (y0, y1) = axes.get_xlim(), axes.get_ylim()
    return Raster((x0, y0), (x1, y1), [max(1, round(pixels)) for pixels in box_in_pixels(axes)[::-1]])


def ring(axes, placer, place, dashed=False):
    axes.plot(*place, "o", ms=10, mfc="none", mec="white", mew=2.4, zorder=7)
    style = {"facecolors": "none", "edgecolors": "black", "linewidths": 1.1, "linestyles": (0, (2, 1.5)) if dashed else "-"}
    axes.scatter(*np.atleast_2d(place).T, s=100, zorder=8, **style)
    axes.plot(*place, "o", ms=10, mfc="none", mec="none", zorder=8, gid="marked")
    at = axes.transData.transform(place)
    angles = np.linspace(0, 2 * np.pi, 12, endpoint=False)
    around = at + 8.0 * np.column_stack([np.cos(angles), np.sin(angles)])
    placer.keep_visible(axes.transData.inverted().transform(np.vstack([around, [at]])))


def legend_below(figure, axes, handles, **more):
    axes.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, 0.0), borderaxespad=0.0,
                bbox_transform=axes.transAxes + ScaledTranslation(0, -0.65, figure.dpi_scale_trans), **{"ncol": len(handles), **more})
