"""Cards of Abaqus that generate nodes and elements, as *NODE and *ELEMENT cards: *NGEN, *NFILL, *NCOPY, *ELGEN, *ELCOPY; and *SYSTEM."""
import dataclasses

import numpy as np

from .cards import numbers_in
from .node_systems import LocalSystem, cartesian

GENERATORS = ("NGEN", "NFILL", "NCOPY", "ELGEN", "ELCOPY")
# Card -> options that are read; others are errors, since they change what is generated.
OPTIONS = {"NGEN": {"NSET"}, "NFILL": {"NSET"}, "NCOPY": {"CHANGENUMBER", "OLDSET", "NEWSET", "SHIFT"}, "ELGEN": {"ELSET", "ALLNODES"},
           "ELCOPY": {"OLDSET", "NEWSET", "ELEMENTSHIFT", "SHIFTNODES"}}


def written_out(cards, findings):
    """The cards, with *NODE and *ELEMENT in place of those that generate nodes and elements."""
    special = any(card.keyword in GENERATORS or card.keyword == "SYSTEM" or card.keyword == "NODE" and "SYSTEM" in card.options for card in cards)
    return Generator(findings).run(cards) if special else cards


class Generator:
    """Nodes, elements and sets that are known so far; each part begins anew."""

    def __init__(self, findings):
        self.findings = findings
        self._begin()

    def _begin(self):
        self.nodes, self.elements, self.sets, self.system = {}, {}, {"NSET": {}, "ELSET": {}}, LocalSystem()

    def run(self, cards):
        done = []
        for card in cards:
            if card.keyword in ("PART", "ENDPART"):
                self._begin()
            if card.keyword == "SYSTEM":
                self.system = LocalSystem.of(card, self.findings)
            elif card.keyword in GENERATORS:
                done += self._generated(card)
            else:
                done.append(self._noted(card))
        return done

    def _noted(self, card):
        if card.keyword == "NODE":
            card = self._placed(card)
            for _, words in card.rows:
                self.nodes[words[0]] = [float(word) for word in words[1:4]]
        elif card.keyword == "ELEMENT":
            self._note_elements(card)
        if card.keyword in ("NSET", "ELSET"):
            self._set(card.keyword, card.option(card.keyword)).update(dict.fromkeys(self._listed(card)))
        elif card.keyword in ("NODE", "ELEMENT"):
            kind = "NSET" if card.keyword == "NODE" else "ELSET"
            self._set(kind, card.option(kind)).update((words[0], None) for _, words in card.rows)
        return card

    def _set(self, kind, name):
        return self.sets[kind].setdefault(name, {})

    def _placed(self, card):
        """*NODE in Cartesian coordinates of the part"""
        kind, rows, points = card.option("SYSTEM", "R"), [], []
        for place, words in card.rows:
            numbers = [value or 0.0 for value in numbers_in(words[1:4], place, self.findings)]
            rows.append((place, words[0]))
            points.append((numbers + [0.0] * 3)[:3])
        if kind[:1] not in ("R", "C", "S"):
            self.findings.error(card.place, f"{card.title}: SYSTEM={card.options['SYSTEM']}; expected R, C or S")
        elif points:
            points = self.system.placed(cartesian(points, kind)).tolist()
        options = {name: value for name, value in card.options.items() if name != "SYSTEM"}
        return dataclasses.replace(card, options=options, rows=[(place, [label, *map(repr, point)]) for (place, label), point in zip(rows, points)])

    def _note_elements(self, card):
        """Labels and nodes of elements whose data line is one row; a row that ends within an element is continued."""
        from ..cells import KINDS as SHAPES
        from .elements import kind_of

        kind = kind_of(card.option("TYPE"))
        words = [word for _, row in card.rows for word in row if word]
        each = 1 + SHAPES[kind][1] if kind in SHAPES else max((len(row) for _, row in card.rows), default=1)
        for first in range(0, len(words), each):
            self.elements[words[first]] = (card.option("TYPE"), words[first + 1:first + each])

    def _listed(self, card):
        for place, words in card.rows:
            if "GENERATE" in card.options:
                first, last, step = [int(value) for value in (numbers_in(words, place, self.findings) + [1, 1])[:3]]
                yield from map(str, range(first, last + 1, max(step, 1)))
                continue
            for word in filter(None, words):
                yield from self.sets[card.keyword].get(word.upper(), {word: None})

    def _generated(self, card):
        unknown = sorted(set(card.options) - OPTIONS[card.keyword])
        if unknown:
            self.findings.error(card.place, f"{card.title}: option {unknown[0]} is not supported; write the nodes or elements out")
            return []
        try:
            return list(getattr(self, "_" + card.keyword.lower())(card))
        except (KeyError, ValueError, IndexError, TypeError, OverflowError) as error:
            self.findings.error(card.place, f"{card.title}: wrong or unknown number, set or node {error}")
            return []

    def _integers(self, words, place, defaults):
        given = [None if value is None else int(value) for value in numbers_in(words, place, self.findings)]
        return [default if value is None else value for value, default in zip(given + [None] * (len(defaults) - len(given)), defaults)]

    def _node_card(self, card, place, found, set_=""):
        """*NODE with positions by label"""
        rows = [(place, [str(label), *(repr(float(x)) for x in point)]) for label, point in found]
        options = {"NSET": set_} if set_ else {}
        return self._noted_plain(dataclasses.replace(card, keyword="NODE", title="*NODE", options=options, rows=rows))

    def _noted_plain(self, card):
        """Notes a card whose coordinates are already Cartesian."""
        system, self.system = self.system, LocalSystem()
        card = self._noted(card)
        self.system = system
        return card

    def _between(self, card, place, first, last, count, step, set_):
        """Nodes that divide the line from a node to another in `count` equal parts"""
        ends = np.array([self.nodes[str(first)], self.nodes[str(last)]])
        found = [(first + k * step, ends[0] + (ends[1] - ends[0]) * k / count) for k in range(1, count)]
        return self._node_card(card, place, found, set_)

    def _ngen(self, card):
        for place, words in card.rows:
            first, last, step = self._integers(words[:3], place, [None, None, 1])
            count = (last - first) // step
            if (last - first) % step or count < 1:
                raise ValueError(f"increment {step} from {first} to {last}")
            set_ = card.options.get("NSET", "")
            yield self._between(card, place, first, last, count, step, set_)
            if set_:
                yield self._node_set(card, place, set_, [first, last])

    def _nfill(self, card):
        for place, words in card.rows:
            pairs = [sorted(map(int, self.sets["NSET"][word.upper()])) for word in words[:2]]
            if len(pairs[0]) != len(pairs[1]):
                raise ValueError(f"sets of {len(pairs[0])} and {len(pairs[1])} nodes")
            count, step = self._integers(words[2:4], place, [1, 1])
            for one, other in zip(*pairs):
                yield self._between(card, place, one, other, count, step, card.options.get("NSET", ""))
            if card.options.get("NSET"):
                yield self._node_set(card, place, card.options["NSET"], [*pairs[0], *pairs[1]])

    def _node_set(self, card, place, name, labels):
        return self._noted(dataclasses.replace(card, keyword="NSET", title="*NSET", options={"NSET": name}, rows=[(place, list(map(str, labels)))]))

    def _ncopy(self, card):
        from .parts import motion_of

        if "SHIFT" not in card.options:
            raise ValueError("without SHIFT")
        old, shift = self.sets["NSET"][card.option("OLDSET")], int(card.options["CHANGENUMBER"])
        moved = motion_of(card, self.findings).moved(np.array([self.nodes[label] for label in old]))
        yield self._node_card(card, card.place, [(int(label) + shift, point) for label, point in zip(old, moved)], card.options.get("NEWSET", ""))

    def _element_card(self, card, place, type_, found, set_=""):
        rows = [(place, [str(label), *map(str, nodes)]) for label, nodes in found]
        options = {"TYPE": type_, **({"ELSET": set_} if set_ else {})}
        return self._noted(dataclasses.replace(card, keyword="ELEMENT", title="*ELEMENT", options=options, rows=rows))

    def _elgen(self, card):
        for place, words in card.rows:
            master = int(words[0])
            n1, dn1, de1, n2, dn2, de2, n3, dn3, de3 = self._integers(words[1:10], place, [1] * 9)
            type_, nodes = self.elements[str(master)]
            found = []
            for k, j, i in np.ndindex(n3, n2, n1):
                nodes_on, on = i * dn1 + j * dn2 + k * dn3, i * de1 + j * de2 + k * de3
                if on:
                    found.append((master + on, [int(node) + nodes_on for node in nodes]))
            yield self._element_card(card, place, type_, found, card.options.get("ELSET", ""))
            if card.options.get("ELSET"):
                yield self._noted(dataclasses.replace(card, keyword="ELSET", title="*ELSET", options={"ELSET": card.options["ELSET"]},
                                                      rows=[(place, [str(master)])]))

    def _elcopy(self, card):
        old, shift, nodes_on = self.sets["ELSET"][card.option("OLDSET")], int(card.options["ELEMENTSHIFT"]), int(card.options["SHIFTNODES"])
        by_type = {}
        for label in old:
            type_, nodes = self.elements[label]
            by_type.setdefault(type_, []).append((int(label) + shift, [int(node) + nodes_on for node in nodes]))
        for type_, found in by_type.items():
            yield self._element_card(card, card.place, type_, found, card.options.get("NEWSET", ""))
