"""The parts around the views: documents, dialogs, toasts, the session.

The shell also handles Escape.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from imgui_bundle import imgui

from lucida.app.images.renderers import Renderers
from lucida.app.instruments.objects.choosing import choose, chosen
from lucida.app.lecture.view import LectureView
from lucida.app.state.app_state import AppState
from lucida.app.state.session import Session, session_of
from lucida.app.ui.host import Host
from lucida.app.ui.instrument import Instrument
from lucida.app.ui.messages import loading_box, message_box
from lucida.app.ui.stage import Rect, Stage
from lucida.app.ui.toasts import Toasts
from lucida.renderer.system.errors import describe

from .documents import Documents
from .files import Files
from .hints import Hints
from .proportion import Proportion
from .session_store import Keeper
from .shortcut_sheet import keys_document

REDRAWN = 8  # frames after a change of the bars or of the views' places


class Shell:
    """The shell of one window. keeper: saves the session; None if none is kept.

    folder: the settings folder; None for none.
    """

    def __init__(
        self,
        views: list[Instrument],
        files: Files,
        keeper: Keeper | None = None,
        folder: Path | None = None,
    ) -> None:
        self.stage: Stage = Stage(views)
        self.proportion = Proportion()
        self.toasts = Toasts()
        self.documents = Documents(keys_document)
        self.hints = Hints(folder)
        self.files = files
        self._keeper = keeper
        self._kept: AppState | None = None
        self._asked = False  # whether a field had the keyboard in the last frame
        self._popup = False  # whether a popup was open at the end of the last frame
        self._answered = ""  # the text of the failure whose message was closed
        self._division: tuple[bool, dict[str, Rect]] = False, {}  # of the last frame
        self._dividing = 0  # number of frames to request for it

    # Requests of actions.

    def open_document(self, name: str) -> None:
        self.documents.open(name)

    def escape(self, window: Host) -> None:
        """Handle Escape: close the topmost box, cancel long work, leave presentation mode, or clear
        the selection or the mark.
        """
        if self.files.dialog.is_open:
            self.files.dialog.cancel()
        elif self.files.question is not None:
            self.files.question = None
        elif self.files.message:
            self.files.message = ""
        elif failure := self._unanswered(window.renderers):
            self._answered = describe(failure)
        elif self.documents.shown:
            self.documents.shown = ""
        elif window.box is not None:
            window.box = None
        elif self.files.loading:
            self.files.cancel()
        elif window.state.preferences.presentation:
            window.edit(replace(window.state.preferences, presentation=False))
        elif chosen(window.state):
            window.amend(choose(window.state, ()))
        elif window.state.marked is not None:
            window.change(window.state.with_options(replace(window.state.options, marked=None)))
        else:
            self.toasts.clear()

    # The frame.

    def frame(self, window: Host) -> None:
        """Update the parts. Call once a frame, before the views."""
        self.draw_until_divided(window)
        self.stage.follow()
        self.stage.leave_out_hidden(window)
        self._keep(window)
        for said in self.files.poll_said():
            self.toasts.add(said)

    def draw_until_divided(self, window: Host) -> None:
        """Request frames until bars and views have their places. Each change takes effect a frame
        later, and an idle window on a slow machine would show intermediate layouts for seconds.
        """
        division = window.has_tools, dict(self.stage.rects)
        self._dividing = REDRAWN if division != self._division else max(self._dividing - 1, 0)
        self._division = division
        if self._dividing:
            window.animate()

    def draw(self, window: Host, typing: bool = False, in_menus: bool = False) -> None:
        """Draw the boxes over the views. typing: True if a box has the keyboard, and handles Escape
        as the menus do.
        """
        # ImGui closes a popup or a menu itself, as long as nobody else claims the key.
        if not (self._popup or typing or in_menus) and imgui.shortcut(
            int(imgui.Key.escape), imgui.InputFlags_.route_global
        ):
            self.escape(window)
        if not self.toasts.texts:  # they are at the same place, and come first
            self.hints.draw(window, self.stage.rects)
        self.documents.draw()
        self.files.dialog.draw()
        if self.files.loading and loading_box(
            f"Loading {self.files.loading}", self.files.loading_s
        ):
            self.files.cancel()
        self._messages(window)
        self.toasts.draw()
        self._hide_cursor(typing or self.files.dialog.is_open)

    def _hide_cursor(self, asks: bool) -> None:
        """Hide the keyboard's cursor once the field that was typed into is gone.

        The cursor and its tooltip would be on an item that the user did not select. Tab and the
        arrow keys show it again.
        """
        if self._asked and not asks:
            imgui.set_nav_cursor_visible(False)
        self._asked = asks

    def note_popups(self) -> None:
        """Record whether a popup is open. Call at the end of a frame, because ImGui closes a popup
        by Escape before the next frame begins.
        """
        any_popup = imgui.PopupFlags_.any_popup_id | imgui.PopupFlags_.any_popup_level
        self._popup = bool(imgui.is_popup_open("", int(any_popup)))

    def end(self, window: Host, keeps_edits: bool = True) -> None:
        """Save the session. Call once, at the end. keeps_edits: include unsaved changes."""
        if self._keeper is not None:
            session = self._session(window)
            if not keeps_edits:
                session = replace(session, unsaved="")
            self._keeper.close(session)

    def _session(self, window: Host) -> Session:
        """Return the session to save."""
        state = window.present
        lecture = window.view(LectureView).kept(state)
        return session_of(state, self.stage.arrangement(), lecture)

    def _messages(self, window: Host) -> None:
        """Draw one message at a time: questions first, then failures."""
        if self._keeper is not None and self._keeper.message:
            self.toasts.add(self._keeper.message, good=False)
            self._keeper.message = ""
        question = self.files.question
        if question is not None:
            answer = message_box(question.text, (*question.answers, "Cancel"))
            if answer:
                self.files.question = None
            if answer in question.answers:
                question.answers[answer]()
            return
        if self.files.message:
            if message_box(self.files.message):
                self.files.message = ""
            return
        failure = self._unanswered(window.renderers)
        if failure is None:
            return
        both = window.renderers
        who = {both.raster_error: "rasterizer", both.ray_error: "ray tracer"}
        text = f"The {who.get(failure, 'comparison')} failed. {describe(failure)}"
        undo = ("Undo",) if window.can_undo() else ()
        answer = message_box(text, ("Try again", *undo, "Close"))
        if answer == "Try again":
            window.retry()
        elif answer == "Undo":
            window.undo()
        elif answer == "Close":
            self._answered = describe(failure)

    def _unanswered(self, renderers: Renderers) -> Exception | None:
        """Return a failure that the user has not answered yet."""
        failure = renderers.failure
        if failure is None:
            self._answered = ""  # report the next failure, even if it is the same
        # A failure in each frame is a new exception each time: compare the words.
        return failure if failure is not None and describe(failure) != self._answered else None

    def _keep(self, window: Host) -> None:
        keeper = self._keeper
        if keeper is None:
            return
        io, state, answered = (
            imgui.get_io(),
            window.present,
            window.view(LectureView).take_answered(),
        )
        if state is not self._kept or io.want_save_ini_settings or answered:
            self._kept, io.want_save_ini_settings = state, False
            keeper.mark()
        if keeper.due():
            keeper.save(self._session(window))
