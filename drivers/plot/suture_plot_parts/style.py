"""Colours, lines and the shape of figures, common to all plots."""
from io import BytesIO

from . import quick_start  # noqa: F401  before the other modules of matplotlib

import matplotlib
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.patheffects import withStroke
from matplotlib.transforms import Bbox

from .png import write_png

# Okabe and Ito's palette, suitable for colour-blind readers.
PALETTE = ["#E69F00", "#56B4E9", "#009E73", "#F0E442", "#0072B2", "#D55E00", "#CC79A7", "#000000"]
# Colours for names of lines, all dark enough on white and on pale colours.
LINES = ["#0072B2", "#D55E00", "#8F3F73", "#00694D", "#8A7A00", "#2E86B8"]
TENSION, COMPRESSION = "#C1272D", "#0B4F9E"
LOAD, SUPPORT = "#C2410C", "#00694D"
PRESSURE_COLOUR, GAP_COLOUR = "#0072B2", "#D55E00"
GREY = "#9a9a9a"
MARGIN = 0.08  # inches around the content of a picture
MOST_EDGES = 40000  # with more cells, the edges would merge into a black area
WIDEST, HIGHEST = 10.0, 8.0  # inches

matplotlib.rcParams.update({
    "figure.dpi": 100, "savefig.dpi": 170, "font.size": 9, "axes.titlesize": 10, "axes.linewidth": 0.6, "axes.spines.top": False,
    "axes.spines.right": False, "lines.linewidth": 1.2, "legend.frameon": False, "xtick.direction": "out", "ytick.direction": "out",
    "axes.formatter.limits": (-4, 5), "axes.formatter.useoffset": False
})


class PlotError(Exception):
    """An error that the user can fix, such as a missing or damaged file."""


def new_figure(width, height, **more):
    """A figure in inches, drawn by Agg. pyplot, which would keep it until it is closed, is not needed."""
    figure = Figure(figsize=(width, height), **more)
    FigureCanvasAgg(figure)
    return figure


def headline(figure, text):
    """A title above all panels; more lines lie above the figure."""
    figure.suptitle(text, fontsize=10, x=0.01, y=1 - 0.26 / figure.get_figheight(), ha="left", va="bottom")


def with_panels(rows, columns, size, **more):
    """Figure of a size in inches with rows and columns of panels at fixed places: (figure, axes). \\param more  of Figure.subplots()

    Each panel has the same space for its title, tick labels and axis labels; panels that share their x axis are closer.
    """
    figure = new_figure(*size)
    width, height = size
    above, below, left, right = 0.32, 0.2 if more.get("sharex") else 0.5, 0.78, 0.12
    last = 0.3 if more.get("sharex") else 0.0  # the only tick labels
    across, down = (width - 0.1) / columns, (height - 0.35 - last) / rows
    keywords = {"left": (left + 0.05) / width, "right": 1 - (right + 0.05) / width, "top": 1 - (0.3 + above) / height, "bottom": (below + last + 0.05) / height,
                "wspace": (left + right) / (across - left - right), "hspace": (above + below) / (down - above - below)}
    more["gridspec_kw"] = {**more.get("gridspec_kw", {}), **keywords}
    return figure, figure.subplots(rows, columns, **more)


def canvas(points, title, unit, extra=0.0, room=0.03, names=("x", "y"), most=(WIDEST, HIGHEST)):
    """Figure with equal scales in the shape of the region that contains `points`. Its layout is fixed.

    \\param extra  inches beside the axes, for a colour bar
    \\param room   margin, as a fraction of the region's larger extent: on all sides, or (left and right, above and below)
    \\param most   largest width of the figure and height of its axes, in inches
    """
    low, high = points.min(axis=0)[:2], points.max(axis=0)[:2]
    margin = np.array(room if isinstance(room, tuple) else (room, room)) * max((high - low).max(), 1e-300)
    low, high = low - margin, high + margin
    aspect = (high[1] - low[1]) / (high[0] - low[0])
    width = most[0] - extra - 1.0
    if width * aspect > most[1]:
        width = max(most[1] / aspect, 2.5)
    height = min(width * aspect, most[1])
    figure = new_figure(width + extra + 1.0, height + 1.1)
    axes = figure.add_axes([0.8 / (width + extra + 1.0), 0.6 / (height + 1.1), width / (width + extra + 1.0), height / (height + 1.1)])
    axes.set_aspect("equal")
    axes.set_xlim(low[0], high[0])
    axes.set_ylim(low[1], high[1])
    axes.locator_params(axis="x", nbins=max(3, min(9, int(width / 0.8))))
    axes.locator_params(axis="y", nbins=max(3, min(9, int(height / 0.45))))
    axes.set_xlabel(f"{names[0]} [{unit}]")
    axes.set_ylabel(f"{names[1]} [{unit}]")
    axes.set_title(fitted(figure, title, min(width, height / aspect)), loc="left", y=1.0)
    return figure, axes


