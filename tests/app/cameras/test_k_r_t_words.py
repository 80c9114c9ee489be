"""K, R and t in the camera panel: correct, legible, and the same camera when pasted."""

from __future__ import annotations

from dataclasses import replace
from typing import get_args

import numpy as np
import pytest
from copied_views import NOW, SIZE, read_view

from lucida.app.cameras.other_words import of_any_size, other_words
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.intrinsics import PixelOrigin
from lucida.renderer.scene.model import View
from lucida.renderer.system.errors import LucidaError

AIMED = Camera.look_at((3, 2, 5), (0, 0.5, 0), fov_y_deg=40, aspect=SIZE[0] / SIZE[1])
POINTS = np.random.default_rng(3).uniform(-1, 1, (20, 3))
ORIGINS: tuple[PixelOrigin, ...] = get_args(PixelOrigin)


def assert_same(one: Camera, other: Camera) -> None:
    pixels, expected = one.project(POINTS, SIZE), other.project(POINTS, SIZE)
    assert np.allclose(pixels.row, expected.row, atol=1e-6)
    assert np.allclose(pixels.column, expected.column, atol=1e-6)


@pytest.mark.parametrize("origin", ORIGINS)
def test_a_copied_camera_is_the_same_when_pasted(origin: PixelOrigin) -> None:
    words = other_words(View(AIMED), SIZE, origin)
    assert_same(read_view(words.copied, NOW).for_size(SIZE), AIMED)
    names: dict[str, object] = {}
    exec(words.copied, names)
    K, R, t = AIMED.intrinsics(SIZE, origin)
    assert np.allclose(np.array(names["K"]), K, atol=1e-9)
    assert np.array_equal(np.array(names["R"]), R)
    assert np.array_equal(np.array(names["t"]), t)


def test_the_shown_matrices_are_aligned_and_rounded() -> None:
    lines = other_words(View(Camera((0, 0, 5))), (100, 100), "corner").read
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


def test_a_pasted_k_is_shown_with_that_of_the_current_image() -> None:
    """The height of the current image decides: 90 pixels instead of 480."""
    text = "K = [[700.125, 0, 300], [0, 690, 250], [0, 0, 1]]\nw = 640\nh = 480\nt = [0, 0, 6]"
    view = read_view(text, NOW)
    words = other_words(view, SIZE, "center")
    assert words.read[:4] == (
        "as it was given, for 640 x 480",
        "K  700.125    0  300",
        "         0  690  250",
        "         0    0    1",
    )
    assert words.read[4] == f"in this image, {SIZE[0]} x {SIZE[1]}"
    assert float(words.read[5].split()[1]) == pytest.approx(700.125 * 90 / 480, rel=1e-4)
    names: dict[str, object] = {}
    exec(words.copied, names)
    assert np.allclose(np.array(names["K"]), [[700.125, 0, 300], [0, 690, 250], [0, 0, 1]])
    assert (names["width"], names["height"]) == (640, 480)
    assert_same(read_view(words.copied, NOW).for_size(SIZE), view.for_size(SIZE))
    # A changed camera was not pasted; an image of the given size has only one K.
    moved = replace(view, camera=replace(view.camera, distance=9.0))
    assert other_words(moved, SIZE, "center").read[0].startswith("K")
    assert other_words(view, (640, 480), "center").read[0].startswith("K")


def test_a_parallel_camera_has_no_k() -> None:
    with pytest.raises(LucidaError, match="no focal length"):
        other_words(View(Camera(projection="parallel")), SIZE, "center")


@pytest.mark.parametrize("origin", ORIGINS)
def test_k_of_any_size_is_a_formula(origin: PixelOrigin) -> None:
    camera = Camera(v=(0.1, 1, 0), viewport=(-0.4, 0.6, -0.3, 0.5), distance=1.7)
    formula = of_any_size(camera, origin)
    for W, H in ((640, 480), (1920, 1080)):
        K = eval(formula.replace(" W", "*W").replace(" H", "*H"))
        assert np.allclose(K, camera.intrinsics((W, H), origin).K, rtol=1e-6)
