"""Lines of the image where rounding decides: how near is on it, and what is just not any more."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from renderer import Camera
from renderer.edges import Discontinuities
from renderer.scene.flat import flatten
from renderer.scene.model import Checker, Material, Mesh, Scene, SceneObject

SIZE = (32, 24)
CAMERA = Camera(viewport=(-0.5, 0.5, -0.375, 0.375))  # one pixel is 1/32 of a unit at t = 1


def triangle(corners, order=(0, 1, 2), **material) -> SceneObject:
    return SceneObject(Mesh([corners[k] for k in order], [[0, 1, 2]]), Material(**material))


def wall(depth: float, across: float = 0.0, up: float = 0.0) -> SceneObject:
    """A triangle 60 units wide, whose depth grows so much a unit."""
    ends = ((-30, -30), (30, -30), (0, 30))
    return triangle([(x, y, -depth - across * x - up * y) for x, y in ends])


def test_surfaces_that_coincide_to_the_depth_buffers_last_place_meet_everywhere():
    """To 4e-6 of their depth. The second one's depth changes by 1e-5 of itself a pixel each way."""
    lines = Discontinuities(flatten(Scene((wall(50), wall(50, 3.2e-4, 3.2e-4)))), CAMERA, SIZE)
    j = 15.5 + np.array([0.0, 0.38, 0.42, -0.38, -0.42, 3.0])
    i = np.full(6, 11.5)
    found = lines.meeting_px(np.zeros(6, int), np.ones(6, int), i, j, np.full(6, 50.0))
    wanted = np.array([0, 0, 0.42, 0, 0.42, 3.0]) / np.sqrt(2)
    np.testing.assert_allclose(found, wanted, rtol=0.05)


@pytest.mark.parametrize("camera", [CAMERA, replace(CAMERA, projection="parallel")])
@pytest.mark.parametrize(("off", "cut"), [(0.9e-6, True), (1.1e-6, False)])
def test_a_surface_in_a_clip_plane_is_cut_everywhere(camera, off, cut):
    """No line is to be seen there, and float32 decides for all of it."""
    pixel = np.zeros(1, int), np.array([5]), np.array([20])
    flat = flatten(Scene((wall(2),)))
    for side in (-1, 1):
        for name in ("near", "far"):
            limit = {name: 2 * (1 + side * off)}
            distance = Discontinuities(flat, replace(camera, **limit), SIZE).clip_px(
                *pixel, np.full(1, 2.0)
            )
            assert (distance[0] == 0) == cut
            assert cut or distance[0] > 1e3


@pytest.mark.parametrize("order", [(0, 1, 2), (1, 0, 2)])
@pytest.mark.parametrize("side", [-1, 1])
def test_a_cell_reaches_a_thousandth_beyond_the_surface(order, side):
    """On the side away from the viewer: so that a face that lies in a border has one colour. The
    wall crosses the border z = 0.5 at x = 0, which is seen where the wall is 1/1000 behind it."""
    corners = [(-0.3, -0.3, 0.497), (0.3, -0.3, 0.503), (0, 0.4, 0.5)]
    checkered = triangle(corners, order, checker=Checker(size=1.0))
    eye = (0.0, 0.0, 2.5 * side + 0.5)
    camera = replace(CAMERA, eye=eye, w=(0, 0, side), u=(side, 0, 0))
    lines = Discontinuities(flatten(Scene((checkered,))), camera, SIZE)
    i, j = np.full(3, 11.5), 15.5 + np.array([1.0, 1.28, 2.0])
    found = lines.checker_px(np.zeros(3, int), i, j, np.full(3, 2.5))
    np.testing.assert_allclose(found, [0.28, 0.0, 0.72], atol=0.01)


LARGE = [(40, 393, 600), (40, -157, 700), (900, -7, 600)], (40, -7, 900), 500
DISTANT = [(7, 2, 3), (7, 6, 3), (10, 2, -9)], (7, 4, 1000), 13


@pytest.mark.parametrize(("part", "touched"), [(0.9, True), (1.1, False)])
@pytest.mark.parametrize("order", [(0, 1, 2), (1, 0, 2), (2, 0, 1), (1, 2, 0)])
@pytest.mark.parametrize(("corners", "eye", "of"), [LARGE, DISTANT], ids=["large", "distant"])
def test_an_edge_is_known_to_a_part_of_its_distance_or_of_its_size(
    corners, eye, of, order, part, touched
):
    """2^-21 of its farther end's distance from the eye (500), or of the diagonal of the object's
    box (3, 4, 12) where that is less. The ray passes the first edge by a part of that."""
    lines = Discontinuities(
        flatten(Scene((triangle(corners, order),))),
        replace(CAMERA, eye=(eye[0] - part * of * 2**-21, *eye[1:]), viewport=(-1e-6, 1e-6) * 2),
        (33, 33),
    )
    middle = np.array([16])
    distance = lines.outline_px(np.zeros(1, int), middle, middle)
    assert (distance[0] == 0) == touched


def test_beyond_its_end_an_edge_is_not_touched():
    """The ray passes 50 units above or below the edge's ends, on the line through them."""
    corners, (x, _, z), _ = LARGE
    for y in (443, -207):
        camera = replace(CAMERA, eye=(x, y, z), viewport=(-1e-6, 1e-6) * 2)
        lines = Discontinuities(flatten(Scene((triangle(corners),))), camera, (33, 33))
        middle = np.array([16])
        assert lines.outline_px(np.zeros(1, int), middle, middle)[0] > 1e3


