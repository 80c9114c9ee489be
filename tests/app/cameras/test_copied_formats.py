"""Other programs' formats in the clipboard: copied, pasted, told what they are."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from copied_views import NOW, SIZE, read_view

from lucida.app.cameras.reader import read_copied
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.lenses import Lens
from lucida.renderer.files.cameras import PosedCamera, written
from lucida.renderer.scene.model import View
from lucida.renderer.system.errors import LucidaError

AIMED = Camera.look_at((3, 2, 5), (0, 0.5, 0), fov_y_deg=40)
WIDE = View(AIMED, fit=True)
POINTS = np.random.default_rng(3).uniform(-1, 1, (20, 3))
LENS = '{"K": [9, 9, 5, 5], "D": [0.5, 0, 0, 0]}'


@pytest.mark.parametrize(
    ("format", "parallel"), [("opencv", False), ("gltf", False), ("gltf", True)]
)
def test_a_pasted_file_is_the_camera_that_was_written(format: str, parallel: bool) -> None:
    view = replace(WIDE, camera=replace(AIMED, projection="parallel")) if parallel else WIDE
    text = written([PosedCamera(view.for_size(SIZE), SIZE)], format).decode()
    copied = read_copied(text, NOW)
    back, shown = copied.view.for_size(SIZE), view.for_size(SIZE)
    seen, wanted = back.project(POINTS, SIZE), shown.project(POINTS, SIZE)
    assert np.allclose(seen.row, wanted.row, atol=1e-6)
    assert np.allclose(seen.column, wanted.column, atol=1e-6)
    if not parallel:
        assert copied.view.camera.distance == NOW.camera.distance
    assert copied.said.startswith("The camera is pasted from the clipboard: ")
    assert "\n" not in copied.said


def test_the_conventions_that_were_taken_are_said() -> None:
    said = read_copied("fx = fy = 100\ncx = 40\ncy = 30\nfx = 100\nfy = 100", NOW).said
    assert "OpenCV's K, R and t" in said
    assert "integer coordinates at pixel centres" in said
    assert "80" not in said or "middle is the principal point" in said


def test_a_camera_of_square_pixels_is_seen_unstretched_and_another_as_it_is() -> None:
    square = (
        "image_width = 640\nimage_height = 480\nK = [[700, 0, 319.5], [0, {fy}, 239.5], [0, 0, 1]]"
    )
    fitted = read_copied(square.format(fy=700), NOW)
    assert fitted.view.fit and "square" not in fitted.said
    exact = read_copied(square.format(fy=707), NOW)
    assert not exact.view.fit
    assert "its pixels are not square: seen as they are at 640x480" in exact.said
    K = exact.view.for_size((640, 480)).intrinsics((640, 480)).K
    assert np.allclose(K, [[700, 0, 319.5], [0, 707, 239.5], [0, 0, 1]])


def test_a_lens_is_kept_and_named() -> None:
    copied = read_copied(LENS, NOW)
    assert copied.view.camera.lens == Lens("brown", {"k1": 0.5})
    assert "with its lens, brown, k1 = 0.5" in copied.said


def test_several_cameras_are_told_to_be_opened_as_a_file() -> None:
    frame = '{"transform_matrix": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]}'
    text = f'{{"camera_angle_x": 1, "frames": [{frame}, {frame}]}}'
    with pytest.raises(LucidaError, match="clipboard: holds 2 cameras; save the text as a file"):
        read_view(text, NOW)
