"""The window on a desk: what only a real display, a window manager and a home that outlives a start
can show."""

import json
import sys
from dataclasses import dataclass

import numpy as np
import pytest
from desk import Program, check_same

from lucida.app.window.hints import SEEN

pytestmark = [
    pytest.mark.timeout(1500),
    pytest.mark.skipif(not sys.platform.startswith("linux"), reason="made for X11 on Linux"),
]
COLUMN = 1100, 430  # in the lecture's column, where nothing is
STATUS = -90  # rows: below is the status line, which has the time that an image took


def at_rest(desk):
    """The screen with no widget under the mouse or marked for the keyboard."""
    desk.click(*COLUMN)
    desk.rest()
    return desk.still()


def session(home):
    return json.loads((home / "CONFIG" / "lucida" / "session-1.json").read_bytes())


@dataclass(frozen=True)
class FirstDay:
    """The screen at the start and at the end of a day, black parts of screens, and the session."""

    begun: np.ndarray
    ended: np.ndarray
    black: list[float]
    black_presented: float
    session: dict


@pytest.fixture(scope="module")
def first_day(desk, tmp_path_factory):
    """A window in which the size of type is changed six times, and a pixel is typed."""
    home = tmp_path_factory.mktemp("first day")
    settings = home / "CONFIG" / "lucida"
    settings.mkdir(parents=True)
    (settings / SEEN).touch()  # the first start's hints
    style = "F9"
    with Program(desk, home) as program:
        presented = desk.burst(style)[-1]  # its bars around images are black
        black = desk.burst("ctrl+plus", style, "ctrl+plus", "ctrl+minus", "ctrl+0")
        ended = desk.still()
        desk.key("ctrl+g")
        desk.still()
        desk.xdotool("key", "--delay", 0, "3", "1", "Tab", "4", "1")  # faster than frames
        desk.still()
        desk.key("Return")
        desk.still()
        program.quit()
    return FirstDay(program.begun, ended, black, presented, session(home))


def test_six_changes_of_type_size_leave_every_pixel_as_it_was(first_day, tmp_path):
    black = first_day.black
    most = max(black[0], first_day.black_presented)
    assert max(black) < most + 0.2, f"a frame was black: {black}"
    check_same(first_day.begun, first_day.ended, tmp_path)


def test_what_is_typed_right_after_tab_is_in_the_next_field(first_day):
    assert first_day.session["options"]["marked"] == [30, 40]


def test_a_lecture_comes_back_and_fresh_is_as_on_the_first_day(desk, first_day, tmp_path):
    with Program(desk, tmp_path, "lecture", "--step", "2") as program:
        black = desk.burst("Prior", "Next", "Next", "Next")  # of which two move a camera
        assert max(black) < max(black[0], black[-1]) + 0.2, f"a frame was black: {black}"
        desk.click(300, 300)  # marks a pixel, which is a change of the step
        desk.key("ctrl+plus", "F9")  # in a lecture that is a change of style alone
        left = at_rest(desk)
        program.quit("starts in presentation mode")
    kept = session(tmp_path)
    assert (kept["lecture"]["number"], kept["lecture"]["in_step"]) == (1, True)
    assert {"Outside", "Raster"} <= {*kept["arrangement"]["visible"]}  # two views
    assert kept["arrangement"]["layout"] == "Lecture"
    assert "Lecture" in kept["arrangement"]["visible"]
    with Program(desk, tmp_path) as program:
        check_same(left[:STATUS], program.begun[:STATUS], tmp_path)
        program.quit()
    with Program(desk, tmp_path, "--fresh") as program:
        check_same(first_day.begun, program.begun, tmp_path)
        program.quit()
