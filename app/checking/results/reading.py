"""Reading what was answered: files of `lucida lecture --answers` and of `lucida check --json`.

What cannot be read costs a line each, and the rest counts.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from datetime import UTC, datetime
from pathlib import Path

import msgspec

from lucida.app.checking.results.model import ClassAnswer, NamedMistake
from lucida.app.lecture.answer_log import KeptAnswer
from lucida.renderer.files.reading import first_bytes, read_file
from lucida.renderer.system.errors import LucidaError

SNIFFED_BYTES = 1 << 16
MOST_LINES = 20  # that are reported of a file, which may be something else
LARGEST = 256 << 20  # bytes of a file


class _Made(msgspec.Struct):
    mistake: str
    reply: str = ""
    read: str = ""


class _Extra(msgspec.Struct):
    mistakes: list[_Made] = msgspec.field(default_factory=list)


class _Test(msgspec.Struct):
    name: str
    status: str
    extra_data: _Extra = msgspec.field(default_factory=_Extra)


class _Check(msgspec.Struct):
    time: datetime | None = None


class _Results(msgspec.Struct):
    """The file of a check, as Gradescope reads it."""

    tests: list[_Test]
    extra_data: _Check = msgspec.field(default_factory=_Check)


def is_results(source: str) -> bool:
    """Return True for a file of answers, or of a check's results, by its name and contents."""
    if not source.lower().endswith((".jsonl", ".json")):
        return False
    try:
        text = first_bytes(Path(source), SNIFFED_BYTES).replace(b" ", b"")
    except (OSError, ValueError):
        return False
    return b'"lucida":"answer"' in text or b'"lucida":"check"' in text


def read_answers(paths: Sequence[str | Path]) -> tuple[list[ClassAnswer], list[str]]:
    """Return all answers in the files, and a line for each part that could not be read."""
    answers: list[ClassAnswer] = []
    problems: list[str] = []
    for path in dict.fromkeys(Path(path) for path in paths):
        try:
            data = read_file(path, LARGEST)
        except LucidaError as error:
            problems.append(str(error))
            continue
        found = _of_check(path, data)
        if found is None:
            found, lines = _of_lecture(path, data)
            problems += lines[:MOST_LINES]
        answers += found
    return answers, problems


def _of_check(path: Path, data: bytes) -> list[ClassAnswer] | None:
    """Return the tasks in a check's results; None if the file is not one."""
    try:
        results = msgspec.json.decode(data, type=_Results)
    except (msgspec.DecodeError, UnicodeDecodeError):
        return None
    time = _local(results.extra_data.time)
    return [
        ClassAnswer(
            str(path.absolute()),
            f"Your code: {test.name.partition(':')[0]}",
            test.status == "passed",
            time,
            tuple(NamedMistake(m.mistake, m.reply, m.read) for m in test.extra_data.mistakes),
        )
        for test in results.tests
    ]


def _of_lecture(path: Path, data: bytes) -> tuple[list[ClassAnswer], list[str]]:
    answers, problems = [], []
    for number, line in _lines(data):
        try:
            kept = msgspec.json.decode(line, type=KeptAnswer)
        except (msgspec.DecodeError, UnicodeDecodeError) as error:
            is_json = isinstance(error, msgspec.ValidationError)
            problem = f"is no answer: {error}" if is_json else "is no JSON"
            place = f"{path}:{number}"
            problems.append(str(LucidaError("", problem, "delete the line", place)))
            continue
        mistakes = (NamedMistake(kept.mistake, kept.reply, kept.read),) if kept.mistake else ()
        answers.append(
            ClassAnswer(
                kept.name or kept.sitting,
                kept.step,
                kept.right,
                _local(kept.time),
                mistakes,
                kept.after_solution,
            )
        )
    return answers, problems


def _lines(data: bytes) -> Iterator[tuple[int, bytes]]:
    for number, line in enumerate(data.split(b"\n"), start=1):
        if line.strip():
            yield number, line


def _local(time: datetime | None) -> datetime | None:
    """Return a time as clocks here show it, without a zone."""
    if time is None:
        return None
    try:
        return (time if time.tzinfo else time.replace(tzinfo=UTC)).astimezone().replace(tzinfo=None)
    except (OverflowError, ValueError, OSError):  # in the year 1, for instance
        return None
