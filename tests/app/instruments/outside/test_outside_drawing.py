"""The outside view's pixels: the picture on the image plane, and which lines are hidden."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from lucida.app.instruments.outside.diagram import Item, Role, Segments
from lucida.app.instruments.outside.frustum import pixel_corners, plane_corners
from lucida.app.instruments.outside.paint import figure_color, ground_of, layers, role_color
from lucida.app.instruments.outside.projected import project
from lucida.app.instruments.outside.screen import OutsideScreen
from lucida.app.ui import contrast, palettes, theme
from lucida.renderer.camera.camera import Camera
from lucida.renderer.raster import Rasterizer
from lucida.renderer.raster.overlay import (
    Overlay,
    PlacedPicture,
    Plane,
    ShownScene,
    plane_on_screen,
)
from lucida.renderer.scene.material import Material
from lucida.renderer.scene.model import Scene, SceneObject, Sphere

SIZE = (160, 120)
INNER = Camera(eye=(0.3, -0.2, 2.0), viewport=(-0.8, 0.9, -0.4, 0.6), w=(0.1, 0.0, 1.0))
# Four colours, one a corner: row 0 is the top.
PICTURE = np.array(
    [[(255, 0, 0, 255), (0, 255, 0, 255)], [(0, 0, 255, 255), (255, 255, 0, 255)]], np.uint8
)
DARK_GROUND = (0.0, 0.0, 0.0)
STRAIGHT = Camera.look_at((0, 0, 4), (0, 0, 0), fov_y_deg=45.0, aspect=4 / 3)
EMPTY = Scene((), background=(0.0, 0.0, 0.0))
BALL = Scene(
    (SceneObject(Sphere((0.0, 0.0, 0.0), 1.0), Material(diffuse=(0.1, 0.1, 0.1))),),
    background=(0.0, 0.0, 0.0),
)


def outsides() -> list[Camera]:
    """In perspective and parallel projection, from before and behind the plane, mirrored too."""
    before = Camera.look_at((2.0, 1.5, 5.0), (0.3, 0.0, 1.0), fov_y_deg=35.0, aspect=4 / 3)
    behind = Camera.look_at((1.0, 1.0, -3.0), (0.3, 0.0, 1.0), fov_y_deg=35.0, aspect=4 / 3)
    parallel = Camera.look_at((2.0, 1.5, 5.0), (0.3, 0.0, 1.0), projection="parallel")
    wide = (-2.0, 2.0, -1.5, 1.5)
    mirrored = tuple(-np.asarray(before.u))
    return [
        before,
        behind,
        Camera(parallel.eye, parallel.u, parallel.v, parallel.w, 1.0, wide, "parallel"),
        Camera(before.eye, mirrored, before.v, before.w, before.distance, before.viewport),
    ]


def drawn(
    rasterizer: Rasterizer,
    scene: Scene,
    camera: Camera,
    items: list[Item],
    plane: Plane | None = None,
    unit_px: float = 1.0,
) -> NDArray[np.uint8]:
    """The view's pixels, (height, width, 3)."""
    rasterizer.set_scene(scene)
    with rasterizer.current() as gl:
        overlay = Overlay(gl)
        picture: Any = None
        if plane is not None:
            picture = gl.texture((2, 2), 4, PICTURE.tobytes())
        try:
            primitives = project(items, OutsideScreen(camera, SIZE, 1e-3, unit_px))
            texture = overlay.draw(
                ShownScene(rasterizer.draw(camera, SIZE, "outside")),
                camera,
                SIZE,
                layers(primitives, DARK_GROUND),
                unit_px,
                PlacedPicture(plane, picture) if plane is not None else None,
            )
            pixels = np.frombuffer(texture.read(), np.uint8).reshape(SIZE[1], SIZE[0], 4)
            assert pixels[..., 3].min() == 255  # ImGui blends it
        finally:
            overlay.release()
            if picture is not None:
                picture.release()
    return pixels[..., :3]


def at(pixels: NDArray[np.uint8], camera: Camera, point: Any) -> NDArray[np.int64]:
    """The colour where a world point is."""
    row, column, _ = camera.project(np.asarray(point, float), SIZE)
    return pixels[round(float(row)), round(float(column))].astype(int)


