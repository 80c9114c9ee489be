"""The probe's look-ups along a ray, at their borders: clip planes, shadows, mirrored rays."""

from __future__ import annotations

import math
from types import SimpleNamespace

import numpy as np
import pytest

from lucida.app.instruments.probe.model import Probe, winner_of
from lucida.app.instruments.probe.reading import BEHIND, FAR, HIDDEN, NEAR, SEEN, Reading
from lucida.app.instruments.probe.shading import SurfaceHit
from lucida.renderer.camera.camera import Camera
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
from lucida.renderer.system.errors import LucidaError
from lucida.renderer.trace.tiles.effects import effects_of

MIRROR = Material((0.5, 0.5, 0.5), (0.5, 0.5, 0.5))
CORNERS = [[-9, 0, -9], [9, 0, -9], [9, 0, 9], [-9, 0, 9]]
FACES = [[0, 2, 1], [0, 3, 2]]
FLOOR = Mesh(CORNERS, FACES)


def read(scene: Scene, eye=(0, 2, 0), way=(0, -1, 0), **arguments) -> Reading:
    """Read the ray from the eye in that direction; a parallel camera's only one."""
    w = -np.array(way, float)
    u = np.cross(w, (1, 0, 0) if abs(w[0]) < 0.5 else (0, 0, 1))
    camera = Camera(eye, tuple(u), tuple(np.cross(w, u)), tuple(w), projection="parallel")
    return Probe(scene).at((0, 0), camera, (1, 1), **arguments)


def standings(*spheres: tuple[float, float], **clip: float) -> list[list[str]]:
    """Return the standings of spheres straight ahead of the eye, by their distance and radius."""
    objects = tuple(SceneObject(Sphere((0, 0, -away), radius)) for away, radius in spheres)
    reading = Probe(Scene(objects)).at((0, 0), Camera(**clip), (1, 1))
    by_number = sorted(reading.meetings, key=lambda meeting: meeting.object)
    return [[crossing.standing for crossing in meeting.crossings] for meeting in by_number]


def test_an_empty_scene_and_a_pixel_that_is_not_there():
    probe = Probe(Scene(()))
    assert probe.at((3, 2), Camera.canonical(), (64, 48)).meetings == ()
    for pixel in ((-1, 0), (0, -1), (48, 0), (0, 64)):
        with pytest.raises(LucidaError, match="outside 64x48"):
            probe.at(pixel, Camera.canonical(), (64, 48))


def test_crossings_on_the_clip_planes_are_cut_off():
    assert standings((1, 1)) == [[BEHIND, SEEN]]  # the eye is on it
    assert standings((3, 1), near=2, far=4) == [[NEAR, FAR]]
    assert standings((3, 1), near=1.9, far=4.1) == [[SEEN, HIDDEN]]
    assert standings((1, 0.5), near=2) == [[NEAR, NEAR]]
    assert standings((-3, 1), near=2) == [[BEHIND, BEHIND]]
    found = SimpleNamespace(t=np.array([1.0, 2.0, 3.0]))
    ranges = {(0, math.inf): 0, (1, 3): 1, (2, 3): -1, (0, 1): -1, (2.5, 3.5): 2}
    assert {t_range: winner_of(found, t_range) for t_range in ranges} == ranges


def test_what_is_cut_off_stands_before_what_is_missed():
    places = [(5, 0, -3), (0, 0, -8), (0, 0, 4), (5, 0, 0), (0, 0, -3)]
    scene = Scene(tuple(SceneObject(Sphere(at, 1)) for at in places))
    reading = Probe(scene).at((0, 0), Camera(far=6), (1, 1))
    assert [meeting.object for meeting in reading.meetings] == [4, 2, 1, 0, 3]


# Shadows.


def lit(*lights: PointLight | DirectionalLight, blocker: Mesh | None = None) -> list[bool]:
    """Return which lights reach (0, 0, 0) on a floor."""
    shapes = [FLOOR] if blocker is None else [FLOOR, blocker]
    scene = Scene(tuple(SceneObject(shape) for shape in shapes), lights)
    # From the side: what is above the point is not in the way of the view.
    reading = read(scene, (2, 2, 0), (-1, -1, 0), shadows=True)
    assert reading.hit is not None and reading.hit.object == 0
    assert reading.hit.point == pytest.approx((0, 0, 0), abs=1e-12)
    assert reading.shading is not None
    return [lamp.is_lit for lamp in reading.shading.lamps]


