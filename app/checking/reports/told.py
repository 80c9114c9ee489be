"""The part of a result that the task's feedback allows to report; shared by all reports."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from lucida.app.checking.calls import Failure
from lucida.app.checking.checked import Status, TaskResult, WrongCase
from lucida.app.checking.tasks import FEEDBACK, CheckTask
from lucida.app.ui.explaining.symbols import arguments
from lucida.renderer.system.errors import one_line, visible

if TYPE_CHECKING:
    from lucida.app.checking.mistakes.diagnosis import Diagnosis


VERDICTS = {"right": "correct"}  # a status in words, where it is not its own


@dataclass(frozen=True)
class Told:
    """The reported part of a result.

    verdict: None if it is withheld.
    diagnosis: sentences.
    wrong: the number of wrong cases, in words.
    first: the first wrong case.
    failure: the reason why the task could not be tried, with the student's own lines.
    output: the text that the student's code printed.
    mistakes: those of the diagnosis, as class_results reads them.
    """

    verdict: Status | None
    diagnosis: tuple[str, ...] = ()
    wrong: str = ""
    first: WrongCase | None = None
    function: str = ""
    failure: tuple[str, ...] = ()
    output: str = ""
    mistakes: tuple[dict[str, str], ...] = ()

    @property
    def lines(self) -> tuple[str, ...]:
        """All helpful lines, without the printed output."""
        found = [*self.failure, *self.diagnosis]
        if self.first is not None:
            found += [f"{self.wrong}; the first one:", *self.first_lines]
        return tuple(found)

    @property
    def first_lines(self) -> tuple[str, ...]:
        """The first wrong case."""
        assert self.first is not None
        called = f"{self.function}({self.first.arguments})"
        answers = f"correct: {self.first.right}", f"given: {self.first.given}"
        return (*[self.first.where] * bool(self.first.where), called, *answers)


def told(result: TaskResult) -> Told:
    """Return what may be reported.

    The reason for a failure, with the call that led to it, is always included: without it, nobody
    could correct the code.
    """
    feedback = FEEDBACK.index(result.task.feedback)
    output = visible(result.output.replace("\r\n", "\n")).rstrip()
    if result.status == "failed":
        assert result.failure is not None
        why = one_line(result.failure.text)
        return Told("failed", failure=(why, *failure_lines(result.failure)), output=output)
    if feedback == 0:
        return Told(None)
    if result.status == "right" or feedback == 1:
        return Told(result.status, output=output)
    diagnosis = result.diagnosis if feedback == 3 else None
    return Told(
        "wrong",
        diagnosis.sentences if diagnosis else (),
        f"{result.wrong} of {result.cases} cases {'is' if result.wrong == 1 else 'are'} wrong",
        _shown(result),
        result.task.function,
        output=output,
        mistakes=_mistakes(diagnosis) if diagnosis else (),
    )


def _mistakes(diagnosis: Diagnosis) -> tuple[dict[str, str], ...]:
    """Return the likeliest mistakes by name; without a name, the first sentence."""
    if not diagnosis.candidates:
        return tuple({"mistake": text, "reply": text} for text in diagnosis.sentences[:1])
    return tuple(
        {"mistake": mistake.name, "reply": mistake.hint, "read": mistake.part}
        for mistake in diagnosis.candidates[0]
    )


def _shown(result: TaskResult) -> WrongCase | None:
    first = result.first
    if first is None:
        return None
    return replace(first, arguments=arguments(first.arguments, result.task.notation))


@dataclass(frozen=True)
class Reported:
    """A task in a report. is_right: also if the verdict is withheld."""

    task: CheckTask
    say: Told
    points: float = 0.0
    is_right: bool = False


def reported(
    tried: Sequence[TaskResult], tasks: Sequence[CheckTask], problem: str
) -> list[Reported]:
    """Return all tasks for a report. Those without a result failed.

    tried: the results that exist.
    tasks: all required tasks.
    problem: the reason if nothing could be run at all.
    """
    names = {result.task.name for result in tried}
    untried = Told("failed", failure=(problem or "was not tried",))
    return [
        *(Reported(one.task, told(one), one.points, one.status == "right") for one in tried),
        *(Reported(task, untried) for task in tasks if task.name not in names),
    ]


def summary(tried: Sequence[TaskResult], tasks: Sequence[CheckTask]) -> str:
    """Return one line on all results; only their number if a verdict is withheld."""
    if any(told(result).verdict is None for result in tried):
        return f"{len(tried)} {'task was' if len(tried) == 1 else 'tasks were'} tried."
    right = sum(result.status == "right" for result in tried)
    points = sum(result.points for result in tried), sum(task.points for task in tasks)
    return f"{right} of {len(tasks)} tasks correct, {of_points(*points)}"


def of_points(points: float, most: float) -> str:
    return f"{points:g} of {most:g} {'point' if most == 1 else 'points'}"


def failure_lines(failure: Failure) -> list[str]:
    """Return the student's own lines, without the last one if the failure's text repeats it."""
    lines = [visible(line.rstrip()) for line in failure.traceback]
    if lines and lines[-1] in failure.text:
        del lines[-1]
    return lines if len(lines) > 1 else []
