"""The cameras of a film: where they are, and the file of keys."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from lucida import LucidaError, View, load_scene, save_view
from lucida.app.cameras.films.key_file import keys_text, load_keys
from lucida.app.cameras.films.paths import Key, around, dolly_zoom, through
from lucida.renderer.scene.focus import scene_focus

SIZE = (64, 36)
SCENE = load_scene("still-life")
VIEW, FOCUS = SCENE.view, scene_focus(SCENE)


def seen(camera):
    return np.array(camera.project(FOCUS.center, SIZE)[:2])


def test_an_orbit_keeps_its_distance_and_closes():
    cameras = around(VIEW, FOCUS, SIZE, 12)
    eyes = np.array([camera.eye for camera in cameras])
    distances = np.linalg.norm(eyes - FOCUS.center, axis=1)
    assert cameras[0] == VIEW.for_size(SIZE)
    assert np.ptp(distances) < 1e-9 and np.ptp(eyes[:, 1]) < 1e-9
    steps = np.linalg.norm(eyes - np.roll(eyes, 1, axis=0), axis=1)
    assert np.ptp(steps) < 1e-9 and steps[0] > 0.1
    assert (eyes[1] - eyes[0]) @ cameras[0].u > 0  # the eye moves to the right


def test_a_dolly_zoom_keeps_the_focus_in_place():
    cameras = dolly_zoom(VIEW, FOCUS, SIZE, 5)
    assert cameras[-1].distance == pytest.approx(4 * cameras[0].distance)
    assert np.ptp([seen(camera) for camera in cameras], axis=0).max() < 1e-6
    with pytest.raises(LucidaError, match="parallel rays have no distance"):
        dolly_zoom(
            replace(VIEW, camera=replace(VIEW.camera, projection="parallel")), FOCUS, SIZE, 5
        )


def test_keys_are_passed_in_time(tmp_path):
    views = [View(camera) for camera in around(VIEW, FOCUS, SIZE, 4)]
    keys = [Key(views[0], 1.0, "constant"), Key(views[1], 2.0, "cut"), Key(views[2], 1.0)]
    cameras = through(keys, FOCUS, SIZE, 7)  # one each half a second
    assert cameras[0] == views[0].camera and cameras[-1] == views[2].camera
    assert [camera == views[1].camera for camera in cameras] == [0, 0, 1, 1, 1, 1, 0]
    even = np.linalg.norm(np.subtract(cameras[1].eye, cameras[0].eye))
    assert np.linalg.norm(np.subtract(cameras[2].eye, cameras[1].eye)) == pytest.approx(even)
    longer = [*keys, Key(views[3], 1.0)]
    assert through(longer, FOCUS, SIZE, 9)[6::2] == [views[2].camera, views[3].camera]
    path = tmp_path / "keys.toml"
    path.write_text(keys_text(keys))
    assert load_keys(path) == keys


def test_a_file_of_keys_may_name_view_files(tmp_path):
    save_view(tmp_path / "corner.toml", VIEW)
    path = tmp_path / "keys.toml"
    table = "camera = { eye = [0, 0, 5], target = [0, 0, 0] }\nseconds = 3\n"
    path.write_text(
        f"timing = 'cut'\nseconds = 1.5\n[[keys]]\ncamera = 'corner.toml'\n[[keys]]\n{table}"
    )
    first, second = load_keys(path)
    assert first == Key(VIEW, 1.5, "cut")
    assert (second.seconds, second.view.camera.eye) == (3, (0, 0, 5))


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("keys = []", "keys: is empty"),
        ("[[keys]]\ncamera = 'none.toml'", "none.toml"),
        ("[[keys]]\nseconds = 0\ncamera = {}", r"keys\[0\].seconds: 0 is not between"),
        ("[[keys]]\ntiming = 'slow'\ncamera = {}", r"keys\[0\].timing"),
        ("[[keys]]\ncamera = { eye = 3 }", r"keys\[0\].camera.eye"),
        ("[[keys]]", r"keys\[0\].camera: is missing"),
    ],
)
def test_a_file_of_keys_is_checked(tmp_path, text, message):
    path = tmp_path / "keys.toml"
    path.write_text(text)
    with pytest.raises(LucidaError, match=message) as caught:
        load_keys(path)
    assert "keys.toml" in str(caught.value)
