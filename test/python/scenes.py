"""Scenes that the tests of the package share."""
import numpy


def blocks(press=-0.1, law=None, cell="Quadrilateral4", cells=8, **settings):
    """Two blocks pressed together: strain press / 2, no transverse strain. Blocks and results are those of two_blocks.xml."""
    side = {"Cells": [cells, cells], "Cell": cell, "Blocks": [2, 2], "X": [-1, 1]}
    return {
        "Title": "Two blocks", "Model": "Plane Strain",
        "Mesh": {"Generator": "Boxes", "Boxes": {"upper": dict(side, Y=[0, 1]), "lower": dict(side, Y=[-1, 0])}},
        "Bodies": {"upper": {"Material": "rubber"}, "lower": {"Material": "rubber"}},
        "Materials": {"rubber": law or {"Young Modulus": 2e6, "Poisson Ratio": 0.0}},
        "Boundary Conditions": {"press": {"Group": "upper_top", "Type": "Displacement", "Value": numpy.array([0.0, press])},
                                "ground": {"Group": "lower_bottom", "Type": "Displacement", "Value": (0, 0)}},
        "Contact": {"joint": {"Side A": "upper_bottom", "Side B": "lower_top"}},
        "Partition": {"Type": "Named Groups", "Named Groups": {"Pattern": "subdomain_*"}}, **settings}


def leaning(**settings):
    """The same with a lateral pressure and friction, so that no value is constant."""
    scene = blocks(law={"Young Modulus": 2e6, "Poisson Ratio": 0.3}, **settings)
    scene["Boundary Conditions"]["wind"] = {"Group": "upper_left", "Type": "Pressure", "Value": 2e4}
    scene["Contact"]["joint"].update({"Law": "Coulomb", "Coulomb": {"Coefficient": 0.4}})
    return scene


def bricks(cell, cells=(2, 2, 2)):
    """Two bricks on top of each other, 3D, under a pressure of 1e4 and a lateral one of 2e3."""
    side = {"Cells": list(cells), "Cell": cell, "X": [0, 1], "Y": [0, 1]}
    return {
        "Title": "Two bricks", "Model": "Solid",
        "Mesh": {"Generator": "Boxes", "Boxes": {"upper": dict(side, Z=[1, 2]), "lower": dict(side, Z=[0, 1])}},
        "Bodies": {"upper": {"Material": "rubber"}, "lower": {"Material": "rubber"}},
        "Materials": {"rubber": {"Young Modulus": 2e6, "Poisson Ratio": 0.3}},
        "Boundary Conditions": {"press": {"Group": "upper_top", "Type": "Pressure", "Value": 1e4},
                                "wind": {"Group": "upper_left", "Type": "Pressure", "Value": 2e3},
                                "hold": {"Group": "upper_right", "Type": "Bilateral"}, "side": {"Group": "upper_front", "Type": "Bilateral"},
                                "ground": {"Group": "lower_bottom", "Type": "Displacement", "Value": [0, 0, 0]}},
        "Contact": {"joint": {"Side A": "upper_bottom", "Side B": "lower_top"}}}
