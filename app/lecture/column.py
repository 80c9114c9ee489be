"""The text and the exercise of a step: in a column, or over a picture that fills the window."""

from __future__ import annotations

import time
from dataclasses import replace

from imgui_bundle import ImVec2, imgui

from lucida.app.checking.mistakes.diagnosis import READ
from lucida.app.instruments.outside.growing import stage_at
from lucida.app.state.kept_lecture import Answers
from lucida.app.ui import layout, theme
from lucida.app.ui.host import Host
from lucida.app.ui.lettering import lettering
from lucida.app.ui.messages import wrapped
from lucida.renderer.system.errors import LucidaError

from .answer_log import AnswerLog
from .answer_note import note
from .exercise import exercise
from .exercises import ChoiceExercise
from .foot import foot_height
from .hiding import HideExercise
from .inheriting import changed_view
from .model import Exercise, Step
from .session import LectureSession
from .slide import TITLE, Slides
from .watching_hidden import HiddenWatch

CHOSEN_S = 1.0  # of the movement to the camera of the selected answer
FADE_S = 0.5  # of a text that is added
MOST_OVER = 0.15  # of the window's height, for a text over a picture


class Column:
    """The column's texts and exercises.

    log: keeps the answers, if the user asked for it.
    answered: an answer was given, or a build was reached, since this was last set to False.
    """

    def __init__(self, host: Host, log: AnswerLog | None) -> None:
        self.log, self.answered = log, False
        self.hidden_watch = HiddenWatch(host.animate)
        self._slides = Slides(host.fonts)
        self._to_top = False  # a new step shows the beginning of its text
        self._seek = False  # the text is scrolled to what was just added
        self._added_s: float | None = None  # when a text was added, while it fades in
        self._fitted: tuple[object, ...] = ()  # the key of the text's size

    @property
    def busy(self) -> bool:
        """True while a text fades in, or the reply to an exercise is not yet known."""
        return self.hidden_watch.busy or self._added_s is not None

    def begin_step(self) -> None:
        """Show the text from its beginning."""
        self._to_top = True

    def begin_build(self, fades: bool) -> None:
        """Show the end of the text. fades: it has grown."""
        self.answered = self._seek = True
        self._added_s = time.monotonic() if fades else None

    def draw(self, host: Host, session: LectureSession) -> str:
        """Draw the text. The user can scroll it if it is longer than the column. Return the title
        of the step to read again, if its link was clicked, or "".
        """
        title = ""
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
            title = self._body(host, session, imgui.get_content_region_avail().y)
        imgui.end_child()
        return title

    def draw_over(self, host: Host, session: LectureSession) -> str:
        """Draw the text over a picture. The result is that of draw()."""
        title = self._body(host, session, MOST_OVER * layout.window_px()[1])
        if session.error:
            wrapped(session.error, theme.ERROR)
        return title

    def _body(self, host: Host, session: LectureSession, height: float) -> str:
        """Draw the text and the exercise. height: the space for the longest text of the step."""
        step, options = session.step, host.state.options
        blocks, width = step.blocks, imgui.get_content_region_avail().x
        camera = host.renderers.camera(host.state)
        self._slides.lit = stage_at(options.outside.formula, camera)
        self._fit(session, ImVec2(width, height))
        alpha = self._alpha(host)  # also without a text, so that the fading ends
        if blocks:
            self._slides.text(blocks, width, before=step.before, alpha=alpha)
        if self._seek:
            imgui.set_scroll_here_y(1.0)
            self._seek = False
        if step.exercise is None:
            return ""
        if blocks:
            imgui.dummy(ImVec2(0, 0.5 * imgui.get_font_size()))
        return self._exercise(host, session, step.exercise)

    def _exercise(self, host: Host, session: LectureSession, task: Exercise) -> str:
        answers, said = session.answers, None
        before = replace(answers, texts=dict(answers.texts))
        if isinstance(task, HideExercise):
            said = self.hidden_watch.judgement(host, task)
        if exercise(task, answers, self._slides, host.fonts, said):
            _solve(host, task)
        if answers.chosen != before.chosen:
            _show_chosen(host, session.step, answers)
        self.answered = self.answered or answers != before
        if self.log is not None and answers.verdict != before.verdict:
            self.log.exercise(session.lecture, session.step, answers)
        if self.log is not None and said is not None:
            self.log.hidden(session.lecture, session.step, said, answers.solved)
        return _link(session)

    def _fit(self, session: LectureSession, room: ImVec2) -> None:
        """Make the text as large as all builds of the step, and their exercise, allow."""
        builds = [one for one in session.lecture.builds if one.number == session.number]
        fitted = *builds, room, theme.used()
        if fitted == self._fitted:
            return
        self._fitted = fitted
        texts = [one.blocks for one in builds]
        is_asked = any(one.exercise is not None for one in builds)
        self._slides.fit(texts, room.x, 0.0 if is_asked else room.y)

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


def _link(session: LectureSession) -> str:
    """Draw a link to the step that explains a wrong answer. Return its title if it is clicked."""
    lecture, verdict = session.lecture, session.answers.verdict
    if verdict is None or verdict.right or not verdict.is_answer:
        return ""
    title = verdict.read or lecture.explaining(session.step)
    if lecture.number_of(title) in (None, session.number):
        return ""
    return title if imgui.text_link(f"{READ}{title}") else ""


def _solve(host: Host, task: Exercise) -> None:
    """Put the object of a hiding exercise where it hides the other one."""
    assert isinstance(task, HideExercise)
    try:
        host.change(replace(host.state, scene=task.solved(host.state.scene)))
    except LucidaError as error:  # it was deleted
        host.files.message = str(error)


def _show_chosen(host: Host, step: Step, answers: Answers) -> None:
    """Move the camera to that of the selected answer."""
    assert isinstance(step.exercise, ChoiceExercise) and answers.chosen is not None
    changes = step.exercise.options[answers.chosen].camera
    if changes is not None:
        host.move(host.state.with_view(changed_view(step.view, changes)), CHOSEN_S)
