"""The object that a ray meets first, against the tracer's images."""

from __future__ import annotations

import numpy as np
import pytest

from lucida import Tracer
from lucida.app.images.picking import object_on_ray
from lucida.renderer.files import BUILTIN_SCENES, load_scene
from lucida.renderer.scene import Scene, SceneObject, Sphere, shapes

SIZE = (16, 9)


@pytest.mark.parametrize("name", BUILTIN_SCENES)
def test_it_is_what_the_image_shows(name):
    scene = load_scene(name)
    camera = scene.view.for_size(SIZE)
    with Tracer(scene) as tracer:
        numbers = tracer.render(camera, SIZE, ("id",)).channel("id")
    rays = camera.rays(SIZE)
    wrong = 0
    for row in range(SIZE[1]):
        for column in range(SIZE[0]):
            number = object_on_ray(scene, rays.origin[row, column], rays.direction[row, column])
            wrong += (-1 if number is None else number) != numbers[row, column]
    assert wrong <= 1  # a centre on an edge


def test_what_is_behind_is_not_met_and_inside_counts():
    ball = SceneObject(Sphere((0, 0, 0), 1.0))
    box = SceneObject(shapes.transformed(shapes.box(1.0), shapes.placement((0, 0, -5))))
    scene = Scene((box, ball))
    away, toward = np.array([0.0, 0, 2.0]), np.array([0.0, 0, -2.0])
    assert object_on_ray(scene, np.array([0.0, 0, 5]), away) is None
    assert object_on_ray(scene, np.array([0.0, 0, 5]), toward) == 1
    assert object_on_ray(scene, np.array([0.0, 0, 0]), toward) == 1
    assert object_on_ray(scene, np.array([0.0, 0, -2]), toward) == 0
    assert object_on_ray(scene, np.array([0.0, 3, 5]), toward) is None
    assert object_on_ray(Scene(()), away, toward) is None


def test_a_pixel_outside_of_the_lens_shows_no_object():
    scene, nowhere = load_scene("still-life"), np.full(3, np.nan)
    assert object_on_ray(scene, np.zeros(3), nowhere) is None


def test_the_nearest_point_of_a_sphere_counts_whatever_the_ray_s_length():
    near, far = (SceneObject(Sphere((0, 0, z), radius)) for z, radius in ((1, 1.0), (-5, 5.5)))
    scene = Scene((far, near))  # they overlap: each begins before the other's middle
    for length in (0.1, 1.0, 30.0):
        for z, number in ((9, 1), (-20, 0), (1.5, 0), (1, 0)):
            way = np.array([0.0, 0.0, -length if z > -20 else length])
            assert object_on_ray(scene, np.array([0.0, 0, z]), way) == number, (length, z)
