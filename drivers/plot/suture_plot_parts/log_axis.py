"""Numbers at logarithmic axes."""
from matplotlib.ticker import FormatStrFormatter, FuncFormatter, LogLocator, MaxNLocator, NullFormatter


def logarithmic_ticks(axis, low, high, text=None):
    """Numbers on a logarithmic axis from `low` to `high`, even if it spans less than two powers of ten.

    \\param text  text of a number; default: that of matplotlib, or %g where the axis is short
    """
    axis.set_minor_formatter(NullFormatter())
    if high < 100 * low:
        subs = (1, 2, 5) if high >= 20 * low else (1, 2, 3, 5)
        axis.set_major_locator(LogLocator(subs=subs) if high > 3 * low else MaxNLocator(nbins=5))
        axis.set_major_formatter(FormatStrFormatter("%g"))
    if text is not None:
        axis.set_major_formatter(FuncFormatter(lambda value, _: text(value)))
