"""Scene files: every kind of entry, the documented defaults, and mistakes told in one line."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lucida.renderer.camera.camera import Camera
from lucida.renderer.files import load_scene
from lucida.renderer.files.scene_file import scene_from_toml
from lucida.renderer.files.scene_parts import SceneParts
from lucida.renderer.scene import (
    Checker,
    DirectionalLight,
    Material,
    PointLight,
    Scene,
    Sphere,
    View,
    flatten,
    framing,
)
from lucida.renderer.scene.limits import TRIANGLES
from lucida.renderer.system.cancelling import cancelled_by
from lucida.renderer.system.errors import LucidaError

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
BALL = '[[objects]]\ntype = "sphere"\n'


def scene(text: str) -> Scene:
    return scene_from_toml(text, Path(), "s.toml", "s")


def test_a_full_scene_file() -> None:
    read = scene(
        """
        lucida = 1
        name = "two things"
        ambient = [0.1, 0.2, 0.3]
        background = "#ff8000"
        [camera]
        eye = [0, 0, 5]
        target = [0, 0, 0]
        fov_y_deg = 90
        near = 0.5
        [materials.red]
        diffuse = [0.8, 0.1, 0.1]
        specular = [0.5, 0.5, 0.5]
        shininess = 90
        checker = { diffuse = "#000000", size = 0.25 }
        [[objects]]
        type = "sphere"
        name = "ball"
        material = "red"
        center = [1, 2, 3]
        radius = 0.5
        [[objects]]
        type = "box"
        size = [1, 2, 3]
        material = { diffuse = "#ffffff" }
        translate = [0, 1, 0]
        scale = 2
        [[lights]]
        type = "point"
        position = [1, 2, 3]
        color = [2, 2, 2]
        [[lights]]
        type = "directional"
        direction = [0, -1, 0]
        """
    )
    assert read.name == "two things"
    assert read.ambient == (0.1, 0.2, 0.3)
    half = ((128 / 255 + 0.055) / 1.055) ** 2.4
    assert read.background == pytest.approx((1.0, half, 0.0), abs=1e-6)
    ball, box = read.objects
    assert ball.shape == Sphere((1, 2, 3), 0.5)
    assert (ball.name, box.name) == ("ball", "")
    assert ball.material == Material((0.8, 0.1, 0.1), (0.5, 0.5, 0.5), 90, Checker((0, 0, 0), 0.25))
    assert box.material == Material((1, 1, 1))
    np.testing.assert_allclose(
        flatten(Scene((box,))).bounds, [[-1, -1, -3], [1, 3, 3]], rtol=1e-6, atol=1e-6
    )
    assert read.lights == (PointLight((1, 2, 3), (2, 2, 2)), DirectionalLight((0, -1, 0)))
    assert read.view.fit
    assert read.view.camera.eye == (0, 0, 5)
    assert read.view.camera.near == 0.5
    assert read.view.camera.fov_y_deg == pytest.approx(90)


@pytest.mark.parametrize(
    ("table", "bounds"),
    [
        ('type = "box"', (1, 1, 1)),
        ('type = "rectangle"\nwidth = 4\ndepth = 2', (4, 0, 2)),
        ('type = "disk"\nradius = 2', (4, 0, 4)),
        ('type = "cylinder"\nradius = 1\nheight = 3', (2, 3, 2)),
        ('type = "cone"\nradius = 1\nheight = 3\nsmooth = false', (2, 3, 2)),
        ('type = "torus"\nradius = 2\ntube_radius = 0.5', (5, 1, 5)),
        ('type = "torus"\nradius = 2\ntube_radius = 0.5\nrotate_deg = [90, 0, 0]', (5, 5, 1)),
        ('type = "box"\nscale = [1, 2, 3]', (1, 2, 3)),
        ('type = "sphere"', (2, 2, 2)),
    ],
)
def test_every_type_has_its_size_about_the_origin(table: str, bounds: tuple[float, ...]) -> None:
    low, high = flatten(scene(f"[[objects]]\n{table}\n")).bounds
    np.testing.assert_allclose(high - low, bounds, atol=1e-5)
    np.testing.assert_allclose(high + low, 0, atol=1e-5)


def test_what_a_scene_file_leaves_out() -> None:
    read = scene(BALL)
    assert read.name == "s"
    assert read.lights == framing.LIGHTS
    assert (read.ambient, read.background) == (framing.AMBIENT, framing.BACKGROUND)
    assert read.objects[0].material == Material()
    assert scene(BALL + "\n[camera]").view == View(Camera.canonical(), fit=True)
    assert scene("lights = []\n" + BALL).lights == ()


@pytest.mark.parametrize(
    ("camera", "fit"),
    [
        ("", True),
        ("eye = [0, 0, 1]", True),
        ("fit = false", False),
        ("viewport = [-1, 1, -1, 1]", False),
        ("viewport = [-1, 1, -1, 1]\nfit = true", True),
        ("eye = [0, 0, 1]\ntarget = [0, 0, 0]", True),
        ("eye = [0, 0, 1]\ntarget = [0, 0, 0]\nfit = false", False),
    ],
)
def test_a_scene_s_camera_fits_unless_it_gives_its_viewport(camera: str, fit: bool) -> None:
    assert scene(f"{BALL}[camera]\n{camera}").view.fit is fit


def test_the_aspect_of_a_look_at_camera_is_in_every_picture() -> None:
    view = scene(f"{BALL}[camera]\neye = [0, 0, 2]\ntarget = [0, 0, 0]\naspect = 1.5").view
    for size in ((100, 100), (300, 100)):
        left, right, bottom, top = view.for_size(size).viewport
        assert right - left >= 1.5
        assert top - bottom >= 1.0
        assert (right - left) / (top - bottom) == pytest.approx(size[0] / size[1])


MISTAKES = {
    "objects = [\n  {type = 'box' size = 1}\n]": "line 2, column 17: ",
    'a = "': "line 1, column 6: ",
    "a = 1\na = 2": "line 2, column 6: cannot overwrite a value",
    "lucida = 9\nnonsense = 1": "lucida: the file has version 9; this program reads up to 1",
    "lucida = 'x'": "lucida: 'x' is not a version",
    "name = 'x'": "objects: is missing",
    "objects = 3": "objects: is a whole number; give a list",
    "objects = [3]": "objects[0]: is a whole number; give a table",
    "object = []": "object: is unknown; did you mean 'objects'?",
    "[[objects]]\nradius = 1": "objects[0].type: is missing",
    "[[objects]]\ntype = 'spere'": "objects[0].type: 'spere' is unknown; did you mean 'sphere'?",
    BALL + "radios = 1": "objects[0].radios: is unknown; did you mean 'radius'?",
    BALL + "radius = -1": "objects[0].radius: -1 is not above 0",
    BALL + "radius = nan": "objects[0].radius: nan is not finite",
    BALL + "radius = 1e308": "objects[0].radius: 1e+308 is too large",
    BALL + "radius = 1e-300": "objects[0].radius: 1e-300 is below 1e-09",
    BALL + "radius = 1979-05-27": "objects[0].radius: is a date; give a number",
    BALL + "center = [1, inf, 0]": "objects[0].center: inf is not finite",
    BALL + "center = [1, 'a', 0]": "objects[0].center[1]: is text in quotes; give a number",
    BALL + BALL + "material = {difuse = 1}": (
        "objects[1].material.difuse: is unknown; did you mean 'diffuse'?"
    ),
    BALL + "material = {diffuse = '#12345'}": "objects[0].material.diffuse: '#12345' is not a col",
    BALL + "material = {diffuse = [1, -1, 0]}": "objects[0].material.diffuse: -1 is outside 0 to",
    BALL + "material = {shininess = 0}": "objects[0].material.shininess: 0 is outside 1 to 1000",
    BALL + "material = {checker = {size = 0}}": "objects[0].material.checker.size: 0 is not above",
    BALL + "material = 'red'": "objects[0].material: 'red' is unknown; define it under [materials]",
    BALL + "material = 'rde'\n[materials.red]": (
        "objects[0].material: 'rde' is unknown; did you mean 'red'?"
    ),
    BALL + "[materials]\nred = 1": "materials.red: is a whole number; give a table",
    "[[objects]]\ntype = 'box'\nscale = 0": "objects[0].scale: (0.0, 0.0, 0.0) flattens the shape",
    "[[objects]]\ntype = 'box'\nscale = 1e300": "objects[0].scale: 1e+300 is too large",
    "[[objects]]\ntype = 'cone'\nsegments = 1000000000": (
        "objects[0].segments: 1000000000 is outside 3 to 1024"
    ),
    "[[objects]]\ntype = 'model'\nfile = 'none.obj'": "objects[0].file: none.obj: does not exist",
    BALL + "[[lights]]\ntype = 'point'": "lights[0].position: is missing",
    BALL + "[[lights]]\ntype = 'sun'": "lights[0].type: 'sun' is unknown",
    BALL + "[[lights]]\ntype = 'directional'\ndirection = [0, 0, 0]": (
        "lights[0].direction: (0, 0, 0) has no direction"
    ),
    BALL + "[camera]\nw = [0, 0, 0]": "camera.w: (0, 0, 0) is not independent of u and v",
    BALL + "[camera]\ntarget = [0, 0, 0]": "camera.eye: is missing",
    BALL + "[camera]\neye = [1, 1, 1]\ntarget = [1, 1, 1]": "camera.target: (1, 1, 1) is the eye",
    BALL + "[camera]\neye = [0, 0, 1]\ntarget = [0, 0, 0]\nfov_y_deg = 180": (
        "camera.fov_y_deg: 180 is not between 0 and 180"
    ),
    BALL + "[camera]\neye = [0, 0, 1]\ntarget = [0, 0, 0]\nu = [1, 0, 0]": (
        "camera.u: cannot be used together with target"
    ),
    "ambient = -1": "ambient: is a whole number; give text in quotes or a list",
    "ambient = [0, 0, -1]\n" + BALL: "ambient: -1 is outside 0 to",
    "background = 'red'\n" + BALL: "background: 'red' is not a colour",
}


@pytest.mark.parametrize("text", MISTAKES)
def test_mistakes_name_the_file_the_field_and_the_remedy(text: str) -> None:
    with pytest.raises(LucidaError) as caught:
        scene(text)
    assert str(caught.value).startswith(f"s.toml: {MISTAKES[text]}")
    assert caught.value.remedy
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("a = " + "[" * 100_000, "is nested too deeply"),
        ("a = " + "{a=" * 100_000, "is nested too deeply"),
        ("a" + ".a" * 500_000 + " = 1", "line 1: has a key of too many parts"),
        ("\n[" + '"a".' * 500_000 + "a]", "line 2: has a key of too many parts"),
        ("a = " + "1" * 10_000, "holds a number of too many digits"),
        ("[[a]]\nb = [0, [" + "9" * 400 + "]]", "a[0].b[1][0]: is a whole number of 400 digits"),
        ("objects = [" + "{type = 'sphere'}," * 10_001 + "]", "objects: holds 10001 objects"),
        ("lights = [" + "{}," * 65 + "]\n" + BALL, "lights: holds 65 lights; give at most 64"),
        ("x" * 1_000_000, "line 1, column 1000001: "),
    ],
)
def test_hostile_text_is_refused_in_bounded_time(text: str, message: str) -> None:
    with pytest.raises(LucidaError) as caught:
        scene(text)
    assert str(caught.value).startswith(f"s.toml: {message}")


def test_the_triangles_of_a_scene_are_counted_before_all_are_made(monkeypatch) -> None:
    monkeypatch.setattr("lucida.renderer.files.scene_file.TRIANGLES", 30)
    monkeypatch.setattr(SceneParts, "mesh", None)
    with pytest.raises(LucidaError, match=r"objects: holds 12000 triangles; give at most 30"):
        scene("objects = [" + "{type = 'box'}," * 1000 + "]")


HEAVY = {
    "torus": "{type = 'torus', segments = 256, sides = 1024},",
    "cylinder": "{type = 'cylinder', segments = 1024},",
    "cone": "{type = 'cone', segments = 1024},",
    "disk": "{type = 'disk', segments = 1024},",
}


@pytest.mark.parametrize("name", HEAVY)
def test_a_few_lines_that_make_millions_of_triangles_are_refused_unbuilt(
    name: str, monkeypatch
) -> None:
    each = len(scene(f"objects = [{HEAVY[name]}]").objects[0].shape.faces)
    most = TRIANGLES if name == "torus" else 9 * each
    count = most // each + 1
    monkeypatch.setattr("lucida.renderer.files.scene_file.TRIANGLES", most)
    monkeypatch.setattr(SceneParts, "mesh", None)
    with pytest.raises(LucidaError) as caught:
        scene(f"objects = [{HEAVY[name] * count}]")
    problem = f"holds {each * count} triangles; give at most {most}, or split the scene"
    assert str(caught.value) == f"s.toml: objects: {problem}"


def test_copies_of_a_model_are_counted(tmp_path: Path, monkeypatch) -> None:
    (tmp_path / "t.obj").write_text(TRIANGLE)
    monkeypatch.setattr("lucida.renderer.files.scene_file.TRIANGLES", 10)
    table = "[[objects]]\ntype = 'model'\nfile = 't.obj'\n"
    (tmp_path / "a.toml").write_text(table * 10)
    assert len(load_scene(tmp_path / "a.toml").objects) == 10
    (tmp_path / "a.toml").write_text(table * 11)
    with pytest.raises(LucidaError, match="holds 11 triangles"):
        load_scene(tmp_path / "a.toml")


def test_reading_a_scene_is_cancelled_between_its_objects(monkeypatch) -> None:
    checks, built = iter([None, None, KeyboardInterrupt]), []

    def check() -> None:
        if error := next(checks):
            raise error

    monkeypatch.setattr(SceneParts, "mesh", lambda *_: built.append(0) or ())
    with pytest.raises(KeyboardInterrupt), cancelled_by(check):
        scene("objects = [{type = 'box'}, {type = 'box'}, {type = 'box'}]")
    assert len(built) == 2


# Models in scene files.


def test_a_model_s_path_begins_at_its_scene_file(tmp_path: Path) -> None:
    (tmp_path / "models").mkdir()
    (tmp_path / "models" / "t.obj").write_text(TRIANGLE)
    (tmp_path / "a.toml").write_text(
        """
        [[objects]]
        type = "model"
        file = "models/t.obj"
        translate = [10, 0, 0]
        [[objects]]
        type = "model"
        name = "second"
        file = "models/t.obj"
        scale = -2
        material = { diffuse = "#000000" }
        """
    )
    read = load_scene(tmp_path / "a.toml")
    assert [entry.name for entry in read.objects] == ["t", "second"]
    assert [entry.material.diffuse for entry in read.objects] == [
        framing.MATERIAL.diffuse,
        (0, 0, 0),
    ]
    np.testing.assert_array_equal(flatten(read).bounds, [[-2, -2, 0], [11, 1, 0]])


def test_the_parts_of_a_model_are_named_below_it(tmp_path: Path) -> None:
    parts = "v 0 0 0\nv 1 0 0\nv 0 1 0\no a\nf 1 2 3\nv 0 0 1\no b\nf 1 2 4\n"
    (tmp_path / "t.obj").write_text(parts)
    (tmp_path / "a.toml").write_text('[[objects]]\ntype="model"\nname="m"\nfile="t.obj"')
    assert [entry.name for entry in load_scene(tmp_path / "a.toml").objects] == ["m/a", "m/b"]


def test_a_broken_model_is_named_with_its_place_in_the_scene(tmp_path: Path) -> None:
    (tmp_path / "t.obj").write_text(TRIANGLE + "f 1 2 4\n")
    path = tmp_path / "a.toml"
    path.write_text('[[objects]]\ntype = "model"\nfile = "t.obj"')
    with pytest.raises(LucidaError) as caught:
        load_scene(path)
    assert str(caught.value).startswith(
        f"{path}: objects[0].file: {tmp_path / 't.obj'}: line 5: 'f 1 2 4' is not valid"
    )


def test_a_scene_cannot_include_a_scene(tmp_path: Path) -> None:
    path = tmp_path / "a.toml"
    path.write_text('[[objects]]\ntype = "model"\nfile = "a.toml"')
    with pytest.raises(LucidaError, match=r"objects\[0\]\.file: .*a\.toml: is a scene file; give"):
        load_scene(path)
