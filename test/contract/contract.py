"""Interface for scripts: the schemas of doc/schema, and test/contract/contract.json for exit codes, files and options.

Functions return lists of problems, one sentence each; an empty list means no change. run_contract.py applies them to runs, test_contract.py
to modified copies of run files.
"""
import csv
import json
import pathlib
import re

import jsonschema

SCHEMAS = pathlib.Path(__file__).resolve().parents[2] / "doc" / "schema"
TABLES = ("history", "rigid_groups", "steps", "contact", "reactions", "frames", "probe", "transmission", "comparison")


def schema(name):
    return json.loads((SCHEMAS / f"{name}.schema.json").read_text())


def summaryProblems(summary):
    """Deviations of a summary from its schema."""
    found = jsonschema.Draft202012Validator(schema("summary")).iter_errors(summary)
    return ["summary.json: " + "/".join(map(str, error.absolute_path)) + ": " + error.message[:300] for error in found]


def resolved(node, whole):
    """A schema with its reference resolved; for a choice with null, the other alternative."""
    if "oneOf" in node:
        node = next(one for one in node["oneOf"] if one.get("type") != "null")
    return whole["$defs"][node["$ref"].split("/")[-1]] if "$ref" in node else node


def undescribed(node, whole, path=""):
    """Keys of the schema without a description, numbers without a unit, objects with unspecified keys."""
    problems = []
    if not (node.get("description") or "$ref" in node or path.endswith("[]")):
        problems.append(f"{path}: no description")
    node = resolved(node, whole)
    types = node.get("type", [])
    types = [types] if isinstance(types, str) else types
    items = node.get("items", {}).get("type", [])
    if ({"number", "integer"} & set(types) or "number" in items) and "unit" not in node and not path.endswith("[]"):
        problems.append(f"{path}: no unit")
    if "object" in types and path != "/parameters" and "additionalProperties" not in node:
        problems.append(f"{path}: any key may be added")
    for key, below in node.get("properties", {}).items():
        problems += undescribed(below, whole, f"{path}/{key}")
    if isinstance(node.get("additionalProperties"), dict):
        problems += undescribed(node["additionalProperties"], whole, path + "[]")
    if node.get("items", {}).get("properties") or "$ref" in node.get("items", {}):
        problems += undescribed(node["items"], whole, path + "[]")
    return problems


def keysOf(node, whole, path=""):
    """All keys of the schema, as paths."""
    node, keys = resolved(node, whole), set()
    for key, below in node.get("properties", {}).items():
        keys |= {f"{path}/{key}"} | keysOf(below, whole, f"{path}/{key}")
    for below in (node.get("additionalProperties"), node.get("items")):
        if isinstance(below, dict):
            keys |= keysOf(below, whole, path + "/*")
    return keys


def keysIn(value, node, whole, path=""):
    """Keys of the schema that a summary has."""
    node, keys = resolved(node, whole), set()
    if isinstance(value, list):
        for one in value:
            keys |= keysIn(one, node.get("items", {}), whole, path + "/*")
    elif isinstance(value, dict):
        own = node.get("properties", {})
        for key, below in value.items():
            if key in own:
                keys |= {f"{path}/{key}"} | keysIn(below, own[key], whole, f"{path}/{key}")
            elif isinstance(node.get("additionalProperties"), dict):
                keys |= keysIn(below, node["additionalProperties"], whole, path + "/*")
    return keys


def isOfType(text, field):
    if field["type"] == "string":
        return True
    if field["type"] == "boolean":
        return text in ("true", "false")
    try:
        int(text) if field["type"] == "integer" else float(text)
    except ValueError:
        return False
    return True


def fieldsOf(header, fields):
    """Field of each column, in order; None and a problem if they do not match."""
    found, rest = [], list(header)
    for field in fields:
        if "pattern" in field:
            while rest and re.match(field["pattern"], rest[0]):
                found.append(field)
                rest.pop(0)
        elif rest and rest[0] == field["name"]:
            found.append(field)
            rest.pop(0)
        elif "when" not in field:
            return None, f"expected the column '{field['name']}', found " + (f"'{rest[0]}'" if rest else "no more")
    return (None, f"the column '{rest[0]}' is not in the schema, or not in this place") if rest else (found, None)


def tableProblems(path, kind, summary=None):
    """Deviations of a table from its schema: columns and their order, types, values, empty required fields."""
    described = schema(kind)
    path = pathlib.Path(path)
    with path.open(newline="") as file:
        rows = list(csv.reader(file))
    if not rows:
        return [f"{path.name}: empty"]
    fields, problem = fieldsOf(rows[0], described["fields"])
    if problem:
        return [f"{path.name}: {problem}"]
    problems = []
    if summary and described["summary_key"] and summary["format"]["tables"][described["summary_key"]] != described["version"]:
        problems.append(f"{path.name}: its version in summary.json is not that of the schema")
    for number, row in enumerate(rows[1:], 2):
        if len(row) != len(fields):
            problems.append(f"{path.name}:{number}: {len(row)} fields, expected {len(fields)}")
            continue
        for text, field in zip(row, fields):
            if text == "":
                if not field.get("missing"):
                    problems.append(f"{path.name}:{number}: {field['name']} is empty")
            elif not isOfType(text, field) or text not in field.get("enum", [text]):
                problems.append(f"{path.name}:{number}: {field['name']} is '{text}', expected {field.get('enum', field['type'])}")
    return problems[:20]


def filesOf(folder):
    """Names of the files of a run; files of load steps share one name."""
    folder = pathlib.Path(folder)
    if not folder.exists():
        return []
    return sorted({re.sub(r"_\d{4,}\.vtkhdf$", "_<step>.vtkhdf", str(path.relative_to(folder)))
                   for path in folder.rglob("*") if path.is_file()})


def folderProblems(folder):
    """Every file of a run against its schema."""
    folder = pathlib.Path(folder)
    problems, summary = [], None
    if (folder / "summary.json").exists():
        summary = json.loads((folder / "summary.json").read_text())
        problems += summaryProblems(summary)
    if summary is None:
        return []  # no finished run here
    for path in sorted(folder.glob("*.csv")):
        kind = next((named for named in ("probe", "transmission") if path.name.startswith(named + "_")), path.stem)
        problems += tableProblems(path, kind, summary) if kind in TABLES else [f"{path.name}: a table without a schema"]
    return problems


def runProblems(expected, code, folder):
    """Compares exit code and files of a run with the contract."""
    problems = []
    if code != expected["exit_code"]:
        problems.append(f"exit code {code}, the contract says {expected['exit_code']}")
    found, files = set(filesOf(folder)), set(expected["files"])
    problems += [f"file {name}: not in the contract" for name in sorted(found - files)]
    problems += [f"file {name}: in the contract, but not left" for name in sorted(files - found)]
    return problems


def optionsOf(text):
    """Options of a --help text, each with the name of its value: "--set PATH=VALUE"."""
    options = set()
    for line in text.splitlines():
        found = re.match(r"\s{1,4}((?:-\w,?\s*)?--[a-z][\w-]*)(?:[ =](?![ ])([^ ]+\{[^}]*\}|[^ ]*[^ :](?= |$)))?", line)
        if found:
            name = re.search(r"--[a-z][\w-]*", found[1])[0]
            options.add(name + (" " + found[2] if found[2] else ""))
    return sorted(options)


def optionProblems(program, expected, text):
    found, known = set(optionsOf(text)), set(expected)
    return [f"{program}: option {one} is not in the contract" for one in sorted(found - known)] + \
        [f"{program}: option {one} of the contract is not in --help" for one in sorted(known - found)]
