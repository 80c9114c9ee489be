"""The outside view's resolution while its camera moves, by a clock that the test sets."""

from dataclasses import replace
from types import SimpleNamespace

import pytest

from lucida.app.images.request import ImageRequest
from lucida.app.instruments.outside import ground as module
from lucida.app.instruments.outside.ground import SHIFTS, SLOW_S, Ground
from lucida.renderer.camera.camera import Camera
from lucida.renderer.files import load_scene
from lucida.renderer.images.coarseness import STILL_S

SIZE = 40, 30


class Painter:
    """A fake rasterizer and overlay that records the sizes it draws."""

    def __init__(self):
        self.sizes = []

    def draw(self, request, place):
        self.sizes.append(request.size)
        return SimpleNamespace()

    def gather(self, *_):
        return SimpleNamespace()


@pytest.fixture
def draw(monkeypatch):
    now_s, painter, ground = [10.0], Painter(), Ground()
    monkeypatch.setattr(module.time, "monotonic", lambda: now_s[0])
    request = ImageRequest(load_scene("canonical"), Camera.look_at((4, 3, 5), (0, 0, 0)), SIZE)

    def draw(after_s, place):
        """Return the sizes drawn `after_s` later with a camera at a place."""
        now_s[0] += after_s
        painter.sizes.clear()
        camera = replace(request.camera, eye=(place, 3.0, 5.0))
        shown = ground.picture(replace(request, camera=camera), painter, painter)
        for width, _ in painter.sizes[-1:]:
            assert shown.factor == SIZE[0] // width
        return list(painter.sizes)

    return draw


def test_fast_pictures_have_the_full_resolution(draw):
    assert [draw(SLOW_S / 2, place) for place in range(5)] == 5 * [[SIZE]]


def test_a_slow_picture_halves_the_resolution_until_the_camera_rests(draw):
    half = SIZE[0] // 2, SIZE[1] // 2
    assert draw(0, 0) == [SIZE]
    assert draw(2 * SLOW_S, 1) == [half]
    assert draw(SLOW_S / 2, 2) == [half]
    assert draw(SLOW_S / 2, 2) == []  # nothing has changed
    assert draw(STILL_S, 2) == len(SHIFTS) * [SIZE]  # with smooth edges
    assert draw(1.0, 2) == []
    assert draw(1.0, 3) == [SIZE]  # another motion
