"""Colours, lines and the shape of figures, common to all plots."""
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.font_manager import FontProperties
from matplotlib.patheffects import withStroke

# Okabe and Ito's palette, suitable for colour-blind readers.
PALETTE = ["#E69F00", "#56B4E9", "#009E73", "#F0E442", "#0072B2", "#D55E00", "#CC79A7", "#000000"]
# Colours for names of lines, all dark enough on white and on pale colours.
LINES = ["#0072B2", "#D55E00", "#8F3F73", "#00694D", "#8A7A00", "#2E86B8"]
TENSION, COMPRESSION = "#C1272D", "#0B4F9E"
LOAD, SUPPORT = "#C2410C", "#00694D"
PRESSURE_COLOUR, GAP_COLOUR = "#0072B2", "#D55E00"
GREY = "#9a9a9a"
MOST_EDGES = 60000  # with more cells, the edges would merge into a black area
WIDEST, HIGHEST = 10.0, 8.0  # inches

plt.rcParams.update({
    "figure.dpi": 100, "savefig.dpi": 170, "font.size": 9, "axes.titlesize": 10, "axes.linewidth": 0.6, "axes.spines.top": False,
    "axes.spines.right": False, "lines.linewidth": 1.2, "legend.frameon": False, "xtick.direction": "out", "ytick.direction": "out",
    "axes.formatter.limits": (-4, 5), "axes.formatter.useoffset": False
})


class PlotError(Exception):
    """An error that the user can fix, such as a missing or damaged file."""


def canvas(points, title, unit, extra=0.0, room=0.03, names=("x", "y")):
    """Figure with equal scales in the shape of the region that contains `points`.

    \\param extra  inches beside the axes, for a colour bar
    \\param room   margin, as a fraction of the region's larger extent: on all sides, or (left and right, above and below)
    """
    low, high = points.min(axis=0)[:2], points.max(axis=0)[:2]
    margin = np.array(room if isinstance(room, tuple) else (room, room)) * max((high - low).max(), 1e-300)
    low, high = low - margin, high + margin
    aspect = (high[1] - low[1]) / (high[0] - low[0])
    width = WIDEST - extra - 1.0
    if width * aspect > HIGHEST:
        width = max(HIGHEST / aspect, 2.5)
    height = min(max(width * aspect, 1.8), HIGHEST)
    figure, axes = plt.subplots(figsize=(width + extra + 1.0, height + 1.1), constrained_layout=True)
    axes.set_aspect("equal")
    axes.set_xlim(low[0], high[0])
    axes.set_ylim(low[1], high[1])
    axes.locator_params(axis="x", nbins=max(3, min(9, int(width / 0.8))))
    axes.locator_params(axis="y", nbins=max(3, min(9, int(height / 0.45))))
    axes.set_xlabel(f"{names[0]} [{unit}]")
    axes.set_ylabel(f"{names[1]} [{unit}]")
    axes.set_title(fitted(figure, title, min(width, height / aspect)), loc="left")
    return figure, axes


def fitted(figure, text, inches):
    """The text of a title, with line breaks between words, so that no line is too wide."""
    renderer = figure.canvas.get_renderer()
    font = FontProperties(size=plt.rcParams["axes.titlesize"])
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
    figure.savefig(path, bbox_inches="tight", pad_inches=0.08)
    plt.close(figure)
    return path


def edge_style(count, width):
    return {"edgecolors": "face", "linewidths": 0.1} if count > MOST_EDGES else {"linewidths": width}


def pale(colour):
    return 0.45 * np.array(matplotlib.colors.to_rgb(colour)) + 0.55


def halo():
    return [withStroke(linewidth=2.2, foreground="white")]
