#!/usr/bin/python3
"""The page doc/parameters.md, from the descriptions that suture_schema prints. parameters.py SUTURE_SCHEMA [--check]: prints the page;
--check compares it with the file beside this script instead."""
import re
import sys

from generated_page import markdown, show_or_check

HEAD = """# Parameters

Every parameter of a scene and of a study, as `suture_schema --format markdown` and `suture_schema --study --format markdown` print them. The
first part has what most scenes need, in the order in which a scene is written; the second part, [Advanced](#advanced), chooses methods and
compares with exact solutions. A name such as Mesh/File is the one in `--set "Mesh/File=mesh.msh"`. `suture_schema --format xml` prints a scene
with all defaults.

`python3 doc/parameters.py build/drivers/suture_schema > doc/parameters.md` renews this page.

"""


ADVANCED = ("Exact Solution", "Partition", "Condensed Groups", "Contact On The Interface", "Outer Solver", "Preconditioner", "Subdomain")


def section(title, *options):
    text = re.sub(r"(?<!\.)\.\.(?!\.)", ".", markdown(*options))
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
    return show_or_check(__file__, HEAD + ordered(section("A scene")) + "\n" + section("A study", "--study"))


if __name__ == "__main__":
    sys.exit(main())
