"""Scenes far from the world's origin look as they do at the origin, in all renderers.

Between 1e3 and 1e6 units off they are as exact as there; up to 1e9 the renderers agree.
"""

from dataclasses import replace

import numpy as np
import pytest
from agreeing import agree
from scenes import ODD, crowd, moved, placed
from trace_reference import ball

from lucida import Camera, Rasterizer, Tracer
from lucida.renderer.compare.raster_and_ray import CHANNELS
from lucida.renderer.scene import shapes
from lucida.renderer.scene.material import Material
from lucida.renderer.scene.model import (
    Checker,
    DirectionalLight,
    Mesh,
    PointLight,
    Scene,
    SceneObject,
)

SIZE = (96, 64)
FARS = [1e3, 1e6]
VIEWS = ["perspective", "parallel", "inside", "clipped"]
# Of hits, normals and colours: the translation itself, rounded in float64, moves things by 1e-10.
SAME = {"depth": 2e-5, "normal": 2e-4, "color": 2e-3}


def camera_of(view, by=0.0):
    eye, target = np.array([1.5, 1.4, 3.1]) + by, np.array([0.2, 0.1, 0.0]) + by
    if view == "inside":
        eye = np.array([0.21, 0.61, -0.58]) + by  # in a sphere
    camera = Camera.look_at(eye, target, fov_y_deg=50, aspect=1.5)
    if view == "parallel":
        return replace(camera, projection="parallel", viewport=(-1.8, 1.8, -1.2, 1.2))
    return replace(camera, near=2.9, far=4.1) if view == "clipped" else camera


@pytest.mark.parametrize("view", VIEWS)
@pytest.mark.parametrize("far", FARS)
def test_a_translated_scene_looks_as_before(view, far):
    scene, by = crowd(), far * ODD
    here = agree(scene, camera_of(view))
    there = agree(moved(scene, by), camera_of(view, by))
    for first, second in zip(here, there, strict=True):
        same = first.id == second.id
        assert same.mean() > 0.997
        hit = same & (first.id >= 0)
        assert hit.any()
        for name, tolerance in SAME.items():
            wrong = np.abs(first.channel(name)[hit] - second.channel(name)[hit]) > tolerance
            # Borders of checkers and outlines: a pixel's centre may lie within 1e-9 of one.
            assert wrong.mean() < 2e-3, (name, np.argwhere(wrong)[:5])


@pytest.mark.parametrize("far", [1e4, 1e6])
def test_shadows_and_mirrors_of_a_translated_scene_look_as_before(far):
    scene, by = crowd(), far * ODD
    frames = []
    for shown, shift in ((scene, 0.0 * by), (moved(scene, by), by)):
        with Tracer(shown, shadows=True, mirror_depth=2) as tracer:
            frames.append(tracer.render(camera_of("perspective", shift), SIZE))
    wrong = np.abs(frames[0].color - frames[1].color).max(axis=2) > 2e-3
    assert wrong.mean() < 3e-3, np.argwhere(wrong)[:5]
    with Tracer(scene) as tracer:  # they are to be seen at all
        plain = tracer.render(camera_of("perspective"), SIZE)
    assert (np.abs(plain.color - frames[0].color).max(axis=2) > 0.02).mean() > 0.1


def test_objects_at_opposite_ends_of_a_scene_are_both_exact():
    parts = [moved(crowd(), sign * 1e6 * ODD) for sign in (-1, 1)]
    scene = replace(
        parts[0],
        objects=parts[0].objects + parts[1].objects,
        lights=parts[0].lights[:2] + parts[1].lights,
    )
    for sign in (-1, 1):
        for view in ("perspective", "parallel"):
            agree(scene, camera_of(view, sign * 1e6 * ODD))


