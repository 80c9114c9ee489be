"""K, R and t as the camera panel says them: right, legible, pasted back as they are."""

from __future__ import annotations

from typing import get_args

import numpy as np
import pytest
from copied_views import NOW, SIZE, read_view

from app.cameras.other_words import other_words
from renderer.camera import Camera
from renderer.camera_formats import PosedCamera, written
from renderer.camera_formats.given import Options
from renderer.errors import LucidaError
from renderer.intrinsics import PixelOrigin

AIMED = Camera.look_at((3, 2, 5), (0, 0.5, 0), fov_y_deg=40, aspect=SIZE[0] / SIZE[1])
POINTS = np.random.default_rng(3).uniform(-1, 1, (20, 3))
ORIGINS: tuple[PixelOrigin, ...] = get_args(PixelOrigin)


def assert_same(one: Camera, other: Camera) -> None:
    seen, wanted = one.project(POINTS, SIZE), other.project(POINTS, SIZE)
    assert np.allclose(seen.row, wanted.row, atol=1e-6)
    assert np.allclose(seen.column, wanted.column, atol=1e-6)


@pytest.mark.parametrize("origin", ORIGINS)
def test_what_is_copied_is_pasted_by_its_own_pixel_origin(origin: PixelOrigin) -> None:
    words = other_words(AIMED, SIZE, origin)
    assert_same(read_view(words.copied, NOW).for_size(SIZE), AIMED)
    names: dict[str, object] = {}
    exec(words.copied, names)
    K, R, t = AIMED.intrinsics(SIZE, origin)
    assert np.allclose(np.array(names["K"]), K, atol=1e-9)
    assert np.array_equal(np.array(names["R"]), R)
    assert np.array_equal(np.array(names["t"]), t)


@pytest.mark.parametrize("ending", ["", ".json"])
@pytest.mark.parametrize("origin", ORIGINS)
def test_a_file_of_opencv_is_read_by_the_origin_that_it_says(
    origin: PixelOrigin, ending: str
) -> None:
    options = Options(pixel_origin=origin, ending=ending)
    text = written([PosedCamera(AIMED, SIZE)], "opencv", options)[""].decode()
    assert_same(read_view(text, NOW).for_size(SIZE), AIMED)


def test_what_is_read_has_columns_and_no_rests_of_rounding() -> None:
    lines = other_words(Camera((0, 0, 5)), (100, 100), "corner").read
    assert lines == (
        "K  100    0  50",
        "     0  100  50",
        "     0    0   1",
        "R  1   0   0",
        "   0  -1   0",
        "   0   0  -1",
        "t  0",
        "   0",
        "   5",
    )


def test_the_origin_moves_the_principal_point_by_half_a_pixel() -> None:
    centers, corners = (other_words(AIMED, SIZE, origin).read for origin in ORIGINS)
    assert centers[3:] == corners[3:]
    assert centers[0].split()[-1] == f"{SIZE[0] / 2 - 0.5:g}"
    assert corners[0].split()[-1] == f"{SIZE[0] / 2:g}"


def test_a_parallel_camera_has_none() -> None:
    with pytest.raises(LucidaError, match="no focal length"):
        other_words(Camera(projection="parallel"), SIZE, "center")
