# Blender evaluates a point cache on the rest mesh and finds every vertex where the OBJ frames have it.
# blender -b --factory-startup --python-exit-code 1 --python read_in_blender.py -- CACHES NAME FRAMES [legacy]
# Blender's newer importer leaves out vertices of no face; the legacy one keeps them.
import sys

import bpy

folder, name, frames, *legacy = sys.argv[sys.argv.index("--") + 1:]


def positions_in(path):
    return [[float(x) for x in line.split()[1:4]] for line in open(path) if line.startswith("v ")]


def load(cache_format):
    rest = f"{folder}/{name}.rest.obj"
    if legacy:
        bpy.ops.import_scene.obj(filepath=rest, split_mode="OFF")
    else:
        bpy.ops.wm.obj_import(filepath=rest)
    body = bpy.context.selected_objects[0]
    cache = body.modifiers.new("cache", "MESH_CACHE")
    cache.cache_format = cache_format
    cache.filepath = f"{folder}/{name}.{cache_format.lower()}"
    cache.frame_start = 1
    return body


largest = 0.0
moved = 0.0
for cache_format in ("PC2", "MDD"):
    body = load(cache_format)
    first = positions_in(f"{folder}/{name}/frame_0001.obj")
    for frame in range(1, int(frames) + 1):
        bpy.context.scene.frame_set(frame)
        mesh = body.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
        expected = positions_in(f"{folder}/{name}/frame_{frame:04}.obj")
        assert len(mesh.vertices) == len(expected), f"{len(mesh.vertices)} vertices for {len(expected)}"
        for vertex, place, start in zip(mesh.vertices, expected, first):
            largest = max(largest, *(abs(a - b) for a, b in zip(vertex.co, place)))
            moved = max(moved, *(abs(a - b) for a, b in zip(place, start)))
    assert body.data.uv_layers, "no texture coordinates"
print(f"largest difference {largest}, moved {moved}")
assert moved > 1e-3, "nothing moved"
assert largest <= 1e-6, f"a vertex is {largest} m off"
