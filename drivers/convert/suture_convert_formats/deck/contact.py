"""*CONTACT PAIR, *TIE, *CLEARANCE, and the laws of *SURFACE INTERACTION."""
import dataclasses
import re

import numpy as np

from .cards import numbers_in
from .findings import nearest
from .geometry import mean_edge, project
from .overclosure import read_overclosure

STIFF = 50.0  # stiffness x size / Young's modulus from which penetrations are below 2 % of the compression of the bodies
SOFT = {"LINEAR": "Linear", "EXPONENTIAL": "Exponential", "TABULAR": "Table"}  # names in the scene
NEAR = 0.05  # default tolerance of *TIE over the length of an edge


@dataclasses.dataclass
class Interaction:
    """Law between two surfaces; hard contact without an Overclosure"""
    title: str
    place: object
    friction: float = 0.0
    law: str = "Frictionless"
    overclosure: object = None


@dataclasses.dataclass
class Contact:
    """An entry of the scene's list Contact; sides are names of side groups."""
    name: str
    side_a: str
    side_b: str
    law: str
    coefficient: float = 0.0
    gap: float = None
    overclosure: object = None
    softened: bool = False  # the scene has the overclosure


def read_interactions(cards, findings):
    """Interactions by upper-case name"""
    found, current = {}, None
    for card in cards:
        if card.keyword == "SURFACEINTERACTION":
            current = found[card.option("NAME")] = Interaction(card.options.get("NAME", ""), card.place)
        elif card.keyword == "CHANGEFRICTION":  # listed; what follows changes no other interaction
            current = Interaction(card.options.get("INTERACTION", ""), card.place)
        elif card.keyword == "FRICTION" and current is not None:
            read_friction(card, current, findings)
        elif card.keyword == "SURFACEBEHAVIOR" and current is not None:
            read_behaviour(card, current, findings)
        elif card.keyword in ("FRICTION", "SURFACEBEHAVIOR"):
            findings.error(card.place, f"{card.title} without *SURFACE INTERACTION before it")
    for interaction in found.values():
        if interaction.law == "Frictionless" and interaction.friction > 0:
            interaction.law = "Coulomb"
        elif interaction.law == "No Separation" and interaction.friction > 0:
            findings.leave(interaction.place, f"interaction '{interaction.title}': friction of a contact without separation")
    return found


def read_friction(card, interaction, findings):
    rows = card.numbers(findings)
    if not rows:
        return  # *FRICTION, ROUGH: the option is listed
    interaction.friction = rows[0][1][0] or 0.0
    if len(rows) > 1:
        findings.leave(rows[1][0], f"{card.title}: a table; the first coefficient is used")


def read_behaviour(card, interaction, findings):
    interaction.overclosure = law = read_overclosure(card, findings)
    if law.kind == "TIED":
        interaction.law, law.reason = "Tied", "as Tied"
    elif law.no_separation:
        interaction.law, law.reason = "No Separation", "as No Separation"


