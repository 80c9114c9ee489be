"""Every step of the built-in lecture shows its own state and views, whichever way leads to it."""

from dataclasses import replace

import numpy as np
from imgui_bundle import hello_imgui, imgui
from lecture_window import untraced, untraced_drive
from option_changes import with_options
from window_driver import Key

from lucida.app.lecture.reading import BUILTIN, load_lecture
from lucida.app.lecture.view import LECTURE
from lucida.app.ui import layout
from lucida.app.ui.theme import framebuffer_scale

SPOILED = (1, 21, 30)  # steps with images, without, and with a resolution
JUMPS = (33, 12)
VISITED = sorted({*SPOILED, *JUMPS})


def _begin(d):
    d.window.lecture.give(load_lecture(BUILTIN), BUILTIN)
    _rest(d)
    return d.window.lecture


def _rest(d):
    d.settle()
    d.until(lambda: not d.window.is_rearranging)
    d.settle()  # a mark finds its image's size


def _go(d, number):
    d.window.lecture.go(d.window, number)
    _rest(d)


def _facts(d):
    """Return a step's state, its images' size and camera, and the places of its views."""
    state, both = d.state, d.renderers
    return (
        replace(state, options=replace(state.options, bookmarks=())),
        both.size,
        both.camera(state),
        _rects(d),
    )


def _views(d, picture):
    """Return what the views show, without their tabs, which show who has the keyboard, and without
    the status line, which reports work in the background.
    """
    scale = framebuffer_scale()
    boxes = {name: [round(edge * scale) for edge in rect] for name, rect in _rects(d).items()}
    return {
        name: picture[top:bottom, left:right] for name, (left, top, right, bottom) in boxes.items()
    }


def _rects(d):
    return dict(sorted(d.stage.rects.items()))


def _leave(d):
    d.window.lecture.leave(d.window)
    d.settle()


def _spoil(d):
    """Do what a user may do between two steps."""
    state = d.state
    changed = with_options(
        state,
        marked=(1, 2),
        shadows=not state.options.shadows,
        images={"resolution": None, "samples": 4, "exposure_ev": 2.0, "channel": "depth"},
        outside={"bundle": (2, 2), "volume": False},
        stepper={"steps": (3, 3), "canvas": (4, 3)},
        laboratory={"page": "array", "progress": 3.0},
    )
    d.window.change(changed.with_camera(replace(state.camera, eye=(0.3, 0.4, 7.0))))
    for name in ("Raster", "Outside"):
        d.stage.show(name, not d.stage.is_shown(name))
    _rest(d)


def drive_a_step_does_not_depend_on_the_way(d):
    lecture = _begin(d)
    facts, before = {}, d.picture()
    for number in VISITED:
        step = lecture.session.lecture.steps[number]
        _go(d, number)
        facts[number] = _facts(d)
        picture = d.picture()
        views = _views(d, picture)
        assert views.keys() == {LECTURE, *(name.capitalize() for name in step.views)}, step.title
        for name, view in views.items():  # something is visible in each view
            is_over = step.full and name == LECTURE  # the text, if there is one
            assert is_over or (min(view.shape[:2]) > 80 and view.std() > 5), (step.title, name)
        assert np.abs(picture.astype(int) - before).max() > 30, step.title
        assert d.renderers.failure is None and not d.files.message, step.title
        before = picture
    with untraced(d):
        for number in JUMPS:
            _go(d, number)
            assert _facts(d) == facts[number], number
        for number in SPOILED:
            _spoil(d)
            _go(d, number)
            assert _facts(d) == facts[number], number
    _leave(d)


@untraced_drive
def drive_the_stage_has_pictures_and_text_alone(d):
    before = layout.LAYOUTS[1].name
    d.layout(before)
    lecture = _begin(d)
    bars = hello_imgui.get_runner_params().imgui_window_params

    def is_bare():
        return not (bars.show_menu_bar or bars.show_status_bar or d.window.has_tools)

    d.ctx.mouse_teleport_to_pos((200, 200))
    d.until(lambda: not lecture.shows_controls)
    assert is_bare() and d.window.on_stage
    d.settle()
    rects = _rects(d)
    assert rects["Raster"][1] < 3 and rects["Raster"][3] > imgui.get_io().display_size.y - 3
    resting = d.picture()
    d.ctx.mouse_move_to_pos((210, 210))
    assert lecture.shows_controls
    d.stay = True
    assert np.abs(d.picture().astype(int) - resting).max() > 30  # the foot and the menu's button
    assert _rects(d)["Raster"] == rects["Raster"]  # the image stays where it is
    d.change(marked=(1, 1))
    d.press(Key.escape)  # leaves the stage, and the mark: on its point, in another image size
    assert bars.show_menu_bar and d.window.has_tools and d.state.marked is not None
    d.press(Key.f9)
    assert is_bare()
    for key in (Key._1, Key._2, Key.enter):
        d.press(key)
    assert lecture.session.number == 11
    _rest(d)
    _leave(d)
    assert layout.current().name == before and bars.show_menu_bar
