"""contact.png, contact_2.png, ...: pressure and gap on each contact surface; with friction also the tangential traction."""
import matplotlib
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection
from matplotlib.colors import LinearSegmentedColormap, Normalize
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.patheffects import withStroke
from matplotlib.ticker import MaxNLocator

from ..friction import TRACTION_COLOUR
from ..samples import show
from ..style import GAP_COLOUR, PRESSURE_COLOUR, headline, new_figure, shortened, wrapped
from ..units import scaled
from . import level
from .contact_surface import Chart, contact_surfaces
from .image import coloured, picture
from .page import bare
from .raster import Raster
from .ruler import axes_and_scale_beside

PRESSURES = LinearSegmentedColormap.from_list("pressure", ["#dcebf5", "#7fb6dc", PRESSURE_COLOUR, "#00283f"])
GAPS = LinearSegmentedColormap.from_list("gap", ["#fdeadf", "#f0a777", GAP_COLOUR, "#5e2a00"])
TRACTIONS = LinearSegmentedColormap.from_list("traction", ["#f3e3ef", "#cf93bd", TRACTION_COLOUR, "#3d1231"])
USED = LinearSegmentedColormap.from_list("used", ["#e3f1ea", "#8cc9ab", "#00694D", "#D55E00"])
PLAIN, STRIPE = np.array([0.93, 0.93, 0.93]), np.array([0.72, 0.72, 0.72])
WIDTH = 10.0  # inches
HIGHEST = 9.8  # inches of all panels of a page
LEFT, ABOVE = 0.75, 0.42  # inches beside and above a panel
BETWEEN = 0.35  # inches between panels side by side
FLAT = 0.4  # ratio of height to width below which both panels have the full width


class Panels:
    """A contact with its chart, and the size of its panels in inches."""

    def __init__(self, surface):
        self.surface, self.chart = surface, Chart(surface)
        self.low, self.high = (limit(self.chart.flat.reshape(-1, 2), axis=0) for limit in (np.min, np.max))
        margin = 0.03 * max((self.high - self.low).max(), 1e-300)
        self.low, self.high = self.low - margin, self.high + margin
        aspect = (self.high - self.low)[1] / (self.high - self.low)[0]
        self.stacked = aspect < FLAT
        wide = 0.68 * WIDTH if self.stacked else 0.5 * WIDTH - 1.5
        strip = 0.45 if self.chart.names else 0.8  # tick and axis labels, or axes and scale
        self.panel = min(wide * aspect, 3.6)  # inches of the picture
        self.width = self.panel / aspect
        self.rows = (2 if self.stacked else 1) * (2 if surface.rubs else 1)
        self.height = self.rows * (self.panel + strip + 0.45)


def contact_figures(run):
    """Yields the pages: (words on its part, figure)."""
    pages, room = [], 0.0
    for panels in map(Panels, contact_surfaces(run)):
        if not pages or room + panels.height > HIGHEST:
            pages.append([])
            room = 0.0
        pages[-1].append(panels)
        room += panels.height
    total, start = sum(map(len, pages)), 0
    for number, page in enumerate(pages):
        words = "" if len(pages) == 1 else f" Contacts {start + 1} to {start + len(page)} of {total}."
        start += len(page)
        yield words, contact_figure(run, page, f", part {number + 1} of {len(pages)}" if len(pages) > 1 else "")


def contact_figure(run, page, part):
    height = sum(panels.height for panels in page) + 0.5
    figure = new_figure(WIDTH + BETWEEN, height)
    headline(figure, wrapped(f"{run.title}: contact surfaces{part}{run.state}", 130))
    top = height - 0.5
    for panels in page:
        each = 1 if panels.stacked else 2  # panels side by side
        axes = []
        for k in range(panels.rows * each):
            row, column = divmod(k, each)
            place = [LEFT + column * (0.5 * WIDTH + BETWEEN), top - row * panels.height / panels.rows - ABOVE - panels.panel, panels.width, panels.panel]
            axes.append(figure.add_axes(np.array(place) / [WIDTH + BETWEEN, height, WIDTH + BETWEEN, height]))
        top -= panels.height
        draw(run, panels, axes)
    handles = [Patch(facecolor=PLAIN, edgecolor=STRIPE, hatch="////", lw=0, label="open: no pressure"),
               Patch(facecolor=PLAIN, lw=0, label="closed: no gap"),
               Line2D([], [], color="black", lw=1.4, label="edge of the closed area")]
    if any(panels.surface.rubs for panels in page):
        handles.append(Line2D([], [], color="white", lw=1.1, path_effects=[withStroke(linewidth=2.4, foreground="black")], label="edge of the sticking area"))
    figure.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, 0.0), ncols=len(handles))
    return figure


