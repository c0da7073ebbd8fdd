"""*NSET, *ELSET and *SURFACE, in any order: sets of sets may come before the sets that they contain."""
import re

from .elements import dimension_of, sides_of
from .findings import nearest
from .model import integers

TITLES = {"NSET": "node set", "ELSET": "element set"}


class Sets:
    """Sets by (kind, scope, upper-case name); their members are found when they are used."""

    def __init__(self, model, findings):
        self.model, self.findings, self.assembly = model, findings, model.assembly
        self.entries = {"NSET": {}, "ELSET": {}, "SURFACE": {}}  # (scope, name) -> list of (scope of the members, card)
        self.names = {}  # (scope, name in upper case) -> name in the file
        self.found, self.owners = {}, None  # owners: number of elements at each side, by its vertices
        self.of_element_card = {}
        for key, element in model.elements.items():
            self.of_element_card.setdefault((key[0], element.place), []).append(key)
        for card in self.assembly.cards:
            self._note(card)

    def _note(self, card):
        if card.keyword in ("NSET", "ELSET"):
            if card.keyword not in card.options:
                self.findings.error(card.place, f"*{card.keyword} without {card.keyword}=<name>")
                return
            self._enter(card.keyword, card.options[card.keyword], card, self._members_scope(card))
        elif card.keyword == "SURFACE":
            if "NAME" not in card.options:
                self.findings.error(card.place, "*SURFACE without NAME=<name>")
                return
            self._enter("SURFACE", card.options["NAME"], card, card.scope)
        elif card.keyword == "NODE" and card.options.get("NSET"):
            self._enter("NSET", card.options["NSET"], card, card.scope)
        elif card.keyword == "ELEMENT" and card.options.get("ELSET"):
            self._enter("ELSET", card.options["ELSET"], card, card.scope)

    def _enter(self, kind, name, card, scope):
        key = (card.scope, name.upper())
        self.names.setdefault(key, name)
        self.entries[kind].setdefault(key, []).append((scope, card))

    def _members_scope(self, card):
        scope = card.option("INSTANCE", card.scope)
        if scope and scope not in self.assembly.instances:
            self.findings.error(card.place, f"no such instance '{card.options['INSTANCE']}'" + nearest(scope, self.assembly.instances.values()))
            return ""
        return scope

    def title(self, key):
        """Name of a set or surface for the scene: that in the file, after its instance"""
        scope, _ = key
        return (self.assembly.instances[scope] + "." if scope else "") + self.names[key]

    def key_of(self, kind, word, scope):
        """Key of a set or surface that a card names, or None."""
        name = word.upper()
        candidates = [(scope, name), ("", name)]
        at = name.find(".")
        while at > 0:
            instance = name[:at] if name[:at] in self.assembly.instances else ""  # otherwise the name of the assembly
            candidates.append((instance, name[at + 1:]))
            at = name.find(".", at + 1)
        return next((key for key in candidates if key in self.entries[kind]), None)

    def known(self, kind):
        return [self.title(key) for key in self.entries[kind]]

    def labelled(self, word, scope):
        """Key of a node or element that a card gives by its label, 12 or Part-1.12; None: not a label"""
        if re.fullmatch(r"\d+", word):
            return (scope, int(word))
        instance, _, label = word.rpartition(".")
        if label.isdigit() and instance.upper() in self.assembly.instances:
            return (instance.upper(), int(label))
        return None

    def members(self, kind, word, scope, place):
        """Keys of the nodes (NSET) or elements (ELSET) that a card names by label or set."""
        label = self.labelled(word, scope)
        if label is not None:
            table = self.model.nodes if kind == "NSET" else self.model.elements
            if label not in table:
                self.findings.error(place, f"no such {'node' if kind == 'NSET' else 'element'} {word}")
            return [label] if label in table else []
        key = self.key_of(kind, word, scope)
        if key is None:
            self.findings.error(place, f"no such {TITLES[kind]} '{word}'" + nearest(word, self.known(kind)))
            return []
        return self.of(kind, key)

    def of(self, kind, key):
        """Members of a set, without repetition, in their order."""
        if (kind, key) not in self.found:
            self.found[kind, key] = []  # a set that contains itself adds nothing
            members = {}
            for scope, card in self.entries[kind][key]:
                members.update(dict.fromkeys(self._of_card(kind, scope, card)))
            self.found[kind, key] = list(members)
        return self.found[kind, key]

    def _of_card(self, kind, scope, card):
        table = self.model.nodes if kind == "NSET" else self.model.elements
        if card.keyword == "NODE":
            return [key for key in ((scope, int(words[0])) for _, words in card.rows if words[0].isdigit()) if key in table]
        if card.keyword == "ELEMENT":
            return self.of_element_card.get((scope, card.place), [])
        if "GENERATE" in card.options:
            return [key for key in self._generated(scope, card) if key in table]
        if kind == "NSET" and "ELSET" in card.options:
            elements = self.members("ELSET", card.options["ELSET"], scope, card.place)
            return [node for key in elements for node in self.model.elements[key].nodes]
        return self._listed(kind, scope, card, table)

    def _generated(self, scope, card):
        for place, words in card.rows:
            given = integers(words, place, self.findings)
            first, last, *step = given * 2 if len(given) == 1 else given or (0, -1)  # a single label is itself
            for label in range(first, last + 1, step[0] if step and step[0] > 0 else 1):
                yield (scope, label)

    def _listed(self, kind, scope, card, table):
        for place, words in card.rows:
            for word in filter(None, words):
                label = self.labelled(word, scope)
                if label is None:
                    yield from self.members(kind, word, scope, place)
                elif label in table:
                    yield label
                else:
                    self.findings.leave(place, f"{card.title}: no such {'node' if kind == 'NSET' else 'element'} {word}")

    def surface(self, key):
        """(sides, nodes) of a surface: sides as (element key, number from 0; None: the element itself), keys of nodes"""
        if ("SURFACE", key) not in self.found:
            self.found["SURFACE", key] = ([], [])
            sides, nodes = {}, {}
            for scope, card in self.entries["SURFACE"][key]:
                self._read_surface(card, sides, nodes)
            self.found["SURFACE", key] = (list(sides), list(nodes))
        return self.found["SURFACE", key]

    def _read_surface(self, card, sides, nodes):
        type_ = card.option("TYPE", "ELEMENT")
        if type_ not in ("ELEMENT", "NODE") or card.option("COMBINE", "UNION") != "UNION":
            self.findings.error(card.place, f"{card.title}: expected TYPE=ELEMENT or TYPE=NODE, or COMBINE=UNION")
            return
        for place, words in card.rows:
            if "COMBINE" in card.options:
                for word in filter(None, words):
                    more = self.surface_named(word, card.scope, place)
                    sides.update(dict.fromkeys(more[0]))
                    nodes.update(dict.fromkeys(more[1]))
            elif type_ == "NODE":
                nodes.update(dict.fromkeys(self.members("NSET", words[0], card.scope, place)))
            else:
                sides.update(dict.fromkeys(self._sides(card, words, place)))

    def surface_named(self, word, scope, place):
        key = self.key_of("SURFACE", word, scope)
        if key is None:
            self.findings.error(place, f"no such surface '{word}'" + nearest(word, self.known("SURFACE")))
            return [], []
        return self.surface(key)

    def _sides(self, card, words, place):
        face = words[1].upper() if len(words) > 1 else ""
        if not re.fullmatch(r"S\d|SPOS|SNEG|", face):
            self.findings.error(place, f"expected a side S1 to S6 of elements, found '{', '.join(words)}'")
            return
        for key in self.members("ELSET", words[0], card.scope, place):
            element = self.model.elements[key]
            if element.kind is None:
                continue
            if self.is_facet(element):
                yield (key, None)
            elif not face:  # the free sides
                yield from ((key, side) for side in range(len(sides_of(element.kind))) if self._is_free((key, side)))
            elif face[1:].isdigit() and 0 < int(face[1:]) <= len(sides_of(element.kind)):
                yield (key, int(face[1:]) - 1)
            else:
                self.findings.error(place, f"element {key[1]} has no side {face}")

    def _is_free(self, side):
        """Whether a side belongs to one element only"""
        if self.owners is None:
            self.owners = {}
            for key, element in self.model.elements.items():
                if element.kind and dimension_of(element.kind) == self.model.dimension:
                    for number in range(len(sides_of(element.kind))):
                        corners = frozenset(self.nodes_of_side((key, number)))
                        self.owners[corners] = self.owners.get(corners, 0) + 1
        return self.owners[frozenset(self.nodes_of_side(side))] == 1

    def is_facet(self, element):
        """Whether an element is a side of others: a surface element of a 3D deck, a line of a 2D deck"""
        return dimension_of(element.kind) == self.model.dimension - 1

    def nodes_of_side(self, side):
        """Keys of the vertices of a side (element key, number)"""
        key, number = side
        element = self.model.elements[key]
        if number is None:
            return element.nodes[:{"line3": 2, "triangle6": 3, "quad8": 4, "quad9": 4}.get(element.kind, len(element.nodes))]
        return tuple(element.nodes[k] for k in sides_of(element.kind)[number])
