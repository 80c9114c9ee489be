"""Cameras as text: each form is read back exactly; any other text is refused in one line."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest
from copied_views import NOW, lens_views, read_view, subject, views
from hypothesis import example, given
from hypothesis import strategies as st

from lucida.app.cameras.reader import MOST_CHARACTERS
from lucida.app.cameras.text import as_text
from lucida.renderer.camera.camera import Camera
from lucida.renderer.scene.model import View
from lucida.renderer.system.errors import LucidaError


@given(view=views | lens_views())
@example(view=View(Camera(eye=(-1e-9, 1e-300, -0.0), near=1e-7)))
def test_a_copied_view_is_read_back_exactly(view: View) -> None:
    assert read_view(as_text("view file", subject(view)), NOW) == view


@given(views | lens_views())
def test_the_python_runs_as_it_is(view: View) -> None:
    names: dict[str, object] = {}
    exec(as_text("Python", subject(view)), names)
    assert names["camera"] == view.camera
    assert names.get("view", View(view.camera)) == view


@pytest.mark.parametrize(
    ("text", "camera"),
    [
        (
            "[camera]\neye = [0, 0, 5]\ntarget = [0, 0, 0]\nfov_y_deg = 40",
            Camera.look_at((0, 0, 5), (0, 0, 0), fov_y_deg=40),
        ),
        ("[camera]\neye = [0, 0, 5]", Camera((0, 0, 5))),
    ],
)
def test_partial_view_files_are_read(text: str, camera: Camera) -> None:
    assert read_view(text, NOW).camera == camera


@pytest.mark.parametrize(
    ("camera", "view"),
    [
        ("eye = [0, 0, 5]", View(Camera((0, 0, 5)), fit=True)),
        (
            "eye = [0, 0, 5]\nviewport = [-1, 1, -1, 1]",
            View(Camera((0, 0, 5), viewport=(-1, 1, -1, 1))),
        ),
        (
            "eye = [0, 0, 5]\ntarget = [0, 0, 0]",
            View(Camera.look_at((0, 0, 5), (0, 0, 0)), fit=True),
        ),
    ],
)
def test_a_scene_files_camera_is_read(camera: str, view: View) -> None:
    """A scene's viewport is fitted unless it is given; a view file's only with a target."""
    ball = '[[objects]]\nshape = "sphere"\ncenter = [0, 0, 0]\nradius = 1\n'
    assert read_view(f"lucida = 1\n[camera]\n{camera}\n{ball}", NOW) == view
    alone = read_view(f"lucida = 1\n[camera]\n{camera}\n", NOW)
    assert alone == replace(view, fit="target" in camera)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "holds no camera"),
        ("clip_from_camera = " + "1 " * 16, "camera_from_world: is missing"),
        ("# [camera]\neye = 3", "eye: is unknown"),
        ("[camera]\neye = [0, 0]", "camera.eye"),
        ("[camera]\nw = [0, 0, 0]", "camera.w: .*independent"),
        ("camera_from_world = [1, 2, 3]", "has 3 numbers; give 16"),
        (
            "camera_from_world = " + "1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1",
            "clip_from_camera: is missing",
        ),
        (
            "camera_from_world = 1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1\nclip_from_camera = "
            + "1 " * 16,
            "clip_from_camera: is not a projection",
        ),
    ],
)
def test_text_without_a_camera_is_refused_in_one_line(text: str, message: str) -> None:
    with pytest.raises(LucidaError) as error:
        read_view(text, NOW)
    line = str(error.value)
    assert line.startswith("clipboard: ")
    assert re.search(message, line), line
    assert "\n" not in line
    assert len(line) < 250


@given(st.text(max_size=200))
@example("camera_from_world=[" + "nan," * 16 + "]")
@example("[camera]\n" + "a" * 100)
def test_any_text_is_a_camera_or_one_error(text: str) -> None:
    message = "clipboard: "
    try:
        replace(read_view(text, NOW).camera)  # validates itself
    except LucidaError as error:
        message = str(error)
    assert message.startswith("clipboard: ")


def test_a_text_has_up_to_a_hundred_thousand_characters() -> None:
    text = "[camera]\neye = [1, 2, 3]".ljust(MOST_CHARACTERS)
    assert read_view(text, NOW).camera.eye == (1.0, 2.0, 3.0)
    with pytest.raises(LucidaError, match="a long text"):
        read_view(text + " ", NOW)
