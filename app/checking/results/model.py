"""The answers of a class: read from files, counted by mistake and by step.

The files are those of `lucida lecture --answers` and of `lucida check --json`. A part that cannot
be read costs a line, and the rest counts.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

import msgspec

from lucida.app.lecture.answer_log import KeptAnswer
from lucida.renderer.files.reading import first_bytes, read_file
from lucida.renderer.system.errors import LucidaError, one_line, shortened

TALKED_ABOUT = 3
LONGEST = 400  # characters of a text from a file


@dataclass(frozen=True)
class NamedMistake:
    """name: unique. reply: its explanation, as a lecture's text. read: the step to read again."""

    name: str
    reply: str = ""
    read: str = ""


@dataclass(frozen=True)
class ClassAnswer:
    """An answer.

    student: a typed name, a sitting or a file of results; never shown.
    step: its title; for code, the task.
    time: local time; None if unknown.
    helped: given after the solution was shown.
    """

    student: str
    step: str
    right: bool
    time: datetime | None = None
    mistakes: tuple[NamedMistake, ...] = ()
    helped: bool = False


@dataclass(frozen=True)
class MistakeCount:
    """A mistake.

    students: that made it.
    times: how often.
    stuck: of these students, those without a right answer in the same step afterwards.
    steps: in which it was made.
    """

    mistake: NamedMistake
    students: int
    times: int
    stuck: int
    steps: tuple[str, ...]


@dataclass(frozen=True)
class StepCount:
    """A step: the numbers of students who were correct at once, later, or not yet."""

    title: str
    at_once: int
    later: int
    not_yet: int
    mistakes: tuple[MistakeCount, ...]

    @property
    def students(self) -> int:
        return self.at_once + self.later + self.not_yet


@dataclass(frozen=True)
class ClassResults:
    """The results of a class.

    steps: in the lecture's order, then the others.
    mistakes: the most frequent first.
    days: the days of the first and the last answer, in words; empty if unknown.
    numbers: of the lecture's steps, from 1, by title.
    problems: a line for each part of the files that could not be read.
    """

    students: int
    answers: int
    steps: tuple[StepCount, ...]
    mistakes: tuple[MistakeCount, ...]
    days: str
    numbers: dict[str, int]
    problems: tuple[str, ...] = ()

    @property
    def to_talk_about(self) -> tuple[MistakeCount, ...]:
        return self.mistakes[:TALKED_ABOUT]

    @property
    def summary(self) -> str:
        """The numbers of answers counted, in words."""
        words = f"{counted(self.answers, 'answer')} by {counted(self.students, 'student')}"
        return f"{words}, {self.days}" if self.days else words

    def step_name(self, title: str) -> str:
        """Return a step's title with its number, if it is one of the lecture's."""
        number = self.numbers.get(title)
        return title if number is None else f"step {number}, {title}"

    def told(self, count: MistakeCount) -> str:
        """Return how many made a mistake and where, in words."""
        places = " and ".join(self.step_name(title) for title in count.steps)
        return f"{told(count, self.students)} ({places})"


def told(count: MistakeCount, students: int) -> str:
    """Return how many of the students made a mistake, in words."""
    words = f"{count.students} of {counted(students, 'student')}"
    if count.times > count.students:
        words += f", {count.times} times"
    return f"{words}; {count.stuck} not correct yet" if count.stuck else words


def shown(text: str) -> str:
    """Return a text from a file on one line, shortened."""
    return one_line(shortened(text, LONGEST))


def counted(number: int, noun: str) -> str:
    return f"{number:,} {noun}{'' if number == 1 else 's'}"


def class_results(
    answers: Sequence[ClassAnswer], titles: Sequence[str], problems: Iterable[str] = ()
) -> ClassResults:
    """Count the answers. titles: of the lecture's steps."""
    # Those without a time come last; sorting keeps the files' order otherwise.
    answers = sorted(answers, key=lambda one: (one.time is None, one.time or datetime.min))
    by_step: dict[str, list[ClassAnswer]] = defaultdict(list)
    for answer in answers:
        by_step[answer.step].append(answer)
    numbers = {title: n for n, title in reversed(list(enumerate(titles, start=1)))}
    order = sorted(by_step, key=lambda title: numbers.get(title, len(titles) + 1))
    return ClassResults(
        len({answer.student for answer in answers}),
        len(answers),
        tuple(_step(title, by_step[title]) for title in order),
        _mistakes(answers),
        _days([answer.time for answer in answers if answer.time is not None]),
        numbers,
        tuple(problems),
    )


def _days(times: Sequence[datetime]) -> str:
    """Return the first and the last day of times in their order, in words."""
    days = list(dict.fromkeys(f"{time.day} {time:%B %Y}" for time in times))
    return " to ".join(dict.fromkeys((days[0], days[-1]))) if days else ""


def _step(title: str, answers: Sequence[ClassAnswer]) -> StepCount:
    first: dict[str, ClassAnswer] = {}
    for answer in answers:
        first.setdefault(answer.student, answer)
    at_once = {name for name, answer in first.items() if answer.right and not answer.helped}
    right = {answer.student for answer in answers if answer.right and not answer.helped}
    later = len(right - at_once)
    not_yet = len(first) - len(at_once) - later
    return StepCount(title, len(at_once), later, not_yet, _mistakes(answers))


def _mistakes(answers: Sequence[ClassAnswer]) -> tuple[MistakeCount, ...]:
    """Count the mistakes in answers, which are in the order of time."""
    known: dict[str, NamedMistake] = {}
    students: dict[str, set[str]] = defaultdict(set)
    times: Counter[str] = Counter()
    stuck: dict[str, set[tuple[str, str]]] = defaultdict(set)
    steps: dict[str, dict[str, None]] = defaultdict(dict)
    for answer in answers:
        place = answer.student, answer.step
        if answer.right and not answer.helped:
            for places in stuck.values():
                places.discard(place)
        for mistake in answer.mistakes:
            known.setdefault(mistake.name, mistake)
            students[mistake.name].add(answer.student)
            times[mistake.name] += 1
            steps[mistake.name][answer.step] = None
            stuck[mistake.name].add(place)
    found = [
        MistakeCount(
            one,
            len(students[name]),
            times[name],
            len({who for who, _ in stuck[name]}),
            tuple(steps[name]),
        )
        for name, one in known.items()
    ]
    return tuple(sorted(found, key=lambda one: (-one.students, -one.stuck, -one.times)))


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
