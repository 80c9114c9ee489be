"""The window's state: history, switches, and edits that may be illegal for a while."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from option_changes import with_options

from lucida.app.cameras.basis import with_component, with_vector
from lucida.app.cameras.editing import Draft, edit_component, edit_field
from lucida.app.state.app_state import MOST_UNDO_STEPS, AppState, History, is_orthonormal
from lucida.app.state.changes import change
from lucida.renderer.camera.camera import Camera
from lucida.renderer.files import load_scene
from lucida.renderer.scene import View
from lucida.renderer.scene.model import Scene, SceneObject, Sphere

SCENE = Scene((SceneObject(Sphere()),), view=View(Camera(eye=(0, 0, 5)), fit=True))
STATE = AppState.for_scene(SCENE)
SKEWED = Camera(u=(1, 0.3, 0), v=(0, 2, 0.1), w=(0.2, 0, 1))


def moved(x):
    return STATE.with_camera(replace(STATE.camera, eye=(x, 0, 5)))


def test_a_drag_is_one_step_of_undo():
    history = History(STATE)
    for x in (1.0, 2.0, 3.0):
        history = history.change(moved(x), gesture=("drag", 1))
    history = history.change(moved(4.0), gesture=("drag", 2))
    assert history.undo().present == moved(3.0)
    assert history.undo().undo().present == STATE
    assert history.undo().undo().undo().present == STATE
    assert history.undo().undo().redo().redo().present == moved(4.0)


def test_a_drag_that_ends_where_it_began_is_no_step():
    history = History(STATE).change(moved(1.0), "a").change(moved(2.0), "b")
    assert history.change(moved(1.0), "b").past == (STATE,)
    again = history.change(moved(1.0), "b").change(moved(3.0), "b")
    assert again.undo().present == moved(1.0)


def test_a_drag_after_undo_does_not_join_the_drag_before():
    history = History(STATE).change(moved(1.0), "a").change(moved(2.0), "b").undo()
    history = history.change(moved(3.0), "a")
    assert history.undo().present == moved(1.0)


def test_the_first_of_two_clicks_is_taken_back():
    start = AppState.for_scene(load_scene("canonical"))
    before = History(start).change(start.with_fit(not start.view.fit))
    click, later = ("drag", 3), ("drag", 4)
    marked = before.change(with_options(before.present, marked=(1, 2)), click)
    assert (marked.unclicked(click).present, marked.unclicked(click).past) == (
        before.present,
        before.past,
    )
    assert marked.unclicked(later) is marked  # something else came in between
    drawn = marked.amended(with_options(marked.present, marked_size=(64, 36)))
    assert drawn.unclicked(click).present == before.present
    other = before.change(before.present.with_fit(start.view.fit), click)
    assert other.unclicked(click) is other  # a drag that has changed more
    assert History(start).unclicked(None) == History(start)


@given(st.lists(st.sampled_from(["undo", "redo", 1.0, 2.0, 3.0]), max_size=30))
def test_undo_walks_a_list_of_states(acts):
    """Against a list and a place in it: a change forgets what came after; none is no step."""
    history, states, here = History(STATE), [STATE], 0
    for act in acts:
        if act == "undo":
            history, here = history.undo(), max(0, here - 1)
        elif act == "redo":
            history, here = history.redo(), min(len(states) - 1, here + 1)
        else:
            state = moved(float(act))
            history = history.change(state)
            if state != states[here]:
                states, here = [*states[: here + 1], state], here + 1
        assert (*history.past, history.present, *history.future) == tuple(states)
        assert len(history.past) == here


BALL = Sphere()


def edited_scene(*more):
    return replace(SCENE, objects=(*SCENE.objects, *more))


LOOKS = (
    {"outside": {"grid": False}, "stepper": {"steps": (3, 4)}},
    {"preferences": {"theme": "light"}},
    {"preferences": {"presentation": True, "font_scale": 2.0}},
    {"images": {"channel": "depth", "exposure_ev": 1.0, "magnification": 8.0}},
)


@pytest.mark.parametrize("looks", LOOKS)
def test_undo_leaves_the_looks_as_they_are(looks):
    history = History(STATE).change(moved(1.0)).change(moved(2.0)).undo()
    seen = history.change(with_options(history.present, **looks), "a drag")
    assert (seen.past, seen.future) == (history.past, history.future)  # no step, and no end of redo
    assert seen.undo().present == with_options(STATE, **looks)
    assert seen.redo().present == with_options(moved(2.0), **looks)
    both = seen.change(moved(3.0))  # and the looks of before
    assert both.present == moved(3.0) and both.undo().present == moved(1.0)


def test_undo_of_a_lectures_step_brings_its_display_back():
    shown = with_options(IN_LECTURE, images={"channel": "id"})
    after = replace(STATE, step=("a lecture", 3))
    assert History(shown).change(after).undo().present == shown


def test_undo_has_a_limit():
    history = History(STATE)
    for x in range(MOST_UNDO_STEPS + 5):
        history = history.change(moved(1.0 + x))
    assert len(history.past) == MOST_UNDO_STEPS
    assert history.past[-1] == moved(MOST_UNDO_STEPS + 4.0)


def test_the_switch_follows_the_basis_and_mends_it():
    skewed = STATE.with_view(View(SKEWED))
    assert STATE.keep_orthonormal and not skewed.keep_orthonormal
    assert skewed.with_scene(SCENE).keep_orthonormal
    assert not skewed.with_scene(SCENE, View(SKEWED)).keep_orthonormal
    mended = skewed.with_keep_orthonormal(True).camera
    assert is_orthonormal(mended) and np.allclose(np.cross(mended.w, SKEWED.w), 0)
    assert skewed.with_keep_orthonormal(False).camera == SKEWED
    off = STATE.with_keep_orthonormal(False)
    assert not off.keep_orthonormal and off.camera == STATE.camera
    assert off.with_keep_orthonormal(True) == STATE


def test_a_mark_has_the_size_of_the_image_that_it_was_set_in():
    state = with_options(STATE, marked=(1, 2), marked_size=(64, 36))
    assert with_options(state, marked=(1, 2), shadows=True).options.marked_size == (64, 36)
    assert with_options(state, marked=(2, 2)).options.marked_size is None
    assert with_options(state, marked=None).options.marked_size is None
    assert change(state, with_options(state, marked=(2, 2))) == "Mark (3, 3)"


IN_LECTURE = replace(STATE, step=("a lecture", 2, 0))
TURNED = STATE.with_camera(replace(STATE.camera, u=(0, 1, 0), v=(1, 0, 0), w=(0, 0, -1)))


@pytest.mark.parametrize(
    ("before", "after", "words"),
    [
        (STATE, IN_LECTURE, "Lecture: step 3"),
        (IN_LECTURE, replace(STATE, step=("a lecture", 2, 1)), "Lecture: step 3.2"),
        (IN_LECTURE, with_options(STATE, marked=(2, 2)), "Mark (3, 3)"),
        (STATE, STATE.with_scene(replace(SCENE, name="cow")), "Scene: cow"),
        (STATE, STATE.with_scene(edited_scene(SceneObject(BALL, name="ball"))), "Add ball"),
        (STATE, STATE.with_scene(replace(SCENE)), "Lights and background"),
        (STATE, moved(3.0), "Eye x: 0 to 3"),
        (STATE, TURNED, "Turn the camera"),
        (STATE, TURNED.with_camera(replace(TURNED.camera, eye=(0, 0, 9))), "Move the camera"),
        (STATE, STATE.with_camera(replace(STATE.camera, near=0.5)), "Near: off to 0.5"),
        (STATE, STATE.with_fit(False), "Fit to the image's aspect ratio: off"),
        (STATE, STATE.with_keep_orthonormal(False), "Keep orthonormal: off"),
        (STATE, with_options(STATE, images={"resolution": (64, 36)}), "Resolution: 64 x 36"),
        (STATE, with_options(moved(3.0), shadows=True), "Eye x: 0 to 3, Shadows: on"),
        (STATE, STATE, "Nothing visible"),
    ],
)
def test_a_step_of_undo_is_named_by_what_it_changes(before, after, words):
    assert change(before, after) == words


@given(
    name=st.sampled_from("uvw"),
    axis=st.integers(0, 2),
    value=st.floats(-3, 3),
    mirrored=st.booleans(),
    spin=st.tuples(*[st.floats(-1, 1)] * 3).filter(lambda v: np.linalg.norm(v) > 0.1),
)
def test_edits_keep_the_basis_orthonormal_and_its_handedness(name, axis, value, mirrored, spin):
    camera = with_vector(Camera(u=(-1, 0, 0) if mirrored else (1, 0, 0)), "w", np.array(spin))
    assert is_orthonormal(camera)
    assert np.allclose(np.multiply(camera.w, np.linalg.norm(spin)), spin)
    edited = with_component(camera, name, axis, value)
    assert is_orthonormal(edited)
    assert getattr(edited, name)[axis] == pytest.approx(min(max(value, -1), 1), abs=1e-9)
    assert edited.determinant * camera.determinant > 0


@pytest.mark.parametrize(("name", "taken"), [("u", "v"), ("v", "w"), ("w", "v")])
def test_a_vector_may_take_the_place_of_another(name, taken):
    """The basis may be skewed: the vector whose place is taken is rotated out of the way."""
    there = np.array(getattr(SKEWED, taken))
    camera = with_vector(SKEWED, name, there)
    assert is_orthonormal(camera)
    assert np.allclose(getattr(camera, name), there / np.linalg.norm(there))
    assert camera.determinant * SKEWED.determinant > 0


def test_an_illegal_value_waits_and_the_camera_stays():
    state = replace(STATE, keep_orthonormal=False)
    draft = Draft.of(state.camera)
    after, draft = edit_component(state, draft, "w", 2, 0.0)
    assert after == state
    assert draft.error is not None
    assert draft.is_wrong("w")
    assert draft.value("w") == (0, 0, 0)
    # A waiting component becomes part of the camera with the one that makes it legal.
    after, draft = edit_component(after, draft, "w", 0, 1.0)
    assert after == state
    assert draft.is_wrong("w")  # parallel to u
    after, draft = edit_component(after, draft, "u", 2, 1.0)
    assert draft.error is None
    assert after.camera.w == (1, 0, 0)
    assert after.camera.u == (1, 0, 1)


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("distance", 0.0),
        ("distance", float("nan")),
        ("viewport", (0.5, -0.5, -0.5, 0.5)),
        ("eye", (float("inf"), 0.0, 0.0)),
    ],
)
def test_illegal_fields_are_told_and_kept_out(name, value):
    state, draft = edit_field(STATE, Draft.of(STATE.camera), name, value)
    assert state == STATE
    assert [field for field in ("eye", "distance", "viewport") if draft.is_wrong(field)] == [name]


def test_a_legal_edit_does_not_wait_for_an_illegal_one():
    state, draft = edit_field(STATE, Draft.of(STATE.camera), "distance", -1.0)
    state, draft = edit_component(state, draft, "eye", 0, 2.0)
    assert state.camera.eye == (2, 0, 5)
    assert draft.following(state.camera).is_wrong("distance")
    assert draft.value("distance") == -1.0
    state, draft = edit_field(state, draft, "distance", 3.0)
    assert state.camera.distance == 3.0
    assert draft.error is None


def test_a_draft_is_dropped_when_the_camera_changes_elsewhere():
    _, draft = edit_field(STATE, Draft.of(STATE.camera), "distance", -1.0)
    assert draft.following(STATE.camera) is draft
    assert draft.following(moved(1.0).camera).error is None


def test_a_state_with_another_part_has_the_rest_as_it_was():
    assert not STATE.has_effects
    assert with_options(STATE, shadows=True).has_effects
    assert with_options(STATE, mirrors=True).has_effects
    assert STATE.with_camera(STATE.camera) is STATE
    assert not STATE.with_fit(False).view.fit
    assert STATE.with_fit(False).with_fit(True) == STATE
    other = Scene((), view=View(Camera(eye=(9, 9, 9))))
    assert STATE.with_scene(other).view == other.view
    assert STATE.with_scene(other, STATE.view) == replace(STATE, scene=other)


def test_what_follows_from_a_change_of_the_window_is_no_step():
    history = History(STATE).change(moved(1.0), "a")
    assert history.amended(moved(1.0)) is history
    amended = history.amended(moved(2.0))
    assert (amended.present, amended.past) == (moved(2.0), (STATE,))
    assert amended.change(moved(3.0), "a").past == (STATE,)
