"""An open lecture: its current step, its answers, and whether its file has changed.

Also what a session file keeps of it, and the reading of a changed file.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

from app.lecture.model import Lecture, Step
from app.lecture.reading import BUILTIN, load_lecture
from app.lecture.typesetting import first_mistake
from app.state.app_state import AppState
from app.storage.kept_lecture import Answers, KeptLecture
from app.storage.paths import restored, stored
from app.storage.watching import FilesWatch, fingerprint
from renderer.errors import describe
from renderer.scene.models import read_by
from renderer.scene.noting import stamp
from renderer.scene.subprocess_reader import ModelReader


class LectureSession:
    """An open lecture.

    path: its file.
    watch: of this file and the files that it names.
    error: the reason why a newer version cannot be read, for the user.
    left: the sitting before, if it ended at another step, until one walks on.
    """

    def __init__(
        self, lecture: Lecture, path: Path, number: int = 0, left: KeptLecture | None = None
    ) -> None:
        self.lecture, self.path, self.number = lecture, path, number
        self.left = left
        if left is None or left.file != _file(path) or self.left_at(left) == number:
            self.left = None
        self.error = ""
        self._answers: dict[str, Answers] = {}
        self._uncovered: dict[int, int] = {}  # by steps
        self.watch = FilesWatch({path.absolute(): stamp(path), **lecture.files})
        self._fingerprint = fingerprint(path)

    @classmethod
    def resumed(cls, kept: KeptLecture) -> LectureSession:
        """Return the lecture at its step, read again. Raises LucidaError.

        In a file that has changed meanwhile it is at the step of the same title; the replies to
        answers are dropped.
        """
        path = Path(restored(kept.file)) if kept.file else BUILTIN
        agreed = frozenset(Path(restored(file)) for file in kept.outside)
        session = cls(load_lecture(path, agreed), path)
        session.go_on(kept)
        return session

    def left_at(self, kept: KeptLecture) -> int:
        """Return the number of the step at which a sitting ended."""
        return self.lecture.nearest(kept.title, kept.number)

    def go_on(self, kept: KeptLecture) -> None:
        """Go to the step at which a sitting ended, with its answers."""
        self.number, self.left = self.left_at(kept), None
        self._uncovered[self.number] = kept.uncovered
        changed = self.differs_from(kept)
        for title, answers in kept.answers.items():
            verdict = None if changed else answers.verdict
            self._answers[title] = replace(answers, texts=dict(answers.texts), verdict=verdict)

    def differs_from(self, kept: KeptLecture) -> bool:
        """Return True if the file is not the one that was kept."""
        return self._fingerprint != kept.fingerprint

    def kept(self, state: AppState) -> KeptLecture:
        """Return what a session file keeps. state: the window's."""
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
            self.uncovered,
        )

    @property
    def step(self) -> Step:
        return self.lecture.steps[self.number]

    @property
    def place(self) -> tuple[str, int]:
        """The lecture and the step, as states name them."""
        return self.lecture.source, self.number

    @property
    def answers(self) -> Answers:
        """The answers to the current step."""
        return self._answers.setdefault(self.step.title, Answers())

    def go(self, number: int) -> bool:
        """Go to a step, the first or the last for a number beyond. Return True if it is another.

        An earlier step shows all that it covers.
        """
        number = min(max(number, 0), len(self.lecture.steps) - 1)
        if number < self.number:
            self._uncovered[number] = self.lecture.steps[number].stages
        moved, self.number = number != self.number, number
        if moved:
            self.left = None
        return moved

    @property
    def uncovered(self) -> int:
        """The part of the current step that is uncovered."""
        return min(self._uncovered.get(self.number, 0), self.step.stages)

    def uncover(self, stages: int) -> bool:
        """Uncover more of the step, or cover it again by a negative number. Return True if that
        changes it.
        """
        before = self.uncovered
        self._uncovered[self.number] = min(max(before + stages, 0), self.step.stages)
        return self.uncovered != before

    def take(self, lecture: Lecture) -> None:
        """Continue in a newer version, at the same step. Replies to questions that are no longer
        the same, or count pixels in another way, are dropped; what was typed stays.
        """
        uncovered = self.uncovered
        before, after = (
            {step.title: step.exercise for step in one.steps} for one in (self.lecture, lecture)
        )
        for title, answers in self._answers.items():
            if before.get(title) != after.get(title):
                answers.verdict = None
        self.number = lecture.nearest(self.step.title, self.number)
        self._uncovered = {self.number: uncovered}
        self.lecture, self.error = lecture, ""
        self.watch.follow(lecture.files)
        self._fingerprint = fingerprint(self.path)


def _file(path: Path) -> str:
    """Return a lecture's file as sessions keep it."""
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
        # A large model of its scenes is read in a separate process.
        with session.watch.reading(), read_by(ModelReader().read):
            lecture = load_lecture(session.path, agreed)
    except Exception as error:  # shown below the text, which stays
        return LectureReread(session, None, describe(error))
    mistake = first_mistake(lecture.formulas)
    return LectureReread(session, lecture, "" if mistake is None else str(mistake))
