"""Camera options of the command line: fields, target, field of view and lens."""

from __future__ import annotations

import argparse

import numpy as np
import pytest

from lucida import Camera, Lens, LucidaError, View
from lucida.app.cameras.options import add_camera_options, with_camera_options
from lucida.app.commands.arguments import Parser

BASE = View(Camera(eye=(1, 2, 3), distance=2.0, near=0.5), fit=True)


def parsed(*words: str) -> argparse.Namespace:
    parser = Parser("lucida")
    add_camera_options(parser)
    return parser.parse_args(words)


def view_of(*words: str, base: View = BASE) -> View:
    return with_camera_options(parsed(*words), base)


def test_no_option_leaves_the_view():
    assert view_of() is BASE


def test_a_target_and_a_field_of_view_are_look_at():
    view = view_of("--eye", "0,2,6", "--target", "0,1,0", "--up", "0,1,0", "--fov", "35")
    looking = Camera.look_at((0, 2, 6), (0, 1, 0), fov_y_deg=35)
    for name in ("eye", "u", "v", "w", "distance", "viewport"):
        assert np.allclose(getattr(view.camera, name), getattr(looking, name)), name
    assert view.camera.near == 0.5  # unchanged
    assert view.fit


def test_a_target_alone_keeps_eye_and_distance():
    camera = view_of("--target=4,2,3").camera
    assert camera.eye == BASE.camera.eye
    assert camera.distance == BASE.camera.distance
    assert camera.w == (-1, 0, 0)


def test_up_alone_keeps_the_direction():
    camera = view_of("--up", "1,0,0").camera
    assert camera.w == BASE.camera.w
    assert camera.v == (1, 0, 0)


def test_the_field_of_view_is_that_of_the_given_viewport():
    camera = view_of("--fov", "90", "--viewport", "-2,2,-3,3").camera
    assert camera.distance == pytest.approx(3.0)
    assert camera.fov_y_deg == pytest.approx(90)


@pytest.mark.parametrize("word", ["-1,-0.5,3", "-.5,0,1"])
def test_a_vector_may_begin_with_a_minus(word):
    assert view_of("--eye", word).camera.eye[0] < 0


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--target=1,2,3"], "--target: (1, 2, 3) is the eye itself; look at another point"),
        (["--target=1,9,3"], "--up: (0, 1, 0) is along the view direction; give another up"),
        (
            ["--target=0,0,0", "--u=1,0,0"],
            "--u: cannot be used together with --target; give one of the two",
        ),
        (
            ["--up=0,1,0", "--w=0,0,1"],
            "--w: cannot be used together with --up; give one of the two",
        ),
        (
            ["--fov=40", "--distance=2"],
            "--distance: cannot be used together with --fov; give one of the two",
        ),
        (["--fov=180"], "--fov: 180 is not between 0 and 180; give e.g. 40"),
        (["--fov=40", "--projection=parallel"], "--fov: does not apply to a parallel projection"),
    ],
)
def test_mistakes_name_the_option(words, message):
    with pytest.raises(LucidaError) as caught:
        view_of(*words)
    assert str(caught.value).startswith(message)


def test_a_lens_is_put_on_and_taken_off():
    view = view_of("--lens", "brown:k1=-0.2,k2=0.03")
    assert view.camera.lens == Lens("brown", {"k1": -0.2, "k2": 0.03})
    assert view_of("--lens", "none", base=view) == BASE
    wide = view_of("--lens", "equidistant", "--fov", "200").camera
    assert wide.fov_y_deg == pytest.approx(200, abs=1e-4)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--lens", "browm"), "'browm' is unknown"),
        (("--lens", "brown:k9=1"), "k9"),
        (("--lens", "brown:k1=x"), "'x' is not a number"),
        (("--lens", "brown:k1"), "'k1' has no value; give k1=0.1"),
        (("--lens", "brown:k1=0.1,k1=0.2"), "given twice"),
        (("--lens", "equirectangular:k1=1"), "leave it out"),
    ],
)
def test_a_wrong_lens_is_refused(words, message, capsys):
    with pytest.raises(SystemExit) as ended:
        parsed(*words)
    assert ended.value.code == 2
    assert message in capsys.readouterr().err


def test_parallel_rays_and_a_lens_are_refused():
    with pytest.raises(LucidaError, match=r"--lens.*parallel rays cannot pass through a lens"):
        view_of("--lens", "equisolid", "--projection", "parallel")
