#!/usr/bin/python3
"""Reads the report of the test program Fields with VTK's own reader and compares it with the exact linear field of SampleRun.hpp."""
import sys

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import VTK_LINE, VTK_TRIANGLE, VTK_VERTEX
from vtkmodules.vtkIOHDF import vtkHDFReader


def read(path):
    reader = vtkHDFReader()
    assert reader.CanReadFile(path), f"VTK does not recognise {path}"
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def arrays(data):
    return {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)) for i in range(data.GetNumberOfArrays())}


def same(what, found, expected, tolerance):
    worst = np.abs(np.asarray(found) - expected).max()
    scale = np.abs(expected).max()
    assert worst <= tolerance * scale, f"{what}: off by {worst:g} of {scale:g}"
    print(f"{what}: off by {worst:g} of {scale:g}")


folder = sys.argv[1]
grid = read(f"{folder}/fields_0000.vtkhdf")
points = vtk_to_numpy(grid.GetPoints().GetData())
point_data, cell_data = arrays(grid.GetPointData()), arrays(grid.GetCellData())

assert grid.GetNumberOfCells() == 72
assert {grid.GetCellType(i) for i in range(72)} == {VTK_TRIANGLE}
gradient = np.array([[1e-3, 2e-3, 0], [-5e-4, 3e-3, 0], [0, 0, 0]])
same("Displacement", point_data["Displacement"], points @ gradient.T, 1e-15)

young, poisson = 2e6, 0.25
strain = 0.5 * (gradient + gradient.T)
mu = young / (2 * (1 + poisson))
stress = young * poisson / ((1 + poisson) * (1 - 2 * poisson)) * np.trace(strain) * np.eye(3) + 2 * mu * strain
same("Stress", cell_data["Stress"], np.tile([stress[0, 0], stress[1, 1], stress[2, 2], stress[0, 1], stress[1, 2], stress[0, 2]], (72, 1)), 1e-12)
deviator = stress - np.trace(stress) / 3 * np.eye(3)
same("VonMises", cell_data["VonMises"], np.full(72, np.sqrt(1.5 * (deviator**2).sum())), 1e-12)
in_plane = np.sort(np.linalg.eigvalsh(stress[:2, :2]))[::-1]
same("PrincipalStress", cell_data["PrincipalStress"], np.tile([*in_plane, stress[2, 2]], (72, 1)), 1e-12)

same("NodalStress", point_data["NodalStress"], np.tile([stress[0, 0], stress[1, 1], stress[2, 2], stress[0, 1], 0, 0], (len(points), 1)), 1e-11)
same("NodalVonMises", point_data["NodalVonMises"], np.full(len(points), np.sqrt(1.5 * (deviator**2).sum())), 1e-11)
same("NodalPrincipalStress", point_data["NodalPrincipalStress"], np.tile(np.linalg.eigvalsh(stress)[::-1], (len(points), 1)), 1e-11)

# Names that ParaView shows as field data.
names = {}
for i in range(grid.GetFieldData().GetNumberOfArrays()):
    array = grid.GetFieldData().GetAbstractArray(i)
    names[array.GetName()] = [array.GetVariantValue(k).ToString() for k in range(array.GetNumberOfTuples())]
assert names["BodyNames"] == ["lower", "upper"], names
assert names["MaterialNames"] == ["rock"], names
assert names["SubdomainNames"] == ["subdomain_lower_0_0", "subdomain_lower_1_0", "subdomain_upper_0_0"], names
assert "upper_top" in names["GroupNames"] and sorted(names["GroupNames"]) == names["GroupNames"], names
assert (cell_data["Material"] == 0).all()

# Cells refer to the right points: every subdomain has its area, every body its place.
area = {0: 0.0, 1: 0.0, 2: 0.0}
for i in range(72):
    corner = points[[grid.GetCell(i).GetPointId(k) for k in range(3)]]
    signed = 0.5 * np.cross(corner[1] - corner[0], corner[2] - corner[0])[2]
    assert signed > 0, f"cell {i} is turned over"
    area[int(cell_data["Subdomain"][i])] += signed
    assert (corner[:, 1].mean() > 1) == (cell_data["Body"][i] == 1), f"cell {i} is in the wrong body"
same("area of the subdomains", [area[0], area[1], area[2]], np.array([1.0, 1.0, 2.0]), 1e-14)
# Points with one number are one place.
place = {}
for number, point in zip(point_data["NodeId"], points):
    assert np.array_equal(place.setdefault(int(number), point), point)
assert len(place) == 2 * 7 * 4

contact = read(f"{folder}/contact_0000.vtkhdf")
data = arrays(contact.GetPointData())
assert [contact.GetCellType(i) for i in range(contact.GetNumberOfCells())] == [VTK_LINE, VTK_LINE, VTK_VERTEX]
same("ContactPressure", data["ContactPressure"], np.array([4.0, 6.0, 0.0, 10.0]), 0)
same("Gap", data["Gap"], np.array([0.0, -1e-15, 4e-3, 0.0]), 0)
same("Active", data["Active"], np.array([1, 1, 0, 1]), 0)
same("Normal", data["Normal"], np.array([[0, 1, 0], [0, 1, 0], [0, 1, 0], [0.6, 0.8, 0]]), 0)
same("ArcLength", data["ArcLength"], np.array([0, 0.5, 1.0, 0.0]), 0)
for name in ("InitialGap", "ContactForce", "Displacement", "Pair", "Line", "Piece"):
    assert name in data, f"{name} is missing"
