"""The answers of a session, kept on disk if the user asks for it, one JSON object per line.

docs/lectures.md describes the format; results.py reads it.
"""

from __future__ import annotations

import os
import secrets
from datetime import UTC, datetime
from pathlib import Path

import msgspec

from lucida.app.state.kept_lecture import Answers, Judgement
from lucida.renderer.system.atomic import check_writable
from lucida.renderer.system.errors import LucidaError, describe

from .model import Lecture, Step

LONGEST_NAME = 60


class KeptAnswer(msgspec.Struct, tag_field="lucida", tag="answer", omit_defaults=True):
    """A line of the file.

    sitting: the same for all answers between a start of the window and its end.
    name: the one typed, or "".
    answer: as typed or selected.
    mistake, reply, read: as in Judgement; read is never empty for a wrong answer.
    after_solution: the solution had been shown.
    """

    time: datetime
    sitting: str
    step: str
    right: bool
    name: str = ""
    lecture: str = ""
    answer: str = ""
    mistake: str = ""
    reply: str = ""
    read: str = ""
    after_solution: bool = False


class AnswerLog:
    """A log that appends answers to a file.

    name: the name that the user has typed, or "".
    problem: the reason why the last answer could not be written, or "".
    """

    def __init__(self, path: Path) -> None:
        """Raise LucidaError if the file cannot be written, or does not hold answers."""
        target = check_writable(path)
        self.path, self.name, self.problem, self.count = path, "", "", 0
        self._sitting = secrets.token_hex(4)
        self._hidden: set[str] = set()
        with open(target, "ab+") as file:
            file.seek(0)
            first = file.readline(1 << 20)
            if first.strip():
                try:
                    msgspec.json.decode(first, type=KeptAnswer)
                except msgspec.DecodeError:
                    problem, remedy = "is a file of another kind", "give a new file"
                    raise LucidaError("--answers", problem, remedy, str(path)) from None
                file.seek(-1, os.SEEK_END)
                if file.read() != b"\n":  # a crash has cut the last line
                    file.write(b"\n")

    def exercise(self, lecture: Lecture, step: Step, answers: Answers) -> None:
        """Keep an answer to a step's exercise."""
        verdict = answers.verdict
        if verdict is None or not verdict.is_answer:
            return  # the texts could not be read
        given = "; ".join(f"{field} {text}" for field, text in answers.texts.items())
        if answers.chosen is not None:
            given = "ABCDEFGH"[answers.chosen]
        self.keep(lecture, step, verdict, given, answers.solved)

    def hidden(self, lecture: Lecture, step: Step, said: Judgement, solved: bool) -> None:
        """Keep the correct answer to a hiding exercise, but not the reply to each move."""
        if said.right and step.title not in self._hidden:
            self._hidden.add(step.title)
            self.keep(lecture, step, said, "", solved)

    def keep(
        self,
        lecture: Lecture,
        step: Step,
        verdict: Judgement,
        given: str,
        after_solution: bool = False,
    ) -> None:
        """Append an answer. A failure is kept in `problem`: the lecture continues."""
        line = KeptAnswer(
            datetime.now(UTC).replace(microsecond=0),
            self._sitting,
            step.title,
            verdict.right,
            self.name.strip(),
            lecture.title,
            given,
            verdict.mistake,
            "" if verdict.right else verdict.text,
            "" if verdict.right else verdict.read or lecture.explaining(step),
            after_solution,
        )
        try:
            # Write once, at the end of the file, because several windows may share it.
            file = os.open(self.path, os.O_WRONLY | os.O_APPEND | os.O_CREAT, 0o666)
            try:
                os.write(file, msgspec.json.encode(line) + b"\n")
            finally:
                os.close(file)
        except OSError as error:
            reason = error.strerror or describe(error)
            self.problem = f"{self.path.name} cannot be written: {reason}"
        else:
            self.problem, self.count = "", self.count + 1
