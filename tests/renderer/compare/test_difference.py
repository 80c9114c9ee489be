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
    SIGNED_COLORS,
    STEPS,
    UNEXPLAINED_COLOR,
    false_color,
    most,
    signed_difference,
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
    difference = signed_difference(frame(color=dark), frame(color=bright))
    expected = [
        encode_srgb(0.3) - encode_srgb(0.2),  # the ray image is brighter
        encode_srgb(0.1) - encode_srgb(0.5),  # the channel that differs most decides the sign
    ]
    np.testing.assert_allclose(difference[0], expected, rtol=1e-6)


def test_what_is_brighter_than_white_looks_the_same():
    assert not signed_difference(frame(color=row((5, 1, 2))), frame(color=row((1, 9, 1)))).any()


def test_depth_is_relative_and_infinite_where_one_misses():
    raster, ray = frame(depth=row(2, 5, INF, INF, 3)), frame(depth=row(4, 4, INF, 3, INF))
    assert signed_difference(raster, ray, "depth")[0].tolist() == [0.5, -0.25, 0, -INF, INF]


def test_normals_differ_by_their_most_different_component():
    raster = frame(normal=row((0, 0, 1), (0, 0, 1)))
    ray = frame(normal=row((0.1, -0.3, 1), (0, 0, 0)))
    np.testing.assert_allclose(signed_difference(raster, ray, "normal")[0], [-0.3, -1])


def test_objects_are_the_same_or_not():
    raster, ray = frame(id=row(0, 3, -1, dtype=np.int32)), frame(id=row(0, 2, 0, dtype=np.int32))
    assert signed_difference(raster, ray, "id")[0].tolist() == [0, 1, 1]


@pytest.mark.parametrize("channel", ["color", "depth", "normal"])
def test_not_a_number_is_never_no_difference(channel):
    shape = (1, 1) if channel == "depth" else (1, 1, 3)
    good, bad = (frame(**{channel: np.full(shape, v, np.float32)}) for v in (0.5, np.nan))
    for pair in ((good, bad), (bad, good), (bad, bad)):
        difference = signed_difference(*pair, channel)
        assert np.isnan(difference).all()
        assert false_color(difference, channel)[0, 0].tolist() == [255, 255, 255]
        signed = false_color(difference, channel, signed=True)
        assert signed[0, 0].tolist() == SIGNED_COLORS[-1].tolist()


def test_the_maps_are_told_apart_by_lightness_alone():
    """Some viewers, and gray printers, have nothing else."""
    light = luminance(from_srgb(ABSOLUTE_COLORS))
    step = 15  # of the map's colours: rounding to 8 bits is no matter then
    assert (np.diff(light[::step]) > 0).all()
    assert light[0] == 0
    assert light[-1] == pytest.approx(1)
    both = luminance(from_srgb(SIGNED_COLORS))
    middle = STEPS // 2
    assert both[middle] == pytest.approx(1)
    assert (np.diff(both[: middle + 1 : step]) > 0).all()
    assert (np.diff(both[middle::step]) < 0).all()
    # Equal differences of either sign are about equally dark; blue against orange tells the sign.
    assert np.abs(np.sqrt(both) - np.sqrt(both[::-1])).max() < 0.15
    assert (SIGNED_COLORS[: middle - 20, 2] > SIGNED_COLORS[: middle - 20, 0]).all()
    assert (SIGNED_COLORS[middle + 21 :, 0] > SIGNED_COLORS[middle + 21 :, 2]).all()


@pytest.mark.parametrize("gain", [1, 4, 1024])
def test_gain_moves_full_scale(gain):
    full = 1 / gain
    values = np.array([0, full / 2, full, 3 * full, -full, INF, -INF], np.float32)
    absolute = false_color(values, "color", gain)
    last, middle = ABSOLUTE_COLORS[-1].tolist(), ABSOLUTE_COLORS[STEPS // 2].tolist()
    assert absolute.tolist() == [[0, 0, 0], middle, last, last, last, last, last]
    signed = false_color(values, "color", gain, signed=True)
    low, high = SIGNED_COLORS[0].tolist(), SIGNED_COLORS[-1].tolist()
    assert signed[0].tolist() == [255, 255, 255]
    assert signed[2:].tolist() == [high, high, low, high, low]


def test_objects_have_no_sign():
    values = np.array([0, 1], np.float32)
    assert (false_color(values, "id", signed=True) == false_color(values, "id")).all()


def test_every_cause_has_a_colour_of_its_own():
    colors = [*CAUSE_COLORS.values(), SHADING_COLOR, UNEXPLAINED_COLOR]
    assert tuple(CAUSE_COLORS) == CAUSES
    assert len(set(colors)) == len(CAUSES) + 2


def test_of_two_that_differ_alike_the_brighter_one_gives_the_sign():
    assert most(np.array([[0.5, -0.5, 0.0], [-0.5, 0.25, 0.5]], np.float32)).tolist() == [0.5, 0.5]


def test_full_scale_and_the_nearest_colour():
    """Normals differ by up to 2; everything else by 1."""
    step = 1 / (STEPS - 1)
    for channel, scale in (("color", 1.0), ("depth", 1.0), ("normal", 2.0)):
        values = np.float32([0.0, 1.3 * step, 1.6 * step, 0.5, 1.0]) * np.float32(scale)
        wanted = ABSOLUTE_COLORS[[0, 1, 2, (STEPS - 1) // 2, STEPS - 1]]
        assert (false_color(values, channel) == wanted).all(), channel
    assert (
        false_color(np.float32([3.0, -3.0]), "color", 2.0, True) == SIGNED_COLORS[[-1, 0]]
    ).all()
    assert ABSOLUTE_COLORS.shape == SIGNED_COLORS.shape == (STEPS, 3)
