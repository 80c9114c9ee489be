"""The guided lecture: its steps, keys and buttons, the exercises, the file that is edited."""

from __future__ import annotations

import threading
from dataclasses import replace
from unittest.mock import patch

import numpy as np
import pytest
from imgui_bundle import hello_imgui, imgui
from objects_window import handle_px
from outside_window import place
from window_driver import SIZE, Driver, Key, changed

from app.host import layout
from app.lecture import view
from app.lecture.hiding import HideExercise
from app.lecture.model import Lecture
from app.lecture.reading import BUILTIN, load_lecture
from app.lecture.session import LectureReread, LectureSession
from app.lecture.step_options import state_of
from app.lecture.view import LECTURE, LectureView
from app.objects.choosing import chosen
from app.outside import scrubber
from app.outside.growing import GROWS
from app.outside.options import OutsideOptions
from app.outside.view import OUTSIDE, OutsideView
from app.storage.kept_lecture import Judgement
from app.widgets import formula
from renderer.camera import Camera
from renderer.scene_editing.moving import bounds_of

SMALL = """\
title = "Small"
[[steps]]
title = "First"
text = "One **ball** at $z = -3$."
scene = "spheres"
[[steps]]
title = "Second"
views = ["ray", "camera"]
scene = "canonical"
options.images.exposure_ev = 1.0
"""


def _lecture(d: Driver) -> LectureView:
    return d.window.lecture


def _give(d: Driver, text: str = SMALL) -> Lecture:
    path = d.folder / "small.toml"
    path.write_text(text)
    lecture = load_lecture(path)
    _lecture(d).give(lecture, path)
    d.settle()
    return lecture


def _shown(d: Driver) -> set[str]:
    return {view.name for view in d.window.shell.stage.shown}


def _number(d: Driver) -> int:
    session = _lecture(d).session
    assert session is not None
    return session.number


def _item(d: Driver, name: str) -> str:
    """An item of the step's text, which scrolls in a window of its own."""
    return f"//{LECTURE}/**/{name}"


def _answer(d: Driver, field: str, text: str) -> None:
    d.ctx.item_input_value(_item(d, f"##{field}"), text)
    d.ctx.yield_(2)


def drive_a_key_right_after_the_beginning_is_not_lost(d: Driver) -> None:
    d.ctx.menu_click('//##MainMenuBar/Lecture/Begin "Images, rays and cameras"')
    d.ctx.key_press(int(Key.page_down))
    d.settle()
    session = _lecture(d).session
    assert session is not None
    assert (session.number, session.uncovered) == (0, 1)
    assert d.window.state.preferences.presentation
    _lecture(d).leave(d.window)
    d.settle()


def drive_keys_and_buttons_walk_the_steps(d: Driver) -> None:
    first, second = _give(d).steps
    assert layout.current().name == layout.LECTURE
    assert d.window.state == state_of(first, d.window.state)
    assert _shown(d) == {LECTURE, "Raster"}
    before = d.picture()
    d.ctx.key_press(int(Key.page_down))
    d.settle()
    assert (_number(d), d.window.state.scene) == (1, second.scene)
    assert d.window.state.images.exposure_ev == 1.0
    assert _shown(d) == {LECTURE, "Ray", "Camera"}
    assert changed(before, d.picture()) > 0.3
    d.ctx.key_press(int(Key.page_down))  # there is no third
    assert _number(d) == 1
    d.ctx.key_press(int(Key.page_up))
    d.settle()
    assert (_number(d), d.window.state.scene) == (0, first.scene)
    assert d.window.state.images.exposure_ev == 0.0
    d.ctx.item_click(f"//{LECTURE}/>##next")
    d.settle()
    assert _number(d) == 1
    d.ctx.window_focus(f"//{LECTURE}")
    d.ctx.key_press(int(Key.left_arrow))
    d.settle()
    assert _number(d) == 0
    d.ctx.item_click(f"//{LECTURE}/1 ~1 2##outline".replace(" ~1 ", " \\/ "))
    d.ctx.item_click("//$FOCUSED/2  Second")
    d.settle()
    assert _number(d) == 1


