#!/usr/bin/python3
"""The page doc/parameters.md, from the descriptions that suture_schema prints. parameters.py SUTURE_SCHEMA [--check]: prints the page;
--check compares it with the file beside this script instead."""
import difflib
import pathlib
import re
import subprocess
import sys

HEAD = """# Parameters

Every parameter of a scene and of a study, as `suture_schema --format markdown` and `suture_schema --study --format markdown` print them. A
name such as Mesh/File is that of `--set "Mesh/File=mesh.msh"`. `suture_schema --format xml` prints a scene with all defaults.

`python3 doc/parameters.py build/drivers/suture_schema > doc/parameters.md` renews this page.

"""


def section(program, title, *options):
    text = subprocess.run([program, *options, "--format", "markdown"], capture_output=True, text=True, check=True).stdout
    text = re.sub(r"(?<!\.)\.\.(?!\.)", ".", text)
    text = re.sub(r"(?<=[^.|:;]) (?=\*[A-Z][^*|]*\*: )", ". ", text)  # the list of choices is a sentence of its own
    text = text.replace("&lt;&lt;", "&lt;").replace(">>", ">")
    text = re.sub(r"^## \(top\)\n+", "", text, flags=re.M)
    return f"## {title}\n\n" + re.sub(r"^## ", "### ", text, flags=re.M).strip() + "\n"


def main():
    page = HEAD + section(sys.argv[1], "A scene") + "\n" + section(sys.argv[1], "A study", "--study")
    if "--check" not in sys.argv:
        sys.stdout.write(page)
        return 0
    file = pathlib.Path(__file__).with_suffix(".md")
    difference = list(difflib.unified_diff(file.read_text().splitlines(), page.splitlines(), "doc/parameters.md", "suture_schema", lineterm=""))
    if difference:
        print("\n".join(difference))
        print("doc/parameters.md is not what the program says; renew it: python3 doc/parameters.py build/drivers/suture_schema > doc/parameters.md")
    return 1 if difference else 0


if __name__ == "__main__":
    sys.exit(main())
