"""A hit's colour, taken apart, at its ends: lights in, behind and beside the surface."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from lucida.app.instruments.probe.shading import SurfaceHit, hit_at, shade
from lucida.renderer.scene.flat import flatten
from lucida.renderer.scene.material import Material
from lucida.renderer.scene.model import (
    DirectionalLight,
    Mesh,
    PointLight,
    Scene,
    SceneObject,
    Sphere,
)

# Seen from above: the ray goes down, the normal is up.
HIT = SurfaceHit(
    0, 0, 1.0, 0.0, 0.0, (0.0, -2.0, 0.0), (0.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 1.0, 0.0), ()
)
WHITE = (1.0, 1.0, 1.0)


def lit(*lights, shininess: float = 2.0, ambient=(0.0, 0.0, 0.0)):
    material = Material((0.5, 0.25, 1.0), (0.5, 0.5, 0.5), shininess)
    ball = SceneObject(Sphere((0, -1, 0), 1), material)
    return flatten(Scene((ball,), lights, ambient=ambient))


def test_normals_that_differ_by_more_than_rounding_are_two() -> None:
    assert not HIT.has_own_normal
    assert not replace(HIT, normal=(5e-10, 1.0, 0.0)).has_own_normal
    assert replace(HIT, normal=(0.0, 1.0, 2e-9)).has_own_normal
    assert replace(HIT, normal=(-1.0, 0.0, 0.0)).has_own_normal


def test_a_hit_is_where_the_ray_is_at_t() -> None:
    ball = Scene((SceneObject(Sphere((9, 9, 9), 1)), SceneObject(Sphere((0, 0, -5), 1))))
    found = hit_at(flatten(ball), (0, 0, 1), (0, 0, -2), (2.5, 1, 0.0, 0.0))
    assert found == SurfaceHit(1, 1, 2.5, 0, 0, (0, 0, -2), (0, 0, -4), (0, 0, 1), (0, 0, 1))
    assert not found.has_own_normal


def test_the_normals_of_a_smooth_triangles_corners() -> None:
    """All of them or none: a row of 0 makes the triangle flat."""
    corners, up = [[0, 0, 0], [4, 0, 0], [0, 4, 0], [4, 4, 0]], [0, 0, 1]
    normals = [up, [0.6, 0, 0.8], up, [0, 0, 0]]
    mesh = Mesh(corners, [[0, 1, 2], [1, 3, 2]], normals=normals)
    flat = flatten(Scene((SceneObject(Sphere((9, 9, 9), 1)), SceneObject(mesh))))

    def corner_normals(primitive: int):
        ray = (1, 1, 5), (0, 0, -1)
        return hit_at(flat, *ray, (5.0, primitive, 0.25, 0.25)).corner_normals

    np.testing.assert_allclose(corner_normals(0), normals[:3], rtol=1e-7)
    assert corner_normals(1) == corner_normals(2) == ()


def test_each_light_gives_its_terms() -> None:
    """From straight above, and from 60 degrees aside: n.l = 1/2, n.h = cos 30."""
    aside = (math.sin(math.radians(60)), 0.5, 0.0)
    flat = lit(
        PointLight((0, 4, 0), (1.0, 0.5, 0.25)),
        DirectionalLight(tuple(-x for x in aside), WHITE),
        ambient=(0.25, 0.5, 0.5),
    )
    found = shade(flat, HIT)
    above, sun = found.lamps
    assert (found.albedo, found.specular, found.shininess) == ((0.5, 0.25, 1.0), (0.5,) * 3, 2.0)
    assert found.ambient == (0.125, 0.125, 0.5)
    assert (above.number, above.is_point, above.place) == (0, True, (0, 4, 0))
    assert (above.to_light, above.half, above.n_dot_l, above.n_dot_h) == (
        (0, 1, 0),
        (0, 1, 0),
        1,
        1,
    )
    assert (above.diffuse, above.specular) == ((0.5, 0.125, 0.25), (0.5, 0.25, 0.125))
    assert (sun.number, sun.is_point) == (1, False)
    assert sun.to_light == sun.place == pytest.approx(aside)
    assert sun.half == pytest.approx((0.5, math.cos(math.radians(30)), 0))
    assert (sun.n_dot_l, sun.n_dot_h) == pytest.approx((0.5, math.sqrt(0.75)))
    assert sun.diffuse == pytest.approx((0.25, 0.125, 0.5))
    assert sun.specular == pytest.approx((0.375,) * 3)
    assert found.color == pytest.approx((1.75, 1.0, 1.75))


def test_a_light_in_the_hit_itself_is_left_out() -> None:
    """The others keep their numbers."""
    lights = PointLight((0, 1e-13, 0)), PointLight((0, 2e-12, 0)), PointLight((0, 2, 0))
    found = shade(lit(*lights), HIT)
    assert [lamp.number for lamp in found.lamps] == [1, 2]
    assert found.lamps[0].diffuse == found.lamps[1].diffuse
    assert found.color == pytest.approx(tuple(2 * (k + 0.5) for k in (0.5, 0.25, 1.0)))


def test_shadowed_lights_give_nothing_but_are_told() -> None:
    asked = []

    def is_lit(*given) -> bool:
        asked.append(given)
        return given[2] < math.inf

    flat = lit(DirectionalLight((0, -1, 0)), PointLight((0, 4, 0)))
    sun, lamp = shade(flat, HIT, is_lit).lamps
    assert asked == [(HIT, (0, 1, 0), math.inf), (HIT, (0, 1, 0), 4)]
    assert (sun.is_lit, sun.diffuse, sun.specular) == (False, (0, 0, 0), (0, 0, 0))
    assert sun.n_dot_l == 1
    assert lamp.is_lit and lamp.diffuse == (0.5, 0.25, 1)
    np.testing.assert_allclose(shade(flat, HIT, is_lit).color, (1, 0.75, 1.5))
