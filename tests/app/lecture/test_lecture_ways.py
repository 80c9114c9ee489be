"""A step's state, and its mark, do not depend on what was there before."""

from dataclasses import replace

from both_lectures import both_lectures
from option_changes import with_options

from lucida.app.lecture.step_options import OWN, state_of
from lucida.app.state.app_state import AppState
from lucida.renderer.files import load_scene


def spoiled(state):
    """Return a state as a user may have changed it."""
    changed = with_options(
        state,
        marked=(1, 2),
        shadows=not state.options.shadows,
        images={"resolution": None, "samples": 4, "exposure_ev": 2.0, "channel": "depth"},
        outside={"bundle": (2, 2), "volume": False, "camera": state.camera},
        stepper={"steps": (3, 3), "canvas": (4, 3)},
        laboratory={"page": "array", "progress": 3.0},
    )
    return changed.with_camera(replace(state.camera, eye=(0.3, 0.4, 7.0))).with_fit(False)


def test_a_steps_state_does_not_depend_on_the_way():
    steps = both_lectures().steps
    begun = AppState.for_scene(load_scene("spheres"))
    user = with_options(begun, preferences={"theme": "light", "font_scale": 1.5})
    kept = {name: getattr(user.options, name) for name in OWN}
    for number, step in enumerate(steps):
        own = state_of(step, begun)
        for before in steps[number % 4 :: 4]:
            came = state_of(before, begun)
            assert state_of(step, came) == own, step.title
            assert state_of(step, spoiled(came)) == own, step.title
        came = replace(own, options=replace(own.options, **kept))
        assert state_of(step, user) == came, step.title