def solid_color(role: Role) -> NDArray[np.float64]:
    ink = role_color(role)
    return 255 * np.array([ink.x, ink.y, ink.z])


def picture_plane(camera: Camera) -> Plane:
    corners = plane_corners(INNER)
    plane = plane_on_screen(camera, SIZE, corners[[0, 1, 3]], np.asarray(INNER.eye))
    assert plane is not None
    return plane


@pytest.mark.parametrize("number", range(4))
def test_the_picture_stands_as_the_camera_sees_it(rasterizer: Rasterizer, number: int) -> None:
    """Each pixel of the picture is where its viewing ray goes through the image plane."""
    camera = outsides()[number]
    plane = picture_plane(camera)
    pixels = drawn(rasterizer, EMPTY, camera, [], plane)
    light = 1.0 if plane.is_front else 0.55
    for i in range(2):
        for j in range(2):
            corners = pixel_corners(INNER, (i, j), (2, 2))
            for part in (0.25, 0.5, 0.75):
                point = corners[0] + part * (corners[2] - corners[0])
                found = at(pixels, camera, point)
                assert np.allclose(found, light * PICTURE[i, j, :3], atol=2), (i, j, part)
    corners = plane_corners(INNER)
    outside = corners[0] + 1.15 * (corners[2] - corners[0])
    assert at(pixels, camera, outside).max() == 0


def test_the_scene_hides_the_picture_and_is_hidden_by_it(rasterizer: Rasterizer) -> None:
    camera = outsides()[0]
    plane = picture_plane(camera)
    middle = pixel_corners(INNER, (1, 1), (2, 2)).mean(axis=0)
    toward = np.asarray(camera.eye) - middle
    near, far = middle + 0.3 * toward, middle - 0.3 * toward
    for center, hidden in ((near, False), (far, True)):
        scene = Scene((SceneObject(Sphere(tuple(center), 0.1)),), background=(0, 0, 0))
        seen = at(drawn(rasterizer, scene, camera, [], plane), camera, middle)
        assert np.allclose(seen, PICTURE[1, 1, :3], atol=2) == hidden


def line(start: Any, end: Any, **more: Any) -> Segments:
    return Segments("l", "extra", np.array([[start, end]], float), **more)


@pytest.mark.parametrize("projection", ["perspective", "parallel"])
def test_a_line_is_solid_before_an_object_and_pale_dashes_behind_it(
    rasterizer: Rasterizer, projection: str
) -> None:
    camera = Camera.look_at((0, 0, 6), (0, 0, 0), fov_y_deg=40.0, aspect=4 / 3)
    if projection == "parallel":
        wide = (-2.0, 2.0, -1.5, 1.5)
        camera = Camera(camera.eye, camera.u, camera.v, camera.w, 1.0, wide, "parallel")
    ground = drawn(rasterizer, BALL, camera, [])
    solid = solid_color("extra")
    for z, hidden in ((1.5, False), (-1.5, True)):
        item = line((-1.9, 0.1, z), (1.9, 0.1, z), width=3.0, hidden=0.4)
        pixels = drawn(rasterizer, BALL, camera, [item])
        row = round(float(camera.project((0, 0.1, z), SIZE)[0]))
        across = pixels[row].astype(float)
        inside = [int(camera.project((x, 0.1, z), SIZE)[1]) for x in (-0.5, 0.5)]
        over = across[inside[0] : inside[1]]
        is_ink = np.abs(over - solid).max(axis=1) < 3
        if not hidden:
            assert is_ink.all()
        else:
            assert not is_ink.any()
            plain = np.abs(over - ground[row, inside[0] : inside[1]]).max(axis=1) < 2
            assert 0.2 < plain.mean() < 0.8  # dashes and gaps
        # Beside the ball nothing hides it.
        left = int(camera.project((-1.7, 0.1, z), SIZE)[1])
        assert np.abs(across[max(left, 1)] - solid).max() < 3


