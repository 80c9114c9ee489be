"""Keys that a reader does not use are named; poses and lenses in related formats are read."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from format_cameras import pasted

from lucida.renderer.camera.camera import Camera
from lucida.renderer.files.cameras import CameraSet, read_cameras
from lucida.renderer.files.cameras.given import Given
from lucida.renderer.system.errors import LucidaError

AT_REST = np.eye(4).tolist()
OPENCV = {"K": [500, 510, 320, 240], "image_size": [640, 480]}
NERF = {"w": 64, "h": 48, "fl_x": 50, "frames": [{"transform_matrix": AT_REST}]}
CAMERA = Camera.look_at((1, 2, 3), (0, 0, 0), fov_y_deg=40)
OPENGL = {"view": CAMERA.camera_from_world.tolist()}
OPENGL["projection"] = CAMERA.clip_from_camera(0.5, 20).tolist()
GLTF: dict[str, Any] = {
    "asset": {"version": "2.0"},
    "nodes": [{"camera": 0}],
    "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}],
}


@pytest.mark.parametrize(
    ("table", "note"),
    [
        (OPENCV | {"rig": {"position": [0, 0, 1]}, "gain": 2}, "not used: rig.position, gain"),
        (OPENCV | {"RadialDistortion": [-0.2, 0.1]}, "not used: RadialDistortion"),
        (OPENCV | {"k": [400, 510, 320, 240]}, "not used: k"),
        (OPENCV | {"t": [0, 0, 1], "w2c": AT_REST}, "not used: t"),
        (NERF | {"frames": [{"transform_matrix": AT_REST, "iso": 100}] * 2}, "not used: iso"),
        (NERF | {f"key{k}": 1 for k in range(10)},
         "not used: key0, key1, key2, key3, key4, key5, key6, key7 and 2 more"),
        (OPENGL | {"modelMatrix": AT_REST}, "not used: modelMatrix"),
        (GLTF | {"animations": [{}]},
         "animations are not used: the cameras are at their nodes' resting places"),
        (GLTF | {"cameras": 2 * GLTF["cameras"]},
         "cameras[1] is not used: no node of the scene holds it"),
    ],
)  # fmt: skip
def test_unused_keys_are_named(table: dict[str, Any], note: str) -> None:
    found = pasted(json.dumps(table))
    assert found.notes == (note,)
    assert note in found.taken


@pytest.mark.parametrize("table", [OPENCV, NERF, OPENGL, GLTF])
def test_a_file_without_unused_keys_has_no_note(table: dict[str, Any]) -> None:
    assert not pasted(json.dumps(table)).notes


EUROC = """
T_BS: {cols: 4, rows: 4, data: [0,-1,0,1, 1,0,0,2, 0,0,1,3, 0,0,0,1]}
rate_hz: 20
resolution: [640, 480]
camera_model: pinhole
intrinsics: [500, 500, 320, 240]
distortion_model: radial-tangential
distortion_coefficients: [0.0, 0.0, 0.0, 0.0]
"""
KALIBR = """
cam0:
  w2c: [[0, 1, 0, -2], [-1, 0, 0, 1], [0, 0, 1, -3], [0, 0, 0, 1]]
  intrinsics: [500, 500, 320, 240]
  resolution: [640, 480]
cam1:
  T_cn_cnm1: [[1, 0, 0, -2], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
  intrinsics: [500, 500, 320, 240]
  resolution: [640, 480]
"""
TABLES = """
left: {K: [500, 500, 320, 240], size: [640, 480], c2w: [0,-1,0,1, 1,0,0,2, 0,0,1,3]}
right: {K: [500, 500, 320, 240], size: [640, 480], c2w: [0,-1,0,1, 1,0,0,4, 0,0,1,3]}
"""


def read(text: str) -> CameraSet:
    return read_cameras(Given("a.yaml", text.encode(), Path("a.yaml")))


EYES = [(1, 2, 3), (1, 4, 3)]


@pytest.mark.parametrize("text", [KALIBR, TABLES], ids=["kalibr", "tables"])
def test_poses_of_two_cameras_are_read(text: str) -> None:
    """The camera is turned by 90 degrees about z, at (1, 2, 3); its pair is 2 to the right."""
    found = read(text)
    assert [posed.camera.eye for posed in found.cameras] == [pytest.approx(eye) for eye in EYES]
    for camera in (posed.camera for posed in found.cameras):
        assert camera.u == pytest.approx((0, 1, 0)) and camera.w == pytest.approx((0, 0, -1))


def test_a_pose_on_a_robot_is_named() -> None:
    found = read(EUROC)
    assert found.notes == ("not used: T_BS, rate_hz",)
    assert found.cameras[0].camera.eye == (0, 0, 0)


@pytest.mark.parametrize(
    "text",
    [
        '{"K": [500, 500, 320, 240], "size": [640, 480], "model": "fisheye"}',
        "K = [500, 500, 320, 240]\nsize = 640, 480\ncamera_model = 'fisheye'\n",
        "<opencv_storage><cam><size>640 480</size><camera_model>fisheye</camera_model>"
        "<K>500 500 320 240</K></cam></opencv_storage>",
    ],
)
def test_a_lens_model_is_read_in_any_notation(text: str) -> None:
    lens = pasted(text).cameras[0].camera.lens
    assert lens is not None and lens.model == "fisheye"


def test_two_yaml_documents_are_refused() -> None:
    with pytest.raises(LucidaError, match="holds 2 documents"):
        read(f"{EUROC}\n---\n{EUROC}")
