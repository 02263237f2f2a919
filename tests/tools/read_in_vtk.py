# VTK reads a collection and its files; times, positions, speeds, strains and contacts are what they should be.
# python3 read_in_vtk.py CACHES NAME FPS GROUND-REACH: a cloth of quads over the plane y = 0
import struct
import sys
import xml.etree.ElementTree as tree

import vtk
from vtk.util.numpy_support import vtk_to_numpy
import numpy

folder, name, fps, reach = sys.argv[1], sys.argv[2], float(sys.argv[3]), float(sys.argv[4])


def samples():
    data = open(f"{folder}/{name}.pc2", "rb").read()
    points, count = struct.unpack_from("<i", data, 16)[0], struct.unpack_from("<i", data, 28)[0]
    return numpy.frombuffer(data, "<f4", offset=32).reshape(count, points, 3)


def read(file):
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(f"{folder}/{file}")
    reader.Update()
    assert reader.GetErrorCode() == 0, file
    return reader.GetOutput()


def edges_of(mesh):
    found = set()
    for c in range(mesh.GetNumberOfCells()):
        cell = mesh.GetCell(c)
        ids = [cell.GetPointId(k) for k in range(cell.GetNumberOfPoints())]
        found |= {tuple(sorted(pair)) for pair in zip(ids, ids[1:] + ids[:1])}
    return numpy.array(sorted(found))


def strain_at(points, edges, rest):
    one, other = edges[:, 0], edges[:, 1]
    length = lambda x: numpy.linalg.norm(x[one].astype(float) - x[other], axis=1)
    strain = numpy.abs(length(points) / length(rest) - 1)
    total, count = numpy.zeros(len(points)), numpy.zeros(len(points))
    for end in (one, other):
        numpy.add.at(total, end, strain)
        numpy.add.at(count, end, 1)
    return total / count


expected = samples()
entries = tree.parse(f"{folder}/{name}.pvd").getroot().findall("./Collection/DataSet")
assert len(entries) == len(expected), f"{len(entries)} files for {len(expected)} samples"
edges = edges_of(read(entries[0].get("file")))
touched = 0
for k, entry in enumerate(entries):
    mesh = read(entry.get("file"))
    assert abs(float(entry.get("timestep")) - k / fps) < 1e-12
    assert abs(mesh.GetFieldData().GetArray("TimeValue").GetValue(0) - k / fps) < 1e-12
    points = vtk_to_numpy(mesh.GetPoints().GetData())
    array = lambda what: vtk_to_numpy(mesh.GetPointData().GetArray(what))
    assert numpy.array_equal(points, expected[k])
    assert numpy.allclose(array("speed"), numpy.linalg.norm(array("velocity"), axis=1), rtol=1e-6)
    assert numpy.allclose(array("strain"), strain_at(points, edges, expected[0]), atol=1e-5)
    assert numpy.array_equal(array("contact"), points[:, 1] <= reach), k
    touched += array("contact").sum()
    assert mesh.GetPointData().GetTCoords() is not None
assert touched > 0, "nothing came down"
difference = numpy.abs((expected[2] - expected[0]) * fps / 2 - vtk_to_numpy(
    read(entries[1].get("file")).GetPointData().GetArray("velocity"))).max()
assert difference < 0.05, f"velocities are {difference} m/s off"
print(f"{len(entries)} files, {touched} contacts, velocities within {difference} m/s")