def test_a_light_in_the_surfaces_plane_or_below_gives_none():
    lights = [PointLight((0, y, 5)) for y in (1, 0, -1)]
    assert lit(*lights) == [True, False, False]
    ways = [DirectionalLight((0, y, -1)) for y in (-1, 0, 1)]
    assert lit(*ways) == [True, False, False]


def plate(y: float, z: float, normal: tuple[float, float] = (1, 0)) -> Mesh:
    """A small one about (0, y, z); its normal's y and z: level, if not told."""
    up, across = normal
    transform = np.eye(4)
    transform[1:3, 1], transform[1:3, 2], transform[1:3, 3] = (up, across), (-across, up), (y, z)
    return Mesh(CORNERS, FACES, transform=transform @ np.diag([0.02, 1, 0.02, 1]))


@pytest.mark.parametrize("height", [0.25, 1.0, 3.0])
def test_what_is_between_shadows_however_near(height):
    light, sun = PointLight((0, 4, 0)), DirectionalLight((0, -1, 0))
    assert lit(light, sun, blocker=plate(height, 0)) == [False, False]
    # Beyond a point light nothing shadows; nor beside the way.
    assert lit(light, sun, blocker=plate(5, 0)) == [True, False]
    assert lit(light, sun, blocker=plate(height, 3)) == [True, True]


# Mirrored rays.


def smooth(normal: tuple[float, float, float]) -> Mesh:
    return Mesh(CORNERS, FACES, normals=[normal] * 4)


def bounce_of(mesh: Mesh):
    reading = read(Scene((SceneObject(mesh, MIRROR),)), mirror_depth=3)
    assert isinstance(reading.hit, SurfaceHit)
    (bounce,) = reading.bounces  # it leaves the scene: none follows
    return bounce


def test_mirrored_rays_follow_the_smooth_normal_unless_that_is_into_the_surface():
    """Straight down onto a floor whose normals lean: 2 (n.l) n - l."""
    assert bounce_of(FLOOR).direction == (0, 1, 0)
    assert bounce_of(smooth((0.28, 0.96, 0))).direction == pytest.approx((0.5376, 0.8432, 0))
    # With a normal of (0.8, 0.6, 0) it were (0.96, -0.28, 0): the plane's is taken.
    assert bounce_of(smooth((0.8, 0.6, 0))).direction == pytest.approx((0, 1, 0))
    lean = Scene((SceneObject(smooth((0.8, 0.6, 0)), MIRROR),))
    (slanting,) = read(lean, way=(1, -2, 0), mirror_depth=1).bounces
    assert slanting.direction == pytest.approx((1, 2, 0))
    bounce = bounce_of(FLOOR)
    scene = Scene((SceneObject(FLOOR, MIRROR),))
    away = float(effects_of(True, 3, flatten(scene).bounds).away)
    assert bounce.origin == (0, away, 0) and away > 0
    assert bounce.hit is None and bounce.shading is None
    assert bounce.weight == (0.5, 0.5, 0.5) and bounce.color == pytest.approx(scene.background)


def test_between_two_mirrors_light_fades_as_often_as_asked_for():
    ceiling = Mesh([[x, 1, z] for x, _, z in CORNERS], FACES)
    half, dull = Material((0, 0, 0), (0.5, 0.25, 0)), Material((0.5, 0.5, 0.5))
    scene = Scene((SceneObject(FLOOR, half), SceneObject(ceiling, half)))

    def weights(scene: Scene, depth: int) -> list[tuple[float, ...]]:
        reading = read(scene, (0, 0.5, 0), mirror_depth=depth)
        seen = [bounce.hit.object for bounce in reading.bounces if bounce.hit]
        assert seen == [1, 0, 1, 0][: len(seen)]
        return [bounce.weight for bounce in reading.bounces]

    assert weights(scene, 0) == []
    assert weights(scene, 3) == [(0.5, 0.25, 0), (0.25, 0.0625, 0), (0.125, 0.015625, 0)]
    # What sees nothing mirrored sends no further ray, not one of no light.
    assert weights(Scene((SceneObject(FLOOR, half), SceneObject(ceiling, dull))), 3) == [
        (0.5, 0.25, 0)
    ]
    assert weights(Scene((SceneObject(FLOOR, dull), SceneObject(ceiling, half))), 3) == []
