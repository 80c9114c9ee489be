"""An image that is black or shows nothing: the reason, the remedy, and who says it."""

import json
from dataclasses import replace

import numpy as np
import pytest
from option_changes import with_options

from lucida import Camera, load_scene
from lucida.app.cameras.remedies import helped, remedy_for
from lucida.app.cli import main
from lucida.app.images.compare import comparing
from lucida.app.state.app_state import AppState
from lucida.renderer.camera.lenses import Lens
from lucida.renderer.compare.raster_and_ray import compare
from lucida.renderer.compare.why_black import Darkness, darkness, middle_of, why_nothing_is_hit
from lucida.renderer.scene import DirectionalLight, Mesh, Scene, SceneObject, Sphere, View, flatten
from lucida.renderer.scene.focus import scene_focus
from lucida.renderer.trace import Tracer

SIZE = (32, 24)
BALL, TRIANGLE = Sphere((0, 0, -5), 1.0), Mesh([(0, 0, -4), (1, 0, -6), (0, 1, -6)], [[0, 1, 2]])
AHEAD, BACK = DirectionalLight((0, 0, -1)), DirectionalLight((0, 0, 1))
FAR_AWAY = Camera(eye=(0.3, 0.4, 900), viewport=(-90, 90, -90, 90), distance=50)
BEHIND = ["--eye", "0,1,-30"]  # the scenes' cameras look along -z


def a_scene(*shapes, lights=(AHEAD,), ambient=(0.0, 0.0, 0.0)):
    return Scene(tuple(map(SceneObject, shapes or (BALL,))), lights, ambient)


def seen(scene, camera):
    with Tracer(scene) as tracer:
        return darkness(flatten(scene), camera, tracer.render(camera, SIZE))


@pytest.mark.parametrize("shape", [BALL, TRIANGLE])
@pytest.mark.parametrize("projection", ["perspective", "parallel"])
@pytest.mark.parametrize(
    ("camera", "cause", "words"),
    [
        (Camera(eye=(0, 0, -19)), "behind", "everything is behind the eye"),
        (Camera(eye=(90, 0, 0)), "beside", "picture: left"),
        (Camera(eye=(0, 40, 0)), "beside", "picture: below"),
        (Camera(viewport=(5, 6, -0.5, 0.5)), "beside", "picture: left"),
        (Camera(near=50.0), "clip", "cut by near = 50"),
        (Camera(near=0.1, far=0.5), "clip", "cut by near = 0.1 and far = 0.5"),
        (
            Camera(eye=(0.3, 0.4, 900), viewport=(-90, 90, -90, 90), distance=50),
            "beside",
            "no viewing",
        ),
    ],
)
def test_the_reason_that_nothing_is_hit_and_its_remedy(shape, projection, camera, cause, words):
    scene, camera = a_scene(shape, ambient=(0.1, 0.1, 0.1)), replace(camera, projection=projection)
    dark = seen(scene, camera)
    assert dark.reason is not None
    assert dark.reason.cause == cause
    assert words in dark.reason.text
    assert remedy_for(dark.reason)
    better = helped(AppState.for_scene(scene, View(camera)), dark.reason, dark, scene_focus(scene))
    assert seen(scene, better.view.for_size(SIZE)).shown(0.0) is None


@pytest.mark.parametrize("shape", [BALL, TRIANGLE])
@pytest.mark.parametrize(
    ("model", "camera", "cause"),
    [
        ("brown", Camera(eye=(0, 0, -6.5)), "behind"),
        ("fisheye", Camera(far=3.5), "clip"),
        ("orthographic", Camera(eye=(0, 0, -9)), "lens"),
        ("fisheye", Camera(eye=(40, 0, 0)), "beside"),
    ],
)
def test_the_reason_through_a_lens(shape, model, camera, cause):
    assert (
        why_nothing_is_hit(flatten(a_scene(shape)), replace(camera, lens=Lens(model)))[0] == cause
    )


def test_an_eye_inside_an_object_that_far_cuts():
    flat = flatten(a_scene(Sphere((0, 0, 0), 3.0)))
    assert why_nothing_is_hit(flat, Camera(far=2)).cause == "clip"


