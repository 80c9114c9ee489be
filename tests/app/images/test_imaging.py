"""The options of both images, the numbers in their pixels, and the mark that stays."""

from dataclasses import replace

import numpy as np
import pytest
from option_changes import with_options

from lucida.app.images import imaging
from lucida.app.images.marking import followed, moved
from lucida.app.images.pixelvalues import is_dark, line_count, shown_bytes, value_lines
from lucida.app.state.app_state import AppState
from lucida.app.state.options.shared import ImageOptions
from lucida.renderer.camera.camera import Camera
from lucida.renderer.images.display import picture
from lucida.renderer.images.frame import Frame
from lucida.renderer.images.shared_numbers import FARTHEST_GRAY
from lucida.renderer.scene.model import Scene, View
from lucida.renderer.system.errors import LucidaError

COLOR = ImageOptions()


@pytest.mark.parametrize("text", [" 1280 X 720 ", "1280*720", "1280 720", "1280\u00d7720"])
def test_resolutions_as_people_type_them(text):
    assert imaging.parsed_size(text) == (1280, 720)


@pytest.mark.parametrize("text", ["1280", "0x9", "-4x3", "99999x99999", "1e3x7"])
def test_what_is_no_resolution_is_told(text):
    with pytest.raises(LucidaError, match=r"is not a size|has no pixels|is too large"):
        imaging.parsed_size(text)


def test_a_resolution_is_seen_whole():
    state = AppState.for_scene(Scene(()))
    state = with_options(state, images={"magnification": 8.0, "center": (0.1, 0.1)})
    state = imaging.with_resolution(state, (64, 36))
    assert (state.images.magnification, state.images.center) == (None, (0.5, 0.5))


def test_magnifying_keeps_the_middle_and_all_of_the_image_has_its_own():
    state = with_options(AppState.for_scene(Scene(())), images={"center": (0.1, 0.2)})
    closer = imaging.with_magnification(state, 8)
    assert closer == with_options(state, images={"magnification": 8.0})
    whole = imaging.with_magnification(closer, None)
    assert whole == with_options(state, images={"center": (0.5, 0.5)})


def frame():
    rng = np.random.default_rng(4)
    normal = rng.normal(size=(5, 7, 3)).astype(np.float32)
    normal /= np.linalg.norm(normal, axis=2, keepdims=True)
    depth = rng.uniform(2, 9, (5, 7)).astype(np.float32)
    number = rng.integers(-1, 12, (5, 7)).astype(np.int32)
    depth[number < 0], normal[number < 0] = np.inf, 0
    color = rng.uniform(0, 1.4, (5, 7, 3)).astype(np.float32)
    return Frame((7, 5), color, depth, normal, number)


def srgb(light):
    """Return IEC 61966-2-1's display values, 0 to 255, not rounded."""
    light = np.clip(light, 0, 1)
    return 255 * np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)


@pytest.mark.parametrize("channel", ["color", "depth", "normal", "id"])
def test_pixels_have_the_colours_of_the_saved_pictures(channel):
    image = frame()
    finite = image.depth[np.isfinite(image.depth)]
    low, high = finite.min(), finite.max()
    options = replace(COLOR, channel=channel, exposure_ev=0.5)
    shown = shown_bytes(image.channel(channel), options, (low, high)).astype(int)
    assert np.abs(shown - picture(image, channel, 0.5)).max() <= 1
    if channel == "color":
        assert np.abs(shown - srgb(image.color * np.sqrt(2))).max() <= 0.51
    elif channel == "depth":
        gray = np.clip((image.depth - low) / (high - low), 0, 1)  # the far end is FARTHEST_GRAY
        there = 255 * (1 - (1 - FARTHEST_GRAY) * gray)
        assert np.abs(shown[..., 0] - np.where(image.id < 0, 0, there)).max() <= 0.51
    elif channel == "normal":
        there = np.where(image.id[..., None] < 0, 0, 127.5 * (image.normal + 1))
        assert np.abs(shown - there).max() <= 0.51
    else:
        for one in range(-1, 12):  # a colour for each object, and another for each
            colors = {tuple(color) for color in shown[image.id == one].tolist()}
            others = {tuple(color) for color in shown[image.id != one].tolist()}
            assert len(colors) <= 1
            assert not colors & others


def test_linear_transfer_shows_light_without_a_curve():
    color = frame().color
    linear = shown_bytes(color, replace(COLOR, transfer="linear"), None)
    assert np.abs(linear - np.clip(color, 0, 1) * 255).max() <= 0.51


