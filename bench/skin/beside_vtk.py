#!/usr/bin/python3
"""A skin as palpate draws it, beside VTK's iso-surface of the same volume from the same place.

Usage: beside_vtk.py VOLUME.h5 FRAME.png LEVEL YAW_DEG PITCH_DEG DISTANCE_MM OUT.png
FRAME: of `palpate simulate`, 960 x 720, with that camera and target_mm = [0, 0, 0].
Needs the packages python3-vtk9, python3-h5py, python3-matplotlib, and a display (xvfb-run does).
"""
import math
import sys

import h5py
import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

FIELD_OF_VIEW_DEG = math.degrees(0.6)  # vertical: the default of [render]
PANEL_PX = 308  # of the frame, on its left
SKIN = (0.87, 0.70, 0.60)


def volume_of(path):
    """Cells about the middle of the image, as a scene puts them: x is turned round where the image is left-handed."""
    with h5py.File(path) as file:
        intensity = file["intensity"][:].astype("float32")
        spacing = [1e3 * s for s in file.attrs["spacing_m"]]
        matrix = file.attrs["orientation_lps"].reshape(3, 3) if "orientation_lps" in file.attrs else None
    if matrix is not None and vtk.vtkMath.Determinant3x3(matrix.tolist()) < 0:
        intensity = intensity[:, :, ::-1].copy()
    image = vtk.vtkImageData()
    image.SetDimensions(intensity.shape[::-1])
    image.SetSpacing(spacing)
    image.SetOrigin([-0.5 * s * (n - 1) for s, n in zip(spacing, intensity.shape[::-1])])
    image.GetPointData().SetScalars(numpy_to_vtk(intensity.ravel(), deep=True))
    return image


def drawn_by_vtk(image, level, yaw, pitch, distance, size):
    surface = vtk.vtkFlyingEdges3D()
    surface.SetInputData(image)
    surface.SetValue(0, level)
    largest = vtk.vtkPolyDataConnectivityFilter()
    largest.SetInputConnection(surface.GetOutputPort())
    largest.SetExtractionModeToLargestRegion()
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(largest.GetOutputPort())
    mapper.ScalarVisibilityOff()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(SKIN)
    renderer = vtk.vtkRenderer()
    renderer.AddActor(actor)
    renderer.SetBackground(0.8, 0.83, 0.88)
    camera = renderer.GetActiveCamera()
    towards = (math.sin(yaw) * math.cos(pitch), -math.cos(yaw) * math.cos(pitch), math.sin(pitch))
    camera.SetPosition([distance * t for t in towards])
    camera.SetFocalPoint(0, 0, 0)
    camera.SetViewUp(0, 0, 1)
    camera.SetViewAngle(FIELD_OF_VIEW_DEG)
    renderer.ResetCameraClippingRange()
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetSize(size)
    window.AddRenderer(renderer)
    window.Render()
    grab = vtk.vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.Update()
    picture = grab.GetOutput()
    width, height, _ = picture.GetDimensions()
    return vtk_to_numpy(picture.GetPointData().GetScalars()).reshape(height, width, -1)[::-1]


def main(volume, frame, level, yaw, pitch, distance, out):
    ours = plt.imread(frame)[:, PANEL_PX:, :3]
    height, width = ours.shape[:2]
    theirs = drawn_by_vtk(volume_of(volume), float(level), math.radians(float(yaw)), math.radians(float(pitch)),
                          float(distance), (width, height))
    figure, axes = plt.subplots(1, 2, figsize=(2 * width / 120, height / 120 + 0.3), dpi=120)
    for axis, picture, title in zip(axes, (ours, theirs), ("palpate", "VTK " + vtk.vtkVersion().GetVTKVersion())):
        axis.imshow(picture)
        axis.set_title(title, fontsize=10)
        axis.axis("off")
    figure.tight_layout(pad=0.3)
    figure.savefig(out)


if __name__ == "__main__":
    main(*sys.argv[1:])
