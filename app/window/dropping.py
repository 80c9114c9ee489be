"""A model that was dropped on the window: added to the open scene, or opened in its place.

One that was chosen to be added is added. For others the user is asked once; the answer is an
option, which the menu Scene changes.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Literal

from app.instruments.objects.editing import with_scene
from app.state.app_state import AppState
from app.ui.host import Host
from app.window.opening import Opened
from renderer.editing.objects import add, model_table
from renderer.files import SCENE_NAMES
from renderer.files.models.models import ModelFile, read_by
from renderer.scene.model import Scene
from renderer.system.errors import LucidaError, one_line

ADD, OPEN = "Add it to the scene", "Open it instead"


def is_for_the_scene(state: AppState, opened: Opened) -> bool:
    """Return True if the opened files could be added: only models, dropped on a scene of the
    user's.
    """
    scene = opened.scene
    if scene is None or scene.origin is None or opened.agreed is None or state.step is not None:
        return False
    is_model = scene.origin.tables is None and scene.origin.source not in SCENE_NAMES
    return is_model and not opened.is_first and opened.replaces is None


def settle(host: Host, opened: Opened, open_: Callable[[], None]) -> None:
    """Adds such a model, or opens it, or asks which. open_: opens it."""
    wanted = "add" if opened.adds else host.state.options.objects.dropped
    if wanted == "open":
        open_()
    elif wanted == "add":
        _add(host, opened)
    else:
        scene = opened.scene
        assert scene is not None
        host.files.ask(
            one_line(f"{scene.name}: add the model to the scene? Later ones go the same way."),
            {
                ADD: lambda: _as_answered(host, "add", lambda: _add(host, opened)),
                OPEN: lambda: _as_answered(host, "open", open_),
            },
        )


def with_model(state: AppState, model: Scene) -> AppState:
    """The state with a model, as it was read, as one more object of its scene, which is chosen.
    Raises LucidaError for a scene that cannot be changed."""
    assert model.origin is not None
    read = ModelFile(model.objects, model.views, model.notes)
    with read_by(lambda _: read):  # it is not read again
        scene, items = add(state.scene, model_table(state.scene, model.origin.source))
    return with_scene(state, scene, items)


def _add(host: Host, opened: Opened) -> None:
    assert opened.scene is not None
    try:
        host.change(with_model(host.state, opened.scene))
    except LucidaError as error:
        host.files.message = f"Nothing was added. {error}"
        return
    host.files.say(one_line(f"{opened.scene.name} is in the scene. Shift+F frames all of it."))


def _as_answered(host: Host, answer: Literal["add", "open"], do: Callable[[], None]) -> None:
    host.amend(host.state.with_options(replace(host.state.options.objects, dropped=answer)))
    do()
