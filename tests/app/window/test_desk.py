"""The window on a desk: what only a real display, a window manager and a home that outlives a start
can show."""

import json
import sys

import pytest
from desk import Program, check_same

from lucida.app.window.hints import SEEN

pytestmark = [
    pytest.mark.timeout(1500),
    pytest.mark.skipif(not sys.platform.startswith("linux"), reason="made for X11 on Linux"),
]
COLUMN = 1100, 560  # in the lecture's column, where nothing is
STATUS = -90  # rows: below is the status line, which has the time that an image took


def at_rest(desk):
    """The screen with no widget under the mouse or marked for the keyboard."""
    desk.click(*COLUMN)
    desk.rest()
    return desk.still()


def session(home):
    return json.loads((home / "CONFIG" / "lucida" / "session-1.json").read_bytes())


def test_ten_changes_of_type_size_leave_every_pixel_as_it_was(desk, tmp_path):
    sizes, style = ["ctrl+plus", "ctrl+plus", "ctrl+0"], "F9"
    changes = [*sizes, style, "ctrl+plus", style, "ctrl+minus", style, "ctrl+0", style]
    with Program(desk, tmp_path) as program:
        before = desk.still()
        presented = desk.burst(lambda: desk.key(style))[-1]  # its bars around images are black
        desk.burst(lambda: desk.key(style))
        black = desk.burst(lambda: desk.key(*changes))
        assert len(black) > 5
        assert max(black) < max(black[0], presented) + 0.2, f"a frame was black: {black}"
        check_same(before, desk.still(), tmp_path)
        program.quit()


def test_a_lecture_comes_back_and_fresh_is_as_on_the_first_day(desk, tmp_path):
    lectured, other = tmp_path / "one", tmp_path / "other"
    for home in (lectured, other):
        home.mkdir()
    with Program(desk, lectured, "lecture") as program:
        at_rest(desk)
        black = desk.burst(lambda: desk.key(*["Next"] * 6, "Prior", "Next"))
        assert max(black) < max(black[0], black[-1]) + 0.2, f"a frame was black: {black}"
        desk.click(300, 300)  # marks a pixel, which is a change of the step
        desk.key("ctrl+plus", "F9")  # in a lecture that is a change of style alone
        left = at_rest(desk)
        program.quit("starts in presentation mode")
    kept = session(lectured)
    assert (kept["lecture"]["number"] > 0, kept["lecture"]["in_step"]) == (True, True)
    assert kept["arrangement"]["layout"] == "Lecture"
    assert "Lecture" in kept["arrangement"]["visible"]
    with Program(desk, lectured) as program:
        check_same(left[:STATUS], desk.still()[:STATUS], tmp_path)
        program.quit()
    with Program(desk, lectured, "--fresh") as program:
        fresh = desk.still()
        program.quit()
    settings = other / "CONFIG" / "lucida"
    settings.mkdir(parents=True)
    (settings / SEEN).touch()  # the first start's hints are gone since the lecture was begun
    with Program(desk, other) as program:
        check_same(fresh, desk.still(), tmp_path)
        program.quit()


def test_what_is_typed_right_after_tab_is_in_the_next_field(desk, tmp_path):
    with Program(desk, tmp_path) as program:
        desk.key("ctrl+g")
        desk.still()
        desk.xdotool("key", "--delay", 0, "3", "1", "Tab", "4", "1")  # faster than frames
        desk.still()
        desk.key("Return")
        desk.still()
        program.quit()
    assert session(tmp_path)["options"]["marked"] == [30, 40]
