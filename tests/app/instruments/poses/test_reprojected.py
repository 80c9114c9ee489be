"""A reconstruction's points on the photographs of its cameras."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from sets_of_cameras import ring

from lucida.app.instruments.poses.model import PoseSet, pose_set
from lucida.app.instruments.poses.photographs import pictured
from lucida.app.instruments.poses.reprojected import DARKER, with_points
from lucida.renderer.camera.camera import Camera
from lucida.renderer.files.cameras import CameraSet, PosedCamera

LOOKING = Camera(eye=(0.0, 0.0, 4.0), viewport=(-0.4, 0.4, -0.3, 0.3))


def a_model(points: list[tuple[float, ...]], camera: Camera = LOOKING) -> PoseSet:
    colors = np.arange(1, len(points) + 1, dtype=np.uint8)[:, None].repeat(3, axis=1)
    posed = PosedCamera(camera, (80, 60), "a.png", "a.png")
    return pose_set(Path("/x/f.json"), CameraSet("colmap", (posed,), (), np.array(points), colors))


@pytest.mark.parametrize("projection", ["perspective", "parallel"])
def test_points_are_where_the_camera_projects_them(projection: str) -> None:
    camera = replace(LOOKING, projection=projection)
    points = [(0.1, 0.2, 0.0), (-0.3, -0.1, 1.0), (0.05, -0.25, -2.0)]
    picture = with_points(a_model(points, camera), 0, np.zeros((60, 80, 3), np.uint8))
    for number, point in enumerate(points):
        row, column, _ = camera.project(np.array(point), (80, 60))
        assert (picture[round(float(row)), round(float(column))] == number + 1).all()
    assert (picture > 0).any(axis=2).sum() == 3 * 9


def test_the_nearest_point_is_on_top_in_any_order() -> None:
    line = [(0.0, 0.0, 1.0), (0.0, 0.0, 3.0), (0.0, 0.0, -5.0)]
    for turn in range(3):
        places = [*line[turn:], *line[:turn]]
        picture = with_points(a_model(places), 0, np.zeros((60, 80, 3), np.uint8))
        assert picture.max() == places.index((0.0, 0.0, 3.0)) + 1


def test_points_behind_or_beside_the_camera_are_not_drawn() -> None:
    picture = with_points(
        a_model([(0.0, 0.0, 5.0), (30.0, 0.0, 0.0), (0.0, 0.0, 4.0), (0.0, 1e9, 3.9999999)]),
        0,
        np.full((60, 80, 3), 200, np.uint8),
    )
    assert (picture == int(DARKER * 200)).all()


def test_points_are_drawn_on_a_photograph_on_request(tmp_path: Path) -> None:
    posed = replace(ring(1)[0], image="a.png")
    places = np.random.default_rng(1).uniform(-0.5, 0.5, (40, 3))
    with_some = CameraSet("colmap", (posed,), (), places)
    poses = pose_set(tmp_path / "f.json", with_some)
    assert pictured(poses, 0, True).problem == "a.png is not there."
    Image.new("RGB", (80, 60), (200, 0, 0)).save(tmp_path / "a.png")
    plain, dotted = (pictured(poses, 0, on) for on in (False, True))
    assert plain.pixels is not None and (plain.pixels == (200, 0, 0)).all()
    assert dotted.pixels is not None and (dotted.pixels == (int(DARKER * 200), 0, 0)).any()
    assert (dotted.pixels == poses.colors[0]).all(axis=2).any()
    without = pose_set(tmp_path / "f.json", CameraSet("nerf", (posed,)))
    again = pictured(without, 0, True)
    assert again.pixels is not None and (again.pixels == (200, 0, 0)).all()
    (tmp_path / "a.png").unlink()
    assert pictured(without, 0, True).pixels is None


def test_points_in_the_outermost_pixels_are_drawn() -> None:
    corners = [(0, 0), (0, 79), (59, 0), (59, 79)]
    rays = [LOOKING.ray(*corner, (80, 60)) for corner in corners]
    model = a_model([tuple(ray.origin + 4 * ray.direction) for ray in rays])
    picture = with_points(model, 0, np.zeros((60, 80, 3), np.uint8))
    assert [picture[corner].tolist() for corner in corners] == [[k] * 3 for k in (1, 2, 3, 4)]