@pytest.mark.parametrize("turn_deg", [0.0, 37.0])
@pytest.mark.parametrize("view", ["perspective", "parallel"])
def test_a_small_thing_beside_a_large_one(view, turn_deg):
    """A kilometre of ground, turned with all that stands on it, seen from a hand above it."""
    matrix = placed(ball(), 1e5, 2e5, -3e5, turn_deg).transform
    ground = shapes.box((1e3, 0.5, 1e3))
    thing = ball(16, 24)
    stand, small = np.eye(4), np.eye(4)
    stand[:3, 3] = 0, -0.25, 0
    small[:3, :3] *= 0.02
    small[:3, 3] = 333.0, 0.02, -271.0
    white = Material(checker=Checker(size=0.01))
    scene = Scene(
        (
            SceneObject(replace(ground, transform=matrix @ stand), white),
            SceneObject(replace(thing, transform=matrix @ small), Material((0.7, 0.3, 0.2))),
        ),
        (PointLight(tuple(matrix[:3] @ [333.1, 0.1, -270.9, 1])),),
    )
    eye, target, up = (
        matrix[:3] @ np.array(p)
        for p in ([333.1, 0.08, -270.8, 1], [333, 0.01, -271, 1], [0, 1, 0, 0])
    )
    camera = Camera.look_at(eye, target, up, fov_y_deg=40, aspect=1.5)
    if view == "parallel":
        camera = replace(camera, projection="parallel", viewport=(-0.09, 0.09, -0.06, 0.06))
    agree(scene, camera)


def test_a_close_look_at_a_large_turned_mesh():
    """The rasterizer, too, sees the mesh's own vertices: none that were rounded in the world."""
    steps = np.linspace(-1e3, 1e3, 41)
    x, z = (axis.ravel() for axis in np.meshgrid(steps, steps))
    vertices = np.stack([x, 20 * np.sin(x / 90) * np.cos(z / 70), z], axis=1)
    k = (np.arange(40)[:, None] * 41 + np.arange(40)).ravel()
    faces = np.concatenate([np.stack(c, 1) for c in ((k, k + 41, k + 1), (k + 1, k + 41, k + 42))])
    mesh = placed(Mesh(vertices, faces), 3e4, 1e4, -2e4, 61)
    scene = Scene((SceneObject(mesh),), (DirectionalLight((-1, -2, -1)),))
    for corner in (820, 1000, 300):
        point = mesh.transform[:3] @ [*mesh.vertices[corner].astype(float), 1]
        eye = mesh.transform[:3] @ [*(mesh.vertices[corner] + np.float32([0.02, 0.05, 0.03])), 1]
        agree(scene, Camera.look_at(eye, point, fov_y_deg=60, aspect=1.5))


@pytest.mark.parametrize("view", ["perspective", "parallel", "inside"])
def test_renderers_agree_at_1e9_and_hold_numbers_beyond(view):
    """At 1e9 float64 has steps of 1e-7: the renderers still agree. Beyond, images become coarse,
    but hold numbers."""
    by = 1e9 * ODD
    agree(moved(crowd(), by), camera_of(view, by))
    for far in (1e10, 1e11, 1e12):
        by = far * ODD
        scene, camera = moved(crowd(), by), camera_of(view, by)
        with Rasterizer(scene) as rasterizer, Tracer(scene, shadows=True, mirror_depth=1) as tracer:
            for renderer in (rasterizer, tracer):
                frame = renderer.render(camera, SIZE, channels=CHANNELS)
                assert np.isfinite(frame.color).all()
                assert np.isfinite(frame.normal).all()
                assert not np.isnan(frame.depth).any()
        if far < 1e11:
            assert (frame.id >= 0).mean() > 0.3


def test_single_rays_start_anywhere():
    by = 1e6 * ODD
    scene, camera = moved(crowd(), by), camera_of("perspective", by)
    origins, directions = (part.reshape(-1, 3) for part in camera.rays(SIZE))
    with Tracer(scene) as tracer:
        t, primitive = tracer.closest_hits(origins, directions)
        frame = tracer.render(camera, SIZE, channels=CHANNELS)
    same = primitive == frame.primitive.ravel()
    assert same.mean() > 0.99
    seen = same & (primitive >= 0)
    np.testing.assert_allclose(t[seen], frame.depth.ravel()[seen], rtol=1e-4)
