#!/usr/bin/python3
"""Documentation against the sources.

check_doc.py ROOT: prints, and fails for,
- rows of the table of doc/theory.md whose class, function or test does not exist. A row is
  | equation | meaning | `Class`, `Class::function` or `function` | `folder/File.Test`, `folder/File.Suite.Test` or `ctest name` |;
- relative links of Markdown files to missing files, and link fragments `#...` without a heading.
"""
import json
import os
import pathlib
import re
import sys

HEADER = ["equation", "meaning", "code", "test"]
NAME = r"[A-Za-z_]\w*"


def withoutComments(text):
    """C++ without comments and string contents; line numbers are kept."""
    pattern = r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"'
    return re.sub(pattern, lambda found: '""' if found[0][0] == '"' else re.sub(r"[^\n]", "", found[0]), text, flags=re.S)


def braces(text, begin):
    """Text between the brace at `begin` and its closing brace."""
    depth = 0
    for i in range(begin, len(text)):
        depth += {"{": 1, "}": -1}.get(text[i], 0)
        if depth == 0:
            return text[begin + 1:i]
    return text[begin + 1:]


def outermost(text):
    """Text with everything between braces removed."""
    parts, depth = [], 0
    for part in re.split(r"([{}])", text):
        if part == "{":
            depth += 1
        elif part == "}":
            depth -= 1
            parts.append(";")  # a body ends a declaration
        elif depth == 0:
            parts.append(part)
    return "".join(parts)


def declares(text, name):
    """True if the text, without braces, declares a function: the type is before the name, on the same line or the line above."""
    for found in re.finditer(r"([^;(),]*?)\b" + name + r"\s*\(", text):
        before = found[1].split()
        if before and before[-1] not in ("return", "new", "throw") and re.search(r"[\w>&*]$", before[-1]):
            return True
    return False


class Sources:
    """Classes and functions of packages/."""

    def __init__(self, root):
        self.members = {}  # class -> its definitions
        self.free = []     # texts of namespaces
        for file in sorted(root.glob("packages/**/*.hpp")):
            text = withoutComments(file.read_text())
            for found in re.finditer(r"\b(?:class|struct)\s+(" + NAME + r")\b[^;{}()=]*\{", text):
                self.members.setdefault(found[1], []).append(braces(text, found.end() - 1))
            for found in re.finditer(r"\bnamespace\b[^;{}]*\{", text):
                self.free.append(outermost(braces(text, found.end() - 1)))

    def missing(self, code):
        """Problem with a name of the table, or None."""
        owner, _, function = code.rpartition("::")
        if owner:
            if owner not in self.members:
                return f"no header of packages/ has a class {owner}"
            if not any(declares(outermost(body), function) for body in self.members[owner]):
                return f"class {owner} has no member {function}()"
        elif code not in self.members and not any(declares(text, code) for text in self.free):
            return f"no header of packages/ has a class or function {code}"
        return None


class Tests:
    """Unit tests by file, and names of ctest without their ranks."""

    def __init__(self, root):
        self.root = root
        self.named = set()
        for file in root.glob("test/**/CMakeLists.txt"):
            text = re.sub(r"#[^\n]*", "", file.read_text())
            self.named |= set(re.findall(r"\badd_test\(NAME\s+([\w.]+)\s", text)) | set(re.findall(r"\bsuture_mpi_test\(([\w.]+)\s", text))
            self.named |= {"corpus." + name for name in re.findall(r"\bsuture_lost_scenes\((\w+)\s", text)}
            for prefix, table in re.findall(r"\bsuture_run_table\(([\w.]+)\s+\$\{CMAKE_CURRENT_SOURCE_DIR\}/([\w.]+)", text):
                self.named |= {f"{prefix}.{case}" for case in json.loads((file.parent / table).read_text())["cases"]}
        self.named |= {"validation." + file.parent.name for file in root.glob("input/validation/*/checks.json")}
        self.named |= {"drivers." + file.name.split(".")[0] for file in root.glob("input/*/*.expected.json")}

    def units(self, file):
        text = withoutComments(file.read_text())
        found = set(re.findall(r"\bTEUCHOS_UNIT_TEST\(\s*(\w+)\s*,\s*(\w+)\s*\)", text))
        # Macros of a file that make tests: #define MACRO(Name, ...) TEUCHOS_UNIT_TEST(Suite, Name)
        for macro, name, suite in re.findall(
                r"#define\s+(\w+)\((\w+)[^)]*\)\s*(?:\\\s*)*TEUCHOS_UNIT_TEST\(\s*(\w+)\s*,\s*\2\s*\)", text):
            found.discard((suite, name))
            found |= {(suite, test) for test in re.findall(r"^" + macro + r"\(\s*(\w+)", text, flags=re.M)}
        return found

    def missing(self, test):
        """Problem with a test of the table, or None."""
        if test.startswith("ctest "):
            return None if test[6:] in self.named else f"ctest has no test {test[6:]}"
        parts = re.fullmatch(r"([\w/]+)/(\w+)\.(?:(\w+)\.)?(\w+)", test)
        if not parts:
            return f"{test} is neither folder/File.Test nor ctest name"
        file = self.root / "test" / parts[1] / (parts[2] + ".cpp")
        if not file.is_file():
            return f"there is no {file.relative_to(self.root)}"
        made = file.parent / "CMakeLists.txt"
        if not made.is_file() or not re.search(r"\b" + parts[2] + r"\b", re.sub(r"#[^\n]*", "", made.read_text())):
            return f"{file.relative_to(self.root)} is not named in its CMakeLists.txt"
        wanted = (parts[3] or parts[2], parts[4])
        return None if wanted in self.units(file) else f"{file.relative_to(self.root)} has no TEUCHOS_UNIT_TEST({wanted[0]}, {wanted[1]})"


