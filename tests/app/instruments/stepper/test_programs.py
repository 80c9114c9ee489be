"""The programs that a lecture runs: their lines, their moments, and the image that they end in."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from recorded_runs import TWO_BALLS, cameras

from lucida.app.instruments.stepper.loop_parts import Model, ViewingRay, color_at, intersect
from lucida.app.instruments.stepper.loops import image_order
from lucida.app.instruments.stepper.programs import (
    IMAGE_ORDER,
    OBJECT_ORDER,
    RAY_TRACING,
    Line,
    LoopRun,
    hits_of,
    run_part,
    whole_program,
)
from lucida.app.instruments.stepper.source import shown_lines
from lucida.app.ui.explaining.languages import julia
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


def test_each_whole_number_of_the_option_is_a_run() -> None:
    for option, part in ((0.0, 0.0), (0.25, 0.25), (1.0, 1.0), (1.25, 0.25), (2.0, 1.0)):
        assert run_part(option) == part


def test_ray_tracing_sets_every_pixel_once_the_background_too() -> None:
    run = LoopRun(BALLS, RAY_TRACING)
    told = image_order(Model(TWO_BALLS), CAMERA, SIZE).array
    np.testing.assert_array_equal(run.at(1).canvas, told)
    for part in np.linspace(0.01, 0.99, 20):
        done = set_pixels(run, part).ravel()
        assert done[: done.sum()].all()
        canvas = run.at(part).canvas.reshape(-1, 3)
        np.testing.assert_array_equal(canvas[done], told.reshape(-1, 3)[done])


def test_a_scene_without_objects_is_background() -> None:
    hits = hits_of(Model(Scene((), background=(0.5, 0.5, 0.5))), CAMERA, (2, 2))
    assert (LoopRun(hits, RAY_TRACING).at(1).canvas == 0.5).all()
    assert np.isnan(LoopRun(hits, OBJECT_ORDER, by_object=True).at(1).canvas).all()


# The program on the screen draws the image, in each notation and language.


class FromOne:
    """A canvas whose rows and columns are counted from 1."""

    def __init__(self, made: np.ndarray) -> None:
        self.made = made

    def __setitem__(self, pixel: tuple[int, int], value: tuple[float, ...]) -> None:
        assert min(pixel) >= 1
        self.made[pixel[0] - 1, pixel[1] - 1] = value


def drawn_by(lines: tuple[str, ...], scene: Scene, camera: Camera, from_one: bool) -> np.ndarray:
    """Run a program's text; vectors are of the camera, in letters or in words."""
    model, array = Model(scene), np.full((SIZE[1], SIZE[0], 3), np.nan)
    vectors = {name: np.array(getattr(camera, name)) for name in ("eye", "u", "v", "w")}
    letters = {"e": vectors["eye"], "d": camera.distance, **vectors}
    names: dict[str, object] = {**vectors, "distance": camera.distance}
    names |= zip(("left", "right", "bottom", "top"), camera.viewport, strict=True)
    names |= {
        "cam": SimpleNamespace(**letters),
        "size": lambda canvas: (SIZE[1], SIZE[0]),
        "miss": SimpleNamespace(t=math.inf, color=model.background),
        "intersect": lambda thing, *ray: hit_of(model, camera, thing, *ray),
        "color": lambda hit: hit.color,
    }
    exec(compile("\n".join(lines), "program", "exec"), names)
    names["render"](model.objects, FromOne(array) if from_one else array)  # type: ignore[operator]
    return array


def hit_of(model, camera, thing, origin, direction):
    ray = ViewingRay(tuple(map(float, origin)), tuple(map(float, direction)), *camera.t_range)
    hit = intersect(thing, ray)
    return SimpleNamespace(t=hit.t, color=color_at(model, ray, hit))


def read_back(lines: tuple[str, ...]) -> tuple[str, ...]:
    """Julia's lines as Python."""
    found = []
    for line in lines:
        if line.strip() != "end":
            line = re.sub(r"\b1:(\w+)$", r"range(1, \1 + 1)", line)
            line = re.sub(r"\b0:(\w+) - 1$", r"range(\1)", line).replace("function ", "def ")
            opens = line.strip().startswith(("def ", "for ", "if "))
            found.append(line + ":" if opens else line)
    return tuple(found)


@pytest.mark.parametrize("notation", ["book", "code"])
@pytest.mark.parametrize("language", ["python", "julia"])
@pytest.mark.parametrize("projection", ["perspective", "parallel"])
def test_the_whole_program_draws_the_image(projection, language, notation) -> None:
    scene = load_scene("canonical")
    own = scene.view.for_size(SIZE)
    simple = replace(Camera.canonical(), projection=projection)
    for camera in (simple, replace(own, projection=projection, viewport=(-0.4, 0.5, -0.3, 0.6))):
        texts = tuple(line.text for line in whole_program(camera))
        assert ("left" in texts[4]) == (camera is not simple) and len(texts) <= 15
        if language == "julia":
            shown = "\n".join(shown_lines(texts, notation))
            lines = read_back(julia.loops(shown, Indexing.LECTURE).lines)
        else:
            lines = shown_lines(texts, notation, Indexing.LECTURE)
        told = image_order(Model(scene), camera, SIZE).array
        np.testing.assert_allclose(
            drawn_by(lines, scene, camera, language == "julia"), told, atol=1e-9
        )
        run = LoopRun(hits_of(Model(scene), camera, SIZE), whole_program(camera))
        np.testing.assert_allclose(run.at(1).canvas, told, atol=1e-9)


def test_lines_are_lit_when_they_run() -> None:
    lines = (Line("once", "once"), Line("row", "row"), *RAY_TRACING)
    run = LoopRun(BALLS, lines)
    first = run.at(1e-9)
    assert set(first.lit) == {0} and first.pixel == (0, 0)
    steps = {n: sum(run.at(p).lit.get(n, 0) > 0 for p in np.linspace(0, 1, 4000)) for n in range(6)}
    assert 0 < steps[1] < steps[5] < steps[4]


def test_the_cameras_of_other_kinds_have_hits_too() -> None:
    for camera in cameras(TWO_BALLS, np.random.default_rng(3)):
        np.testing.assert_allclose(
            LoopRun(hits_of(Model(TWO_BALLS), camera, SIZE), RAY_TRACING).at(1).canvas,
            image_order(Model(TWO_BALLS), camera, SIZE).array,
            atol=1e-9,
        )
