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
        changes = {}
        for key in sorted(set().union(*active)):
            own = changes.setdefault(self.nodal.source[key], {})
            for number, (before, after) in enumerate(zip(active, active[1:]), 1):
                if (key in before) != (key in after):
                    own[number, "begins" if key in after else "ends"] = None
        frozen = {self.nodal.source[key]: step for key, step in self.track.frozen.items()}
        for source, own in changes.items():
            if own:
                text = ", ".join(f"{what} in step {self.steps.all[number].number}" for number, what in sorted(own))
                self.findings.leave(source.place, f"*BOUNDARY on '{source.name}' {text}; {self._consequence(first)}")
            if source in frozen:
                self.findings.leave(source.place, f"*BOUNDARY, FIXED on '{source.name}': the displacements at the beginning of step "
                                                  f"{frozen[source].number} are not known before a solution; the scene holds them at zero")

    def _consequence(self, first):
        same = "a scene has the same supports in all its steps"
        if self.history:
            return f"{same}: here those of the last step; with {self.history} the results depend on those of earlier steps"
        return f"{same}: it begins with step {self.steps.all[first].number}, whose results do not depend on those of earlier steps"


def history_of(cards, contacts):
    """Why results depend on earlier steps; empty: they do not"""
    if any(contact.law == "Coulomb" for contact in contacts):
        return "friction"
    return "pre-tension" if any(card.keyword == "PRE-TENSIONSECTION" for card in cards) else ""
