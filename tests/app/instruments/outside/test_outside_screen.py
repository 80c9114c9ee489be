"""Projection from the world to the pixels of the outside view."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from looked_at import LOOKING, SIZE, cameras, looking_cameras, vectors

from lucida.app.instruments.outside.diagram import Arrow, Label, Segments, polyline
from lucida.app.instruments.outside.frustum import plane_corners
from lucida.app.instruments.outside.projected import Shape, Strokes, Text, project
from lucida.app.instruments.outside.screen import OutsideScreen
from lucida.renderer.camera.camera import Camera
from lucida.renderer.raster.overlay import plane_on_screen


@pytest.mark.parametrize("camera", looking_cameras())
def test_points_are_where_the_camera_has_them(camera: Camera) -> None:
    screen = OutsideScreen(camera, SIZE)
    for point in np.random.default_rng(1).uniform(-1, 1, (20, 3)):
        row, column, parameter = camera.project(point, SIZE)
        _, at, depth, visible = screen.seen(point)
        assert visible
        assert np.allclose(at, (column + 0.5, row + 0.5))
        assert np.isclose(depth, parameter if camera.is_parallel else 1 / parameter)


@pytest.mark.parametrize("projection", ["perspective", "parallel"])
def test_the_direction_to_the_viewer_is_a_unit_vector(projection: Any) -> None:
    camera = Camera(eye=(0, 0, 5), w=(0, 0, 2), projection=projection)
    screen = OutsideScreen(camera, SIZE)
    assert np.allclose(screen.toward_viewer(np.array([0.0, 0.0, -3.0])), (0, 0, 1))
    assert np.allclose(screen.toward_viewer(np.array([0.0, 0.0, 5.0])), (0, 0, 1))


@given(cameras(), st.lists(st.tuples(vectors, vectors), min_size=1, max_size=10))
def test_segments_are_clipped_to_the_guard(camera: Camera, ends: list[Any]) -> None:
    screen = OutsideScreen(camera, SIZE, 1e-3)
    world = 3 * np.array(ends)
    points, depth, numbers = screen.segments(world)
    assert np.isfinite(points).all()
    assert np.isfinite(depth).all()
    assert (np.abs(points - np.array(SIZE) / 2) <= 4.001 * np.array(SIZE) / 2).all()
    assert (depth > 0).all()
    for segment, number in zip(points, numbers, strict=True):
        for end, spot in zip(segment, map(screen.seen, world[number]), strict=True):
            if spot.visible:
                atol = 1e-6 * (1 + np.abs(spot.points).max())
                assert np.allclose(end, spot.points, atol=atol)
    visible = {k for k, pair in enumerate(world) if screen.seen(pair).visible.any()}
    assert visible <= set(numbers.tolist())


def test_a_segment_from_behind_is_clipped_at_near() -> None:
    screen = OutsideScreen(Camera.canonical(), (100, 100), 0.5)
    points, depth, _ = screen.segments(np.array([[[0, 0, 5.0], [0.5, 0, -5.0]]]))
    # At t = 0.5 the segment is at x = 0.275; seen from the eye, 0.55 to the right of it.
    assert np.allclose(points[0, 0], (50 + 55, 50))
    assert np.allclose(depth[0], (2.0, 0.2))


def test_a_polygon_around_the_viewer_is_clipped() -> None:
    corners = np.array([[-9, -1, 9], [9, -1, 9], [9, -1, -9], [-9, -1, -9]], float)
    points, depth = OutsideScreen(Camera.canonical(), (100, 100), 0.1).polygon(corners)
    assert len(points) >= 3
    assert np.isfinite(points).all()
    assert (depth > 0).all()
    assert (points[:, 1] > 50).all()  # all of a floor is below the horizon


def test_dashes_go_on_from_segment_to_segment() -> None:
    path = polyline(np.array([[-0.2, 0, -1], [0, 0, -1], [0.2, 0.1, -1]], float))
    (strokes,) = project(
        [Segments("l", "extra", path)], OutsideScreen(Camera.canonical(), (100, 100))
    )
    assert isinstance(strokes, Strokes)
    assert np.allclose(strokes.before, [0, 20])


@pytest.mark.parametrize("camera", looking_cameras())
def test_arrows_end_at_their_vectors_tips(camera: Camera) -> None:
    start, end = np.array([0, 0, -1.0]), np.array([0.4, 0.9, -0.5])
    screen = OutsideScreen(camera, (640, 480))
    parts = project([Arrow("u", "u", start, end)], screen)
    tip = screen.seen(end)
    assert tip.visible
    heads = [p for p in parts if isinstance(p, Shape) and p.name == "u head"]
    assert np.linalg.norm(heads[0].points - tip.points, axis=1).min() < 1e-6
    (shaft,) = (p for p in parts if isinstance(p, Strokes) and p.name == "u")
    assert np.linalg.norm(shaft.points[0, 1] - tip.points) < 20


def test_labels_stand_off_their_arrow_and_vanish_with_short_ones() -> None:
    screen = OutsideScreen(Camera.canonical(), (100, 100))
    origin = np.array([0.0, 0, -1])
    label = Label("v", "v", "v", np.array([0, 0.3, -1]), away=origin, strong=True, least=8.0)
    (text,) = project([label], screen)
    assert isinstance(text, Text)
    assert np.allclose(text.toward, (0, -1))  # up on the screen
    assert np.allclose(text.at, (50, 20))
    short = replace(label, point=np.array([0, 0.05, -1]))
    assert project([short], screen) == []
    behind = replace(label, point=np.array([0, 0, 1.0]))
    assert project([behind], screen) == []


def test_a_plane_has_a_front_and_a_back_and_is_hidden_edge_on() -> None:
    inner = Camera.canonical()
    corners, eye = plane_corners(inner)[[0, 1, 3]], np.asarray(inner.eye)
    behind = Camera.look_at((0, 0, -3), (0, 0, 0))
    for camera, front in ((LOOKING, True), (behind, False)):
        plane = plane_on_screen(camera, SIZE, corners, eye)
        assert plane is not None
        assert plane.is_front == front
    edge_on = Camera.look_at((3, 0, -1), (0, 0, -1))
    assert plane_on_screen(edge_on, SIZE, corners, eye) is None
