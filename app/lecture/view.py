"""The guided lecture: a column of text next to the views that a step shows.

The view holds the open lecture, and puts the window into the state of a step. column.py draws texts
and exercises, controls.py the foot; model.py defines a step, step_options.py its state.
"""

from __future__ import annotations

import time
from collections.abc import Collection, Sequence
from dataclasses import replace
from pathlib import Path

import moderngl
from imgui_bundle import ImVec2, imgui

from lucida.app.instruments.outside.view import OutsideView
from lucida.app.state.app_state import AppState
from lucida.app.state.kept_lecture import KeptLecture
from lucida.app.state.session import source_of
from lucida.app.ui import layout
from lucida.app.ui.background import Background
from lucida.app.ui.host import Host
from lucida.app.ui.instrument import Instrument, view_of

from .answer_log import AnswerLog
from .column import Column
from .controls import Controls
from .drawn_answer import DrawnAnswer
from .foot import BACK, END, NEXT
from .invitation import invitation
from .model import Lecture
from .reading import BUILTIN, load_lecture
from .session import LectureReread, LectureSession, reread
from .step_options import own, state_of

LECTURE = "Lecture"
# A text over a picture: its width relative to the window's, and its background's opacity.
OVER, GROUND = 0.68, 0.85
STACKED = 1.5  # width / height of the window below which two pictures are stacked
UPRIGHT = {"stepper"}  # views that need their height


