"""The raster image on its way to the window, together with the ray image."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import replace

import moderngl
import numpy as np
import pytest
from option_changes import with_options

from lucida.app.images.progressive_ray import RayImage
from lucida.app.images.renderers import Renderers
from lucida.app.images.request import ImageRequest
from lucida.app.images.shown import Picture, whole
from lucida.app.images.textures import ImageTextures
from lucida.app.state.app_state import AppState
from lucida.renderer.camera.navigation import moved
from lucida.renderer.files import load_scene
from lucida.renderer.images.coarseness import STILL_S
from lucida.renderer.images.frame import CHANNELS, Frame
from lucida.renderer.raster import Look, Rasterizer
from lucida.renderer.raster.targets import Targets
from lucida.renderer.system.errors import LucidaError

SIZE, OTHER_SIZE = (96, 64), (120, 90)
SCENE = load_scene("still-life")


@pytest.fixture
def textures(gl) -> Iterator[ImageTextures]:
    made = ImageTextures(gl)
    yield made
    made.release()


def wanted(dx: float = 0.0, size: tuple[int, int] = SIZE) -> ImageRequest:
    return ImageRequest(SCENE, moved(SCENE.view.for_size(size), (dx, 0.0, 0.0)), size)


def frame(textures: ImageTextures, of: ImageRequest, channel: str = "color") -> Picture:
    textures.begin_frame()
    picture = textures.raster_in(whole(of.size), of, Look(channel))  # type: ignore[arg-type]
    assert textures.raster_error is None
    assert picture is not None
    return picture


def pixels(picture: Picture) -> np.ndarray:
    return np.frombuffer(picture.texture.read(), np.uint8).copy()


def test_what_is_read_is_what_a_rasterizer_draws(textures):
    frame(textures, wanted())
    for step in range(1, 4):
        of = wanted(0.2 * step)
        read = textures.raster.read_back(of)
        with Rasterizer(SCENE) as rasterizer:
            expected = rasterizer.render(of.camera, of.size, CHANNELS)
        for channel in CHANNELS:
            np.testing.assert_array_equal(read.channel(channel), expected.channel(channel))
        values = textures.raster.values(of, ("depth", "id"), (3, 4, 9, 12))
        np.testing.assert_array_equal(values["depth"], expected.depth[3:9, 4:12])
        np.testing.assert_array_equal(values["id"], expected.id[3:9, 4:12])


def test_effects_that_only_the_tracer_has_draw_nothing_anew(textures):
    of = wanted()
    frame(textures, of)
    image = textures.raster.image
    for effects in ({"shadows": True}, {"mirrors": True}, {"samples": 16}):
        asked = replace(of, **effects)
        frame(textures, asked)
        assert textures.raster.read_back(asked).size == of.size
        assert textures.raster.image is textures.raster.full(asked) is image


def test_an_image_that_fails_leaves_nothing_broken(textures, monkeypatch):
    before = pixels(frame(textures, wanted()))
    textures.begin_frame()
    with monkeypatch.context() as full_memory:
        # Only here does a GPU that is full say so.
        full_memory.setattr(Targets, "_build", lambda *_: (_ for _ in ()).throw(moderngl.Error()))
        with pytest.raises(LucidaError, match="select a smaller image"):
            textures.raster.read_back(wanted(size=OTHER_SIZE))
    np.testing.assert_array_equal(pixels(frame(textures, wanted())), before)


def test_a_range_that_nobody_asks_for_is_nothing_to_wait_for(textures):
    frame(textures, wanted(), "depth")
    assert textures.unfinished  # the range's numbers come a frame later
    for _ in range(3):
        frame(textures, wanted())
    assert not textures.unfinished
    assert textures.depths() is not None


class Window:
    """A window's frames: both images of a camera that moves. The test traces the ray image."""

    def __init__(self, gl: moderngl.Context, monkeypatch: pytest.MonkeyPatch) -> None:
        self.both, self.state = Renderers(lambda: None), AppState.for_scene(SCENE)
        self.both.size = SIZE
        self.now_s, self.preparing_s = 100.0, 0.0
        self.asked: list[tuple[ImageRequest, int]] = []
        self.arrived: RayImage | None = None
        live, window = self.both.live, self
        monkeypatch.setattr(live, "request", lambda *what: self.asked.append(what))
        monkeypatch.setattr(live, "poll", self._poll)
        monkeypatch.setattr(
            type(live), "preparing_s", property(lambda _: window.preparing_s), raising=True
        )
        monkeypatch.setattr(time, "monotonic", lambda: self.now_s)
        self.both.begin(gl)

    def _poll(self) -> RayImage | None:
        image, self.arrived = self.arrived, None
        return image

    def trace(self) -> None:
        """Let the newest ray image arrive."""
        request, factor = self.asked[-1]
        width, height = (-(-side // factor) for side in request.size)
        color = np.zeros((height, width, 3), np.float32)
        shown = Frame((width, height), color, time_s=1.0)
        self.arrived = RayImage(request, shown, factor)

    def move(self, dx: float = 0.1) -> None:
        self.state = self.state.with_camera(moved(self.state.camera, (dx, 0.0, 0.0)))

    def frame(self, has_ray: bool = True) -> tuple[ImageRequest, int, RayImage | None]:
        """Draw a frame. Return the request and the factor of the raster image, and the ray
        image.
        """
        self.now_s += 1 / 60
        self.both.update(self.state, True)
        request = self.both.request(self.state)
        assert request is not None and self.both.textures is not None
        place = whole(SIZE)
        assert self.both.picture(False, self.state, place) is not None
        raster = self.both.textures.raster.image
        assert raster is not None
        ray = None
        if has_ray:
            if self.both.picture(True, self.state, place) is not None:
                ray = self.both.shown_ray(self.state)
                assert ray is not None
            self.both.trace(self.state)
        return raster.request, raster.factor, ray


@pytest.fixture
def window(gl, monkeypatch) -> Iterator[Window]:
    made = Window(gl, monkeypatch)
    yield made
    made.both.end()


def begun(window: Window) -> None:
    """Both images at rest."""
    for _ in range(3):
        window.frame()
        window.trace()
    request, factor, ray = window.frame()
    assert factor == 1 and ray is not None and ray.request.without_effects == request


def test_in_motion_both_images_have_one_camera_and_one_size(window):
    begun(window)
    seen = set()
    for step in range(40):
        window.move()
        request, factor, ray = window.frame()
        assert ray is not None
        assert (ray.request.camera, ray.request.size) == (request.camera, request.size)
        assert ray.factor == factor
        seen.add((request, factor))
        if step % 3:  # some images take two frames
            window.trace()
    assert len(seen) > 20
    assert {factor for _, factor in seen} > {1}  # the tracer has said that it is slow


def test_at_rest_both_become_full_and_the_raster_image_does_not_wait(window):
    begun(window)
    for _ in range(3):
        window.move()
        window.frame()
        window.trace()
    request, factor, ray = window.frame()
    assert factor == ray.factor > 1 and request == window.both.request(window.state)
    assert window.both.unfinished(window.state)
    window.now_s += STILL_S
    request, factor, ray = window.frame()
    assert factor == 1 < ray.factor and request.camera == ray.request.camera
    assert window.asked[-1] == (request, 1)
    window.trace()
    assert window.frame()[2].factor == 1


def test_the_raster_image_goes_alone_while_the_tracer_prepares(window):
    begun(window)
    window.preparing_s = 1.0
    window.move()
    window.frame()
    request, _, ray = window.frame()
    assert request == window.both.request(window.state)
    assert ray is None  # another camera's


def test_the_raster_image_goes_alone_where_no_view_shows_the_ray_image(window):
    begun(window)
    for _ in range(2):
        window.frame(has_ray=False)
    window.move()
    request, _, _ = window.frame(has_ray=False)
    assert request == window.both.request(window.state)


def test_several_samples_are_for_a_camera_at_rest(window):
    window.state = with_options(window.state, images={"samples": 16})
    begun(window)
    assert window.asked[-1][0].samples == 16
    window.move()
    window.frame()
    assert window.asked[-1][0].samples == 1
