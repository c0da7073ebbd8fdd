"""What the conversion of a deck reports: errors, and cards that are not, or differently, part of the scene."""
import difflib
from typing import NamedTuple

from ..foreign import ConvertError

MOST_NAMES = 12  # names listed in a message


class Place(NamedTuple):
    """A line of a file."""
    file: object
    line: int


def nearest(name, known):
    """A sentence with the nearest known name and the known names."""
    known = sorted(set(known))
    folded = {other.upper(): other for other in known}
    close = difflib.get_close_matches(name.upper(), folded, 1)
    shown = ", ".join(known[:MOST_NAMES]) + (f" and {len(known) - MOST_NAMES} more" if len(known) > MOST_NAMES else "")
    return (f". Did you mean '{folded[close[0]]}'?" if close else ".") + f" Known here: {shown or 'none'}"


class Findings:
    """
    errors   they stop the conversion, all together
    left     cards, options and elements that are not in the scene although they change its answer
    changed  cards that the scene represents differently
    aside    cards without influence on the answer: output requests, controls of solvers
    All are lists of (place, text).
    """

    def __init__(self, path):
        self.path = path
        self.errors, self.left, self.changed, self.aside = [], [], [], []
        self._known = set()

    def error(self, place, text):
        self._add(self.errors, place, text)

    def leave(self, place, text):
        self._add(self.left, place, text)

    def change(self, place, text):
        self._add(self.changed, place, text)

    def put_aside(self, place, text):
        self._add(self.aside, place, text)

    def _add(self, some, place, text):
        if (id(some), place, text) not in self._known:
            self._known.add((id(some), place, text))
            some.append((place, text))

    def spot(self, place):
        """'line 3', or with its file if that is an included one"""
        if place is None:
            return ""
        return f"line {place.line}" if place.file == self.path else f"{place.file.name}, line {place.line}"

    def stop(self):
        """\\throws ConvertError  if there are errors: all of them"""
        if len(self.errors) == 1:
            place, text = self.errors[0]
            raise ConvertError(f"{place.file}, line {place.line}: {text}" if place else f"{self.path}: {text}")
        if self.errors:
            lines = [f"  {self.spot(place)}: {text}" if place else f"  {text}" for place, text in self._sorted(self.errors)]
            raise ConvertError(f"{len(self.errors)} errors in {self.path}\n" + "\n".join(lines))

    def _sorted(self, some):
        return sorted(some, key=lambda one: (one[0] is not None and one[0].file != self.path, one[0].line if one[0] else 0))

    def texts(self, some):
        """Lines '<place>: <text>', sorted; equal texts share a line."""
        places = {}
        for place, text in self._sorted(some):
            places.setdefault(text, []).append(self.spot(place))
        lines = []
        for text, spots in places.items():
            spots = [spot for spot in dict.fromkeys(spots) if spot]
            plain = [spot[5:] for spot in spots if spot.startswith("line ")]
            if len(spots) > 1 and len(plain) == len(spots):
                spots = ["lines " + ", ".join(plain[:8]) + (f" and {len(plain) - 8} more" if len(plain) > 8 else "")]
            lines.append(f"{'; '.join(spots)}: {text}" if spots else text)
        return lines
