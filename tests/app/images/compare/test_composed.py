"""The compare view's pictures on the GPU, against the definition on the CPU."""

from dataclasses import replace

import numpy as np
import pytest

from lucida import Frame
from lucida.app.images.compare.composed import RIM, SIDES, Composed, Mapping, marks
from lucida.renderer.compare.raster_and_ray import AGREE, CAUSES, LABEL_COLORS, SHADING, UNEXPLAINED
from lucida.renderer.images.difference import (
    ABSOLUTE_COLORS,
    SIGNED_COLORS,
    STEPS,
    false_color,
    signed_difference,
)
from lucida.renderer.raster.resources import Owner, new_texture
from lucida.renderer.raster.targets import Textures

SIZE = (13, 7)  # (width, height), odd on purpose
INF, NAN = np.inf, np.nan


@pytest.fixture
def composed(gl):
    made = Composed(gl)
    yield made
    made.release()


@pytest.fixture
def upload(gl):
    owner = Owner()

    def upload(values):
        height, width = values.shape[:2]
        components = values.shape[2] if values.ndim == 3 else 1
        texture = owner.own(new_texture(gl, (width, height), components, values.dtype))
        texture.write(np.ascontiguousarray(values))
        return texture

    yield upload
    owner.release()


def shown(picture):
    texture = getattr(picture, "texture", picture)
    width, height = texture.size
    return np.frombuffer(texture.read(), np.uint8).reshape(height, width, 4)[..., :3]


def random_frame(seed):
    """Every channel, with misses, infinite and useless numbers among them."""
    rng = np.random.default_rng(seed)
    shape = SIZE[::-1]
    color = (1.5 * rng.random((*shape, 3)) - 0.1).astype(np.float32)
    depth = rng.uniform(1, 3, shape).astype(np.float32)
    depth[rng.random(shape) < 0.3] = INF
    normal = rng.uniform(-1, 1, (*shape, 3)).astype(np.float32)
    color[0, seed], depth[1, seed], normal[2, seed] = NAN, NAN, NAN
    return Frame(SIZE, color, depth, normal, rng.integers(-1, 3, shape).astype(np.int32))


def textures(frame, upload):
    ones = np.ones((*SIZE[::-1], 1), np.float32)
    return Textures(
        color=upload(np.concatenate([frame.color, ones], axis=2)),
        surface=upload(np.concatenate([frame.normal, frame.depth[..., None]], axis=2)),
        object=upload(frame.id),
        primitive=upload(frame.id),
    )


def index_of(picture, colors):
    """The places in a map of a picture's colours."""
    distance = np.abs(picture[:, :, None].astype(int) - colors.astype(int)).sum(axis=3)
    assert (distance.min(axis=2) == 0).all(), "a colour that is not in the map"
    return distance.argmin(axis=2)


@pytest.mark.parametrize(
    ("channel", "component"),
    [("color", "rgb"), ("color", "green"), ("depth", "rgb"), ("normal", "rgb"), ("id", "rgb")],
)
@pytest.mark.parametrize("gain", [1, 7.5])
@pytest.mark.parametrize("signed", [False, True])
def test_the_shader_computes_the_same(composed, upload, channel, component, gain, signed):
    raster, ray = random_frame(1), random_frame(2)
    mapping = Mapping(channel, component, gain, signed)
    picture = shown(composed.difference(textures(raster, upload), "drawn", ray, mapping))
    if component == "green":
        raster, ray = (replace(each, color=each.color[..., [1] * 3]) for each in (raster, ray))
    difference = signed_difference(raster, ray, channel)
    expected = false_color(difference, channel, gain, signed)
    colors = SIGNED_COLORS if signed and channel != "id" else ABSOLUTE_COLORS
    away = np.abs(index_of(picture, colors) - index_of(expected, colors))
    # Neighbours in the map, where a float's last place decides the rounding.
    assert away.max() <= 1
    assert (away != 0).mean() < 0.05


def test_it_is_drawn_again_only_where_something_has_changed(composed, upload):
    first, second = textures(random_frame(1), upload), random_frame(2)
    before = shown(composed.difference(first, 1, second, Mapping()))
    first.color.write(np.zeros((*SIZE[::-1], 4), np.float32))
    assert (shown(composed.difference(first, 1, second, Mapping())) == before).all()
    assert (shown(composed.difference(first, 2, second, Mapping())) != before).any()
    after = shown(composed.difference(first, 2, second, Mapping(gain=0.5)))
    assert (after != before).any()
    assert (shown(composed.difference(first, 2, random_frame(3), Mapping(gain=0.5))) != after).any()


