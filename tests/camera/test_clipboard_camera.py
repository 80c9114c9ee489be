"""Cameras as text: each form comes back as it was; what is no camera is told in one line."""

from __future__ import annotations

import math
import re
import shlex
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st

from app.cameras.reader import MOST_CHARACTERS, read_view
from app.cameras.text import FORMS, Form, Subject, as_text, command_line
from app.cli import main
from app.commands import view as view_command
from renderer.camera import Camera, volume
from renderer.errors import LucidaError
from renderer.scene import load_scene, save_view
from renderer.scene.model import View

ROOT = Path(__file__).parents[2]
SIZE = (160, 90)
NOW = View(Camera(eye=(9, 9, 9), distance=2.5, near=0.25), fit=True)
BOUNDS = np.array([[x, y, z] for x in (-2, 2) for y in (-1, 2) for z in (-3, 2)], float)
numbers = st.floats(-3, 3)
vectors = st.tuples(numbers, numbers, numbers)


@st.composite
def views(draw: st.DrawFn) -> View:
    basis = np.array([draw(vectors) for _ in range(3)])
    lengths = np.linalg.norm(basis, axis=1)
    assume((lengths > 0.1).all())
    assume(abs(volume(*(basis / lengths[:, None]))) > 0.02)
    left, bottom = draw(numbers), draw(numbers)
    camera = Camera(
        draw(vectors),
        *(tuple(row) for row in basis.tolist()),
        draw(st.floats(0.1, 5)),
        (left, left + draw(st.floats(0.05, 4)), bottom, bottom + draw(st.floats(0.05, 4))),
        draw(st.sampled_from(("perspective", "parallel"))),
        draw(st.none() | st.floats(0.01, 3)),
        draw(st.none() | st.floats(3.5, 50)),
    )
    return View(camera, draw(st.booleans()))


def subject(view: View) -> Subject:
    return Subject(view, view.for_size(SIZE), "still-life", BOUNDS)


@pytest.mark.parametrize("form", [form for form in FORMS if form != "OpenGL matrices"])
@given(view=views())
@example(view=View(Camera(eye=(-1e-9, 1e-300, -0.0), near=1e-7)))
def test_what_is_copied_comes_back_exactly(form: Form, view: View) -> None:
    assert read_view(as_text(form, subject(view)), NOW) == view


@given(views())
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


@given(views(), st.floats(0.1, 5))
def test_pasted_matrices_give_the_same_image_at_any_distance(view: View, distance: float) -> None:
    shown = view.for_size(SIZE)
    text = as_text("OpenGL matrices", subject(view))
    camera = read_view(text, View(Camera(distance=distance))).camera
    points = np.asarray(shown.eye) - 3.0 * np.asarray(shown.w) + np.array([[0, 0, 0], [1, 0.5, 0]])
    one, two = shown.project(points, SIZE), camera.project(points, SIZE)
    np.testing.assert_allclose(one.row, two.row, rtol=1e-4, atol=1e-4)
    np.testing.assert_allclose(one.column, two.column, rtol=1e-4, atol=1e-4)


def test_matrices_are_named_column_by_column_and_what_opengl_takes() -> None:
    camera = Camera(eye=(1, 2, 3), near=0.5, far=20.0)
    text = as_text("OpenGL matrices", Subject(View(camera), camera, "spheres", BOUNDS))
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
    text = as_text("OpenGL matrices", Subject(View(behind), behind, "spheres", BOUNDS))
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
    text = as_text("OpenGL matrices", Subject(View(camera), camera, "spheres", np.zeros((0, 3))))
    assert f"# {told}" in text.split("\n")


def test_a_path_that_is_no_text_is_written_as_shells_write_bytes() -> None:
    text = command_line(View(Camera()), "a 'b'\\\n\udcff.obj")
    assert text.startswith(r"lucida render $'a \'b\'\\\n\xff.obj' -o image.png")
    assert command_line(View(Camera()), "a 'b'").split(" --")[0] == (
        """lucida render 'a '"'"'b'"'"'' -o image.png"""
    )


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


@given(views())
def test_the_python_runs_as_it_is(view: View) -> None:
    names: dict[str, object] = {}
    exec(as_text("Python", subject(view)), names)
    assert names["camera"] == view.camera
    assert names.get("view", View(view.camera)) == view