def drive_a_step_is_uncovered_by_keys_and_buttons(d: Driver) -> None:
    text = "text = '''\n- one\n- [two](#bright)\n\n> Why?\n'''"
    more = "reveal = true\nanswer = 'So.'\nlinks.bright.images.exposure_ev = 2"
    covered = SMALL.replace('text = "One **ball** at $z = -3$."', f"{text}\n{more}")
    _give(d, covered)
    session = _lecture(d).session
    assert session is not None
    pictures = [d.picture()]
    for stage in (1, 2, 3):
        d.ctx.key_press(int(Key.page_down))
        d.ctx.yield_(3)
        pictures.append(d.picture())
        assert (session.number, session.uncovered) == (0, stage)
        assert changed(*pictures[-2:]) > 0
    d.ctx.key_press(int(Key.page_up))
    d.ctx.item_click(f"//{LECTURE}/<##back")
    assert session.uncovered == 1
    d.ctx.mouse_teleport_to_pos((3, 3))
    d.ctx.yield_(3)
    assert changed(pictures[1], d.picture()) < 0.01
    d.ctx.item_click(f"//{LECTURE}/###all")
    assert session.uncovered == 3
    d.ctx.yield_(2)
    for exposure_ev in (2.0, 0.0):
        d.ctx.item_click(_item(d, "two##2"))
        d.settle()
        assert d.window.state.images.exposure_ev == exposure_ev
    d.ctx.item_click(f"//{LECTURE}/>##next")
    d.settle()
    assert session.number == 1
    d.ctx.key_press(int(Key.page_up))
    d.settle()
    assert (session.number, session.uncovered) == (0, 3)


def drive_one_key_comes_back_to_the_step(d: Driver) -> None:
    first, _ = _give(d).steps
    lecture = d.window.state
    d.window.change(d.window.state.with_options(shadows=True, images={"exposure_ev": 3.0}))
    d.window.change(d.window.state.with_scene(d.start.scene))
    d.settle()
    d.ctx.key_press(int(Key.backspace))
    d.settle()
    assert d.window.state == lecture == state_of(first, lecture)
    d.ctx.key_press(int(Key.mod_ctrl) | int(Key.z))  # and that is one step of undo
    assert d.window.state.scene is d.start.scene


def drive_undo_walks_back_over_steps(d: Driver) -> None:
    first, second = _give(d).steps
    moved = d.window.state.with_options(images={"exposure_ev": 3.0})
    d.window.change(moved)
    d.settle()
    d.ctx.key_press(int(Key.page_down))
    d.settle()
    entered = d.window.state
    d.window.change(entered.with_options(shadows=True))
    ctrl = int(Key.mod_ctrl)
    d.ctx.key_press(ctrl | int(Key.z))  # what was changed in this step
    d.settle()
    assert (_number(d), d.window.state) == (1, entered)
    d.ctx.key_press(ctrl | int(Key.z))  # the way to it: text, views and state come back together
    d.settle()
    assert (_number(d), d.window.state) == (0, moved)
    assert _shown(d) == {LECTURE, "Raster"}
    d.ctx.key_press(ctrl | int(Key.z))
    d.settle()
    assert (_number(d), d.window.state) == (0, state_of(first, moved))
    for _ in range(2):
        d.ctx.key_press(ctrl | int(Key.y))
        d.settle()
    assert (_number(d), d.window.state) == (1, entered)
    assert d.window.state == state_of(second, entered)
    assert _shown(d) == {LECTURE, "Ray", "Camera"}
    # Before the lecture there is no step: the text stays where it is.
    while d.window.can_undo():
        d.window.undo()
        d.ctx.yield_(2)
    d.settle()
    assert (_number(d), d.window.state) == (0, d.start)


