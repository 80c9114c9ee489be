"""The window, as its instruments see it: the state, both images, files, and menu commands."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from typing import Protocol, TypeVar

from lucida.app.images.renderers import Renderers
from lucida.app.state.app_state import AppState
from lucida.app.state.bounds import OptionPart
from lucida.app.state.options import Options
from lucida.app.state.options.shared import Pixel
from lucida.renderer.scene import View as SceneView
from lucida.renderer.scene.focus import Focus

from .entry_box import Box
from .recent import RecentFiles
from .theme import Fonts

T = TypeVar("T")


class Filing(Protocol):
    """The window's files for views and actions. message: the last error."""

    message: str

    @property
    def recent(self) -> RecentFiles: ...
    def open(self, source: str) -> None: ...
    def open_dialog(self) -> None: ...
    def add_model_dialog(self) -> None: ...
    def save_view_dialog(self, view: SceneView) -> None: ...
    def save_as_dialog(
        self, title: str, name: str, kind: tuple[str, ...], store: Callable[[str], str]
    ) -> None:
        """Ask for a path, and save to it in the background.

        kind: the kind in words, and its extensions; the first is added to a name without one.
        store: saves to the path, and returns a message for the user.
        """

    def ask_name(
        self, title: str, name: str, kind: tuple[str, ...], named: Callable[[str], None]
    ) -> None:
        """Ask for a name to save under. kind: see save_as_dialog(). named: gets the path."""

    def ask_open(
        self, title: str, words: str, endings: tuple[str, ...], chosen: Callable[[list[str]], None]
    ) -> None:
        """Ask for files to open. words: a description of such files."""

    def ask(self, text: str, answers: dict[str, Callable[[], None]]) -> None:
        """Ask a question. answers: the buttons next to Cancel, with their functions."""

    def say(self, text: str) -> None:
        """Show a toast."""


class Around(Protocol):
    """The parts of the window around the views, for actions."""

    def open_document(self, name: str) -> None: ...


class Host(Protocol):
    """The window, for instruments and actions. Use it only on the window's thread.

    renderers: both images of the current state.
    files: opening and saving. shell: the parts around the views.
    moves: True if animations may run; False while a picture of the window is taken.
    is_rearranging: True until all views have their places, after which sizes are final.
    box: the open entry box, or None.
    """

    fonts: Fonts
    renderers: Renderers
    moves: bool
    is_rearranging: bool
    box: Box | None

    @property
    def has_tools(self) -> bool:
        """False if views are only pictures, as on a lecture's stage and in pages."""

    @property
    def files(self) -> Filing: ...
    @property
    def shell(self) -> Around: ...
    @property
    def state(self) -> AppState: ...
    @property
    def options(self) -> Options:
        """The current state's options."""

    @property
    def present(self) -> AppState:
        """The current state, even during a movement towards it."""

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
        changes with the same gesture other than None.
        """

    def edit(self, part: Options | OptionPart) -> None:
        """Replace a part of the options, as apply() does: `edit(replace(options.probe, ...))`."""

    def change(self, state: AppState) -> None:
        """Make a state the current one, as a separate undo step."""

    def amend(self, state: AppState) -> None:
        """Make a state the current one without an undo step, because the user did not cause the
        change.
        """

    def show(self, view: str) -> None:
        """Show a view that is hidden, or behind another tab."""

    def show_in(self, view: str, layout: str) -> None:
        """Show a view in a layout that has a place for it, unless it is visible."""

    def is_visible(self, view: str) -> bool:
        """Return True if a view was drawn in the last frame."""

    def view(self, kind: type[T]) -> T:
        """Return the window's instrument of a class."""

    def unclick(self) -> None:
        """Undo the previous click if it marked a pixel: it was the first of a double click."""

    def focus_object(self) -> None: ...
    def undo(self) -> None: ...
    def redo(self) -> None: ...
    def can_undo(self) -> bool: ...
    def can_redo(self) -> bool: ...
    def retry(self) -> None: ...
    def quit(self) -> None: ...
    def save_scene(self) -> None: ...
    def save_scene_as(self) -> None: ...
    def travel(self, state: AppState) -> None:
        """Make a state the current one, as an undo step, by a smooth transition of its camera, or
        of the outside camera if that is visible.
        """

    def move(
        self, state: AppState, move_s: float, loop: bool = False, start: AppState | None = None
    ) -> None:
        """Make a state the current one, as an undo step, and animate towards it for some seconds.

        The states in between are never in the history. Any change and any press of the mouse end
        the movement. loop: True to repeat it. start: None for the state that is shown.
        """

    def end_movement(self) -> bool:
        """End such a movement. Return True if one was under way that would have ended by itself."""

    @property
    def travelling(self) -> bool:
        """True while such a transition is under way."""

    def animate(self) -> None:
        """Request the next frame at full rate, because something is moving by itself."""