def test_values_are_written_as_the_channel_needs():
    color = np.array([[[0, 0.5, 2.0]]], np.float32)
    assert value_lines(color, COLOR) == [["  0\n188\n255"]]
    depth = replace(COLOR, channel="depth")
    assert value_lines(np.array([[3.14159, np.inf, 12345.0]]), depth) == [["3.14", "-", "1e+04"]]
    normal = replace(COLOR, channel="normal")
    assert value_lines(np.array([[[1, 0, -0.5]]]), normal) == [["+1.00\n+0.00\n-0.50"]]
    numbers = np.array([[4, 0, -1]])
    assert value_lines(numbers, replace(COLOR, channel="id")) == [["4", "0", "-"]]
    for options in (COLOR, depth, normal):
        array = np.zeros((1, 1) if options.channel == "depth" else (1, 1, 3), np.float32)
        assert value_lines(array, options)[0][0].count("\n") + 1 == line_count(options)


@pytest.mark.parametrize(
    ("t", "text"),
    [
        (9.99, "9.99"),
        (9.996, "10.0"),
        (99.94, "99.9"),
        (99.96, "100"),
        (999.4, "999"),
        (999.6, "1e+03"),
        (np.nan, "-"),
    ],
)
def test_depths_have_three_digits(t, text):
    """A pixel has room for five letters."""
    assert value_lines(np.array([[t]]), replace(COLOR, channel="depth")) == [[text]]


def test_text_is_read_on_every_colour():
    """WCAG 2 asks for a contrast of 4.5 : 1 for text."""
    values = np.arange(0, 256, 15, dtype=np.uint8)
    colors = np.stack(np.meshgrid(values, values, values), axis=-1).reshape(1, -1, 3)
    linear = ((colors / 255 + 0.055) / 1.055) ** 2.4
    linear = np.where(colors / 255 <= 0.04045, colors / 255 / 12.92, linear)
    luminance = linear @ [0.2126, 0.7152, 0.0722]
    text = np.where(is_dark(colors), 1.0, 0.0)
    high, low = np.maximum(text, luminance), np.minimum(text, luminance)
    assert ((high + 0.05) / (low + 0.05)).min() >= 4.5


VIEW = View(Camera(), fit=True)


def test_the_mark_keeps_its_ray():
    for size, new in [((64, 36), (1280, 720)), ((64, 36), (50, 90)), ((500, 300), (4, 3))]:
        for pixel in [(0, 0), (size[1] // 2, size[0] // 3), (size[1] - 1, size[0] - 1)]:
            there = moved(pixel, size, VIEW, new)
            x, y = VIEW.for_size(size).image_point(*pixel, size)
            left, right, bottom, top = VIEW.for_size(new).viewport
            half = (right - left) / new[0] / 2, (top - bottom) / new[1] / 2
            at = VIEW.for_size(new).image_point(*there, new)
            if left < x < right:
                assert abs(at[0] - x) <= half[0] * 1.001
            if bottom < y < top:
                assert abs(at[1] - y) <= half[1] * 1.001


def test_the_mark_is_not_carried_away_by_many_sizes():
    mark, anchor, of = (17, 33), None, None
    for width in [64, *range(63, 3, -1), *range(4, 65)]:
        mark, anchor = followed(mark, of, anchor, VIEW, (width, 36))
        of = (width, 36)
        assert mark[1] < width
    assert mark == (17, 33)


def test_a_new_mark_counts_from_where_it_is_set():
    mark, anchor = followed((17, 33), None, None, VIEW, (64, 36))
    mark, anchor = followed((2, 3), None, anchor, VIEW, (64, 36))
    assert (mark, anchor.pixel) == ((2, 3), (2, 3))
    assert followed(None, None, anchor, VIEW, (64, 36)) == (None, None)
    for outside, inside in {(99, 99): (35, 63), (0, 0): (0, 0), (-3, -3): (0, 0)}.items():
        assert followed(outside, None, None, VIEW, (64, 36))[0] == inside


def test_normals_and_linear_light_at_their_ends():
    normals = np.array([[[1.0, -1.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 3.0]]], np.float32)
    shown = shown_bytes(normals, replace(COLOR, channel="normal"), None)
    assert shown[0].tolist() == [[255, 0, 128], [0, 0, 0], [128, 128, 255]]
    light = np.array([[[0.25, 1.0, 2.0], [-1.0, np.nan, 0.125]]], np.float32)
    linear = replace(COLOR, transfer="linear", exposure_ev=1.0)
    assert shown_bytes(light, linear, None)[0].tolist() == [[128, 255, 255], [0, 0, 64]]


@pytest.mark.parametrize("depths", [None, (2.0, 2.0), (3.0, 2.0)])
def test_depths_without_a_range_are_white(depths):
    shown = shown_bytes(np.array([[2.0, 7.0, np.inf]]), replace(COLOR, channel="depth"), depths)
    assert shown[0, :, 0].tolist() == [255, 255, 0]


def test_depths_beyond_the_range_are_its_ends():
    depth = np.array([[1.0, 2.0, 3.0, 4.0, 99.0, np.inf]])
    shown = shown_bytes(depth, replace(COLOR, channel="depth"), (2.0, 4.0))[0, :, 0].tolist()
    last = round(255 * FARTHEST_GRAY)
    assert shown == [255, 255, round(255 * (1 + FARTHEST_GRAY) / 2), last, last, 0]
