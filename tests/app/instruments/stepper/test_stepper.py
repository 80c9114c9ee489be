"""The loop stepper: two algorithms, one image, the fast renderers'; and every step of it."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from recorded_runs import SCENES, TWO_BALLS, TWO_BOXES, cameras, recorded

from lucida.app.instruments.stepper import model as stepper
from lucida.app.instruments.stepper.loop_parts import MISS, Hit, Model, ViewingRay
from lucida.app.instruments.stepper.loops import PROGRAMS, image_order, rasterization
from lucida.app.instruments.stepper.model import moment_at
from lucida.app.instruments.stepper.raster_parts import Corner, triangles
from lucida.renderer.camera.camera import Camera
from lucida.renderer.compare.raster_and_ray import compare_frames
from lucida.renderer.files import BUILTIN_SCENES, load_scene
from lucida.renderer.images.frame import CHANNELS
from lucida.renderer.trace import Tracer

IMAGE = (16, 12)

# One image, proved against the fast renderers.


@pytest.mark.parametrize("name", BUILTIN_SCENES)
def test_all_loops_end_in_the_renderers_image(name: str, rasterizer) -> None:
    scene = load_scene(name)
    model = Model(scene)
    own, *others = cameras(scene, np.random.default_rng(7))
    number = BUILTIN_SCENES.index(name)
    other = others[number % len(others)]  # each kind in some scene, and some wound back
    other = replace(other, u=tuple(-x for x in other.u)) if number % 2 else other
    rasterizer.set_scene(scene)
    hits = 0
    with Tracer(scene) as tracer, Tracer(scene, method="reference") as reference:
        for number, camera in enumerate((own, other)):
            by_triangles, by_image = (
                run(model, camera, IMAGE).array for run in (rasterization, image_order)
            )
            exact = reference.render(camera, IMAGE, channels=CHANNELS)
            np.testing.assert_allclose(by_image, exact.color, rtol=1e-6, atol=1e-7)
            if camera is not own:
                # No centre lies on an edge, or on the line of a checker, where rounding decides.
                np.testing.assert_allclose(by_triangles, by_image, atol=1e-9, err_msg=number)
            # The loops' colours with the other channels of the same rays: agreement is 2/255, or
            # a line of the image within 1/128 pixel.
            fast = [one.render(camera, IMAGE, channels=CHANNELS) for one in (rasterizer, tracer)]
            for color, frames in ((by_image, fast), (by_triangles, (exact, *fast))):
                ours = replace(exact, color=color.astype(np.float32))
                for frame in frames:
                    result = compare_frames(model.flat, camera, IMAGE, frame, ours)
                    assert result.unexplained == 0, result.summary()
                    assert result.agree > 0.95 * result.pixels, result.summary()
                    assert result.max_color_error <= 2 / 255
            hits += int((exact.id >= 0).sum())
    assert hits > 95


# The code on the screen is the code that runs.


@pytest.mark.parametrize("program", PROGRAMS)
def test_lines_are_run_in_the_loops_order(program) -> None:
    run = recorded(SCENES[program], program, size=(4, 3))
    source = run.source
    lines = [moment_at(run, step).line for step in range(len(run))]
    assert lines[0] == 1 and source.lines[lines[-1]] == "    return canvas"
    assert set(lines) == set(range(1, len(source.lines)))
    outer, inner = source.pixels, source.objects
    if program is rasterization:
        outer, inner = inner, outer
    assert source.lines[outer.start - 1].startswith("    ")
    assert inner.start - 1 in outer and outer.start - 1 not in inner


# Steps.


@pytest.mark.parametrize("program", PROGRAMS)
def test_every_moment_follows_from_the_one_before(program) -> None:
    """The canvas changes by what the line before says."""
    run = recorded(SCENES[program], program, size=(6, 5))
    before = moment_at(run, 0)
    for step in range(1, len(run)):
        now = moment_at(run, step)
        assert now.step == step
        if run.source.lines[before.line].lstrip().startswith("canvas[i, j]"):
            assert before.pixel is not None
            expected = before.canvas.copy()
            expected[before.pixel] = now.canvas[before.pixel]
            assert np.array_equal(now.canvas, expected, equal_nan=True)
            assert np.isfinite(now.canvas[before.pixel]).all()
        elif before.line > 4:
            assert np.array_equal(now.canvas, before.canvas, equal_nan=True)
        before = now
    assert moment_at(run, -5).step == 0 and moment_at(run, 10**9).step == len(run) - 1


@pytest.mark.parametrize("projection", ["perspective", "parallel"])
def test_variables_are_the_lectures(projection: str) -> None:
    """u = (j - 0.5) / W - 0.5, v = -((i - 0.5) / H - 0.5) with 1-based i, j; the ray from them."""
    camera = Camera(projection=projection)
    run = recorded(TWO_BALLS, image_order, camera)
    checked = 0
    for step in range(0, len(run), 7):
        now = moment_at(run, step)
        if now.ray is None:
            continue
        assert now.pixel is not None
        i, j = now.pixel[0] + 1, now.pixel[1] + 1
        u, v = (j - 0.5) / 20 - 0.5, -((i - 0.5) / 15 - 0.5)
        texts = {one.name: stepper.describe(one.value) for one in now.variables}
        assert (texts["i"], texts["j"]) == (str(i - 1), str(j - 1))
        assert float(texts["x"]) == pytest.approx(u, abs=6e-5)
        assert float(texts["y"]) == pytest.approx(v, abs=6e-5)
        if projection == "parallel":
            assert now.ray.origin == pytest.approx((u, v, 0))
            assert now.ray.direction == pytest.approx((0, 0, -1))
        else:
            assert now.ray.origin == (0, 0, 0)
            assert now.ray.direction == pytest.approx((u, v, -1))
        checked += 1
    assert checked > 30


# Ways to go on.


def test_going_to_the_next_pixel_and_object() -> None:
    run = recorded(TWO_BALLS, image_order, size=(4, 3))
    step, visited = 0, []
    while (following := stepper.after(run, step, "pixel")) < len(run) - 1:
        step = following
        visited.append(moment_at(run, step).pixel)
    assert visited == [(i, j) for i in range(3) for j in range(4)]
    objects = []
    step = 0
    for _ in range(4):
        step = stepper.after(run, step, "object")
        now = moment_at(run, step)
        names = [one.value.name for one in now.variables if one.name == "object"]
        objects.append((now.pixel, *names))
    assert objects == [((i, j), name) for i, j in ((0, 0), (0, 1)) for name in ("far", "near")]


def test_values_are_told_in_a_few_characters() -> None:
    model = Model(TWO_BOXES)
    (_, near), piece = model.objects, next(triangles(model, Camera.canonical()))
    ray = ViewingRay((0.0, 0.0, 0.0), (0.125, 0.5, -1.0), 0.0, math.inf)
    for value, text in (
        (range(3, 7), "3 to 6"),
        (range(0), "none"),
        (near, "near"),
        (piece, f"far, number {piece.primitive}"),
        (replace(piece, shares=0.5 * piece.shares), f"far, number {piece.primitive}, clipped"),
        (Corner(3.14159, 12.5, 0.25), "(3.14, 12.50), z = 0.2500"),
        ((2.0, 13.5), "(2, 13.5)"),
        (ray, "(0.0000, 0.0000, 0.0000) + t (0.1250, 0.5000, -1.0000)"),
        (MISS, "miss, t = inf"),
        (Hit(2.5, near, 12), "t = 2.5000, near"),
        (0.5, "0.5000"),
        (3, "3"),
    ):
        assert stepper.describe(value) == text
