"""Zeros, infinities and signs, where answers are judged and explained."""

from __future__ import annotations

import math
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import Phase, example, given, settings
from hypothesis import strategies as st

from app.checking.builtin import BUILTIN
from app.checking.kinds import KINDS
from app.checking.mistakes.ray_diagnosis import diagnose_rays
from app.checking.mistakes.ray_facts import PLACES
from app.checking.mistakes.ray_trial import RayCase
from app.checking.mistakes.rays import WORDS, RayTask, ray_program, run_rays
from app.checking.tasks import CheckCase
from renderer.camera import Camera

borders = st.sampled_from([0.0, -0.0, 1.0, -1.0, 1e300, math.inf, -math.inf, math.nan])
parameters = st.floats(1e-3, 1e3) | st.just(math.inf)
HITS = [task for task in BUILTIN if task.kind in ("hit-sphere", "hit-triangle")]
CLOSEST = [task for task in BUILTIN if task.kind == "closest-hit"]


@given(parameters, borders | st.floats(), st.sampled_from([0.0, 1e-6]))
def test_a_hit_is_right_near_the_right_one_and_a_miss_where_there_is_one(right, answer, near):
    is_right = answer == right or abs(answer - right) <= near
    for task in HITS:
        case = CheckCase((), right, near, {})
        assert KINDS[task.kind].wrong(task, [case], np.array([answer])).tolist() == [not is_right]
    for task in CLOSEST:
        for number in (0.0, 1.0):
            case = CheckCase((), (number, right), near, {})
            for given_number in (0.0, 1.0, -1.0):
                wrong = KINDS[task.kind].wrong(task, [case], np.array([[given_number, answer]]))
                assert wrong.tolist() == [not is_right or given_number != number]


edges = st.sampled_from([-1.5, -1.0, -0.5, 0.0, 0.5, 1.0, 1.5])
sides = st.lists(edges, min_size=2, max_size=2, unique=True).map(sorted)
viewports = st.tuples(sides, sides).map(lambda both: (*both[0], *both[1]))
sizes = st.tuples(st.integers(3, 5), st.integers(3, 5))
CAMERA = Camera.look_at((3, 1, 2), (0, 0, 0))


@settings(max_examples=30, phases=(Phase.explicit, Phase.generate))
@example((-1.0, 1.0, -1.0, 0.0), (-1.0, 1.0, -0.5, 0.5), (4, 4), "perspective")
@given(viewports, viewports, sizes, st.sampled_from(["perspective", "parallel"]))
def test_any_viewport_for_any_other_is_explained_in_numbers(asked, made, size, projection):
    camera = replace(CAMERA, projection=projection, viewport=asked)
    cases = [RayCase(camera, size, pixel) for pixel in np.ndindex(size[1], size[0])]
    rays = [replace(camera, viewport=made).ray(*case.pixel, size) for case in cases]
    wrong = np.full(len(cases), asked != made)
    found = diagnose_rays(cases, np.array(rays), wrong) if wrong.any() else None
    if wrong.any():
        assert found is not None
        assert found.sentences
        words = " ".join(found.sentences).replace(",", " ").replace(";", " ").split()
        assert not {"nan", "inf", "-inf"} & set(words), words


@example((0.0, 1.5, -1.0, 1.0), (3, 4))
@example((0.0, 1.5, -1.0, 1.0), (4, 3))
@given(viewports, sizes)
def test_places_are_what_they_are_called(viewport, size):
    left, right, bottom, top = map(Fraction, viewport)
    case = RayCase(replace(CAMERA, viewport=viewport), size, (0, 0))
    found = {name: bool(is_there(case)) for name, is_there in PLACES}
    wide, high = (right - left) / size[0], (top - bottom) / size[1]
    assert found["where pixels are square"] == (wide == high)
    assert found["where the viewport is symmetric"] == ((left, bottom) == (-right, -top))
    assert found["in square images"] == (size[0] == size[1])
    assert found["in perspective"] != found["in parallel projection"]


@pytest.mark.parametrize("from_top", [True, False])
@pytest.mark.parametrize("turned", ["rows", "columns"])
def test_rows_and_columns_that_are_turned_mirror_every_other_mistake(from_top, turned):
    """In a viewport that is symmetric: x, or y, has the other sign."""
    program = ray_program(RayTask(words=WORDS, from_top=from_top))
    names = {
        "rows": "rows count upwards" if from_top else "rows count downwards",
        "columns": "columns count leftwards",
    }
    (flip,) = [one for one in program.mistakes if one.name == names[turned]]
    basis = dict(zip("uvw", np.eye(3), strict=True))
    known = {"i": np.array([[0.0], [1], [2], [3]]), "j": np.array([[0.0], [2], [1], [4]])}
    known |= {"width": 5, "height": 4, "eye": np.zeros(3), "distance": 1.3, **basis}
    known |= {"left": -1.1, "right": 1.1, "bottom": -0.7, "top": 0.7}
    mirror = np.array([1, -1, 1]) if turned == "rows" else np.array([-1, 1, 1])
    right = run_rays(program, known)[1]
    assert run_rays(program, known, (flip,))[1] == pytest.approx(right * mirror)
    tried: list[str] = []
    for other in program.mistakes:
        if other is not flip and other.part == flip.part and program.can_combine(flip, other):
            alone, both = (run_rays(program, known, m)[1] for m in ((other,), (flip, other)))
            if np.isfinite(alone).all() and not np.allclose(alone, right):
                assert both == pytest.approx(alone * mirror), other.name
                tried.append(other.name)
    assert len(tried) >= 24, tried
