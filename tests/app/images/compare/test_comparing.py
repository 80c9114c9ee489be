"""The compare view's words, and steps from pixel to pixel."""

from dataclasses import replace

import pytest
from flawed_images import changed, image
from option_changes import with_options

from lucida import Camera, load_scene
from lucida.app.images.compare import comparing
from lucida.app.state.app_state import AppState
from lucida.renderer.compare.raster_and_ray import CAUSES, SHADING, UNEXPLAINED, compare_frames
from lucida.renderer.scene.flat import flatten
from lucida.renderer.scene.model import Scene

SIZE = (8, 6)


def compared(effects=False, **values):
    """Compare a flat image with one that has other values in some pixels."""
    flat = other = image(2, 0, -1, SIZE)
    for name, (where, value) in values.items():
        other = changed(other, where, **{name: value})
    return compare_frames(flatten(Scene(())), Camera(), SIZE, flat, other, effects)


@pytest.fixture(scope="module")
def state():
    return AppState.for_scene(load_scene("spheres"))


def test_the_headline_says_what_matters():
    assert comparing.headline(compared()) == ("All pixels agree", True)
    one = compared(color=((3, 4), 0.9))
    assert comparing.headline(one) == ("1 pixel differs without an explanation", False)
    assert comparing.headline(one, "shadows") == (
        "Not comparable with shadows: 1 of 48 differ",
        False,
    )
    explained = replace(
        one, unexplained=0, shading=0, explained=dict.fromkeys(CAUSES, 0) | {"edge": 1}
    )
    assert comparing.headline(explained) == ("All but 1 edge pixel agree", True)


def test_pixels_are_counted_by_cause():
    comparison = compared(color=((3, slice(0, 3)), 0.9), id=((0, 0), 4))
    counts = comparing.counts(comparison)
    assert set(counts) == {cause.label for cause in comparing.LABELS}
    assert counts[SHADING] == 3
    assert counts[UNEXPLAINED] == 1
    assert sum(counts.values()) == comparison.pixels - comparison.agree


def test_with_effects_the_colour_alone_is_not_examined():
    comparison = compared(effects=True, color=((3, 4), 0.9), depth=((1, 1), 5))
    assert comparing.counts(comparison)[SHADING] == 1
    assert comparing.counts(comparison)[UNEXPLAINED] == 1


def test_the_next_pixel_is_the_next_one_in_the_order_of_reading():
    comparison = compared(color=(([1, 1, 4], [2, 6, 0]), 0.9), id=((2, 3), 4))
    found, pixel = [], None
    for _ in range(5):
        pixel = comparing.next_differing(comparison, pixel)
        found.append(pixel)
    assert found == [(1, 2), (1, 6), (2, 3), (4, 0), (1, 2)]
    back = []
    for _ in range(4):
        pixel = comparing.next_differing(comparison, pixel, forward=False)
        back.append(pixel)
    assert back == [(4, 0), (2, 3), (1, 6), (1, 2)]
    assert comparing.next_differing(comparison, None, forward=False) == (4, 0)
    assert comparing.next_differing(comparison, (1, 4)) == (1, 6)
    assert comparing.next_differing(comparison, (1, 2), label=UNEXPLAINED) == (2, 3)
    assert comparing.next_differing(comparison, (2, 3), label=UNEXPLAINED) == (2, 3)
    assert comparing.next_differing(comparison, None, label=1) is None
    assert comparing.next_differing(compared(), None) is None


def test_a_step_marks_and_magnifies(state):
    comparison = compared(color=((3, 4), 0.9))
    after = comparing.stepped(state, comparison)
    assert after.marked == (3, 4)
    assert after.images.magnification == comparing.MARKED_MAGNIFICATION
    assert after.images.center == (4.5 / 8, 3.5 / 6)
    closer = with_options(state, images={"magnification": 64.0})
    assert comparing.stepped(closer, comparison).images.magnification == 64.0
    assert comparing.stepped(state, compared()) is state


def test_shadows_and_mirrors_are_named(state):
    both = with_options(state, shadows=True, mirrors=True)
    assert comparing.effects_of(both) == "shadows and mirrors"