class LectureView(Instrument):
    """The view "Lecture". views: all views; the steps of a lecture show the others.

    log: keeps the answers, if the user asked for it.
    """

    name = LECTURE
    title = "Lecture"
    padding = ImVec2(18, 14)

    def __init__(self, views: Sequence[Instrument]) -> None:
        self._views = views
        self.session: LectureSession | None = None
        self._reading: Background[LectureReread] | None = None
        self._column: Column | None = None
        self._arranged = True
        self._entered = False  # True if the step's state is set
        self._before: AppState | None = None  # the state when the lecture began
        self._put_off: tuple[KeptLecture, KeptLecture, str] | None = None
        self._begun = False
        self.arrangements = 0  # number of times that the views were arranged
        self._layout = ""  # the layout when the lecture began
        self._lies_over = False  # the text was over the picture in the last frame
        self._is_stacked = False  # one picture was above the other
        self.log: AnswerLog | None = None
        self._controls = Controls()
        self._drawn_answer = DrawnAnswer()

    @property
    def column(self) -> Column:
        assert self._column is not None
        return self._column

    @property
    def shows_controls(self) -> bool:
        return self._controls.shown

    @property
    def _others(self) -> list[Instrument]:
        return [view for view in self._views if view is not self]

    # Requests of actions and buttons.

    def give(
        self,
        lecture: Lecture,
        path: Path,
        at: tuple[int, int] = (0, 0),
        left: KeptLecture | None = None,
    ) -> None:
        """Begin a lecture at a build of a step, in the next frame.

        left: the previous session, at whose step the lecturer may continue.
        """
        self.session = LectureSession(lecture, path, at, left)
        self._entered, self._put_off = False, None

    def resume(self, session: LectureSession, shown: Collection[str]) -> None:
        """Continue a lecture in the window's current state and views, the names `shown`. If these
        are the step's, they go to their places again.
        """
        self.session, self._before, self._entered = session, None, True
        self._arranged = {LECTURE, *map(str.capitalize, session.step.views)} != {*shown}

    def take_begun(self) -> bool:
        """Return True if a lecture was begun since the last call."""
        begun, self._begun = self._begun, False
        return begun

    def put_off(self, kept: KeptLecture, scene: str) -> None:
        """Keep a lecture that cannot be read now in the session until another one is opened.

        scene: the scene shown in place of its step's.
        """
        self._put_off = replace(kept, in_step=False), kept, scene

    def kept(self, state: AppState) -> KeptLecture | None:
        """Return the lecture's entry for a session file."""
        if self.session is not None:
            return self.session.kept(state)
        if self._put_off is None:
            return None
        elsewhere, kept, scene = self._put_off
        return kept if source_of(state.scene) == scene else elsewhere

    def take_answered(self) -> bool:
        """Return True if an answer was given since the last call."""
        answered, self.column.answered = self.column.answered, False
        return answered

    def leave(self, window: Host) -> None:
        """End the lecture, in the default layout and type. Restore the previous scene and view,
        unless the user has opened another scene since.
        """
        if self.session is None:
            return
        steps, state = self.session.lecture.steps, window.state
        self.session = None
        state = replace(state, options=own(state.options), step=None)
        if self._before is not None and any(step.scene is state.scene for step in steps):
            state = state.with_scene(self._before.scene, self._before.view)
        window.change(state.with_options(replace(state.options.preferences, presentation=False)))
        layout.switch(self._layout or layout.LAYOUTS[0].name)

    @property
    def is_given(self) -> bool:
        return self.session is not None

    def go(self, window: Host, number: int, build: int = 0) -> None:
        """Go to a build of a step, and show its own state."""
        if self.session is not None:
            self.session.go(number, build)
            self._enter(window)

    def read_again(self, window: Host, title: str) -> None:
        """Go to the last build, which has the whole text, of the step with a title: in the open
        lecture, or in the built-in one, which then begins.
        """
        number = None if self.session is None else self.session.lecture.number_of(title)
        if self.session is not None and number is not None:
            self.go(window, number, self.session.lecture.count(number) - 1)
            return
        lecture = load_lecture(BUILTIN)
        number = lecture.number_of(title) or 0
        self.give(lecture, BUILTIN, (number, lecture.count(number) - 1))

    @property
    def was_left(self) -> bool:
        """True if the lecture can continue where the previous session ended."""
        return self.session is not None and self.session.left is not None

    def go_on(self, window: Host) -> None:
        """Go to the step at which the previous session ended."""
        if self.session is not None and self.session.left is not None:
            self.session.go_on(self.session.left)
            self._enter(window)

    def advance(self, window: Host, builds: int) -> None:
        """Go to the next build (1) or the previous one (-1), or else end a current movement."""
        if self.session is None or window.end_movement():
            return
        before = self.session.step
        if not self.session.walk(builds):
            return
        step = self.session.step
        if not self._entered or step.number != before.number:
            self._enter(window)
            return
        self.column.begin_build(fades=builds > 0)
        move_s = (before if builds < 0 else step).move_s
        self._build(window, move_s, step.loop and builds > 0)
        if step.views != before.views:
            self._arrange()

    def play(self, window: Host) -> None:
        """Play the movement to the present build again."""
        if self.session is None or self.session.step.build == 0 or not self._entered:
            return
        step, (_, number, build) = self.session.step, self.session.place
        lecture = self.session.lecture
        before = lecture.builds[lecture.place(number, build - 1)]
        own = state_of(step, window.state)
        window.move(own, step.move_s, step.loop, start=state_of(before, own))

    def _enter(self, window: Host) -> None:
        """Show the step's own state. A lecture that has just begun does so in its first frame."""
        if self._entered:
            self.restore(window)

    def restore(self, window: Host, **preferences: bool) -> None:
        """Restore the step's own scene, camera, options and views."""
        if self.session is None:
            return
        self._build(window, 0.0, **preferences)
        self._entered = True
        self.column.begin_step()
        for view in self._others:
            view.begin_anew()
        self._arrange()

    def _build(self, window: Host, move_s: float, loop: bool = False, **preferences: bool) -> None:
        """Show the present build's own state, after a movement."""
        assert self.session is not None
        state = replace(window.state, step=self.session.place)
        state = state.with_options(state.options.with_changes({"preferences": preferences}))
        window.move(state_of(self.session.step, state), move_s, loop)

    def _arrange(self) -> None:
        self._arranged = False
        layout.switch(layout.LECTURE)

    # The frame.

    @property
    def settled(self) -> bool:
        working = any(one is not None and one.busy for one in (self._reading, self._column))
        return not (self.is_entering or (self.session is not None and working))

    @property
    def is_entering(self) -> bool:
        """True until a step's views have been arranged."""
        return self.session is not None and not (self._entered and self._arranged)

    def begin(self, host: Host, context: moderngl.Context) -> None:
        self._reading = Background("lucida-lecture", host.animate)
        self._column = Column(host, self.log)

    def end(self) -> None:
        if self._reading is not None:
            self._reading.close()
        if self._column is not None:
            self._column.hidden_watch.close()

    def follow(self, host: Host) -> None:
        """Handle new steps and newer files.

        Call this once a frame, even while the view is hidden.
        """
        if self.session is None:
            return
        division = self._is_over(host), is_stacked(self.session.step.views, layout.window_px())
        if division != (self._lies_over, self._is_stacked):
            self._lies_over, self._is_stacked = division
            self._arrange()
        if not self._entered:  # the lecture becomes visible
            if host.state.step is None:  # not if one lecture follows another
                self._before, self._layout = host.state, layout.current().name
            self.restore(host, presentation=True)
            self._begun = True
        number = self._controls.follow(host)
        if number is not None:
            self.go(host, number)
        self._follow_undo(host.state.step, self.session)
        if not self._arranged and layout.current().name == layout.LECTURE:
            names = map(str.capitalize, self.session.step.views)
            second = layout.STACKED_SPACE if self._is_stacked else layout.LOWER_SPACE
            spaces = (layout.MAIN, second)
            layout.arrange(self._others, dict(zip(names, spaces, strict=False)))
            self.arrangements += 1
            self._arranged = True
            imgui.set_nav_cursor_visible(False)  # its item no longer exists
            host.animate()
        self._follow_file(host, self.session)

    def _follow_undo(self, place: tuple[str, int, int] | None, session: LectureSession) -> None:
        """Show another step's text and views if undo or redo went into its states."""
        if place is None or place[0] != session.lecture.source:
            return
        views = session.step.views
        if session.go(*place[1:]) and session.step.views != views:
            self._arrange()

    def _follow_file(self, host: Host, session: LectureSession) -> None:
        assert self._reading is not None
        if session.watch.changed(time.monotonic()):
            self._reading.submit(lambda: reread(session))
        if session.watch.waiting:
            host.animate()
        outcome = self._reading.poll()
        if outcome is None or outcome.value is None or outcome.value.session is not session:
            return  # another lecture was begun meanwhile
        if outcome.value.lecture is not None:
            session.take(outcome.value.lecture)
            self.restore(host)
        session.error = outcome.value.mistake

    # Drawing.

    def draw(self, host: Host) -> None:
        session = self.session
        if session is None:
            if (path := invitation(host)) is not None:
                self.give(load_lecture(path), path)
            return
        self._keys(host)
        draw = self.column.draw_over if self._lies_over else self.column.draw
        if title := draw(host, session):
            self.read_again(host, title)
        if not self._lies_over or self.shows_controls:
            self._do(host, self._controls.draw(host, session))
        self._drawn_answer.show(host, view_of(self._views, OutsideView), session)

    def _is_over(self, host: Host) -> bool:
        """Return True if the picture fills the window and the text lies over it."""
        session = self.session
        return session is not None and session.step.full and not host.has_tools

    def placed(self, host: Host) -> int:
        session, whole = self.session, layout.whole()
        if session is None or whole is None or not self._lies_over:
            return 0
        (left, top), (wide, high) = whole
        width = OVER * wide
        is_empty = not (session.step.blocks or session.error or self.shows_controls)
        imgui.set_next_window_pos((left + 0.5 * (wide - width), top - high * is_empty))
        imgui.set_next_window_size_constraints((width, 0), (width, high))
        imgui.set_next_window_bg_alpha(GROUND)
        flags = imgui.WindowFlags_
        return int(flags.no_decoration | flags.always_auto_resize | flags.no_move)

    def _keys(self, host: Host) -> None:
        """Handle the arrow keys while the column has the keyboard. Page Up and Page Down are
        actions.
        """
        if imgui.is_any_item_active():
            return
        for key, steps in ((imgui.Key.left_arrow, -1), (imgui.Key.right_arrow, 1)):
            if imgui.shortcut(int(key)):
                self.advance(host, steps)

    def unseen(self, host: Host) -> None:
        self._drawn_answer.hide(view_of(self._views, OutsideView))

    def _do(self, host: Host, asked: int | str | None) -> None:
        """Handle a request of the foot."""
        if asked == END:
            self.leave(host)
        elif asked in (BACK, NEXT):
            self.advance(host, 1 if asked == NEXT else -1)
        elif isinstance(asked, int):
            self.go(host, asked)


def is_stacked(views: Sequence[str], window_px: tuple[float, float]) -> bool:
    """Return True if a step's two pictures are larger one above the other."""
    width, height = window_px
    return len(views) == 2 and width < STACKED * height and UPRIGHT.isdisjoint(views)
