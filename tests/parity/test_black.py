"""Why an image is black: each cause, in an image that has it, and none in a usual one."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest

from app.cameras.remedies import helped, remedy_for
from app.state.app_state import AppState
from renderer import Camera, load_scene
from renderer.black import Darkness, darkness, is_inside
from renderer.focus import scene_focus
from renderer.nothing_hit import Reason
from renderer.scene import (
    DirectionalLight,
    Material,
    Mesh,
    PointLight,
    Scene,
    SceneObject,
    Sphere,
    View,
    flatten,
)
from renderer.trace import Tracer

SIZE = (32, 24)
CUBE = Mesh(
    [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)],
    [
        *((0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1)),
        *((2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)),
    ],
)
AHEAD, BACK = DirectionalLight((0, 0, -1)), DirectionalLight((0, 0, 1))
NONE = (0.0, 0.0, 0.0)


def a_scene(*lights, shape=None, material=None, ambient=NONE) -> Scene:
    ball = SceneObject(shape or Sphere((0, 0, -5), 1.0), material or Material(), "Ball")
    return Scene((ball,), lights=lights, ambient=ambient)


def seen(scene: Scene, camera: Camera, shadows: bool = False) -> Darkness:
    with Tracer(scene, shadows=shadows) as tracer:
        frame = tracer.render(camera, SIZE)
    return darkness(scene, flatten(scene), camera, frame, shadows)


def cause(scene: Scene, camera: Camera) -> str:
    reason = seen(scene, camera).shown(0.0)
    return reason.cause if reason is not None else ""


def in_shadow() -> Scene:
    scene = a_scene(PointLight((0, 0, 9)))
    screen = SceneObject(Mesh([(-9, -9, 2), (9, -9, 2), (0, 20, 2)], [[0, 1, 2]]))
    return replace(scene, objects=(*scene.objects, screen))


BLACK, BLUE = Material(diffuse=NONE), Material(diffuse=(0, 0, 1))
SQUARE = Mesh([(-9, -9, -5), (9, -9, -5), (9, 9, -5), (-9, 9, -5)], [[0, 1, 2], [0, 2, 3]])
INSIDE = Camera(eye=(0.1, 0.2, 0.3))
RED = DirectionalLight((0, 0, -1), (1, 0, 0))


@pytest.mark.parametrize(
    ("scene", "camera", "shadows", "told"),
    [
        (a_scene(), Camera(), False, "no light: the scene has no lights"),
        (a_scene(DirectionalLight((0, 0, -1), NONE)), Camera(), False, "no light: all lights are"),
        (a_scene(ambient=(0.1, 0.1, 0.1)), Camera(), False, ""),
        (in_shadow(), Camera(), True, "shadow: all that is seen"),
        (in_shadow(), Camera(), False, ""),
        (
            a_scene(AHEAD, material=BLACK),
            Camera(),
            False,
            "material: what is",
        ),
        (
            a_scene(RED, material=BLUE),
            Camera(),
            False,
            "material: .* lights",
        ),
        (
            a_scene(shape=Sphere((0, 0, 0), 3.0)),
            INSIDE,
            False,
            "inside: .* object 'Ball'",
        ),
        (a_scene(shape=CUBE), INSIDE, False, "inside: the eye"),
        (a_scene(AHEAD), Camera(eye=(0, 0, -9)), False, "behind: "),
    ],
)
def test_the_cause(scene, camera, shadows, told):
    reason = seen(scene, camera, shadows).shown(0.0)
    assert re.match(told + ("" if told else "$"), f"{reason[0]}: {reason[1]}" if reason else "")


@pytest.mark.parametrize("light", [BACK, PointLight((0, 0, -9))])
@pytest.mark.parametrize("projection", ["perspective", "parallel"])
def test_lights_behind_the_surfaces(light, projection):
    camera = Camera(projection=projection)
    assert cause(a_scene(light, shape=SQUARE), camera) == "unlit"
    assert cause(a_scene(light, AHEAD, shape=SQUARE), camera) == ""
    assert cause(a_scene(light, PointLight((0, 0, 9)), shape=SQUARE), camera) == ""


class TestExposure:
    def test_an_exposure_that_hides_all_is_told_and_can_be_helped(self):
        dark = seen(a_scene(DirectionalLight((0, 0, -1), (1e-3,) * 3)), Camera())
        assert dark.reason is None
        reason = dark.shown(-4.0)
        assert reason is not None
        assert reason.cause == "exposure"
        state = AppState.for_scene(load_scene("canonical")).with_options(
            images={"exposure_ev": -4.0}
        )
        better = helped(state, reason, dark, scene_focus(state.scene))
        assert dark.shown(better.images.exposure_ev) is None

    def test_what_is_just_to_be_seen_is_not_told(self):
        assert Darkness(1.0, None).shown(-11.0) is None
        assert Darkness(1.0, None).shown(-13.0) is not None
        assert Darkness(1.0, None).shown(-8.0, is_linear=True) is not None

    def test_a_brightness_beyond_all_bounds_is_no_error(self):
        assert Darkness(3e38, None).shown(32.0) is None
        assert Darkness(float("inf"), None).shown(8.0) is None


def test_the_inside_of_a_cube_that_is_far_away():
    points = np.random.default_rng(3).uniform(-2, 2, (200, 3))
    moved = np.eye(4)
    moved[:3, 3] = (1e6, 0, 0)
    flat = flatten(a_scene(shape=replace(CUBE, transform=moved)))
    told = [is_inside(flat, 0, tuple(point)) for point in (points + moved[:3, 3]).tolist()]
    assert told == (np.abs(points) < 1).all(axis=1).tolist()
    assert 5 < sum(told) < 195


@pytest.mark.parametrize("projection", ["perspective", "parallel"])
@pytest.mark.parametrize(
    ("camera", "why"),
    [
        (Camera(eye=(0, 0, -19)), "behind"),
        (Camera(eye=(12, 3, 0)), "beside"),
        (Camera(eye=(0, -30, 0), viewport=(-0.1, 0.1, 2, 2.2)), "beside"),
        (Camera(viewport=(5, 6, -0.5, 0.5)), "viewport"),
        (Camera(far=0.5), "clip"),
        (Camera(near=50.0), "clip"),
        (Camera(eye=(0.3, 0.4, 900), viewport=(-90.0, 90.0, -90.0, 90.0), distance=50), "small"),
    ],
)
def test_the_remedy_shows_something(camera, why, projection):
    scene = a_scene(AHEAD, ambient=(0.1, 0.1, 0.1))
    camera = replace(camera, projection=projection)
    dark = seen(scene, camera)
    assert dark.reason is not None
    assert dark.reason.cause == why
    assert remedy_for(dark.reason)
    state = AppState.for_scene(scene, View(camera))
    better = helped(state, dark.reason, dark, scene_focus(scene))
    assert cause(scene, better.view.for_size(SIZE)) == ""


def test_a_skewed_camera_is_turned_as_it_is():
    scene = a_scene(AHEAD)
    camera = Camera(eye=(0, 0, -19), u=(2, 0.3, 0), w=(0.1, 0, 1))
    dark = seen(scene, camera)
    assert dark.reason is not None
    state = AppState.for_scene(scene, View(camera))
    better = helped(state, dark.reason, dark, scene_focus(scene)).camera
    before, after = (c.basis.T @ c.basis for c in (camera, better))
    assert np.abs(before - after).max() < 1e-12
    assert better.eye == camera.eye


def test_causes_without_a_remedy_have_no_button():
    reason = Reason("empty", "")
    assert remedy_for(reason) == ""
    state = AppState.for_scene(load_scene("canonical"))
    assert helped(state, reason, Darkness(0.0, reason), scene_focus(state.scene)) is state
