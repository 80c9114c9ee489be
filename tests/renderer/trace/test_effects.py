"""Shadows and mirrors against answers on paper."""

import numpy as np
import pytest

from lucida.renderer.camera.camera import Camera
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
from lucida.renderer.trace import Tracer

FLOOR = Mesh([[-9, 0, -9], [9, 0, -9], [9, 0, 9], [-9, 0, 9]], [[0, 2, 1], [0, 3, 2]])
CAMERA = Camera.look_at((1, 4, 6), (0, 0.4, 0), fov_y_deg=50)
SIZE = (120, 120)
CENTER, RADIUS = np.array([0.2, 1.3, -0.3]), 0.8


def balls_distance(origin, direction):
    """Return the distance at which rays pass the ball's surface, ahead of their origins.

    It is negative for a hit.
    """
    unit = direction / np.linalg.norm(direction, axis=-1, keepdims=True)
    to_center = CENTER - origin
    ahead = np.maximum(np.einsum("...k,...k->...", to_center, unit), 0)
    return np.linalg.norm(to_center - ahead[..., None] * unit, axis=-1) - RADIUS


def floor_points(depth):
    origin, direction = CAMERA.rays(SIZE)
    return origin + depth[..., None] * direction


@pytest.mark.parametrize(
    "light", [PointLight((2, 5, 1)), PointLight((0.2, 1.6, -0.3)), DirectionalLight((1, -2, 0.5))]
)
def test_a_ball_throws_its_shadow(light):
    """The second light is inside the ball: all the floor is in the dark."""
    diffuse = Material((0.5, 0.6, 0.7))
    ball = SceneObject(Sphere(tuple(CENTER), RADIUS), diffuse)
    scene = Scene((SceneObject(FLOOR, diffuse), ball), (light,), ambient=(0.1, 0.1, 0.1))
    with Tracer(scene) as plain, Tracer(scene, shadows=True) as tracer:
        without = plain.render(CAMERA, SIZE)
        frame = tracer.render(CAMERA, SIZE)
    assert np.array_equal(frame.id, without.id)
    assert np.array_equal(frame.depth, without.depth)
    floor = frame.id == 0
    points = floor_points(np.where(floor, frame.depth, 1.0))
    if isinstance(light, PointLight):
        to_light = np.asarray(light.position) - points
    else:
        to_light = np.broadcast_to(-np.asarray(light.direction, float), points.shape)
    distance = balls_distance(points, to_light)
    dark, lit = floor & (distance < -1e-3), floor & (distance > 1e-3)
    assert np.count_nonzero(dark) > 200
    assert np.allclose(frame.color[dark], 0.1 * np.array([0.5, 0.6, 0.7]), atol=1e-6)
    assert np.array_equal(frame.color[lit], without.color[lit])


def test_what_lies_behind_a_light_throws_no_shadow():
    roof = Mesh(FLOOR.vertices + np.float32([0, 5, 0]), FLOOR.faces)
    scene = Scene((SceneObject(FLOOR), SceneObject(roof)), (PointLight((0, 4, 0)),))
    camera = Camera.look_at((1, 4.5, 6), (0, 0, 0), fov_y_deg=40)
    with Tracer(scene) as plain, Tracer(scene, shadows=True) as tracer:
        assert np.array_equal(plain.render(camera, SIZE).color, tracer.render(camera, SIZE).color)


@pytest.mark.parametrize("smooth", [False, True])
def test_no_surface_shadows_itself(smooth):
    """Seen from the light, everything is lit."""
    random = np.random.default_rng(3)
    corners = random.uniform(-1, 1, (60, 1, 3)) + random.normal(scale=0.3, size=(60, 3, 3))
    vertices, faces = corners.reshape(-1, 3), np.arange(180).reshape(-1, 3)
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    flat = np.cross(b - a, c - a)
    normals = np.repeat(flat / np.linalg.norm(flat, axis=1, keepdims=True), 3, axis=0)
    mesh = Mesh(vertices, faces, normals if smooth else None)
    for distance in (4.0, 400.0):
        eye = np.array([0.6, 0.5, 0.62]) * distance
        scene = Scene(
            (SceneObject(mesh), SceneObject(Sphere((0, 0, 0), 0.4))), (PointLight(tuple(eye)),)
        )
        camera = Camera.look_at(eye, (0, 0, 0), fov_y_deg=120 / distance)
        with Tracer(scene) as plain, Tracer(scene, shadows=True) as tracer:
            lit, shadowed = (one.render(camera, SIZE).color for one in (plain, tracer))
        differs = np.abs(lit - shadowed).max(axis=2) > 1e-6
        # Rays that start a little off the surface pass an outline a little differently.
        assert differs.mean() < 0.002


