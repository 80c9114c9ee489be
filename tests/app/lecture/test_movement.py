"""States between two states: exact ends, and legal ones between."""

from dataclasses import replace

import numpy as np
import pytest
from option_changes import with_options

from lucida.app.instruments.outside.frustum import plane_corners
from lucida.app.lecture.movement import Movement
from lucida.app.state.app_state import AppState
from lucida.app.state.bounds import check
from lucida.renderer.camera.camera import Camera
from lucida.renderer.files import load_scene
from lucida.renderer.scene.focus import scene_focus
from lucida.renderer.scene.model import View

SIZE = 160, 90
PARTS = np.linspace(0, 1, 21)
EYE = Camera.look_at((4, 3, 5), (0, 0, 0))


def movement(start, end):
    return Movement(start, end, scene_focus(start.scene), SIZE)


@pytest.fixture(scope="module")
def state():
    return AppState.for_scene(load_scene("canonical"))


@pytest.fixture(scope="module")
def changed(state):
    camera = replace(state.camera, eye=(1.0, 0.5, 1.0), projection="parallel")
    end = replace(state, view=View(camera, state.view.fit))
    options = {"camera": EYE, "grid": False, "target": (1.0, 2.0, 3.0), "up": (0.0, 0.0, 1.0)}
    return with_options(end,
        images={"exposure_ev": 4.0, "channel": "depth", "samples": 16}, outside=options,
        marked=(3, 4), laboratory={"after_ev": 1.5},
    )  # fmt: skip


def test_a_movement_s_ends_are_the_states_themselves(state, changed):
    moving = movement(state, changed)
    assert moving.at(1) == moving.at(1.5) == changed
    first = moving.at(0)
    assert first.view == state.view
    assert first.images.exposure_ev == state.images.exposure_ev


def test_everything_else_changes_when_it_begins(state, changed):
    first = movement(state, changed).at(0)
    assert (first.images.channel, first.images.samples, first.marked) == ("depth", 16, (3, 4))
    outside = first.options.outside
    assert (outside.camera, outside.grid, outside.target) == (EYE, False, (1.0, 2.0, 3.0))


def test_all_between_is_legal_and_goes_one_way(state, changed):
    moving = movement(state, changed)
    states = [moving.at(part) for part in PARTS]
    for one in states:
        check(AppState, one)
    for values in (
        [one.images.exposure_ev for one in states],
        [one.options.outside.up[2] for one in states],
    ):
        assert values == sorted(values) and len(set(values)) == len(PARTS)
    assert movement(changed, state).at(0.25).images.exposure_ev == pytest.approx(
        states[15].images.exposure_ev
    )


def test_cameras_in_options_take_the_same_path(state):
    other = Camera.look_at((-4, 3, 5), (0, 0, 0))
    ends = [with_options(state, outside={"camera": camera}) for camera in (EYE, other)]
    eyes = [movement(*ends).at(part).options.outside.camera.eye for part in PARTS]
    np.testing.assert_allclose([eyes[0], eyes[-1]], [EYE.eye, other.eye])
    assert np.all(np.linalg.norm(eyes, axis=1) > 5)  # around the scene, not through it


def test_the_frame_stays_while_the_eye_goes_to_infinity(state):
    """From perspective to parallel, if both cameras have their frames in one place."""
    near = Camera(eye=(0, 0, 5.4), distance=5.4, viewport=(-2.7, 2.7, -1.8, 1.8))
    parallel = replace(near, eye=(0, 0, 0), projection="parallel")  # whose rays begin in its frame
    moving = movement(*(replace(state, view=View(one)) for one in (near, parallel)))
    frame, eyes = plane_corners(near), []
    for part in PARTS:
        camera = moving.at(part).camera
        if not camera.is_parallel:
            np.testing.assert_allclose(plane_corners(camera), frame, atol=1e-6)
            eyes.append(camera.eye[2])
    assert eyes == sorted(eyes) and eyes[-1] > 100
