"""The guided lecture: its steps, keys and buttons, its column, the file that is edited."""

from dataclasses import replace

import numpy as np
from imgui_bundle import imgui
from lecture_window import SMALL, give, lecture_of, number_of, shown, untraced, untraced_drive
from option_changes import with_options
from window_driver import SIZE, Key, changed

from lucida.app.lecture.step_options import state_of
from lucida.app.lecture.view import LECTURE
from lucida.app.ui import formula, layout


@untraced_drive
def drive_a_key_right_after_the_beginning_is_not_lost(d):
    d.ctx.menu_click('//##MainMenuBar/Lecture/Begin "Images, rays and cameras"')
    d.press(Key.page_down)
    d.settle()
    session = lecture_of(d).session
    assert session.place[1:] == (0, 1)
    assert d.state.preferences.presentation
    lecture_of(d).leave(d.window)
    d.settle()


@untraced_drive
def drive_the_end_brings_back_what_was_shown_before(d):
    moved = replace(d.state.camera, eye=(1.0, 2.0, 7.0))
    before = d.state.with_camera(moved).with_fit(False)
    d.window.change(before)
    give(d)
    d.press(Key.page_down)
    d.settle()
    assert d.state.scene is not before.scene
    give(d)  # one lecture after another
    lecture_of(d).leave(d.window)
    d.settle()
    assert d.state.scene is before.scene
    assert d.state.view == before.view


def drive_keys_and_buttons_walk_the_steps(d):
    first, second = give(d).steps
    assert layout.current().name == layout.LECTURE
    assert d.state == state_of(first, d.state)
    assert shown(d) == {LECTURE, "Raster"}
    before = d.picture()
    d.press(Key.page_down)
    d.settle()
    assert (number_of(d), d.state.scene) == (1, second.scene)
    assert d.state.images.exposure_ev == 1.0
    assert shown(d) == {LECTURE, "Ray"}
    assert changed(before, d.picture()) > 0.3
    with untraced(d):
        d.press(Key.page_down)  # there is no third
        assert number_of(d) == 1
        d.press(Key.page_up)
        d.settle()
        assert (number_of(d), d.state.scene) == (0, first.scene)
        assert d.state.images.exposure_ev == 0.0
        d.click(f"//{LECTURE}/>##next")
        d.settle()
        assert number_of(d) == 1
        d.ctx.window_focus(f"//{LECTURE}")
        d.press(Key.left_arrow)
        d.settle()
        assert number_of(d) == 0
        d.click(f"//{LECTURE}/###outline")
        d.click("//$FOCUSED/2  Second")
        d.settle()
        assert number_of(d) == 1


BUILDS = """\
title = "Small"
[[steps]]
title = "First"
text = "- one"
scene = "spheres"
[[steps.builds]]
text = "- two"
options.images.exposure_ev = 4.0
camera.eye = [0.5, 1.0, 6.0]
move_s = 60.0
[[steps.builds]]
instead = "three"
move_s = 0.0
[[steps]]
title = "Second"
"""


@untraced_drive
def drive_builds_are_walked_and_move(d):
    give(d, BUILDS)
    lecture, session = lecture_of(d), lecture_of(d).session
    window, past = d.window, d.steps
    first, picture = window.state, d.picture()

    def press(key):
        d.press(key)
        return session.place[1:]

    assert press(Key.page_down) == (0, 1)
    assert 0 < window.state.images.exposure_ev < 4 == window.present.images.exposure_ev
    assert window.state.camera not in (first.camera, window.present.camera)
    assert not window.settled
    assert press(Key.page_down) == (0, 1)  # ends the movement, and no more
    assert window.state is window.present and d.steps == past + 1
    d.settle()
    assert changed(picture, d.picture()) > 0.01
    assert press(Key.r) == (0, 1) and window.state.images.exposure_ev < 4  # plays it again
    d.ctx.mouse_move_to_pos((200, 300))
    d.ctx.mouse_click(0)
    d.frames(2)
    assert window.state is window.present and window.state.images.exposure_ev == 4
    window.change(state_of(session.step, window.state))
    assert press(Key.page_down) == (0, 2)
    assert window.state is window.present
    assert press(Key.page_down) == (1, 0)
    d.settle()
    assert press(Key.page_up) == (0, 2)  # the step as it was left
    d.settle()
    assert press(Key.page_up) == (0, 1) and press(Key.page_up) == (0, 0)
    assert 0 < window.state.images.exposure_ev < 4  # the movement, backwards
    assert press(Key.page_up) == (0, 0)
    d.settle()
    assert window.state.camera == first.camera
    d.change(preferences={"reduced_motion": True})
    assert press(Key.page_down) == (0, 1) and window.state is window.present
    d.change(preferences={"reduced_motion": False})
    window.undo()
    d.settle()
    assert session.place[1:] == (0, 0)  # a build is one step of undo
    lecture.go(window, 0, 2)
    d.settle()
    assert session.place[1:] == (0, 2) and window.state.images.exposure_ev == 4