@pytest.mark.parametrize(
    ("text", "camera"),
    [
        (
            "from renderer import Camera\nc = Camera.look_at((0, 0, 5), (0, 0, 0), fov_y_deg=40)",
            Camera.look_at((0, 0, 5), (0, 0, 0), fov_y_deg=40),
        ),
        ("renderer.Camera.canonical()", Camera()),
        ("Camera((1, 2, 3), distance=2)", Camera((1, 2, 3), distance=2)),
        (
            "[camera]\neye = [0, 0, 5]\ntarget = [0, 0, 0]\nfov_y_deg = 40",
            Camera.look_at((0, 0, 5), (0, 0, 0), fov_y_deg=40),
        ),
        ("[camera]\neye = [0, 0, 5]", Camera((0, 0, 5))),
        ("--eye=0,0,5", replace(NOW.camera, eye=(0, 0, 5))),
        (
            "lucida spheres --eye 0,0,5 --distance 3 # mine",
            replace(NOW.camera, eye=(0, 0, 5), distance=3),
        ),
    ],
)
def test_near_relatives_are_read(text: str, camera: Camera) -> None:
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
def test_of_a_whole_scene_file_the_camera_is_read(camera: str, view: View) -> None:
    """As the scene has it; a view file's viewport stands as it is."""
    ball = '[[objects]]\nshape = "sphere"\ncenter = [0, 0, 0]\nradius = 1\n'
    assert read_view(f"lucida = 1\n[camera]\n{camera}\n{ball}", NOW) == view
    alone = read_view(f"lucida = 1\n[camera]\n{camera}\n", NOW)
    assert alone == replace(view, fit="target" in camera)


@pytest.mark.parametrize(
    ("text", "fit"),
    [
        ("View(Camera(), fit=True)", True),
        ("View(Camera(), fit=False)", False),
        ("View(Camera(), wide=True)", False),
        ("View(Camera(), fit=wide)", False),
        ("renderer.View(Camera(), fit=1)", True),
        ("Picture(Camera(), fit=True)", False),
    ],
)
def test_a_view_in_python_is_fitted_where_it_says_so(text: str, fit: bool) -> None:
    assert read_view(text, NOW) == View(Camera(), fit)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("", "holds no camera"),
        ("clip_from_camera = " + "1 " * 16, "camera_from_world: is missing"),
        ("# [camera]\neye = 3", "eye: is unknown"),
        ("dear all,", "holds no camera"),
        ("x" * (MOST_CHARACTERS + 1), "long text"),
        ("[camera]\neye = [0, 0]", "camera.eye"),
        ("[camera]\neye = [0, 0, ", "line 2"),
        ("[camera]\nw = [0, 0, 0]", "camera.w: .*independent"),
        ("--eye=0,0", "is not 3 numbers"),
        ("--distance=-1", "--distance: -1 is not above 0"),
        ("--projection=fisheye", "invalid choice"),
        ('--eye="0,0', "is not 3 numbers"),
        ("Camera(eye=(0, 0, 5)", "not complete"),
        ("Camera(eye=(0, 0, x))", "plain numbers"),
        ("Camera(eye=(0, 0, 5), fov=3)", "fov"),
        ("Camera(distance=-1)", "distance: -1 is not above 0"),
        ("print('Camera (' + 'x')", "without a camera"),
        ("Camera(eye=" + "(" * 5000, "not complete"),
        ("camera_from_world = [1, 2, 3]", "has 3 numbers; give 16"),
        (
            "camera_from_world = " + "1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1",
            "clip_from_camera: is missing",
        ),
        (
            "camera_from_world = 1 0 0 4  0 1 0 5  0 0 1 6  0 0 0 1\nclip_from_camera = "
            + "1 " * 16,
            "column by column; transpose",
        ),
        (
            "camera_from_world = 0 0 0 0  0 0 0 0  0 0 0 0  0 0 0 1\nclip_from_camera = "
            + "1 " * 16,
            "no inverse",
        ),
        (
            "camera_from_world = 1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1\nclip_from_camera = "
            + "1 " * 16,
            "neither a perspective nor a parallel",
        ),
        (
            "camera_from_world = 1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1\n"
            "clip_from_camera = 0 0 0 0  0 0 0 0  0 0 0 -1  0 0 0 0",
            "viewport",
        ),
    ],
)
def test_what_is_no_camera_is_told_in_one_line(text: str, told: str) -> None:
    with pytest.raises(LucidaError) as error:
        read_view(text, NOW)
    line = str(error.value)
    assert line.startswith("clipboard: ")
    assert re.search(told, line), line
    assert "\n" not in line
    assert len(line) < 250


@given(st.text(max_size=200))
@example("camera_from_world=[" + "nan," * 16 + "]")
@example("[camera]\n" + "a" * 100)
@example("--fit --eye=inf,0,0")
@example("--help --eye=0,0,1")
def test_any_text_is_a_camera_or_one_error(text: str) -> None:
    try:
        view = read_view(text, NOW)
    except LucidaError as error:
        source = str(error).partition(":")[0]
    else:
        source, _ = "clipboard", replace(view.camera)  # checks itself
    assert source == "clipboard"


