"""A second camera in the outside view, drawn from its rays."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from lucida.app.instruments.outside.diagram import Dot, Item, Label, Segments
from lucida.app.instruments.outside.projected import Strokes, project
from lucida.app.instruments.outside.screen import OutsideScreen
from lucida.app.instruments.outside.second_camera import (
    GivenRay,
    corner_rays,
    second_camera,
    second_ray,
)
from lucida.renderer.camera.camera import Camera

SIZE = (40, 30)
REACH = 6.0
CAMERA = Camera.look_at((0.0, 1.0, 4.0), (0.0, 0.0, 0.0), aspect=4 / 3)
LOOKING = Camera.look_at((6.0, 5.0, 9.0), (0.0, 0.0, 1.0))


def corners(camera: Camera = CAMERA) -> tuple[np.ndarray, np.ndarray]:
    rays = camera.rays(SIZE)
    origins = np.broadcast_to(rays.origin, (*SIZE[::-1], 3))
    directions = np.broadcast_to(rays.direction, origins.shape)
    return corner_rays(origins, directions)


def drawn(origins: np.ndarray, directions: np.ndarray) -> list[Item]:
    return second_camera(origins, directions, REACH, "student's", "pixel (1, 1)")


def named(items, name: str):
    return [item for item in items if item.name == name]


def test_a_perspective_camera_s_edges_leave_its_eye() -> None:
    items = drawn(*corners())
    (edges,) = named(items, "second edges")
    assert np.allclose(edges.segments[:, 0], CAMERA.eye)
    rays = edges.segments[:, 1] - edges.segments[:, 0]
    assert np.linalg.norm(rays, axis=1).mean() == pytest.approx(REACH)
    assert (rays @ np.asarray(CAMERA.w) < 0).all()  # forwards
    (eye,), (label,) = named(items, "second eye"), named(items, "second name")
    assert isinstance(eye, Dot) and np.allclose(eye.point, CAMERA.eye)
    assert isinstance(label, Label) and label.text == "student's"
    x, y = CAMERA.image_point(SIZE[1] - 1, SIZE[0] - 1, SIZE)
    last = np.asarray(CAMERA.eye) + CAMERA.basis @ (x, y, -CAMERA.distance)
    assert np.allclose(label.point, last)  # opposite the first pixel
    plane = named(items, "second image plane")[0].segments[:, 0]
    x, y = CAMERA.image_point(0, 0, SIZE)
    corner = np.asarray(CAMERA.eye) + CAMERA.basis @ (x, y, -CAMERA.distance)
    assert np.allclose(plane[0], corner)
    dot, text = named(items, "second first pixel")
    assert np.allclose(dot.point, corner) and text.text == "pixel (1, 1)"


def test_a_parallel_camera_has_no_eye_and_its_plane_is_where_its_rays_begin() -> None:
    origins, directions = corners(replace(CAMERA, projection="parallel"))
    items = drawn(origins, directions)
    assert not named(items, "second eye")
    assert np.allclose(named(items, "second image plane")[0].segments[:, 0], origins)


def test_a_singular_basis_is_drawn() -> None:
    """All rays in one plane, which no Camera may have."""
    origins, directions = corners()
    directions[:, 1] = 0.0
    parts = project(drawn(origins, directions), OutsideScreen(LOOKING, (200, 150)))
    edges = [part for part in named(parts, "second edges") if isinstance(part, Strokes)]
    assert [part.points.shape for part in edges] == [(4, 2, 2)]
    assert all(np.isfinite(part.points).all() for part in parts if hasattr(part, "points"))


@pytest.mark.parametrize("bad", [np.nan, np.inf, 0.0])
def test_invalid_rays_draw_nothing(bad) -> None:
    directions = np.full((4, 3), bad)
    ray = GivenRay(np.zeros(3), np.full(3, bad))
    assert drawn(np.zeros((4, 3)), directions) == [] and second_ray(ray, REACH) == []


def test_a_ray_ends_at_its_hit_or_at_the_reach() -> None:
    ray = GivenRay(np.array([1.0, 0.0, 0.0]), np.array([0.0, 0.0, -2.0]))
    for t, end, hits in ((1.5, -3.0, 1), (None, -REACH, 0), (np.inf, -REACH, 0)):
        items = second_ray(replace(ray, t=t), REACH)
        (line,) = named(items, "second ray")
        assert isinstance(line, Segments)
        assert np.allclose(line.segments[0], [(1, 0, 0), (1, 0, end)])
        assert len(named(items, "second hit")) == hits