def box_in_pixels(axes):
    """(width, height) of the axes in a saved picture."""
    figure, place = axes.figure, axes.get_position()
    return matplotlib.rcParams["savefig.dpi"] * np.array([place.width * figure.get_figwidth(), place.height * figure.get_figheight()])


def colour_bar(axes, colours, label, height=0.8, **more):
    """A colour bar beside the axes, in the middle of their height."""
    inches = box_in_pixels(axes) / matplotlib.rcParams["savefig.dpi"]
    place = [1.0 + 0.16 / inches[0], 0.5 - 0.5 * height, 0.16 / inches[0], height]
    bar = axes.figure.colorbar(colours, cax=axes.inset_axes(place), **more)
    bar.set_label(label)
    bar.outline.set_linewidth(0.4)
    return bar


def fitted(figure, text, inches):
    """The text of a title, with line breaks between words, so that no line is too wide."""
    renderer = figure.canvas.get_renderer()
    font = FontProperties(size=matplotlib.rcParams["axes.titlesize"])
    lines = []
    for word in text.split():
        longer = f"{lines[-1]} {word}" if lines else word
        if lines and renderer.get_text_width_height_descent(longer, font, False)[0] <= inches * figure.dpi:
            lines[-1] = longer
        else:
            lines.append(word)
    # Words longer than a line are broken by their number of characters.
    return "\n".join(part for line in lines for part in wrapped(line, max(int(11 * inches), len(line) if " " in line else 0)).split("\n")) or text


def wrapped(text, width):
    """The text with line breaks between words, and within words longer than a line."""
    import textwrap
    return "\n".join(textwrap.wrap(text, max(width, 20))) or text


def shortened(name, most=30):
    return name if len(name) <= most else name[:most - 10] + "\u2026" + name[-9:]


def save(figure, path):
    """Writes the picture in full colour, cut to its content."""
    dpi = matplotlib.rcParams["savefig.dpi"]
    image = rendered(figure)
    (top, bottom), (left, right) = content(image)
    return write_png(path, image[top:bottom, left:right, :3], dpi)


def rendered(figure):
    """The picture with the titles and legends outside of the figure: rows x columns x 4 bytes, in the resolution of saved pictures."""
    if figure.get_layout_engine() is not None:
        figure.draw_without_rendering()
        figure.set_layout_engine("none")
    dpi = matplotlib.rcParams["savefig.dpi"]
    figure.set_dpi(dpi)
    box = reach(figure)
    region = Bbox(np.array([np.floor(box.min - 4), np.ceil(box.max + 4)]) / dpi)
    columns, rows = np.round(region.size * dpi).astype(int)
    raw = BytesIO()
    figure.savefig(raw, format="rgba", dpi=dpi, bbox_inches=Bbox.from_bounds(*region.min, *((np.array([columns, rows]) + 0.01) / dpi)))
    return np.frombuffer(raw.getbuffer(), dtype=np.uint8).reshape(rows, columns, 4)


def content(image):
    """((top, bottom), (left, right)) of the part of a picture that is not white, with a margin."""
    drawn = image.view(np.uint32)[:, :, 0] != 0xFFFFFFFF
    return [edges(drawn.any(axis=axis), MARGIN * matplotlib.rcParams["savefig.dpi"]) for axis in (1, 0)]


def reach(figure):
    """The box that contains the figure, and all legends and titles outside of it, in pixels."""
    renderer = figure.canvas.get_renderer()
    outside = [figure.legends, [figure._suptitle], *([axes.get_legend(), axes._left_title, *axes.texts] for axes in figure.axes)]
    boxes = [artist.get_window_extent(renderer) for artists in outside for artist in artists if artist is not None and artist.get_visible()]
    return Bbox.union([figure.bbox, *(box for box in boxes if np.isfinite(box.extents).all() and box.width > 0)])


def edges(used, margin):
    """(first, end) of the part of a row that is used, with a margin."""
    where = np.flatnonzero(used)
    first, end = (where[0], where[-1] + 1) if len(where) else (0, len(used))
    return max(int(first - margin), 0), min(int(end + margin), len(used))


def pale(colour):
    return 0.45 * np.array(matplotlib.colors.to_rgb(colour)) + 0.55


def halo():
    return [withStroke(linewidth=2.2, foreground="white")]
