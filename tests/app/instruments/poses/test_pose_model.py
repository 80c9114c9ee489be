"""A set of cameras: its frusta, points, names and views."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from sets_of_cameras import SIZE, a_set, ring

from lucida.app.instruments.outside.extent import looked_from
from lucida.app.instruments.outside.frustum import plane_corners
from lucida.app.instruments.poses.model import (
    LINES,
    NO_POINTS,
    cloud,
    frusta,
    pose_set,
)
from lucida.app.state.app_state import AppState
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.lenses import Lens
from lucida.renderer.files.cameras import CameraSet
from lucida.renderer.scene import Scene, View


def test_a_frustum_s_edges_are_the_rays_through_the_image_s_corners() -> None:
    poses = a_set(4)
    lines = frusta(poses).reshape(4, LINES, 2, 3)
    for posed, own in zip(poses.cameras, lines, strict=True):
        camera = posed.camera
        corners = plane_corners(camera)  # upper left, upper right, lower right, lower left
        edges = own[:4]
        assert np.allclose(edges[:, 0], camera.eye)
        ways = edges[:, 1] - edges[:, 0]
        wanted = corners - camera.eye
        assert np.allclose(np.cross(ways, wanted), 0, atol=1e-12)
        assert (np.einsum("ij,ij->i", ways, wanted) > 0).all()
        assert np.linalg.norm(ways, axis=1).mean() == pytest.approx(poses.length)
        assert np.allclose(own[4:8, 0], edges[:, 1])  # the image's sides go round its corners
        assert np.allclose(own[4:8, 1], np.roll(edges[:, 1], -1, axis=0))
        tip = own[8:, 1]
        assert np.allclose(tip[0], tip[1])
        assert ((tip[0] - edges[:2, 1].mean(axis=0)) @ camera.v) > 0  # the mark for up


def test_a_parallel_camera_has_a_box() -> None:
    posed = ring(1)[0]
    camera = replace(posed.camera, projection="parallel")
    poses = pose_set(Path("x.json"), CameraSet("nerf", (replace(posed, camera=camera),)))
    edges = frusta(poses)[:4]
    assert np.allclose(edges[:, 1] - edges[:, 0], -poses.length * np.asarray(camera.w))
    sides = edges[:, 0] - camera.eye
    assert np.allclose(sides @ np.asarray(camera.u), [camera.viewport[k] for k in (0, 1, 1, 0)])
    assert np.allclose(sides @ np.asarray(camera.v), [camera.viewport[k] for k in (3, 3, 2, 2)])


def test_strays_are_not_framed_and_points_are_shuffled() -> None:
    places = np.linspace(-1, 1, 1000)[:, None] * [1.0, 0.5, 0.25]
    places[-2], places[-1] = (1e6, 0, 0), (np.nan, 0, 0)
    poses = a_set(4, points=places)
    assert len(poses.points) == 999
    assert 2.9 < poses.high[0] < 4  # the cameras are 3 away
    drawn = poses.points + poses.origin.astype(np.float32)
    first = np.sort(drawn[:100, 0])
    assert first[0] < -0.8 and first[-1] > 0.8  # the first ones sample all
    assert np.allclose(np.sort(drawn[:, 0])[:-1], places[:-2, 0], atol=1e-5)
    assert (poses.colors == poses.colors[0, 0]).all()  # gray where the file has none


def test_colours_stay_with_their_points() -> None:
    places = np.linspace(-1, 1, 256)[:, None] * [1.0, 1.0, 1.0]
    colors = np.arange(256, dtype=np.uint8)[:, None].repeat(3, axis=1)
    found = CameraSet("colmap", tuple(ring(3)), (), places, colors)
    poses = pose_set(Path("sparse/0"), found)
    drawn = poses.points[:, 0] + poses.origin[0]
    assert np.allclose(drawn, places[poses.colors[:, 0].astype(int), 0], atol=1e-5)


def test_a_cloud_bounds_its_frusta_and_visible_points() -> None:
    places = np.array([[0.0, 9.0, 0.0], [0.0, -2.0, 0.0]])
    poses = a_set(4, points=places)
    whole, bare = cloud(poses, True), cloud(poses, False)
    assert whole.points is poses.points
    assert bare.points is NO_POINTS[0]
    assert len(whole.lines.segments) == 4 * LINES
    low, high = bare.around.min(axis=0), bare.around.max(axis=0)
    assert ((bare.lines.segments >= low) & (bare.lines.segments <= high)).all()
    assert high[1] < 2 < 9 < whole.around[:, 1].max()


def test_names_leave_out_the_folder_that_all_are_in() -> None:
    assert a_set(2).names == ("000.png", "001.png")
    named = [
        replace(posed, name=name)
        for posed, name in zip(ring(3), ("a/x/1", "a/y/1", "a/y/2"), strict=True)
    ]
    assert pose_set(Path("f"), CameraSet("nerf", tuple(named))).names == ("x/1", "y/1", "y/2")
    flat = [replace(posed, name=name) for posed, name in zip(ring(2), ("a1", "a2"), strict=True)]
    assert pose_set(Path("f"), CameraSet("nerf", tuple(flat))).names == ("a1", "a2")
    nameless = [replace(posed, name="", image="") for posed in ring(2)]
    assert pose_set(Path("f"), CameraSet("nerf", tuple(nameless))).names == ("0", "1")
    same = [replace(posed, name="a/1") for posed in ring(2)]
    assert pose_set(Path("f"), CameraSet("nerf", tuple(same))).names == ("1", "1")


def test_a_lens_bends_the_frusta_and_stays_in_the_view() -> None:
    """An equidistant corner's angle is its radius; an orthographic lens sees at most 90 degrees."""
    posed = ring(1)[0]
    view = replace(posed.camera, viewport=(-1.0, 1.0, -1.0, 1.0), distance=1.0)
    for model, angle in (("equidistant", 2**0.5), ("orthographic", math.pi / 2)):
        camera = replace(view, lens=Lens(model))
        poses = pose_set(Path("f"), CameraSet("f", (replace(posed, camera=camera),)))
        ways = poses.ways[0] / np.linalg.norm(poses.ways[0], axis=1, keepdims=True)
        corners = ways[:: poses.parts]
        assert np.allclose(corners @ -np.asarray(camera.w), math.cos(angle), atol=1e-3)
        sides = frusta(poses)[4:-2]
        assert len(sides) == 4 * poses.parts == len(ways) and poses.parts > 1
        assert np.allclose(sides[:, 0], poses.origins[0] + poses.length * poses.ways[0])
        assert poses.view(0).camera.lens == Lens(model)


