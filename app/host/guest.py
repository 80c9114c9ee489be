"""A guest: what another instrument draws over the 3D views, and does there with the mouse.

The views know no guest by its name; who makes one gives it to them.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

from imgui_bundle import ImVec2

from app.state.app_state import AppState
from renderer.camera import Camera

if TYPE_CHECKING:
    from app.host.view import Host


@dataclass(frozen=True)
class ShownIn:
    """What a view shows. name: of the view. camera: as it is drawn. origin, extent: where the whole
    of its image is on the screen, in ImGui's units; it may be larger than the view."""

    name: str
    camera: Camera
    origin: ImVec2
    extent: ImVec2


@dataclass(frozen=True)
class Click:
    """number: of the object under the mouse in the id image; None for the background. double: the
    second of two. more: with Shift or Ctrl."""

    number: int | None
    double: bool
    more: bool


class Guest(Protocol):
    """All of it is called in the window's thread, in each frame of a view."""

    def holds(self, view: str) -> bool:
        """Whether the mouse is on something of the guest's: the view leaves it alone then."""

    def wants(self, host: Host, double: bool) -> bool:
        """Whether a click in a view is for the guest, not for the view."""

    def click(self, host: Host, shown: ShownIn, click: Click) -> None:
        """A click that it wanted."""

    def remedy(self, state: AppState, cause: str) -> str:
        """What a button says that helps where an image is black; "" for nothing. cause: as
        renderer/black.py has it."""

    def remedied(self, state: AppState, remedy: str) -> AppState:
        """The state after that button. Raises LucidaError."""

    def draw(self, host: Host, shown: ShownIn, over: bool) -> None:
        """Draws into the view's ImGui window. over: whether the mouse is over its picture."""
