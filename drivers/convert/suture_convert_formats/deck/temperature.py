"""*INITIAL CONDITIONS, TYPE=TEMPERATURE and *TEMPERATURE: per body, uniform or linear in x, y, z."""
import numpy as np

from .cards import numbers_in
from .steps import amount

EXACT = 1e-9  # largest difference from a linear field, over the largest temperature


class Temperatures:
    def __init__(self, cards, steps, solids, conditions, findings):
        self.solids, self.sets, self.findings, self.conditions, self.steps = solids, solids.sets, findings, conditions, steps
        self.needed = set()  # sections that need an expansion coefficient
        self.initial = np.zeros(len(solids.mesh.points))
        for card in cards:
            if card.keyword == "INITIALCONDITIONS" and card.option("TYPE") == "TEMPERATURE":
                for (node, _), value, _ in self._expand(card):
                    self.initial[node] = value
            elif card.keyword == "INITIALCONDITIONS":
                findings.leave(card.place, f"{card.title}, TYPE={card.options.get('TYPE', '')}")
        track = steps.track(("TEMPERATURE",), self._expand)
        if track.values:
            self._add(track)

    def _expand(self, card):
        for place, words in card.rows:
            numbers = numbers_in(words[1:2], place, self.findings)
            if not numbers or numbers[0] is None:
                self.findings.error(place, f"{card.title}: expected a node or set and a temperature, found '{', '.join(words)}'")
                continue
            for key in self.sets.members("NSET", words[0], card.scope, place):
                if key in self.solids.node:
                    yield (self.solids.node[key], 0), numbers[0], place

    def _add(self, track):
        """Changes of temperature at all nodes and times. Track ramps begin at zero: the ramp of T begins at the initial temperature."""
        change = np.zeros((len(self.solids.mesh.points), len(self.steps.times)))
        for (node, _), values in track.values.items():
            change[node] = values
        change = self._from_initial(track, change)
        place = next(iter(track.place.values()))
        for body, name in enumerate(self.solids.bodies):
            own = self.solids.node_body == body
            sections = np.unique(self.solids.section_of[self.solids.body_of == body]).tolist()
            expands = [section for section in sections if self.solids.sections.all[section].material.expansion]
            if expands and change[own].any():
                self.needed.update(sections)
                self._add_body(name, change[own], self.solids.mesh.points[own], self.initial[own], place)

    def _from_initial(self, track, change):
        """Subtracts the initial temperature from the step on in which a temperature begins; OP=NEW leads back to it."""
        shares = {None: 0.0, **{step: self._share(step) for step in self.steps.all}}
        for key in track.values:
            weight = shares[track.began[key]] - shares[track.removed.get(key)]
            change[key[0]] -= self.initial[key[0]] * weight
        return change

    def _share(self, step):
        """0 before a step, 1 after it, linear in between: at all times"""
        return np.clip((self.steps.times - step.start) / step.period, 0.0, 1.0)

    def _add_body(self, name, change, points, initial, place):
        peak = np.unravel_index(np.argmax(np.abs(change)), change.shape)
        value, factors = amount(change[peak[0]])
        field = change[:, peak[1]]
        same = np.abs(change - np.outer(field, np.array(factors or [1.0]))).max() <= EXACT * abs(value)
        title = f"temperature of {name}"
        if same and np.ptp(field) <= EXACT * abs(value) and np.ptp(initial) <= EXACT * abs(value):
            reference = float(initial.mean())
            self.conditions.add(title, "Temperature", factors, Body=name, Value=[reference + value], Reference_Temperature=reference)
            return
        linear = np.column_stack([np.ones(len(points)), points])
        constants = np.linalg.lstsq(linear, field, rcond=None)[0]
        if not same or np.abs(linear @ constants - field).max() > EXACT * abs(value):
            self.findings.leave(place, f"*TEMPERATURE of body '{name}': neither uniform nor linear in x, y, z")
            return
        terms = [repr(float(constants[0]))] + [f"{float(c)!r}*{letter}" for c, letter in zip(constants[1:], "xyz") if abs(c) > 0]
        self.findings.change(place, f"*TEMPERATURE of body '{name}': written as an expression of the change from the initial temperature")
        self.conditions.add(title, "Temperature", factors, Body=name, Expression=" + ".join(terms))
