"""contact.png, contact_2.png, ...: pressure and gap along each contact line; with friction also the tangential traction."""
import math

import numpy as np

from .friction import draw_friction, friction_legend, has_friction
from .line_panel import curve
from .style import GAP_COLOUR, PRESSURE_COLOUR, headline, shortened, with_panels, wrapped
from .units import scaled

FEW = 6  # lines on one page of large panels; more lines are distributed over pages of small panels
MOST = 12


def contact_figures(run):
    """Yields the pages: (words on its part, figure)."""
    data = run.contact.point_data
    lines = sorted(set(zip(data["Piece"].tolist(), data["Line"].tolist())))
    pages = 1 if len(lines) <= FEW else math.ceil(len(lines) / MOST)
    each = math.ceil(len(lines) / pages)
    for page in range(pages):
        words = "" if pages == 1 else f" Lines {page * each + 1} to {min((page + 1) * each, len(lines))} of {len(lines)}."
        yield words, contact_figure(run, lines[page * each:(page + 1) * each], len(lines) > FEW, f", part {page + 1} of {pages}" if pages > 1 else "")


def contact_figure(run, lines, small, part):
    grid, data = run.contact, run.contact.point_data
    names = list(run.parameter("Contact", default={}))
    pressure_factor, pressure_unit = scaled(grid.units["ContactPressure"], np.nanmax(np.abs(data["ContactPressure"])))
    gap_factor, gap_unit = scaled(grid.units["Gap"], max(np.nanmax(np.abs(data["Gap"])), 1e-12))
    columns = min(len(lines), 4 if small else 3)
    rows = math.ceil(len(lines) / columns)
    rubs = has_friction(grid)
    panels = 3 if rubs else 2
    width, height = (max(2.9 * columns, 6.5), 1.55 * panels * rows) if small else (max(3.6 * columns, 6.5), 2.1 * panels * rows)
    figure, axes = with_panels(panels * rows, columns, (width, height + 0.5), squeeze=False)
    headline(figure, wrapped(f"{run.title}: contact lines{part}; filled: closed, hollow on grey: open{run.state}", int(13 * width)))
    for extra in range(len(lines), rows * columns):
        for k in range(panels):
            axes[panels * (extra // columns) + k][extra % columns].set_visible(False)
    for number, (piece, line) in enumerate(lines):
        row, column = divmod(number, columns)
        above, below = axes[panels * row][column], axes[panels * row + panels - 1][column]
        own = np.flatnonzero((data["Piece"] == piece) & (data["Line"] == line))
        own = own[np.argsort(data["ArcLength"][own], kind="stable")]
        arc, active = data["ArcLength"][own], data["Active"][own].astype(bool)
        pressure, gap, initial = (data[name][own] for name in ("ContactPressure", "Gap", "InitialGap"))
        name = names[int(line)] if 0 <= line < len(names) else f"line {line:g}"
        pairs = f"{len(own)} pair{'s' if len(own) != 1 else ''}, {np.count_nonzero(~active)} open"
        above.set_title(f"{shortened(name, 20 if small else 26 if columns > 1 else 60)}: {pairs}", loc="left", fontsize=8 if small else 9, y=1.0)
        for axis, values, factor, colour in ((above, pressure, pressure_factor, PRESSURE_COLOUR), (below, gap, gap_factor, GAP_COLOUR)):
            curve(axis, arc, factor * values, active, colour, small)
        if rubs:
            draw_friction(axes[panels * row + 1][column], grid, own, small, not small or column == 0)
        if np.nanmax(np.abs(initial), initial=0.0) > 1e-9 * max(arc.max(), 1e-300):
            below.plot(arc, gap_factor * initial, ls="--", lw=0.9, color="#555555", label="initial gap")
            if not small or number == 0:
                below.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), borderaxespad=0.0, fontsize=8)
        if not small or number + columns >= len(lines):
            below.set_xlabel(f"arc length [{grid.units['ArcLength']}]")
        if not small or column == 0:
            above.set_ylabel(f"pressure [{pressure_unit}]")
            below.set_ylabel(f"gap [{gap_unit}]")
    if rubs:
        friction_legend(figure)
    return figure