def drive_the_column_keeps_its_share_of_a_window_that_grows(d: Driver) -> None:
    _give(d, SMALL.replace('"ray", "camera"', '"raster", "ray"'))
    _lecture(d).advance(d.window, 1)
    d.settle()

    def shares() -> tuple[float, float]:
        """The column's part of the width, and the lower image's of the height of both."""
        rects = d.window.shell.stage.rects
        low, high = rects["Ray"], rects["Raster"]
        (left, _, right, _), width = rects[LECTURE], imgui.get_io().display_size.x
        height = low[3] - low[1]
        return (right - left) / width, height / (height + high[3] - high[1])

    before = shares()
    hello_imgui.change_window_size((1700, 1000))
    try:
        d.until(lambda: imgui.get_io().display_size.x == 1700)
        d.settle()
        assert np.allclose(shares(), before, atol=0.02)
    finally:
        hello_imgui.change_window_size(SIZE)
    d.until(lambda: imgui.get_io().display_size.x == SIZE[0])
    d.settle()
    assert np.allclose(shares(), before, atol=0.02)


def drive_in_a_narrow_column_no_button_is_cut_off(d: Driver) -> None:
    _give(d)
    boxes = []
    wide = (1600, 720)
    for size in (wide, SIZE, (640, 480)):
        hello_imgui.change_window_size(size)
        d.until(lambda size=size: imgui.get_io().display_size.x == size[0])
        d.settle()
        low_x, low_y, high_x, high_y = d.window.shell.stage.rects[LECTURE]
        boxes = [
            d.ctx.item_info(f"//{LECTURE}/{name}").rect_full for name in (">##next", "###restore")
        ]
        for box in boxes:
            assert low_x <= box.min.x < box.max.x <= high_x
            assert low_y <= box.min.y < box.max.y <= high_y
        in_a_row = boxes[0].max.x <= boxes[1].min.x
        assert in_a_row == (size == wide)
    hello_imgui.change_window_size(SIZE)
    d.until(lambda: imgui.get_io().display_size.x == SIZE[0])
    d.settle()


def drive_a_column_that_was_widened_stays_so(d: Driver) -> None:
    _give(d)

    def left() -> float:
        return d.window.shell.stage.rects[LECTURE][0]

    before, top = left(), d.window.shell.stage.rects[LECTURE][1]
    edge = (before - _lecture(d).padding.x - 1, top + 200)
    d.drag(edge, (edge[0] - 150, edge[1]))
    d.settle()
    widened = left()
    assert widened < before - 100
    for steps in (1, -1):
        _lecture(d).advance(d.window, steps)
        d.settle()
        d.until(lambda: abs(left() - widened) < 3)
    layout.reset()  # what the user asks for gives the layout's own
    d.ctx.yield_(6)
    d.settle()
    assert abs(left() - before) < 3


def drive_what_a_step_points_out_is_framed(d: Driver) -> None:
    pointing = SMALL.replace('views = ["ray"', 'highlight = ["eye", "ray"]\nviews = ["ray"')
    _give(d, pointing)
    d.ctx.key_press(int(Key.page_down))
    d.settle()
    assert d.window.state.options.highlight == ("eye", "ray")
    left, top, right, bottom = (round(x) for x in d.window.shell.stage.rects["Ray"])
    yellow = np.array([240, 228, 66])

    def is_framed() -> tuple[bool, bool]:
        d.ctx.mouse_teleport_to_pos((3, 3))
        d.ctx.yield_(2)
        marked = (np.abs(d.picture().astype(int) - yellow) < 12).all(axis=2)
        box = d.ctx.item_info("//Camera/##eye.x").rect_full
        beside = marked[round(box.min.y) : round(box.max.y), : round(box.min.x)]
        rows = marked[top + 20 : bottom - 20]
        edges = rows[:, left : left + 4].any(axis=1), rows[:, right - 4 : right].any(axis=1)
        return bool(beside.any(axis=1).mean() > 0.8), bool(min(e.mean() for e in edges) > 0.9)

    assert is_framed() == (True, True)
    d.ctx.key_press(int(Key.page_up))
    d.settle()
    d.ctx.key_press(int(Key.page_down))
    d.settle()
    d.window.change(d.window.state.with_options(highlight=()))
    d.settle()
    assert is_framed() == (False, False)


