# Draws docs/images/export_blender.png: the drape's rest mesh, played from its PC2 by Blender and drawn by Cycles.
# blender -b --factory-startup --python docs/export_blender.py -- CACHES FRAME TEXTURE PICTURE
import math
import os
import sys

import bpy

folder, frame, texture, picture = sys.argv[sys.argv.index("--") + 1:]
scene = bpy.context.scene
for thing in list(bpy.data.objects):
    bpy.data.objects.remove(thing)


def lay_on(body, texture):
    material = bpy.data.materials.new("cloth")
    material.use_nodes = True
    image = material.node_tree.nodes.new("ShaderNodeTexImage")
    image.image = bpy.data.images.load(os.path.abspath(texture))
    shader = material.node_tree.nodes["Principled BSDF"]
    material.node_tree.links.new(image.outputs["Color"], shader.inputs["Base Color"])
    shader.inputs["Roughness"].default_value = 0.8
    body.data.materials.clear()
    body.data.materials.append(material)


# The three lines of docs/export.md.
bpy.ops.wm.obj_import(filepath=f"{folder}/drape.rest.obj")
cache = bpy.context.object.modifiers.new("billow", "MESH_CACHE")
cache.cache_format, cache.filepath, cache.frame_start = "PC2", f"{folder}/drape.pc2", 1

body = bpy.context.object
lay_on(body, texture)
for polygon in body.data.polygons:
    polygon.use_smooth = True
scene.frame_set(int(frame))
sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
sun.data.energy, sun.rotation_euler = 3.0, (math.radians(50), math.radians(10), math.radians(35))
scene.collection.objects.link(sun)
camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
camera.location, camera.rotation_euler = (0.5, -2.4, 0.2), (math.radians(78), 0, 0)
scene.collection.objects.link(camera)
bpy.context.view_layer.update()
scene.camera = camera
bpy.ops.object.select_all(action="DESELECT")
body.select_set(True)
bpy.ops.view3d.camera_to_view_selected()
camera.data.angle *= 1.15
scene.world.node_tree.nodes["Background"].inputs[0].default_value = (0.6, 0.65, 0.7, 1)
scene.render.engine = "CYCLES"
scene.cycles.samples, scene.cycles.use_denoising, scene.cycles.seed = 64, False, 0
scene.view_settings.view_transform = "Standard"
scene.render.resolution_x, scene.render.resolution_y = 480, 270
scene.render.filepath = os.path.abspath(picture)
bpy.ops.render.render(write_still=True)
