"""The guided lecture: a column of text next to the views that a step shows.

The view has the open lecture, and puts the window into the state of a step. slide.py draws texts,
exercise.py exercises, foot.py the navigation; model.py defines a step, step_options.py its state.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import moderngl
from imgui_bundle import ImVec2, imgui

from app.instruments.outside.growing import stage_at, stages_of
from app.instruments.outside.options import OutsideOptions
from app.instruments.outside.view import OutsideView
from app.lecture.answer_log import AnswerLog
from app.lecture.answer_note import note
from app.lecture.drawn_answer import DrawnAnswer
from app.lecture.exercise import exercise
from app.lecture.exercises import ChoiceExercise
from app.lecture.foot import BACK, END, NEXT, RESTORE, foot, foot_height
from app.lecture.hiding import HideExercise
from app.lecture.inheriting import changed_view
from app.lecture.invitation import invitation
from app.lecture.model import Lecture, Step
from app.lecture.reading import load_lecture
from app.lecture.session import LectureReread, LectureSession, reread
from app.lecture.slide import TITLE, Slides
from app.lecture.step_options import own, state_of
from app.lecture.text import Block, in_language, languages
from app.lecture.watching_hidden import HiddenWatch
from app.state.app_state import AppState
from app.state.kept_lecture import KeptLecture
from app.state.session import source_of
from app.ui import layout, theme
from app.ui.background import Background
from app.ui.checks import radio_button
from app.ui.explaining.languages import LANGUAGES
from app.ui.lettering import lettering
from app.ui.messages import wrapped
from app.ui.view import DockedView, Host, view_of
from renderer.system.errors import LucidaError

LECTURE = "Lecture"
CHOSEN_S = 1.0  # of the movement to the camera of the chosen answer
FADE_S = 0.5  # of a text that is added
CONTROLS_S = 2.0  # until controls go after the mouse rests
# Of a text over a picture: its part of the window's width, its least width, the part of the height
# that it may take, and the opacity of its ground.
OVER, LEAST_OVER_EM, MOST_OVER, GROUND = 0.6, 28.0, 0.3, 0.85


class LectureView(DockedView):
    """The view "Lecture". views: all views; the steps of a lecture show the others.

    log: keeps what is answered, if the user asked for it.
    """

    name = LECTURE
    title = "Lecture"
    padding = ImVec2(18, 14)

    def __init__(self, views: Sequence[DockedView]) -> None:
        self._views = views
        self.session: LectureSession | None = None
        self._reading: Background[LectureReread] | None = None
        self._slides: Slides | None = None
        self.hidden_watch: HiddenWatch | None = None
        self._arranged = True
        self._entered = False  # whether the step's state has been taken
        self._before: AppState | None = None  # what the window showed when the lecture began
        self._put_off: tuple[KeptLecture, KeptLecture, str] | None = None
        self._answered = self._begun = False
        self.arrangements = 0  # how often the views have been put into their places
        self._layout = ""  # the one that was shown when the lecture began
        self._moved_s = 0.0  # when the mouse moved last
        self._typed = ""  # digits of a step's number
        self._lies_over = False  # the text, in the last frame
        self._to_top = False  # a step's text is read from its beginning
        self.log: AnswerLog | None = None
        self._seek = False  # the text is scrolled to what was just added
        self._added_s: float | None = None  # when that was, while it fades in
        self._fitted: tuple[object, ...] = ()  # what the size of the text follows from
        self._drawn_answer = DrawnAnswer()

    @property
    def _others(self) -> list[DockedView]:
        return [view for view in self._views if view is not self]

    # What actions and buttons ask for.

    def give(
        self,
        lecture: Lecture,
        path: Path,
        at: tuple[int, int] = (0, 0),
        left: KeptLecture | None = None,
    ) -> None:
        """Begin a lecture at a build of a step, in the next frame.

        left: the sitting before, at whose step the lecturer may go on.
        """
        self.session = LectureSession(lecture, path, at, left)
        self._entered, self._put_off = False, None

    def resume(self, session: LectureSession) -> None:
        """Continue a lecture in the window's current state and views."""
        self.session, self._before = session, None
        self._entered = self._arranged = True

    def take_begun(self) -> bool:
        """Return True if a lecture was begun since the last call."""
        begun, self._begun = self._begun, False
        return begun

    def put_off(self, kept: KeptLecture, scene: str) -> None:
        """Keep a lecture that cannot be read now in the session until another one is opened.

        scene: the scene that is shown instead of its step's.
        """
        self._put_off = replace(kept, in_step=False), kept, scene

    def kept(self, state: AppState) -> KeptLecture | None:
        """Return what a session file keeps of the lecture."""
        if self.session is not None:
            return self.session.kept(state)
        if self._put_off is None:
            return None
        elsewhere, kept, scene = self._put_off
        return kept if source_of(state.scene) == scene else elsewhere

    def take_answered(self) -> bool:
        """Return True if something was answered since the last call."""
        answered, self._answered = self._answered, False
        return answered

    def leave(self, window: Host) -> None:
        """End the lecture, in the default layout and type. Bring back the scene and the view from
        before, unless the user has opened another scene since.
        """
        if self.session is None:
            return
        steps, state = self.session.lecture.steps, window.state
        self.session = None
        state = replace(state, options=own(state.options), step=None)
        if self._before is not None and any(step.scene is state.scene for step in steps):
            state = state.with_scene(self._before.scene, self._before.view)
        window.change(state.with_options(preferences={"presentation": False}))
        layout.switch(self._layout or layout.LAYOUTS[0].name)

    @property
    def is_given(self) -> bool:
        return self.session is not None

    def go(self, window: Host, number: int, build: int = 0) -> None:
        """Go to a build of a step, and show its own state."""
        if self.session is not None:
            self.session.go(number, build)
            self._enter(window)

    @property
    def was_left(self) -> bool:
        """True if the lecture can go on where the sitting before ended."""
        return self.session is not None and self.session.left is not None

    def go_on(self, window: Host) -> None:
        """Go to the step at which the sitting before ended."""
        if self.session is not None and self.session.left is not None:
            self.session.go_on(self.session.left)
            self._enter(window)

    def advance(self, window: Host, builds: int) -> None:
        """Go to the next build (1), or to the one before (-1). End a movement that is under way
        instead.
        """
        if self.session is None or window.end_movement():
            return
        before = self.session.step
        if not self.session.walk(builds):
            return
        step = self.session.step
        if not self._entered or step.number != before.number:
            self._enter(window)
            return
        self._answered = self._seek = True
        self._added_s = time.monotonic() if builds > 0 else None
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
        self._entered = self._to_top = True
        for view in self._others:
            view.begin_anew()
        self._arrange()

    def _build(self, window: Host, move_s: float, loop: bool = False, **preferences: bool) -> None:
        """Show the present build's own state, after a movement."""
        assert self.session is not None
        state = replace(window.state, step=self.session.place)
        state = state.with_options(preferences=preferences)
        window.move(state_of(self.session.step, state), move_s, loop)

    def _arrange(self) -> None:
        self._arranged = False
        layout.switch(layout.LECTURE)

    # The frame.

    @property
    def settled(self) -> bool:
        working = any(one is not None and one.busy for one in (self._reading, self.hidden_watch))
        working = working or self._added_s is not None
        return not (self.is_entering or (self.session is not None and working))

    @property
    def is_entering(self) -> bool:
        """True while a step's views must still be put into their places."""
        return self.session is not None and not (self._entered and self._arranged)

    def begin(self, host: Host, context: moderngl.Context) -> None:
        self._reading = Background("lucida-lecture", host.animate)
        self._slides = Slides(host.fonts)
        self.hidden_watch = HiddenWatch(host.animate)

    def end(self) -> None:
        for one in (self._reading, self.hidden_watch):
            if one is not None:
                one.close()

    def follow(self, host: Host) -> None:
        """Take steps and newer files. Call once a frame, also while the view is hidden."""
        if self.session is None:
            return
        if self._lies_over != self._is_over(host):
            self._lies_over = not self._lies_over
            self._arrange()
        if not self._entered:  # to be seen from the last row, whichever way it was begun
            if host.state.step is None:  # otherwise one lecture follows another
                self._before, self._layout = host.state, layout.current().name
            self.restore(host, presentation=True)
            self._begun = True
        self._follow_mouse(host)
        self._follow_undo(host.state.step, self.session)
        if not self._arranged and layout.current().name == layout.LECTURE:
            names = map(str.capitalize, self.session.step.views)
            spaces = (layout.MAIN, layout.LOWER_SPACE)
            layout.arrange(self._others, dict(zip(names, spaces, strict=False)))
            self.arrangements += 1
            self._arranged = True
            imgui.set_nav_cursor_visible(False)  # with its tooltip it was on what has gone
            host.animate()
        self._follow_file(host, self.session)

    @property
    def shows_controls(self) -> bool:
        """True while the mouse moves, and two seconds after it."""
        return time.monotonic() - self._moved_s < CONTROLS_S or bool(self._typed)

    def _follow_mouse(self, host: Host) -> None:
        """Follow the mouse, and the digits of a step's number that are typed before Enter."""
        io = imgui.get_io()
        if host.moves and (io.mouse_delta.x or io.mouse_delta.y):
            self._moved_s = time.monotonic()
        popup = imgui.PopupFlags_.any_popup_id | imgui.PopupFlags_.any_popup_level
        if imgui.is_popup_open("", int(popup)):
            self._moved_s = time.monotonic()
        if self.shows_controls:
            host.animate()
        if io.want_text_input or io.key_ctrl or io.key_shift or io.key_alt:
            self._typed = ""
            return
        for digit in range(10):
            if imgui.is_key_pressed(imgui.Key(int(imgui.Key._0) + digit)):
                self._typed = (self._typed + str(digit))[-3:]
        if self._typed and imgui.is_key_pressed(imgui.Key.enter):
            self.go(host, int(self._typed) - 1)
            self._typed = ""

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

    # The column.

    def draw(self, host: Host) -> None:
        if self.session is None:
            if (path := invitation(host)) is not None:
                self.give(load_lecture(path), path)
            return
        session, slides = self.session, self._slides
        self._keys(host)
        assert slides is not None
        slides.notation = host.state.options.notation
        position = host.state.of(OutsideOptions).formula
        stages = stages_of(host.renderers.camera(host.state))
        slides.lit = stage_at(position, stages) if position is not None else ""
        if self._lies_over:
            self._over(host, session, slides)
        else:
            self._column(host, session, slides)
        self._drawn_answer.show(host, view_of(self._views, OutsideView), session)

    def _column(self, host: Host, session: LectureSession, slides: Slides) -> None:
        """Draw the text, which is scrolled if it is longer than the column, and what is below."""
        imgui.text_colored(theme.DIM, session.step.part or session.lecture.title)
        with lettering(host.fonts.bold, TITLE):
            wrapped(session.step.title)
        imgui.dummy(ImVec2(0, 0.25 * imgui.get_font_size()))
        if session.error:
            wrapped(session.error, theme.ERROR)
        if self.log is not None and note(self.log, session.step.exercise is not None):
            self.log = None
        room = ImVec2(0, -foot_height())
        if imgui.begin_child("step", room, imgui.ChildFlags_.nav_flattened):
            if self._to_top:
                imgui.set_scroll_y(0.0)
                self._to_top = False
            self._body(host, session, slides, imgui.get_content_region_avail().y)
        imgui.end_child()
        self._controls(host, session)

    # Over the picture.

    def _is_over(self, host: Host) -> bool:
        """Return True if the picture fills the window and the text lies over it."""
        session = self.session
        return session is not None and session.step.full and not host.has_tools

    def placed(self, host: Host) -> int:
        session, whole = self.session, layout.whole()
        if session is None or whole is None or not self._lies_over:
            return 0
        (left, top), (wide, high) = whole
        width = max(OVER * wide, min(LEAST_OVER_EM * imgui.get_font_size(), wide))
        is_empty = not (session.step.blocks or session.error or self.shows_controls)
        imgui.set_next_window_pos((left + 0.5 * (wide - width), top - high * is_empty))
        imgui.set_next_window_size_constraints((width, 0), (width, high))
        imgui.set_next_window_bg_alpha(GROUND)
        flags = imgui.WindowFlags_
        return int(flags.no_decoration | flags.always_auto_resize | flags.no_move)

    def _over(self, host: Host, session: LectureSession, slides: Slides) -> None:
        """Draw the text over the picture, and the controls below it while the mouse moves."""
        if session.step.blocks:
            self._body(host, session, slides, MOST_OVER * layout.window_px()[1])
        if session.error:
            wrapped(session.error, theme.ERROR)
        if self.shows_controls:
            self._controls(host, session)

    def _keys(self, host: Host) -> None:
        """Handle the arrow keys while the column has the keyboard. Page Up and Page Down are
        actions.
        """
        if imgui.is_any_item_active():
            return
        for key, steps in ((imgui.Key.left_arrow, -1), (imgui.Key.right_arrow, 1)):
            if imgui.shortcut(int(key)):
                self.advance(host, steps)

    def _body(self, host: Host, session: LectureSession, slides: Slides, height: float) -> None:
        """Draw the text and the exercise. height: the room for the longest text of the step."""
        step = session.step
        blocks, width = self._in_language(host, step), imgui.get_content_region_avail().x
        old, alpha = in_language(step.before, host.state.options.language), self._alpha(host)
        self._fit(session, slides, host.state.options.language, ImVec2(width, height))
        if blocks:
            slides.text(blocks, width, before=old, alpha=alpha)
        if self._seek:
            imgui.set_scroll_here_y(1.0)
            self._seek = False
        if step.exercise is None:
            return
        if blocks:
            imgui.dummy(ImVec2(0, 0.5 * imgui.get_font_size()))
        answers = session.answers
        before = replace(answers, texts=dict(answers.texts))
        task, said = step.exercise, None
        if isinstance(task, HideExercise):
            assert self.hidden_watch is not None
            said = self.hidden_watch.judgement(host, task)
        shown = exercise(task, answers, slides, host.fonts, said)
        if isinstance(task, ChoiceExercise) and answers.chosen not in (None, before.chosen):
            fields = task.options[answers.chosen].camera
            if fields is not None:
                host.move(host.state.with_view(changed_view(step.view, fields)), CHOSEN_S)
        if shown and isinstance(task, HideExercise):
            try:
                host.change(replace(host.state, scene=task.solved(host.state.scene)))
            except LucidaError as error:  # it was deleted
                host.files.message = str(error)
        self._answered = self._answered or answers != before
        if self.log is not None and answers.verdict != before.verdict:
            self.log.exercise(session.lecture, step, answers)
        if self.log is not None and said is not None:
            self.log.hidden(session.lecture, step, said, answers.solved)

    def _fit(self, session: LectureSession, slides: Slides, language: str, room: ImVec2) -> None:
        """Make the text as large as all builds of the step allow; an exercise needs its room."""
        builds = [one for one in session.lecture.builds if one.number == session.number]
        fitted = *builds, room, theme.used(), slides.notation, language
        if fitted == self._fitted:
            return
        self._fitted = fitted
        texts = [in_language(one.blocks, language) for one in builds]
        is_asked = any(one.exercise is not None for one in builds)
        slides.fit(texts, room.x, 0.0 if is_asked else room.y)

    def _alpha(self, host: Host) -> float:
        """Return the opacity of the text that was just added."""
        if self._added_s is None:
            return 1.0
        alpha = (time.monotonic() - self._added_s) / FADE_S
        if alpha >= 1 or not host.moves or host.state.preferences.reduced_motion:
            self._added_s = None
            return 1.0
        host.animate()
        return alpha

    def unseen(self, host: Host) -> None:
        self._drawn_answer.hide(view_of(self._views, OutsideView))

    def _in_language(self, host: Host, step: Step) -> tuple[Block, ...]:
        """Draw the choice of languages if the step's programs have several. Return its text
        in one.
        """
        chosen = host.state.options.language
        offered = languages(step.blocks)
        for number, (name, title) in enumerate(LANGUAGES.items()):
            if name not in offered:
                continue
            if number:
                imgui.same_line(0, imgui.get_font_size())
            if radio_button(f"{title}##language", name == chosen):
                host.apply(host.state.with_options(language=name))
        return in_language(step.blocks, host.state.options.language)

    def _controls(self, host: Host, session: LectureSession) -> None:
        is_shown = not host.state.preferences.presentation or self.shows_controls
        imgui.push_style_var(imgui.StyleVar_.alpha, float(is_shown))
        asked = foot(session, self._typed)
        imgui.pop_style_var()
        if asked == END:
            self.leave(host)
        elif asked == RESTORE:
            self.restore(host)
        elif asked in (BACK, NEXT):
            self.advance(host, 1 if asked == NEXT else -1)
        elif isinstance(asked, int):
            self.go(host, asked)
