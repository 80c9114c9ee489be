"""The focus of a scene, by hand: its middle, its extent, and what a picture holds."""

import numpy as np
import pytest

from lucida.renderer.camera.camera import Camera
from lucida.renderer.scene.focus import Focus, object_corners, scene_focus
from lucida.renderer.scene.model import Mesh, Scene, SceneObject, Sphere, View


def balls(*spheres, eye=(0, 0, 0)):
    """Spheres on the x axis, as (x, radius)."""
    objects = tuple(SceneObject(Sphere((x, 0, 0), radius)) for x, radius in spheres)
    return Scene(objects, view=View(Camera(eye=eye)))


@pytest.mark.parametrize(
    ("eye", "reach"),
    [
        ((4, 0, 3), 7.5),  # half again the middle one of what reaches 5, 7 and 2 from the middle
        ((4, -8.24, 3), 12.0),  # half again the eye's 8.24, to two digits
        ((-4.4, 0, 0), 13.0),
    ],
)
def test_numbers_of_the_eye_go_half_again_as_far_as_the_scene_or_its_eye(eye, reach):
    focus = scene_focus(balls((0, 1), (10, 1), (4, 2), eye=eye))
    assert focus.center == (4, 0, 0)
    assert focus.reach == reach


def test_the_middle_of_two_is_between_them():
    assert scene_focus(balls((0, 1), (10, 1))).center == (5, 0, 0)
    assert scene_focus(balls((0, 1), (10, 1), (4, 1), (90, 1))).center == (7, 0, 0)


def test_a_mesh_counts_as_the_ball_round_its_box():
    moved = np.array([(2, 0, 0, 10), (0, 2, 0, 0), (0, 0, 2, -5), (0, 0, 0, 1.0)])
    mesh = Mesh([(0, 0, 0), (3, 4, 0), (3, 0, 12)], [[0, 1, 2]], transform=moved)
    focus = scene_focus(Scene((SceneObject(mesh),), view=View(Camera(eye=(13, 4, 7)))))
    assert focus.center == (13, 4, 7)
    assert focus.reach == 20  # half again 13, which is half the diagonal of 6 x 8 x 24
    assert focus.bounds.min(axis=0).tolist() == [10, 0, -5]
    assert focus.bounds.max(axis=0).tolist() == [16, 8, 19]


@pytest.mark.parametrize(
    ("spheres", "framed"),
    [
        ([(0, 1), (9, 1), (5, 3)], [0, 1, 2]),
        ([(0, 1), (2, 1), (1, 3)], [0, 1, 2]),
        ([(0, 1), (0, 1), (0, 4), (0, 5), (0, 20)], [0, 1, 2, 3]),
        ([(0, 1), (2, 1), (1, 3.1)], [0, 1]),  # more than three times the usual, and round the rest
        ([(0, 1), (10, 1), (5, 6.1)], [0, 1, 2]),  # less than half of what the others take, 6.16
        ([(0, 1), (10, 1), (5, 6.2)], [0, 1]),
        ([(0, 1), (0, 50)], [0]),  # of two, the smaller one is the usual
        ([(0, 50)], [0]),
    ],
)
def test_what_is_larger_than_the_rest_and_holds_it_is_not_framed(spheres, framed):
    scene = balls(*spheres)
    focus = scene_focus(scene)
    wanted = np.concatenate([object_corners(scene.objects[k]) for k in framed])
    assert focus.framed.tolist() == wanted.tolist()
    reached = max(abs(x) + radius for x, radius in spheres)
    assert np.abs(focus.bounds).max() == reached
    assert focus.bounds.shape == (8, 3)


def test_a_scene_without_objects_has_a_focus_too():
    focus = scene_focus(Scene(()))
    assert focus == Focus((0, 0, 0), 2.0)
    assert focus.framed.shape == focus.bounds.shape == (0, 3)
