"""The coarseness of images in motion."""

import pytest

from lucida.renderer.images.coarseness import (
    FACTORS,
    MOST_HITS,
    MOST_MISSES,
    STILL_S,
    Coarseness,
    reduced,
)

PIXELS, BUDGET_S, FRAME_S = 1280 * 720, 0.006, 1 / 60


def measured(pixel_s):
    """One that has seen a full image."""
    coarseness = Coarseness(BUDGET_S)
    coarseness.measured(1, PIXELS, pixel_s * PIXELS)
    return coarseness


def motion(coarseness, start_s, pixel_s, frames=30):
    """Return the factors of a motion whose images take pixel_s for each pixel."""
    factors = []
    for frame in range(frames):
        factors.append(coarseness.changed(PIXELS, start_s + frame * FRAME_S))
        pixels = PIXELS // factors[-1] ** 2
        coarseness.measured(factors[-1], pixels, pixel_s * pixels)
    return factors


@pytest.mark.parametrize("pixel_s", [1e-9, 3e-9, 4e-8, 1e-7, 1e-6, 1e-4])
def test_a_motion_is_as_fine_as_the_budget_allows(pixel_s):
    for factor in motion(measured(pixel_s), 0.0, pixel_s):
        assert factor == FACTORS[-1] or pixel_s * PIXELS / factor**2 <= BUDGET_S
        assert factor == 1 or pixel_s * PIXELS / (factor // 2) ** 2 > BUDGET_S


def test_what_stays_too_slow_becomes_coarser_and_not_finer_again_before_a_rest():
    coarseness = measured(4e-8)
    before = motion(coarseness, 0.0, 4e-8, 5)
    slow = motion(coarseness, 5 * FRAME_S, 4e-7, 25)
    assert slow == sorted(slow)
    assert slow[0] == before[-1] < slow[-1]
    assert set(motion(coarseness, 30 * FRAME_S, 1e-9)) == {slow[-1]}
    coarseness.measured(1, PIXELS, 1e-9 * PIXELS)
    coarseness.measured(1, PIXELS, 1e-9 * PIXELS)
    assert motion(coarseness, 30.0, 1e-9)[-1] < slow[-1]


def test_what_proves_quick_enough_becomes_finer():
    factors = motion(measured(1e-7), 0.0, 1e-9)
    assert factors[0] == 4 and factors[-1] == 1
    assert factors == sorted(factors, reverse=True)


def test_one_slow_image_changes_nothing():
    coarseness = measured(4e-8)
    factors = motion(coarseness, 0.0, 4e-8, 5)
    coarseness.measured(factors[-1], PIXELS // factors[-1] ** 2, 1.0)
    assert set(motion(coarseness, 5 * FRAME_S, 4e-8, 20)) == {factors[-1]}


def test_a_longer_time_counts_half_and_a_shorter_one_whole():
    coarseness = Coarseness(BUDGET_S)
    for share in (0.5, 1.4):  # of the budget: 0.95 after both
        coarseness.measured(1, PIXELS, share * BUDGET_S)
    assert coarseness.changed(PIXELS, 0.0) == 1
    coarseness.measured(1, PIXELS, 1.4 * BUDGET_S)  # 1.175
    assert coarseness.changed(PIXELS, STILL_S) == 2
    coarseness.measured(1, PIXELS, 0.9 * BUDGET_S)
    assert coarseness.changed(PIXELS, 2 * STILL_S) == 1


def test_the_first_image_of_a_motion_is_one_miss():
    coarseness = Coarseness(BUDGET_S)
    coarseness.changed(PIXELS, 0.0)
    for frame in range(1, MOST_MISSES + 1):
        coarseness.measured(1, PIXELS, 100 * BUDGET_S)
        assert coarseness.changed(PIXELS, frame * FRAME_S) == (2 if frame == MOST_MISSES else 1)


def test_nothing_measured_is_as_coarse_as_it_is_told():
    assert Coarseness(BUDGET_S).changed(PIXELS, 0.0) == 1
    forgetful = Coarseness(BUDGET_S, unknown=8)
    assert forgetful.changed(PIXELS, 0.0) == 8
    forgetful.measured(1, PIXELS, 1e-6)
    assert forgetful.changed(PIXELS, STILL_S) == 1
    forgetful.forget()
    assert forgetful.changed(PIXELS, 3 * STILL_S) == 8


@pytest.mark.parametrize("size", [(1, 1), (7, 3), (1280, 720)])
def test_the_last_pixels_are_part_of_a_coarse_image(size):
    for factor in FACTORS:
        for full, coarse in zip(size, reduced(size, factor), strict=True):
            assert coarse >= 1 and (coarse - 1) * factor < full <= coarse * factor


@pytest.mark.parametrize(("share", "finer"), [(0.25, True), (0.26, False)])
def test_several_images_in_a_quarter_of_the_budget_make_it_finer_and_no_fewer(share, finer):
    coarseness = Coarseness(BUDGET_S, unknown=4)
    coarseness.changed(PIXELS, 0.0)
    for frame in range(1, MOST_HITS + 1):
        coarseness.measured(4, PIXELS // 16, share * BUDGET_S)
        wanted = 2 if finer and frame == MOST_HITS else 4
        assert coarseness.changed(PIXELS, frame * FRAME_S) == wanted
