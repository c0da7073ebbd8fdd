#!/usr/bin/python3
"""The page doc/materials_list.md, from the built-in materials that suture_schema prints. materials_list.py SUTURE_SCHEMA [--check]: prints
the page; --check compares it with the file beside this script instead."""
import sys

from generated_page import markdown, show_or_check

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

if __name__ == "__main__":
    sys.exit(show_or_check(__file__, HEAD + markdown("--materials")))
