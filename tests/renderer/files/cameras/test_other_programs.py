"""Files of programs that are only read: the kind is recognised, K, pose and lens are theirs."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from lucida.renderer.camera.lenses import Lens
from lucida.renderer.files.cameras import CameraSet, read_cameras
from lucida.renderer.system.errors import LucidaError

ORB = """%YAML:1.0
Camera.type:"KannalaBrandt8"
Camera1.fx: 500
Camera1.fy: 510.
Camera1.cx: 330.0
Camera1.cy: 235.0
Camera1.k1: 0.01
Camera1.k2: 0.02
Camera.width: 640
Camera.height: 480
"""
STELLA = """Camera:
  name: "a camera"
  model: "perspective"
  fx: 500
  fy: 510
  cx: 330
  cy: 235
  k1: -0.2
  k2: 0.1
  p1: 0.001
  p2: -0.002
  k3: 0.0
  fps: 20.0
  cols: 640
  rows: 480
"""
VINS = """%YAML:1.0
---
model_type: PINHOLE
camera_name: camera
image_width: 640
image_height: 480
distortion_parameters:
   k1: -0.2
   k2: 0.1
   p1: 0.001
   p2: -0.002
projection_parameters:
   fx: 500
   fy: 510
   cx: 330
   cy: 235
"""
VINS_FISHEYE = """%YAML:1.0
---
model_type: KANNALA_BRANDT
camera_name: camera
image_width: 640
image_height: 480
projection_parameters:
   k2: 0.01
   k3: 0.02
   k4: 0.0
   k5: 0.0
   mu: 500
   mv: 510
   u0: 330
   v0: 235
"""
KALIBR = """cam0:
  cam_overlaps: [1]
  camera_model: pinhole
  distortion_coeffs: [-0.2, 0.1, 0.001, -0.002]
  distortion_model: radtan
  intrinsics: [500, 510, 330, 235]
  resolution: [640, 480]
cam1:
  T_cn_cnm1:
  - [1, 0, 0, -0.25]
  - [0, 1, 0, 0]
  - [0, 0, 1, 0]
  - [0, 0, 0, 1]
  camera_model: pinhole
  distortion_coeffs: [0.9]
  distortion_model: fov
  intrinsics: [500, 510, 330, 235]
  resolution: [640, 480]
"""
STEREO = """%YAML:1.0
---
M1: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [500, 0, 330, 0, 510, 235, 0, 0, 1]
D1: !!opencv-matrix
   rows: 1
   cols: 5
   dt: d
   data: [-0.2, 0.1, 0.001, -0.002, 0]
M2: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [500, 0, 330, 0, 510, 235, 0, 0, 1]
D2: !!opencv-matrix
   rows: 1
   cols: 5
   dt: d
   data: [0, 0, 0, 0, 0]
R: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [1, 0, 0, 0, 1, 0, 0, 0, 1]
T: [-0.25, 0, 0]
image_width: 640
image_height: 480
"""
INI = """# oST version 5.0 parameters
[image]

width
640

height
480

[narrow_stereo]

camera matrix
500.0 0.0 330.0
0.0 510.0 235.0
0.0 0.0 1.0

distortion
-0.2 0.1 0.001 -0.002 0.0

rectification
1.0 0.0 0.0
0.0 1.0 0.0
0.0 0.0 1.0

projection
500.0 0.0 330.0 0.0
0.0 510.0 235.0 0.0
0.0 0.0 1.0 0.0
"""
BROWN = {"k1": -0.2, "k2": 0.1, "p1": 0.001, "p2": -0.002}
# The file, its text, its pixel origin, its first lens's model and coefficients; each has
# fx = 500, fy = 510, cx = 330, cy = 235, in 640 x 480, and, if it has two cameras, the second one
# at (0.25, 0, 0).
FILES: list[tuple[str, Any, str, str, dict[str, float]]] = [
    ("orb.yaml", ORB, "center", "fisheye", {"k1": 0.01, "k2": 0.02, "k3": 0, "k4": 0}),
    ("vins.yaml", VINS, "center", "brown", BROWN),
    ("stella.yaml", STELLA, "center", "brown", BROWN),
    ("fisheye.yaml", VINS_FISHEYE, "center", "fisheye", {"k1": 0.01, "k2": 0.02, "k3": 0, "k4": 0}),
    ("camchain.yaml", KALIBR, "center", "brown", BROWN),
    ("stereo.yml", STEREO, "center", "brown", BROWN | {"k3": 0}),
    ("ost.ini", INI, "center", "brown", BROWN | {"k3": 0}),
]


def read(folder: Path, name: str, content: Any) -> CameraSet:
    path = folder / name
    path.write_text(content if isinstance(content, str) else json.dumps(content))
    return read_cameras(path)


@pytest.mark.parametrize(("name", "content", "origin", "model", "coefficients"), FILES)
def test_k_pose_and_lens(
    name: str,
    content: Any,
    origin: str,
    model: str,
    coefficients: dict[str, float],
    tmp_path: Path,
) -> None:
    found = read(tmp_path, name, content)
    one = found.cameras[0]
    assert one.size == (640, 480)
    K = one.camera.intrinsics(one.size, origin).K
    assert [K[0, 0], K[1, 1], K[0, 2], K[1, 2], K[0, 1]] == pytest.approx([500, 510, 330, 235, 0])
    assert one.camera.eye == pytest.approx((0, 0, 0))
    assert (*one.camera.v, *one.camera.w) == pytest.approx((0, -1, 0, 0, 0, -1))
    known = {name: value for name, value in coefficients.items() if value}
    assert one.camera.lens == (Lens(model, known) if model else None)
    assert len(found.cameras) <= 2
    for two in found.cameras[1:]:
        assert two.camera.eye == pytest.approx((0.25, 0, 0)) and two.name != one.name


def test_kalibrs_fov_and_a_float_as_a_switch(tmp_path: Path) -> None:
    lens = read(tmp_path, "camchain.yaml", KALIBR).cameras[1].camera.lens
    assert lens == Lens("fov", {"omega": 0.9})
    text = STEREO.replace("M1", "camera_matrix").replace("D1", "distortion_coefficients")
    text = text[: text.index("M2")] + "image_width: 640\nimage_height: 480\nfisheye_model: 0.\n"
    lens = read(tmp_path, "mono.yml", text).cameras[0].camera.lens
    assert lens is not None and lens.model == "brown"


@pytest.mark.parametrize(
    ("name", "content", "complaint"),
    [
        ("a.yaml", KALIBR.replace(": pinhole", ": omni"), "cam0.camera_model: 'omni' is a lens"),
        ("a.json", {"fx": 5, "fy": 5, "cx": 5, "cy": 5, "xi": 1.2}, "xi: 1.2 is for a mirror"),
        ("a.ini", INI.replace("500.0 0.0 330.0\n", ""), "camera matrix: has 6 numbers"),
    ],
)
def test_what_is_not_supported_is_named(
    name: str, content: Any, complaint: str, tmp_path: Path
) -> None:
    with pytest.raises(LucidaError, match=complaint) as caught:
        read(tmp_path, name, content)
    assert caught.value.remedy
