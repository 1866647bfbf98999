"""Inside Blender: opens_run.py ADD_ON_FOLDER RUN [PICTURE]. Prints facts, and ends with 0 where all hold."""

import sys

import bpy
import numpy

where, run, *picture = sys.argv[sys.argv.index("--") + 1:]
sys.path.insert(0, where)
import gracilis_run  # noqa: E402
from gracilis_run.vtp import read_surface  # noqa: E402


def points(made, shaped=False):
    mesh = made.evaluated_get(bpy.context.evaluated_depsgraph_get()).data if shaped else made.data
    held = numpy.empty(3 * len(mesh.vertices), "f4")
    mesh.vertices.foreach_get("co", held)
    return held.reshape(-1, 3)


def on_disk(made, frame):
    return read_surface(f"{run}/frames/{made['gracilis_name']}_{frame:04d}.vtp")[0].astype("f4")


def check(fact, holds):
    print("holds" if holds else "FAILS", fact)
    if not holds:
        sys.exit(1)


gracilis_run.register()
for made in list(bpy.data.objects):
    bpy.data.objects.remove(made)
scene = bpy.context.scene
check("the operator opens it", bpy.ops.import_scene.gracilis_run(directory=run) == {"FINISHED"})
root = next(o for o in scene.objects if "gracilis_run" in o)
surfaces = list(root.children)
last = scene.frame_end - scene.frame_start
check(f"there are surfaces ({len(surfaces)}) and frames ({last})", len(surfaces) >= 3 and last >= 2)
for frame in (last, 1):
    scene.frame_set(scene.frame_start + frame)
    check(f"surfaces are those of frame {frame}", all(numpy.array_equal(points(o), on_disk(o, frame)) for o in surfaces))
bone = next(o for o in surfaces if o["gracilis_name"].startswith("hip_bone"))
femur = next(o for o in surfaces if o["gracilis_name"].startswith("femur"))
middle = lambda o: numpy.mean([o.matrix_world @ v.co for v in o.data.vertices], axis=0)
bpy.context.view_layer.update()
check("the femur lies below the hip bone", middle(femur)[2] < middle(bone)[2] - 0.1)

try:
    ended = bpy.ops.import_scene.gracilis_run(directory=run + "/plots")
except RuntimeError as error:  # how scripts hear of an operator's report
    ended = {"CANCELLED"} if "holds no frames" in str(error) else {"?"}
check("a folder without frames is refused", ended == {"CANCELLED"})

if picture:
    light = bpy.data.objects.new("light", bpy.data.lights.new("light", "SUN"))
    light.data.energy = 3
    light.rotation_euler = (0.6, 0.2, 0.5)
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.location, camera.rotation_euler = (-1.2, -1.2, -0.05), (1.57, 0, -0.785)
    for made in (light, camera):
        scene.collection.objects.link(made)
    scene.camera = camera
    scene.world.color = (1, 1, 1)
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.use_denoising = 16, False
    scene.render.resolution_x, scene.render.resolution_y = 500, 500
    scene.render.filepath = picture[0]
    scene.frame_set(scene.frame_end)
    bpy.ops.render.render(write_still=True)

gracilis_run.open_run(bpy.context, run, keep=True)
kept = [o for o in bpy.data.objects if o.type == "MESH" and o.data.shape_keys]
check("kept frames are shape keys", len(kept) == len(surfaces))
scene.frame_set(scene.frame_start + 2)
bpy.context.view_layer.update()
check("which follow the timeline", all(numpy.allclose(points(o, True), on_disk(o, 2), atol=1e-6) for o in kept))
gracilis_run.unregister()
