"""Where in a lecture's file its formulas stand, for whoever has to say which one is wrong.

Owns which fields of a step are texts. Knows nothing of how formulas are set.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from typing import Any

from app.teach.lecture import text as texts
from app.teach.lecture.model import Written
from app.teach.lecture.places import Places


def formulas_written(
    steps: Iterable[dict[str, Any]], places: Places, source: str
) -> tuple[Written, ...]:
    """All formulas of a lecture. steps: its tables, as read and found to be legal. source: the
    file's name."""
    found = []
    for number, step in enumerate(steps):
        for name, text in _texts_of(step):
            field = f"steps[{number}].{name}"
            first = places.line(field)
            at = 0
            for latex in texts.formulas(texts.parse(text)):
                # A formula in a paragraph, or in a question, may go on in the next line.
                pattern = r"\s+(?:>\s*)?".join(map(re.escape, latex.split()))
                match = re.compile(pattern).search(text, at)
                at = match.start() if match else at
                found.append(Written(latex, field, source, first + text.count("\n", 0, at)))
                at = match.end() if match else at
    return tuple(found)


def _texts_of(step: dict[str, Any]) -> Iterator[tuple[str, str]]:
    """The texts of a step, with their fields below it."""
    if "text" in step:
        yield "text", step["text"]
    exercise = step.get("exercise")
    if exercise is None:
        return
    yield "exercise.question", exercise["question"]
    for number, option in enumerate(exercise.get("options", ())):
        yield f"exercise.options[{number}].text", option["text"]
        yield f"exercise.options[{number}].feedback", option["feedback"]
    for number, answer in enumerate(exercise.get("answers", ())):
        for place, wrong in enumerate(answer.get("wrong", ())):
            field = f"exercise.answers[{number}].wrong[{place}].feedback"
            yield field, wrong["feedback"]
