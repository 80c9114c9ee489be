"""The coarseness of images in motion, and the number of frames that draw one."""

from __future__ import annotations

from typing import Any

import pytest

from app.images.progressive_raster import STRIP_PIXELS, STRIP_S, Pace, ProgressiveRaster
from renderer.camera import Camera
from renderer.coarseness import FACTORS, STILL_S, Coarseness

PIXELS = 1280 * 720
FRAME_S = 1 / 60


def measured(pixel_s: float, budget_s: float = 0.006, once_s: float = 0.012) -> Coarseness:
    """One that has seen a full image."""
    coarseness = Coarseness(budget_s, once_s)
    coarseness.measured(1, PIXELS, pixel_s * PIXELS)
    return coarseness


def motion(coarseness: Coarseness, start_s: float, pixel_s: float, frames: int = 30) -> list[int]:
    """The factors of a motion, whose images take pixel_s each pixel."""
    factors = []
    for frame in range(frames):
        factors.append(coarseness.changed(PIXELS, start_s + frame * FRAME_S))
        pixels = PIXELS // factors[-1] ** 2
        coarseness.measured(factors[-1], pixels, pixel_s * pixels)
    return factors


def test_a_quick_device_draws_no_coarse_image():
    assert set(motion(measured(1e-9), 0.0, 1e-9)) == {1}


@pytest.mark.parametrize("pixel_s", [3e-9, 4e-8, 1e-7, 1e-6, 1e-4])
def test_no_image_is_finer_than_the_budget_allows(pixel_s):
    for factor in motion(measured(pixel_s), 0.0, pixel_s)[1:]:
        assert factor == FACTORS[-1] or pixel_s * PIXELS / factor**2 <= 0.006
        assert factor == 1 or pixel_s * PIXELS / (factor - 1) ** 2 > 0.006 or factor > 4


def test_what_stays_too_slow_becomes_coarser_and_not_finer_again_before_a_rest():
    coarseness = measured(4e-8)
    before = motion(coarseness, 0.0, 4e-8, 5)
    slow = motion(coarseness, 5 * FRAME_S, 2e-7, 25)
    assert slow == sorted(slow)
    assert slow[0] == before[-1] < slow[-1]
    quick = motion(coarseness, 30 * FRAME_S, 1e-9)
    assert set(quick) == {slow[-1]}
    coarseness.measured(1, PIXELS, 1e-9 * PIXELS)
    assert motion(coarseness, 30.0, 1e-9)[0] == 1


def test_nothing_measured_is_as_coarse_as_it_is_told():
    assert Coarseness(0.006, 0.012).changed(PIXELS, 0.0) == 1
    assert Coarseness(0.006, 0.012, unknown=8).changed(PIXELS, 0.0) == 8
    forgetful = measured(1e-9)
    forgetful.forget()
    assert forgetful.full_s(PIXELS) == 0.0
    assert forgetful.changed(PIXELS, 0.0) == 1


