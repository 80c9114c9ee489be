"""The frustum under the mouse."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from sets_of_cameras import a_set, ring

from lucida.app.instruments.outside.screen import OutsideScreen
from lucida.app.instruments.poses.model import LINES, PoseSet, frusta, pose_set
from lucida.app.instruments.poses.picking import picked
from lucida.renderer.camera.camera import Camera
from lucida.renderer.files.cameras import CameraSet

SIZE = (640, 480)
LENGTH = 0.4
ABOVE = Camera.look_at((0.5, 9.0, 4.0), (0.0, 0.0, 0.0), fov_y_deg=45.0, aspect=4 / 3)
PARALLEL = replace(ABOVE, projection="parallel", viewport=(-5.0, 5.0, -3.75, 3.75))


def middles(poses: PoseSet, screen: OutsideScreen) -> np.ndarray:
    """On the screen, the middle of each camera's second edge."""
    lines = frusta(poses, LENGTH).reshape(len(poses.names), LINES, 2, 3)[:, 1].mean(axis=1)
    found = screen.spots(lines)
    assert found is not None
    return found[0]


@pytest.mark.parametrize("looking", [ABOVE, PARALLEL])
def test_each_is_found_by_its_lines(looking: Camera) -> None:
    poses, screen = a_set(12), OutsideScreen(looking, SIZE)
    for number, (x, y) in enumerate(middles(poses, screen).tolist()):
        assert picked(poses, LENGTH, screen, (x, y)) == number
        assert picked(poses, LENGTH, screen, (x + 2.0, y - 2.0)) == number
    assert picked(poses, LENGTH, screen, (3.0, 3.0)) is None
    assert picked(poses, LENGTH, screen, (320.0, 250.0)) is None  # inside the ring


@pytest.mark.parametrize("looking", [ABOVE, PARALLEL])
def test_of_two_the_one_in_front_is_found(looking: Camera) -> None:
    """Two on one ray of the camera that looks, in either order."""
    posed = ring(1)[0]
    eye = np.asarray(posed.camera.eye)
    step = np.asarray(ABOVE.eye) - eye if looking is ABOVE else np.asarray(looking.w)
    nearer = eye + 0.3 * step / np.linalg.norm(step)
    second = replace(posed, camera=replace(posed.camera, eye=tuple(nearer.tolist())))
    screen = OutsideScreen(looking, SIZE)
    place = screen.spots(eye[None])
    assert place is not None
    for cameras, front in (((posed, second), 1), ((second, posed), 0)):
        poses = pose_set(Path("f"), CameraSet("f", cameras))
        assert picked(poses, LENGTH, screen, tuple(place[0][0].tolist())) == front
