"""Supports that begin or end in a later step: a scene has the same supports over its whole path."""


class SupportPath:
    """
    Without history (friction, pre-tension) the results of a step depend on its own loads and supports only: the scene begins with the first
    step from which on the supports are those of the last step. With history it has all steps, with the supports of the last step.
    """

    def __init__(self, track, nodal, steps, nodes, history, findings):
        """\\param nodes  keys of nodes that carry supports \\param history  why results depend on earlier steps; empty: they do not"""
        self.track, self.nodal, self.steps, self.history, self.findings = track, nodal, steps, history, findings
        active = [{key for key in some if key[0] in nodes} for some in track.active]
        first = next((k + 1 for k in reversed(range(len(active))) if active[k] != active[-1]), 0)
        if not first:
            return
        self._list(active, first)
        for key in set().union(*active) - active[-1]:
            track.drop(key)
        if not history:
            steps.begin_with(steps.all[first])
            track.skip()

    def _list(self, active, first):
        """One finding for each set or card whose supports change"""
        found, frozen = {}, {}  # Source -> changes -> directions; Source -> step
        for key in sorted(set().union(*active)):
            changes = tuple((number, "begins" if key in after else "ends") for number, (before, after) in enumerate(zip(active, active[1:]), 1)
                            if (key in before) != (key in after))
            found.setdefault(self.nodal.source[key], {}).setdefault(changes, set()).add(key[1])
            if key in self.track.frozen:
                frozen[self.nodal.source[key]] = self.track.frozen[key]
        for source, by_changes in found.items():
            for changes, directions in by_changes.items():
                if changes:
                    which = f", direction{'s' if len(directions) > 1 else ''} {', '.join(map(str, sorted(directions)))}," if len(by_changes) > 1 else ""
                    text = ", ".join(f"{what} in step {self.steps.all[number].number}" for number, what in changes)
                    self.findings.leave(source.place, f"*BOUNDARY on '{source.name}'{which} {text}; {self._consequence(first)}")
        for source, step in frozen.items():
            self.findings.leave(source.place, f"*BOUNDARY, FIXED on '{source.name}': the displacements at the beginning of step {step.number} are not "
                                              "known before a solution; the scene holds them at zero")

    def _consequence(self, first):
        same = "a scene has the same supports in all its steps"
        if self.history:
            return f"{same}: here those of the last step; with {self.history} the results depend on those of earlier steps"
        return f"{same}; therefore the scene begins with step {self.steps.all[first].number}, whose results do not depend on those of earlier steps"


def history_of(cards, contacts):
    """Why results depend on earlier steps; empty: they do not"""
    if any(contact.law == "Coulomb" for contact in contacts):
        return "friction"
    return "pre-tension" if any(card.keyword == "PRE-TENSIONSECTION" for card in cards) else ""
