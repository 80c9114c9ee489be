"""A view: a window that can be docked, shown and hidden; and what it may ask of its host."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Mapping
from typing import ClassVar, Protocol, TypeVar

import moderngl
from imgui_bundle import ImVec2

from app.cameras.focus import Focus
from app.images.renderers import Renderers
from app.state.app_state import AppState
from app.state.options import Pixel
from app.storage.recent import RecentFiles
from app.widgets.theme import Fonts
from renderer.camera import Camera
from renderer.scene import View as SceneView


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
        """Asks where something is to go, and stores it there in the background. kind: in words, and
        the endings, of which the first is added to a name without one. store: does it, and says
        what it did."""

    def ask(
        self,
        text: str,
        answer: str,
        then: Callable[[], None],
        other: tuple[str, Callable[[], None]] | None = None,
    ) -> None:
        """Ask a question that one button answers, next to Cancel.

        then: called after a yes. other: an alternative and its function.
        """

    def say(self, text: str) -> None:
        """Show a toast."""


class Host(Protocol):
    """The window as its views see it. All of it is used in the window's thread.

    renderers: both images of the present state. files: opening and saving. moves: whether things
    may move by themselves; not where a picture of the window is taken.
    """

    fonts: Fonts
    renderers: Renderers
    moves: bool

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
        """Report that the mouse is over a pixel; for the next frame, in every view."""

    def apply(self, state: AppState, gesture: Hashable = None) -> None:
        """Makes a state the present one. Changes while an item is held are one step of undo; so
        are those with an equal gesture that is not None."""

    def change(self, state: AppState) -> None:
        """Makes a state the present one, as a step of its own."""

    def amend(self, state: AppState) -> None:
        """Makes a state the present one, without a step of undo: not the user has changed it."""

    def unclick(self) -> None:
        """Takes back the click before this one, if it has marked a pixel: it was the first of a
        double click."""

    def ask_resolution(self) -> None:
        """Opens the box to type the images' resolution into."""

    def travel(self, state: AppState) -> None:
        """Make a state the present one, as an undo step, by a smooth transition of its camera, or
        of the outside camera if that is visible.
        """

    def take(self, text: str) -> bool:
        """Offer a pasted text that holds no camera to the views. Return True if one took it and is
        shown.
        """

    @property
    def travelling(self) -> bool:
        """True while such a transition is under way."""

    def animate(self) -> None:
        """Asks for a next frame at full rate: something is moving by itself."""


AView = TypeVar("AView", bound="DockedView")


class DockedView:
    """name: unique, ImGui's id of the window. title: on its tab. padding, flags: of the ImGui
    window; None and 0: as in the style. places: layouts that show it, in addition to those that
    name it themselves (layout.py), and its dock space there.

    Methods are called on the window's thread, with its OpenGL context current.
    """

    name: ClassVar[str]
    title: ClassVar[str]
    padding: ClassVar[ImVec2 | None] = None
    flags: ClassVar[int] = 0
    places: ClassVar[Mapping[str, str]] = {}

    @property
    def label(self) -> str:
        return f"{self.title}###{self.name}"

    @property
    def settled(self) -> bool:
        """True if nothing in the view will change by itself."""
        return True

    def begin(self, host: Host, context: moderngl.Context) -> None:
        """Once, when there is a context."""

    def draw(self, host: Host) -> None:
        """Draw the view inside its ImGui window. Called once in each frame in which it is
        visible.
        """

    def unseen(self, host: Host) -> None:
        """Once a frame in which the view is hidden, or behind another tab."""

    def flown(self, host: Host) -> Camera | None:
        """The camera that the keys move while the mouse is over the view; None: there is none."""
        return None

    def with_flown(self, state: AppState, camera: Camera) -> AppState:
        """The state with that camera moved."""
        return state

    def takes(self, host: Host, text: str) -> bool:
        """Return True if the view took a pasted text that holds no camera. It is shown then."""
        return False

    def object_under(self, host: Host) -> int | None:
        """The index of the scene's object under the mouse; None for the background, and where
        that is not known."""
        return None

    @property
    def sections(self) -> tuple[str, ...] | None:
        """Which of the view's parts are folded open; None: as there is room, or it has none."""
        return None

    def open_sections(self, names: tuple[str, ...]) -> None:
        """Folds these parts open, and the others shut. Unknown ones are of another version."""

    def cancel(self) -> None:
        """Ends a drag under way: something else has changed the state."""

    @property
    def has_pending(self) -> bool:
        """True if something was entered that is not in the state because it is illegal."""
        return False

    def drop_pending(self) -> None:
        """Takes that back."""

    def as_set(self, state: AppState) -> AppState:
        """The present state as it was made, without what the view has fitted to its size since."""
        return state

    def begin_anew(self) -> None:
        """Reset what the view keeps outside the state, because a lecture took a step."""

    def end(self) -> None:
        """Once, before the context goes."""


def view_of(views: Iterable[DockedView], kind: type[AView]) -> AView:
    """The view of a class among all views."""
    return next(view for view in views if isinstance(view, kind))
