"""The display transform on the GPU, against the one on the CPU."""

import gc

import numpy as np
import pytest

from lucida.renderer.images import to_srgb8
from lucida.renderer.images.display import picture
from lucida.renderer.images.frame import Frame
from lucida.renderer.raster import DepthRange, Display, Look, Section, upload


@pytest.fixture
def display(gl):
    display = Display(gl)
    yield display
    display.release()


@pytest.mark.parametrize("exposure_ev", [0.0, 1.5, -3.0])
def test_the_display_agrees_with_numpy(show, exposure_ev):
    levels = np.concatenate(
        [[0, 1e-6, 0.0031308, 0.5, 1, 1.0001, 7, 1e4], np.linspace(0, 1.2, 400)]
    )
    color = (
        np.stack([levels, levels[::-1], levels**2], axis=-1).astype(np.float32).reshape(8, 51, 3)
    )
    shown = show(Frame((51, 8), color), Look(exposure_ev=exposure_ev))
    difference = shown.astype(int) - to_srgb8(color, exposure_ev)
    assert np.abs(difference).max() <= 1  # where a float's last place decides the rounding
    assert (difference != 0).mean() < 0.01


def test_extreme_exposures_do_no_harm(show):
    gray = Frame((1, 1), np.full((1, 1, 3), 0.5, np.float32))
    assert show(gray, Look(exposure_ev=5000.0))[0, 0].tolist() == [255] * 3
    assert show(gray, Look(exposure_ev=-5000.0))[0, 0].tolist() == [0] * 3


def test_released_resources_leave_nothing(gl):
    gl.gc_mode = "context_gc"
    texture, display, ranges = None, Display(gl), DepthRange(gl)
    target = gl.framebuffer([gl.texture((9, 9), 4)])
    for k in range(1, 30):
        texture = upload(gl, np.ones((k, 31 - k), np.float32), texture)
        assert texture.size == (31 - k, k)
        display.show(texture, Look("depth"), Section(), target, ranges.measure(texture))
    for resource in (texture, display, ranges, target.color_attachments[0], target):
        resource.release()
    gc.collect()
    left = [name for thing in gl.objects if (name := type(thing).__name__) != "InvalidObject"]
    gl.gc_mode = None
    assert left == []


@pytest.fixture
def data():
    """A frame with all channels; more objects than there are colours."""
    rng = np.random.default_rng(3)
    normal = rng.normal(size=(37, 53, 3)).astype(np.float32)
    normal /= np.linalg.norm(normal, axis=2, keepdims=True)
    depth = rng.uniform(1.5, 40, (37, 53)).astype(np.float32)
    number = rng.integers(-1, 40, (37, 53)).astype(np.int32)
    depth[number < 0], normal[number < 0] = np.inf, 0
    color = rng.uniform(0, 1.5, (37, 53, 3)).astype(np.float32)
    color[0, 0], color[0, 1] = np.nan, 1e30
    return Frame((53, 37), color, depth, normal, number)


@pytest.fixture
def show(gl, display):
    """Shows a channel of a frame as the window does: uint8 (height, width, 3)."""
    ranges, made = DepthRange(gl), []

    def draw(frame, look, section=None, size=None):
        source = upload(gl, frame.channel(look.channel))
        target = gl.framebuffer([gl.texture(size or frame.size, 4)])
        ends = ranges.measure(source) if look.channel == "depth" else None
        display.show(source, look, section or Section(), target, ends)
        made.extend((source, target))
        width, height = size or frame.size
        return np.frombuffer(target.read(components=3), np.uint8).reshape(height, width, 3)

    yield draw
    for resource in (ranges, *made):
        resource.release()


@pytest.mark.parametrize("channel", ["color", "depth", "normal", "id"])
def test_channels_have_the_colours_of_saved_pictures(data, show, channel):
    difference = show(data, Look(channel)).astype(int) - picture(data, channel)
    assert np.abs(difference).max() <= 1
    assert (difference != 0).mean() < 0.01


def test_linear_light_without_the_curve(data, show):
    expected = np.clip(np.nan_to_num(data.color), 0, 1) * 255
    assert np.abs(show(data, Look(transfer="linear")) - expected).max() <= 1


def test_the_range_of_depths_is_found(gl, data):
    ranges = DepthRange(gl)
    assert ranges.numbers() is None
    finite = data.depth[np.isfinite(data.depth)]
    for depth in (data.depth, data.depth[:1, :1], np.full((300, 700), 7, np.float32)):
        texture = upload(gl, depth)
        ranges.measure(texture)
        assert ranges.unfinished
        hits = depth[np.isfinite(depth)]
        expected = (hits.min(), hits.max()) if len(hits) else None
        assert ranges.numbers() == expected
        assert not ranges.unfinished
        texture.release()
    texture = upload(gl, np.full((4, 4), np.inf, np.float32))
    ranges.measure(texture)
    assert ranges.numbers() is None
    assert len(finite) > 10
    texture.release()
    ranges.release()


def test_a_magnified_part_is_made_of_squares(data, show):
    section = Section((-21.0, -14.0), (1 / 7, 1 / 7))
    shown = show(data, Look("id"), section, (70, 49))
    expected = picture(data, "id")[2:9, 3:13].repeat(7, axis=0).repeat(7, axis=1)
    assert (shown == expected).all()


def test_a_reduced_image_is_the_mean_of_what_it_covers(data, show):
    rng = np.random.default_rng(1)
    light = rng.uniform(0, 1, (36, 48, 3)).astype(np.float32)
    frame = Frame((48, 36), light)
    shown = show(frame, Look(), Section((0, 0), (4.0, 4.0), True), (12, 9))
    means = light.reshape(9, 4, 12, 4, 3).mean(axis=(1, 3))
    assert np.abs(shown.astype(int) - to_srgb8(means)).max() <= 1
    # Parts of pixels count as parts: 1.5 of them on each of the screen's.
    gray = np.zeros((1, 3, 3), np.float32)
    gray[0, 1] = 1.0
    shown = show(Frame((3, 1), gray), Look(), Section((0, 0), (1.5, 1.0), True), (2, 1))
    expected = to_srgb8(np.float32(1 / 3))
    assert np.abs(shown.astype(int) - int(expected)).max() <= 1


def test_somebody_elses_error_is_not_taken_for_ones_own(gl):
    """A window's context is shared with those who draw its widgets."""
    gl.texture((2, 2), 4).use(99999)  # there is no such unit
    upload(gl, np.zeros((2, 2), np.float32)).release()
