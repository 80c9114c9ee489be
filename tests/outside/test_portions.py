"""A picture that is drawn in steps, one a frame while things move and it is slow."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from app.outside.portions import AT_ONCE, SLOW_S, STILL_S, Portions

FRAME_S = 1 / 60


class Screen:
    """Three steps a picture, of what moves; each takes a while of the clock."""

    def __init__(self, step_s: float) -> None:
        self.now_s, self.step_s = 100.0, step_s
        self.steps: list[int] = []  # in each frame
        self.shown: object = None
        self.portions = Portions(lambda: self.now_s)

    def drawing(self, what: object) -> Iterator[None]:
        if what == self.shown:
            return
        for step in range(3):
            self.now_s += self.step_s
            self.steps[-1] += 1
            if step == 2:
                self.shown = what
            yield

    def frame(self, what: int, fixed: object = "", at_once: bool = False) -> int:
        """Return the number of steps that it took."""
        self.now_s += FRAME_S
        self.steps.append(0)
        self.portions.go_on(fixed, what, lambda: self.drawing((fixed, what)), at_once)
        return self.steps[-1]

    def move(self, frames: int) -> list[int]:
        return [self.frame(number) for number in range(1, frames + 1)]


def test_what_is_quick_is_drawn_in_each_frame() -> None:
    screen = Screen(0.3 * SLOW_S)
    assert screen.move(20) == [3] * 20
    assert not screen.portions.behind


def test_a_slow_picture_takes_a_step_a_frame_once_it_moves() -> None:
    screen = Screen(0.4 * SLOW_S)
    steps = screen.move(40)
    assert steps[:AT_ONCE] == [3] * AT_ONCE
    assert max(steps[AT_ONCE:]) == 1
    assert screen.portions.behind
    assert screen.shown[1] > 30  # type: ignore[index]  # it follows


def test_at_rest_it_becomes_what_is_now_and_nothing_more_is_drawn() -> None:
    screen = Screen(0.4 * SLOW_S)
    screen.move(20)
    for _ in range(8):
        screen.frame(20)
    assert screen.shown == ("", 20)
    assert not screen.portions.behind
    assert [screen.frame(20) for _ in range(3)] == [0, 0, 0]


def test_a_single_change_after_a_rest_is_drawn_at_once() -> None:
    screen = Screen(0.4 * SLOW_S)
    screen.move(20)
    screen.now_s += 2 * STILL_S
    assert screen.frame(99) == 3
    assert screen.shown == ("", 99)


def test_what_is_in_hand_and_what_is_of_another_kind_is_never_divided() -> None:
    screen = Screen(0.4 * SLOW_S)
    screen.move(20)
    assert screen.frame(21, at_once=True) == 3
    assert screen.frame(22) == 1
    assert screen.frame(23, "of another size") == 3
    assert screen.shown == ("of another size", 23)


def test_after_a_failure_it_begins_again() -> None:
    screen = Screen(0.4 * SLOW_S)
    screen.move(20)

    def failing() -> Iterator[None]:
        raise MemoryError
        yield

    with pytest.raises(MemoryError):
        screen.portions.go_on("other", 21, failing)
    screen.portions.forget()
    assert not screen.portions.behind
    assert screen.frame(22) == 3
