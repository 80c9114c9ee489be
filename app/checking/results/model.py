"""The answers of a class, counted by mistake and by step. Pure."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from datetime import datetime

from lucida.renderer.system.errors import one_line, shortened

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
