"""Cameras as OpenGL's matrices: copied, and pasted from other programs."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from copied_views import BOUNDS, NOW, SIZE, read_view, subject, views
from hypothesis import given

from lucida.app.cameras.text import Subject, as_text
from lucida.renderer.camera.camera import Camera
from lucida.renderer.scene.model import View


@given(views)
def test_matrices_come_back_as_the_camera_that_was_drawn(view: View) -> None:
    text = as_text("OpenGL matrices", subject(view))
    shown = view.for_size(SIZE)
    back = read_view(text, View(replace(NOW.camera, distance=shown.distance)))
    assert not back.fit
    camera = back.camera
    for name in ("eye", "u", "v", "w", "viewport"):
        assert getattr(camera, name) == pytest.approx(getattr(shown, name), abs=1e-6)
    assert (camera.projection, camera.distance) == (shown.projection, shown.distance)
    if shown.near is None and shown.far is None:
        assert (camera.near, camera.far) == (None, None)  # they were the scene's, not the camera's
    for name in ("near", "far"):
        if getattr(shown, name) is not None:
            assert getattr(camera, name) == pytest.approx(getattr(shown, name), rel=1e-5)


def test_matrices_are_named_column_by_column_and_what_opengl_takes() -> None:
    camera = Camera(eye=(1, 2, 3), near=0.5, far=20.0)
    text = as_text("OpenGL matrices", Subject(View(camera), camera, BOUNDS))
    values: dict[str, list[float]] = {}
    exec(text, {}, values)
    view, clip = values["camera_from_world"], values["clip_from_camera"]
    assert len(view) == len(clip) == 16
    assert view[12:] == [-1.0, -2.0, -3.0, 1.0]  # the translation is the last column
    assert clip[11] == -1.0
    assert clip[10] == pytest.approx(-(20 + 0.5) / (20 - 0.5))
    assert clip[14] == pytest.approx(-2 * 20 * 0.5 / (20 - 0.5))
    assert "near = 0.5, far = 20.0" in text
    behind = Camera(u=(-1, 0, 0), w=(0, 0, -1))
    text = as_text("OpenGL matrices", Subject(View(behind), behind, BOUNDS))
    assert "-0.0," not in text and "-0.0]" not in text


@pytest.mark.parametrize(
    ("clip", "told"),
    [
        ({}, "near = 0.1, far = 100.0: fitted to the scene"),
        ({"near": 0.5}, "near = 0.5, far = 500.0"),
        ({"near": 0.02}, "near = 0.02, far = 100.0"),
        ({"far": 20.0}, "near = 0.02, far = 20.0"),
        ({"far": 400.0}, "near = 0.1, far = 400.0"),
        ({"near": 0.5, "far": 20.0}, "near = 0.5, far = 20.0"),
    ],
)
def test_of_matrices_a_clip_plane_that_is_not_set_is_found(
    clip: dict[str, float], told: str
) -> None:
    """Without a scene 0.1 and 100; but never more than a factor of 1000 nearer or farther."""
    camera = Camera(eye=(1, 2, 3), **clip)
    text = as_text("OpenGL matrices", Subject(View(camera), camera, np.zeros((0, 3))))
    assert f"# {told}" in text.split("\n")


@pytest.mark.parametrize(
    "written",
    [
        "float {name}[16] = {{ {cells} }};",
        "const GLfloat {name}[16] = {{\n{floats}\n}};",
        "mat4 {name} = mat4({cells});",
        "{name} = np.array([{cells}]).reshape(4, 4).T",
        "{name}: [{cells}]",
    ],
)
def test_matrices_out_of_other_programs(written: str) -> None:
    camera = Camera(eye=(1, 2, 3), viewport=(-1.0, 2.0, -0.5, 0.75), near=0.5, far=20.0)
    pieces = []
    for name, matrix in (
        ("camera_from_world", camera.camera_from_world),
        ("clip_from_camera", camera.clip_from_camera(0.5, 20.0)),
    ):
        cells = [repr(x) for x in matrix.T.ravel().tolist()]
        floats = ", ".join(f"{cell}f" for cell in cells)
        pieces.append(written.format(name=name, cells=", ".join(cells), floats=floats))
    back = read_view("\n".join(pieces), View(Camera()))
    assert back.camera.eye == pytest.approx(camera.eye)
    assert back.camera.viewport == pytest.approx(camera.viewport)
    assert back.camera.near == pytest.approx(0.5)


@pytest.mark.parametrize(
    "text",
    [
        "K = [[800. 0. 320.]\n [0. 800. 240.]\n [0. 0. 1.]]\nt = [0, 0, 4]\nsize = (640, 480)",
        '{"w": 640, "h": 480, "fl_x": 800, "cx": 320.5, "cy": 240.5, "frames": [{'
        '"transform_matrix": [[1, 0, 0, 0], [0, -1, 0, 0], [0, 0, -1, -4], [0, 0, 0, 1]]}]}',
        '{"view": [[1, 0, 0, 0], [0, -1, 0, 0], [0, 0, -1, -4], [0, 0, 0, 1]], "projection": '
        "[[2.5, 0, -0.0015625, 0], [0, 3.33333333333, 0.00208333333, 0], [0, 0, -1.01, -0.2], "
        "[0, 0, -1, 0]]}",
    ],
)
def test_what_others_write_is_pasted_at_the_present_distance(text: str) -> None:
    view = read_view(text, NOW)
    assert view.camera.distance == NOW.camera.distance
    assert view.fit == ("projection" not in text)  # matrices have no size: they stand as they are
    back = Camera.from_intrinsics(
        [[800, 0, 320], [0, 800, 240], [0, 0, 1]],
        size=(640, 480),
        camera_from_world=np.column_stack([np.eye(3), (0, 0, 4)]),
    )
    points = np.array([[0.1, 0.2, 0.3], [-1, 1, 2]])
    for one, two in zip(
        view.camera.project(points, (640, 480))[:2],
        back.project(points, (640, 480))[:2],
        strict=True,
    ):
        assert one == pytest.approx(two, abs=1e-6)
