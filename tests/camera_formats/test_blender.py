"""Blender's cameras, there and back: as people write them, random and broken ones."""

from __future__ import annotations

import json
import math
import re

import numpy as np
import pytest
from format_cameras import (
    pasted,
)

from renderer.camera import Camera
from renderer.camera_formats import PosedCamera, read_cameras, written
from renderer.camera_formats.given import Given, Options
from renderer.errors import LucidaError

# Blender's default camera: 7.36, -6.93, 4.96, turned by 63.6, 0 and 46.7 degrees.
DEFAULT = """\
import bpy
import math

scene = bpy.context.scene
light = bpy.data.lights.new("Sun", type="SUN")
light.type = "SUN"
sun = bpy.data.objects.new("Sun", light)
sun.location = (4.0, 1.0, 5.9)
cam_data = bpy.data.cameras.new("Camera")
cam = bpy.data.objects.new("Camera", cam_data)
cam.location = (7.36, -6.93, 4.96)
cam.rotation_euler = (math.radians(63.6), 0, 46.7 * math.pi / 180)
cam_data.lens = 60 - 20 / 2
cam_data.sensor_width = +30 + 6
scene.render.resolution_x, scene.render.resolution_y = 1920, 1080
"""
# The same as JSON.
TABLE = {
    "camera": {
        "location": [7.36, -6.93, 4.96],
        "rotation_euler_degrees": [63.6, 0, 46.7],
        "data": {"lens": 50.0, "sensor_width": 36},
    },
    "render": {"resolution_x": 1920, "resolution_y": 1080},
}
ADDED = """\
bpy.ops.mesh.primitive_cube_add(location=(1, 1, 1))
bpy.ops.object.camera_add(location=(7.36, -6.93, 4.96), rotation=(1.110029, 0, 0.815069))
bpy.context.object.data.angle = 2 * 0.345555753
"""


@pytest.mark.parametrize("text", [DEFAULT, json.dumps(TABLE), ADDED])
def test_blenders_default_camera(text):
    found = pasted(text)
    assert found.format == "blender"
    (posed,) = found.cameras
    camera = posed.camera
    assert posed.size == (1920, 1080) and camera.eye == (7.36, -6.93, 4.96)
    assert camera.viewport == pytest.approx((-0.36, 0.36, -0.2025, 0.2025), rel=1e-6)
    # R = Rz Ry Rx: the first column lies in the plane, and the camera looks down at the origin.
    turn = math.radians(46.7)
    assert camera.u == pytest.approx((math.cos(turn), math.sin(turn), 0), abs=1e-6)
    assert camera.w[2] == pytest.approx(math.cos(math.radians(63.6)), abs=1e-6)
    assert -np.asarray(camera.w) @ camera.eye < -0.98 * np.linalg.norm(camera.eye)


def test_what_is_not_given_is_told():
    (_, axes, told) = pasted(ADDED).taken
    assert axes.startswith("the world as it is")
    assert told == (
        "what is not given is Blender's own: sensor_width 36.0, resolution_x 1920, "
        "resolution_y 1080"
    )
    options = Options(size=(100, 50))
    found = read_cameras(Given("it", ADDED.encode()), "", options)
    assert found.cameras[0].size == (100, 50)
    assert "resolution_x" not in found.taken[-1]
    parallel = ADDED.replace("angle", "type").replace("2 * 0.345555753", "'ORTHO'")
    assert "own: ortho_scale 6.0, res" in pasted(parallel).taken[-1]


# Of a lens of 30 and a sensor of 36 x 18, shifted by (0.25, -0.5), the picture's edges at distance
# 1, by hand: seen = sensor / lens along the side that fits; a pixel is 1 x stretch.
@pytest.mark.parametrize(
    ("size", "fit", "aspect", "viewport"),
    [
        ((200, 100), "AUTO", (1, 1), (-0.3, 0.9, -0.9, -0.3)),
        ((100, 200), "AUTO", (1, 1), (0.0, 0.6, -1.2, 0.0)),
        ((100, 200), "HORIZONTAL", (1, 1), (-0.3, 0.9, -1.8, 0.6)),
        ((200, 100), "VERTICAL", (1, 1), (-0.45, 0.75, -0.6, 0.0)),
        ((200, 100), "AUTO", (1, 4), (0.0, 0.6, -1.2, 0.0)),
        ((200, 100), "HORIZONTAL", (2, 1), (-0.3, 0.9, -0.75, -0.45)),
    ],
)
def test_sensor_fit_shift_and_pixel_aspect(size, fit, aspect, viewport):
    values = {"location": [0, 0, 0], "lens": 30, "sensor_width": 36, "sensor_height": 18}
    values |= {"sensor_fit": fit, "shift_x": 0.25, "shift_y": -0.5}
    values |= {"resolution_x": size[0], "resolution_y": size[1]}
    values |= {"pixel_aspect_x": aspect[0], "pixel_aspect_y": aspect[1]}
    (posed,) = pasted(json.dumps(values)).cameras
    assert posed.camera.viewport == pytest.approx(viewport)
    parallel = values | {"type": "ORTHO", "ortho_scale": 1.2 if fit != "VERTICAL" else 0.6}
    (posed,) = pasted(json.dumps(parallel)).cameras
    assert posed.camera.is_parallel and posed.camera.viewport == pytest.approx(viewport)