def drive_a_lecture_is_read_again_when_it_is_saved(d: Driver) -> None:
    _give(d)
    session = _lecture(d).session
    assert session is not None
    path = session.path
    d.ctx.key_press(int(Key.page_down))
    d.settle()
    path.write_text(SMALL.replace('"canonical"', '"columns"').replace("[[steps]]", "\n[[steps]]"))
    d.until(lambda: d.window.state.scene.name == "columns")
    assert (_number(d), session.error) == (1, "")
    # A mistake is told with its line; the last legal version goes on.
    path.write_text(SMALL.replace('"canonical"', '"canonicle"'))
    d.until(lambda: bool(session.error))
    assert "small.toml:9: steps[1].scene: 'canonicle' is unknown" in session.error
    d.settle()
    assert d.window.state.scene.name == "columns"
    if formula.available():  # a formula that cannot be set is told, and shown as it is
        path.write_text(SMALL.replace("$z =", r"$\\foo =").replace('"columns"', '"spheres"'))
        d.until(lambda: "is no command" in session.error)
        assert r"small.toml:4: steps[0].text: \foo is no command" in session.error
        assert d.window.state.scene.name == "canonical camera"
        d.picture()
    path.write_text(SMALL)
    d.until(lambda: not session.error)
    d.settle()
    assert d.window.state.scene.name == "canonical camera"


def drive_a_lecture_that_is_read_again_does_not_take_the_place_of_another(d: Driver) -> None:
    _give(d)
    first = _lecture(d).session
    assert first is not None
    begun, gate = threading.Event(), threading.Event()
    again = view.reread

    def slow(session: LectureSession) -> LectureReread:
        begun.set()
        assert gate.wait(60)
        return again(session)

    view.reread = slow
    try:
        first.path.write_text(SMALL.replace('"Small"', '"Newer"'))
        d.until(begun.is_set)
    finally:
        view.reread = again
    _lecture(d).give(load_lecture(BUILTIN), BUILTIN)
    d.ctx.yield_(3)
    gate.set()
    d.settle()
    second = _lecture(d).session
    assert second is not None and second.lecture.title != "Newer" and second.path == BUILTIN
    assert _number(d) == 0


def _looking(d: Driver) -> Camera | None:
    return d.window.state.of(OutsideOptions).camera


def drive_the_formula_plays_in_the_outside_view(d: Driver) -> None:
    lecture = load_lecture(BUILTIN)
    number = [step.title for step in lecture.steps].index("Any camera")
    _lecture(d).give(lecture, BUILTIN, number)
    d.settle()
    outside, seen = d.window.view(OutsideView), set[float]()

    def position() -> float:
        found = d.window.state.of(OutsideOptions).formula
        assert found is not None
        seen.add(found)
        return found

    assert position() == 6
    d.window.change(d.window.state.with_options(preferences={"reduced_motion": True}))
    with patch.object(scrubber, "STAGE_S", 0.1):
        d.ctx.key_press(int(Key.y))
        d.until(lambda: outside.scrubber.playing)
        d.until(lambda: position() == 6 and not outside.scrubber.playing)
    assert {round(one % 1, 6) for one in seen} <= {0.0, GROWS}  # it jumps
    d.settle()
    assert "ray" in {part.name for part in outside.primitives}
    low = d.ctx.item_info(f"//{LECTURE}/stages").rect_full
    middle = (low.min.y + low.max.y) / 2
    d.drag((low.min.x + 5, middle), ((low.min.x + low.max.x) / 2, middle))
    assert position() == pytest.approx(3, abs=0.05)
    d.settle()
    assert "ray" not in {part.name for part in outside.primitives}
    d.window.undo()
    assert position() == 6  # one drag is one step
    d.ctx.key_press(int(Key.y))
    d.until(lambda: outside.scrubber.playing)
    d.window.lecture.go(d.window, _number(d) + 1)
    d.settle()
    assert not outside.scrubber.playing


