"""The recordings that the stepper shows while others are made; its pictures and lines."""

from __future__ import annotations

import threading
import time
from dataclasses import replace

import numpy as np
import pytest

from lucida.app.instruments.stepper.code import code_words
from lucida.app.instruments.stepper.model import moment_at
from lucida.app.instruments.stepper.recording import Recording
from lucida.app.instruments.stepper.runs import Made, Prepared, recordings
from lucida.app.ui.canvas import CELL, LEAST_CELL, cell_of, color_picture
from lucida.app.ui.explaining.breaking import breakable
from lucida.renderer.camera.camera import Camera
from lucida.renderer.files import load_scene
from lucida.renderer.images.display import to_srgb8
from lucida.renderer.scene.model import Scene, SceneObject, Sphere
from lucida.renderer.system.errors import LucidaError

SIZE = (8, 6)
CAMERA = Camera.canonical()
BALL = Scene((SceneObject(Sphere((0, 0, -3), 1)),))


class Watched:
    """Runs, and waiting for them."""

    def __init__(self) -> None:
        self._woken = threading.Condition()
        self._count = 0
        self.runs = Prepared("stepper", recordings, self._wake)

    def _wake(self) -> None:
        with self._woken:
            self._count += 1
            self._woken.notify_all()

    def until_complete(self, scene: Scene, camera: Camera, size=SIZE) -> Made:
        with self._woken:
            while True:
                pair = self.runs.of(scene, camera, size)
                if pair is not None and (pair.scene, pair.camera, pair.size) == (
                    scene,
                    camera,
                    size,
                ):
                    return pair
                assert self._woken.wait(60)


@pytest.fixture
def watched():
    made = Watched()
    yield made
    made.runs.close()


def last_canvas(run: Recording) -> np.ndarray:
    return moment_at(run, len(run) - 1).canvas


def test_both_recordings_of_a_scene_come(watched: Watched) -> None:
    pair = watched.until_complete(BALL, CAMERA)
    assert np.array_equal(*map(last_canvas, pair.value))
    assert watched.runs.of(BALL, CAMERA, SIZE) is pair
    assert not watched.runs.busy and watched.runs.error is None


def test_the_last_camera_s_stay_until_the_next_are_complete(watched: Watched) -> None:
    first = watched.until_complete(BALL, CAMERA)
    moved = replace(CAMERA, eye=(0.2, 0, 0))
    shown = watched.runs.of(BALL, moved, SIZE)
    assert shown is first or (shown is not None and shown.camera == moved)
    second = watched.until_complete(BALL, moved)
    assert second is not first


def test_another_scene_s_or_canvas_s_are_never_shown(watched: Watched) -> None:
    watched.until_complete(BALL, CAMERA)
    other = load_scene("spheres")
    shown = watched.runs.of(other, CAMERA, SIZE)
    assert shown is None or shown.scene is other
    watched.until_complete(other, CAMERA)
    shown = watched.runs.of(other, CAMERA, (4, 3))
    assert shown is None or shown.size == (4, 3)
    assert watched.until_complete(other, CAMERA, (4, 3)).size == (4, 3)


def test_a_long_run_is_ended_by_the_next_wish(watched: Watched) -> None:
    columns = load_scene("columns")
    watched.runs.of(columns, columns.view.for_size((64, 48)), (64, 48))
    assert watched.until_complete(columns, CAMERA).size == SIZE


def test_a_canvas_that_cannot_be_is_said(watched: Watched) -> None:
    watched.runs.of(BALL, CAMERA, (100, 100))
    while watched.runs.error is None:
        assert watched.runs.of(BALL, CAMERA, (100, 100)) is None
        time.sleep(0.001)
    assert isinstance(watched.runs.error, LucidaError)
    watched.until_complete(BALL, CAMERA)
    assert watched.runs.error is None


# What the panels draw of it.


def test_the_canvas_as_a_picture() -> None:
    """Each pixel a square; what is not set is dark, with a point in its middle."""
    color = np.full((2, 3, 3), np.nan)
    color[0, 1] = (0.25, 0.5, 2.0)
    assert (cell_of(3), cell_of(64)) == (CELL, LEAST_CELL)
    picture = color_picture(color, 1.0)
    assert picture.shape == (2 * CELL, 3 * CELL, 3)
    assert (picture[:CELL, CELL : 2 * CELL] == to_srgb8(color[0, 1], 1.0)).all()
    unset = picture[CELL:, :CELL]
    assert len(np.unique(unset.reshape(-1, 3), axis=0)) == 2
    assert (unset[0] == unset[0, 0]).all() and (unset[CELL // 2, CELL // 2] != unset[0, 0]).any()


def test_names_with_a_colour_stand_apart_in_the_code() -> None:
    line = "        hit = intersect(object, ray)"
    words = code_words(line)
    assert [word for _, word in words if word.strip() in ("hit", "ray")] == [
        "hit",
        "ray",
    ]
    assert "".join(word for _, word in words) == line
    for column, word in words:
        assert line[column : column + len(word)] == word
    assert code_words("    for j in range(W):") == ((0, "    for j in range(W):"),)


@pytest.mark.parametrize(
    ("formula", "parts"),
    [
        ("u = a + (b - c) - d", ["u", "= a", "+ (b - c)", "- d"]),
        (r"= \frac{a + b}{c - d} = 3", [r"= \frac{a + b}{c - d}", "= 3"]),
        ("t > 0", ["t > 0"]),
        ("= -1 + x", ["= -1", "+ x"]),
    ],
)
def test_formulas_are_broken_outside_brackets(formula: str, parts: list[str]) -> None:
    assert list(breakable(formula)) == parts
    assert " ".join(parts) == formula
