"""The window's present state with its history, to which changes add undo steps."""

from __future__ import annotations

from collections.abc import Hashable

from imgui_bundle import hello_imgui, imgui

from lucida.app.images.renderers import Renderers
from lucida.app.lecture.movement import Movement
from lucida.app.state.app_state import AppState, History
from lucida.app.state.bounds import OptionPart
from lucida.app.state.options import Options
from lucida.renderer.scene.focus import scene_focus

from .playing import Playing


class Edits:
    """The part of ui/host.py's Host that changes the state. All changes while an item is held are
    one undo step.

    A change ends a movement between two states, because it would start from a state in between.
    """

    renderers: Renderers
    moves: bool

    def __init__(self, state: AppState) -> None:
        self.history = History(state)
        self.playing = Playing()
        self._gesture = 0
        self._was_active = False

    @property
    def state(self) -> AppState:
        """The present state, or the one that a movement towards it shows."""
        return self.playing.shown or self.history.present

    @property
    def options(self) -> Options:
        return self.state.options

    @property
    def present(self) -> AppState:
        return self.history.present

    def note_gesture(self) -> bool:
        """Begin another undo step if an item has become active. Return True while one is active.
        Call once a frame.
        """
        active = imgui.is_any_item_active()
        if active and not self._was_active:
            self._gesture += 1
        self._was_active = active
        return active

    def apply(self, state: AppState, gesture: Hashable = None) -> None:
        if state == self.state or self._was_moving():
            return
        if gesture is None and (self._was_active or imgui.is_any_item_active()):
            gesture = ("drag", self._gesture if self._was_active else self._gesture + 1)
        self.history = self.history.change(state, gesture)

    def edit(self, part: Options | OptionPart) -> None:
        self.apply(self.state.with_options(part))

    def change(self, state: AppState) -> None:
        if state != self.state and not self._was_moving():
            self.history = self.history.change(state)

    def amend(self, state: AppState) -> None:
        if not self.playing.under_way:  # otherwise repeated after the movement
            self.history = self.history.amended(state)

    def move(
        self, state: AppState, move_s: float, loop: bool = False, start: AppState | None = None
    ) -> None:
        start = start or self.state
        self.playing.end()
        self.change(state)
        if move_s and self.moves and not state.preferences.reduced_motion:
            movement = Movement(start, state, scene_focus(state.scene), self.renderers.size)
            self.playing.begin(movement, move_s, loop)
            self.animate()

    def end_movement(self) -> bool:
        return self.playing.end()

    def animate(self) -> None:
        hello_imgui.request_refresh()

    def unclick(self) -> None:
        self.history = self.history.unclicked(("drag", self._gesture))

    def _was_moving(self) -> bool:
        """End a movement. Return True if there was one."""
        was_moving = self.playing.under_way
        self.playing.end()
        return was_moving