NARROW = replace(CAMERA, viewport=(-1e-6, 1e-6) * 2)
# Looks along (-1, 0, -1) from 2 units to the right: straight ahead for what is 2 units away.
SKEWED = replace(
    NARROW, projection="parallel", w=(1, 0, 1), viewport=(2 - 1e-6, 2 + 1e-6, -1e-6, 1e-6)
)


@pytest.mark.parametrize("camera", [NARROW, SKEWED], ids=["perspective", "parallel"])
@pytest.mark.parametrize("axis", [0, 1])
@pytest.mark.parametrize(("part", "on_it"), [(0.9, True), (1.1, False)])
def test_a_cells_border_is_known_to_a_part_of_the_hits_distance(camera, axis, part, on_it):
    """2^-21 of 2 units; of an object that lies 90 cells of 0.3 units beside the world's origin."""
    eye = np.array([27.0, 27.0, 30.0])
    eye[axis] += 0.15 + part * 2 * 2**-21  # cells are centred: beside a border
    moved = np.array([(1, 0, 0, 27), (0, 1, 0, 27), (0, 0, 1, 0), (0, 0, 0, 1.0)])
    mesh = Mesh([(-9, -9, 28), (9, -9, 28), (0, 20, 28)], [[0, 1, 2]], transform=moved)
    checkered = SceneObject(mesh, Material(checker=Checker(size=0.3)))
    lines = Discontinuities(flatten(Scene((checkered,))), replace(camera, eye=tuple(eye)), (33, 33))
    middle = np.array([16])
    distance = lines.checker_px(np.zeros(1, int), middle, middle, np.full(1, 2.0))
    assert (distance[0] == 0) == on_it


@pytest.mark.parametrize("projection", ["perspective", "parallel"])
@pytest.mark.parametrize(("part", "cut"), [(0.9, True), (1.1, False)])
def test_an_eye_on_a_surface_is_known_to_a_part_of_the_largest_coordinate(projection, part, cut):
    """1e-12 of the wall's 30 units, whatever the unit of ray parameters is."""
    corners = [(-30, -30, 20), (30, -30, 20), (0, 30, 20)]
    camera = replace(
        CAMERA, eye=(0, 0, 20 + part * 30e-12), w=(0, 0, 0.5), distance=4, projection=projection
    )
    lines = Discontinuities(flatten(Scene((triangle(corners),))), camera, SIZE)
    pixel = np.zeros(1, int), np.array([5]), np.array([20])
    distance = lines.clip_px(*pixel, np.full(1, 1.0))
    assert (distance[0] == 0) == cut


@pytest.mark.parametrize("order", [(0, 1, 2), (1, 0, 2), (2, 0, 1), (1, 2, 0)])
def test_an_eye_that_lies_on_an_edge_sees_it_everywhere(order):
    """As far as float32 knows: 2^-21 of 300 before and behind the eye."""
    known = 300 * 2**-21
    for back, touched in ((-0.9, True), (0.9, True), (1.1, False)):
        corners = [(-300, 0, 0), (300, 0, 0), (0, -400, 400)]
        camera = replace(CAMERA, eye=(0, 0, -back * known), viewport=(-1e-6, 1e-6) * 2)
        lines = Discontinuities(flatten(Scene((triangle(corners, order),))), camera, (33, 33))
        middle = np.array([16])
        distance = lines.outline_px(np.zeros(1, int), middle, middle)
        assert (distance[0] == 0) == touched, back


def away_px(corners, i: int, j: int) -> float:
    """From a triangle's nearest edge."""
    lines = Discontinuities(flatten(Scene((triangle(corners),))), CAMERA, SIZE)
    return float(lines.outline_px(np.zeros(1, int), np.array([i]), np.array([j]))[0])


def test_an_edge_as_near_as_what_is_unknown_of_it_is_met(monkeypatch):
    corners = ((-0.3, -0.2, -1.0), (0.3, -0.2, -1.0), (0.0, 0.3, -1.0))
    monkeypatch.setattr("renderer.edges.unknown_edge_px", lambda *_: np.zeros(1))
    away = away_px(corners, 11, 16)
    assert away > 2
    for unknown, found in ((away, 0.0), (0.99 * away, away)):
        monkeypatch.setattr("renderer.edges.unknown_edge_px", lambda *_, u=unknown: np.full(1, u))
        assert away_px(corners, 11, 16) == found


@pytest.mark.parametrize("across", [(1.0, 0.25, 0.0), (1.0, 0.0, -4.0)])  # ahead; from behind
def test_a_ray_through_an_edge_touches_it_wherever_in_the_image(monkeypatch, across):
    """The image's first pixel, whose ray is longer than 1; all numbers are exact in float32."""
    monkeypatch.setattr("renderer.edges.unknown_edge_px", lambda *_: np.full(1, -1.0))
    met, way = 2 * np.array([-0.484375, 0.359375, -1.0]), np.array(across)
    beside, above = np.array([0.0, 1.0, -1.0]), np.array([0.0, 1e-4, 0.0])
    assert away_px((met - way, met + way, met + beside), 0, 0) == 0
    near = met + above
    assert away_px((near - way, near + way, near + beside), 0, 0) > 0