@untraced_drive
def drive_one_key_comes_back_to_the_step(d):
    first, _ = give(d).steps
    lecture = d.state
    d.change(shadows=True, images={"exposure_ev": 3.0})
    d.window.change(d.state.with_scene(d.start.scene))
    d.settle()
    d.press(Key.backspace)
    d.settle()
    assert d.state == lecture == state_of(first, lecture)
    d.press(Key.mod_ctrl | Key.z)  # and that is one step of undo
    assert d.state.scene is d.start.scene


@untraced_drive
def drive_undo_walks_back_over_steps(d):
    first, second = give(d).steps
    moved = with_options(d.state, mirrors=True)
    d.window.change(moved)
    d.settle()
    d.press(Key.page_down)
    d.settle()
    entered = d.state
    d.window.change(with_options(entered, shadows=True))
    d.press(Key.mod_ctrl | Key.z)  # what was changed in this step
    d.settle()
    assert (number_of(d), d.state) == (1, entered)
    d.undo()  # the way to it: text, views and state come back together
    d.settle()
    assert (number_of(d), d.state) == (0, moved)
    assert shown(d) == {LECTURE, "Raster"}
    d.undo()
    d.settle()
    assert (number_of(d), d.state) == (0, state_of(first, moved))
    for _ in range(2):
        d.window.redo()
        d.settle()
    assert (number_of(d), d.state) == (1, entered)
    assert d.state == state_of(second, entered)
    assert shown(d) == {LECTURE, "Ray"}
    # Before the lecture there is no step: the text stays where it is.
    while d.window.can_undo():
        d.undo()
        d.frames(2)
    d.settle()
    begun = with_options(d.start, preferences={"presentation": True})  # which undo leaves alone
    assert (number_of(d), d.state) == (0, begun)


def drive_the_column_keeps_its_share_of_a_window_that_grows(d):
    give(d, SMALL.replace('["ray"]', '["raster", "ray"]'))
    lecture_of(d).advance(d.window, 1)
    d.settle()

    def shares():
        """The column's part of the width, and the lower image's of the height of both."""
        rects = d.stage.rects
        low, high = rects["Ray"], rects["Raster"]
        (left, _, right, _), width = rects[LECTURE], imgui.get_io().display_size.x
        height = low[3] - low[1]
        return (right - left) / width, height / (height + high[3] - high[1])

    before = shares()
    for size in ((1700, 1000), SIZE):
        d.resize(size)
        assert np.allclose(shares(), before, atol=0.02)


@untraced_drive
def drive_a_lecture_is_read_again_when_it_is_saved(d):
    give(d)
    session = lecture_of(d).session
    path = session.path
    d.press(Key.page_down)
    d.settle()
    path.write_text(SMALL.replace('"canonical"', '"columns"').replace("[[steps]]", "\n[[steps]]"))
    d.until(lambda: d.state.scene.name == "columns")
    assert (number_of(d), session.error) == (1, "")
    # A mistake is told with its line; the last legal version goes on.
    path.write_text(SMALL.replace('"canonical"', '"canonicle"'))
    d.until(lambda: bool(session.error))
    assert "small.toml:9: steps[1].scene: 'canonicle' is unknown" in session.error
    d.settle()
    assert d.state.scene.name == "columns"
    if formula.available():  # a formula that cannot be set is told, and shown as it is
        path.write_text(SMALL.replace("$z =", r"$\\foo =").replace('"columns"', '"spheres"'))
        d.until(lambda: "is no command" in session.error)
        assert r"small.toml:4: steps[0].text: \foo is no command" in session.error
        assert d.state.scene.name == "canonical camera"
    path.write_text(SMALL)
    d.until(lambda: not session.error)
    d.settle()
    assert d.state.scene.name == "canonical camera"


@untraced_drive
def drive_a_lecture_is_opened_and_dropped(d):
    path, broken = d.folder / "mine.toml", d.folder / "broken.toml"
    path.write_text(SMALL.replace('"Small"', '"Mine"'))
    broken.write_text(SMALL.replace('"canonical"', '"canonicle"'))
    lecture, files = d.window.lecture, d.files
    lecture.session = None
    d.menu("Lecture/Open lecture...")
    assert files.dialog.is_open
    d.frames(2)
    d.ctx.key_chars_replace_enter(str(path))
    d.until(lambda: lecture.session is not None)
    d.settle()
    assert lecture.session.lecture.title == "Mine"
    assert d.state.scene.name == "spheres"
    assert shown(d) == {LECTURE, "Raster"}
    d.until(lambda: [entry.name for entry in files.recent.entries][:1] == ["mine.toml"])
    # A broken one is told with its line, and nothing is lost.
    session, state = lecture.session, d.state
    d.drop([str(broken)])
    d.until(lambda: bool(files.message))
    assert "broken.toml:9: steps[1].scene: 'canonicle' is unknown" in files.message
    assert (lecture.session, d.state) == (session, state)
    d.press(Key.escape)
    assert files.message == ""
    path.write_text(SMALL.replace('"Small"', '"Dropped"'))
    lecture.session = None
    d.window.change(d.start)
    d.settle()
    d.drop([str(path)])
    d.until(lambda: lecture.session is not None)
    d.settle()
    assert lecture.session.lecture.title == "Dropped"
    assert shown(d) == {LECTURE, "Raster"}
    d.undo()  # what was there before is one step of undo away
    assert d.state == with_options(d.start, preferences={"presentation": True})
