"""Sessions as text: what was open comes back; what no window can have left is refused."""

import json
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st
from option_changes import with_options

from lucida.app.state.app_state import AppState
from lucida.app.state.options.shared import Bookmark
from lucida.app.state.removed import without_removed
from lucida.app.state.session import (
    LARGEST_BYTES,
    VERSION,
    Arrangement,
    NewerVersionError,
    from_bytes,
    session_of,
    to_bytes,
)
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.lenses import Lens
from lucida.renderer.files import BUILTIN_SCENES, load_scene
from lucida.renderer.scene import View
from lucida.renderer.system.errors import LucidaError

SPHERES = load_scene("spheres")
ARRANGEMENT = Arrangement(
    "Compare",
    ("Camera", "Raster"),
    {"Camera": ("Look at",)},
)


def damaged(data, **changes):
    """A session with other values: section__field=value."""
    table = json.loads(data)
    for path, value in changes.items():
        *parents, last = path.split("__")
        part = table
        for name in parents:
            part = part[name]
        part[last] = value
    return json.dumps(table).encode()


def test_a_session_comes_back_as_it_was(state, scene):
    session = session_of(state, ARRANGEMENT)
    assert session.scene == "spheres"
    read = from_bytes(to_bytes(session))
    assert read == session
    assert read.state(scene) == state
    assert read.arrangement == ARRANGEMENT


def test_a_lens_comes_back_and_a_damaged_one_is_refused(state):
    camera = replace(state.camera, projection="perspective", lens=Lens("brown", {"k1": -0.2}))
    data = to_bytes(session_of(state.with_camera(camera), ARRANGEMENT))
    assert from_bytes(data).view.camera == camera
    with pytest.raises(LucidaError, match=r"lens\.model.*'fog' is unknown"):
        from_bytes(data.replace(b'"brown"', b'"fog"'))


@given(
    eye=st.tuples(*[st.floats(-1e12, 1e12)] * 3),
    distance=st.floats(1e-12, 1e12),
)
def test_numbers_are_kept_exactly(eye, distance):
    view = View(Camera(eye, distance=distance))
    state = AppState.for_scene(SPHERES, view)
    state = with_options(state, bookmarks=(Bookmark(5, view),))
    session = from_bytes(to_bytes(session_of(state, Arrangement())))
    assert (session.view, session.options.bookmarks[0].view) == (view, view)


def test_of_a_scene_from_no_file_the_first_built_in_one_is_kept(scene, tmp_path):
    (tmp_path / "scene.toml").write_text('[[objects]]\ntype = "sphere"\n')
    for origin, kept in (
        (None, BUILTIN_SCENES[0]),
        (replace(scene.origin, source=""), BUILTIN_SCENES[0]),
        (load_scene(tmp_path / "scene.toml").origin, str(tmp_path / "scene.toml")),
    ):
        state = AppState.for_scene(replace(scene, origin=origin))
        assert session_of(state, Arrangement()).scene == kept


def test_what_an_older_session_lacks_has_its_default(state):
    data = to_bytes(session_of(state, ARRANGEMENT))
    table = json.loads(data)
    del table["options"]["compare"], table["arrangement"], table["options"]["images"]["samples"]
    read = from_bytes(json.dumps(table).encode())
    assert read.options.images.samples == 1
    assert read.options.images.exposure_ev == 1.5
    assert read.arrangement == Arrangement()
    del table["keep_orthonormal"]
    assert from_bytes(json.dumps(table).encode()).keep_orthonormal


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"\x00\xff\xfe",
        b"{",
        b"[]",
        b"null",
        b'{"lucida_session": true}',
        b'{"lucida_session": "1"}',
        b'{"lucida_session": 0}',
        b'{"lucida_session": 1}',
        b"[" * 100_000,
        b'{"lucida_session": 1, "scene": ' + b"9" * 10_000 + b"}",
        b" " * (LARGEST_BYTES + 1),
    ],
)
def test_what_is_no_session_is_one_clear_error(content):
    with pytest.raises(LucidaError) as caught:
        from_bytes(content, "session-1.json")
    assert str(caught.value).startswith("session-1.json: ")
    assert len(str(caught.value)) < 300


@pytest.mark.parametrize(
    "changes",
    [
        {"view__camera__distance": 0},
        {"view__camera__eye": [1, 2]},
        {"view__camera__eye": [1e300, 0, 0]},
        {"view__camera__projection": "fisheye"},
        {"options__images__channel": "smell"},
        {"options__preferences__font_scale": 0},
        {"options__preferences__theme": "pink"},
        {"options__marked": [-1, 0]},
        {"options__bookmarks": [{"number": 0, "view": {"camera": {}}}]},
        {"options__bookmarks": [{"number": 1, "view": 5}]},
        {"options": []},
        {"scene": 3},
        {"arrangement__visible": "Camera"},
    ],
)
def test_values_that_no_window_can_have_left_are_refused(state, changes):
    data = to_bytes(session_of(state, ARRANGEMENT))
    assert from_bytes(damaged(data)) == session_of(state, ARRANGEMENT)
    with pytest.raises(LucidaError, match="Lucida starts afresh"):
        from_bytes(damaged(data, **changes))


def test_a_newer_session_is_refused_as_such(state):
    data = damaged(to_bytes(session_of(state, ARRANGEMENT)), lucida_session=VERSION + 1)
    with pytest.raises(NewerVersionError, match="update Lucida"):
        from_bytes(data)


def test_removed_options_are_left_out_and_replaced_values_have_their_successors():
    """The successors differ from the defaults, which a lost value would become."""
    old = {"notation": "code", "laboratory": {"zoom": 2, "page": "heights"}, "pixel": [1, 2]}
    kept, lines = without_removed(old)
    assert kept == {"laboratory": {"page": "function"}, "pixel": [1, 2]}
    assert [line.partition(":")[0] for line in lines] == [
        "notation is ignored",
        "laboratory.zoom is ignored",
        "laboratory.page = 'heights' is now 'function'",
    ]