def cells(line):
    return [cell.strip() for cell in line.strip().strip("|").split("|")]


def checkTable(root):
    """Problems of the table of doc/theory.md."""
    page = root / "doc" / "theory.md"
    if not page.is_file():
        return ["there is no doc/theory.md"]
    sources, tests, problems, rows, inside = Sources(root), Tests(root), [], 0, False
    for number, line in enumerate(page.read_text().splitlines(), 1):
        if not line.startswith("|"):
            inside = False
        elif cells(line) == HEADER:
            inside = True
        elif inside and not re.fullmatch(r"[|\s:-]+", line):
            rows += 1
            row = cells(line)
            quoted = [re.fullmatch(r"`([^`]+)`", cell) for cell in row[2:]]
            if len(row) != len(HEADER) or not all(row) or not all(quoted):
                problems.append(f"doc/theory.md:{number}: not a row of equation, meaning, `code`, `test`")
                continue
            found = [sources.missing(quoted[0][1]), tests.missing(quoted[1][1])]
            problems += [f"doc/theory.md:{number}: {problem}" for problem in found if problem]
    return problems if rows else [f"doc/theory.md has no table with the header {' | '.join(HEADER)}"]


def anchors(text):
    """Anchors of headings, as generated on the web."""
    text = re.sub(r"^```.*?^```", "", text, flags=re.S | re.M)
    headings = re.findall(r"^#+\s+(.*?)\s*$", text, flags=re.M)
    return {re.sub(r"\s", "-", re.sub(r"[^\w\s-]", "", heading.lower())) for heading in headings}


def pages(root):
    """Markdown files below a folder, except hidden folders and build folders, where other tests may remove files
    at the same time."""
    made = {path.parent.name for path in root.glob("*/CMakeCache.txt")} | {path.parent.name for path in root.glob("*/CTestTestfile.cmake")}
    for folder, inner, names in os.walk(root):
        folder = pathlib.Path(folder)
        inner[:] = [name for name in inner if not name.startswith(".") and not (folder == root and name in made)]
        yield from (folder / name for name in names if name.endswith(".md"))


def checkLinks(root):
    """Problems of relative links in Markdown files."""
    problems = []
    for page in sorted(pages(root)):
        inside = page.relative_to(root)
        text = re.sub(r"^```.*?^```", lambda found: "\n" * found[0].count("\n"), page.read_text(), flags=re.S | re.M)
        for number, line in enumerate(text.splitlines(), 1):
            for target in re.findall(r"\]\(([^)\s]+)(?: \"[^\"]*\")?\)", re.sub(r"`[^`]*`", "", line)):
                if re.match(r"[a-z]+:", target):
                    continue
                path, _, part = target.partition("#")
                file = page.parent / path if path else page
                if not file.exists():
                    problems.append(f"{inside}:{number}: the link {target} leads to no file")
                elif part and (file.suffix != ".md" or part not in anchors(file.read_text())):
                    problems.append(f"{inside}:{number}: {path or inside.name} has no heading #{part}")
    return problems


def main():
    root = pathlib.Path(sys.argv[1])
    problems = checkTable(root) + checkLinks(root)
    for problem in problems:
        print(problem)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
