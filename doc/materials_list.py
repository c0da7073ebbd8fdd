#!/usr/bin/python3
"""The page doc/materials_list.md, from the built-in materials that suture_schema prints. materials_list.py SUTURE_SCHEMA [--check]: prints
the page; --check compares it with the file beside this script instead."""
import difflib
import pathlib
import subprocess
import sys

HEAD = """# Built-in materials

A scene names one of these materials in `Bodies/<body>/Material` ([how](materials_and_loads.md#named-materials)); its values are converted to
the scene's `Units`. `suture_schema --materials` prints this list.

The values are for a first design. Strengths are the least values of the standards for the product and thickness in the second column. Where
no standard fixes a value, the last table calls it typical, with its range: compare with the data sheet or the test of your material. No value
includes a partial safety factor. `Strength` is the criterion of the [safety factors](materials_and_loads.md#safety-factors). nu: Poisson
ratio; expansion: thermal expansion.

`python3 doc/materials_list.py build/drivers/suture_schema > doc/materials_list.md` renews this page from
`packages/elasticity/materials/materials.xml`, which is installed as `share/suture/materials.xml`.

"""


def main():
    text = subprocess.run([sys.argv[1], "--materials", "--format", "markdown"], capture_output=True, text=True, check=True).stdout
    page = HEAD + text
    if "--check" not in sys.argv:
        sys.stdout.write(page)
        return 0
    file = pathlib.Path(__file__).with_suffix(".md")
    difference = list(difflib.unified_diff(file.read_text().splitlines(), page.splitlines(), "doc/materials_list.md", "suture_schema", lineterm=""))
    if difference:
        print("\n".join(difference))
        print("renew it: python3 doc/materials_list.py build/drivers/suture_schema > doc/materials_list.md")
    return 1 if difference else 0


if __name__ == "__main__":
    sys.exit(main())
