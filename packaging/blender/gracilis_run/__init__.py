"""Blender add-on: opens a run folder of Gracilis (File > Import). Its muscles and bones follow the timeline.

By default each frame's file is read when the timeline comes to it, so the folder must stay where it is. With "Keep in the
file" all frames become shape keys of the .blend file.
"""

import functools
import json
import pathlib

import bpy
import numpy
from bpy.app.handlers import persistent
from mathutils import Matrix, Vector

from .vtp import read_surface

bl_info = {
    "name": "Gracilis runs",
    "description": "Opens run folders of Gracilis: muscles and bones that follow the timeline",
    "author": "The Gracilis maintainers",
    "version": (0, 1, 0),
    "blender": (3, 0, 0),
    "location": "File > Import > Gracilis run",
    "category": "Import-Export",
}

colors = {"muscle": (0.45, 0.08, 0.06, 1), "bone": (0.82, 0.76, 0.62, 1)}


def frame_files(folder):
    """Per name of a surface its files in the order of frames; refuses what is no run, or a compact one."""
    files = {}
    for file in sorted((pathlib.Path(folder) / "frames").glob("*_*.vtp")):
        files.setdefault(file.stem.rpartition("_")[0], []).append(file)
    if not files:
        raise ValueError(f"{folder} holds no frames/NAME_0000.vtp; of a compact run: gracilis export RUN --to surfaces")
    return files


@functools.lru_cache(maxsize=256)
def points_of(file):
    return read_surface(file)[0].astype("f4").ravel()


def material(kind):
    name = "Gracilis " + kind
    made = bpy.data.materials.get(name)
    if made is None:
        made = bpy.data.materials.new(name)
        made.diffuse_color = colors[kind]
        made.use_nodes = True
        made.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = colors[kind]
    return made


def upright(folder):
    """Takes the frame of the files to Blender's: up is z, and the front looks along -y."""
    try:
        axes = json.loads((pathlib.Path(folder) / "run.json").read_text())["axes"]
    except (OSError, KeyError, ValueError):
        axes = {}
    forward = Vector(axes.get("anterior", (1, 0, 0)))
    up = Vector(axes.get("superior", (0, 1, 0)))
    return Matrix((-forward.cross(up), -forward, up)).to_4x4()


def add_object(name, files, root, collection):
    points, faces, arrays = read_surface(files[0])
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(points.tolist(), [], faces.tolist())
    mesh.polygons.foreach_set("use_smooth", numpy.ones(len(faces), bool))
    mesh.materials.append(material("muscle" if arrays else "bone"))
    made = bpy.data.objects.new(name, mesh)
    made.parent = root
    made["gracilis_name"] = name
    collection.objects.link(made)
    return made


def keep_frames(made, files, first):
    """A shape key per frame, each at 1 in its own frame and at 0 in the others."""
    made.shape_key_add(name="Basis")
    for number, file in enumerate(files):
        key = made.shape_key_add(name=f"frame {number}")
        key.data.foreach_set("co", points_of(str(file)))
        for frame, value in ((number - 1, 0), (number, 1), (number + 1, 0)):
            key.value = value
            key.keyframe_insert("value", frame=first + frame)


def open_run(context, folder, keep=False):
    """Puts the run into a collection of its own; the timeline's first frame is the capture pose. Says its root."""
    folder = pathlib.Path(folder).resolve()
    files = frame_files(folder)
    collection = bpy.data.collections.new(folder.name)
    context.scene.collection.children.link(collection)
    root = bpy.data.objects.new(folder.name, None)
    root.matrix_world = upright(folder)
    collection.objects.link(root)
    first = context.scene.frame_start
    for name, own in files.items():
        made = add_object(name, own, root, collection)
        if keep:
            keep_frames(made, own, first)
    if not keep:
        root["gracilis_run"] = str(folder)
        root["gracilis_first"] = first
    context.scene.frame_end = first + max(len(own) for own in files.values()) - 1
    return root


@persistent
def follow(scene, _depsgraph=None):
    """Takes every run that is read from disk to the timeline's frame; one whose folder is gone stays as it is."""
    for root in scene.objects:
        if "gracilis_run" not in root:
            continue
        folder = pathlib.Path(root["gracilis_run"])
        for made in root.children:
            number = max(0, scene.frame_current - root["gracilis_first"])
            file = folder / "frames" / f"{made['gracilis_name']}_{number:04d}.vtp"
            if file.exists():
                made.data.vertices.foreach_set("co", points_of(str(file)))
                made.data.update()


class OpenRun(bpy.types.Operator):
    bl_idname = "import_scene.gracilis_run"
    bl_label = "Gracilis run"
    bl_description = "Open a run folder of Gracilis"
    bl_options = {"REGISTER", "UNDO"}

    directory: bpy.props.StringProperty(subtype="DIR_PATH")
    keep: bpy.props.BoolProperty(name="Keep in the file", description="All frames as shape keys, without the folder")

    def execute(self, context):
        try:
            open_run(context, self.directory, self.keep)
        except ValueError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}

    def invoke(self, context, _event):
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}


def menu(self, _context):
    self.layout.operator(OpenRun.bl_idname)


def register():
    bpy.utils.register_class(OpenRun)
    bpy.types.TOPBAR_MT_file_import.append(menu)
    bpy.app.handlers.frame_change_pre.append(follow)


def unregister():
    bpy.app.handlers.frame_change_pre.remove(follow)
    bpy.types.TOPBAR_MT_file_import.remove(menu)
    bpy.utils.unregister_class(OpenRun)