def test_each_side_keeps_its_picture(composed, upload):
    rng = np.random.default_rng(3)
    values = [rng.integers(0, 256, (*SIZE[::-1], 4), np.uint8) for _ in SIDES]
    pictures = [
        composed.compose(SIZE, (upload(value), 0), side=side)
        for value, side in zip(values, SIDES, strict=True)
    ]
    for picture, value in zip(pictures, values, strict=True):
        assert (shown(picture) == value[..., :3]).all()


def test_a_coarse_picture_is_enlarged_to_the_nearest_pixel(composed, upload):
    coarse = np.random.default_rng(4).integers(0, 256, (4, 7, 4), np.uint8)
    picture = shown(composed.compose((14, 8), (upload(coarse), 0)))
    assert (picture == coarse[..., :3].repeat(2, axis=0).repeat(2, axis=1)).all()


def test_a_muted_picture_is_gray_and_dark(composed, upload):
    bright = np.full((*SIZE[::-1], 4), (250, 120, 30, 255), np.uint8)
    picture = shown(composed.compose(SIZE, (upload(bright), 0), muted=True))
    assert (picture == picture[..., :1]).all()
    assert 20 < picture.mean() < 100


def test_marked_pixels_have_their_causes_colours(composed, upload):
    labels = np.zeros(SIZE[::-1], np.uint8)
    labels[2, 3], labels[4, 5], labels[6, 12] = 1, SHADING, UNEXPLAINED
    black = upload(np.zeros((*SIZE[::-1], 4), np.uint8))
    picture = composed.compose(SIZE, (black, 0), labels=labels, enlarged=False)
    expected = LABEL_COLORS[labels]
    assert (shown(picture) == expected).all()
    labels = labels.copy()
    labels[0, 0] = len(CAUSES)
    picture = composed.compose(SIZE, (black, 0), labels=labels, enlarged=False)
    assert (shown(picture) == LABEL_COLORS[labels]).all()


def test_single_pixels_are_enlarged_so_that_they_can_be_seen():
    labels = np.zeros((40, 50), np.uint8)
    labels[0, 0], labels[20, 20], labels[20, 22] = 1, 2, UNEXPLAINED
    large = marks(labels)
    assert (large[:2, :2] == 1).all()
    assert large[2, 2] == RIM
    assert (large[19:22, 19:21] == 2).all()
    assert (large[19:22, 21:24] == UNEXPLAINED).all()  # above the cause that is known
    assert large[20, 18] == large[18, 20] == large[22, 24] == RIM
    assert large[39, 49] == AGREE
    assert (LABEL_COLORS[RIM] == 0).all()
    labels = np.zeros((900, 1000), np.uint8)
    labels[500, 500] = 3
    assert (marks(labels) == 3).sum() == 7 * 7
    assert (marks(labels) == RIM).sum() == 9 * 9 - 7 * 7


def test_many_marks_are_not_enlarged():
    labels = np.zeros((40, 50), np.uint8)
    labels[10:20] = SHADING
    assert (marks(labels) == labels).all()
    labels[30, 30] = 1
    large = marks(labels)
    assert (large[10:20] == SHADING).all()
    assert (large[29:32, 29:32] == 1).all()


def test_nothing_is_left(gl, upload):
    gl.gc_mode = "context_gc"
    raster, ray = textures(random_frame(1), upload), random_frame(2)
    kept = sum(type(thing).__name__ != "InvalidObject" for thing in gl.objects)
    made = Composed(gl)
    picture = made.difference(raster, 0, ray, Mapping("depth"))
    made.compose(SIZE, picture.held, labels=np.ones(SIZE[::-1], np.uint8))
    made.release()
    assert sum(type(thing).__name__ != "InvalidObject" for thing in gl.objects) == kept
    gl.gc_mode = None


def test_the_maps_can_be_shown_as_bars(composed):
    for signed, colors in ((False, ABSOLUTE_COLORS), (True, SIGNED_COLORS)):
        assert shown(composed.color_map(signed)).tolist() == [colors.tolist()]
        assert composed.color_map(signed).size == (STEPS, 1)
