"""The answers of a class, counted by mistake, by step and over time. Pure."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from datetime import datetime, timedelta

from lucida.renderer.system.errors import one_line, shortened

MOST_BINS = 24
TALKED_ABOUT = 3
LONGEST = 400  # characters of a text from a file
FOLLOWED = 6  # mistakes that are followed over time
MINUTE, DAY = timedelta(minutes=1), timedelta(days=1)
WIDTHS = (MINUTE, 5 * MINUTE, 15 * MINUTE, 60 * MINUTE, DAY, 7 * DAY, 28 * DAY, 364 * DAY)


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
class Timeline:
    """Counts in bins of equal width.

    first, last: the times of the first and the last answer.
    right, wrong: answers.
    mistakes: the most frequent ones, and how often each was made.
    """

    first: datetime
    last: datetime
    starts: tuple[datetime, ...]
    width: timedelta
    right: tuple[int, ...]
    wrong: tuple[int, ...]
    mistakes: tuple[tuple[NamedMistake, tuple[int, ...]], ...]

    @property
    def labels(self) -> tuple[str, ...]:
        form = "{0:%H:%M}" if self.width < DAY else "{0.day} {0:%b}"
        if self.width < DAY and self.starts[0].date() != self.starts[-1].date():
            form = "{0.day} {0:%b} {0:%H:%M}"
        return tuple(form.format(start) for start in self.starts)


@dataclass(frozen=True)
class ClassResults:
    """The results of a class.

    steps: in the lecture's order, then the others.
    mistakes: the most frequent first.
    numbers: of the lecture's steps, from 1, by title.
    problems: a line for each part of the files that could not be read.
    """

    students: int
    answers: int
    steps: tuple[StepCount, ...]
    mistakes: tuple[MistakeCount, ...]
    timeline: Timeline | None
    numbers: dict[str, int]
    problems: tuple[str, ...] = ()

    @property
    def to_talk_about(self) -> tuple[MistakeCount, ...]:
        return self.mistakes[:TALKED_ABOUT]

    @property
    def summary(self) -> str:
        """The numbers of answers counted, in words."""
        words = f"{counted(self.answers, 'answer')} by {counted(self.students, 'student')}"
        if self.timeline is None:
            return words
        first, last = self.timeline.first, self.timeline.last
        day = "{0.day} {0:%B %Y}".format
        days = day(first) if first.date() == last.date() else f"{day(first)} to {day(last)}"
        return f"{words}, {days}"

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
    mistakes = _mistakes(answers)
    return ClassResults(
        len({answer.student for answer in answers}),
        len(answers),
        tuple(_step(title, by_step[title]) for title in order),
        mistakes,
        _timeline(answers, [count.mistake for count in mistakes[:FOLLOWED]]),
        numbers,
        tuple(problems),
    )


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


def _timeline(answers: Sequence[ClassAnswer], followed: Sequence[NamedMistake]) -> Timeline | None:
    timed = [(answer.time, answer) for answer in answers if answer.time is not None]
    if not timed:
        return None
    first, last = timed[0][0], timed[-1][0]
    midnight = first.replace(hour=0, minute=0, second=0, microsecond=0)

    def begin(width: timedelta) -> datetime:
        return midnight + (first - midnight) // width * width

    width = next((w for w in WIDTHS if (last - begin(w)) // w < MOST_BINS), WIDTHS[-1])
    count = (last - begin(width)) // width + 1
    right, wrong = [0] * count, [0] * count
    rows = {mistake.name: [0] * count for mistake in followed}
    for time, answer in timed:
        place = (time - begin(width)) // width
        (right if answer.right else wrong)[place] += 1
        for mistake in answer.mistakes:
            if mistake.name in rows:
                rows[mistake.name][place] += 1
    return Timeline(
        first,
        last,
        tuple(begin(width) + place * width for place in range(count)),
        width,
        tuple(right),
        tuple(wrong),
        tuple((mistake, tuple(rows[mistake.name])) for mistake in followed),
    )
