# Draws docs/images/export_paraview.png: one frame of a collection, coloured by its strain, by VTK as ParaView does it.
# /usr/bin/python3 docs/export_paraview.py COLLECTION FRAME PICTURE, under xvfb-run where there is no screen
import os
import sys
import xml.etree.ElementTree as tree

import vtk

collection, frame, picture = sys.argv[1], int(sys.argv[2]), sys.argv[3]
entry = tree.parse(collection).getroot().findall("./Collection/DataSet")[frame - 1]
reader = vtk.vtkXMLPolyDataReader()
reader.SetFileName(os.path.join(os.path.dirname(collection), entry.get("file")))
reader.Update()
mesh = reader.GetOutput()
mesh.GetPointData().SetActiveScalars("strain")

colours = vtk.vtkLookupTable()
colours.SetHueRange(0.62, 0.0)
colours.Build()
mapper = vtk.vtkPolyDataMapper()
mapper.SetInputData(mesh)
mapper.SetLookupTable(colours)
mapper.SetScalarRange(*mesh.GetPointData().GetArray("strain").GetRange())
actor = vtk.vtkActor()
actor.SetMapper(mapper)
actor.GetProperty().SetAmbient(0.5)
actor.GetProperty().SetDiffuse(0.5)
bar = vtk.vtkScalarBarActor()
bar.SetLookupTable(colours)
bar.SetTitle("strain")
bar.SetNumberOfLabels(4)
bar.SetWidth(0.1)
bar.SetHeight(0.8)
bar.SetPosition(0.85, 0.1)

renderer = vtk.vtkRenderer()
renderer.SetBackground(0.32, 0.34, 0.43)
renderer.AddActor(actor)
renderer.AddActor2D(bar)
window = vtk.vtkRenderWindow()
window.SetOffScreenRendering(1)
window.SetMultiSamples(0)
window.SetSize(480, 270)
window.AddRenderer(renderer)
renderer.GetActiveCamera().SetPosition(0.5, 0.3, 2.4)
renderer.GetActiveCamera().SetFocalPoint(0, 0, 0)
renderer.ResetCamera()
window.Render()

grab = vtk.vtkWindowToImageFilter()
grab.SetInput(window)
writer = vtk.vtkPNGWriter()
writer.SetFileName(picture)
writer.SetInputConnection(grab.GetOutputPort())
writer.Write()
