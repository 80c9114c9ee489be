"""The difference of two images in each channel, and its colour."""

import numpy as np
import pytest

from lucida import Frame
from lucida.renderer.compare.raster_and_ray import CAUSES
from lucida.renderer.images import encode_srgb
from lucida.renderer.images.difference import (
    ABSOLUTE_COLORS,
    CAUSE_COLORS,
    SHADING_COLOR,
    STEPS,
    UNEXPLAINED_COLOR,
    difference,
    false_color,
)
from lucida.renderer.images.display import from_srgb, luminance

INF = np.inf


def frame(**channels):
    height, width = next(iter(channels.values())).shape[:2]
    return Frame(size=(width, height), **channels)


def row(*values, dtype=np.float32):
    return np.array([values], dtype)


def test_color_is_compared_as_it_is_shown():
    dark, bright = row((0.2, 0.2, 0.2), (0.5, 0.5, 0.5)), row((0.3, 0.2, 0.2), (0.5, 0.1, 0.45))
    found = difference(frame(color=dark), frame(color=bright))
    expected = [encode_srgb(0.3) - encode_srgb(0.2), encode_srgb(0.5) - encode_srgb(0.1)]
    np.testing.assert_allclose(found[0], expected, rtol=1e-6)


def test_what_is_brighter_than_white_looks_the_same():
    assert not difference(frame(color=row((5, 1, 2))), frame(color=row((1, 9, 1)))).any()


def test_depth_is_relative_and_infinite_where_one_misses():
    raster, ray = frame(depth=row(2, 5, INF, INF, 3)), frame(depth=row(4, 4, INF, 3, INF))
    assert difference(raster, ray, "depth")[0].tolist() == [0.5, 0.25, 0, INF, INF]


def test_normals_differ_by_their_most_different_component():
    raster = frame(normal=row((0, 0, 1), (0, 0, 1)))
    ray = frame(normal=row((0.1, -0.3, 1), (0, 0, 0)))
    np.testing.assert_allclose(difference(raster, ray, "normal")[0], [0.3, 1])


def test_objects_are_the_same_or_not():
    raster, ray = frame(id=row(0, 3, -1, dtype=np.int32)), frame(id=row(0, 2, 0, dtype=np.int32))
    assert difference(raster, ray, "id")[0].tolist() == [0, 1, 1]


@pytest.mark.parametrize("channel", ["color", "depth", "normal"])
def test_not_a_number_is_never_no_difference(channel):
    shape = (1, 1) if channel == "depth" else (1, 1, 3)
    good, bad = (frame(**{channel: np.full(shape, v, np.float32)}) for v in (0.5, np.nan))
    for pair in ((good, bad), (bad, good), (bad, bad)):
        found = difference(*pair, channel)
        assert np.isnan(found).all()
        assert false_color(found, channel)[0, 0].tolist() == [255, 255, 255]


def test_the_map_is_told_apart_by_lightness_alone():
    """Some viewers, and gray printers, have nothing else."""
    light = luminance(from_srgb(ABSOLUTE_COLORS))
    step = 15  # of the map's colours: rounding to 8 bits is no matter then
    assert (np.diff(light[::step]) > 0).all()
    assert light[0] == 0
    assert light[-1] == pytest.approx(1)


@pytest.mark.parametrize("gain", [1, 4, 1024])
def test_gain_moves_full_scale(gain):
    full = 1 / gain
    values = np.array([0, full / 2, full, 3 * full, INF], np.float32)
    absolute = false_color(values, "color", gain)
    last, middle = ABSOLUTE_COLORS[-1].tolist(), ABSOLUTE_COLORS[STEPS // 2].tolist()
    assert absolute.tolist() == [[0, 0, 0], middle, last, last, last]


def test_every_cause_has_a_colour_of_its_own():
    colors = [*CAUSE_COLORS.values(), SHADING_COLOR, UNEXPLAINED_COLOR]
    assert tuple(CAUSE_COLORS) == CAUSES
    assert len(set(colors)) == len(CAUSES) + 2


def test_full_scale_and_the_nearest_colour():
    """Normals differ by up to 2; everything else by 1."""
    step = 1 / (STEPS - 1)
    for channel, scale in (("color", 1.0), ("depth", 1.0), ("normal", 2.0)):
        values = np.float32([0.0, 1.3 * step, 1.6 * step, 0.5, 1.0]) * np.float32(scale)
        wanted = ABSOLUTE_COLORS[[0, 1, 2, (STEPS - 1) // 2, STEPS - 1]]
        assert (false_color(values, channel) == wanted).all(), channel
    assert ABSOLUTE_COLORS.shape == (STEPS, 3)
