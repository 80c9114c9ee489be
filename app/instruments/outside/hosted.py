"""The outside view's guest, which acts in it for another instrument; see app/ui/guest.py."""

from __future__ import annotations

from collections.abc import Callable

from imgui_bundle import imgui

from lucida.app.ui.guest import Click, Guest, ShownIn
from lucida.app.ui.host import Host

from .mouse import Scope


class Hosted:
    """The guest of one view. view: the view's name. guest: set by the guest itself, or None."""

    def __init__(self, view: str) -> None:
        self._view = view
        self.guest: Guest | None = None
        self._took_double = False  # a double-click's release is not a click

    @property
    def holds(self) -> bool:
        """Return True if the mouse is on something of the guest's."""
        return self.guest is not None and self.guest.holds(self._view)

    def draw(self, host: Host, scope: Scope, over: bool) -> None:
        if self.guest is not None:
            self.guest.draw(host, self._shown(scope), over or self.holds)

    def take_click(
        self,
        host: Host,
        scope: Scope,
        clicked: bool,
        number: Callable[[], int | None],
    ) -> bool:
        """Offer the guest a click on the current item. Return True if it took the click.

        clicked: True if the button was released. number: the object under the mouse.
        """
        left = imgui.MouseButton_.left
        double = imgui.is_item_activated() and imgui.is_mouse_double_clicked(left)
        if clicked and self._took_double:
            self._took_double = False
            return True
        if self.guest is None or not (double or clicked) or not self.guest.wants(host, double):
            return False
        if double:
            host.unclick()
        io = imgui.get_io()
        click = Click(number(), double, io.key_shift or io.key_ctrl)
        self.guest.click(host, self._shown(scope), click)
        self._took_double = double
        return True

    def _shown(self, scope: Scope) -> ShownIn:
        return ShownIn(self._view, scope.shown, scope.origin, scope.extent)
