"""A cloud's pixels: the places of its points and lines, and their hidden parts."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from lucida.app.instruments.outside.cloud import Cloud
from lucida.app.instruments.outside.cloud_layer import CloudLayer
from lucida.app.instruments.outside.diagram import Segments
from lucida.app.instruments.outside.paint import role_color
from lucida.app.instruments.outside.screen import OutsideScreen
from lucida.renderer.camera.camera import Camera
from lucida.renderer.raster import Rasterizer
from lucida.renderer.raster.overlay import CLOUD_HIDDEN, Overlay, ShownScene
from lucida.renderer.scene.material import Material
from lucida.renderer.scene.model import Scene, SceneObject, Sphere

SIZE = (160, 120)
GROUND = (0.0, 0.0, 0.0)
EMPTY = Scene((), background=(0.0, 0.0, 0.0))
BALL = Scene(
    (SceneObject(Sphere((0.0, 0.0, 0.0), 0.5), Material(diffuse=(0.0, 0.0, 0.0))),),
    background=(0.0, 0.0, 0.0),
)
LOOKING = Camera.look_at((2.0, 1.5, 5.0), (0.0, 0.0, 0.0), fov_y_deg=35.0, aspect=4 / 3)
PARALLEL = replace(LOOKING, projection="parallel", viewport=(-2.0, 2.0, -1.5, 1.5))
MIRRORED = replace(LOOKING, u=tuple(-x for x in LOOKING.u))
CAMERAS = [LOOKING, PARALLEL, MIRRORED]
RED = (255, 0, 0)
NO_LINES = np.zeros((0, 2, 3))


def a_cloud(
    points: Any = (), lines: NDArray[np.float64] = NO_LINES, color: Any = RED, reach: float = 2.0
) -> Cloud:
    """Return a cloud whose float32 positions count from an origin of its own."""
    places = np.asarray(points, float).reshape(-1, 3)
    origin = np.array([0.25, -0.5, 0.125])
    colors = np.broadcast_to(np.array(color, np.uint8), (len(places), 3))
    around = np.array([np.full(3, -reach), np.full(3, reach)])
    item = Segments("poses", "pose", np.asarray(lines, float), 3.0)
    return Cloud(item, origin, (places - origin).astype(np.float32), colors, around)


def drawn(
    rasterizer: Rasterizer, cloud: Cloud, camera: Camera, scene: Scene = EMPTY
) -> NDArray[np.int64]:
    """Return the view's pixels, (height, width, 3)."""
    rasterizer.set_scene(scene)
    screen = OutsideScreen(camera, SIZE, 1e-3)
    with rasterizer.current() as gl:
        overlay, layer = Overlay(gl), CloudLayer(gl)
        try:
            textures = rasterizer.draw(camera, SIZE, "outside")
            picture = layer.picture(cloud, screen, GROUND)
            texture = overlay.draw(ShownScene(textures), camera, SIZE, [], cloud=picture)
            rows = np.frombuffer(texture.read(), np.uint8).reshape(SIZE[1], SIZE[0], 4)
            assert rows[..., 3].min() == 255  # ImGui blends it
            return rows[..., :3].astype(int)
        finally:
            layer.release()
            overlay.release()


def at(pixels: NDArray[np.int64], camera: Camera, point: Any) -> NDArray[np.int64]:
    row, column, _ = camera.project(np.asarray(point, float), SIZE)
    return pixels[round(float(row)), round(float(column))]


@pytest.mark.parametrize("camera", CAMERAS)
def test_points_are_where_the_camera_projects_them(rasterizer: Rasterizer, camera: Camera) -> None:
    places = np.random.default_rng(3).uniform(-0.9, 0.9, (12, 3))
    pixels = drawn(rasterizer, a_cloud(places), camera)
    for place in places:
        assert at(pixels, camera, place).tolist() == [255, 0, 0]
    assert 12 * 4 < (pixels[..., 0] > 0).sum() <= 12 * 16  # small squares, nothing else


@pytest.mark.parametrize("camera", CAMERAS)
def test_lines_are_where_the_camera_projects_them(rasterizer: Rasterizer, camera: Camera) -> None:
    ends = np.array([[(-0.8, -0.4, 0.3), (0.9, 0.5, -0.2)], [(-0.5, 0.6, 0.0), (-0.5, -0.6, 0.5)]])
    pixels = drawn(rasterizer, a_cloud(lines=ends), camera)
    ink = role_color("pose")
    for start, end in ends:
        for part in (0.05, 0.3, 0.62, 0.95):
            found = at(pixels, camera, start + part * (end - start))
            assert np.abs(found - 255 * np.array([ink.x, ink.y, ink.z])).max() < 8
    assert (pixels > 0).any(axis=2).mean() < 0.05


@pytest.mark.parametrize("camera", CAMERAS)
def test_the_nearer_of_two_points_is_drawn(rasterizer: Rasterizer, camera: Camera) -> None:
    toward = np.asarray(camera.w) if camera.is_parallel else np.asarray(camera.eye)
    near, far = 0.2 * toward, np.zeros(3)
    for order in ((near, far), (far, near)):
        cloud = a_cloud(order, color=[RED if place is near else (0, 0, 255) for place in order])
        assert at(drawn(rasterizer, cloud, camera), camera, far).tolist() == [255, 0, 0]


@pytest.mark.parametrize("camera", CAMERAS)
def test_points_behind_the_scene_are_pale(rasterizer: Rasterizer, camera: Camera) -> None:
    toward = np.asarray(camera.w) if camera.is_parallel else np.asarray(camera.eye)
    toward = toward / np.linalg.norm(toward)
    for place, light in ((1.2 * toward, 1.0), (-1.2 * toward, CLOUD_HIDDEN)):
        found = at(drawn(rasterizer, a_cloud([place]), camera, BALL), camera, place)
        assert found[0] == pytest.approx(255 * light, abs=2)
        assert at(drawn(rasterizer, a_cloud([place]), camera), camera, place)[0] == 255


@pytest.mark.parametrize("projection", ["perspective", "parallel"])
def test_a_cloud_is_clipped_at_the_outside_camera(rasterizer: Rasterizer, projection: str) -> None:
    camera = Camera(viewport=(-0.5, 0.5, -0.375, 0.375), projection=projection)
    line = np.array([[(0.0, -0.2, -1.5), (0.0, -0.2, 2.0)]])
    points = [(0.1, 0.1, -1.0), (0.1, 0.1, 1.0)]
    pixels = drawn(rasterizer, a_cloud(points, line), camera)
    assert at(pixels, camera, points[0]).tolist() == [255, 0, 0]
    assert at(pixels, camera, (0.0, -0.2, -1.4)).max() > 100
    above = pixels[: SIZE[1] // 2]
    assert (above.max(axis=2) > 0).sum() <= 16  # the other half of the line is not mirrored there
    behind = a_cloud(points[1:], line + np.array([0.0, 0.0, 4.0]))
    assert drawn(rasterizer, behind, camera).max() == 0
