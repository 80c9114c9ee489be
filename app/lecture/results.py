"""The answers of a class, read from files and counted in one table by step.

The files are those of `lucida lecture --answers`. They may hold anything: a line that cannot be
read is skipped and reported, and all text is escaped.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from pathlib import Path

import msgspec

from lucida.app.web.lecture.text import plain, written
from lucida.renderer.files.reading import read_file
from lucida.renderer.system.errors import LucidaError, counted, shortened

from .answer_log import KeptAnswer

LARGEST = 256 << 20  # bytes of a file
LONGEST = 400  # characters of a text from a file
MOST_LINES = 20  # reported for one file, which may be of another kind
HEAD = """\
<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>What the class answered</title>
<style>
:root { color-scheme: light dark; }
body { margin: 0 auto; max-width: 64rem; padding: 1rem; font: 1rem/1.5 system-ui, sans-serif; }
table { border-collapse: collapse; width: 100%; } ul { margin: 0; padding-left: 1.2rem; }
li p { display: inline; margin-right: .3rem; } li p:first-of-type, .bold { font-weight: 600; }
th, td { border-bottom: 1px solid gray; padding: .4rem .6rem; text-align: left;
  vertical-align: top; }
td.count { text-align: right; font-variant-numeric: tabular-nums; }
</style></head><body>
<h1>What the class answered</h1>
"""
COLUMNS = ("step", "correct at once", "correct later", "not correct yet", "mistakes")


def summary(answers: Sequence[KeptAnswer]) -> str:
    """Return the numbers of answers and students as text."""
    students = len(set(map(_student, answers)))
    return f"{counted((len(answers), 'answer'))} by {counted((students, 'student'))}"


def page(answers: Sequence[KeptAnswer], titles: Sequence[str]) -> str:
    """Return one self-contained HTML page: a row for each step, in the order of the titles.

    titles: of the lecture's steps.
    """
    numbers = {title: number for number, title in reversed(list(enumerate(titles, 1)))}
    by_step: dict[str, list[KeptAnswer]] = defaultdict(list)
    for answer in sorted(answers, key=lambda one: one.time):
        by_step[answer.step].append(answer)
    steps = sorted(by_step, key=lambda title: numbers.get(title, len(titles) + 1))
    head = "".join(f"<th>{name}</th>" for name in COLUMNS)
    rows = "".join(_row(title, by_step[title], numbers) for title in steps)
    return (
        f"{HEAD}<p>{summary(answers)}</p>\n<table><tr>{head}</tr>\n{rows}</table>\n</body></html>\n"
    )


def counts(answers: Sequence[KeptAnswer]) -> tuple[int, int, int]:
    """Return the numbers of students who answered a step correctly at once, later, or not yet.

    answers: those to one step, in the order of time.
    """
    first: dict[str, KeptAnswer] = {}
    for answer in answers:
        first.setdefault(_student(answer), answer)
    right = {_student(one) for one in answers if one.right and not one.after_solution}
    at_once = {who for who in right if first[who].right and not first[who].after_solution}
    return len(at_once), len(right - at_once), len(first.keys() - right)


def mistakes(answers: Sequence[KeptAnswer]) -> list[tuple[KeptAnswer, int]]:
    """Return one answer for each mistake, and the number of students who made it, most first."""
    known: dict[str, KeptAnswer] = {}
    students: dict[str, set[str]] = defaultdict(set)
    for answer in answers:
        if answer.mistake:
            known.setdefault(answer.mistake, answer)
            students[answer.mistake].add(_student(answer))
    found = [(answer, len(students[name])) for name, answer in known.items()]
    return sorted(found, key=lambda one: -one[1])


def _student(answer: KeptAnswer) -> str:
    """Return the student's typed name, or the session. It is never shown."""
    return answer.name or answer.sitting


def _row(title: str, answers: Sequence[KeptAnswer], numbers: dict[str, int]) -> str:
    cells = "".join(f'<td class="count">{count}</td>' for count in counts(answers))
    items = "".join(
        f"<li>{counted((students, 'student'))}: {_mistake(answer, numbers)}</li>"
        for answer, students in mistakes(answers)
    )
    return f"<tr><td>{_step(title, numbers)}</td>{cells}<td><ul>{items}</ul></td></tr>\n"


def _mistake(answer: KeptAnswer, numbers: dict[str, int]) -> str:
    texts = dict.fromkeys((answer.mistake, answer.reply))
    read = f"Explained by {_step(answer.read, numbers)}." if answer.read else ""
    return "".join(map(_lecture_text, filter(None, texts))) + read


def _step(title: str, numbers: dict[str, int]) -> str:
    number = f"step {numbers[title]}, " if title in numbers else ""
    return number + plain(shortened(title, LONGEST))


def _lecture_text(text: str) -> str:
    """Return a lecture's text as HTML, unchanged if it cannot be typeset."""
    text = shortened(text, LONGEST)
    try:
        return written(text)
    except LucidaError:
        return plain(text)


def read_answers(paths: Sequence[str | Path]) -> tuple[list[KeptAnswer], list[str]]:
    """Return all answers in the files, and a line for each part that could not be read."""
    answers: list[KeptAnswer] = []
    problems: list[str] = []
    for path in dict.fromkeys(map(Path, paths)):
        try:
            found, lines = _of_file(path, read_file(path, LARGEST))
        except LucidaError as error:
            found, lines = [], [str(error)]
        answers += found
        problems += lines[:MOST_LINES]
    return answers, problems


def _of_file(path: Path, data: bytes) -> tuple[list[KeptAnswer], list[str]]:
    answers, problems = [], []
    for number, line in enumerate(data.split(b"\n"), 1):
        if not line.strip():
            continue
        try:
            answers.append(msgspec.json.decode(line, type=KeptAnswer))
        except (msgspec.DecodeError, UnicodeDecodeError) as error:
            is_json = isinstance(error, msgspec.ValidationError)
            problem = f"is no answer: {error}" if is_json else "is no JSON"
            place = f"{path}:{number}"
            problems.append(str(LucidaError("", problem, "delete the line", place)))
    return answers, problems