class Contacts:
    """Contacts of a scene, and the side groups of their surfaces"""

    def __init__(self, cards, solids, findings):
        self.solids, self.sets, self.findings, self.mesh = solids, solids.sets, findings, solids.mesh
        self.interactions = read_interactions(cards, findings)
        self.all, self.groups, self.clearances = [], {}, {}
        for card in cards:
            if card.keyword == "CLEARANCE":
                self._read_clearance(card)
        for card in cards:
            if card.keyword in ("CONTACTPAIR", "TIE"):
                for place, words in card.rows:
                    self._add(card, place, words)

    def _read_clearance(self, card):
        values = numbers_in([card.options.get("VALUE", "")], card.place, self.findings)
        if values[0] is None:
            self.findings.leave(card.place, f"{card.title} without VALUE=<clearance>")
        else:
            self.clearances[card.option("SLAVE"), card.option("MASTER")] = values[0]

    def _add(self, card, place, words):
        names = [word for word in words if word]
        if len(names) < 2:
            self.findings.leave(place, f"{card.title}: contact of a surface with itself; expected two surfaces")
            return
        sides = [self.surface(name, card.scope, place) for name in names[:2]]
        interaction = self._interaction(card)
        if None in sides:
            return
        slave, master = sides
        contact = Contact(f"{slave} on {master}", slave, master, "Tied")
        self._adjust(card, contact, names)
        if card.keyword == "CONTACTPAIR":
            self._choose_law(interaction, contact)
            contact.gap = self.clearances.pop((names[0].upper(), names[1].upper()), None)
        self.all.append(contact)

    def surface(self, name, scope, place):
        """Side group of a surface; None after an error"""
        key = self.sets.key_of("SURFACE", name, scope)
        if key is None:
            self.findings.error(place, f"no such surface '{name}'" + nearest(name, self.sets.known("SURFACE")))
            return None
        if key not in self.groups:
            self.groups[key] = self._group(key, place)
        return self.groups[key]

    def _group(self, key, place):
        before = len(self.findings.errors)
        sides, nodes = self.sets.surface(key)
        if len(self.findings.errors) > before:
            return None
        title = self.sets.title(key)
        rows, faults = self.solids.rows_of_surface(sides, nodes)
        for fault in faults:
            self.findings.leave(place, f"surface '{title}': {fault}")
        if not len(rows):
            self.findings.error(place, f"surface '{title}' contains no side of the solid elements")
            return None
        return self.solids.group(title, rows)

    # Laws

    def _interaction(self, card):
        """Interaction of a *CONTACT PAIR; None: hard and without friction"""
        name = card.option("INTERACTION")
        if name and name not in self.interactions:
            known = [one.title for one in self.interactions.values()]
            self.findings.error(card.place, f"no such surface interaction '{card.options['INTERACTION']}'" + nearest(name, known))
        return self.interactions.get(name)

    def _choose_law(self, interaction, contact):
        contact.law = "Frictionless"
        if interaction is None:
            return
        contact.law, contact.coefficient = interaction.law, interaction.friction
        contact.overclosure = interaction.overclosure
        if interaction.overclosure is not None and interaction.overclosure.is_soft:
            self._soften(interaction.title, interaction.overclosure, contact)

    def _soften(self, title, law, contact):
        """Takes over a pressure by overclosure; a very stiff one is an approximation of hard contact, and a table may not be possible"""
        hard = f"*SURFACE BEHAVIOR of '{title}': hard contact instead of "
        law.reason = f"as Pressure Overclosure = {SOFT[law.kind]}"
        contact.softened = True
        if law.kind == "LINEAR" and law.stiffness is not None:
            ratio = law.stiffness * self._size(contact) / self._modulus(contact)
            if ratio >= STIFF:
                contact.softened = False
                law.reason = f"{hard}the linear stiffness {law.stiffness:g} ({ratio:.0f} times stiffness over size of the bodies)"
                self.findings.change(law.place, law.reason)
        elif law.kind == "EXPONENTIAL":
            law.reason += ": the pressure is zero at the clearance c0, as in Abaqus; in CalculiX it is a hundredth of p0 there"
            self.findings.change(law.place, f"*SURFACE BEHAVIOR of '{title}' {law.reason}")
        elif law.kind == "TABULAR" and not law.is_convex:
            contact.softened = False
            law.reason = f"{hard}a table that does not begin at zero pressure, or whose slope decreases"
            self.findings.leave(law.place, law.reason)

    def _bodies(self, contact):
        elements = np.concatenate([self.mesh.side_groups[side][:, 0] for side in (contact.side_a, contact.side_b)])
        return np.unique(self.solids.body_of[elements])

    def _size(self, contact):
        """Least edge of the boxes around the bodies"""
        sizes = [np.ptp(self.mesh.points[self.solids.node_body == body], axis=0).min() for body in self._bodies(contact)]
        return float(min(sizes))

    def _modulus(self, contact):
        used = np.unique(self.solids.section_of[np.isin(self.solids.body_of, self._bodies(contact))])
        materials = [self.solids.sections.all[section].material for section in used.tolist()]
        return min(material.young or min(material.moduli) for material in materials)

    # Positions

    def _adjust(self, card, contact, names):
        """Moves slave nodes onto the master surface, and leaves out the sides of a tie that are too far away."""
        tied = card.keyword == "TIE"
        value = card.options.get("ADJUST", "YES" if tied else "")
        rows, master = self.mesh.side_groups[contact.side_a], self.mesh.side_groups[contact.side_b]
        nodes = np.unique(rows[:, 2:])
        nodes = nodes[nodes >= 0]
        if not (tied or value):
            return
        places, distances = project(self.mesh, self.mesh.points[nodes], master)
        if tied:
            limit = self._tolerance(card, master)
            self._leave_far(card, contact, rows, set(nodes[np.abs(distances) > limit].tolist()), limit)
            moved = np.abs(distances) <= limit
        elif re.fullmatch(r"[-+.\dEe]+", value):
            moved = distances <= (numbers_in([value], card.place, self.findings)[0] or 0.0)
        else:
            chosen = {self.solids.node.get(key) for key in self.sets.members("NSET", value, card.scope, card.place)}
            moved = np.isin(nodes, [node for node in chosen if node is not None])
        moved &= np.abs(distances) > 1e-9 * mean_edge(self.mesh, master)
        if value.upper() != "NO" and moved.any():
            self.mesh.points[nodes[moved]] = places[moved]
            most = np.abs(distances[moved]).max()
            self.findings.change(card.place, f"{card.title}: {moved.sum()} nodes of '{names[0]}' moved onto '{names[1]}', by at most {most:.3g}")

    def _tolerance(self, card, master):
        given = card.options.get("POSITIONTOLERANCE", "")
        value = numbers_in([given], card.place, self.findings)[0]
        return value if value is not None else NEAR * mean_edge(self.mesh, master)

    def _leave_far(self, card, contact, rows, far, limit):
        near = np.array([not far.intersection(row[row >= 0].tolist()) for row in rows[:, 2:]])
        if near.all():
            return
        if not near.any():
            self.findings.error(card.place, f"{card.title}: '{contact.side_a}' and '{contact.side_b}' are farther apart than the tolerance "
                                            f"{limit:.3g}; give a larger POSITION TOLERANCE")
            return
        self.findings.change(card.place, f"{card.title}: {(~near).sum()} sides of '{contact.side_a}' are not tied: farther than {limit:.3g} from "
                                         f"'{contact.side_b}'")
        contact.side_a = self.solids.group(contact.side_a + " tied", rows[near])

    def check_clearances(self, cards):
        for card in cards:
            if card.keyword == "CLEARANCE" and (card.option("SLAVE"), card.option("MASTER")) in self.clearances:
                self.findings.leave(card.place, f"{card.title}: no *CONTACT PAIR with these surfaces")
