"""What a view is: a window that can be docked, shown, hidden; and what it may ask of its host.

Owns the two interfaces. Knows nothing of any one view.
"""

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
    """What views and actions ask of the window's files. message: what went wrong."""

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
        """Asks something that stands on one button, beside Cancel. then: does it, after a yes.
        other: what can be done instead, and does it."""

    def say(self, text: str) -> None:
        """Something was done: tells it in passing."""


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
        """Says that the mouse is over a pixel; for the next frame, in every view."""

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
        """Makes a state the present one, as a step of its own, by a smooth passage of its camera,
        or of the one that looks in the outside view, where that is to be seen."""

    def take(self, text: str) -> bool:
        """A text was pasted that holds no camera: shows the view that knows what to do with it;
        gives whether there is one."""

    @property
    def travelling(self) -> bool:
        """Whether such a passage is under way."""

    def animate(self) -> None:
        """Asks for a next frame at full rate: something is moving by itself."""


AView = TypeVar("AView", bound="DockedView")


class DockedView:
    """A view. name: unique, ImGui's id of the window. title: on its tab. padding, flags: of the
    ImGui window; None and 0: as the style has them. places: layouts that show it, beside those that
    name it themselves (layout.py), and the dock space that it has there.

    Methods are called in the window's thread, with its OpenGL context current.
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
        """Whether nothing in the view will change by itself."""
        return True

    def begin(self, host: Host, context: moderngl.Context) -> None:
        """Once, when there is a context."""

    def draw(self, host: Host) -> None:
        """Once a frame in which the view is to be seen, inside its ImGui window."""

    def unseen(self, host: Host) -> None:
        """Once a frame in which the view is hidden, or behind another tab."""

    def flown(self, host: Host) -> Camera | None:
        """The camera that the keys move while the mouse is over the view; None: there is none."""
        return None

    def with_flown(self, state: AppState, camera: Camera) -> AppState:
        """The state with that camera moved."""
        return state

    def takes(self, host: Host, text: str) -> bool:
        """Whether the view knows what to do with a text that was pasted and holds no camera; it
        has taken it then, and is shown."""
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
        """Whether something was entered that is not in the state, because it is not legal."""
        return False

    def drop_pending(self) -> None:
        """Takes that back."""

    def as_set(self, state: AppState) -> AppState:
        """The present state as it was made, without what the view has fitted to its size since."""
        return state

    def begin_anew(self) -> None:
        """A lecture has taken a step: what the view keeps beside the state is as at first."""

    def end(self) -> None:
        """Once, before the context goes."""


def view_of(views: Iterable[DockedView], kind: type[AView]) -> AView:
    """The view of a class among all views."""
    return next(view for view in views if isinstance(view, kind))
