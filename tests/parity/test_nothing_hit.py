"""An image that shows nothing: the reason, and who says it."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest

from app.cli import main
from app.compare import comparing
from renderer import Camera, Scene, load_scene
from renderer.compare import compare
from renderer.lenses import Lens
from renderer.nothing_hit import middle_of, why_nothing_is_hit
from renderer.scene import Mesh, SceneObject, Sphere, flatten

BALL = flatten(Scene((SceneObject(Sphere((0, 0, -5), 1.0)),)))
TRIANGLE = flatten(Scene((SceneObject(Mesh([(0, 0, -4), (1, 0, -6), (0, 1, -6)], [[0, 1, 2]])),)))
BEHIND = ["--eye", "0,1,-30"]  # the scenes' cameras look along -z


@pytest.mark.parametrize("flat", [BALL, TRIANGLE])
@pytest.mark.parametrize("projection", ["perspective", "parallel"])
@pytest.mark.parametrize(
    ("camera", "why"),
    [
        (Camera(eye=(0, 0, -6.5)), "everything is behind the eye"),
        (Camera(near=6.5), "everything is behind the eye or nearer than near = 6.5"),
        (Camera(far=3.9), "everything is farther than far = 3.9"),
        (Camera(eye=(90, 0, 0)), "everything is outside of the picture: left"),
        (
            Camera(eye=(90, 0, 0), w=(0, 0, 2), distance=2, far=2.5),
            "everything is outside of the picture: left",
        ),
        (Camera(eye=(90, 0, 0), w=(0, 0, 2), far=1.9), "everything is farther than far = 1.9"),
    ],
)
def test_the_reason(flat, projection, camera, why):
    assert why_nothing_is_hit(flat, replace(camera, projection=projection)).text == why


def test_a_ball_that_reaches_in_front_of_the_eye_is_not_behind_it():
    assert why_nothing_is_hit(BALL, Camera(eye=(90, 0, -5.5))).cause != "behind"


@pytest.mark.parametrize("flat", [BALL, TRIANGLE])
@pytest.mark.parametrize(
    ("model", "camera", "cause", "word"),
    [
        ("brown", Camera(eye=(0, 0, -6.5)), "behind", "behind the eye"),
        ("fisheye", Camera(far=3.5), "clip", "far = 3.5"),
        ("fisheye", Camera(near=9.0), "clip", "near = 9"),
        ("orthographic", Camera(eye=(0, 0, -9), near=1.0), "lens", "outside of the lens"),
        ("fisheye", Camera(eye=(40, 0, 0)), "beside", "picture: left"),
        ("fisheye", Camera(eye=(0, 40, 0)), "beside", "picture: below"),
    ],
)
def test_the_reason_through_a_lens(flat, model, camera, cause, word):
    reason = why_nothing_is_hit(flat, replace(camera, lens=Lens(model)))
    assert reason.cause == cause
    assert word in reason.text


def test_some_objects_are_counted():
    flat = flatten(Scene(tuple(SceneObject(Sphere((90, 0, z), 1.0)) for z in (-5, 5, 8))))
    told = "everything is outside of the picture: right; 2 of 3 are behind the eye"
    assert why_nothing_is_hit(flat, Camera()).text == told


@pytest.mark.parametrize("projection", ["perspective", "parallel"])
def test_a_viewport_off_the_axis_is_to_blame_where_one_on_it_would_see(projection):
    camera = Camera(viewport=(7, 8, -0.5, 0.5), projection=projection)
    reason = why_nothing_is_hit(BALL, camera)
    assert reason.cause == "viewport"
    assert "x from 7 to 8" in reason.text
    assert why_nothing_is_hit(BALL, replace(camera, eye=(90, 40, 0))).cause == "beside"


@pytest.mark.parametrize("projection", ["perspective", "parallel"])
def test_what_is_smaller_than_a_pixel_is_told_with_its_size(projection):
    flat = flatten(Scene((SceneObject(Sphere((0, 0, -5), 0.001)),)))
    camera = Camera(projection=projection)
    reason = why_nothing_is_hit(flat, camera, (8, 6))
    assert reason.cause == "small"
    pixels = 0.002 * 8 / (1 if camera.is_parallel else 5)
    assert f"pixel: {pixels:.2g} x" in reason.text
    assert why_nothing_is_hit(flat, camera, (80_000, 60_000)).cause == "missed"


def test_what_reaches_from_behind_the_eye_may_be_anywhere():
    """Its outline in the image is not that of its corners."""
    plain = Mesh([(-9, -1, 9), (9, -1, 9), (0, -1, -9)], [[0, 1, 2]])
    camera = Camera(viewport=(-0.5, 0.5, 3, 4))
    assert (
        why_nothing_is_hit(flatten(Scene((SceneObject(plain),))), camera, (8, 6)).cause == "missed"
    )


def test_an_empty_scene():
    assert why_nothing_is_hit(flatten(Scene(())), Camera()).text == "the scene has no objects"


def test_the_middle_is_of_the_bounds():
    assert middle_of(BALL) == (0, 0, -5)


class TestCommands:
    @pytest.fixture(autouse=True)
    def in_an_empty_folder(self, tmp_path, monkeypatch):
        monkeypatch.chdir(tmp_path)

    @pytest.mark.parametrize("channel", ["color", "depth", "id"])
    def test_render_says_it_and_writes(self, capsys, tmp_path, channel, gl_backend):
        line = ["render", "canonical", "-o", "a.npy", "--size", "8x6", "--backend", gl_backend]
        assert main([*line, "--channel", channel, *BEHIND]) == 0
        told = capsys.readouterr()
        assert told.err.startswith("lucida: nothing is hit: everything is behind the eye; --target")
        assert told.err.count("\n") == 1
        written = np.load(tmp_path / "a.npy")
        assert written.shape[:2] == (6, 8)
        assert main([*line, "--channel", channel]) == 0
        assert capsys.readouterr().err == ""

    def test_the_remedy_helps(self, capsys, gl_backend):
        line = ["render", "canonical", "-o", "a.npy", "--size", "8x6", "--backend", gl_backend]
        main([*line, *BEHIND])
        target = next(w for w in capsys.readouterr().err.split() if w.startswith("--target="))
        assert main([*line, *BEHIND, target]) == 0
        assert capsys.readouterr().err == ""

    def test_compare_is_no_success(self, capsys, gl_backend):
        line = ["compare", "canonical", "--size", "8x6", "--backend", gl_backend]
        assert main([*line, *BEHIND]) == 1
        told = capsys.readouterr()
        assert told.out.startswith("nothing is hit in either image: everything is behind the eye\n")
        assert main([*line, *BEHIND, "--json"]) == 1
        report = json.loads(capsys.readouterr().out)
        assert report["nothing_hit"] == "everything is behind the eye"
        assert main([*line, "--json"]) == 0
        assert json.loads(capsys.readouterr().out)["nothing_hit"] is None


def test_the_window_s_words(gl_backend):
    scene = load_scene("canonical")
    away = Camera(eye=(0, 0, -30))
    empty = compare(scene, away, (8, 6), gl_backend)
    assert empty.summary_short() == "nothing is hit: everything is behind the eye"
    told = "Nothing is hit in either image: everything is behind the eye"
    assert comparing.headline(empty) == (told, False)
    assert comparing.headline(empty, "shadows") == (told, False)


def test_an_object_far_away_is_judged_where_it_stands():
    mesh = Mesh([(0, 0, -4), (1, 0, -6), (0, 1, -6)], [[0, 1, 2]])
    moved = np.eye(4)
    moved[:3, 3] = (0, 0, 1e6)
    flat = flatten(Scene((SceneObject(replace(mesh, transform=moved)),)))
    assert why_nothing_is_hit(flat, Camera()).text == "everything is behind the eye"


def balls(*places: tuple[float, float, float, float]):
    return flatten(Scene(tuple(SceneObject(Sphere((x, y, z), r)) for x, y, z, r in places)))


@pytest.mark.parametrize(
    ("places", "camera", "cause", "told"),
    [
        (
            [(0, 0, -1, 0.1), (0, 0, -20, 0.1)],
            Camera(near=2, far=10),
            "clip",
            "all that is in view is nearer than near = 2 or farther than far = 10",
        ),
        (
            [(0, 0, -1, 0.1), (50, 0, -5, 0.1)],
            Camera(near=2),
            "clip",
            "all that is in view is nearer than near = 2",
        ),
        (
            [(0, 0, -100, 0.1), (50, 0, -5, 0.1), (0, 0, 9, 1)],
            Camera(far=20),
            "clip",
            "all that is in view is farther than far = 20; 1 of 3 are behind the eye",
        ),
        (
            [(50, 0, -1, 0.1), (50, 0, -20, 0.1)],
            Camera(near=2, far=10),
            "beside",
            "everything is outside of the picture: right",
        ),
        (
            [(0, 0, 0, 3)],
            Camera(far=2),
            "clip",
            "no viewing ray meets an object within far = 2",
        ),
        (
            [(0, 0, -5, 6)],
            Camera(near=1.5, far=2),
            "clip",
            "no viewing ray meets an object between near = 1.5 and far = 2",
        ),
        (
            [(0, 0, -5, 0.1), (0, 0, -30, 1)],
            Camera(viewport=(0.021, 0.03, 0.021, 0.03), far=100),
            "missed",
            "no viewing ray meets an object",
        ),
    ],
)
def test_near_and_far_are_to_blame_for_what_would_be_in_view(places, camera, cause, told):
    assert tuple(why_nothing_is_hit(balls(*places), camera)) == (cause, told)
