"""glTF cameras: read at their nodes, written, and what they cannot hold."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given as over
from hypothesis import strategies as st

from lucida.renderer.camera.camera import Camera
from lucida.renderer.files.cameras import PosedCamera, read_cameras, written
from lucida.renderer.files.cameras.given import Given, Options
from lucida.renderer.files.models.gltf_file import glb_bytes
from lucida.renderer.system.errors import LucidaError

PERSPECTIVE = {"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1, "zfar": 50.0}}
ORTHOGRAPHIC = {
    "type": "orthographic",
    "orthographic": {"xmag": 2.0, "ymag": 1.5, "znear": 0.0, "zfar": 9.0},
}
SIZE = (160, 90)


def tree(*cameras: Any, **changes: Any) -> dict[str, Any]:
    """A tree of these cameras, each at a node of its own."""
    return {
        "asset": {"version": "2.0"},
        "nodes": [{"camera": number, "name": f"c{number}"} for number in range(len(cameras))],
        "cameras": list(cameras),
    } | changes


def given(found: object) -> Given:
    return Given("scene.gltf", json.dumps(found).encode())


def one(found: object, **options: Any) -> PosedCamera:
    (camera,) = read_cameras(given(found), options=Options(**options)).cameras
    return camera


def gltf_pixels(camera: dict, matrix: np.ndarray, points: np.ndarray, size: tuple) -> np.ndarray:
    """Project points with the specification's own matrices: (n, 2) in pixels, from the upper left
    corner.
    """
    a = size[0] / size[1]
    projection = np.zeros((4, 4))
    if camera["type"] == "perspective":
        lens = camera["perspective"]
        a = lens.get("aspectRatio", a)
        near, far, tangent = lens["znear"], lens["zfar"], math.tan(lens["yfov"] / 2)
        projection[0, 0], projection[1, 1] = 1 / (a * tangent), 1 / tangent
        projection[2, 2:] = (far + near) / (near - far), 2 * far * near / (near - far)
        projection[3, 2] = -1
    else:
        lens = camera["orthographic"]
        projection[0, 0], projection[1, 1] = 1 / lens["xmag"], 1 / lens["ymag"]
        projection[2, 2], projection[3, 3] = -0.1, 1
    homogeneous = np.column_stack([points, np.ones(len(points))])
    clip = homogeneous @ (projection @ np.linalg.inv(matrix)).T
    x, y = (clip[:, :2] / clip[:, 3:]).T
    return np.column_stack([(x + 1) / 2 * size[0], (1 - y) / 2 * size[1]])


def our_pixels(camera: Camera, points: np.ndarray, size: tuple) -> np.ndarray:
    found = camera.project(points, size)
    return np.column_stack([found.column, found.row]) + 0.5


@st.composite
def rotations(draw: st.DrawFn) -> np.ndarray:
    x, y, z, w = (draw(st.floats(-1, 1)) for _ in range(4))
    q = np.array([x, y, z, w]) if x * x + y * y + z * z + w * w > 1e-3 else np.array([0, 0, 0, 1])
    return q / np.linalg.norm(q)


@over(rotations(), st.floats(0.05, 3.0), st.floats(0.2, 5.0), st.booleans(), st.randoms())
def test_points_land_where_the_specification_says(turn, yfov, aspect, parallel, random):
    camera = json.loads(json.dumps(ORTHOGRAPHIC if parallel else PERSPECTIVE))
    if not parallel:
        camera["perspective"] |= {"yfov": yfov, "aspectRatio": aspect}
    parts = [{"rotation": turn.tolist(), "translation": [1, 2, 3], "children": [1]}]
    nodes = [*parts, {"camera": 0, "translation": [0, 0.5, 0], "scale": [2, 3, 0.5]}]
    found = one(tree(camera, nodes=nodes)).camera
    rigid = np.eye(4)
    rigid[:3, :3], rigid[:3, 3] = found.basis, found.eye
    x, y, z, w = turn
    looks = [2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)]
    np.testing.assert_allclose(found.w, looks, atol=1e-12)
    local = np.array([[random.uniform(-1, 1), random.uniform(-1, 1), -2.0] for _ in range(5)])
    points = local @ found.basis.T + found.eye
    expected = gltf_pixels(camera, rigid, points, SIZE)
    np.testing.assert_allclose(our_pixels(found, points, SIZE), expected, atol=1e-6)


def test_without_an_aspect_ratio_the_height_s_angle_stays():
    seen = one(tree(PERSPECTIVE))
    assert seen.fit and seen.size is None
    assert seen.camera.fitted((200, 100)).fov_y_deg == pytest.approx(math.degrees(0.8))
    seen = one(tree(PERSPECTIVE), size=(30, 90))  # an image that is higher than wide
    assert not seen.fit and seen.camera.viewport == pytest.approx((-1 / 6, 1 / 6, -0.5, 0.5))


def test_clip_planes_are_kept_and_what_was_taken_is_told():
    found = read_cameras(given(tree(PERSPECTIVE)))
    camera = found.cameras[0].camera
    assert (camera.near, camera.far) == (0.1, 50)
    assert "znear and zfar clip" in found.taken
    assert any("no aspectRatio" in phrase for phrase in found.taken)
    box = one(tree(ORTHOGRAPHIC)).camera
    assert (box.is_parallel, box.near, box.far) == (True, None, 9)
    assert box.viewport == (-2, 2, -1.5, 1.5)


def test_the_camera_of_a_mirrored_or_skewed_node_is_rigid():
    nodes = [
        {"camera": 0, "name": "m", "scale": [1, 1, -1]},
        {"children": [2], "scale": [1, 3, 1]},
        {"camera": 0, "name": "s", "rotation": [0, 0, 0.3826834, 0.9238795]},
    ]
    found = read_cameras(given(tree(PERSPECTIVE, nodes=nodes)))
    mirrored, skewed = (entry.camera for entry in found.cameras)
    assert mirrored.w == pytest.approx((0, 0, -1))
    for camera in (mirrored, skewed):
        np.testing.assert_allclose(camera.basis.T @ camera.basis, np.eye(3), atol=1e-12)
        assert camera.determinant == pytest.approx(1)


def test_several_cameras_and_their_names(tmp_path: Path):
    (tmp_path / "a.gltf").write_text(
        json.dumps(tree(PERSPECTIVE | {"name": "lens"}, ORTHOGRAPHIC, nodes=[
            {"camera": 1, "name": "top"}, {"camera": 0}, {"camera": 0, "name": "again"},
        ]))
    )  # fmt: skip
    found = read_cameras(tmp_path / "a.gltf")
    assert [entry.name for entry in found.cameras] == ["top", "lens", "again"]


def lens(**changes: Any) -> dict[str, Any]:
    return {"type": "perspective", "perspective": PERSPECTIVE["perspective"] | changes}  # type: ignore


BROKEN = {
    "yfov": (tree(lens(yfov=4)), r"cameras\[0\]\.perspective\.yfov: expected a number < 3\.14"),



    "type": (tree({"type": "fisheye"}), r"cameras\[0\]\.type: 'fisheye' is not"),

    "nobody": (tree(nodes=[{"camera": 3}]), r"cameras: names entry 3"),

    "none": (tree(), r"holds no camera"),
    "mag": (
        tree(ORTHOGRAPHIC | {"orthographic": {"xmag": -1, "ymag": 1, "znear": 0, "zfar": 1}}),
        r"orthographic\.xmag: expected a number > 0",
    ),
}  # fmt: skip


@pytest.mark.parametrize("what", BROKEN)
def test_what_is_broken_is_told_in_one_line(what: str, tmp_path: Path):
    found, told = BROKEN[what]
    with pytest.raises(LucidaError, match=told) as caught:
        read_cameras(given(found))
    assert str(caught.value).startswith("scene.gltf: ") and "\n" not in str(caught.value)


CANONICAL = Camera.canonical()


def test_a_parallel_camera_off_the_middle_is_the_same_from_another_eye():
    camera = replace(CANONICAL, viewport=(1.0, 3.0, 0.0, 1.0), projection="parallel")
    found = one(json.loads(written([PosedCamera(camera)], "gltf"))).camera
    assert found.eye == pytest.approx((2, 0.5, 0))
    assert found.viewport == pytest.approx((-1, 1, -0.5, 0.5))


def test_the_cameras_of_a_glb_are_those_of_a_gltf() -> None:
    text = written([PosedCamera(CANONICAL)], "gltf")
    data = glb_bytes(json.loads(text))
    one_text, one_binary = (read_cameras(Given("a", given)).cameras for given in (text, data))
    assert one_text == one_binary