class TestCommandLine:
    """What is copied is what the command line takes."""

    VIEW = View(
        Camera(
            eye=(0.5, 1.5, -6.25),
            u=(-1.0, 0.125, 0.0),
            w=(0.0, -1e-05, -1.0),
            viewport=(-0.8, 0.7, -0.5, 0.5),
            near=1.5,
        ),
        fit=True,
    )

    def test_render_and_compare_draw_that_camera(self, tmp_path, monkeypatch, capsys) -> None:
        monkeypatch.chdir(tmp_path)
        save_view("corner.toml", self.VIEW)
        line = as_text("command line", replace(subject(self.VIEW), source="spheres"))
        words = shlex.split(line)[1:]
        assert words[:2] == ["render", "spheres"]
        extra = ["--channel", "depth", "--renderer", "ray", "--size", "48x27"]
        assert main([*words, *extra, "-o", "one.npy"]) == 0
        assert main(["render", "spheres", "--view", "corner.toml", *extra, "-o", "two.npy"]) == 0
        one, two = np.load("one.npy"), np.load("two.npy")
        assert np.array_equal(one, two)
        assert np.isfinite(one).any()
        capsys.readouterr()

    def test_the_window_takes_it_too(self, monkeypatch) -> None:
        seen = []
        monkeypatch.setattr(
            "app.window.viewer.run_viewer",
            lambda *_, change, **__: seen.append(change and change(NOW)) or 0,
        )
        words = shlex.split(as_text("command line", subject(self.VIEW)))
        options = [word for word in words if word.startswith("--")]
        assert main(["spheres", *options]) == 0
        assert seen[0].fit
        assert seen[0].camera == replace(self.VIEW.camera, far=None)
        assert main(["spheres"]) == 0
        assert seen[1] is None  # nothing to change
        assert view_command.NAME == "view"

    def test_a_viewport_stands_as_it_is_without_fit(self, monkeypatch) -> None:
        seen = []
        monkeypatch.setattr(
            "app.window.viewer.run_viewer", lambda *_, change, **__: seen.append(change(NOW)) or 0
        )
        for options, fit in (
            (["--viewport=-1,1,-1,1"], False),
            (["--viewport=-1,1,-1,1", "--fit"], True),
            (["--no-fit"], False),
            (["--eye=1,2,3"], True),
        ):
            assert main(options) == 0
            assert seen.pop().fit is fit

    @pytest.mark.parametrize(
        ("options", "told"),
        [
            ("--eye=1,2", "'1,2' is not 3 numbers; give e.g. 0,0,5"),
            ("--viewport=1,2,3", "is not 4 numbers; give e.g. -0.5,0.5"),
            ("--near=a", "'a' is not a number"),
            ("--w=0,0,0", "--w: (0, 0, 0) is not independent of u and v; give w a part"),
            ("--distance=nan", "--distance: nan is not finite"),
        ],
    )
    def test_a_mistake_is_one_line(self, capsys, options: str, told: str) -> None:
        assert main(["render", "spheres", "-o", "a.png", options]) == 2
        line = capsys.readouterr().err
        assert told in line
        assert line.count("\n") == 1


def test_the_copied_python_runs_in_a_program_of_its_own() -> None:
    scene = load_scene("still-life")
    program = as_text("Python", subject(scene.view)) + "print(view.for_size((32, 18)).fov_y_deg)\n"
    done = subprocess.run(
        [sys.executable, "-c", program], cwd=ROOT, capture_output=True, text=True, timeout=120
    )
    assert done.returncode == 0, done.stderr
    assert math.isclose(float(done.stdout), scene.view.for_size((32, 18)).fov_y_deg)


@pytest.mark.parametrize(
    ("scale", "off", "is_read"),
    [(1, 1e-6, True), (1, 1.2e-6, False), (100, 9e-5, True), (100, 2e-4, False)],
)
def test_a_matrix_is_affine_to_a_millionth_of_its_largest_number(
    scale: float, off: float, is_read: bool
) -> None:
    text = (
        f"camera_from_world = {scale} 0 0 {off}  0 {scale} 0 0  0 0 {scale} 0  0 0 0 1\n"
        "clip_from_camera = 1 0 0 0  0 1 0 0  0 0 -1 0  0 0 0 1"
    )
    if is_read:
        assert read_view(text, NOW).camera.is_parallel
    else:
        with pytest.raises(LucidaError, match="not affine"):
            read_view(text, NOW)


@pytest.mark.parametrize(
    ("depth", "near", "far"),
    [
        ("-8 -3", 0.25, 0.5),
        ("-0.2 -1", None, 10.0),  # near is in the eye's plane: nothing before it is drawn anyway
        ("-0.2 1", None, None),
        ("0.0 0", None, None),
        ("-0.0 0", None, None),
    ],
)
def test_of_parallel_matrices_clip_planes_in_front_of_the_eye_count(
    depth: str, near: float | None, far: float | None
) -> None:
    scale, shift = depth.split()
    text = (
        "camera_from_world = 1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1\n"
        f"clip_from_camera = 1 0 0 0  0 1 0 0  0 0 {scale} 0  0 0 {shift} 1"
    )
    camera = read_view(text, NOW).camera
    assert (camera.near, camera.far) == (near, far)


def test_of_a_command_line_only_whole_options_of_the_camera_count() -> None:
    camera = read_view("lucida scene#1.toml --eye 1,2,3 --dist 7", NOW).camera
    assert camera == replace(NOW.camera, eye=(1.0, 2.0, 3.0))


def test_a_text_has_up_to_a_hundred_thousand_characters() -> None:
    text = "--eye 1,2,3".ljust(MOST_CHARACTERS)
    assert read_view(text, NOW).camera.eye == (1.0, 2.0, 3.0)
    with pytest.raises(LucidaError, match="a long text"):
        read_view(text + " ", NOW)
