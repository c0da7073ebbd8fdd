"""Shortens the start of matplotlib: its classes write the documentation of their properties when they are defined, for a third of the start."""
from matplotlib import artist


def _unchanged(cls):
    """The class keeps the documentation of `set` that it inherits."""


if hasattr(artist.Artist, "_update_set_signature_and_docstring"):  # not part of matplotlib's interface
    artist.Artist._update_set_signature_and_docstring = classmethod(_unchanged)
