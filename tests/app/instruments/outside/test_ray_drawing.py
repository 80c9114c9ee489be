"""Drawings of viewing rays that a lecture builds up, and of the simple camera."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from lucida.app.instruments.outside.camera_diagram import Content, diagram
from lucida.app.instruments.outside.diagram import Arrow, Dot, Item, Label, RayEnd, Segments
from lucida.app.instruments.outside.pixel_drawing import pixel_numbers
from lucida.app.instruments.outside.ray_drawing import half_line, meetings, rays_to
from lucida.app.instruments.outside.simple_camera import simple_camera, simple_ray
from lucida.app.state.options.outside import OutsideOptions
from lucida.renderer.camera.camera import Camera

CAMERA = Camera.canonical()
SIZE = (10, 10)
PIXEL = (2, 6)


def _texts(items: list[Item]) -> set[str]:
    return {item.text for item in items if isinstance(item, Label)}


def _names(items: list[Item], kind: type) -> list[str]:
    return [item.name for item in items if isinstance(item, kind)]


def test_half_a_line_grows_from_p_by_d_to_all_t_above_0() -> None:
    stages = [half_line(CAMERA, SIZE, PIXEL, grown) for grown in (0.0, 1, 2, 3, 4)]
    assert stages[0] == []
    assert _names(stages[1], Arrow) == [] and _names(stages[2], Arrow) == ["d"]
    assert {"t = 1", "t = 2", "t = 3"} <= _texts(stages[3]) and "t < 0" not in _texts(stages[3])
    (behind,) = (one for one in stages[4] if isinstance(one, Segments) and one.name == "t < 0")
    assert behind.dashed and "t < 0" in _texts(stages[4])
    (second,) = (one for one in stages[3] if isinstance(one, Dot) and one.name == "t = 2")
    assert np.allclose(second.point, (0.3, 0.5, -2.0))


def test_of_all_meetings_the_least_t_above_0_wins() -> None:
    found = (-1.0, 0.8, 2.0)
    items = meetings(CAMERA, SIZE, PIXEL, found, 9.0, 1.0)
    assert {"t = -1", "t = 0.8", "t = 2"} <= _texts(items)
    (beyond,) = (one for one in items if one.name == "beyond")
    assert beyond.opacity == 1  # not yet paler
    items = meetings(CAMERA, SIZE, PIXEL, found, 9.0, 2.0)
    assert [one.name for one in items if isinstance(one, Dot) and one.role == "mark"] == ["t = 0.8"]
    (ray,) = (one for one in items if isinstance(one, Segments) and one.name == "ray")
    assert np.allclose(ray.segments[0, 1], (0.12, 0.2, -0.8))


@pytest.mark.parametrize("projection", ["perspective", "parallel"])
def test_a_ray_to_a_point_passes_the_image_plane_where_the_point_is_seen(projection) -> None:
    camera = replace(CAMERA, projection=projection, viewport=(-3.0, 3.0, -3.0, 3.0))
    point = (0.7, -0.4, -3.0)
    items = rays_to(camera, [point], 2.0, 5.0)
    (dot,) = (one for one in items if isinstance(one, Dot) and one.name.startswith("on plane"))
    seen, there = camera.project(dot.point, SIZE), camera.project(np.array(point), SIZE)
    assert (seen.row, seen.column) == pytest.approx((there.row, there.column))
    assert dot.point[2] == pytest.approx(0.0 if camera.is_parallel else -1.0)
    (after,) = (one for one in items if isinstance(one, Segments) and one.name == "rays")
    assert np.allclose(after.segments, [[dot.point, point]])
    assert not any(isinstance(one, Dot) for one in rays_to(camera, [point], 0.5, 5.0))


def test_the_simple_camera_gets_one_fact_after_another() -> None:
    facts = [_texts(simple_camera(CAMERA, grown, measured=True)) for grown in range(6)]
    assert "(0, 0, 0)" in facts[1] and "-z" in facts[2] and "1" not in facts[3]
    assert "1" in facts[4] and "d = 1" in facts[5]


def test_the_lectures_pixel_in_numbers() -> None:
    letters = simple_ray(CAMERA, SIZE, PIXEL, 1, 3.0, numbers=False)
    assert {"u", "v", "(u, v, -d)"} <= _texts(letters)
    numbers = simple_ray(CAMERA, SIZE, PIXEL, 1, 3.0, numbers=True)
    assert {"u = 0.15", "v = 0.25", "(0.15, 0.25, -1)"} <= _texts(numbers)
    assert "(3, 7)" in _texts(simple_ray(CAMERA, SIZE, PIXEL, 1, 1.0, numbers=True))


def test_rows_and_columns_are_numbered_and_the_marked_one_always_is() -> None:
    every = _names(pixel_numbers(CAMERA, SIZE, PIXEL, 1, 1), Label)
    assert every == [*(f"row {k}" for k in range(10)), *(f"column {k}" for k in range(10))]
    few = _texts(pixel_numbers(CAMERA, (32, 32), (4, 9), 1, 3))
    assert few == {"1", "5", "10", "32"}


def test_a_basis_from_a_target_grows_in_the_order_in_which_it_is_computed() -> None:
    camera = Camera.look_at((3.0, 2.0, 4.0), (0.0, 0.0, 0.0))
    seen = []
    for grown in (0.0, 1.0, 2.0, 3.0, 4.0):
        options = OutsideOptions(
            image=False, grid=False, volume=False, target=(0, 0, 0), basis_grown=grown
        )
        items = diagram(Content(camera, SIZE, options, 9.0, marked=RayEnd(PIXEL, None)))
        seen.append(set(_names(items, Arrow)))
    assert seen == [set(), {"w"}, {"w", "up"}, {"w", "up", "u"}, {"w", "up", "u", "v"}]
