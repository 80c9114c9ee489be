"""Take what was opened into the window: a scene, a view, a lecture, a file of code, photographs.

Decides what replaces what. opening.py reads.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Protocol

from app.checking.your_code.view import YourCodeView
from app.images.photograph.model import with_photograph
from app.instruments.poses.model import PoseSet
from app.instruments.poses.view import PosesView
from app.lecture.view import LectureView
from app.ui.host import Host
from app.window import dropping
from app.window.opening import Opened
from renderer.editing.documents import are_versions, is_unsaved
from renderer.files import EMPTY_SCENE, load_scene
from renderer.scene import Scene
from renderer.system.errors import one_line

READ_AGAIN = "Read it again"


class Taker(Host, Protocol):
    """The window as it takes what was opened."""

    def open_code(self, path: str) -> None: ...
    def leave_scene(self, then: Callable[[], None]) -> None:
        """Run what replaces the scene; ask first if something would be lost."""


def take_opened(window: Taker, opened: Opened) -> None:
    """All that sources held, each in its place."""
    if opened.code:
        window.open_code(opened.code)
    if opened.poses is not None:
        _take_poses(window, opened, opened.poses)
    if opened.tasks:
        window.view(YourCodeView).open_tasks(window, opened.tasks)
    if opened.photograph:
        window.change(with_photograph(window.state, opened.photograph, shown=True, follows=False))
        window.files.say("The photograph is laid over the images: Image > Photograph.")
    if opened.lecture is not None:  # whose steps have scenes of their own
        lecture = opened.lecture
        window.leave_scene(lambda: window.view(LectureView).give(*lecture))
    elif opened.scene is not None:
        _take_scene(window, opened, opened.scene)
    elif opened.view is not None:
        window.change(window.state.with_view(opened.view))


def _take_poses(window: Taker, opened: Opened, poses: PoseSet) -> None:
    """Show a set in an empty scene, unless a scene or a view was opened with it."""
    view = window.view(PosesView)
    if opened.scene is not None or opened.view is not None or opened.lecture is not None:
        view.open(window, poses, None)
    else:
        window.leave_scene(lambda: view.open(window, poses, load_scene(EMPTY_SCENE)))


def _take_scene(window: Taker, opened: Opened, scene: Scene) -> None:
    state, textures = window.state, window.renderers.textures
    if opened.replaces is not None and not are_versions(opened.replaces, state.scene):
        return  # another one is shown meanwhile
    if opened.prepared is not None and textures is not None:
        textures.rasterizer.prepare(scene, opened.prepared)
    if opened.replaces is not None:
        old = state.scene  # which may have been edited while its file was read
        if is_unsaved(old):
            window.files.ask(
                one_line(f"{old.name} was changed by another program, and here: not saved."),
                {READ_AGAIN: lambda: take_newer(window, old, scene)},
            )
        else:
            take_newer(window, old, scene)
        return

    def open_() -> None:
        window.change(window.state.with_scene(scene, opened.view))

    if opened.is_first:
        first = state.with_scene(scene, opened.view)
        kept = state.keep_orthonormal and first.keep_orthonormal
        window.amend(replace(first, keep_orthonormal=kept))
    elif dropping.is_for_the_scene(state, opened):
        dropping.settle(window, opened, lambda: window.leave_scene(open_))
    else:
        window.leave_scene(open_)


def take_newer(window: Taker, old: Scene, new: Scene) -> None:
    """A newer version of the shown scene, as a step of its own: with its own camera, unless the
    user has moved it."""
    untouched = window.state.view == old.view
    state = replace(window.state, scene=new)
    window.change(state.with_view(new.view) if untouched else state)
    window.files.say(f"{new.name} was read again: its file was saved.")
