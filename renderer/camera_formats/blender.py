"""Blender's cameras: a script that creates them, and the values that people copy out by hand.

A camera looks along -z with y up: the columns of matrix_world, normalised, are u, v, w and eye.
The world is not converted, in either direction: Blender's has z up and Lucida's y, by custom only.
The picture is `sensor / lens` wide (perspective) or `ortho_scale` (parallel), along its longer side
or the side that sensor_fit names. shift_x and shift_y move it, in units of that side.
Panoramic cameras are in blender_panorama.py.
Source: Blender, source/blender/blenkernel/intern/camera.cc, BKE_camera_params_compute_viewplane().
"""

from __future__ import annotations

import math
import pprint
import re
from collections.abc import Sequence

from renderer.camera import Camera, Size
from renderer.camera_checks import listed, told_apart
from renderer.camera_formats import blender_panorama
from renderer.camera_formats.blender_camera import DEFAULTS, KNOWN, TURNS, posed
from renderer.camera_formats.blender_values import Found, Values, script, tables
from renderer.camera_formats.entries import errors_within, in_image
from renderer.camera_formats.given import Given, Options
from renderer.camera_formats.posed import CameraSet, PosedCamera
from renderer.camera_formats.rigid import UNSEEN_PX, pose_of, rigid
from renderer.errors import LucidaError
from renderer.scene.reading import check_bytes

LENSES = blender_panorama.LENSES
LARGEST_SCRIPT_BYTES = 1 << 24
MOST_PIXEL_ASPECT = 200  # Blender's own bounds
LEAST_LENS = 1.0
_HINTS = re.compile(r"\b(bpy|matrix_world|rotation_euler|sensor_width|ortho_scale|resolution_x)\b")
AXES = "the world as it is: z is up where Blender's scene has it so"


def recognises(given: Given) -> bool:
    return given.is_text and _HINTS.search(given.text) is not None


def read(given: Given, options: Options) -> CameraSet:
    if given.json is not None:
        found: list[Found] = [(values, {}) for values in tables(given.json, KNOWN | {"name"})]
    else:
        check_bytes(len(given.data), LARGEST_SCRIPT_BYTES, given.name)
        found = script(given.text, KNOWN)
    cameras, left_out = [], dict[str, None]()
    for index, (values, lines) in enumerate(found):
        try:
            if not values.keys() & (TURNS | {"location"}):
                remedy = "give it, or location and rotation_euler"
                raise LucidaError("matrix_world", "is missing", remedy)
            cameras.append(posed(values, options))
        except LucidaError as error:
            if line := lines.get(error.field):
                field = f"line {line}: {error.field}"
                raise LucidaError(field, error.problem, error.remedy) from None
            raise error.within(f"cameras[{index}]") if len(found) > 1 else error from None
        left_out |= dict.fromkeys(_left_out(values, options))
    taken = ["camera to world, y up, -z forward", AXES]
    if left_out:
        told = ", ".join(f"{name} {DEFAULTS[name]}" for name in left_out)
        taken.append(f"what is not given is Blender's own: {told}")
    return CameraSet("blender", tuple(cameras), tuple(taken))


def _left_out(values: Values, options: Options) -> list[str]:
    """Return the names of the missing values that determine a camera's field of view."""
    names = ["ortho_scale"] if values.get("type") == "ORTHO" else ["lens", "sensor_width"]
    if values.get("type") == "PANO":
        names = list(blender_panorama.needed(values))
    if any(name.startswith("angle") for name in values):
        names.remove("lens")
    if options.size is None:
        names += ["resolution_x", "resolution_y"]
    return [name for name in names if name not in values]


def write(cameras: Sequence[PosedCamera], options: Options) -> dict[str, bytes]:
    entries: list[Values] = []
    render: dict[str, float] = {}
    for one in cameras:
        with errors_within(one.name):
            camera, size = in_image(one, options, "Blender")
            entry, its_render = _entry(camera, size)
            for key, value in its_render.items():
                known = float(render.setdefault(key, value) or 0.0)
                rounding = 0.0 if isinstance(value, int) else 2 * UNSEEN_PX / max(size)
                if not math.isclose(known, value, rel_tol=rounding):
                    own, others = told_apart(value, known)
                    problem = f"{own} differs from another camera's {others}"
                    remedy = "choose one camera: a Blender scene has one"
                    raise LucidaError(key, problem, remedy)
        entries.append({"name": one.name or "Lucida"} | entry)
    parts = {"cameras": entries, "render": render}
    texts = {name: pprint.pformat(part, sort_dicts=False) for name, part in parts.items()}
    return {"": _SCRIPT.format(**texts).encode()}


_SCRIPT = '''\
"""Cameras from Lucida: open this in Blender's text editor and run it.

The world is as it was, no axis is changed: where a model was turned on its way into Blender, as
importers do that make y up into z up, give these cameras the same turn.
"""

import bpy
from mathutils import Matrix

CAMERAS = {cameras}

RENDER = {render}

scene = bpy.context.scene
for entry in CAMERAS:
    data = bpy.data.cameras.new(entry["name"])
    for key, value in entry.items():
        if key not in ("name", "matrix_world"):
            setattr(data if hasattr(data, key) else data.cycles, key, value)
    if data.type == "PANO":
        scene.render.engine = "CYCLES"
    camera = bpy.data.objects.new(entry["name"], data)
    camera.matrix_world = Matrix(entry["matrix_world"])
    scene.collection.objects.link(camera)
    scene.camera = camera
for key, value in RENDER.items():
    setattr(scene.render, key, value)
'''


def _entry(camera: Camera, size: Size) -> tuple[Values, dict[str, float]]:
    """Return a camera's values, and those of the scene's render settings.

    sensor_fit is HORIZONTAL, so that the width alone determines the field of view, and all shifts
    are in widths.
    """
    camera = rigid(camera, "Blender", size)
    left, right, bottom, top = camera.viewport
    seen = right - left
    stretch = (top - bottom) / size[1] / (seen / size[0])  # a pixel's height over its width
    if not 1 / MOST_PIXEL_ASPECT <= stretch <= MOST_PIXEL_ASPECT:
        problem = f"{listed(camera.viewport)} has pixels {stretch:g} times as high as wide"
        remedy = f"stay within {MOST_PIXEL_ASPECT}, as Blender does"
        raise LucidaError("viewport", problem, remedy)
    shifts = {"shift_x": (left + right) / 2 / seen, "shift_y": (bottom + top) / 2 / seen}
    entry: Values
    if camera.lens is not None:
        entry = blender_panorama.entry(camera)
    elif camera.is_parallel:
        entry = {"type": "ORTHO", "ortho_scale": seen, "sensor_fit": "HORIZONTAL", **shifts}
    else:
        sensor = max(36.0, LEAST_LENS * seen / camera.distance)
        lens = max(LEAST_LENS, sensor * camera.distance / seen)
        entry = {"type": "PERSP", "sensor_fit": "HORIZONTAL", "sensor_width": sensor, "lens": lens}
        entry |= shifts
    for key, value in (("clip_start", camera.near), ("clip_end", camera.far)):
        if value is not None:
            entry[key] = value
    entry["matrix_world"] = [tuple(row) for row in pose_of(camera).tolist()]
    render: Values = {
        "resolution_x": size[0],
        "resolution_y": size[1],
        "resolution_percentage": 100,
    }
    render |= {"pixel_aspect_x": max(1.0, 1 / stretch), "pixel_aspect_y": max(1.0, stretch)}
    return entry, render