def drive_exercises_say_what_is_right_and_wrong(d: Driver) -> None:
    lecture = load_lecture(BUILTIN)
    titles = [step.title for step in lecture.steps]
    _lecture(d).give(lecture, BUILTIN, titles.index("Exercise: a pixel's ray"))
    d.settle()
    session = _lecture(d).session
    assert session is not None
    _answer(d, "origin", "$, **, `")  # signs of the text's own
    d.ctx.item_click(_item(d, "Check"))
    d.settle()  # fails if the view has failed
    assert session.answers.verdict is not None and session.answers.verdict.field == "origin"
    # Pixel (2, 5) of 8 x 8: u = 4.5/8 - 1/2, v = -(1.5/8 - 1/2).
    _answer(d, "origin", "0, 0, 0")
    _answer(d, "direction", "1/16, -5/16, -1")
    d.ctx.item_click(_item(d, "Check"))
    d.ctx.yield_(2)
    verdict = session.answers.verdict
    assert verdict is not None and not verdict.right and "minus sign" in verdict.text
    d.ctx.yield_(2)
    outside = d.window.view(OutsideView)
    assert any(item.name == "your d" for item in outside.extra)  # next to the correct one
    wrong = d.picture()
    d.window.change(d.window.state.with_options(outside={"answers": False}))
    d.ctx.yield_(2)
    assert not outside.extra
    d.window.undo()
    d.ctx.yield_(2)
    assert outside.extra
    given = _looking(d)
    _answer(d, "origin", "4, 3, 5")
    d.ctx.item_click(_item(d, "Check"))
    d.ctx.yield_(3)
    assert outside.extra and _looking(d) != given  # it was out of sight
    _answer(d, "origin", "0, 0, 0")
    _answer(d, "direction", "1/16, 5/16, -1")
    d.ctx.item_click(_item(d, "Check"))
    d.ctx.yield_(2)
    assert session.answers.verdict is not None and session.answers.verdict.right
    assert changed(wrong, d.picture()) > 0 and not outside.extra and _looking(d) == given
    d.window.lecture.go(d.window, titles.index("Exercise: which camera?"))
    d.settle()
    d.ctx.item_click(_item(d, "option 0"))
    d.ctx.yield_(2)
    assert session.answers.verdict is not None and not session.answers.verdict.right
    d.ctx.yield_(2)
    assert outside.extra
    d.window.lecture.advance(d.window, 1)
    d.settle()
    assert not outside.extra  # another step
    d.window.lecture.advance(d.window, -1)
    d.settle()
    assert outside.extra
    d.ctx.item_click(_item(d, "option 3"))
    d.ctx.yield_(2)
    assert session.answers.verdict is not None and session.answers.verdict.right
    # The answers are still there after a look elsewhere.
    d.window.lecture.advance(d.window, 1)
    d.settle()
    assert session.answers.verdict is None
    d.window.lecture.advance(d.window, -1)
    d.settle()
    assert session.answers.chosen == 3


def drive_a_lecture_is_opened_and_dropped(d: Driver) -> None:
    path, broken = d.folder / "mine.toml", d.folder / "broken.toml"
    path.write_text(SMALL.replace('"Small"', '"Mine"'))
    broken.write_text(SMALL.replace('"canonical"', '"canonicle"'))
    lecture, files = d.window.lecture, d.window.files
    lecture.session = None
    d.ctx.menu_click("//##MainMenuBar/Lecture/Open lecture...")
    assert files.dialog.is_open
    d.ctx.yield_(2)
    d.ctx.key_chars_replace_enter(str(path))
    d.until(lambda: lecture.session is not None)
    d.settle()
    assert lecture.session is not None and lecture.session.lecture.title == "Mine"
    assert d.window.state.scene.name == "spheres"
    assert _shown(d) == {LECTURE, "Raster"}
    d.until(lambda: [entry.name for entry in files.recent.entries][:1] == ["mine.toml"])
    # A broken one is told with its line, and nothing is lost.
    session, state = lecture.session, d.window.state
    d.drop([str(broken)])
    d.until(lambda: bool(files.message))
    assert "broken.toml:9: steps[1].scene: 'canonicle' is unknown" in files.message
    assert (lecture.session, d.window.state) == (session, state)
    d.ctx.key_press(int(Key.escape))
    assert files.message == ""
    path.write_text(SMALL.replace('"Small"', '"Dropped"'))
    lecture.session = None
    d.window.change(d.start)
    d.settle()
    d.drop([str(path)])
    d.until(lambda: lecture.session is not None)
    d.settle()
    assert lecture.session is not None and lecture.session.lecture.title == "Dropped"
    assert _shown(d) == {LECTURE, "Raster"}
    d.window.undo()  # what was there before is one step of undo away
    assert d.window.state == d.start


