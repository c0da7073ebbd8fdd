"""One plot of a run, with its caption in the report."""
from dataclasses import dataclass
from pathlib import Path
from typing import Any


@dataclass
class Picture:
    name: str  # of its file, without .png
    section: str  # of the report
    caption: str
    figure: Any = None
    path: Path = None


def note_on(left_out):
    """A sentence on names that a plot does not show."""
    if not left_out:
        return ""
    names = ", ".join(left_out[:12]) + (f" and {len(left_out) - 12} more" if len(left_out) > 12 else "")
    return f" Not labelled for lack of space: {names}."