def test_the_picture_hides_lines_but_not_its_own(rasterizer: Rasterizer) -> None:
    camera = outsides()[0]
    plane = picture_plane(camera)
    corners = plane_corners(INNER)
    middle = corners.mean(axis=0)
    across = 0.3 * (corners[1] - corners[0])
    away = middle - np.asarray(camera.eye)
    solid = solid_color("extra")

    def is_solid(item: Segments, point: Any) -> bool:
        pixels = drawn(rasterizer, EMPTY, camera, [item], plane)
        return bool(np.abs(at(pixels, camera, point) - solid).max() < 4)

    own = line(middle - across, middle + across, width=3.0, on_plane=True)
    assert is_solid(own, middle)
    for shift, seen in ((-0.1, True), (0.1, False)):
        other = middle + shift * away
        item = line(other - across, other + across, width=3.0, hidden=0.0)
        assert is_solid(item, other) == seen


@pytest.mark.parametrize("width", [1.0, 4.0, 12.0])
def test_lines_are_as_wide_as_they_say(rasterizer: Rasterizer, width: float) -> None:
    """By their coverage, whatever their direction; without their casing, which is black here."""
    assert (solid_color("grid") == 255).all()
    for end in ((1.0, 0.0, 0.0), (0.7, 0.7, 0.0), (0.3, -0.9, 0.0)):
        item = Segments("l", "grid", np.array([[(0, 0, 0), end]], float), width)
        pixels = drawn(rasterizer, EMPTY, STRAIGHT, [item]) / 255.0
        screen = OutsideScreen(STRAIGHT, SIZE)
        points, _, _ = screen.segments(item.segments)
        length = float(np.linalg.norm(points[0, 1] - points[0, 0]))
        area = pixels[..., 0].sum()
        wanted = width * length + np.pi * width**2 / 4
        # A pixel's coverage comes from one distance: thin slanted lines are a little uneven.
        assert abs(area - wanted) < 0.05 * wanted + 0.15 * length / width


def test_pictures_that_are_shifted_have_a_mean_with_smooth_edges(rasterizer: Rasterizer) -> None:
    white = Scene(BALL.objects, background=(1.0, 1.0, 1.0))
    rasterizer.set_scene(white)
    with rasterizer.current() as gl:
        overlay = Overlay(gl)
        shifts = ((-0.25, -0.25), (-0.25, 0.25), (0.25, -0.25), (0.25, 0.25))
        for number, shift in enumerate(shifts):
            picture = rasterizer.draw(STRAIGHT.shifted(*shift, SIZE), SIZE, "outside")
            mean = overlay.gather(picture, number == 0, 1 / len(shifts))
        pixels = np.frombuffer(mean.read(), np.float16).reshape(SIZE[1], SIZE[0], 4)
        overlay.release()
    wanted = rasterizer.render(STRAIGHT, SIZE, ("color",), samples=4).color
    assert wanted is not None
    assert np.abs(pixels[..., :3] - wanted).max() < 2e-3


@pytest.mark.parametrize("look", ["dark", "light"])
@pytest.mark.parametrize("presented", [False, True])
@pytest.mark.parametrize("background", [(0, 0, 0), (0.02, 0.03, 0.04), (0.2, 0.2, 0.2), (1, 1, 1)])
def test_the_basis_stands_out_from_the_scenes_ground(monkeypatch, look, presented, background):
    """By the ground that it is drawn on, not by the theme: light themes show dark scenes too."""
    # The public way to a look is a window's.
    monkeypatch.setattr(theme, "_used", [theme.WindowLook(look, presented)])
    ground = ground_of(background, 0.0)
    for name in "uvw":
        color = role_color(name, ground)
        assert contrast.contrast((color.x, color.y, color.z), ground) >= 3.0
        own = role_color(name)
        if look == "light" and max(ground) < 0.35:
            own = palettes.PRESENTED_DARK.BASIS[name]
        if contrast.contrast((own.x, own.y, own.z), ground) >= 3.0:
            assert (color.x, color.y, color.z) == (own.x, own.y, own.z)
        assert contrast.contrast(figure_color(name, 0.0, ground), ground) >= 3.0