def test_turns_in_any_order_and_by_quaternion():
    # x, then y: z goes to x + y's ... each by a quarter, by hand.
    quarter = math.pi / 2
    orders = {"XYZ": (0, -1, 0), "YXZ": (1, 0, 0)}
    for order, w in orders.items():
        values = {"rotation_euler": [quarter, quarter, 0], "rotation_mode": order}
        (posed,) = pasted(json.dumps(values)).cameras
        assert posed.camera.w == pytest.approx(w, abs=1e-12), order
        text = f"import bpy\ncam.rotation_euler = Euler(({quarter}, {quarter}, 0), '{order}')\n"
        assert pasted(text).cameras[0].camera.w == pytest.approx(w, abs=1e-12)
    text = 'import bpy\ncam.rotation_mode = "QUATERNION"\ncam.rotation_quaternion = (1, 0, 1, 0)\n'
    assert pasted(text).cameras[0].camera.w == pytest.approx((1, 0, 0), abs=1e-12)


@pytest.mark.parametrize(
    "angles",
    [
        {"angle": 1.0}, {"angle_degrees": 180 / math.pi}, {"angle_deg": 180 / math.pi},
        {"angle_x": 1.0}, {"angle_x_degrees": 180 / math.pi},
        {"angle_y": 1.0, "sensor_height": 40}, {"angle_y_deg": 180 / math.pi, "sensor_height": 40},
        {"lens": 20 / math.tan(0.5)},
    ],
)  # fmt: skip
def test_every_way_to_say_how_wide(angles):
    """Of a sensor of 40 mm; not turned, it looks down -z."""
    values = {"location": [1, 2, 3], "sensor_width": 40, "resolution_x": 20, "resolution_y": 20}
    (posed,) = pasted(json.dumps(values | angles)).cameras
    side = math.tan(0.5)
    assert posed.camera.viewport == pytest.approx((-side, side, -side, side))
    assert posed.camera.basis.tolist() == np.eye(3).tolist()


@pytest.mark.parametrize("wide", [1e-3, 1.0, 1e3])
def test_a_lens_as_short_or_long_as_blender_takes(wide):
    """Blender has no focal length below 1 mm: there the sensor grows."""
    camera = Camera(distance=1 / wide, viewport=(-1, 1, -1, 1))
    text = written([PosedCamera(camera, (20, 20))], "blender")[""]
    lens, sensor = (
        re.search(rf"'{key}': ([^,}}]+)", text.decode()) for key in ("lens", "sensor_width")
    )
    assert lens and sensor and float(lens[1]) >= 0.999 and float(sensor[1]) >= 35.999
    assert pasted(text).cameras[0].camera.viewport[1] == pytest.approx(wide)


def test_cameras_in_a_table_inherit_the_values_around_it():
    entries = [{"name": "a", "location": [1, 2, 3]}, {"name": "b", "location": [4, 5, 6]}]
    table = {"lens": 36, "shift_x": 0, "made": [3], "inner": {"cameras": entries}}
    found = pasted(json.dumps(table), "blender").cameras
    assert [(one.name, one.camera.eye[0]) for one in found] == [("a", 1), ("b", 4)]
    assert {one.camera.viewport[:2] for one in found} == {(-0.5, 0.5)}


def test_the_scale_of_matrix_world_is_left_out():
    rows = [[0, -3, 0, 1], [2, 0, 0, 2], [0, 0, 4, 3], [0, 0, 0, 1]]
    text = f"import bpy\ncam.matrix_world = mathutils.Matrix({rows})\n"
    (posed,) = pasted(text).cameras
    camera = posed.camera
    assert (camera.eye, camera.u, camera.v) == ((1, 2, 3), (0, 1, 0), (-1, 0, 0))
    assert camera.w == (0, 0, 1)


