"""The programs that a lecture runs: their lines, their moments, and the image that they end in."""

from __future__ import annotations

import math
import sys
from dataclasses import replace
from types import SimpleNamespace
from typing import Any
from unittest.mock import patch

import numpy as np
import pytest
from recorded_runs import TWO_BALLS

from lucida.app.instruments.stepper.loop_parts import Model, ViewingRay, color_at, intersect
from lucida.app.instruments.stepper.loops import image_order
from lucida.app.instruments.stepper.programs import (
    IMAGE_ORDER,
    OBJECT_ORDER,
    RAY_TRACING,
    LoopRun,
    hits_of,
    run_part,
    whole_program,
)
from lucida.app.instruments.stepper.source import shown_lines
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.pixels import Indexing
from lucida.renderer.files import load_scene
from lucida.renderer.scene.model import Scene

SIZE = (8, 6)
CAMERA = Camera.canonical()
BALLS = hits_of(Model(TWO_BALLS), CAMERA, SIZE)
RUNS = LoopRun(BALLS, OBJECT_ORDER, by_object=True), LoopRun(BALLS, IMAGE_ORDER)


def set_pixels(run: LoopRun, part: float) -> np.ndarray:
    return np.isfinite(run.at(part).canvas[..., 0])


def test_both_loops_end_in_one_image_that_all_objects_have_drawn() -> None:
    by_object, by_image = (run.at(1).canvas for run in RUNS)
    np.testing.assert_array_equal(by_object, by_image)
    told = image_order(Model(TWO_BALLS), CAMERA, SIZE).array
    drawn = np.isfinite(by_object[..., 0])
    assert 0 < drawn.sum() < 48
    np.testing.assert_array_equal(by_object[drawn], told[drawn])
    assert (told[~drawn] == TWO_BALLS.background).all()  # no object has affected these


def test_one_loop_fills_object_by_object_the_other_pixel_by_pixel() -> None:
    by_object, by_image = RUNS
    far, both = BALLS.t[0] < math.inf, BALLS.t.min(axis=0) < math.inf
    half = next(p for p in np.linspace(0.4, 0.6, 200) if by_object.at(p).pixel == (0, 1))
    assert np.array_equal(set_pixels(by_object, half).ravel(), far)
    assert (BALLS.t[0] > BALLS.t[1]).any()
    for part in np.linspace(0.01, 0.99, 30):
        moment = by_image.at(part)
        assert moment.pixel is not None and max(moment.lit.values()) == 1.0
        number = moment.pixel[0] * SIZE[0] + moment.pixel[1]
        done = set_pixels(by_image, part).ravel()
        assert np.array_equal(done[:number], both[:number]) and not done[number + 1 :].any()


@pytest.mark.parametrize("run", RUNS)
def test_nothing_is_lit_before_and_after_a_run(run: LoopRun) -> None:
    for part in (0.0, 1.0):
        moment = run.at(part)
        assert moment.pixel is None and not moment.lit
    assert not set_pixels(run, 0).any()
    parts = [set_pixels(run, part).sum() for part in np.linspace(0, 1, 50)]
    assert parts == sorted(parts)
    seen = {line for part in np.linspace(0.001, 0.999, 300) for line in run.at(part).lit}
    assert seen == {0, 1, 2, 3}


def test_each_run_passes_all_pixels_once_an_object_order_once_an_object() -> None:
    last = SIZE[0] * SIZE[1] - 1
    for run, times in zip(RUNS, (len(BALLS.t), 1), strict=True):
        places = [run.at(part).pixel for part in np.linspace(0.001, 1 - 1e-9, 400)]
        numbers = [row * SIZE[0] + column for row, column in places]
        assert numbers[0] == 0 and numbers[-1] == max(numbers) == last
        assert np.sum(np.diff(numbers) < 0) == times - 1


def test_each_whole_number_of_the_option_is_a_run() -> None:
    for option, part in ((0.0, 0.0), (0.25, 0.25), (1.0, 1.0), (1.25, 0.25), (2.0, 1.0)):
        assert run_part(option) == part


def test_a_scene_without_objects_is_background() -> None:
    hits = hits_of(Model(Scene((), background=(0.5, 0.5, 0.5))), CAMERA, (2, 2))
    assert (LoopRun(hits, RAY_TRACING).at(1).canvas == 0.5).all()
    assert np.isnan(LoopRun(hits, OBJECT_ORDER, by_object=True).at(1).canvas).all()


# The program on the screen draws the image, in each language.


def drawn_by(lines: tuple[str, ...], scene: Scene, camera: Camera) -> np.ndarray:
    """Run a program's text; vectors are of the camera, in letters."""
    model, array = Model(scene), np.full((SIZE[1], SIZE[0], 3), np.nan)
    fields = {name: np.array(getattr(camera, name)) for name in ("eye", "u", "v", "w")}
    fields |= {"e": fields["eye"], "d": camera.distance, "distance": camera.distance}
    fields |= zip(("left", "right", "bottom", "top"), camera.viewport, strict=True)
    objects = {
        "miss": SimpleNamespace(t=math.inf, color=model.background),
        "intersect": lambda thing, *ray: hit_of(model, camera, thing, *ray),
        "color": lambda hit: hit.color,
    }
    names: dict[str, Any] = {}
    with patch.dict(sys.modules, objects=SimpleNamespace(**objects)):
        exec(compile("\n".join(lines), "program", "exec"), names)
    names["render"](model.objects, SimpleNamespace(**fields), array)
    return array


def hit_of(model, camera, thing, origin, direction):
    ray = ViewingRay(tuple(map(float, origin)), tuple(map(float, direction)), *camera.t_range)
    hit = intersect(thing, ray)
    return SimpleNamespace(t=hit.t, color=color_at(model, ray, hit))


@pytest.mark.parametrize("projection", ["perspective", "parallel"])
def test_the_whole_program_draws_the_image(projection) -> None:
    scene = load_scene("canonical")
    own = scene.view.for_size(SIZE)
    simple = replace(Camera.canonical(), projection=projection)
    for camera in (simple, replace(own, projection=projection, viewport=(-0.4, 0.5, -0.3, 0.6))):
        texts = tuple(line.text for line in whole_program(camera))
        assert ("left" in texts[5]) == (camera is not simple) and len(texts) <= 15
        lines = shown_lines(texts, Indexing.LECTURE)
        told = image_order(Model(scene), camera, SIZE).array
        np.testing.assert_allclose(drawn_by(lines, scene, camera), told, atol=1e-9)
        run = LoopRun(hits_of(Model(scene), camera, SIZE), whole_program(camera))
        np.testing.assert_allclose(run.at(1).canvas, told, atol=1e-9)
