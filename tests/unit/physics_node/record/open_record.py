#!/usr/bin/python3
"""Opens a record the way a viewer does: by what record.xdmf says, into VTK data sets.

Usage: open_record.py record.xdmf STEPS POINTS [slab]
  STEPS  0: any number but none
  slab   it is the pressed slab of the tests: look at its volume, too
Debian's VTK is built without a reader of XDMF, so the XML is followed here, selection by selection as its
standard says, and VTK's own classes check that what comes out is a mesh.
"""
import os
import re
import sys
import xml.etree.ElementTree as xml


def stop(why):
    print(f"open_record.py: {why}", file=sys.stderr)
    sys.exit(1)


try:
    import h5py
    import numpy
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import VTK_QUAD, vtkCellArray, vtkPolyData
    from vtkmodules.vtkFiltersCore import vtkMassProperties, vtkTriangleFilter
except ImportError as error:
    stop(f"needs the Debian packages python3-vtk9 and python3-h5py: {error}")


def numbers(text):
    return [int(word) for word in text.split()]


def read_item(item, folder):
    """A DataItem as an array: of the file, or a hyperslab (start, stride, count) of another."""
    dimensions = numbers(item.get("Dimensions"))
    if item.get("ItemType") == "HyperSlab":
        selection, whole = item.findall("DataItem")
        start, stride, count = numpy.array(numbers(selection.text)).reshape(numbers(selection.get("Dimensions")))
        whole = read_item(whole, folder)
        slab = whole[tuple(slice(s, s + d * (c - 1) + 1, d) for s, d, c in zip(start, stride, count))]
        return slab.reshape(dimensions)
    name, path = re.fullmatch(r"\s*([^:]+):(.+?)\s*", item.text).groups()
    with h5py.File(os.path.join(folder, name), "r") as file:
        data = file[path]
        if list(data.shape) != dimensions:
            stop(f"{path} has the shape {data.shape}, the XML says {dimensions}")
        size = data.dtype.itemsize
        if size != int(item.get("Precision")):
            stop(f"{path} holds numbers of {size} bytes, the XML says {item.get('Precision')}")
        kind = {"Float": "f", "UInt": "u", "UChar": "u"}[item.get("NumberType")]
        if data.dtype.kind != kind:
            stop(f"{path} holds {data.dtype}, the XML says {item.get('NumberType')}")
        return data[...]


def mesh_of(grid, folder):
    """The grid as a VTK mesh of quadrilaterals."""
    points = vtkPoints()
    points.SetData(numpy_to_vtk(read_item(grid.find("Geometry/DataItem"), folder).astype(float), deep=True))
    quads = vtkCellArray()
    topology = grid.find("Topology")
    corners = read_item(topology.find("DataItem"), folder)
    if topology.get("TopologyType") != "Quadrilateral" or len(corners) != int(topology.get("NumberOfElements")):
        stop("the topology is not what it says")
    for quad in corners:
        quads.InsertNextCell(4)
        for corner in quad:
            quads.InsertCellPoint(int(corner))
    mesh = vtkPolyData()
    mesh.SetPoints(points)
    mesh.SetPolys(quads)
    flags = read_item(grid.find("Attribute[@Name='flags']/DataItem"), folder)
    mesh.GetPointData().AddArray(numpy_to_vtk(flags, deep=True))
    if mesh.GetNumberOfCells() and mesh.GetCellType(0) != VTK_QUAD:
        stop("VTK does not see quadrilaterals")
    return mesh


def volume_of(mesh):
    triangles = vtkTriangleFilter()
    triangles.SetInputData(mesh)
    properties = vtkMassProperties()
    properties.SetInputConnection(triangles.GetOutputPort())
    properties.Update()
    return properties.GetVolume()


def main(path, n_steps, n_points, slab_pressed):
    folder = os.path.dirname(path)
    steps = xml.parse(path).getroot().findall("Domain/Grid[@CollectionType='Temporal']/Grid")
    if not steps or n_steps not in (0, len(steps)):
        stop(f"{len(steps)} time steps, not {n_steps}")
    times = [float(step.find("Time").get("Value")) for step in steps]
    if times != sorted(set(times)):
        stop(f"times do not grow: {times}")
    volumes, heights = [], []
    for step in steps:
        mesh = mesh_of(step.find("Grid"), folder)
        if mesh.GetNumberOfPoints() != n_points or mesh.GetPointData().GetArray(0).GetNumberOfTuples() != n_points:
            stop(f"{mesh.GetNumberOfPoints()} points, not {n_points}")
        volumes.append(volume_of(mesh))
        heights.append(sum(mesh.GetPoint(n)[2] for n in range(n_points)) / n_points)
    if not slab_pressed:
        return
    slab = 48e-3 * 48e-3 * 20e-3
    if abs(volumes[0] - slab) > 0.01 * slab or min(volumes) < 0.5 * slab:
        stop(f"the volumes of the slab are {volumes}, at rest {slab}")
    if not heights[-1] < heights[0] - 1e-6:
        stop(f"nothing moves: {heights}")


if __name__ == "__main__":
    if len(sys.argv) not in (4, 5):
        stop("usage: open_record.py record.xdmf STEPS POINTS [slab]")
    main(sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), sys.argv[4:] == ["slab"])
