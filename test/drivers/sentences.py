"""Finds faults in printed sentences that typically arise when a message is composed from parts. The harness checks all program output in the tests;
`sentences.py SOURCE` checks all string literals of the sources, and thus the parts of every branch of every message."""
import pathlib
import re
import sys

SMALL = "a|an|the|at|on|in|of|to|by|for|from|with|and|or|is|are|than|as"
KINDS = [(re.compile(pattern), what) for pattern, what in (
    (rf"\b({SMALL}) \1\b", "a word twice"),
    (r"\b(at|of|to|by|from|with) (at|on|in|of|by|from|with)\b", "two prepositions"),
    (r"\b(a|an) the\b|\bthe (a|an)\b", "two articles"),
    (r" \(\)", "empty parentheses"),
    (r" [,;.](?= |$)", "a blank before a mark"),
    (r"[,;:] [,;:.](?= |$)|([;:][,;:.]|,[;:.])(?= |$)", "two marks"),
    (r"(?<![./\w])\.\.(?= |$)|\w\.\.(?= |$)", "two full stops"),
    (r"[-+ ](inf|nan) ?%", "a share that is no number"),
    (r"%(\.\d+)?[sdgefu]\b", "a format that was not filled in"),
)]
# Correct as they are.
RIGHT = re.compile(r"\bof at (least|most)\b|\bgo(es)? on\b|(?<=\d )in(?= in )")  # the last one: a length in inches


def faults(text):
    """Faults of an output, one sentence for each, including repeated warnings."""
    found = []
    lines = text.splitlines()
    for line in lines:
        plain = RIGHT.sub("", line)
        found += [f"{what} ('{match.group(0).strip()}'): {line.strip()}" for kind, what in KINDS for match in kind.finditer(plain)]
    warnings = [line.strip() for line in lines if line.strip().startswith("warning: ")]
    found += [f"twice: {line}" for line in sorted(set(warnings)) if warnings.count(line) > 1]
    return found


def literals(source):
    """Prose literals of a C++ file; literals that the compiler concatenates count as one."""
    source = re.sub(r'R"(\w*)\(.*?\)\1"', '""', source, flags=re.S)
    source = re.sub(r'("(?:[^"\\\n]|\\.)*")|//[^\n]*|/\*.*?\*/', lambda match: match.group(1) or " ", source, flags=re.S)
    source = re.sub(r"#include[^\n]*", "", source)
    for run in re.finditer(r'"(?:[^"\\\n]|\\.)*"(?:\s*"(?:[^"\\\n]|\\.)*")*', source):
        text = "".join(re.findall(r'"((?:[^"\\\n]|\\.)*)"', run.group(0))).replace('\\"', '"').replace("\\n", "\n")
        if len(re.findall(r"[A-Za-z]{2,}", text)) >= 2:
            yield text


if __name__ == "__main__":
    for wrong, what in (("work 2e-5 exceeds 1.0e-06 at on the path", "two prepositions"), ("the mesh of of it", "a word twice"),
                        ("   warning: x\n  warning: x", "twice"), ("is off by inf %", "no number"), ("turns , then", "blank before")):
        if not any(what in fault for fault in faults(wrong)):
            sys.exit(f"sentences.py does not see: {wrong}")
    bad, read = [], 0
    for folder in ("packages", "drivers", "python"):
        for path in sorted((pathlib.Path(sys.argv[1]) / folder).rglob("*.cpp")):
            for text in literals(path.read_text(encoding="utf-8")):
                read += 1
                bad += [f"{path}: {fault}" for fault in faults(text) if "format that was not" not in fault]
    print(f"{read} texts of the sources were read, {len(bad)} are wrong")
    print("\n".join(bad))
    sys.exit(1 if bad or read < 1000 else 0)