class Motion:
    """One whose images of 64 x 64 pixels begin at a factor, with a budget of half a second."""

    def __init__(self, full_s: float) -> None:
        self.coarseness = Coarseness(0.5, 0.5)
        self.coarseness.measured(1, 4096, full_s)
        self.now_s = 0.0
        self.factors = [self.coarseness.changed(4096, 0.0)]
        self.change()

    def change(self) -> None:
        self.now_s += 0.125
        self.factors.append(self.coarseness.changed(4096, self.now_s))

    def images(self, *times_s: float) -> int:
        """The factor after images that took so long."""
        for time_s in times_s:
            factor = self.factors[-1]
            self.coarseness.measured(factor, 4096 // factor**2, time_s)
            self.change()
        return self.factors[-1]


def test_five_images_in_a_row_that_take_twice_the_budget_make_the_next_coarser():
    motion = Motion(full_s=2.0)
    assert motion.factors == [2, 2], "exactly within the budget"
    assert motion.images(*[1.0] * 9) == 2, "twice the budget is not too slow yet"
    assert motion.images(*[1.1] * 4, 1.0, *[1.1] * 4) == 2
    assert motion.images(1.1) == 3
    assert motion.images(*[1.1] * 4) == 3
    assert motion.images(1.1) == 4


def test_eight_images_in_a_row_that_finer_would_be_within_the_budget_make_the_next_finer():
    motion = Motion(full_s=4.4)
    assert motion.factors == [3, 3]
    assert motion.images(*[0.23] * 9) == 3
    assert motion.images(*[0.22] * 8) == 2
    assert motion.images(*[0.125] * 7, 0.126, *[0.125] * 7) == 2
    assert motion.images(0.125) == 1
    assert motion.images(*[0.1] * 9) == 1
    motion = Motion(full_s=2.0)
    assert motion.images(*[0.125] * 7) == 2
    assert motion.images(0.125) == 1


def test_from_the_third_change_on_the_factor_stays_whatever_is_expected():
    assert Motion(full_s=2.0).images(0.9) == 2
    motion = Motion(full_s=2.0)
    motion.coarseness.measured(2, 1024, 0.9)
    motion.now_s += STILL_S
    motion.change()
    assert motion.factors[-1] == 3


def test_what_is_expected_follows_the_nearest_factor_that_was_measured():
    coarseness = Coarseness(0.625, 0.625)
    coarseness.measured(1, 4096, 10.0)
    coarseness.measured(8, 64, 0.5)
    assert coarseness.changed(4096, 0.0) == 8


def test_a_slower_image_counts_half_and_a_quicker_one_wholly():
    coarseness = Coarseness(0.5, 0.5)
    for time_s, expected_s in ((1.0, 1.0), (3.0, 2.0), (0.5, 0.5), (0.5, 0.5)):
        coarseness.measured(1, 1, time_s)
        assert coarseness.full_s(1) == expected_s
    coarseness.measured(1, 0, 0.5)  # an image without pixels


def test_a_full_image_waits_for_the_end_of_a_motion_but_not_after_one_change():
    coarseness = measured(4e-8)
    assert coarseness.rest_s == 0.0
    coarseness.changed(PIXELS, 10.0)
    assert coarseness.rest_s == 0.0
    coarseness.changed(PIXELS, 10.0 + FRAME_S)
    assert FRAME_S < coarseness.rest_s < STILL_S
    coarseness.changed(PIXELS, 10.2)  # slow frames: still the same motion
    assert coarseness.rest_s == STILL_S
    coarseness = measured(4e-8)
    coarseness.changed(PIXELS, 10.0)
    coarseness.changed(PIXELS, 10.0 + STILL_S)  # another one
    assert coarseness.rest_s == 0.0


class Canvas:
    """A Rasterizer that notes what it is asked to draw."""

    def __init__(self, triangles: int) -> None:
        self.triangles = triangles
        self.parts: list[int] = []
        self.rows: list[tuple[int, int]] = []

    def faces(self, *_: object) -> int:
        return 1

    def pieces(self, *_: object) -> int:
        return self.triangles

    def draw(self, _camera: object, size: tuple[int, int], *_: object) -> str:
        self.parts.append(self.triangles)
        self.rows.append((0, size[1]))
        return "drawn"

    def see(
        self, _camera: object, _size: object, _place: str, first: int, count: int, *_: object
    ) -> bool:
        assert first == sum(self.parts)
        self.parts.append(count)
        return first + count >= self.triangles

    def shade(
        self, _camera: object, _size: object, _place: str, rows: tuple[int, int], *_: object
    ) -> str:
        assert sum(self.parts) == self.triangles
        self.rows.append(rows)
        return "drawn"


def drawn(
    triangles: int, triangle_s: float, at_once: bool = False, expected_s: float = 0.0
) -> tuple[list[int], list[tuple[int, int]], int]:
    """The triangles of each part, the rows of each, and how many frames it took."""
    canvas, frames = Canvas(triangles), 1
    drawing = begun(canvas, triangle_s, "elsewhere", at_once, expected_s)
    while drawing.go_on() is None:
        assert frames < 10_000
        frames += 1
    assert drawing.size == (1280, 720)
    return canvas.parts, canvas.rows, frames


def begun(
    canvas: Canvas, triangle_s: float, shown: str, at_once: bool = False, expected_s: float = 0.0
) -> ProgressiveRaster:
    pace = Pace()
    pace.measured(canvas.triangles, triangle_s * canvas.triangles)
    pace.measured = lambda *_: None  # type: ignore[method-assign]
    size, places = (2560, 1440), ("one", "two")
    rasterizer: Any = canvas
    return ProgressiveRaster(
        rasterizer, Camera(), size, 2, places, shown, pace, expected_s, at_once
    )


def test_a_device_that_is_quick_draws_all_triangles_at_once():
    once = [1_000_000], [(0, 720)], 1
    assert drawn(1_000_000, 1e-9) == once
    assert drawn(1_000_000, 1e-9, expected_s=STRIP_S) == once
    assert drawn(0, 0.0) == ([0], [(0, 720)], 1)
    assert drawn(1_000_000, 1e-4, at_once=True, expected_s=9.0) == once


def test_triangles_that_take_longer_than_a_frame_are_drawn_in_several():
    parts, rows, frames = drawn(1_000_000, 1e-7)  # 0.1 s
    assert rows == [(0, 720)] and frames == len(parts) + 1  # shaded in a frame of its own
    assert sum(parts) == 1_000_000
    assert len(parts) > 2 and min(parts) > 0


def test_pixels_that_take_longer_than_a_frame_are_shaded_in_strips():
    parts, rows, frames = drawn(1000, 1e-9, expected_s=4.5 * STRIP_S)
    assert parts == [1000]
    assert [last - first for first, last in rows] == [160] * 4 + [80]
    assert [first for first, _ in rows] == [0, 160, 320, 480, 640]
    assert frames == 1 + len(rows)
    first, last = drawn(1, 1e-9, expected_s=1e9)[1][0]  # not a row a frame
    assert (last - first) * 1280 == pytest.approx(STRIP_PIXELS, rel=0.03)


@pytest.mark.parametrize("slow", [{"triangle_s": 1e-6}, {"triangle_s": 0, "expected_s": 1.0}])
def test_an_image_in_parts_leaves_alone_what_is_shown(slow):
    canvas = Canvas(100_000)
    assert begun(canvas, shown="one", **slow).place == "two"
    assert begun(canvas, shown="two", **slow).place == "one"
    assert begun(canvas, shown="one", at_once=True, **slow).place == "one"
    assert begun(canvas, 0.0, "one").place == "one"  # one part: a GPU needs no second place


def test_images_of_another_size_are_another_motion():
    coarseness = Coarseness(0.006, 0.012)
    coarseness.measured(1, 1000, 1e-5)
    assert [coarseness.changed(1000, 0.01 * step) for step in range(4)] == [1] * 4
    assert coarseness.changed(1000 * PIXELS, 0.05) == FACTORS[-1]
