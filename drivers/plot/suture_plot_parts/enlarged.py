"""The enlargement of displacements: no gap or hole closes in a picture, and no bodies overlap, unless they do so in the solution."""
import numpy as np

from .units import round_down

RAYS = 200  # parallel lines across the bodies, in each direction
TOUCHING = 0.002  # fraction of the model size: gaps below are not seen, and overlaps up to it are allowed
OPEN = 0.2  # fraction of a gap that stays open


def enlargement(run, factor, gaps):
    """(factor, whether gaps limit it): the enlargement given by the user, else by the scene, else such that the largest displacement is
    about a twentieth of the model size, but at most what the gaps allow. Bodies that move far are drawn where they are.

    \\param gaps  returns (widths, changes of width) of gaps between walls, by the displacements as they are
    """
    if factor is None:
        given = run.parameter("Output", "Enlargement", default="Automatic")
        try:
            factor = float(given)
        except (TypeError, ValueError):
            if run.moving:
                return 1.0, False  # where the bodies are
            return automatic(run, gaps)
    return factor, False


def automatic(run, gaps):
    norm = np.linalg.norm(run.fields.point_data["Displacement"], axis=1).max(initial=0.0)
    size = np.linalg.norm(np.ptp(run.fields.points, axis=0))
    if not (norm > 0 and np.isfinite(norm)):
        return 1.0, False
    wanted = round_down(0.05 * size / norm)
    if wanted <= 1.0:
        return wanted, False  # displacements are large, and reduced
    allowed = limit(*gaps(), TOUCHING * size)
    return (wanted, False) if wanted <= allowed else (max(round_down(allowed), 1.0), True)


def limit(width, change, slack):
    """The largest factor at which no gap closes. A gap that the solution closes, or that is too small to be seen, may overlap by `slack`."""
    seen = (width > slack) & (width + change > slack)
    left = np.where(seen, OPEN * width, -slack)
    closes = change < 0
    factors = (width[closes] - left[closes]) / -change[closes]
    # A gap that the solution itself narrows further is drawn as it is.
    return max(factors.min(initial=np.inf), 1.0)


def between_hits(line, place, leaves, moved):
    """Gaps along parallel lines, from their hits with the outsides of bodies: (widths, changes of width).

    \\param line    number of the line of each hit  \\param place  position along it  \\param leaves  whether the line leaves a body there
    \\param moved   displacement along the line
    """
    order = np.lexsort((leaves, place, line))
    line, place, leaves, moved = line[order], place[order], leaves[order], moved[order]
    gap = (line[1:] == line[:-1]) & leaves[:-1] & ~leaves[1:]
    return np.diff(place)[gap], np.diff(moved)[gap]


def gaps_of_outline(starts, ends, start_moves, end_moves, body_left):
    """Gaps of a 2D outline, along horizontal and vertical lines. `body_left`: the body is on the left of all edges."""
    widths, changes = [np.zeros(0)], [np.zeros(0)]
    low, high = np.minimum(starts, ends).min(axis=0), np.maximum(starts, ends).max(axis=0)
    for axis in (0, 1):
        other = 1 - axis
        spacing = max(high[other] - low[other], 1e-300) / RAYS
        # Lines at (k + 0.5) spacing.
        a, b = (starts[:, other] - low[other]) / spacing - 0.5, (ends[:, other] - low[other]) / spacing - 0.5
        first, count = np.ceil(np.minimum(a, b)).astype(int), np.ceil(np.maximum(a, b)).astype(int) - np.ceil(np.minimum(a, b)).astype(int)
        edge = np.repeat(np.arange(len(a)), count)
        line = first[edge] + np.arange(len(edge)) - np.repeat(np.cumsum(count) - count, count)
        t = (line - a[edge]) / (b - a)[edge]
        place = (1 - t) * starts[edge, axis] + t * ends[edge, axis]
        moved = (1 - t) * start_moves[edge, axis] + t * end_moves[edge, axis]
        upward = (b > a)[edge] == body_left
        leaves = upward if axis == 0 else ~upward
        found = between_hits(line, place, leaves, moved)
        widths.append(found[0])
        changes.append(found[1])
    return np.concatenate(widths), np.concatenate(changes)
