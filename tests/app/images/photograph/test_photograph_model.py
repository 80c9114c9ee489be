"""The place of a photograph in the images and in the state."""

from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lucida import load_scene
from lucida.app.images.photograph.model import (
    WHOLE,
    closed,
    covered,
    letterboxed,
    path_of,
    pixels_of,
    with_photograph,
)
from lucida.app.state.app_state import AppState
from lucida.renderer.camera.camera import Camera

CAMERA = replace(Camera.canonical(), viewport=(-1.0, 3.0, -2.0, 1.0))


def test_a_photograph_fills_an_image_with_its_viewport():
    assert covered(CAMERA, CAMERA) == WHOLE
    assert pixels_of(WHOLE, (640, 480)) == (640, 480)


@pytest.mark.parametrize("size", [(800, 300), (300, 800), (400, 300)])
def test_in_a_fitted_view_a_photograph_keeps_its_proportions(size):
    left, top, right, bottom = covered(CAMERA, CAMERA.fitted(size))
    assert (left + right) / 2 == pytest.approx(0.5) and (top + bottom) / 2 == pytest.approx(0.5)
    assert (right - left) * size[0] / ((bottom - top) * size[1]) == pytest.approx(4 / 3)
    assert min(left, top) == pytest.approx(0) and max(right, bottom) == pytest.approx(1)
    pixels = (300, 225) if size == (300, 800) else (400, 300)
    assert pixels_of((left, top, right, bottom), size) == pixels


SIZES = st.tuples(st.integers(16, 4000), st.integers(16, 4000))


@given(SIZES, SIZES)
def test_a_letterboxed_photograph_keeps_its_shape_in_the_middle(own, shape):
    left, top, right, bottom = letterboxed((0.2, 0.0, 0.8, 1.0), shape, own)
    assert left + right == pytest.approx(1) and top + bottom == pytest.approx(1)
    across, down = (right - left) / 0.6, bottom - top
    assert max(across, down) == pytest.approx(1)
    aspect = shape[0] * across / (shape[1] * down)
    assert aspect == pytest.approx(own[0] / own[1], rel=0.006 + 1.2 / min(*own, *shape))
    assert letterboxed(WHOLE, shape, (0, 0)) == WHOLE


def test_a_shape_that_differs_by_rounding_alone_has_no_bars():
    assert letterboxed(WHOLE, (64, 48), (65, 48)) == WHOLE


def test_a_photograph_is_in_the_state_until_it_is_closed():
    state = AppState.for_scene(load_scene("still-life"))
    assert path_of(state) is None
    shown = with_photograph(state, "/a/b\udcff.png", follows=True)
    assert path_of(shown) == Path("/a/b\udcff.png")
    assert shown.options.photograph.follows
    assert closed(shown).options.photograph == state.options.photograph


@given(
    st.lists(st.floats(0.1, 3), min_size=4, max_size=4),
    st.lists(st.floats(0, 2), min_size=4, max_size=4),
)
def test_a_photograph_covers_the_image_up_to_its_projected_corners(edges, more):
    l, r, b, t = edges  # noqa: E741
    camera = Camera(viewport=(-l, r, -b, t))
    drawn = Camera(viewport=(-l - more[0], r + more[1], -b - more[2], t + more[3]))
    left, top, right, bottom = covered(camera, drawn)
    size = (300, 200)
    for x, y, along, down in ((-l, t, left, top), (r, -b, right, bottom)):
        corner = drawn.project((x, y, -1), size)
        assert along * size[0] - 0.5 == pytest.approx(corner.column, abs=1e-9)
        assert down * size[1] - 0.5 == pytest.approx(corner.row, abs=1e-9)
    assert pixels_of((0, 0, 1e-9, 1e-9), size) == (1, 1)