def drive_a_program_in_the_language_that_is_chosen(d: Driver) -> None:
    text = "```python\\nx = 1\\n```\\n```c\\nint x = 1;\\n```\\n\\nA **number**."
    _give(d, SMALL.replace("One **ball** at $z = -3$.", text))
    d.ctx.mouse_teleport_to_pos((3, SIZE[1] - 3))
    d.ctx.yield_(2)
    before = d.picture()
    d.ctx.item_click(_item(d, "C##language"))
    d.settle()
    d.ctx.mouse_teleport_to_pos((3, SIZE[1] - 3))
    d.ctx.yield_(2)
    assert d.window.state.options.language == "c"
    assert changed(before, d.picture()) > 0.0005
    d.ctx.key_press(int(Key.page_down))
    d.settle()
    assert d.window.state.options.language == "c"  # the reader's own
    d.window.change(d.window.state.with_options(language="python"))


def drive_an_object_is_moved_until_it_hides_another(d: Driver) -> None:
    lecture = load_lecture(BUILTIN)
    number, step = next(
        (k, one) for k, one in enumerate(lecture.steps) if isinstance(one.exercise, HideExercise)
    )
    task = step.exercise
    assert isinstance(task, HideExercise)
    _lecture(d).give(lecture, BUILTIN, number)
    d.settle()
    begun = d.window.state
    assert chosen(begun) == (task.item,)

    def said() -> Judgement:
        watch = _lecture(d).hidden_watch
        assert watch is not None
        judged = watch.said[1]
        assert judged is not None
        return judged

    assert said().text == "100 % of the box can still be seen."
    low, high = bounds_of(begun.scene, [task.item])
    middle = (low + high) / 2
    ball, across = place(d, middle), place(d, middle + np.array([0.3, 0.0, 0.0]))
    way = np.subtract(across, ball) / np.linalg.norm(np.subtract(across, ball))
    grip = np.array(ball) + 0.6 * handle_px(d, OUTSIDE) * way
    d.ctx.mouse_teleport_to_pos(tuple(grip))
    d.ctx.yield_(3)
    steps = len(d.window.history.past)
    d.drag(tuple(grip), tuple(grip + 40 * way))
    moved = d.window.state.scene
    assert moved is not begun.scene and len(d.window.history.past) == steps + 1
    d.settle()
    assert said().text.endswith("can still be seen."), said()
    d.ctx.item_click(_item(d, "###solution"))
    d.ctx.yield_(2)
    d.ctx.item_click(_item(d, "Put it there"))
    d.settle()
    assert said().right, said()
    d.window.undo()
    d.settle()
    assert d.window.state.scene is moved and not said().right
    d.window.change(replace(d.window.state, scene=task.solved(moved)))
    camera = d.window.state.camera
    d.window.change(
        d.window.state.with_camera(replace(camera, eye=tuple(np.add(camera.eye, (0, 0.1, 0)))))
    )
    d.settle()
    assert not said().right and said().text.startswith("The camera has moved.")
    d.ctx.key_press(int(Key.backspace))
    d.settle()
    assert d.window.state == begun
    assert said().text == "100 % of the box can still be seen."
    d.ctx.key_press(int(Key.page_down))  # and keeps nothing for the next
    d.settle()
    assert chosen(d.window.state) == ()
