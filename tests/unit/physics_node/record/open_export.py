#!/usr/bin/python3
"""Opens an export as VTK does: every file of record.pvd with vtkXMLPolyDataReader. Says what is there, as JSON.

Usage: open_export.py record.pvd [picture.png]
For each time: per part its file, points, cells, the enclosed volume, and the range of every array (of a vector, of its
length). With a second word draws the last time on a display that is there (xvfb-run), coloured by displacement, with arrows for the forces.
"""
import json
import math
import os
import sys
import xml.etree.ElementTree as xml

try:
    from vtkmodules.vtkCommonCore import VTK_FLOAT
    from vtkmodules.vtkFiltersCore import vtkMassProperties, vtkTriangleFilter
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
except ImportError as error:
    print(f"open_export.py: needs the Debian package python3-vtk9: {error}", file=sys.stderr)
    sys.exit(1)


def read(path):
    reader = vtkXMLPolyDataReader()
    if not reader.CanReadFile(path):
        sys.exit(f"open_export.py: {path}: VTK does not read it")
    reader.SetFileName(path)
    reader.Update()
    if reader.GetErrorCode() != 0:
        sys.exit(f"open_export.py: {path}: VTK's error {reader.GetErrorCode()}")
    return reader.GetOutput()


def volume_of(mesh):
    triangles = vtkTriangleFilter()
    triangles.SetInputData(mesh)
    properties = vtkMassProperties()
    properties.SetInputConnection(triangles.GetOutputPort())
    properties.Update()
    return properties.GetVolume()


def facts(path, t):
    mesh = read(path)
    arrays = {}
    for data in (mesh.GetPointData(), mesh.GetCellData()):
        for n in range(data.GetNumberOfArrays()):
            array = data.GetArray(n)
            if array.GetNumberOfTuples() not in (mesh.GetNumberOfPoints(), mesh.GetNumberOfCells()):
                sys.exit(f"open_export.py: {path}: {array.GetName()} is not as long as the mesh")
            arrays[array.GetName()] = array.GetRange(-1)
    if mesh.GetPoints().GetDataType() != VTK_FLOAT:
        sys.exit(f"open_export.py: {path}: points of another type")
    told = mesh.GetFieldData().GetArray("TimeValue").GetValue(0)
    used = {mesh.GetCell(n).GetPointId(c) for n in range(mesh.GetNumberOfCells())
            for c in range(mesh.GetCell(n).GetNumberOfPoints())}
    if len(used) != mesh.GetNumberOfPoints():
        sys.exit(f"open_export.py: {path}: {mesh.GetNumberOfPoints() - len(used)} points belong to nothing")
    corners = max((mesh.GetCell(n).GetNumberOfPoints() for n in range(mesh.GetNumberOfCells())), default=0)
    return {"file": os.path.basename(path), "t": t, "t_in_file": told, "points": mesh.GetNumberOfPoints(),
            "cells": mesh.GetNumberOfCells(), "corners": corners, "arrays": arrays, "bounds": mesh.GetBounds(),
            "volume": volume_of(mesh) if mesh.GetNumberOfPolys() else 0, "first": mesh.GetPoint(0) if mesh.GetNumberOfPoints() else None}


def draw(paths, picture):
    import vtkmodules.vtkInteractionStyle  # noqa: F401
    import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
    from vtkmodules.vtkFiltersCore import vtkGlyph3D
    from vtkmodules.vtkFiltersSources import vtkArrowSource
    from vtkmodules.vtkIOImage import vtkPNGWriter
    from vtkmodules.vtkRenderingCore import (vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow,
                                             vtkWindowToImageFilter)
    sources = []
    renderer = vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    for path in paths:
        mesh = read(path)
        mapper = vtkPolyDataMapper()
        mapper.SetInputData(mesh)
        if mesh.GetPointData().HasArray("force"):
            most = mesh.GetPointData().GetArray("force").GetRange(-1)[1]
            arrows = vtkGlyph3D()
            arrows.SetInputData(mesh)
            arrows.SetInputArrayToProcess(1, 0, 0, 0, "force")
            arrow = vtkArrowSource()
            sources.append(arrow)  # the pipeline does not keep it
            arrows.SetSourceConnection(arrow.GetOutputPort())
            arrows.SetScaleFactor(0.03 / most if most > 0 else 1)
            arrows.SetScaleModeToScaleByVector()
            arrows.SetVectorModeToUseVector()
            mapper.SetInputConnection(arrows.GetOutputPort())
            mapper.ScalarVisibilityOff()
        elif mesh.GetPointData().HasArray("displacement"):
            mapper.SetScalarModeToUsePointFieldData()
            mapper.SelectColorArray("displacement")
            mapper.SetScalarRange(0, mesh.GetPointData().GetArray("displacement").GetRange(-1)[1] or 1)
            mapper.GetLookupTable().SetVectorModeToMagnitude()
            mapper.GetLookupTable().SetHueRange(0.66, 0)
        else:
            mapper.SetScalarModeToUseCellFieldData()
            mapper.SelectColorArray("colour")
        actor = vtkActor()
        actor.SetMapper(mapper)
        renderer.AddActor(actor)
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetSize(900, 700)
    window.AddRenderer(renderer)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(-1, 1.6, 0.3)
    camera.SetViewUp(0, 0, 1)
    renderer.ResetCamera()
    window.Render()
    image = vtkWindowToImageFilter()
    image.SetInput(window)
    writer = vtkPNGWriter()
    writer.SetFileName(picture)
    writer.SetInputConnection(image.GetOutputPort())
    writer.Write()


def main(path, picture):
    folder = os.path.dirname(os.path.abspath(path))
    root = xml.parse(path).getroot()
    if root.get("type") != "Collection":
        sys.exit("open_export.py: no collection")
    times = {}
    for part in root.findall("Collection/DataSet"):
        times.setdefault(float(part.get("timestep")), {})[int(part.get("part"))] = os.path.join(folder, part.get("file"))
    steps = [{"t": t, "parts": [facts(file, t) for _, file in sorted(parts.items())]} for t, parts in times.items()]
    if [step["t"] for step in steps] != sorted(times):
        sys.exit("open_export.py: times do not grow")
    print(json.dumps(steps, default=lambda value: None if math.isnan(value) else value))
    if picture:
        draw(list(times[max(times)].values()), picture)


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit("usage: open_export.py record.pvd [picture.png]")
    main(sys.argv[1], sys.argv[2] if len(sys.argv) == 3 else "")