def test_a_scene_without_a_visible_object():
    assert why_nothing_is_hit(flatten(Scene(())), Camera()).text == "the scene has no objects"
    reason = why_nothing_is_hit(flatten(Scene(())), Camera())
    assert remedy_for(reason) == ""
    state = AppState.for_scene(load_scene("canonical"))
    assert helped(state, reason, Darkness(0.0, reason), scene_focus(state.scene)) is state


def test_an_object_far_away_is_judged_where_it_stands():
    moved = np.eye(4)
    moved[:3, 3] = (0, 0, 1e6)
    flat = flatten(a_scene(replace(TRIANGLE, transform=moved)))
    assert why_nothing_is_hit(flat, Camera()).cause == "behind"


def test_the_middle_is_of_the_bounds():
    assert middle_of(flatten(a_scene())) == (0, 0, -5)


@pytest.mark.parametrize(
    ("scene", "text"),
    [
        (a_scene(lights=()), "the scene has no light"),
        (a_scene(lights=(DirectionalLight((0, 0, -1), (0, 0, 0)),)), "the scene has no light"),
        (a_scene(lights=(BACK,)), "no light reaches the visible surfaces"),
        (a_scene(lights=(), ambient=(0.1, 0.1, 0.1)), ""),
        (a_scene(), ""),
    ],
)
def test_an_image_without_light_says_why(scene, text):
    reason = seen(scene, Camera(viewport=(-0.1, 0.1, -0.1, 0.1))).shown(0.0)
    assert (reason.text if reason else "") == text
    assert reason is None or reason.cause == "light"


def test_an_exposure_that_hides_all_is_told_and_can_be_helped():
    dark = seen(a_scene(lights=(DirectionalLight((0, 0, -1), (1e-3,) * 3),)), Camera())
    reason = dark.shown(-4.0)
    assert dark.reason is None
    assert reason is not None
    assert reason.cause == "exposure"
    state = with_options(AppState.for_scene(load_scene("canonical")), images={"exposure_ev": -4.0})
    better = helped(state, reason, dark, scene_focus(state.scene))
    assert dark.shown(better.images.exposure_ev) is None


def test_an_exposure_at_which_something_is_just_visible():
    assert Darkness(1.0, None).shown(-11.0) is None
    assert Darkness(1.0, None).shown(-13.0) is not None
    assert Darkness(1.0, None).shown(-8.0, is_linear=True) is not None
    assert Darkness(float("inf"), None).shown(8.0) is None


class TestCommands:
    @pytest.fixture(autouse=True)
    def in_an_empty_folder(self, tmp_path, monkeypatch):
        monkeypatch.chdir(tmp_path)

    @pytest.mark.parametrize("channel", ["color", "depth"])
    def test_render_says_it_writes_and_names_a_remedy(self, capsys, tmp_path, channel, gl_backend):
        line = ["render", "canonical", "-o", "a.npy", "--size", "8x6", "--backend", gl_backend]
        line += ["--channel", channel]
        assert main([*line, *BEHIND]) == 0
        told = capsys.readouterr().err
        assert told.startswith("lucida: nothing is hit: everything is behind the eye; --target")
        assert told.count("\n") == 1
        assert np.load(tmp_path / "a.npy").shape[:2] == (6, 8)
        target = next(word for word in told.split() if word.startswith("--target="))
        assert main([*line, *BEHIND, target]) == 0
        assert capsys.readouterr().err == ""

    def test_compare_is_no_success(self, capsys, gl_backend):
        line = ["compare", "canonical", "--size", "8x6", "--backend", gl_backend]
        assert main([*line, *BEHIND]) == 1
        told = capsys.readouterr().out
        assert told.startswith("nothing is hit in either image: everything is behind the eye\n")
        assert main([*line, *BEHIND, "--json"]) == 1
        report = json.loads(capsys.readouterr().out)
        assert report["nothing_hit"] == "everything is behind the eye"


def test_the_window_s_words(gl_backend):
    empty = compare(load_scene("canonical"), Camera(eye=(0, 0, -30)), (8, 6), gl_backend)
    told = "Nothing is hit in either image: everything is behind the eye"
    assert comparing.headline(empty, "shadows") == (told, False)
