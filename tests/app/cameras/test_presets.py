"""The presets against their definitions, and the framing of points."""

from __future__ import annotations

import math

import numpy as np
import pytest
from any_camera import cameras, vectors
from hypothesis import given
from hypothesis import strategies as st

from lucida.app.cameras.presets import MARGIN, PRESETS, Preset, clip_around, framed, look_at
from lucida.app.cameras.presets import preset_view as make_view
from lucida.app.state.app_state import is_orthonormal
from lucida.renderer.camera.camera import Camera
from lucida.renderer.files import BUILTIN_SCENES, load_scene
from lucida.renderer.scene.focus import scene_focus
from lucida.renderer.scene.model import View

PRESET = {preset.name: preset for preset in PRESETS}

SIZE = (1600, 900)
CUBE = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)


def preset_view(name: str, points: np.ndarray = CUBE) -> View:
    view = View(Camera.canonical(), fit=True)
    return make_view(PRESET[name], view, points, points, 16 / 9)


def projected(camera: Camera, world: tuple[float, float, float]) -> np.ndarray:
    """Return a direction's parallel projection, (right, up), in units of the world."""
    matrix = camera.camera_from_world
    x, y = matrix[:2, :3] @ np.asarray(world, float)
    return x * np.linalg.norm(camera.u), y * np.linalg.norm(camera.v)


@pytest.mark.parametrize(
    ("name", "right", "up", "toward"),
    [
        ("Front", (1, 0, 0), (0, 1, 0), (0, 0, 1)),
        ("Back", (-1, 0, 0), (0, 1, 0), (0, 0, -1)),
        ("Left", (0, 0, 1), (0, 1, 0), (-1, 0, 0)),
        ("Right", (0, 0, -1), (0, 1, 0), (1, 0, 0)),
        ("Top", (1, 0, 0), (0, 0, -1), (0, 1, 0)),
        ("Bottom", (1, 0, 0), (0, 0, 1), (0, -1, 0)),
    ],
)
def test_a_side_looks_at_the_scene_from_outside(name, right, up, toward) -> None:
    camera = preset_view(name).camera
    assert (camera.u, camera.v, camera.w) == (right, up, toward)
    assert camera.is_parallel
    assert np.dot(np.subtract(camera.eye, 0.5), toward) > 0.5  # outside the cube, on that side
    assert camera.determinant == 1


def test_isometric_foreshortens_all_three_axes_alike_at_120_degrees() -> None:
    camera = preset_view("Isometric").camera
    axes = [np.array(projected(camera, axis)) for axis in np.eye(3)]
    for axis in axes:
        assert np.linalg.norm(axis) == pytest.approx(math.sqrt(2 / 3))
    for first, second in ((0, 1), (1, 2), (2, 0)):
        cosine = axes[first] @ axes[second] / (2 / 3)
        assert math.degrees(math.acos(cosine)) == pytest.approx(120)
    assert axes[1][0] == pytest.approx(0)  # y is upright


def test_dimetric_is_that_of_iso_5456() -> None:
    camera = preset_view("Dimetric").camera
    x, y, z = (np.array(projected(camera, axis)) for axis in np.eye(3))
    assert np.linalg.norm(x) == pytest.approx(np.linalg.norm(y))
    assert np.linalg.norm(z) == pytest.approx(np.linalg.norm(y) / 2)
    assert math.degrees(math.atan2(-x[1], x[0])) == pytest.approx(7, abs=0.3)
    assert math.degrees(math.atan2(-z[1], -z[0])) == pytest.approx(42, abs=0.7)
    assert y[0] == pytest.approx(0)


@pytest.mark.parametrize(("name", "factor"), [("Cavalier", 1.0), ("Cabinet", 0.5)])
def test_oblique_edges_recede_at_45_degrees(name: str, factor: float) -> None:
    """The front face of the unit cube stays a unit square."""
    camera = preset_view(name).camera
    assert projected(camera, (1, 0, 0)) == pytest.approx((1, 0))
    assert projected(camera, (0, 1, 0)) == pytest.approx((0, 1))
    away = np.array(projected(camera, (0, 0, -1)))
    assert np.linalg.norm(away) == pytest.approx(factor)
    assert math.degrees(math.atan2(away[1], away[0])) == pytest.approx(45)
    # The rays' angle with the image plane: 45 degrees, or arctan 2.
    sine = abs(camera.w[2]) / np.linalg.norm(camera.w)
    assert math.tan(math.asin(sine)) == pytest.approx(1 / factor)
    corners = camera.project(CUBE, SIZE)
    unit = SIZE[0] / (camera.viewport[1] - camera.viewport[0])
    assert np.ptp(corners.column) == pytest.approx((1 + factor * math.sqrt(0.5)) * unit)
    assert np.ptp(corners.row) == pytest.approx((1 + factor * math.sqrt(0.5)) * unit)


