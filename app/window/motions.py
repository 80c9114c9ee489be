"""The window's animations: a camera's transition, and a movement between two states."""

from __future__ import annotations

from dataclasses import replace

from imgui_bundle import imgui

from lucida.app.cameras.presets import framed
from lucida.app.cameras.travel import CameraTransition
from lucida.app.instruments.outside.view import OutsideView
from lucida.app.state.app_state import AppState
from lucida.app.ui.host import Host
from lucida.app.ui.instrument import Instrument
from lucida.renderer.scene.focus import object_corners
from lucida.renderer.system.errors import LucidaError

from .edits import Edits


class Motions:
    """The movements of one window, whose states are `edits`."""

    def __init__(self, edits: Edits, instant: bool) -> None:
        self._edits = edits
        self.transition = CameraTransition()
        self.transition.instant = instant

    @property
    def under_way(self) -> bool:
        """True while anything moves."""
        return self.transition.under_way or self._edits.playing.under_way

    def stop(self) -> None:
        """Stop the transition and the movement at their present states."""
        self.transition.stop()
        self._edits.playing.end()

    def travel(self, host: Host, state: AppState) -> None:
        """Implement Host.travel()."""
        edits, now = self._edits, host.state
        ends = host.view(OutsideView).ends(host, state)
        shown = self.transition.begin(now, state, host.focus, host.renderers.size, ends)
        if shown is state:
            host.change(state)
        elif ends is None and state.options != now.options:
            # Only the camera moves gradually; the rest changes at once, in the same step.
            there = replace(now, options=state.options)
            edits.history = edits.history.change(there, self.transition.gesture)
        host.animate()

    def focus_object(self, host: Host, view: Instrument) -> None:
        """Frame the object under the mouse in a view, or the whole scene if there is none."""
        camera, number = view.own_camera(host), view.object_under(host)
        if camera is None:
            return
        points = host.focus.framed
        if number is not None:
            points = object_corners(host.state.scene.objects[number])
        try:
            camera = framed(camera, points, host.focus.bounds)
        except LucidaError:  # it is too large to frame
            return
        host.travel(view.with_own_camera(host.state, camera))

    def frame(self, host: Host, active: bool) -> None:
        """Advance all animations by a frame. A press of the mouse ends a movement; a press on an
        item also ends a transition.

        active: True while an item is held.
        """
        edits, pressed = self._edits, any(imgui.is_mouse_clicked(button) for button in range(3))
        if edits.playing.under_way:
            edits.playing.frame(pressed)
            host.animate()
        if active and pressed:
            self.transition.stop()
        state = self.transition.step(edits.state)
        if state is not edits.state:
            edits.history = edits.history.change(state, self.transition.gesture)
        if self.transition.under_way:
            host.animate()
