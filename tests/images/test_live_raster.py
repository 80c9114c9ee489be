"""The raster image on its way to the window: over several frames, and never torn."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import replace

import moderngl
import numpy as np
import pytest

from app.images import progressive_raster as parts
from app.images.renderers import Renderers
from app.images.request import ImageRequest
from app.images.shown import Picture, whole
from app.images.textures import ImageTextures
from app.state.app_state import AppState
from renderer.coarseness import Coarseness
from renderer.errors import LucidaError
from renderer.frame import CHANNELS, Frame
from renderer.raster import Look, Rasterizer
from renderer.raster.targets import Targets
from renderer.scene import load_scene

SIZE, OTHER_SIZE = (96, 64), (120, 90)
PATIENT_FRAMES = 500


@pytest.fixture
def textures(gl, monkeypatch) -> Iterator[ImageTextures]:
    """Their full images are refined at once, and take many strips."""
    monkeypatch.setattr("app.images.live_raster.MOVING_S", 0.0)
    monkeypatch.setattr(parts, "STRIP_PIXELS", 1)
    monkeypatch.setattr(Coarseness, "full_s", lambda *_: 20 * parts.STRIP_S)
    made = ImageTextures(gl)
    yield made
    made.release()


SCENE = load_scene("still-life")


def wanted(dx: float = 0.0, size: tuple[int, int] = SIZE) -> ImageRequest:
    camera = SCENE.view.for_size(size)
    return ImageRequest(SCENE, replace(camera, eye=tuple(np.add(camera.eye, (dx, 0.0, 0.0)))), size)


def frame(textures: ImageTextures, of: ImageRequest, channel: str = "color") -> Picture:
    textures.begin_frame()
    picture = textures.raster_in(whole(of.size), of, Look(channel))  # type: ignore[arg-type]
    assert textures.raster_error is None
    assert picture is not None
    return picture


def full(textures: ImageTextures, of: ImageRequest) -> Picture:
    for _ in range(PATIENT_FRAMES):
        picture = frame(textures, of)
        if textures.raster.full(of) is not None and not textures.raster.unfinished:
            return picture
        time.sleep(0.001)
    raise AssertionError("never full")


def pixels(picture: Picture) -> np.ndarray:
    return np.frombuffer(picture.texture.read(), np.uint8).copy()


def read_back(textures: ImageTextures, of: ImageRequest) -> Frame:
    for _ in range(PATIENT_FRAMES):
        textures.begin_frame()
        if (read := textures.raster.read_back(of)) is not None:
            return read
    raise AssertionError("never read")


def begin_strips(textures: ImageTextures, of: ImageRequest) -> None:
    """Some strips of a full image, by way of the comparison."""
    for _ in range(5):
        textures.begin_frame()
        assert textures.raster.read_back(of) is None
    # Nothing public says how far an image has come that nobody sees.
    assert textures.raster._under_way is not None
    drawing = textures.raster._under_way.drawing
    assert drawing.factor == 1
    assert 0 < drawing._first_row < of.size[1]


@pytest.mark.parametrize("size", [SIZE, OTHER_SIZE])
def test_the_shown_image_stays_whole_while_another_is_drawn_in_strips(textures, size):
    first = wanted()
    before = pixels(full(textures, first))
    begin_strips(textures, wanted(0.5, size))
    normal = frame(textures, first, "normal")  # drawn anew from the image's textures
    assert (pixels(normal) != before).any()
    np.testing.assert_array_equal(pixels(frame(textures, first)), before)
    read = read_back(textures, first)
    with Rasterizer(SCENE) as rasterizer:
        expected = rasterizer.render(first.camera, first.size, CHANNELS)
    for channel in CHANNELS:
        np.testing.assert_array_equal(read.channel(channel), expected.channel(channel))


def test_what_is_read_is_the_image_drawn_in_strips(textures):
    full(textures, wanted())
    for step in range(1, 4):  # from one place to the other, and back
        of = wanted(0.2 * step)
        read = read_back(textures, of)
        with Rasterizer(SCENE) as rasterizer:
            expected = rasterizer.render(of.camera, of.size, CHANNELS)
        np.testing.assert_array_equal(read.depth, expected.depth)
        values = textures.raster.values(of, "depth", (3, 4, 9, 12))
        assert values is not None
        np.testing.assert_array_equal(values, expected.depth[3:9, 4:12])
        for pixel in ((3, 4), (40, 50)):
            hit = expected.id[pixel], expected.depth[pixel]
            assert textures.raster.hit(of, pixel) == hit


def test_a_motion_shows_something_new_in_each_frame_whatever_one_image_took(textures):
    full(textures, wanted())
    textures.raster.coarseness.changed = lambda *_: 1  # as fine as can be, though that is slow
    for step in range(1, 6):
        drawn = textures.raster.image.number
        frame(textures, wanted(0.1 * step))
        assert textures.raster.image.number == drawn + 1


def test_a_motion_shows_something_new_though_an_image_takes_several_frames(textures):
    full(textures, wanted())
    textures.raster.pace.part_of = lambda triangles: -(-triangles // 3)
    textures.raster.coarseness.changed = lambda *_: 1
    numbers = []
    for step in range(1, 16):
        frame(textures, wanted(0.1 * step))
        numbers.append(textures.raster.image.number)
    assert numbers[-1] - numbers[0] >= 2


def test_an_image_of_another_size_is_never_stretched(textures):
    full(textures, wanted())
    textures.raster.pace.part_of = lambda triangles: -(-triangles // 3)
    for size in (OTHER_SIZE, SIZE, OTHER_SIZE):
        frame(textures, wanted(0.3))  # several frames would draw it
        frame(textures, wanted(0.6, size))
        image = textures.raster.image
        assert image.request.size == size


def test_effects_that_only_the_tracer_has_draw_nothing_anew(textures):
    of = wanted()
    full(textures, of)
    image = textures.raster.image
    for effects in ({"shadows": True}, {"mirrors": True}):
        asked = replace(of, **effects)
        frame(textures, asked)
        assert textures.raster.image is image
        assert textures.raster.full(asked) is image
        assert not textures.raster.unfinished
        assert read_back(textures, asked).size == of.size
        assert textures.raster.image is image


def test_an_image_that_fails_leaves_nothing_broken(textures, monkeypatch):
    monkeypatch.setattr(Coarseness, "full_s", lambda *_: 0.0)
    before = pixels(full(textures, wanted()))
    textures.begin_frame()
    with monkeypatch.context() as full_memory:
        # Only here does a GPU that is full say so.
        full_memory.setattr(Targets, "_build", lambda *_: (_ for _ in ()).throw(moderngl.Error()))
        with pytest.raises(LucidaError, match="choose a smaller image"):  # where the shown one was
            textures.raster.read_back(wanted(size=OTHER_SIZE))
    assert (pixels(frame(textures, wanted(), "normal")) != before).any()
    np.testing.assert_array_equal(pixels(full(textures, wanted())), before)


def test_a_range_that_nobody_asks_for_is_nothing_to_wait_for(textures):
    full(textures, wanted())
    frame(textures, wanted(), "depth")
    assert textures.unfinished  # the range's numbers come a frame later
    for _ in range(3):
        frame(textures, wanted())
    assert not textures.unfinished
    assert textures.depths() is not None


def test_the_ray_image_begins_no_finer_than_the_raster_image_beside_it(gl, monkeypatch):
    both, state = Renderers(lambda: None), AppState.for_scene(SCENE)
    both.size = SIZE
    asked: list[int] = []
    monkeypatch.setattr(both.live, "request", lambda _, begin_at=1: asked.append(begin_at))
    both.begin(gl)
    assert both.textures is not None
    both.trace(state)
    of = both.request(state)
    assert of is not None
    frame(both.textures, of)
    both.trace(state)
    assert both.textures.raster.image is not None
    both.textures.raster.image = replace(both.textures.raster.image, factor=3)
    both.trace(state)
    for _ in range(2):
        both.textures.begin_frame()  # nobody has looked at it in the last one
    both.trace(state)
    both.end()
    assert asked == [1, 1, 3, 1]
