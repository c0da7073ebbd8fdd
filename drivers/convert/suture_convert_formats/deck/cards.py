"""Cards of a deck: keyword lines with their options and data lines; *INCLUDE is followed."""
import dataclasses
import math
import re

from ..foreign import ConvertError
from .findings import Place

DEEPEST = 20  # files that include each other


@dataclasses.dataclass
class Card:
    """
    keyword  upper case, without blanks: "SOLIDSECTION"
    title    the keyword as in the file: "*Solid Section"
    options  option in upper case -> its value as in the file, without quotation marks
    rows     list of (place, words)
    scope    upper-case name of the instance that the card belongs to; "" for none
    """
    keyword: str
    title: str
    options: dict
    place: Place
    rows: list = dataclasses.field(default_factory=list)
    scope: str = ""

    def option(self, name, default=""):
        """Value of an option in upper case"""
        return self.options.get(name, default).upper()

    def numbers(self, findings):
        """Rows of numbers; an empty word is None. Words that are not numbers are errors."""
        return [(place, numbers_in(words, place, findings)) for place, words in self.rows]


def numbers_in(words, place, findings):
    """Numbers of a data line; empty words are None."""
    return [number_in(word, place, findings) if word else None for word in words]


def number_in(word, place, findings):
    """A finite number; None after an error"""
    try:
        number = float(word.replace("D", "E").replace("d", "e"))
        if math.isfinite(number):
            return number
    except ValueError:
        pass
    findings.error(place, f"expected a number, found '{word}'")
    return None


def unquoted(text):
    """Without quotation marks, also around a part as in "left plate".foot"""
    return text.replace('"', "").strip()


def divided(line):
    """Words between commas; commas between quotation marks do not divide."""
    if '"' not in line:
        return [word.strip() for word in line.split(",")]
    words, quoted = [""], False
    for letter in line:
        quoted ^= letter == '"'
        if letter == "," and not quoted:
            words.append("")
        else:
            words[-1] += letter
    return [word.strip() for word in words]


def beside(path, name):
    """The file that a deck names, also in the way of Windows"""
    return path.parent / (name if (path.parent / name).exists() else name.replace("\\", "/"))


def lines(path, depth=0):
    """(place, line) for each line that is neither empty nor a comment; keyword lines that end with a comma are continued."""
    if depth > DEEPEST:
        raise ConvertError(f"{path} includes itself (*INCLUDE)")
    try:
        text = path.read_text(encoding="utf-8-sig", errors="replace")
    except OSError as error:
        raise ConvertError(f"{path}: {error.strerror}") from error
    held, begin = "", 0
    for number, line in enumerate(text.splitlines(), 1):
        line = line.strip()
        if not line or line.startswith("**"):
            continue
        line, place = held + line, Place(path, begin if held else number)
        held = ""
        if line.startswith("*") and line.endswith(","):
            held, begin = line, place.line
        elif re.match(r"\*\s*INCLUDE\b", line, re.I):
            yield from lines(beside(path, header(place, line).options.get("INPUT", "")), depth + 1)
        else:
            yield place, line
    if held:
        yield Place(path, begin), held


def header(place, line):
    first, *words = divided(line[1:])
    options = {name.strip().upper().replace(" ", ""): unquoted(value) for name, _, value in (word.partition("=") for word in words) if name.strip()}
    return Card(first.upper().replace(" ", ""), "*" + " ".join(first.split()), options, place)


def data_row(place, line):
    return place, [unquoted(word) for word in divided(line[:-1] if line.endswith(",") else line)]


def read_cards(path, findings):
    """All cards of a deck in their order."""
    cards = []
    for place, line in lines(path):
        if line.startswith("*"):
            cards.append(header(place, line))
            if cards[-1].options.get("INPUT"):  # data lines in a file
                cards[-1].rows += [data_row(*one) for one in lines(beside(place.file, cards[-1].options.pop("INPUT")), 1)]
        elif not cards:
            findings.error(place, f"expected a keyword (*NODE, ...) before the first data line, found '{line}'")
        else:
            cards[-1].rows.append(data_row(place, line))
    return cards
