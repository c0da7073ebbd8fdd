#!/usr/bin/python3
"""The page doc/parameters.md, from the descriptions that suture_schema prints. parameters.py SUTURE_SCHEMA [--check]: prints the page;
--check compares it with the file beside this script instead."""
import difflib
import pathlib
import re
import subprocess
import sys

HEAD = """# Parameters

Every parameter of a scene and of a study, as `suture_schema --format markdown` and `suture_schema --study --format markdown` print them. The
first part has what most scenes need, in the order in which a scene is written; the second part, [Advanced](#advanced), chooses methods and
compares with exact solutions. A name such as Mesh/File is the one in `--set "Mesh/File=mesh.msh"`. `suture_schema --format xml` prints a scene
with all defaults.

`python3 doc/parameters.py build/drivers/suture_schema > doc/parameters.md` renews this page.

"""


ADVANCED = ("Exact Solution", "Partition", "Condensed Groups", "Contact On The Interface", "Outer Solver", "Preconditioner", "Subdomain")


def section(program, title, *options):
    text = subprocess.run([program, *options, "--format", "markdown"], capture_output=True, text=True, check=True).stdout
    text = re.sub(r"(?<!\.)\.\.(?!\.)", ".", text)
    text = re.sub(r"(?<=[^.|:;]) (?=\*[A-Z][^*|]*\*: )", ". ", text)  # the list of choices is a separate sentence
    text = text.replace("&lt;&lt;", "&lt;").replace(">>", ">")
    text = re.sub(r"^## \(top\)\n+", "", text, flags=re.M)
    return f"## {title}\n\n" + re.sub(r"^## ", "### ", text, flags=re.M).strip() + "\n"


def ordered(scene):
    """The lists of ADVANCED in their own part, after all others."""
    head, *lists = re.split(r"^(?=### )", scene, flags=re.M)
    usual, advanced = [], []
    for part in lists:
        top = re.match(r"### ([^/\n]+)", part)[1]
        (advanced if top in ADVANCED else usual).append(part.strip() + "\n")
    return "\n".join([head.strip() + "\n", *usual, "## Advanced\n\nThe defaults suit most scenes.\n", *advanced])


def main():
    page = HEAD + ordered(section(sys.argv[1], "A scene")) + "\n" + section(sys.argv[1], "A study", "--study")
    if "--check" not in sys.argv:
        sys.stdout.write(page)
        return 0
    file = pathlib.Path(__file__).with_suffix(".md")
    difference = list(difflib.unified_diff(file.read_text().splitlines(), page.splitlines(), "doc/parameters.md", "suture_schema", lineterm=""))
    if difference:
        print("\n".join(difference))
        print("doc/parameters.md differs from the output of suture_schema; renew it: python3 doc/parameters.py build/drivers/suture_schema > doc/parameters.md")
    return 1 if difference else 0


if __name__ == "__main__":
    sys.exit(main())
