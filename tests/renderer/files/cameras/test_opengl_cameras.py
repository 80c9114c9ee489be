"""OpenGL's matrices: in either order, as text and as JSON, and what they can hold."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest
from format_cameras import any_size, assert_same_pixels, centred_camera, pasted

from lucida.renderer.camera.camera import Camera
from lucida.renderer.files.cameras import PosedCamera, written
from lucida.renderer.system.errors import LucidaError

SIZE = (640, 480)
CAMERA = Camera.look_at((1, 2, 3), (0, 0, 0), fov_y_deg=40, aspect=4 / 3)
VIEW, CLIP = CAMERA.camera_from_world, CAMERA.clip_from_camera(0.5, 20)


def listed(view: np.ndarray, clip: np.ndarray, by_rows: bool) -> str:
    tables = {"view": view, "projection": clip}
    return json.dumps({n: (m if by_rows else m.T).tolist() for n, m in tables.items()})


@pytest.mark.parametrize("projection", ["perspective", "parallel"])
@pytest.mark.parametrize("by_rows", [True, False])
def test_either_order_is_found_out(by_rows: bool, projection: str) -> None:
    random = np.random.default_rng(2)
    order = "row by row" if by_rows else "column by column"
    for _ in range(20):
        camera, size = centred_camera(random, projection), any_size(random)
        if _ % 2:  # at the origin only the projection tells
            camera = replace(camera, eye=(0, 0, 0))
        text = listed(camera.camera_from_world, camera.clip_from_camera(0.5, 20), by_rows)
        found = pasted(text)
        assert found.format == "opengl"
        assert found.taken[:2] == (f"view {order}", f"projection {order}")
        back = found.cameras[0].camera
        assert (back.near, back.far) == pytest.approx((0.5, 20))
        assert_same_pixels(camera, back, size)


def test_a_projection_beside_its_diagonal_makes_the_basis_skew_or_mirrored() -> None:
    random = np.random.default_rng(3)
    for parallel in (False, True):
        for _ in range(50):
            clip = CLIP.copy()
            if parallel:
                clip[3] = (0, 0, 0, 1)
                clip[:2, 2:] = random.normal(size=(2, 2))
            clip[0, 1], clip[1, 0] = random.normal(size=2)
            clip[:2] *= random.choice([-1, 1], (2, 1))
            camera = pasted(listed(VIEW, clip, by_rows=True)).cameras[0].camera
            points = np.column_stack([random.normal(size=(9, 3)) * 0.3, np.ones(9)])
            x, y, _, w = clip @ VIEW @ points.T
            seen = camera.project(points[:, :3], SIZE)
            assert seen.column == pytest.approx((x / w + 1) * 320 - 0.5)
            assert seen.row == pytest.approx((1 - y / w) * 240 - 0.5)


def test_of_a_fitted_camera_the_matrices_are_of_its_image() -> None:
    text = written([PosedCamera(CAMERA, (100, 300), fit=True)], "opengl").decode()
    assert_same_pixels(CAMERA.fitted((100, 300)), pasted(text).cameras[0].camera, (100, 300))


def third_row(parallel: bool, near_depth: float, far_depth: float, far: float | None) -> list:
    """Return the third row of a projection with near = 0.1, and these depths of near and far."""
    depths = np.array([[near_depth], [far_depth]])
    planes = np.array([0.1, far or 1e15])
    scale = np.column_stack([-planes, np.ones(2)]) / (1 if parallel else planes[:, None])
    return [0, 0, *np.linalg.solve(scale, depths).ravel()]


@pytest.mark.parametrize("parallel", [False, True])
@pytest.mark.parametrize("far", [100.0, None])
@pytest.mark.parametrize(("near_depth", "far_depth"), [(-1, 1), (1, 0), (1, -1), (0, 1)])
def test_each_range_of_depths_is_read_or_named(
    near_depth: int, far_depth: int, far: float | None, parallel: bool
) -> None:
    if parallel and far is None:
        return
    clip = CLIP.copy()
    clip[3] = (0, 0, 0, 1) if parallel else clip[3]
    clip[2] = third_row(parallel, near_depth, far_depth, far)
    found = pasted(listed(VIEW, clip, by_rows=True))
    camera, note = found.cameras[0].camera, found.taken[2]
    certain = (near_depth, far_depth) in [(-1, 1), (1, -1), *([] if parallel else [(1, 0)])]
    if certain:
        assert (camera.near, camera.far) == (pytest.approx(0.1), far and pytest.approx(far))
    else:  # no matrix tells these two from OpenGL's
        assert f"to {near_depth} and {far_depth}, they are 0.1 and {far or np.inf:g}" in note
    assert "to depths" in note


def changed(place: tuple[int, int], number: object, clip: bool = False) -> str:
    tables = {"view": VIEW.tolist(), "projection": CLIP.tolist()}
    tables["projection" if clip else "view"][place[0]][place[1]] = number
    return json.dumps(tables)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (changed((3, 0), 0.5), "view: is not affine"),
        (changed((3, 2), 1, clip=True), "projection: is not a projection"),
        (changed((2, 3), 0, clip=True), "projection: its third row .* has no near before far"),
        ("view = 1" + " " * 2_000_000, "is too large"),
        (json.dumps({"view": [1, 2], "projection": CLIP.tolist()}), "view: has 2 numbers; give 16"),
        (json.dumps({"view": VIEW.tolist()}), "clip_from_camera: is missing"),
    ],
)
def test_what_is_broken_is_told_in_one_line(text: str, told: str) -> None:
    with pytest.raises(LucidaError, match=told) as caught:
        pasted(text, "opengl")
    assert "\n" not in str(caught.value)
