"""Displays in time: what shines when; the mean over a cycle is the pixel's linear colour."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from app.laboratory import displays
from app.laboratory import displays_view as laboratory_displays
from app.laboratory.displays import DISPLAYS
from app.laboratory.options import LaboratoryOptions
from renderer.images import to_srgb8

MOMENTS = 3000


@pytest.fixture
def color() -> np.ndarray:
    """5 x 7 pixels, black and white among them."""
    part = np.random.default_rng(3).uniform(0, 1, (5, 7, 3)).astype(np.float32)
    part[0, 0], part[4, 6], part[2, 3] = 0, 1, (1, 0, 0.5)
    return part


def cycle(name: str, color: np.ndarray, moments: int = MOMENTS) -> np.ndarray:
    phases = (np.arange(moments) + 0.5) / moments
    return np.array([DISPLAYS[name].light(color, float(phase)) for phase in phases])


@pytest.mark.parametrize("side", [12, 45])
@pytest.mark.parametrize("name", DISPLAYS)
def test_the_mean_over_a_cycle_and_a_pixel_is_its_linear_color(name, side, color):
    display = DISPLAYS[name]
    mean = cycle(name, color).mean(axis=0)  # (5, 7, 3)
    sent = mean[:, :, None, None, :] * display.elements(side) * display.gain(side)
    seen = sent.mean(axis=(2, 3))
    # As finely as a share of the time is known from so many moments.
    np.testing.assert_allclose(seen, color, atol=4 / MOMENTS / display.time_share)


@pytest.mark.parametrize("name", DISPLAYS)
def test_no_element_is_ever_more_than_fully_on(name, color):
    light = cycle(name, color, 300)
    assert light.min() >= 0 and light.max() <= 1
    assert not light[:, 0, 0].any()  # black stays dark
    covered = DISPLAYS[name].elements(40)
    assert covered.min() == 0 and covered.max() == 1
    assert (DISPLAYS[name].gain(40) > 1).all()


def test_each_makes_gray_in_its_own_way(color):
    light = {name: cycle(name, color, 300) for name in DISPLAYS}
    assert set(np.unique(light["led"])) == {0, 1}  # on, or off
    assert set(np.unique(light["dlp"])) == {0, 1}
    assert (light["dlp"].max(axis=(1, 2)) > 0).sum(axis=1).max() == 1  # one colour at a time
    np.testing.assert_array_equal(light["lcd"], np.broadcast_to(color, light["lcd"].shape))
    first = DISPLAYS["dlp"].light(color, 0.1)
    np.testing.assert_array_equal(first[..., 0], color[..., 0] > 0.3)


def test_a_tube_is_scanned_line_by_line_and_fades():
    white, tube = np.ones((4, 6, 3), np.float32), DISPLAYS["tube"]
    for number in range(24):
        phase = number / 24
        light = tube.light(white, phase)[..., 0]
        row, column, *extent = displays.at_work("tube", phase, 4, 6)
        assert (row, column, extent) == (number // 6, number % 6, [1, 1])
        assert light[row, column] == pytest.approx(1) and (light > 0.999).sum() == 1
        # The one before is dimmer, the one that comes next is the dimmest.
        order = np.roll(light.ravel(), -number)  # from the present one on, in the beam's order
        assert (np.diff(order[1:]) > 0).all()
    later = tube.light(white, 0.25)[0, 0] / tube.light(white, 0.15)[0, 0]
    np.testing.assert_allclose(later, np.exp(-0.1 / displays.FADING), rtol=1e-5)


def test_the_row_of_an_lcd_that_is_set():
    rows = [displays.at_work("lcd", k / 5, 5, 7) for k in range(5)]
    assert rows == [(k, 0, 1, 7) for k in range(5)]
    assert displays.at_work("dlp", 0.3, 5, 7) is None


@pytest.mark.parametrize("name", DISPLAYS)
def test_steps_by_hand_walk_the_cycle_and_back(name):
    count, phase, seen = displays.steps(name, 5, 7), 0.0, []
    for _ in range(count):
        seen.append(phase)
        phase = displays.stepped(name, phase, 5, 7)
    assert phase == 0.0 and len(set(seen)) == count
    for expected in reversed(seen):
        phase = displays.stepped(name, phase, 5, 7, -1)
        assert phase == pytest.approx(expected)
    between = 2.5 / count  # stopped while it played
    assert displays.stepped(name, between, 5, 7) == pytest.approx(3 / count)
    assert displays.stepped(name, between, 5, 7, -1) == pytest.approx(2 / count)


@pytest.mark.parametrize("name", DISPLAYS)
def test_the_picture_shows_the_light_where_the_elements_are(name, color):
    display, side, phase = DISPLAYS[name], 40, 0.4
    picture = displays.instant(display, color, phase, side)
    assert picture.shape == (5 * side, 7 * side, 3)
    light = to_srgb8(display.light(color, phase))
    for channel, (x, y, *_) in enumerate(display.places):
        at = picture[int(y * side) :: side, int(x * side) :: side]
        np.testing.assert_array_equal(
            at[..., channel], np.maximum(light[..., channel], display.unlit)
        )
    assert picture[0, 0].max() < display.unlit  # between elements nothing shines


def test_what_a_display_can_show():
    wild = np.array([[[np.nan, -1, 0.25], [np.inf, 3, 0.5]]], np.float32)
    assert displays.shown(wild, 1.0).tolist() == [[[0, 0, 0.5], [1, 1, 1]]]


class Still:
    """A host that counts the frames it is asked for."""

    def __init__(self, moves: bool = True) -> None:
        self.moves, self.asked = moves, 0

    def animate(self) -> None:
        self.asked += 1


def test_the_clock_of_a_cycle(monkeypatch):
    now_s = [100.0]
    monkeypatch.setattr(laboratory_displays.time, "monotonic", lambda: now_s[0])
    page, host = laboratory_displays.DisplaysPage(), Still()
    options = LaboratoryOptions(page="displays", phase=0.9, cycle_s=2.0)

    def phase(passed_s: float, **changes: object) -> float:
        now_s[0] += passed_s
        return page.now(host, replace(options, **changes)).phase  # type: ignore[arg-type]

    assert phase(1.0) == phase(1.0) == 0.9 and not host.asked
    assert phase(1.0, playing=True) == 0.9 and host.asked == 1  # it begins
    assert phase(0.1, playing=True) == pytest.approx(0.95)
    assert phase(0.2, playing=True) == pytest.approx(0.05)  # the next cycle
    assert phase(60.0, playing=True) == pytest.approx(0.175)  # a frame that took long
    page.unseen()
    assert phase(60.0, playing=True) == pytest.approx(0.175)
    asked = host.asked
    assert phase(0.1) == 0.9 and host.asked == asked
    assert phase(0.1, phase=0.3) == 0.3  # somebody has set it
    assert phase(0.1, phase=1.0) == 0.0  # the end of a cycle is its beginning
    host.moves = False  # a picture of the window
    asked = host.asked
    still = phase(0.1, playing=True, phase=0.5)
    assert still == phase(0.1, playing=True, phase=0.5) == 0.5 and host.asked == asked