def draw(run, panels, axes):
    surface, order = panels.surface, anticlockwise(panels.chart.flat)
    raster = raster_for(panels, order)
    own = np.take_along_axis(surface.triangles, order, axis=1)
    closed = raster.interpolate(surface.active[own]) >= 0.5
    pairs_closed = surface.active[:surface.pairs] >= 0.5
    panel(run, panels, axes[0], raster, (surface.pressure, own, pairs_closed), closed, PRESSURES,
          ("pressure", run.contact.units["ContactPressure"], shortened(surface.name, 40), True))
    panel(run, panels, axes[1], raster, (surface.gap, own, ~pairs_closed), ~closed, GAPS,
          ("gap", run.contact.units["Gap"], f"{surface.open} of {surface.pairs} pairs open", False))
    if not surface.rubs:
        return
    panel(run, panels, axes[2], raster, (surface.tangential, own, pairs_closed), closed, TRACTIONS,
          ("tangential traction", run.contact.units["TangentialTraction"], f"{surface.sticking} stick, {surface.slipping} slip", True))
    panel(run, panels, axes[3], raster, (surface.used, own, pairs_closed), closed, USED, ("traction over its bound", "", "friction mobilised", True),
          surface.bounded)
    for each in axes[2:]:
        for colour, width in (("black", 2.4), ("white", 1.1)):
            border_between(each, panels, surface.sticks, colors=colour, linewidths=width, capstyle="round")


def panel(run, panels, axes, raster, of, coloured_part, colours, words, weight=None):
    """One quantity on the surface. \\param of  values, corners of the triangles, pairs whose largest value limits the colour scale

    \\param weight  zero for pairs without a value, which do not take part in the interpolation; default: all take part
    """
    (values, own, pairs), (name, unit, above, striped) = of, words
    top = max(np.nanmax(values[:panels.surface.pairs][pairs], initial=0.0), 0.0)
    factor, unit = scaled(unit, top)
    shown = raster.interpolate(factor * values[own]) if weight is None else among_valued(raster, factor * values, weight, own)
    found = coloured(shown, 0.0, factor * top or 1.0, colours)
    found[~coloured_part] = ground(raster, ~coloured_part, striped)
    axes.set(xlim=(panels.low[0], panels.high[0]), ylim=(panels.low[1], panels.high[1]), aspect="equal")
    axes.set_title(f"{above}\n{name}, " + (f"largest {factor * top:.4g} {unit}".rstrip() if top else "none"), loc="left", fontsize=9, y=1.0)
    show(axes, picture(raster, found))
    lines(axes, panels)
    ruled(axes, panels.chart, run.length_unit)
    if top:
        bar(panels, axes, ScalarMappable(Normalize(0.0, factor * top), colours), (f"{name} [{unit}]" if panels.panel > 1.2 else f"[{unit}]") if unit else "")


def among_valued(raster, values, weight, own):
    """The values at the samples, interpolated between the corners that have one."""
    share = raster.interpolate(weight[own])
    found = raster.interpolate((np.nan_to_num(values) * weight)[own]) / np.maximum(share, 1e-12)
    return np.where(share > 1e-6, found, np.nan)


def bar(panels, axes, colours, label):
    """Colour bar with the height of the plot next to it."""
    drawn = axes.figure.colorbar(colours, cax=axes.inset_axes([1.0 + 0.12 / panels.width, 0.0, 0.14 / panels.width, 1.0]), format="%.4g")
    drawn.locator = MaxNLocator(nbins=max(2, min(6, int(2 * panels.panel))))
    drawn.update_ticks()
    drawn.set_label(label)
    drawn.outline.set_linewidth(0.4)


def raster_for(panels, order):
    """The chart's triangles, rendered with hidden surfaces removed."""
    columns = round(matplotlib.rcParams["savefig.dpi"] * panels.width)
    raster = Raster(panels.low, panels.high, (max(1, round(matplotlib.rcParams["savefig.dpi"] * panels.panel)), columns))
    corners = np.take_along_axis(panels.chart.flat, order[:, :, None], axis=1).reshape(-1, 2)
    raster.draw(corners, np.take_along_axis(panels.chart.near, order, axis=1).reshape(-1), np.arange(len(corners)).reshape(-1, 3))
    return raster


def ground(raster, some, striped):
    """Grey at some of the samples, with diagonal stripes where pairs are open."""
    row, column = np.divmod(raster.samples[some], raster.shape[1])
    return np.where((striped & ((row + column) % 9 < 2))[:, None], STRIPE, PLAIN)


def anticlockwise(flat):
    """Corner order that makes each triangle anticlockwise."""
    turned = np.cross(flat[:, 1] - flat[:, 0], flat[:, 2] - flat[:, 0]) < 0
    return np.where(turned[:, None], [0, 2, 1], [0, 1, 2])


def lines(axes, panels):
    """The border of the surface, and of its closed area."""
    surface, flat = panels.surface, panels.chart.flat
    triangle, side = surface.border()
    border = np.stack([flat[triangle, side], flat[triangle, (side + 1) % 3]], axis=1)
    axes.add_collection(LineCollection(border, colors="#555555", linewidths=0.6, zorder=4))
    border_between(axes, panels, surface.active, colors="black", linewidths=1.4, capstyle="round")


def border_between(axes, panels, share, **style):
    """The line half way between pairs with `share` 1 and pairs with `share` 0."""
    corners = panels.chart.flat.reshape(-1, 2)
    between, _ = level.lines(corners, np.arange(len(corners)).reshape(-1, 3), share[panels.surface.triangles].reshape(-1), 0.5)
    axes.add_collection(LineCollection(between, zorder=5, **style))


def ruled(axes, chart, unit):
    if chart.names:
        axes.set(xlabel=f"{chart.names[0]} [{unit}]{chart.words}", ylabel=f"{chart.names[1]} [{unit}]")
        axes.locator_params(nbins=5)
    else:
        bare(axes)
        axes_and_scale_beside(axes.figure, axes, chart.view, unit)
