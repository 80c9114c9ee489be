"""What a pose by rotation and place can hold of a camera."""

from __future__ import annotations

import json
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from format_cameras import ASKANCE, MIRRORED, SKEWED, straight_camera
from hypothesis import given
from hypothesis import strategies as st

from renderer.camera import Camera, Size
from renderer.camera_checks import told_apart
from renderer.camera_formats import PosedCamera, read_cameras, written
from renderer.camera_formats.given import Given
from renderer.camera_formats.rigid import UNSEEN_PX, moved_px, quaternion_of, rigid, rotation_of
from renderer.camera_formats.saving import save_files
from renderer.errors import LucidaError


@pytest.mark.parametrize("projection", ["perspective", "parallel"])
def test_a_rigid_camera_has_the_same_rays(projection):
    random = np.random.default_rng(1)
    for _ in range(300):
        camera = replace(straight_camera(random, projection), near=0.5, far=7.0)
        found = rigid(camera, "it")
        assert np.allclose(found.basis.T @ found.basis, np.eye(3), atol=1e-12)
        assert found.determinant > 0
        one, other = camera.rays((5, 4)), found.rays((5, 4))
        assert np.allclose(one.origin, other.origin, atol=1e-12)
        unit = 1.0 if projection == "perspective" else np.linalg.norm(camera.w)
        assert np.allclose(one.direction, other.direction * unit, atol=1e-12)
        # The clip planes are the same planes.
        ends = np.multiply(camera.t_range, unit)
        assert np.allclose(ends, found.t_range, rtol=1e-12)


@pytest.mark.parametrize(
    ("posed", "said"),
    [
        (
            SKEWED,
            "v: (0.5, 1, 0) is at 63.4349 degrees to u = (1, 0, 0), not at 90, which it ",
        ),
        (MIRRORED, "u: (-1, 0, 0) is left-handed with v and w, a mirror that it has not; negate u"),
        (ASKANCE, "w: (0.2, 0, 1) is not at right angles to u and v, which it cannot hold in "),
    ],
)
def test_what_no_rotation_holds(posed, said):
    with pytest.raises(LucidaError) as raised:
        rigid(posed.camera, "it")
    assert str(raised.value).startswith(said)


def test_quaternions_there_and_back():
    random = np.random.default_rng(2)
    given = [*random.normal(size=(200, 4)), *np.eye(4), *(np.eye(4) + 1e-9)]
    for quaternion in given:
        rotation = rotation_of(quaternion)
        assert np.allclose(rotation @ rotation.T, np.eye(3)) and np.linalg.det(rotation) > 0
        unit = quaternion / np.linalg.norm(quaternion)
        found = np.array(quaternion_of(rotation))
        assert min(np.abs(found - unit).max(), np.abs(found + unit).max()) < 1e-12
    quarter = rotation_of([1, 0, 0, 1])  # about z: x becomes y
    assert np.allclose(quarter @ [1, 0, 0], [0, 1, 0])


def rounded_set(digits: int, count: int = 12) -> list[PosedCamera]:
    """Cameras of one calibration, whose poses a file has with so many digits."""
    random = np.random.default_rng(digits)
    found = []
    for number in range(count):
        basis, _ = np.linalg.qr(random.normal(size=(3, 3)))
        basis[:, 0] *= np.linalg.det(basis)
        u, v, w = np.round(basis, digits).T.tolist()
        camera = Camera((number, 0.5, 2), u, v, w, 1.0, (-0.3, 0.3, -0.2, 0.2))
        found.append(PosedCamera(camera, (1200, 800), f"{number}.png"))
    return found


@pytest.mark.parametrize("digits", [5, 6, 7, 12])
@pytest.mark.parametrize("format", ["colmap", "nerf", "blender", "gltf", "three", "mitsuba"])
def test_one_calibration_stays_one_where_poses_are_rounded(
    format: str, digits: int, tmp_path: Path
) -> None:
    cameras = rounded_set(digits)
    if digits == 5:  # 4e-6 of 1200 pixels
        cameras = [replace(camera, size=(120, 80)) for camera in cameras]
    files = written(cameras[:1] if format == "mitsuba" else cameras, format)
    if format == "colmap":
        assert "Number of cameras: 1\n" in files["cameras.txt"].decode()
    if format == "nerf":
        table = json.loads(files[""])
        assert "fl_x" in table and "fl_x" not in table["frames"][0]
        assert table["fl_x"] == pytest.approx(cameras[0].size[0] / 0.6, rel=1e-14)
    if format == "mitsuba":
        return
    save_files(tmp_path / "out", files)
    source = tmp_path / "out" if format == "colmap" else Given("", files[""])
    again = read_cameras(source, format).cameras
    assert len({one.camera.viewport for one in again}) == 1
    for one, other in zip(cameras, again, strict=True):
        assert moved_px(one.camera, other.camera, one.size) <= 1.01 * UNSEEN_PX


@pytest.mark.parametrize("format", ["gltf", "blender", "mitsuba"])
@pytest.mark.parametrize("size", [(640, 480), (3000, 2000)])
def test_what_moves_no_point_is_no_reason_to_refuse(format: str, size: Size) -> None:
    """For glTF an image off the middle, for the others pixels that are not square, or not alike."""

    def two(px: float) -> list[PosedCamera]:
        width, height = size
        shift = px / width if format == "gltf" else 0.0
        stretch = 1.0 if format == "gltf" else 1 + 2 * px / max(size)
        half = stretch * height / width / 2
        odd = Camera(viewport=(-0.5 + shift, 0.5 + shift, -half, half))
        plain = Camera(viewport=(-0.5, 0.5, -height / width / 2, height / width / 2))
        return [PosedCamera(odd, size), *[PosedCamera(plain, size)] * (format == "blender")]

    assert written(two(0.9 * UNSEEN_PX), format)
    with pytest.raises(LucidaError) as refused:
        written(two(1.1 * UNSEEN_PX), format)
    said = str(refused.value)
    assert " 1 times" not in said and "1 differs from another camera's 1 " not in said
    assert re.search(r"off the middle by [\d.e-]+ of|1\.0000\d+|0\.9999\d+", said)


@given(st.floats(-1e9, 1e9), st.floats(-1, 1))
def test_numbers_that_differ_are_told_apart(one: float, part: float) -> None:
    other = one * (1 + part * 1e-9)
    texts = told_apart(one, other)
    assert (texts[0] != texts[1]) == (f"{one:.16g}" != f"{other:.16g}")
    assert all(len(text) <= 24 for text in texts)
