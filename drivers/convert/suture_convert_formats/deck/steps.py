"""*STEP, *STATIC and *AMPLITUDE: times of a load path, and the values of loads at these times."""
import bisect

import numpy as np

from .cards import numbers_in
from .findings import nearest

PROCEDURES = {"DYNAMIC", "FREQUENCY", "BUCKLE", "HEATTRANSFER", "COUPLEDTEMPERATURE-DISPLACEMENT", "UNCOUPLEDTEMPERATURE-DISPLACEMENT",
              "MODALDYNAMIC", "STEADYSTATEDYNAMICS", "VISCO", "NOANALYSIS", "ELECTROMAGNETICS", "GREEN", "CRACKPROPAGATION", "COMPLEXFREQUENCY",
              "SUBSTRUCTUREGENERATE", "GEOSTATIC", "SOILS"}
FROZEN = object()  # value of *BOUNDARY, FIXED
SAME = 1e-12  # relative difference of equal times or values


class Amplitude:
    """Factor as a function of time, linear between the points of a table"""

    def __init__(self, card, findings):
        self.total = card.option("TIME").startswith("TOTAL")
        if card.option("DEFINITION", "TABULAR") != "TABULAR" or card.option("VALUE", "RELATIVE") != "RELATIVE":
            findings.leave(card.place, f"{card.title}: only DEFINITION=TABULAR with relative values; the loads act in full")
            self.times, self.values = [0.0], [1.0]
            return
        numbers = [value for place, words in card.rows for value in numbers_in(words, place, findings) if value is not None]
        self.times, self.values = numbers[::2], numbers[1::2]
        if not numbers or len(numbers) % 2 or any(b < a for a, b in zip(self.times, self.times[1:])):
            findings.error(card.place, f"{card.title}: expected pairs of time and value with increasing times")
            self.times, self.values = [0.0], [1.0]

    def at(self, time):
        return float(np.interp(time, self.times, self.values))


class Step:
    """
    number         from 1
    start, period  time at which it begins, and its duration
    cards          in their order
    at_once        loads act in full from its beginning (AMPLITUDE=STEP)
    """

    def __init__(self, number, at_once=False):
        self.number, self.cards, self.start, self.period, self.at_once = number, [], 0.0, 1.0, at_once


class Steps:
    """
    all      static steps
    initial  cards before the steps
    times    ends of all steps, and times in them at which an amplitude has a corner
    skipped  number of times at the beginning that the scene does not have; `all_times` also has these
    """

    def __init__(self, cards, findings):
        self.findings, self.all, self.initial = findings, [], []
        self.amplitudes, self.titles = {}, []
        self._divide(cards)
        if not self.all:
            findings.leave(None, "no *STATIC step: the scene has only the supports of the model")
            self.all.append(Step(1))
        for card in cards:
            if card.keyword == "AMPLITUDE":
                self.amplitudes[card.option("NAME")] = Amplitude(card, findings)
                self.titles.append(card.options.get("NAME", ""))
        self._find_times()

    def _divide(self, cards):
        step, count = None, 0
        for card in cards:
            if card.keyword == "STEP":
                count += 1
                step = Step(count, card.option("AMPLITUDE") == "STEP")
                if "PERTURBATION" in card.options:
                    self._skip(step, card, "PERTURBATION")
                else:
                    self.all.append(step)
                    if card.option("NLGEOM", "NO") != "NO" or ("NLGEOM" in card.options and not card.options["NLGEOM"]):
                        self.findings.leave(card.place, f"{card.title}: NLGEOM; displacements are small in a scene")
            elif card.keyword == "ENDSTEP":
                step = None
            elif step is None:
                self.initial.append(card)
            else:
                if card.keyword in PROCEDURES:
                    self._skip(step, card, card.title)
                step.cards.append(card)

    def _skip(self, step, card, what):
        self.findings.leave(card.place, f"step {step.number} ({what}) with all its loads; only *STATIC steps")
        if step in self.all:
            self.all.remove(step)

    def _find_times(self):
        start, times = 0.0, []
        following = [amplitude for card in self.initial if (amplitude := self._amplitude_of(card)) and amplitude.total]
        for step in self.all:
            step.start = start
            for card in step.cards:
                if card.keyword == "STATIC" and card.rows:
                    row = numbers_in(card.rows[0][1], card.rows[0][0], self.findings)
                    step.period = row[1] if len(row) > 1 and row[1] else 1.0
                    if step.period < 0:
                        self.findings.error(card.rows[0][0], f"{card.title}: expected a period > 0, found {step.period:g}")
                        step.period = 1.0
            start += step.period
            own = [amplitude for card in step.cards if (amplitude := self._amplitude_of(card))]
            following += [amplitude for amplitude in own if amplitude.total]  # loads follow these in later steps, too
            inner = {time + (0.0 if amplitude.total else step.start) for amplitude in own + following for time in amplitude.times}
            times += sorted(time for time in inner if step.start + SAME * start < time < start * (1 - SAME))
            times.append(start)
        self.times = self.all_times = np.array(times)
        self.skipped = 0

    def begin_with(self, step):
        """Leaves out the times before a step."""
        self.skipped = self.of(step)[0]
        self.times = self.all_times[self.skipped:]

    def _amplitude_of(self, card):
        return self.amplitudes.get(card.option("AMPLITUDE")) if card.keyword != "STEP" else None

    def of(self, step):
        """Numbers of the times in a step"""
        first, last = (bisect.bisect_right(self.all_times.tolist(), time * (1 + SAME)) for time in (step.start, step.start + step.period))
        return range(first, last)

    def track(self, keywords, expand, adds=False):
        """Values of loads over the path.

        keywords  cards that prescribe them
        expand    card -> list of (key, value, place)
        adds      whether values of the same key in one step add up; otherwise the last one holds
        \\return    Track
        """
        track = Track(self, keywords, expand, adds)
        track.follow()
        track.skip()
        return track