@pytest.mark.parametrize(("side", "percentage"), [(100, 29), (100, 57), (100, 58), (50, 58)])
def test_a_percentage_that_gives_whole_pixels_loses_none(side, percentage):
    """100 * 0.29 is 28.999999999999996."""
    values = {"location": [0, 0, 0], "resolution_x": side, "resolution_y": side, "lens": 50}
    (posed,) = pasted(json.dumps(values | {"resolution_percentage": percentage})).cameras
    assert posed.size == (side * percentage // 100,) * 2


def test_a_wide_angle_keeps_within_blenders_bounds():
    camera = Camera(viewport=(-100, 100, -100, 100))
    text = written([PosedCamera(camera, (64, 64))], "blender")[""]
    assert b"'lens': 1.0" in text and b"'sensor_width': 200.0" in text
    assert pasted(text).cameras[0].camera.viewport == pytest.approx(camera.viewport)
    text = written([PosedCamera(Camera(), (64, 64))], "blender")[""]
    assert b"'lens': 36.0" in text and b"'sensor_width': 36.0" in text


def test_what_is_written_runs_as_python_and_nothing_that_is_read_does(tmp_path):
    compile(written([PosedCamera(Camera(), (64, 64))], "blender")[""], "it", "exec")
    trace = tmp_path / "ran"
    evil = (
        f"import bpy\nopen({str(trace)!r}, 'w')\ncam.location = (1, 2, open({str(trace)!r}, 'w'))\n"
    )
    with pytest.raises(LucidaError, match=r"line 3: location: .* without running it"):
        pasted(evil)
    assert not trace.exists()


def changed(**fields):
    return json.dumps({"location": [0, 0, 0], "lens": 50, "sensor_width": 36} | fields)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (changed(lens=0), "lens: 0 is not above 0; give e.g. 50"),
        (changed(sensor_fit="BOTH"), "sensor_fit: 'BOTH' is unknown; give one of AUTO, "),
        (changed(type="CUSTOM"), "type: 'CUSTOM' is no PERSP or ORTHO or PANO; "),
        (
            changed(type="PANO", panorama_type="MIRRORBALL"),
            "panorama_type: 'MIRRORBALL' is a lens ",
        ),
        (changed(type="ORTHO", ortho_scale=-1), "ortho_scale: -1 is not above 0; "),
        (changed(rotation_euler={"x": 1}), "rotation_euler: None is not 3 numbers; "),
        (
            changed(rotation_euler=[63.6, 0, 46.7]),
            "rotation_euler: (63.6, 0, 46.7) radians are mor",
        ),
        (
            changed(rotation_mode="AXIS_ANGLE"),
            "rotation_mode: 'AXIS_ANGLE' is not XYZ in any order",
        ),
        (
            changed(rotation_quaternion=[0, 0, 0, 0]),
            "rotation_quaternion: (0, 0, 0, 0) is no rotat",
        ),
        (changed(rotation_mode="QUATERNION"), "rotation_quaternion: None is not 4 numbers; "),
        (
            changed(matrix_world=np.zeros((4, 4)).tolist()),
            "matrix_world: its last row is (0, 0, 0,",
        ),
        (
            changed(matrix_world=[[0] * 4] * 3 + [[0, 0, 0, 1]]),
            "matrix_world: has columns of lengt",
        ),
        (
            changed(matrix_world=np.diag([1e200, 1, 1, 1]).tolist()),
            "matrix_world: has the number 1e+200, which is too la",
        ),
        (changed(resolution_x=10.5), "resolution_x: 10.5 is no whole number; "),
        (changed(resolution_x=5, resolution_percentage=1), "resolution_x: "),
        (changed(pixel_aspect_x=0), "pixel_aspect_x: 0 is not above 0; "),
        (changed(angle=0.5), "angle: is given beside lens; "),
        (
            json.dumps({"location": [0, 0, 0], "angle": 50}),
            "angle: 50 radians are not between 0 an",
        ),
        (changed(clip_start=5, clip_end=2), "clip_end: 2 is not above near = 5; "),
        ('{"lens": 5, "sensor_width": 3}', "matrix_world: is missing; "),
        ('{"a": ' * 90 + "3" + "}" * 90, "holds no camera (blender); "),
        ("import bpy\ncam.location = (1, 2\n", "line 2: is no Python: "),
        ("import bpy\n", "holds no camera (blender); "),
        ("cam.location = somewhere\n", "line 1: location: somewhere has no value that can be read"),
        ("cam.location = (1, 2)\n", "line 1: location: [1, 2] is not 3 numbers; "),
        ("cam.location.x = 3\n", "line 1: location: is given in parts; "),
        ("cam.location += (1, 2, 3)\n", "line 1: location: is given in parts; "),
        ("cam.location = (1, 2, 3 / 0)\n", "line 1: location: has no value; "),
        (
            "a_cam.location = 1, 2, 3\nb_cam.location = 1, 2, 4\n",
            "line 2: location: is not the val",
        ),
        (
            "cam.location = 0, 0, 0\ncam.location = 1, 2, 4\n",
            "line 2: location: is not the value o",
        ),
        ("CAMERAS = [{'location': here}]\n", "line 1: CAMERAS: is a table with more than numbers"),
        ("cam.location = (" + "-" * 500 + "1, 2, 3)\n", "line 1: location: "),
    ],
)
def test_broken_files(text, said):
    with pytest.raises(LucidaError) as raised:
        pasted(text, "blender")
    assert str(raised.value).startswith(f"pasted: {said}") and raised.value.remedy


@pytest.mark.parametrize("text", ["x = " + "(" * 5000, "x = " + "-" * 100_000 + "1", "a\0b"])
def test_hostile_python_is_one_line(text):
    with pytest.raises(LucidaError, match=r"^pasted: .*Python"):
        pasted(text, "blender")
    with pytest.raises(LucidaError, match=r"^pasted: .*Python"):
        pasted("[" * 100_000, "blender")
