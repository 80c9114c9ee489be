"""Pictures along any rays, in the background: the newest question wins, and nothing is lost."""

from __future__ import annotations

import threading
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import pytest
from waiting import wait_for

from lucida.app.images.ray_pictures import RayPictures
from lucida.app.images.scene_tracer import UnwantedError, of_scene
from lucida.renderer.scene.model import Scene, SceneObject, Sphere
from lucida.renderer.system.errors import LucidaError

SCENE, OTHER = Scene((SceneObject(Sphere()),)), Scene((), background=(0.1, 0.2, 0.3))
ORIGINS, DIRECTIONS = np.zeros((2, 3, 3)), np.broadcast_to((0.0, 0.0, -1.0), (2, 3, 3))


@dataclass
class Hitless:
    """A tracer whose rays hit nothing. gone: closed by the window meanwhile."""

    scene: Scene
    gone: bool = False
    scenes: int = 1

    def closest_hits(self, origins, directions, t_min=0.0, t_max=0.0):
        return np.full(len(origins), np.inf, np.float32), np.full(len(origins), -1, np.int32)

    def shaded(self, origins, directions, t_min=0.0, t_max=0.0):
        if self.gone:
            raise LucidaError("tracer", "is closed", "make a new Tracer")
        return np.full((len(origins), 3), self.scene.background, np.float32)


@dataclass
class Source:
    """The window's live tracer."""

    tracers: dict[int, Any] = field(default_factory=dict)
    preparing_s: float = 0.0

    def tracer_of(self, scene: Scene) -> Any | None:
        return self.tracers.get(id(scene))


@pytest.fixture
def pictures():
    made: RayPictures[Any] = RayPictures("test", lambda: None)
    yield made
    made.close()


def source(*scenes: Scene) -> Source:
    return Source({id(scene): Hitless(scene) for scene in scenes})


def followed(pictures, key, scene, asked, make) -> Any:
    """Return the image once nothing is on its way."""
    pictures.follow(key, scene, asked, make)
    wait_for(lambda: pictures.follow(key, scene, asked, make) is not None or not pictures.busy)
    wait_for(lambda: pictures.follow(key, scene, asked, make) is None or not pictures.busy)
    return pictures.follow(key, scene, asked, make)


def along(painter):
    return painter.picture(ORIGINS, DIRECTIONS)


def test_a_picture_comes_and_is_made_once(pictures):
    calls = []
    asked = source(OTHER)

    def make(painter):
        calls.append(painter)
        return along(painter)

    for _ in range(3):
        made = followed(pictures, "one", OTHER, asked, make)
    assert made.shape == (2, 3, 3) and np.allclose(made, OTHER.background)
    assert len(calls) == 1 and not pictures.busy
    followed(pictures, "another", OTHER, asked, make)
    assert len(calls) == 2


def test_the_newest_wins_and_the_last_stands_in(pictures):
    asked, begun, go = source(OTHER), threading.Event(), threading.Event()
    assert followed(pictures, 0, OTHER, asked, lambda painter: "first") == "first"

    def held(painter):
        begun.set()
        assert go.wait(30)
        return "held"

    assert pictures.follow(1, OTHER, asked, held) == "first"
    assert begun.wait(30) and pictures.busy
    never: list[int] = []
    pictures.follow(2, OTHER, asked, lambda painter: never.append(2))
    pictures.follow(3, OTHER, asked, lambda painter: "newest")
    go.set()
    wait_for(lambda: pictures.follow(3, OTHER, asked, along) == "newest")
    assert not never


def test_a_tracer_of_another_scene_is_not_asked():
    asked: list[int] = []
    with pytest.raises(UnwantedError):
        of_scene(Hitless(OTHER), SCENE, lambda: asked.append(1))
    assert not asked


def test_a_picture_of_another_scene_does_not_stand_in(pictures):
    asked = Source({id(OTHER): Hitless(OTHER), id(SCENE): Hitless(SCENE)})
    assert followed(pictures, 0, OTHER, asked, lambda painter: "of the other") == "of the other"
    assert pictures.follow(0, SCENE, asked, lambda painter: "of this") is None
    wait_for(lambda: pictures.follow(0, SCENE, asked, along) == "of this")


def test_a_picture_that_nobody_wants_is_given_up(pictures):
    asked, given_up = source(OTHER), threading.Event()
    begun, forgotten = threading.Event(), threading.Event()

    def make(painter):
        begun.set()
        assert forgotten.wait(30)
        try:
            return along(painter)
        except UnwantedError:
            given_up.set()
            raise

    pictures.follow(0, OTHER, asked, make)
    assert begun.wait(30)
    pictures.forget()
    assert not pictures.busy  # though the thread still works
    forgotten.set()
    assert given_up.wait(30)
    assert followed(pictures, 0, OTHER, asked, lambda painter: "again") == "again"


@pytest.mark.parametrize("gone", [Hitless(SCENE), Hitless(OTHER, gone=True)])
def test_a_tracer_that_has_gone_on_is_asked_again(pictures, gone):
    asked, calls = Source({id(OTHER): gone}), []

    def make(painter):
        calls.append(painter)
        return along(painter)

    def again() -> bool:
        pictures.follow("key", OTHER, asked, make)
        return len(calls) > 1

    wait_for(again)
    assert pictures.error is None
    asked.tracers = source(OTHER).tracers
    wait_for(lambda: pictures.follow("key", OTHER, asked, make) is not None)


@pytest.mark.parametrize("asks", ["picture", "hit", "error"])
def test_a_tracer_that_has_come_back_from_another_scene_is_asked_again(pictures, asks):
    """Half of such a picture would be of the other scene."""

    class ComesBack(Hitless):
        def closest_hits(self, origins, directions, t_min=0.0, t_max=0.0):
            self.scenes += 2 * (not calls[1:])
            return super().closest_hits(origins, directions)

        def shaded(self, origins, directions, t_min=0.0, t_max=0.0):
            self.scenes += 2 * (not calls[1:])
            if asks == "error" and not calls[1:]:
                raise IndexError("of the other scene's objects")
            return super().shaded(origins, directions)

    asked, calls = Source({id(OTHER): ComesBack(OTHER)}), []

    def make(painter):
        calls.append(painter)
        if asks == "hit":
            return float(painter.hits([ORIGINS[0, 0]], [DIRECTIONS[0, 0]])[0])
        return along(painter)

    wait_for(lambda: pictures.follow("key", OTHER, asked, make) is not None)
    assert len(calls) == 2 and pictures.error is None


def test_the_window_s_tracer_is_waited_for_while_it_prepares(pictures):
    asked = Source(preparing_s=0.1)
    assert pictures.follow(0, OTHER, asked, along) is None and pictures.busy
    asked.tracers, asked.preparing_s = source(OTHER).tracers, 0.0
    assert np.allclose(followed(pictures, 0, OTHER, asked, along), OTHER.background)


def test_without_one_it_has_its_own(pictures):
    made = followed(pictures, 0, SCENE, Source(), along)
    assert np.isfinite(made).all() and not np.allclose(made, SCENE.background)


def test_an_error_is_kept_until_something_else_is_asked_for(pictures):
    def fail(painter):
        raise LucidaError("scene", "is too large", "use a smaller one")

    asked = source(OTHER)
    assert followed(pictures, 0, OTHER, asked, fail) is None
    assert isinstance(pictures.error, LucidaError)
    followed(pictures, 1, OTHER, asked, along)
    assert pictures.error is None
