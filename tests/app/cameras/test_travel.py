"""A camera's transition in the window: its path in time, and what ends it."""

from __future__ import annotations

from dataclasses import replace

import pytest
from option_changes import with_options
from test_animation import PRESET, SIZE

from lucida.app.cameras.presets import preset_view
from lucida.app.cameras.travel import DURATION_S, CameraTransition, Ends
from lucida.app.state.app_state import AppState, History, is_orthonormal
from lucida.renderer.camera.camera import Camera
from lucida.renderer.files import load_scene
from lucida.renderer.scene.focus import Focus, scene_focus
from lucida.renderer.scene.model import Scene


class Clock:
    """A clock that the test advances."""

    def __init__(self) -> None:
        self.s = 100.0

    def __call__(self) -> float:
        return self.s


def target_of(state: AppState, name: str) -> AppState:
    focus = scene_focus(state.scene)
    view = preset_view(PRESET[name], state.view, focus.framed, focus.bounds, 1.0)
    return replace(state.with_view(view), keep_orthonormal=is_orthonormal(view.camera))


def begin(scene: Scene, name: str = "Front") -> tuple[Clock, CameraTransition, AppState]:
    clock, state = Clock(), AppState.for_scene(scene)
    transition = CameraTransition(clock)
    target = target_of(state, name)
    shown = transition.begin(state, target, scene_focus(scene), SIZE)
    assert shown is state
    return clock, transition, target


def test_a_transition_takes_its_duration_at_any_frame_rate(scene: Scene) -> None:
    for frames in (1, 7, 300):
        clock, transition, target = begin(scene, "Cabinet")
        state = AppState.for_scene(scene)
        middle = None
        for number in range(frames + 1):
            clock.s = 100.0 + DURATION_S * number / frames
            state = transition.step(state)
            if number == frames // 2:
                middle = state
        assert state == target
        assert not state.keep_orthonormal
        assert not transition.under_way
        assert frames == 1 or middle not in (target, AppState.for_scene(scene))


def test_another_change_of_the_view_ends_a_transition(scene: Scene) -> None:
    clock, transition, _ = begin(scene)
    clock.s += 0.1
    state = transition.step(AppState.for_scene(scene))
    moved = state.with_camera(replace(state.camera, eye=(1, 2, 3)))
    clock.s += 0.1
    assert transition.step(moved) is moved
    assert not transition.under_way


def test_keep_orthonormal_stays_off_until_the_end(scene: Scene) -> None:
    clock, transition, target = begin(scene)
    state = AppState.for_scene(scene).with_keep_orthonormal(False)
    clock.s += 0.4 * DURATION_S
    between = transition.step(state)
    assert is_orthonormal(between.camera) and not between.keep_orthonormal
    clock.s += DURATION_S
    assert transition.step(between).keep_orthonormal == target.keep_orthonormal


def test_a_new_transition_replaces_the_previous_one(scene: Scene) -> None:
    clock, transition, _ = begin(scene)
    assert transition.under_way is True
    first = transition.gesture
    clock.s += 0.1
    state = transition.step(AppState.for_scene(scene))
    other = target_of(state, "Left")
    assert transition.begin(state, other, scene_focus(scene), SIZE) is state
    assert transition.gesture != first
    transition.instant = True
    there = target_of(state, "Right")
    assert transition.begin(state, there, scene_focus(scene), SIZE) is there
    assert transition.under_way is False


def test_a_transition_is_one_undo_step(scene: Scene) -> None:
    clock, transition, target = begin(scene)
    history = History(AppState.for_scene(scene))
    for _ in range(10):
        clock.s += DURATION_S / 9
        state = transition.step(history.present)
        history = history.change(state, transition.gesture)
    assert history.present == target
    assert len(history.past) == 1


def test_the_outside_camera_moves_without_an_undo_step(scene: Scene) -> None:
    clock, state = Clock(), AppState.for_scene(scene)
    start = Camera.look_at((9.0, 3.0, 9.0), (0.0, 0.0, 0.0))
    end = Camera.look_at((0.0, 12.0, 1.0), (0.0, 0.0, 0.0))
    for there in (end, None):  # None: the view finds it
        transition = CameraTransition(clock)
        target = with_options(state, outside={"camera": there}, shadows=True)
        ends = Ends(
            start,
            end,
            SIZE,
            of=lambda state: state.options.outside.camera,
            put=lambda state, camera: with_options(state, outside={"camera": camera}),
        )
        assert transition.begin(state, target, scene_focus(scene), SIZE, ends) is state
        history = History(state)
        for part in (0.0, 0.5, 1.0):
            clock.s += 0.5 * DURATION_S * (part > 0)
            found = transition.step(history.present)
            history = history.change(found, transition.gesture)
            if part == 0.5:
                middle = found.options.outside.camera
        assert middle not in (None, start, end)
        assert history.present == with_options(state, outside={"camera": there})
        assert history.past == ()  # undo is for the scene's camera
        assert not transition.under_way
        # Another outside camera ends the transition; another view does not.
        transition.begin(state, target, scene_focus(scene), SIZE, ends)
        clock.s += 0.1
        found = transition.step(target_of(state, "Front"))
        assert transition.under_way and found.view == target_of(state, "Front").view
        moved = with_options(found, outside={"camera": end})
        assert transition.step(moved) is moved
        assert not transition.under_way


@pytest.mark.parametrize("reason", ["instant", "reduced", "mirrored", "scene", "no window"])
def test_an_invisible_transition_ends_at_once(scene: Scene, reason: str) -> None:
    state, transition, size = AppState.for_scene(scene), CameraTransition(Clock()), SIZE
    target = target_of(state, "Left")
    if reason == "instant":
        transition.instant = True
    elif reason == "reduced":
        state = with_options(state, preferences={"reduced_motion": True})
    elif reason == "mirrored":
        target = target.with_camera(replace(target.camera, u=(0.0, 0.0, -1.0)))
    elif reason == "scene":
        target = target.with_scene(load_scene("canonical"))
    else:
        size = (0, 0)
    assert transition.begin(state, target, Focus(), size) is target
    assert not transition.under_way
