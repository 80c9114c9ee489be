"""View files: exact round trips, the documented defaults, whole files or none."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lucida.renderer.camera.camera import Camera
from lucida.renderer.files import load_view, save_view, view_from_toml, view_to_toml
from lucida.renderer.scene import View
from lucida.renderer.system.errors import LucidaError

numbers = st.floats(-1e12, 1e12, allow_nan=False)
parts = st.floats(-1.0, 1.0)
lengths = st.floats(1e-6, 1e6)


@st.composite
def views(draw) -> View:
    # A triangular basis is never singular; skewed, scaled and left-handed ones are among them.
    a, b, c = draw(lengths), -draw(lengths), draw(lengths)
    left, bottom = draw(st.floats(-1e3, 1e3)), draw(st.floats(-1e3, 1e3))
    near = draw(st.none() | lengths)
    camera = Camera(
        eye=(draw(numbers), draw(numbers), draw(numbers)),
        u=(a, 0.0, 0.0),
        v=(draw(parts) * b, b, 0.0),
        w=(draw(parts) * c, draw(parts) * c, c),
        distance=draw(lengths),
        viewport=(left, left + draw(lengths) + 1e-3, bottom, bottom + draw(lengths) + 1e-3),
        projection=draw(st.sampled_from(["perspective", "parallel"])),
        near=near,
        far=None if near is None else near + draw(lengths),
    )
    return View(camera, draw(st.booleans()))


@given(views())
def test_a_view_comes_back_exactly_from_its_text(view: View) -> None:
    assert view_from_toml(view_to_toml(view)) == view


def test_a_view_comes_back_exactly_from_its_file(tmp_path: Path) -> None:
    camera = Camera(eye=(0.1, 1 / 3, -1e-7), u=(2, 0.5, 0), viewport=(-1, 2, -0.5, 1), far=7.5)
    path = tmp_path / "a.toml"
    for view in (View(camera, fit=True), View(camera, fit=False)):
        save_view(path, view)
        assert load_view(path) == view
    assert [entry.name for entry in tmp_path.iterdir()] == ["a.toml"]


def test_every_field_defaults_to_the_canonical_camera() -> None:
    assert view_from_toml("[camera]") == View(Camera.canonical(), fit=False)
    view = view_from_toml('lucida = 1\n[camera]\nfit = true\nprojection = "parallel"\nfar = 3')
    assert view == View(Camera(projection="parallel", far=3.0), fit=True)


def test_a_view_file_may_say_what_the_camera_looks_at() -> None:
    text = "[camera]\neye = [0, 3, 8]\ntarget = [0, 1, 0]\nfov_y_deg = 35"
    looking = Camera.look_at((0, 3, 8), (0, 1, 0), fov_y_deg=35)
    assert view_from_toml(text) == View(looking, fit=True)
    assert view_from_toml(text + "\nfit = false") == View(looking, fit=False)


def test_a_view_that_cannot_be_written_leaves_the_old_file(tmp_path: Path) -> None:
    path = tmp_path / "a.toml"
    save_view(path, View(Camera.canonical()))
    before = path.read_bytes()
    with pytest.raises(LucidaError, match="missing"):
        save_view(tmp_path / "missing" / "a.toml", View(Camera.canonical()))
    assert path.read_bytes() == before


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "v.toml: camera: is missing"),
        ("[camera", "v.toml: line 1, column 8: "),
        ("[camera]\neye = [0, 0]", "v.toml: camera.eye: has 2 entries; give 3"),
        ("[camera]\neye = [0, 0, nan]", "v.toml: camera.eye: nan is not finite"),
        ("[camera]\nw = [0, 0, 0]", "v.toml: camera.w: (0, 0, 0) is not independent"),
        ("[camera]\ndistance = 0", "v.toml: camera.distance: 0 is not above 0"),
        ("[camera]\ndistance = true", "v.toml: camera.distance: is true or false; give a number"),
        ("[camera]\ndistence = 1", "v.toml: camera.distence: is unknown; did you mean 'distance'?"),
        ("[camera]\nnear = -1", "v.toml: camera.near: -1 is not above 0"),
        ('[camera]\nprojection = "fish"', "v.toml: camera.projection: 'fish' is unknown"),
        ("[camera]\nfit = 1", "v.toml: camera.fit: is a whole number; give true or false"),
        ("lucida = 2\n[camera]", "v.toml: lucida: the file has version 2"),
        ("lucida = true\n[camera]", "v.toml: lucida: True is not a version"),
        ("camera = 3", "v.toml: camera: is a whole number; give a table"),
        ("[camera]\ntarget = [0, 0, 1]", "v.toml: camera.eye: is missing; give it"),
        (
            "[camera]\neye = [0, 0, 1]\ntarget = [0, 0, 1]",
            "v.toml: camera.target: (0, 0, 1) is the",
        ),
        (
            "[camera]\nu = [1, 0, 0]\ntarget = [0, 0, 1]",
            "v.toml: camera.u: cannot be used together with target",
        ),
        ("[camera]\n[[objects]]", "v.toml: objects: is unknown"),
    ],
)
def test_mistakes_name_the_file_the_field_and_the_remedy(text: str, message: str) -> None:
    with pytest.raises(LucidaError) as caught:
        view_from_toml(text, "v.toml")
    assert str(caught.value).startswith(message)
    assert caught.value.remedy
    assert "\n" not in str(caught.value)
