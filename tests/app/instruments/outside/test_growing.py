"""The key formula as it grows: its terms lead from the eye to the pixel, whatever the camera."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from both_lectures import first_lecture
from hypothesis import given
from hypothesis import strategies as st
from looked_at import SIZE, cameras

from lucida.app.instruments.outside.camera_diagram import Content, diagram
from lucida.app.instruments.outside.diagram import Arrow, Dot, Label, RayEnd, Segments
from lucida.app.instruments.outside.growing import (
    STAGES,
    Term,
    grown_diagram,
    lit_in,
    stage_at,
    stage_shares,
    terms,
)
from lucida.app.lecture.text import formulas
from lucida.app.state.options.outside import OutsideOptions
from lucida.renderer.camera.camera import Camera

CAMERA = Camera.look_at((3.0, 2.0, 4.0), (0.0, 0.0, 0.0), distance=1.5, aspect=4 / 3)
END = len(STAGES)
positions = st.floats(0, END)
pixels = st.tuples(st.integers(0, SIZE[1] - 1), st.integers(0, SIZE[0] - 1))


def terms_at(camera: Camera, pixel: tuple[int, int], position: float) -> list[Term]:
    x, y = (float(value) for value in camera.image_point(*pixel, SIZE))
    return terms(camera, x, y, stage_shares(position))


@given(cameras(), pixels)
def test_the_whole_formula_is_the_viewing_ray_head_to_tail(camera, pixel) -> None:
    vectors = {term.name: term for term in terms_at(camera, pixel, END)}
    ray = camera.ray(*pixel, SIZE)
    length = np.linalg.norm(ray.direction)
    assert np.allclose(vectors["d"].start, ray.origin)
    assert np.allclose(vectors["d"].end - vectors["d"].start, ray.direction, atol=1e-9 * length)
    chain = [vectors[name] for name in "wuv" if name in vectors]
    for term, following in itertools.pairwise(chain):
        assert np.array_equal(term.end, following.start)
    assert np.allclose(chain[0].start, camera.eye)
    reached = ray.origin if camera.is_parallel else ray.origin + ray.direction
    assert np.allclose(chain[-1].end, reached, atol=1e-9 * length)


@given(cameras(), pixels, positions, positions)
def test_a_growing_construction_never_shrinks(camera, pixel, early, late) -> None:
    """No term gets shorter, and none begins before the previous one is complete."""
    first, last = sorted((early, late))
    before, after = (terms_at(camera, pixel, position) for position in (first, last))
    for name in ("w", "u", "v"):
        lengths = [
            sum(np.linalg.norm(v.end - v.start) for v in now if v.name == name)
            for now in (before, after)
        ]
        assert lengths[0] <= lengths[1] * (1 + 1e-9) + 1e-12
    parts = list(stage_shares(last).values())
    assert all(part == 1 for part, later in itertools.pairwise(parts) if later > 0)


def test_from_perspective_to_parallel_each_ray_goes_through_its_pixel() -> None:
    pixel = RayEnd((5, 50), 2.0)
    u, v, w = (np.asarray(axis) for axis in (CAMERA.u, CAMERA.v, CAMERA.w))
    x, y = CAMERA.image_point(5, 50, SIZE)
    across = float(x) * u + float(y) * v
    for share in (0.01, 0.3, 0.7, 1.0):
        options = OutsideOptions(formula=6.0, to_parallel=share)
        items = grown_diagram(Content(CAMERA, SIZE, options, 9.0, marked=pixel))
        (ray,) = (item for item in items if isinstance(item, Segments) and item.name == "ray")
        start, end = ray.segments[0]
        center = np.asarray(CAMERA.eye) - (1 - share) * CAMERA.distance * w + across
        assert np.linalg.norm(np.cross(end - start, center - start)) < 1e-9
        assert abs((start - CAMERA.eye) @ w) < 1e-9  # its origin is in the eye's plane
    assert np.allclose(start, np.asarray(CAMERA.eye) + across)
    assert np.allclose(np.cross(end - start, w), 0)


def test_numbers_take_the_place_of_the_formulas_letters() -> None:
    options = OutsideOptions(formula=6.0, numbers=True)
    content = Content(Camera.canonical(), (10, 10), options, 9.0, marked=RayEnd((2, 6), None))
    texts = {item.text for item in grown_diagram(content) if isinstance(item, Label)}
    assert {"0.15 vec(u)", "0.25 vec(v)", "-1 vec(w)", "vec(d) = (0.15, 0.25, -1)"} <= texts


def names_at(position: float | None, camera: Camera = CAMERA) -> set[tuple[type, str]]:
    options = OutsideOptions(formula=position)
    items = grown_diagram(Content(camera, SIZE, options, 9.0, marked=RayEnd((5, 50), 2.0)))
    return {(type(item), item.name) for item in items}


def test_a_hit_is_drawn_once_the_ray_has_reached_it() -> None:
    assert (Dot, "hit") not in names_at(5.5)
    assert (Dot, "hit") in names_at(6.0)


def test_the_ray_comes_last_and_nothing_is_missing_at_the_end() -> None:
    for position in np.linspace(0, END - 1, 9).tolist():
        assert (Segments, "ray") not in names_at(position)
    assert names_at(None) <= names_at(float(END))
    assert {(Arrow, f"term {name}") for name in "wuvd"} <= names_at(float(END))
    assert (Label, "pixel") in names_at(0.5) and (Label, "centre") in names_at(1.5)
    plain = diagram(Content(CAMERA, SIZE, OutsideOptions(), 9.0, marked=RayEnd((5, 50), 2.0)))
    assert {(type(item), item.name) for item in plain} == names_at(None)


@pytest.mark.parametrize("title", ["Any camera", "Parallel: the pixel moves the origin"])
def test_each_term_is_in_the_formulas_of_its_step(title) -> None:
    step = [build for build in first_lecture().builds if build.title == title][-1]
    assert step.changes["outside"]["formula"] == END
    for stage in ("w", "u", "v", "ray"):
        lit = [lit_in(latex, stage) for latex in formulas(step.blocks)]
        assert any(lit), stage
        assert all(part in latex for part, latex in zip(lit, formulas(step.blocks), strict=True))
    assert stage_at(END, CAMERA) == "" and not any(lit_in(f, "") for f in formulas(step.blocks))