@pytest.mark.parametrize("preset", PRESETS, ids=lambda preset: preset.name)
@pytest.mark.parametrize("scene", BUILTIN_SCENES)
def test_every_preset_frames_every_scene(scene: str, preset: Preset) -> None:
    loaded = load_scene(scene)
    focus = scene_focus(loaded)
    assert len(focus.framed)
    view = make_view(preset, loaded.view, focus.framed, focus.bounds, 16 / 9)
    assert view.fit == loaded.view.fit
    camera = view.for_size(SIZE)
    corners = camera.project(focus.framed, SIZE)
    assert (corners.parameter > 0).all()
    assert corners.row.min() > -0.5
    assert corners.column.min() > -0.5
    assert corners.row.max() < SIZE[1] - 0.5
    assert corners.column.max() < SIZE[0] - 0.5
    filled = max(np.ptp(corners.row) / SIZE[1], np.ptp(corners.column) / SIZE[0])
    assert filled > 0.6  # and they fill it
    assert (camera.project(focus.bounds, SIZE).parameter > 0).all()


def test_presets_are_legal_named_once_and_orthonormal_but_for_the_oblique() -> None:
    assert len({preset.name for preset in PRESETS}) == len(PRESETS)
    for preset in PRESETS:
        camera = Camera(u=preset.u, v=preset.v, w=preset.w)
        assert is_orthonormal(camera) is not (preset.name in ("Cavalier", "Cabinet"))
        assert camera.determinant > 0


@given(cameras(0.05), st.lists(vectors, min_size=1, max_size=12))
def test_framed_points_are_in_the_picture(camera: Camera, points: list) -> None:
    after = framed(camera, points)
    assert (after.u, after.v, after.w, after.distance) == (
        camera.u,
        camera.v,
        camera.w,
        camera.distance,
    )
    if not camera.is_parallel:
        assert after.viewport == camera.viewport
    corners = after.project(points, (100, 100))
    assert (corners.parameter > 0).all()
    for place in (corners.row, corners.column):
        assert place.min() > -0.51
        assert place.max() < 99.51
    if len(set(points)) > 1 and camera.is_parallel:
        filled = max(np.ptp(corners.row), np.ptp(corners.column)) / 100
        across = np.ptp(np.array(points) @ np.transpose([camera.u, camera.v]), axis=0)
        assert filled == pytest.approx(1 / MARGIN, rel=1e-3) or across.max() < 0.01


def test_the_eye_stays_before_the_nearest_point_by_a_part_of_the_depth() -> None:
    points = [(0.0, 0.0, 10.0), (0.0, 0.0, 30.0)]
    assert framed(Camera(), points).eye == pytest.approx((0, 0, 31), abs=0.01)


def test_nothing_to_frame_leaves_the_camera() -> None:
    assert framed(Camera(eye=(1, 2, 3)), np.zeros((0, 3))) == Camera(eye=(1, 2, 3))


def test_look_at_aims_and_leaves_the_rest() -> None:
    view = View(Camera(distance=2.0, viewport=(-1, 1, 0, 1), near=0.5), fit=True)
    after = look_at(view, (3, 4, 5), (0, 1, 0), (0, 2, 0))
    camera = after.camera
    assert after.fit
    assert (camera.distance, camera.viewport, camera.near) == (2.0, (-1, 1, 0, 1), 0.5)
    assert camera.eye == (3, 4, 5)
    assert np.multiply(camera.w, 43**0.5) == pytest.approx((3, 3, 5))  # away from the target
    assert np.multiply(camera.u, 34**0.5) == pytest.approx((5, 0, -3))  # up x w


def test_clip_planes_clip_nothing() -> None:
    near, far = clip_around(Camera(eye=(0.5, 0.5, 4)), CUBE)
    assert 2.9 < near < 3
    assert 4 < far < 4.1


def test_near_is_at_least_a_thousandth_of_far() -> None:
    camera = Camera()
    assert clip_around(camera, [(0, 0, -1), (0, 0, -0.0009)]) == (1.01 / 1000, 1.01)
    assert clip_around(camera, [(0, 0, -1), (0, 0, -0.0011)]) == (0.00108, 1.01)
    assert clip_around(camera, [(0, 0, -1), (0, 0, -0.0010197)]) == (1.01 / 1000, 1.01)
