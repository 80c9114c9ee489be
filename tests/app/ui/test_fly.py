"""Flying with the keys: ImGui without a window has the keys, a stand-in takes what is applied."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from imgui_bundle import imgui

from lucida.app.state.app_state import AppState
from lucida.app.ui.fly import Fly
from lucida.app.ui.instrument import Instrument
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import LARGEST
from lucida.renderer.scene.focus import Focus
from lucida.renderer.scene.model import Scene

Key = imgui.Key
WAY = 0.35 * 20.0 * 0.05  # of a frame of 0.05 s, in a scene that reaches 20 units


class Host:
    """The part of the window that Fly uses."""

    def __init__(self) -> None:
        self.state = AppState.for_scene(Scene(()))
        self.focus = Focus(reach=20.0)
        self.gestures: list[object] = []
        self.animated = 0

    def apply(self, state: AppState, gesture: object) -> None:
        self.state = state
        self.gestures.append(gesture)

    def animate(self) -> None:
        self.animated += 1


class Images(Instrument):
    """A view of the images' camera."""

    def flown(self, host: Any) -> Camera | None:
        return host.state.camera

    def with_flown(self, state: AppState, camera: Camera) -> AppState:
        return state.with_camera(camera)


Frame = Callable[..., np.ndarray]


@pytest.fixture
def host() -> Host:
    return Host()


@pytest.fixture
def fly() -> Fly:
    return Fly()


@pytest.fixture
def frame(fly: Fly, host: Host) -> Iterator[Frame]:
    """A frame in which these keys are down; gives how far the eye went: right, up, forward."""
    context = imgui.create_context()
    io = imgui.get_io()
    io.set_ini_filename("")
    io.display_size = imgui.ImVec2(100, 100)
    io.backend_flags |= imgui.BackendFlags_.renderer_has_textures.value
    down: set[Key] = set()

    def run(*keys: Key, over: Instrument | None, before: Callable[[], object] = bool) -> np.ndarray:
        for key in down | set(keys):
            io.add_key_event(key, key in keys)
        down.clear()
        down.update(keys)
        io.delta_time = 0.05
        imgui.new_frame()
        before()
        camera = host.state.camera
        fly.frame(host, over)  # type: ignore[arg-type]
        imgui.end_frame()
        way = np.subtract(host.state.camera.eye, camera.eye)
        return way @ np.array([camera.u, camera.v, -np.array(camera.w)]).T

    yield run
    imgui.destroy_context(context)


IMAGES = Images()


@pytest.mark.parametrize(
    ("keys", "way"),
    [
        ([Key.w], (0, 0, 1)),
        ([Key.s], (0, 0, -1)),
        ([Key.a], (-1, 0, 0)),
        ([Key.d], (1, 0, 0)),
        ([Key.q], (0, -1, 0)),
        ([Key.e], (0, 1, 0)),
        ([Key.w, Key.d, Key.e], (1, 1, 1)),
        ([Key.w, Key.s], (0, 0, 0)),
        ([Key.w, Key.left_shift, Key.mod_shift], (0, 0, 4)),
        ([Key.f], (0, 0, 0)),
    ],
)
def test_each_key_leads_its_way(host: Host, frame: Frame, keys, way) -> None:
    assert frame(*keys, over=IMAGES) == pytest.approx(np.multiply(way, WAY))
    assert host.animated == any(way)


def test_a_flight_stays_in_its_view_and_is_one_step_of_undo(
    host: Host, fly: Fly, frame: Frame
) -> None:
    assert frame(Key.w, over=None) == pytest.approx(0)  # the mouse is over no view
    assert not fly.under_way and not host.gestures
    assert frame(Key.w, over=Instrument()) == pytest.approx(0)  # nor over one that has no camera
    assert not fly.under_way and not host.gestures
    frame(over=IMAGES)
    for over in (IMAGES, None, Instrument()):
        assert frame(Key.w, over=over)[2] == pytest.approx(WAY)
        assert fly.under_way
    frame(over=IMAGES)
    assert not fly.under_way
    frame(Key.w, over=IMAGES)
    first, *same, other = host.gestures
    assert same == [first, first] and other != first


def test_in_the_middle_of_a_drag_both_are_one_step(host: Host, frame: Frame, monkeypatch) -> None:
    monkeypatch.setattr(imgui, "is_any_item_active", lambda: True)
    frame(Key.w, over=IMAGES)
    assert host.gestures == [None]


def open_popup() -> None:
    imgui.open_popup("menu")
    imgui.begin_popup("menu")
    imgui.end_popup()


@pytest.mark.parametrize(
    ("keys", "before"),
    [
        ([Key.mod_ctrl], bool),
        ([Key.mod_alt], bool),
        ([Key.mod_super], bool),
        ([], lambda: setattr(imgui.get_io(), "want_text_input", True)),
        ([], open_popup),
    ],
    ids=["ctrl", "alt", "super", "text", "menu"],
)
def test_keys_that_mean_something_else_do_not_fly(fly: Fly, frame: Frame, keys, before) -> None:
    frame(Key.w, over=IMAGES)
    assert frame(Key.w, *keys, over=IMAGES, before=before) == pytest.approx(0)
    assert not fly.under_way


def test_as_far_out_as_numbers_go_it_stays(host: Host, frame: Frame) -> None:
    host.state = host.state.with_camera(replace(host.state.camera, eye=(0, 0, -LARGEST)))
    assert frame(Key.w, over=IMAGES) == pytest.approx(0)
    assert not host.gestures