def test_up_is_that_of_most_images() -> None:
    assert np.allclose(a_set(8).up, (0, 1, 0), atol=1e-9)
    turned = [
        replace(posed, camera=replace(posed.camera, v=tuple(-x for x in posed.camera.v)))
        for posed in ring(8)
    ]
    assert np.allclose(pose_set(Path("f"), CameraSet("f", tuple(turned))).up, (0, -1, 0))
    long = [
        replace(posed, camera=replace(posed.camera, v=tuple(100 * x for x in posed.camera.v)))
        for posed in turned[:3]
    ]  # lengths have no weight
    assert pose_set(Path("f"), CameraSet("f", (*ring(8)[3:], *long))).up[1] > 0.9


@pytest.mark.parametrize("back", [(0, 0, 1), (1, 2, 0), (0, 1, 0), (0, -3, 0)])
@pytest.mark.parametrize("up", [(0, 1, 0), (0, -1, 0), (0.6, 0.8, 0)])
def test_a_set_is_seen_from_above(back: tuple[float, ...], up: tuple[float, ...]) -> None:
    direction = looked_from(np.array(up, float), np.array(back, float))
    assert np.linalg.norm(direction) == pytest.approx(1.0)
    assert 0.2 < direction @ up < 0.6


def test_a_cameras_view_loses_nothing_in_other_images() -> None:
    poses = a_set(3)
    view = poses.view(1)
    assert (view.camera, SIZE) == view.given == (poses.cameras[1].camera, SIZE)
    assert view.for_size(SIZE).viewport == pytest.approx(view.camera.viewport)
    wide = view.for_size((160, 60)).viewport
    assert wide[2:] == pytest.approx(view.camera.viewport[2:]) and wide[0] < view.camera.viewport[0]


def test_a_camera_keeps_the_shape_of_its_image_s_pixels():
    """The calibration's pixels are 1.2 times as wide as high, in images of any other shape too."""
    camera = Camera(viewport=(-0.6, 0.6, -0.5, 0.5))
    view = View(camera, given=(camera, (100, 100)))
    assert view.for_size((100, 100)) is camera
    for size in ((300, 100), (100, 300), (50, 50)):
        left, right, bottom, top = view.for_size(size).viewport
        assert (right - left) / size[0] / ((top - bottom) / size[1]) == pytest.approx(1.2)
        assert right >= 0.6 - 1e-12 and top >= 0.5 - 1e-12
    state = AppState.for_scene(Scene(()), view)
    assert state.with_fit(False).view.for_size((300, 100)) is camera


def test_frusta_are_as_long_as_the_set_is_wide_and_shorter_among_many() -> None:
    reach = 3.0 * math.sqrt(2)  # half of the diagonal around cameras on a ring
    for count, share in ((4, 0.15), (400, 0.035), (1000, 0.03)):
        assert a_set(count).length == pytest.approx(reach * share)
    assert a_set(1).length == pytest.approx(0.15)
    around = np.array([[0.0, 0.0, 0.0], [3.0, 1.0, 4.0]])
    one = a_set(1, points=around)
    assert one.length == pytest.approx(0.15 * np.linalg.norm(one.high - one.low) / 2)


def test_up_is_y_without_a_clear_majority() -> None:
    for down, up in ((14, -1), (13, 1)):  # of 20: the means are -0.4 and -0.3
        posed = [
            replace(entry, camera=replace(entry.camera, v=(0.0, -1.0 if k < down else 1.0, 0.0)))
            for k, entry in enumerate(ring(20))
        ]
        assert np.allclose(pose_set(Path("f"), CameraSet("f", tuple(posed))).up, (0, up, 0))


@pytest.mark.parametrize("lens", [None, Lens("equidistant")])
def test_the_mark_for_up_is_above_the_middle_of_the_image(lens: Lens | None) -> None:
    posed = ring(1)[0]
    camera = replace(posed.camera, lens=lens)
    poses = pose_set(Path("f"), CameraSet("f", (replace(posed, camera=camera),)))
    lines = frusta(poses)
    tip, corners = lines[-1, 1] - camera.eye, lines[:4, 1] - camera.eye
    assert np.allclose(lines[-2, 1], lines[-1, 1])
    assert np.allclose(lines[-2:, 0], lines[:2, 1])  # from the upper corners
    assert tip @ np.asarray(camera.u) == pytest.approx(0, abs=1e-9)
    high = corners @ np.asarray(camera.v)
    assert tip @ np.asarray(camera.v) > high.max() + 0.2 * np.ptp(high)
