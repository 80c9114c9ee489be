"""Show what was opened in the window: a scene, a view, a lecture, a file of code, photographs.

This module decides what is replaced; opening.py reads the files.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Protocol

from lucida.app.images.photograph.model import with_photograph
from lucida.app.instruments.objects.editing import with_scene
from lucida.app.instruments.poses.model import PoseSet
from lucida.app.instruments.poses.view import PosesView
from lucida.app.lecture.view import LectureView
from lucida.app.state.app_state import AppState
from lucida.app.ui.host import Host
from lucida.renderer.editing.documents import are_versions, is_unsaved
from lucida.renderer.editing.objects import add, model_table
from lucida.renderer.files import EMPTY_SCENE, SCENE_NAMES, load_scene
from lucida.renderer.files.models.models import ModelFile, read_by
from lucida.renderer.scene import Scene, View
from lucida.renderer.system.errors import LucidaError, one_line

from .files import Files
from .opening import (
    OpenedCode,
    OpenedLecture,
    OpenedPhotograph,
    OpenedPoses,
    OpenedScene,
    OpenedView,
)

READ_AGAIN = "Read it again"
ADD, OPEN = "Add it to the scene", "Open it instead"


class Taker(Host, Protocol):
    """The window, as seen by this module."""

    files: Files

    def open_code(self, path: str) -> None: ...
    def leave_scene(self, then: Callable[[], None]) -> None:
        """Call `then`, which replaces the scene; ask first if something would be lost."""


def take_opened(window: Taker) -> None:
    """Show everything that was opened since the last frame. A view applies to the scene or the set
    that was opened with it.
    """
    opened = window.files.poll()
    if opened is None:
        return
    window.animate()
    scene, lecture = opened.find(OpenedScene), opened.find(OpenedLecture)
    view = opened.find(OpenedView)
    for thing in opened.things:
        match thing:
            case OpenedCode(path):
                window.open_code(path)
            case OpenedPhotograph(path):
                window.change(with_photograph(window.state, path, shown=True, follows=False))
                window.files.say("The photograph is laid over the images: Image > Photograph.")
            case OpenedPoses(poses):
                _take_poses(window, poses, alone=scene is None and view is None and lecture is None)
    if lecture is not None:  # its steps have scenes of their own
        window.leave_scene(lambda: window.view(LectureView).give(lecture.lecture, lecture.path))
    elif scene is not None:
        _take_scene(window, scene, None if view is None else view.view)
    elif view is not None:
        window.change(window.state.with_view(view.view))


def _take_poses(window: Taker, poses: PoseSet, alone: bool) -> None:
    """Show a set; in an empty scene if it was opened alone."""
    view = window.view(PosesView)
    if alone:
        window.leave_scene(lambda: view.open(window, poses, load_scene(EMPTY_SCENE)))
    else:
        view.open(window, poses, None)


def _take_scene(window: Taker, opened: OpenedScene, view: View | None) -> None:
    state, textures, scene = window.state, window.renderers.textures, opened.scene
    if opened.replaces is not None and not are_versions(opened.replaces, state.scene):
        return  # the window shows another one by now
    if opened.prepared is not None and textures is not None:
        textures.rasterizer.prepare(scene, opened.prepared)
    if opened.use == "newer":
        old = state.scene  # which may have been edited while its file was read
        if is_unsaved(old):
            window.files.ask(
                one_line(f"{old.name} was changed by another program, and is unsaved here."),
                {READ_AGAIN: lambda: take_newer(window, old, scene)},
            )
        else:
            take_newer(window, old, scene)
    else:
        open_ = partial(
            window.leave_scene, lambda: window.change(_with_other_scene(window.state, scene, view))
        )
        if _is_for_the_scene(state, opened):
            _add_or_open(window, opened, open_)
        else:
            open_()


def _with_other_scene(state: AppState, scene: Scene, view: View | None) -> AppState:
    """Return the state with another scene, which is entirely visible in the outside view."""
    state = state.with_scene(scene, view)
    return state.with_options(replace(state.options.outside, camera=None))


def take_newer(window: Taker, old: Scene, new: Scene) -> None:
    """Show a newer version of the scene, as a separate undo step. Use its own camera unless the
    user has moved the camera.
    """
    untouched = window.state.view == old.view
    state = replace(window.state, scene=new)
    window.change(state.with_view(new.view) if untouched else state)
    window.files.say(f"{new.name} was read again: its file was saved.")


def _is_for_the_scene(state: AppState, opened: OpenedScene) -> bool:
    """Return True if the opened scene could be added: a model dropped on the user's own scene."""
    origin = opened.scene.origin
    if origin is None or opened.agreed is None or state.step is not None:
        return False
    return origin.tables is None and origin.source not in SCENE_NAMES


def _add_or_open(window: Taker, opened: OpenedScene, open_: Callable[[], None]) -> None:
    """Add such a model, or ask whether to open it instead."""
    model = opened.scene
    if opened.use == "add":
        _add(window, model)
        return
    answers = {ADD: lambda: _add(window, model), OPEN: open_}
    window.files.ask(one_line(f"{model.name}: add the model to the scene?"), answers)


def _add(window: Taker, model: Scene) -> None:
    try:
        window.change(with_model(window.state, model))
    except LucidaError as error:
        window.files.message = f"Nothing was added. {error}"
        return
    window.files.say(one_line(f"{model.name} is in the scene. Shift+F frames all of it."))


def with_model(state: AppState, model: Scene) -> AppState:
    """Return the state with a model, as it was read, as one more object of its scene, which is
    selected. Raises LucidaError for a scene that cannot be changed.
    """
    assert model.origin is not None
    read = ModelFile(model.objects, model.views, model.notes)
    with read_by(lambda _: read):  # do not read it again
        scene, items = add(state.scene, model_table(state.scene, model.origin.source))
    return with_scene(state, scene, items)
