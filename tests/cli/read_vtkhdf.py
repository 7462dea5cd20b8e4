"""Reads a VTKHDF file with h5py and numpy and, if it is installed, with VTK. Computes the net forces on the grains
from the file. Uses no code of floc.

Usage: read_vtkhdf.py FILE [largest net force allowed, in units of the largest contact force]
"""

import sys

import h5py
import numpy as np


def layout(group):
    """Checks that the group has the datasets of VTK's specification of UnstructuredGrid. Returns the numbers of
    points and cells."""
    assert list(group.attrs["Version"]) == [1, 0], group.attrs["Version"]
    assert group.attrs["Type"] == b"UnstructuredGrid", group.attrs["Type"]
    n_points, n_cells, n_ids = (int(group[f"NumberOf{kind}"][0]) for kind in ("Points", "Cells", "ConnectivityIds"))
    assert group["Points"].shape == (n_points, 3) and group["Connectivity"].shape == (n_ids,)
    offsets, types = group["Offsets"][:], group["Types"][:]
    assert offsets.shape == (n_cells + 1,) and types.shape == (n_cells,) and types.dtype == np.uint8
    assert offsets[0] == 0 and offsets[-1] == n_ids
    assert np.array_equal(np.diff(offsets), np.where(types == 1, 1, 2)) and set(types) <= {1, 3}
    for name, n in (("PointData", n_points), ("CellData", n_cells)):
        for array in group[name].values():
            assert array.shape[0] == n, array.name
    return n_points, n_cells


def net_forces(group):
    """Sums the forces of the contacts on each grain. The normal force is positive in tension: it then pulls the first
    grain towards the second."""
    x = group["Points"][:]
    n_grains = int((group["Types"][:] == 1).sum())
    lines = group["Connectivity"][n_grains:].reshape(-1, 2)
    cells = {name: array[n_grains:] for name, array in group["CellData"].items()}
    of_id = {int(i): k for k, i in enumerate(group["PointData/id"][:n_grains])}
    net = np.zeros((n_grains, 3))
    if "gravity" in group["FieldData"]:
        net += group["PointData/mass"][:n_grains].reshape(-1, 1) * group["FieldData/gravity"][:].reshape(1, 3)
    for k, (first, end) in enumerate(lines):
        along = x[end] - x[first]
        force = cells["normal_force"][k] * along / np.linalg.norm(along) + cells["shear_force"][k]
        net[first] += force
        if cells["wall"][k] < 0:
            net[of_id[int(cells["id2"][k])]] -= force
    return net, np.abs(cells["normal_force"]).max()


def compare_with_vtk(path, group):
    """Opens the file as ParaView does, where VTK is installed, and requires that VTK reads the arrays of the file."""
    try:
        from vtkmodules.util.numpy_support import vtk_to_numpy
        from vtkmodules.vtkIOHDF import vtkHDFReader
    except ImportError:
        return "VTK is not installed"
    reader = vtkHDFReader()
    assert reader.CanReadFile(path)
    reader.SetFileName(path)
    reader.Update()
    data = reader.GetOutput()
    assert np.array_equal(vtk_to_numpy(data.GetPoints().GetData()), group["Points"][:])
    n_points, n_cells = data.GetNumberOfPoints(), data.GetNumberOfCells()
    for name, read, n in (("PointData", data.GetPointData(), n_points), ("CellData", data.GetCellData(), n_cells)):
        assert read.GetNumberOfArrays() == len(group[name]), name
        for array in group[name]:
            assert np.array_equal(vtk_to_numpy(read.GetArray(array)).reshape(-1), group[name][array][:].reshape(-1)), array
    offsets, connectivity = group["Offsets"][:], group["Connectivity"][:]
    assert n_cells == len(group["Types"])
    for k in range(n_cells):
        cell = data.GetCell(k)
        assert cell.GetCellType() == group["Types"][k]
        assert [cell.GetPointId(p) for p in range(cell.GetNumberOfPoints())] == list(connectivity[offsets[k]:offsets[k + 1]])
    return "read by VTK"


def main(path, allowed):
    with h5py.File(path, "r") as file:
        group = file["VTKHDF"]
        n_points, n_cells = layout(group)
        net, largest = net_forces(group)
        vtk = compare_with_vtk(path, group)
    worst = np.linalg.norm(net, axis=1).max() / largest
    if not worst <= allowed:
        sys.exit(f"the largest net force is {worst}, allowed {allowed}")
    print(f"{n_points} points, {n_cells} cells, {vtk}")


if __name__ == "__main__":
    main(sys.argv[1], float(sys.argv[2]) if len(sys.argv) > 2 else 1e-9)
