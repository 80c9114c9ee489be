"""An instrument: one class with a view that can be docked, shown and hidden, and its actions.

app/window/instruments.py lists the classes. A large one may be split: view.py has its view's class,
actions.py has its actions, and instrument.py joins both.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import ClassVar, TypeVar

import moderngl
from imgui_bundle import ImVec2

from lucida.app.state.app_state import AppState
from lucida.renderer.camera.camera import Camera

from .action import Action
from .host import Host

AnInstrument = TypeVar("AnInstrument", bound="Instrument")


class Instrument:
    """A view in a dockable window, with its actions for menus and keys.

    Methods are called on the window's thread, with its OpenGL context current.

    name: unique; the window's id in ImGui.
    title: the text on its tab.
    padding, flags: the ImGui window's; None and 0 for the style's.
    space: its dock space in layouts that have that space and do not place the view; "" for a tab of
    the main view.
    actions: its actions for menus and keys, in the order of the menus.
    mouse, keyboard: further rows for the shortcut sheet.
    """

    name: ClassVar[str]
    title: ClassVar[str]
    padding: ClassVar[ImVec2 | None] = None
    flags: ClassVar[int] = 0
    space: ClassVar[str] = ""
    actions: ClassVar[tuple[Action, ...]] = ()
    mouse: ClassVar[tuple[tuple[str, str], ...]] = ()
    keyboard: ClassVar[tuple[tuple[str, str], ...]] = ()

    def __init__(self, views: Sequence[Instrument] = ()) -> None:
        """Create the instrument.

        views: the views before it in the window's list, such as one that it draws into.
        """

    @property
    def label(self) -> str:
        return f"{self.title}###{self.name}"

    @property
    def settled(self) -> bool:
        """True if nothing in the view will change by itself."""
        return True

    def begin(self, host: Host, context: moderngl.Context) -> None:
        """Prepare the view. Called once, when there is a context."""

    def placed(self, host: Host) -> int:
        """Place the ImGui window of this frame if it lies over the others. Return its flags; 0 if
        it is docked.
        """
        return 0

    def draw(self, host: Host) -> None:
        """Draw the view inside its ImGui window. Called in each frame in which it is visible."""

    def unseen(self, host: Host) -> None:
        """Handle a frame in which the view is hidden, or behind another tab."""

    def own_camera(self, host: Host) -> Camera | None:
        """Return the camera of a 3D view, which F aims at an object; None if there is none."""
        return None

    def with_own_camera(self, state: AppState, camera: Camera) -> AppState:
        """Return the state with another such camera."""
        return state

    def object_under(self, host: Host) -> int | None:
        """Return the index of the scene's object under the mouse; None for the background, or if
        unknown.
        """
        return None

    @property
    def sections(self) -> tuple[str, ...]:
        """The parts of the view that are unfolded."""
        return ()

    def open_sections(self, names: tuple[str, ...]) -> None:
        """Unfold these parts, and fold the others. Ignore unknown names, from other versions."""

    def cancel(self) -> None:
        """End the current drag, because something else has changed the state."""

    @property
    def has_pending(self) -> bool:
        """True if an entry is not in the state because it is invalid."""
        return False

    def drop_pending(self) -> None:
        """Discard that entry."""

    def begin_anew(self) -> None:
        """Reset the view's data outside the state, because a lecture moved by a step."""

    def end(self) -> None:
        """Release resources. Called once, before the context is destroyed."""


def view_of(views: Iterable[Instrument], kind: type[AnInstrument]) -> AnInstrument:
    """Return the instrument of a class among all."""
    return next(view for view in views if isinstance(view, kind))
