"""A guest: another instrument that draws over the 3D views and uses the mouse there.

Views do not know their guests by name: each guest is passed to them.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

from imgui_bundle import ImVec2

from lucida.renderer.camera.camera import Camera

if TYPE_CHECKING:
    from .host import Host


@dataclass(frozen=True)
class ShownIn:
    """The image that a view shows.

    name: the view's name. camera: the camera that draws it. origin, extent: the rectangle of the
    whole image on the screen, in ImGui's units; it may be larger than the view.
    """

    name: str
    camera: Camera
    origin: ImVec2
    extent: ImVec2


@dataclass(frozen=True)
class Click:
    """A click in a view.

    number: the object under the mouse, as in the id image; None for the background.
    double: True for the second click of a double click.
    more: True if Shift or Ctrl is held.
    """

    number: int | None
    double: bool
    more: bool


class Guest(Protocol):
    """The interface of a guest. All methods are called on the window's thread, in each frame of a
    view.
    """

    def holds(self, view: str) -> bool:
        """Return True if the mouse is over something of the guest's. The view then ignores the
        mouse.
        """

    def wants(self, host: Host, double: bool) -> bool:
        """Return True if a click in a view is for the guest, not for the view."""

    def click(self, host: Host, shown: ShownIn, click: Click) -> None:
        """Handle a click for which wants() returned True."""

    def draw(self, host: Host, shown: ShownIn, over: bool) -> None:
        """Draw into the view's ImGui window. over: True if the mouse is over its picture."""
