"""A lecture that is being given: its current step, its answers, and whether its file has changed.

Also what a session file keeps of it. Pure; the caller has a thread to read the file again.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from app.lecture.exercises import Judgement
from app.lecture.model import Lecture, Step
from app.lecture.reading import BUILTIN, load_lecture
from app.state.app_state import AppState
from app.storage.kept_lecture import KeptAnswers, KeptLecture
from app.storage.paths import restored, stored
from app.storage.watching import FilesWatch, fingerprint
from renderer.scene.noting import stamp


@dataclass
class Answers:
    """The answers to a step's exercise.

    texts: typed, by field. chosen: the option. verdict: on the last answer; None before the first.
    solved: the solution is shown.
    """

    texts: dict[str, str] = field(default_factory=dict)
    chosen: int | None = None
    verdict: Judgement | None = None
    solved: bool = False


class LectureSession:
    """path: the lecture's file. watch: of that and the files that it names."""

    def __init__(self, lecture: Lecture, path: Path, number: int = 0) -> None:
        self.lecture, self.path, self.number = lecture, path, number
        self.error = ""
        self._answers: dict[str, Answers] = {}
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
        session.number = session.lecture.nearest(kept.title, kept.number)
        changed = session.differs_from(kept)
        for title, answers in kept.answers.items():
            said = None if changed or answers.verdict is None else Judgement(*answers.verdict)
            session._answers[title] = Answers(
                dict(answers.texts), answers.chosen, said, answers.solved
            )
        return session

    def differs_from(self, kept: KeptLecture) -> bool:
        """Return True if the file is not the one that was kept."""
        return self._fingerprint != kept.fingerprint

    def kept(self, state: AppState) -> KeptLecture:
        """Return what a session file keeps. state: the window's."""
        answers = {
            title: KeptAnswers(
                dict(one.texts),
                one.chosen,
                None
                if one.verdict is None
                else (one.verdict.right, one.verdict.text, one.verdict.field),
                one.solved,
            )
            for title, one in self._answers.items()
            if one != Answers()
        }
        return KeptLecture(
            "" if self.path == BUILTIN else stored(str(self.path.absolute())),
            self._fingerprint,
            self.number,
            self.step.title,
            state.step == self.place and state.scene is self.step.scene,
            answers,
            tuple(stored(str(file)) for file in self.lecture.outside),
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
        """Those to the present step."""
        return self._answers.setdefault(self.step.title, Answers())

    def go(self, number: int) -> bool:
        """Goes to a step, the first or the last for a number beyond; whether that is another."""
        number = min(max(number, 0), len(self.lecture.steps) - 1)
        moved, self.number = number != self.number, number
        return moved

    def take(self, lecture: Lecture) -> None:
        """Goes on in a newer version, at the same step."""
        self.number = self.lecture.followed(self.number, lecture)
        self.lecture, self.error = lecture, ""
        self.watch.follow(lecture.files)
        self._fingerprint = fingerprint(self.path)
