"""transforms.json: as the synthetic scenes, instant-ngp and nerfstudio print it, there and back."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest
from format_cameras import assert_same_pixels, pasted
from hypothesis import assume, given
from hypothesis import strategies as st

from lucida.renderer.files.cameras import one_of, read_cameras
from lucida.renderer.files.cameras.given import Options
from lucida.renderer.system.errors import LucidaError

POSE = [
    [-0.9999021887779236, 0.004192245192825794, -0.013345719315111637, -0.05379832163453102],
    [-0.013988681137561798, -0.2996590733528137, 0.95394366979599, 3.845470428466797],
    [-4.656612873077393e-10, 0.9540371894836426, 0.29968830943107605, 1.2080823183059692],
    [0.0, 0.0, 0.0, 1.0],
]
# The first frame of a synthetic scene.
SYNTHETIC = {
    "camera_angle_x": 0.6911112070083618,
    "frames": [
        {"file_path": "./train/r_0", "rotation": 0.012566370614359171, "transform_matrix": POSE}
    ],
}
STUDIO = {
    "camera_model": "OPENCV",
    "fl_x": 1072.0,
    "fl_y": 1068.0,
    "cx": 1504.0,
    "cy": 1000.0,
    "w": 3008,
    "h": 2000,
    "k1": 0.0312,
    "k2": 0.0051,
    "p1": 0.0006,
    "p2": 0.0001,
    "applied_transform": [[0, 1, 0, 0], [1, 0, 0, 0], [0, 0, -1, 0]],
    "frames": [
        {"file_path": "images/frame_00001.jpeg", "transform_matrix": POSE},
        {"file_path": "images/frame_00002.jpeg", "transform_matrix": POSE, "fl_x": 900.0, "w": 640},
    ],
}
SHARP = STUDIO | {"k1": 0, "k2": 0.0, "p1": 0, "p2": 0}


def first(change: dict, **frame: object) -> str:
    return json.dumps(SHARP | {"frames": [STUDIO["frames"][0] | frame]} | change)


def test_a_synthetic_scene_sees_what_its_formula_says(tmp_path: Path) -> None:
    """The pixel (i, j) looks along ((j - W/2) / f, -(i - H/2) / f, -1), turned; pixel corners."""
    path = tmp_path / "transforms_train.json"
    path.write_text(json.dumps(SYNTHETIC))
    found = read_cameras(path, options=Options(size=(800, 600)))
    camera = one_of(found.cameras, "r_0")
    assert (found.format, camera.size, camera.name) == ("nerf", (800, 600), "train/r_0")
    assert Path(camera.image) == tmp_path / "train" / "r_0.png"
    focal = 0.5 * 800 / math.tan(0.5 * SYNTHETIC["camera_angle_x"])
    i, j = np.random.default_rng(1).uniform(0, 600, (2, 50))
    local = np.stack([(j - 400) / focal, -(i - 300) / focal, -np.ones(50)])
    points = (np.array(POSE)[:3, :3] @ local).T + np.array(POSE)[:3, 3]
    seen = camera.camera.project(points, (800, 600))
    assert seen.column == pytest.approx(j - 0.5, abs=1e-6)
    assert seen.row == pytest.approx(i - 0.5, abs=1e-6)
    options = Options(size=(800, 600), pixel_origin="center")
    half = read_cameras(path, options=options).cameras[0].camera
    assert half.project(points, (800, 600)).column == pytest.approx(j, abs=1e-6)


def test_without_w_and_h_the_size_is_open_and_said_to_be() -> None:
    found = pasted(json.dumps(SYNTHETIC))
    (camera,) = found.cameras
    assert (camera.size, camera.fit) == (None, False)
    half = math.tan(SYNTHETIC["camera_angle_x"] / 2)
    assert camera.camera.viewport == pytest.approx((-half, half, -half, half))
    assert "no w and h: a square image is taken" in found.taken
    told = pasted(json.dumps(SYNTHETIC), options=Options(size=(800, 800)))
    assert told.cameras[0].size == (800, 800)
    assert_same_pixels(camera.camera, told.cameras[0].camera, (800, 800))


def test_nerfstudio_s_frames_have_intrinsics_of_their_own() -> None:
    found = pasted(json.dumps(STUDIO))
    one, two = found.cameras
    assert one.camera.lens is not None and one.camera.lens.coefficient("k1") == 0.0312
    assert (one.size, two.size) == ((3008, 2000), (640, 2000))
    K = two.camera.intrinsics(two.size, "corner").K
    assert (K[0, 0], K[1, 1], K[0, 2]) == pytest.approx((900, 1068, 1504))
    assert found.notes == ("not used: applied_transform",)
    assert "axes x right, y up, looking along -z (OpenGL)" in found.taken


def test_four_radial_terms_and_a_fisheye() -> None:
    change = {"k3": 0.1, "k4": -0.02, "w": 2000, "h": 2000, "cx": 1000, "cy": 1000, "fl_y": 1072}
    lens = pasted(first(change)).cameras[0].camera.lens
    assert lens is not None and lens.coefficient("k3") == 0.1 and lens.coefficient("r8") == -0.02
    for fisheye in ({"camera_model": "OPENCV_FISHEYE"}, {"is_fisheye": True}):
        lens = pasted(first(change | fisheye | {"k3": 0})).cameras[0].camera.lens
        assert lens is not None and lens.model == "fisheye" and lens.coefficient("k4") == -0.02


def test_a_scaled_pose_is_held() -> None:
    pose = np.diag([2.0, 2.0, 2.0, 1.0]).tolist()
    found = pasted(first({}, transform_matrix=pose))
    assert found.cameras[0].camera.u == pytest.approx((2, 0, 0))


def turned(row: int, column: int, number: object) -> list:
    pose = [list(line) for line in POSE]
    pose[row][column] = number
    return pose


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (json.dumps({"frames": []}), "frames: are missing"),
        (json.dumps({"camera_angle_x": 1}), "frames: are missing"),
        (json.dumps({"frames": [{}]}), r"frames\[0\].transform_matrix: is missing"),
        (first({}, transform_matrix=np.transpose(POSE).tolist()), "is it transposed"),
        (first({}, transform_matrix=np.diag([1, 1, 0, 1]).tolist()), "no inverse"),
        (first({"fl_x": "1072"}), "fl_x: '1072' is not a number"),
        (
            first({"camera_model": "VR180_L"}),
            "camera_model: 'VR180_L' is a lens that is not supported",
        ),
        (json.dumps({"frames": [{"transform_matrix": POSE}]}), "w: is missing"),
        (json.dumps(SYNTHETIC | {"camera_angle_x": 3.2}), "camera_angle_x: 3.2 is not between"),
    ],
    ids=lambda value: value[:40],
)
def test_what_is_broken_is_told_in_one_line(text: str, told: str) -> None:
    with pytest.raises(LucidaError, match=told) as caught:
        pasted(text, "nerf")
    assert "\n" not in str(caught.value)


FOCAL = st.floats(10, 5000) | st.floats(-5000, -10) | st.integers(10, 5000)
OPTICAL = {
    "w": st.integers(1, 4000),
    "h": st.integers(1, 4000),
    "fl_x": FOCAL,
    "fl_y": FOCAL,
    "cx": st.floats(-100, 4000),
    "cy": st.floats(-100, 4000),
    "camera_angle_x": st.floats(0.1, 3),
    "camera_angle_y": st.floats(0.1, 3),
    "k1": st.sampled_from([0, 0.5, -0.25]),
    "p1": st.sampled_from([0.0, 0.5]),
    "camera_model": st.sampled_from(["OPENCV", "PINHOLE", "OPENCV_FISHEYE"]),
    "is_fisheye": st.sampled_from([True, False, 1]),
}


def table_of(*needed: str) -> st.SearchStrategy[dict]:
    optional = {name: values for name, values in OPTICAL.items() if name not in needed}
    return st.fixed_dictionaries({name: OPTICAL[name] for name in needed}, optional=optional)


@given(table_of("w", "h"))
def test_a_frame_s_intrinsics_are_what_their_names_say(table: dict) -> None:
    """K as nerfstudio's parser has it; a negative focal length mirrors the image."""
    assume({"fl_x", "camera_angle_x"} & table.keys())
    w, h = table["w"], table["h"]
    fx = table.get("fl_x") or w / 2 / math.tan(table["camera_angle_x"] / 2)
    fy = fx
    if "fl_y" in table:
        fy = table["fl_y"]
    elif "camera_angle_y" in table and "fl_x" not in table:
        fy = h / 2 / math.tan(table["camera_angle_y"] / 2)
    model = table.get("camera_model")
    bends = any(table.get(name) for name in ("k1", "p1"))
    fisheye = model == "OPENCV_FISHEYE" or table.get("is_fisheye") is True
    assume(min(fx, fy) > 0 or not (fisheye or bends))  # a lens is no mirror
    text = json.dumps(table | {"frames": [{"transform_matrix": POSE}]})
    (read,) = pasted(text, "nerf").cameras
    x, y, z = 0.3, -0.2, -2.0  # seen from the camera, y up
    point = np.array(POSE)[:3] @ (x, y, z, 1)
    seen = read.camera.pinhole.project(point, (w, h))
    assert seen.column + 0.5 == pytest.approx(table.get("cx", w / 2) + fx * x / -z, abs=1e-6)
    assert seen.row + 0.5 == pytest.approx(table.get("cy", h / 2) - fy * y / -z, abs=1e-6)
    assert (read.camera.lens is not None) == (fisheye or bends)


def test_an_angle_that_contradicts_the_focal_length_is_told() -> None:
    for angle, is_told in ((2 * math.atan(1504 / 1072), False), (1.0, True)):
        taken = pasted(
            json.dumps(STUDIO | {"camera_angle_x": angle, "frames": STUDIO["frames"][:1]})
        ).taken
        assert any(line.startswith("fl_x is taken") for line in taken) == is_told
