"""A scene and its mesh from a deck."""
import re

import numpy as np

from .axes import NodalAxes
from .cards import read_cards
from .conditions import Conditions
from .contact import Contacts
from .coupling import Couplings
from .findings import Findings
from .generators import written_out
from .keywords import check
from .loads import Loads
from .materials import Materials, Sections
from .model import Model
from .nodal import NodalCards
from .parts import Assembly
from .preload import Preloads
from .scene import write
from .sets import Sets
from .solids import Solids
from .steps import Steps
from .support_path import SupportPath, history_of
from .supports import Supports
from .temperature import Temperatures

UNITS = {"m": "m, N, Pa", "mm": "mm, N, MPa", "in": "in, lbf, psi"}
SYSTEMS = {"M_KG_S_C": "m", "MM_TON_S_C": "mm", "IN_LB_S_F": "in"}  # as PrePoMax writes them in *HEADING


class DeckScene:
    """
    mesh       Mesh with the groups of the scene
    findings   Findings
    couplings  Couplings: its `all` has each *COUPLING and *RIGID BODY as a RigidGroup
    text(mesh_file)  the scene, whose Mesh/File is mesh_file
    """

    def __init__(self, path, units=None):
        self.path, self.findings = path, Findings(path)
        cards = written_out(read_cards(path, self.findings), self.findings)
        self.assembly = Assembly(cards, self.findings)
        self.findings.stop()
        cards = self.assembly.cards
        cards = check(cards, self.findings)
        self.units = UNITS.get(units, units) or self._units_of(cards)
        self.title = self._title_of(cards)
        self._read_solids(cards)
        self._read_conditions(cards)
        self.findings.stop()

    def _read_solids(self, cards):
        model = Model(self.assembly, self.findings)
        sets = Sets(model, self.findings)
        materials = Materials(cards, self.findings)
        sections = Sections(cards, model, sets, materials, self.findings)
        self.findings.stop()
        self.solids = Solids(model, sets, sections, self.findings)
        self.mesh = self.solids.mesh
        self.found = self.solids.add_element_groups()

    def _read_conditions(self, cards):
        findings, solids = self.findings, self.solids
        self.steps = Steps(cards, findings)
        self.conditions = Conditions(self.mesh.dimension)
        self.contacts = Contacts(cards, solids, findings)
        self.contacts.check_clearances(cards)
        axes = NodalAxes(cards, solids, findings)
        self.couplings = couplings = Couplings(cards, solids, self.conditions, findings)
        held, forced = NodalCards(solids.sets, findings), NodalCards(solids.sets, findings)
        displacements = self.steps.track(("BOUNDARY",), held.boundary)
        SupportPath(displacements, held, self.steps, set(solids.node) | couplings.nodes, history_of(cards, self.contacts.all), findings)
        forces = self.steps.track(("CLOAD",), forced.force, adds=True)
        thickness = self._thickness()
        forces.values = {key: values / thickness for key, values in forces.values.items()}
        axes.turn_forces(forces, forced)
        Supports(displacements, held, axes, solids, self.conditions, findings)
        preloads = Preloads(cards, self.contacts, solids, self.conditions, findings)
        preloads.add(forces, displacements)
        couplings.add(forces, displacements)
        loads = Loads(self.steps, forced, solids, self.conditions, findings)
        loads.add_point_forces(forces)
        loads.add_distributed()
        loads.add_foundations(cards)
        self.needed = Temperatures(cards, self.steps, solids, self.conditions, findings).needed
        self._list_loose((displacements, held), couplings.nodes | set(preloads.sections))
        self._list_loose((forces, forced), couplings.nodes | set(preloads.sections))

    def _thickness(self):
        """Thickness of plane models: loads and results of a scene are per unit of thickness"""
        if self.solids.model not in ("Plane Strain", "Plane Stress"):
            return 1.0
        used = [self.solids.sections.all[number] for number in np.unique(self.solids.section_of).tolist()]
        first = used[0]
        for other in used[1:]:
            if abs(other.thickness - first.thickness) > 1e-9 * first.thickness:
                self.findings.error(other.place, f"thickness {other.thickness:g}, but {first.thickness:g} of '{first.title}'; expected one thickness")
        if first.thickness != 1.0:
            self.findings.change(first.place, f"thickness {first.thickness:g}: forces of the scene and its results are per unit of thickness")
        return first.thickness

    def _list_loose(self, track_of, known):
        """Values at nodes that belong to no solid element, section or coupling."""
        track, nodal = track_of
        for key in track.values:
            node, _ = key
            if node not in self.solids.node and node not in known:
                source = nodal.source[key]
                self.findings.leave(source.place, f"values on '{source.name}', at nodes without solid elements such as node {node[1]}")

    @staticmethod
    def _title_of(cards):
        rows = next((card.rows for card in cards if card.keyword == "HEADING" and card.rows), None)
        return ", ".join(word for word in rows[0][1] if word) if rows else ""

    @staticmethod
    def _units_of(cards):
        for card in cards:
            if card.keyword == "HEADING":
                for _, words in card.rows:
                    found = re.search(r"Unit system: *(\w+)", ",".join(words))
                    if found and found[1] in SYSTEMS:
                        return UNITS[SYSTEMS[found[1]]]
        return None

    def text(self, mesh_file):
        return write(self.path, self.title, self.units, mesh_file, self.solids, self.found, self.conditions, self.contacts, self.steps.times,
                     self.needed, self.findings)
