"""A view: a window that can be docked, shown and hidden; and its host's interface."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable
from typing import ClassVar, Protocol, TypeVar

import moderngl
from imgui_bundle import ImVec2

from app.images.renderers import Renderers
from app.state.app_state import AppState
from app.state.options.shared import Pixel
from app.ui.recent import RecentFiles
from app.ui.theme import Fonts
from renderer.camera.camera import Camera
from renderer.scene import View as SceneView
from renderer.scene.focus import Focus


class Filing(Protocol):
    """The window's files for views and actions. message: the last error."""

    message: str

    @property
    def recent(self) -> RecentFiles: ...
    def open(self, source: str) -> None: ...
    def open_dialog(self) -> None: ...
    def open_lecture_dialog(self) -> None: ...
    def add_model_dialog(self) -> None: ...
    def open_code_dialog(self) -> None: ...
    def open_tasks_dialog(self) -> None: ...
    def open_photograph_dialog(self) -> None: ...
    def save_view_dialog(self, view: SceneView) -> None: ...
    def save_as_dialog(
        self, title: str, name: str, kind: tuple[str, ...], store: Callable[[str], str]
    ) -> None:
        """Ask for a place, and store something there in the background.

        kind: in words, and the extensions; the first is added to a name without one.
        store: stores it, and returns a message on what it did.
        """

    def ask_name(
        self, title: str, name: str, kind: tuple[str, ...], named: Callable[[str], None]
    ) -> None:
        """Ask for a name to save under. kind: as in save_as_dialog(). named: called with it."""

    def ask_open(
        self, title: str, words: str, endings: tuple[str, ...], chosen: Callable[[list[str]], None]
    ) -> None:
        """Ask for files to open. words: for those with the endings."""

    def ask(self, text: str, answers: dict[str, Callable[[], None]]) -> None:
        """Ask a question. answers: the words on the buttons next to Cancel, and what each does."""

    def say(self, text: str) -> None:
        """Show a toast."""


class Host(Protocol):
    """The window as its views see it. Use it only on the window's thread.

    renderers: both images of the current state.
    files: opening and saving.
    moves: True if things may move by themselves; False while a picture of the window is taken.
    """

    fonts: Fonts
    renderers: Renderers
    moves: bool

    @property
    def has_tools(self) -> bool:
        """False if views are pictures alone: on a lecture's stage, and in pages."""

    @property
    def files(self) -> Filing: ...
    @property
    def state(self) -> AppState: ...

    @property
    def focus(self) -> Focus:
        """The scene's middle and size."""

    @property
    def hovered(self) -> tuple[str, Pixel] | None:
        """The pixel under the mouse, and the name of the view that it was found in."""

    def hover(self, view: str, pixel: Pixel) -> None:
        """Report that the mouse is over a pixel, for the next frame in every view."""

    def apply(self, state: AppState, gesture: Hashable = None) -> None:
        """Make a state the current one. Changes while an item is held are one undo step; so are
        those with an equal gesture that is not None.
        """

    def change(self, state: AppState) -> None:
        """Make a state the current one, as a separate undo step."""

    def amend(self, state: AppState) -> None:
        """Make a state the current one without an undo step, because the user did not cause the
        change.
        """

    def show(self, view: str) -> None:
        """Show a view that is hidden, or behind another tab."""

    def unclick(self) -> None:
        """Undo the previous click if it marked a pixel: it was the first of a double click."""

    def ask_resolution(self) -> None:
        """Open the box that asks for the images' resolution."""

    def travel(self, state: AppState) -> None:
        """Make a state the current one, as an undo step, by a smooth transition of its camera, or
        of the outside camera if that is visible.
        """

    def move(
        self, state: AppState, move_s: float, loop: bool = False, start: AppState | None = None
    ) -> None:
        """Make a state the current one, as an undo step, and show states between for some seconds.

        They are never in the history: any change, and any press of the mouse, ends the movement.
        loop: begin it again and again. start: None for the state that is shown.
        """

    def end_movement(self) -> bool:
        """End such a movement. Return True if one was under way that would have ended by itself."""

    @property
    def travelling(self) -> bool:
        """True while such a transition is under way."""

    def animate(self) -> None:
        """Request the next frame at full rate, because something is moving by itself."""


AView = TypeVar("AView", bound="DockedView")


class DockedView:
    """A view in a dockable window.

    Methods are called on the window's thread, with its OpenGL context current.

    name: unique; the window's id in ImGui.
    title: on its tab.
    padding, flags: of the ImGui window; None and 0 for the style's.
    space: where it is docked in layouts that do not place it and have that space; "": where the
    largest view is.
    """

    name: ClassVar[str]
    title: ClassVar[str]
    padding: ClassVar[ImVec2 | None] = None
    flags: ClassVar[int] = 0
    space: ClassVar[str] = ""

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
        """Called in each frame in which the view is hidden, or behind another tab."""

    def flown(self, host: Host) -> Camera | None:
        """Return the camera that the keys move while the mouse is over the view; None if there is
        none.
        """
        return None

    def with_flown(self, state: AppState, camera: Camera) -> AppState:
        """Return the state with that camera moved."""
        return state

    def object_under(self, host: Host) -> int | None:
        """Return the index of the scene's object under the mouse; None for the background, or if
        unknown.
        """
        return None

    @property
    def sections(self) -> tuple[str, ...] | None:
        """The parts of the view that are unfolded; None if they follow the space, or if it has
        none.
        """
        return None

    def open_sections(self, names: tuple[str, ...]) -> None:
        """Unfold these parts, and fold the others. Unknown names come from other versions."""

    def cancel(self) -> None:
        """End the current drag: something else has changed the state."""

    @property
    def has_pending(self) -> bool:
        """True if an entry is not in the state because it is invalid."""
        return False

    def drop_pending(self) -> None:
        """Discard that entry."""

    def begin_anew(self) -> None:
        """Reset what the view keeps outside the state, because a lecture moved by a step."""

    def end(self) -> None:
        """Release resources. Called once, before the context is destroyed."""


def view_of(views: Iterable[DockedView], kind: type[AView]) -> AView:
    """Return the view of a class among all views."""
    return next(view for view in views if isinstance(view, kind))
