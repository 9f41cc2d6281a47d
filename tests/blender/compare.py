"""Run by Blender: imports an exported scene and compares the transforms of its objects with those of the scene.

    blender -b --factory-startup --python compare.py -- SCENE GLB
"""

import sys

import bpy
import numpy as np

import aleph

TIMES = 50
np.bool = bool  # the importer of Blender 3.4 names it; newer numpy has it no more

scene_file, exported = sys.argv[sys.argv.index("--") + 1:]
scene = aleph.load(scene_file)
bpy.ops.wm.read_factory_settings(use_empty=True)
first, last = scene.frames
bpy.context.scene.render.fps = round(scene.fps)
bpy.context.scene.render.fps_base = round(scene.fps) / scene.fps
bpy.ops.import_scene.gltf(filepath=exported)

# Blender's z is up, and its y points away.
to_blender = np.array([[1, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1]], float)
names = [node.name for node in scene.nodes]
# Blender turns cameras and lights about, and shortens long names.
expected = [node for node in scene.nodes if node.camera is None and node.light is None
            and names.count(node.name) == 1 and len(node.name.encode()) < 64]
compared = [node for node in expected if node.name in bpy.data.objects]
largest, size, worst = 0.0, 0.0, ""
for frame in np.unique(np.linspace(first, last, TIMES).round().astype(int)):
    bpy.context.scene.frame_set(int(frame))
    world = scene.worlds(int(frame))
    for node in compared:
        ours = to_blender @ world[node.index] @ to_blender.T
        theirs = np.array(bpy.data.objects[node.name].matrix_world)
        size = max(size, np.abs(ours).max())
        difference = np.abs(ours - theirs).max()
        if difference > largest:
            largest, worst = difference, f"{node.name} at frame {frame}"
print(f"compared {len(compared)} of {len(names)} nodes: at most {largest:.2e} apart, {largest / max(size, 1):.2e} of "
      f"the scene's size ({worst})")
if len(compared) < len(expected) or largest > 2e-6 * max(size, 1):
    sys.exit(1)
