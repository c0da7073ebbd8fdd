"""*SURFACE BEHAVIOR: the pressure of a contact as a function of the overclosure, as the deck gives it."""
import dataclasses

KINDS = ("HARD", "LINEAR", "EXPONENTIAL", "TABULAR", "TIED")


@dataclasses.dataclass
class Overclosure:
    """
    kind           HARD: no penetration; TIED; LINEAR, EXPONENTIAL, TABULAR: softened
    stiffness      LINEAR, TIED: pressure over overclosure [stress / length]
    clearance      EXPONENTIAL, c0: clearance at which the pressure is zero (Abaqus), or a hundredth of `pressure` (CalculiX) [length]
    pressure       EXPONENTIAL, p0: pressure at zero clearance [stress]
    table          TABULAR: list of (pressure, overclosure), with increasing overclosures; below the first one there is no pressure
    no_separation  the surfaces never separate
    reason         how the scene represents the law
    """
    kind: str
    place: object
    stiffness: float = None
    clearance: float = None
    pressure: float = None
    table: list = dataclasses.field(default_factory=list)
    no_separation: bool = False
    reason: str = ""

    @property
    def is_convex(self):
        """True if the table begins at zero pressure and its slope never decreases"""
        slopes = [(b[0] - a[0]) / (b[1] - a[1]) for a, b in zip(self.table, self.table[1:])]
        return bool(slopes) and self.table[0][0] == 0.0 and all(a <= b * (1 + 1e-12) for a, b in zip(slopes, slopes[1:]))

    @property
    def is_soft(self):
        return self.kind in ("LINEAR", "EXPONENTIAL", "TABULAR")


def read_overclosure(card, findings):
    """Overclosure of a *SURFACE BEHAVIOR; hard after an error or a finding"""
    kind = card.option("PRESSURE-OVERCLOSURE", "HARD").replace(" ", "")
    law = Overclosure(kind, card.place, no_separation="NOSEPARATION" in card.options)
    rows = [(place, [value for value in row if value is not None]) for place, row in card.numbers(findings)]
    values = [value for _, row in rows for value in row]
    if kind not in KINDS:
        findings.leave(card.place, f"{card.title}, PRESSURE-OVERCLOSURE={card.options['PRESSURE-OVERCLOSURE']}; hard contact instead")
        law.kind = "HARD"
    elif kind == "LINEAR":
        law.stiffness = positive(values[:1], 1, card, "the stiffness of the contact", findings)
    elif kind == "TIED":
        law.stiffness = values[0] if values else None
    elif kind == "EXPONENTIAL" and positive(values[:2], 2, card, "the clearance c0 and the pressure p0", findings):
        law.clearance, law.pressure = values[:2]
    elif kind == "TABULAR":
        read_table(rows, card, law, findings)
    return law


def positive(values, count, card, what, findings):
    """The first value; None after an error"""
    if len(values) < count or min(values) <= 0:
        findings.error(card.place, f"{card.title}: expected {what} > 0")
        return None
    return values[0]


def read_table(rows, card, law, findings):
    law.table = [(row[0], row[1]) for _, row in rows if len(row) > 1]
    closures = [closure for _, closure in law.table]
    rises = all(a < b for a, b in zip(closures, closures[1:])) and all(a[0] <= b[0] for a, b in zip(law.table, law.table[1:]))
    if len(law.table) < 2 or len(law.table) < len(rows) or not rises:
        findings.error(card.place, f"{card.title}: expected at least two lines of pressure and overclosure, both increasing")
