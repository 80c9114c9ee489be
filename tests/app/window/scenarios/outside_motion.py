"""The outside view in motion: by mouse and keys, in smooth transitions, each one undo step."""

import numpy as np
from held_clock import Clock
from outside_window import empty_place, enter, press, scope, view
from window_driver import Key

from lucida.app.cameras.travel import DURATION_S
from lucida.renderer.camera.camera import Camera


def looks_from(d):
    """The unit vector from what is looked at to the camera that looks."""
    at = view(d).scope
    back = np.asarray(at.camera.w)
    return back / np.linalg.norm(back)


def drive_the_view_turns_smoothly_as_one_step(d):
    enter(d)
    window, clock = d.window, Clock(d)
    start = looks_from(d)
    assert window.state.options.outside.camera is None
    at = view(d).scope
    beside = np.add(at.center, (4 * at.reach, 0, 0))
    view(d).look(window, Camera.look_at(beside, at.center, fov_y_deg=50.0))
    d.until(lambda: window.motions.transition.under_way)
    inner, turned = window.state.view, []
    for part in (0.25, 0.5, 0.75):
        clock.s = 10.0 + part * DURATION_S
        d.frames(2)
        way = looks_from(d)
        turned.append(float(np.arccos(np.clip(way @ start, -1, 1))))
        at = view(d).scope
        ahead = np.asarray(at.center) - at.camera.eye
        assert ahead @ way < 0
    whole = float(np.arccos(np.clip(start @ (1, 0, 0), -1, 1)))
    assert 0 < turned[0] < turned[1] < turned[2] < whole
    assert abs(turned[1] - whole / 2) < 0.02  # half of the way after half of the time
    clock.s += DURATION_S
    d.until(lambda: not window.motions.transition.under_way)
    d.frames(2)
    assert np.allclose(looks_from(d), (1, 0, 0))
    assert not d.steps, "undo is for the other camera"
    assert window.state.view == inner
    # Back to the view of all, which the state leaves to the view, at the end.
    press(d, "Fit all")
    clock.s += 0.999 * DURATION_S
    moving = window.motions.transition
    d.until(lambda: window.state.options.outside.camera is not None and moving.under_way)
    d.frames(2)
    near_end = looks_from(d)
    clock.s += DURATION_S
    d.until(lambda: window.state.options.outside.camera is None)
    d.frames(2)
    assert np.allclose(looks_from(d), start, atol=1e-9)
    assert np.allclose(near_end, start, atol=1e-3)


def drive_the_mouse_moves_the_camera_that_looks(d):
    enter(d)
    window, inner = d.window, d.state.camera
    assert window.state.options.outside.camera is None
    x, y = empty_place(d)
    before = scope(d).camera
    d.drag((x, y), (x + 80, y + 30))
    turned = window.state.options.outside.camera
    assert turned.w != before.w
    assert abs(turned.u[1]) < 1e-9  # no roll
    for button, key in ((1, 0), (2, 0), (0, Key.mod_shift)):
        was = window.state.options.outside.camera
        if key:
            d.ctx.key_down(key)
        d.drag((x, y), (x - 40, y - 20), button)
        if key:
            d.ctx.key_up(key)
        moved = window.state.options.outside.camera
        assert (moved.u, moved.v, moved.w) == (was.u, was.v, was.w)
        assert moved.eye != was.eye
    was = window.state.options.outside.camera
    d.ctx.mouse_teleport_to_pos((x, y))
    d.frames()
    d.ctx.mouse_wheel_y(2)
    d.frames(2)
    closer = window.state.options.outside.camera
    middle = np.asarray(scope(d).center)
    assert np.linalg.norm(closer.eye - middle) < np.linalg.norm(was.eye - middle)
    assert window.state.camera == inner  # the other camera stays


def drive_keys_switch_it(d):
    enter(d)
    window = d.window
    d.move_to(empty_place(d))
    d.press(Key.b)
    assert min(window.state.options.outside.bundle) > 0
    d.press(Key.g)
    assert window.state.options.outside.gizmo == "move"
    d.press(Key.t)
    assert window.state.options.outside.gizmo == "turn"
    d.press(Key.t)
    assert window.state.options.outside.gizmo == "none"
