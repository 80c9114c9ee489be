"""The mistakes' programs and pictures, without a window."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from option_changes import with_options

from lucida.app.checking.mistakes.rays import RayTask, ray_program
from lucida.app.images.changed_pixels import MARK, changed_pixels, difference_picture
from lucida.app.images.ray_pictures import RayPainter
from lucida.app.instruments.mistakes import model
from lucida.app.instruments.mistakes.model import Situation
from lucida.app.state.app_state import AppState
from lucida.renderer.camera.pixels import Indexing
from lucida.renderer.files import load_scene
from lucida.renderer.images import to_srgb8
from lucida.renderer.trace import Tracer

SIZE = (80, 60)
STATE = AppState.for_scene(load_scene("still-life"))
PARALLEL = STATE.with_camera(
    replace(STATE.camera, projection="parallel", viewport=(-2.0, 2.0, -1.5, 1.5))
)
PROGRAMS = [
    ray_program(RayTask(projection, indexing))
    for projection in ("perspective", "parallel")
    for indexing in Indexing
]


@pytest.fixture(scope="module")
def painter():
    with Tracer(STATE.scene) as tracer:
        yield RayPainter(STATE.scene, tracer, lambda: True)


def situation(state: AppState = STATE, columns: int = 64) -> Situation:
    return model.situation_of(with_options(state, mistakes={"columns": columns}), SIZE)


@pytest.mark.parametrize("state", [STATE, PARALLEL])
def test_the_correct_program_draws_the_ray_image(painter, state) -> None:
    now = situation(state)
    both = model.compared(painter, now, ())
    image = painter.tracer.render(now.camera, now.size, ("color",)).channel("color")
    pictures = [to_srgb8(light, 0.0) for light in (both.right, image)]
    assert changed_pixels(*pictures).mean() < 0.01
    assert both.wrong is both.right and both.ray is None


def test_a_mistake_changes_the_picture_and_its_pixels_are_marked(painter) -> None:
    now = situation()
    mistakes = model.named(now.program, ("rows count upwards",))
    both = model.compared(painter, now, mistakes)
    right, wrong = (to_srgb8(light, 0.0) for light in (both.right, both.wrong))
    assert changed_pixels(right, wrong[::-1]).mean() < 0.02  # upside down
    changed = changed_pixels(right, wrong)
    assert changed.mean() > 0.5
    picture = difference_picture(right, changed)
    assert (picture[changed] == MARK).all()
    gray = picture[~changed]
    assert (gray == gray[:, :1]).all() and (gray <= right[~changed].max(axis=1)[:, None]).all()
    assert model.told_difference(changed).endswith("% of the pixels")


def test_the_drawn_rays_are_those_of_the_mistakes(painter) -> None:
    now = situation(with_options(STATE, marked=(30, 40)))
    assert now.pixel is not None
    mistakes = model.named(now.program, ("no eye", "along +w"))
    assert len(mistakes) == 2
    both = model.compared(painter, now, mistakes)
    origins, directions = model.rays_of(now, mistakes)
    assert (both.corners[0] == 0).all() and (origins == 0).all()
    assert np.array_equal(both.corners[1][2], directions[-1, -1])
    assert both.ray is not None and np.array_equal(both.ray.direction, directions[now.pixel])


@pytest.mark.parametrize("program", PROGRAMS)
def test_at_most_two_mistakes_are_on_one_per_line(program) -> None:
    for mistake in program.mistakes:
        chosen = model.switched(program, (), mistake.name)
        assert chosen == (mistake.name,) and model.switched(program, chosen, mistake.name) == ()
        for other in program.mistakes:
            both = model.switched(program, chosen, other.name)
            if other is mistake:
                continue
            together = program.can_combine(mistake, other)
            assert together or mistake.keys & other.keys
            assert both == ((mistake.name, other.name) if together else (other.name,))
            assert [one.name for one in model.named(program, both)] == list(both)
    (once,) = model.named(program, ("nothing", "rows count upwards", "rows count upwards"))
    assert once.name == "rows count upwards"
    first, second = model.named(program, ("columns count leftwards", "rows count upwards"))
    assert model.without_line(program, (first.name, second.name), "x") == (second.name,)
    third = next(mistake for mistake in program.mistakes if not mistake.keys & {"x", "y"})
    names = model.switched(program, (first.name, second.name), third.name)
    assert names == (second.name, third.name)  # the last one stays


@pytest.mark.parametrize("program", PROGRAMS)
def test_a_lines_common_mistakes_come_first(program) -> None:
    for line in program.lines:
        found = model.of_line(replace(program, mistakes=program.mistakes[::-1]), line.key)
        assert {*found} == {mistake for mistake in program.mistakes if line.key in mistake.keys}
        order = [mistake.is_common for mistake in found]
        assert order[0] and order == sorted(order, reverse=True)


def test_pictures_have_the_images_shape_and_a_limited_size() -> None:
    """Pixels are scaled with the picture."""
    for resolution, images, size in (
        (None, (800, 600), (160, 120)),
        (None, (0, 0), (160, 120)),
        (None, (10, 4000), (160, 320)),
        ((8, 8), (8, 8), (8, 8)),
        ((1920, 1080), (1920, 1080), (160, 90)),
    ):
        state = with_options(STATE, images={"resolution": resolution})
        assert model.picture_size(state, images) == size
    for pixel, old, new, scaled in (
        ((0, 0), (800, 600), (80, 60), (0, 0)),
        ((599, 799), (800, 600), (80, 60), (59, 79)),
        ((5, 7), (80, 60), (800, 600), (55, 75)),
    ):
        assert model.scaled_pixel(pixel, old, new) == scaled


def test_unknown_names_are_reported() -> None:
    names = tuple(mistake.name for program in PROGRAMS for mistake in program.mistakes)
    assert model.unknown((*names, "no such thing")) == ("no such thing",)