class Track:
    """
    values   key -> its values at all times
    place    key -> line that defines it first
    card     key -> keyword line of that card
    began    key -> step in which it begins
    removed  key -> step in which OP=NEW ends it
    active   for each step the keys that it has or continues
    frozen   key -> step in which FIXED holds a value that is not prescribed before
    """

    def __init__(self, steps, keywords, expand, adds):
        self.steps, self.keywords, self.expand, self.adds = steps, keywords, expand, adds
        self.values, self.place, self.card, self.end, self.began, self.removed = {}, {}, {}, {}, {}, {}
        self.active, self.frozen, self.following = [], {}, {}  # following: key -> (value, amplitude in total time) of its entries

    def follow(self):
        carried, _ = self._entries(self.steps.initial)
        for step in self.steps.all:
            entries, new = self._entries(step.cards)
            if step is self.steps.all[0] and not new:
                entries = {**carried, **entries}
            at = self.steps.of(step)
            before = set() if new or not self.active else self.active[-1]
            self.active.append(before | set(entries))
            for key in list(self.values):
                if key not in entries:
                    self._continue(key, step, at, new)
            for key, entry in entries.items():
                self._prescribe(key, entry, step, at)
            for key, values in self.values.items():
                self.end[key] = values[at[-1]]

    def skip(self):
        """Leaves out the times that the scene does not have."""
        self.values = {key: values[self.steps.skipped:] for key, values in self.values.items()}

    def drop(self, key):
        for some in (self.values, self.place, self.card, self.began):
            del some[key]

    def copy(self, key, other, values):
        """Sets the values of a key that has all else from another one."""
        self.values[other] = values
        for some in (self.place, self.card, self.began, self.removed):
            if key in some:
                some.setdefault(other, some[key])

    def _entries(self, cards):
        entries, new = {}, False
        for card in cards:
            if card.keyword in self.keywords:
                new |= card.option("OP") == "NEW"
                amplitude = self._amplitude(card)
                for key, value, place in self.expand(card):
                    before = entries[key][0] if self.adds and key in entries else []
                    entries[key] = ([*before, (FROZEN if "FIXED" in card.options else value, amplitude)], place, card.place)
        return entries, new

    def _amplitude(self, card):
        name = card.option("AMPLITUDE")
        if name and name not in self.steps.amplitudes:
            self.steps.findings.error(card.place, f"no such amplitude '{card.options['AMPLITUDE']}'" + nearest(name, self.steps.titles))
        return self.steps.amplitudes.get(name)

    def _continue(self, key, step, at, new):
        last = self.end.get(key, 0.0)
        if new and key not in self.removed:
            self.removed[key] = step
        if new:
            self.following.pop(key, None)
        for i in at:
            time = self.steps.all_times[i]
            share = (time - step.start) / step.period if new else 0.0
            followed = sum(value * (amplitude.at(time) - amplitude.at(step.start)) for value, amplitude in self.following.get(key, ()))
            self.values[key][i] = last * (1 - share) + followed

    def _prescribe(self, key, entry, step, at):
        parts, place, card = entry
        if key not in self.values:
            self.values[key], self.place[key], self.card[key], self.began[key] = np.zeros(len(self.steps.all_times)), place, card, step
        if any(value is FROZEN for value, _ in parts):
            self._freeze(key, step, at)
            return
        self.following[key] = [(value, amplitude) for value, amplitude in parts if amplitude is not None and amplitude.total]
        ramped = [value for value, amplitude in parts if amplitude is None]
        last = self.end.get(key, 0.0) if ramped else 0.0
        for i in at:
            time = self.steps.all_times[i]
            share = 1.0 if step.at_once else (time - step.start) / step.period
            total = last + (sum(ramped) - last) * share if ramped else 0.0
            self.values[key][i] = total + sum(value * amplitude.at(time if amplitude.total else time - step.start)
                                              for value, amplitude in parts if amplitude is not None)

    def _freeze(self, key, step, at):
        """FIXED: the last value of a prescribed displacement; for others the displacement at the beginning of the step, which is not known."""
        number = self.steps.all.index(step)
        if number and key not in self.active[number - 1]:
            self.frozen[key] = step
        self.values[key][list(at)] = self.end.get(key, 0.0)


def amount(values):
    """Largest value, with its sign, and the factors that give the others; None: all zero or only one time"""
    peak = float(values[np.argmax(np.abs(values))]) if len(values) else 0.0
    if peak == 0.0:
        return 0.0, None
    factors = tuple(round(value, 14) for value in (values / peak).tolist())
    return peak, factors if len(values) > 1 else None


def vectors(parts):
    """Sums of constant vectors times factors: components with the same factors share one.

    parts   component -> values at all times
    \\return  list of ({component: value}, factors)
    """
    found = {}
    for component, values in parts.items():
        value, factors = amount(values)
        found.setdefault(factors if value else "zero", {})[component] = value
    zero = found.pop("zero", {})
    all_ = [(members, factors) for factors, members in found.items()]
    if zero:
        if len(all_) == 1:
            all_[0][0].update(zero)
        else:
            all_.append((zero, None))
    return all_
