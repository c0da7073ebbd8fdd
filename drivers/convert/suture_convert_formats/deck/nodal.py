"""Data lines of *BOUNDARY and *CLOAD: nodes, degrees of freedom, values."""
from .cards import numbers_in

NAMED = {"ENCASTRE": (1, 2, 3, 4, 5, 6), "PINNED": (1, 2, 3), "XSYMM": (1, 5, 6), "YSYMM": (2, 4, 6), "ZSYMM": (3, 4, 5),
         "XASYMM": (2, 3, 4), "YASYMM": (1, 3, 5), "ZASYMM": (1, 2, 6)}


class Source:
    """Where the values at a node come from: the set that a card names, or the card if it gives labels"""

    def __init__(self, name, place):
        self.name, self.place = name, place


class NodalCards:
    """Expands cards to ((node key, degree of freedom), value, place); `source` has the Source of each key."""

    def __init__(self, sets, findings):
        self.sets, self.findings, self.source, self.sources = sets, findings, {}, {}

    def boundary(self, card):
        if card.option("TYPE", "DISPLACEMENT") != "DISPLACEMENT":
            self.findings.leave(card.place, f"{card.title}, TYPE={card.options['TYPE']}")
            return
        for place, words in card.rows:
            if len(words) > 1 and words[1].upper() in NAMED:
                yield from self._at(card, words[0], NAMED[words[1].upper()], 0.0, place)
                continue
            if len(words) < 2 or not words[1].isdigit():
                self.findings.error(place, f"{card.title}: expected a node or set and a degree of freedom 1 to 6 or {', '.join(NAMED)}, found "
                                           f"'{', '.join(words)}'")
                continue
            numbers = numbers_in(words[1:4], place, self.findings)
            last = numbers[1] if len(numbers) > 1 and numbers[1] is not None else numbers[0]
            value = numbers[2] if len(numbers) > 2 and numbers[2] is not None else 0.0
            dofs = range(int(numbers[0]), int(last) + 1)
            if any(dof > 6 for dof in dofs):
                self.findings.leave(place, f"{card.title}: degree of freedom {max(dofs)}")
            yield from self._at(card, words[0], [dof for dof in dofs if dof <= 6], value, place)

    def force(self, card):
        for place, words in card.rows:
            numbers = numbers_in(words[1:3], place, self.findings)
            if len(numbers) < 2 or None in numbers:
                self.findings.error(place, f"{card.title}: expected a node or set, a direction and a force, found '{', '.join(words)}'")
                continue
            yield from self._at(card, words[0], [int(numbers[0])], numbers[1], place)

    def _at(self, card, word, dofs, value, place):
        key = self.sets.key_of("NSET", word, card.scope) if self.sets.labelled(word, card.scope) is None else None
        name = self.sets.title(key) if key else f"{card.title[1:].lower()} of line {card.place.line}"
        source = self.sources.setdefault(name, Source(name, place))
        for node in self.sets.members("NSET", word, card.scope, place):
            for dof in dofs:
                self.source[node, dof] = source
                yield (node, dof), value, place
