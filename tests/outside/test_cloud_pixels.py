"""A cloud's pixels: where its points and lines are, what hides them; parts make the whole."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from app.outside import cloud_layer
from app.outside.cloud import Cloud
from app.outside.cloud_layer import CloudLayer
from app.outside.diagram import Segments
from app.outside.frustum import plane_corners
from app.outside.paint import role_color
from app.outside.screen import OutsideScreen
from renderer.camera import Camera
from renderer.raster import Rasterizer
from renderer.raster import cloud as raster_cloud
from renderer.raster.overlay import CLOUD_HIDDEN, Overlay, plane_on_screen
from renderer.scene.model import Material, Scene, SceneObject, Sphere

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
    """Far from the origin its float32 would be coarse: it counts from a place of its own."""
    places = np.asarray(points, float).reshape(-1, 3)
    origin = np.array([0.25, -0.5, 0.125])
    colors = np.broadcast_to(np.array(color, np.uint8), (len(places), 3))
    around = np.array([np.full(3, -reach), np.full(3, reach)])
    item = Segments("poses", "pose", np.asarray(lines, float), 3.0)
    return Cloud(item, origin, (places - origin).astype(np.float32), colors, around)


@contextmanager
def drawing(
    rasterizer: Rasterizer, cloud: Cloud, camera: Camera, scene: Scene = EMPTY, **more: Any
) -> Iterator[tuple[CloudLayer, Callable[[], NDArray[np.int64]]]]:
    """A layer, and what draws the view with what is in it by then: (height, width, 3)."""
    rasterizer.set_scene(scene)
    screen = OutsideScreen(camera, SIZE, 1e-3)
    with rasterizer.current() as gl:
        overlay, layer = Overlay(gl), CloudLayer(gl)

        def draw() -> NDArray[np.int64]:
            textures = rasterizer.draw(camera, SIZE, "outside")
            picture = layer.picture(cloud, screen, GROUND)
            list(overlay.steps(textures, camera, SIZE, [], cloud=picture, **more))
            rows = np.frombuffer(overlay.drawn[0].read(), np.uint8).reshape(SIZE[1], SIZE[0], 4)
            assert rows[..., 3].min() == 255  # ImGui blends it
            return rows[..., :3].astype(int)

        try:
            yield layer, draw
        finally:
            layer.release()
            overlay.release()


def drawn(rasterizer: Rasterizer, *given: Any, **more: Any) -> NDArray[np.int64]:
    with drawing(rasterizer, *given, **more) as (_, draw):
        return draw()


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
def test_of_two_points_the_nearer_is_seen(rasterizer: Rasterizer, camera: Camera) -> None:
    toward = np.asarray(camera.w) if camera.is_parallel else np.asarray(camera.eye)
    near, far = 0.2 * toward, np.zeros(3)
    for order in ((near, far), (far, near)):
        cloud = a_cloud(order, color=[RED if place is near else (0, 0, 255) for place in order])
        assert at(drawn(rasterizer, cloud, camera), camera, far).tolist() == [255, 0, 0]


@pytest.mark.parametrize("camera", CAMERAS)
def test_the_scene_makes_what_is_behind_it_pale(rasterizer: Rasterizer, camera: Camera) -> None:
    toward = np.asarray(camera.w) if camera.is_parallel else np.asarray(camera.eye)
    toward = toward / np.linalg.norm(toward)
    for place, light in ((1.2 * toward, 1.0), (-1.2 * toward, CLOUD_HIDDEN)):
        found = at(drawn(rasterizer, a_cloud([place]), camera, BALL), camera, place)
        assert found[0] == pytest.approx(255 * light, abs=2)
        assert at(drawn(rasterizer, a_cloud([place]), camera), camera, place)[0] == 255


@pytest.mark.parametrize("camera", CAMERAS)
def test_the_picture_on_the_image_plane_makes_what_is_behind_it_pale(
    rasterizer: Rasterizer, camera: Camera
) -> None:
    inner = Camera(eye=(0.0, 0.0, 1.0), viewport=(-0.8, 0.8, -0.6, 0.6))
    corners = plane_corners(inner)[[0, 1, 3]]
    plane = plane_on_screen(camera, SIZE, corners, np.asarray(inner.eye))
    for place, light in (((0.1, 0.1, 0.5), 1.0), ((0.1, 0.1, -0.5), CLOUD_HIDDEN)):
        with rasterizer.current() as gl:
            picture = gl.texture((1, 1), 4, bytes((0, 0, 0, 255)))
        found = drawn(rasterizer, a_cloud([place]), camera, plane=plane, picture=picture)
        assert at(found, camera, place)[0] == pytest.approx(255 * light, abs=2)
        picture.release()


@pytest.mark.parametrize("projection", ["perspective", "parallel"])
def test_what_reaches_behind_the_eye_that_looks_is_cut_there(
    rasterizer: Rasterizer, projection: str
) -> None:
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


def some(count: int, lines: int) -> Cloud:
    generator = np.random.default_rng(5)
    ends = generator.uniform(-0.9, 0.9, (lines, 2, 3))
    ends[:, 1] = ends[:, 0] + 0.2 * (ends[:, 1] - ends[:, 0])
    return a_cloud(generator.uniform(-1, 1, (count, 3)), ends)


def test_what_is_drawn_in_parts_is_the_whole_in_the_end(
    rasterizer: Rasterizer, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A device so slow that a frame has time for one point and one line."""
    cloud = some(400, 60)
    with drawing(rasterizer, cloud, LOOKING) as (layer, draw):
        whole = draw()
        assert layer.settled
    monkeypatch.setattr(raster_cloud, "LINES", 16)
    monkeypatch.setattr(cloud_layer, "STILL_S", 1e6)
    slow = {"points": 1.0, "thin": 1.0, "wide": 1.0}
    monkeypatch.setattr(cloud_layer, "GUESSED_S", slow)
    with drawing(rasterizer, cloud, LOOKING) as (layer, draw):
        seen = [draw()]
        assert np.array_equal(draw(), seen[0])  # while the view moves, nothing is refined
        assert not layer.settled
        monkeypatch.setattr(cloud_layer, "STILL_S", -1.0)
        numbers = [layer.number]
        while not layer.settled:
            assert len(seen) < 500
            seen.append(draw())
            numbers.append(layer.number)
        assert (np.diff(numbers) > 0).all()  # each picture is another one
        assert (seen[0] > 0).any() and (seen[0] > 0).sum() < 0.2 * (whole > 0).sum()
        differ = np.abs(seen[-1] - whole).max(axis=2) > 8
        assert differ.mean() < 0.02  # where lines cross, the other one is over
        draw()
        assert layer.number == numbers[-1]  # nothing is drawn that nothing asked for


def test_no_camera_breaks_it(rasterizer: Rasterizer) -> None:
    for camera in (
        Camera.look_at((1e6, 0, 0), (0, 0, 0)),
        Camera.look_at((1e-6, 0, 0), (0, 0, 0)),
        Camera(eye=(0.0, 0.5, 0.5), viewport=(-1e6, 1e6, -1e6, 1e6), projection="parallel"),
        Camera.look_at((0, 0, -9), (0, 0, -10)),
    ):
        assert drawn(rasterizer, some(50, 20), camera).shape == (SIZE[1], SIZE[0], 3)
    assert drawn(rasterizer, a_cloud(), LOOKING).max() == 0
    assert drawn(rasterizer, a_cloud([(0, 0, 0)], reach=0.0), LOOKING).max() == 255
