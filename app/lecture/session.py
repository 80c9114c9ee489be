"""An open lecture: its current step, its answers, and changes of its file.

This module also defines its entry in a session file, and rereads a changed lecture.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

from lucida.app.state.app_state import AppState
from lucida.app.state.kept_lecture import Answers, KeptLecture
from lucida.app.state.paths import restored, stored
from lucida.app.ui.watching import FilesWatch, fingerprint
from lucida.renderer.system.errors import describe
from lucida.renderer.system.file_dependencies import stamp

from .model import Lecture, Step
from .reading import BUILTIN, load_lecture
from .typesetting import first_mistake


class LectureSession:
    """An open lecture.

    path: its file.
    watch: of this file and the files that it names.
    error: the reason why a newer version cannot be read, for the user.
    left: the previous session, if it ended at another step, until the user continues.
    """

    def __init__(
        self,
        lecture: Lecture,
        path: Path,
        at: tuple[int, int] = (0, 0),
        left: KeptLecture | None = None,
    ) -> None:
        self.lecture, self.path = lecture, path
        self._at = lecture.place(*at)
        self.left = left
        if left is None or left.file != _file(path) or self.left_at(left) == at[0]:
            self.left = None
        self.error = ""
        self._answers: dict[str, Answers] = {}
        self.watch = FilesWatch({path.absolute(): stamp(path), **lecture.files})
        self._fingerprint = fingerprint(path)

    @classmethod
    def resumed(cls, kept: KeptLecture) -> LectureSession:
        """Return the lecture at its step, read again. Raises LucidaError.

        If the file has changed meanwhile, its step is the one with the same title, and replies to
        answers are dropped.
        """
        path = Path(restored(kept.file)) if kept.file else BUILTIN
        agreed = frozenset(Path(restored(file)) for file in kept.outside)
        session = cls(load_lecture(path, agreed), path)
        session.go_on(kept)
        return session

    def left_at(self, kept: KeptLecture) -> int:
        """Return the number of the step at which a session ended."""
        return self.lecture.nearest(kept.title, kept.number)

    def go_on(self, kept: KeptLecture) -> None:
        """Go to the step at which a session ended, with its answers."""
        self._at, self.left = self.lecture.place(self.left_at(kept), kept.build), None
        changed = self.differs_from(kept)
        for title, answers in kept.answers.items():
            verdict = None if changed else answers.verdict
            self._answers[title] = replace(answers, texts=dict(answers.texts), verdict=verdict)

    def differs_from(self, kept: KeptLecture) -> bool:
        """Return True if the file differs from the kept one."""
        return self._fingerprint != kept.fingerprint

    def kept(self, state: AppState) -> KeptLecture:
        """Return the entry for a session file. state: the window's."""
        answers = {
            title: replace(one, texts=dict(one.texts))
            for title, one in self._answers.items()
            if one != Answers()
        }
        return KeptLecture(
            _file(self.path),
            self._fingerprint,
            self.number,
            self.step.title,
            state.step == self.place and state.scene is self.step.scene,
            answers,
            tuple(stored(str(file)) for file in self.lecture.outside),
            self.step.build,
        )

    @property
    def step(self) -> Step:
        """The current step at its current build."""
        return self.lecture.builds[self._at]

    @property
    def number(self) -> int:
        """The number of the current step, from 0."""
        return self.step.number

    @property
    def place(self) -> tuple[str, int, int]:
        """The lecture, the step and the build, as in AppState."""
        return self.lecture.source, self.step.number, self.step.build

    @property
    def answers(self) -> Answers:
        """The answers to the current step."""
        return self._answers.setdefault(self.step.title, Answers())

    def go(self, number: int, build: int = 0) -> bool:
        """Go to a build of a step, or to the nearest one. Return True if it is another."""
        return self._to(self.lecture.place(number, build))

    def walk(self, builds: int) -> bool:
        """Go some builds forward, or back. Return True if the build changes."""
        return self._to(min(max(self._at + builds, 0), len(self.lecture.builds) - 1))

    def _to(self, place: int) -> bool:
        if place == self._at:
            return False
        if self.lecture.builds[place].number != self.number:
            self.left = None
        self._at = place
        return True

    def take(self, lecture: Lecture) -> None:
        """Continue in a newer version, at the same step. Replies to questions that have changed, or
        count pixels differently, are dropped; typed texts stay.
        """
        before, after = (
            {step.title: step.exercise for step in one.builds} for one in (self.lecture, lecture)
        )
        for title, answers in self._answers.items():
            if before.get(title) != after.get(title):
                answers.verdict = None
        number = lecture.nearest(self.step.title, self.number)
        self._at = lecture.place(number, self.step.build)
        self.lecture, self.error = lecture, ""
        self.watch.follow(lecture.files)
        self._fingerprint = fingerprint(self.path)


def _file(path: Path) -> str:
    """Return a lecture's file for a session file."""
    return "" if path == BUILTIN else stored(str(path.absolute()))


@dataclass(frozen=True, eq=False)
class LectureReread:
    """The result of reading a session's file again.

    lecture: None if that failed.
    mistake: the reason, or the first formula that cannot be typeset; "" if there is none.
    """

    session: LectureSession
    lecture: Lecture | None
    mistake: str = ""


def reread(session: LectureSession) -> LectureReread:
    """Read a lecture's file again, on a thread. Another lecture may have begun before this ends."""
    agreed = frozenset(session.lecture.outside)
    try:
        with session.watch.reading():
            lecture = load_lecture(session.path, agreed)
    except Exception as error:  # shown below the old text
        return LectureReread(session, None, describe(error))
    mistake = first_mistake(lecture.formulas)
    return LectureReread(session, lecture, "" if mistake is None else str(mistake))
