"""A camera with a lens in the user's hands: presets, framing, motions, passages."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from lucida.app.cameras.animation import Passage
from lucida.app.cameras.lens_choices import (
    KINDS,
    LENS_PRESETS,
    of_model,
    with_lens,
)
from lucida.app.cameras.presets import framed
from lucida.renderer.camera import navigation
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.lenses import MODELS, Lens, coefficient_range, with_coefficient
from lucida.renderer.scene.model import View

SIZE = (64, 36)
BASE = Camera.look_at((3, 2, 6), (0, 0.5, 0), fov_y_deg=40, aspect=16 / 9)
BOX = np.array([[x, y, z] for x in (-1, 1) for y in (0, 1) for z in (-1, 1)], float)
ROUND = next(preset for preset in LENS_PRESETS if preset.name == "190 degrees")
each_preset = pytest.mark.parametrize("preset", LENS_PRESETS, ids=lambda preset: preset.name)


@each_preset
def test_a_preset_s_lens_fills_the_image(preset):
    camera = preset.of(replace(BASE, projection="parallel"), SIZE[0] / SIZE[1])
    assert (camera.eye, camera.u, camera.w) == (BASE.eye, BASE.u, BASE.w)
    outside = np.isnan(camera.lens_directions(SIZE)[..., 0])
    assert outside.any() == (preset is ROUND)


def test_the_round_one_sees_190_degrees():
    assert ROUND.of(BASE, 1.0).fov_y_deg == pytest.approx(190, abs=0.2)


def test_every_model_has_its_words_and_ranges():
    assert KINDS.keys() == MODELS.keys()
    for model, names in MODELS.items():
        lens = of_model(model)
        for name in names:
            low, high = coefficient_range(model, name)
            assert low < lens.coefficient(name) < high
            for end in (low, high):
                assert with_coefficient(lens, name, end).coefficient(name) == end
        for name in names if model != "fov" else ():
            assert with_coefficient(with_coefficient(lens, name, 0.1), name, 0.0) == lens


def test_a_lens_makes_parallel_rays_perspective_and_those_take_it_off():
    parallel = navigation.switched_projection(BASE, (0, 0.5, 0))
    lens = Lens("brown", {"k1": 0.1})
    camera = with_lens(parallel, lens, (0, 0.5, 0))
    assert camera.lens == lens
    assert camera.viewport == pytest.approx(BASE.viewport)
    assert navigation.switched_projection(camera, (0, 0.5, 0)).viewport == parallel.viewport


@each_preset
def test_what_is_framed_is_in_the_image(preset):
    camera = framed(preset.of(BASE, SIZE[0] / SIZE[1]), BOX)
    row, column, _ = camera.project(BOX, SIZE)
    assert ((row >= -0.5) & (row <= SIZE[1] - 0.5)).all()
    assert ((column >= -0.5) & (column <= SIZE[0] - 0.5)).all()


BARREL = Lens("brown", {"k1": -0.2, "p1": 0.01})
FISHEYE = Lens("fisheye", {"k1": 0.1})


@pytest.mark.parametrize(
    ("start", "end", "early", "late"),
    [
        (None, BARREL, {"k1": -0.2, "p1": 0.01}, {"k1": -0.2, "p1": 0.01}),
        (BARREL, None, {"k1": -0.2, "p1": 0.01}, {"k1": -0.2, "p1": 0.01}),
        (FISHEYE, Lens("fisheye", {"k1": 0.3, "k2": 0.2}), {}, {}),
        (BARREL, FISHEYE, BARREL, FISHEYE),
        (None, Lens("equirectangular"), None, Lens("equirectangular")),
        (Lens("equirectangular"), BARREL, Lens("equirectangular"), BARREL),
    ],
)
def test_a_lens_passes_evenly_or_switches_at_half_of_the_way(start, end, early, late):
    one, two = (View(replace(BASE, lens=lens)) for lens in (start, end))
    passage = Passage(one, two, (0.0, 0.5, 0.0), SIZE)
    assert (passage.at(0.0), passage.at(1.0)) == (one, two)
    if not isinstance(early, dict):
        assert passage.at(0.4).camera.lens == early
        assert passage.at(0.6).camera.lens == late
        return
    middle = passage.at(0.5).camera.lens
    assert middle is not None
    for name in MODELS[middle.model]:
        ends = [lens.coefficient(name) if lens is not None else 0.0 for lens in (start, end)]
        assert middle.coefficient(name) == pytest.approx(sum(ends) / 2)


def test_parallel_rays_pass_through_no_lens_on_the_way():
    parallel = navigation.switched_projection(BASE, (0, 0.5, 0))
    passage = Passage(View(replace(BASE, lens=BARREL)), View(parallel), (0, 0.5, 0), SIZE)
    kinds = {passage.at(float(part)).camera.projection for part in np.linspace(0, 1, 101)}
    assert kinds == {"perspective", "parallel"}
    assert math.isclose(passage.at(0.01).camera.lens.coefficient("k1"), -0.2, rel_tol=1e-2)