@pytest.mark.parametrize("at", [(0, 0, 0), (1e4, -3e3, 1e5)])
@pytest.mark.parametrize("distance", [8.0, 1e5])
def test_far_away_nothing_that_the_light_sees_is_in_the_dark(at, distance):
    """Seen from the light; the scene's place in the world does not matter, nor how far that is."""
    eye = np.array([0.6, 0.5, 0.62]) * distance + at
    move = np.eye(4)
    move[:3, 3] = at
    objects = (
        SceneObject(Mesh(FLOOR.vertices, FLOOR.faces, transform=move)),
        SceneObject(Sphere(tuple(CENTER + at), RADIUS)),
    )
    scene = Scene(objects, (PointLight(tuple(eye)),))
    camera = Camera.look_at(eye, at, fov_y_deg=300 / distance)
    with Tracer(scene) as plain, Tracer(scene, shadows=True) as tracer:
        lit, shadowed = (one.render(camera, SIZE).color for one in (plain, tracer))
    assert shadowed.mean() == pytest.approx(lit.mean(), rel=1e-3)
    assert lit.mean() > 0.1


def test_a_mirror_shows_what_the_reflected_ray_hits():
    mirror = Material((0, 0, 0), (1, 1, 1))
    ball = Material((0.9, 0.4, 0.2))
    scene = Scene(
        (SceneObject(FLOOR, mirror), SceneObject(Sphere(tuple(CENTER), RADIUS), ball)),
        ambient=(1, 1, 1),
        background=(0.1, 0.2, 0.3),
    )
    with Tracer(scene, mirror_depth=1) as tracer:
        frame = tracer.render(CAMERA, SIZE)
    floor = frame.id == 0
    points = floor_points(np.where(floor, frame.depth, 1.0))
    _, direction = CAMERA.rays(SIZE)
    distance = balls_distance(points, direction * [1, -1, 1])
    hit, missed = floor & (distance < -1e-3), floor & (distance > 1e-3)
    assert np.count_nonzero(hit) > 200
    assert np.allclose(frame.color[hit], (0.9, 0.4, 0.2), atol=1e-6)
    assert np.allclose(frame.color[missed], (0.1, 0.2, 0.3), atol=1e-6)
    assert np.allclose(frame.color[frame.id == 1], (0.9, 0.4, 0.2), atol=1e-6)


def test_mirrors_add_no_more_than_their_bounces():
    mirror = Material((0.2, 0.2, 0.2), (0.5, 0.5, 0.5))
    roof = Mesh(FLOOR.vertices + np.float32([0, 5, 0]), FLOOR.faces)
    scene = Scene((SceneObject(FLOOR, mirror), SceneObject(roof, mirror)), ambient=(1, 1, 1))
    means = []
    for depth in (0, 1, 2, 16):
        with Tracer(scene, mirror_depth=depth) as tracer:
            means.append(tracer.render(Camera.look_at((0, 2, 1), (0, 0, 0)), (20, 20)).color)
    assert np.allclose(means[0], 0.2, atol=1e-6)
    assert np.allclose(means[1][8:12], 0.3, atol=1e-4)
    assert np.allclose(means[2][8:12], 0.35, atol=1e-4)
    assert (means[3] <= 0.4 + 1e-4).all()


def test_wrong_settings_are_named():
    scene = Scene(())
    for depth in (-1, 17, 1.5, True):
        with pytest.raises(LucidaError, match="mirror_depth"):
            Tracer(scene, mirror_depth=depth)
    with pytest.raises(LucidaError, match="method"):
        Tracer(scene, method="fast")
    with pytest.raises(LucidaError, match="neither shadows"):
        Tracer(scene, method="reference", shadows=True)
