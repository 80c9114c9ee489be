"""A lecture in a session file: the file, the step, and the answers so far."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple


class Judgement(NamedTuple):
    """The verdict on an answer, and the reply.

    field: the part that it is about, or empty.
    mistake: the name of the mistake, or the reply itself; "" if it is not recognised.
    read: the step that explains it; "" for the step before the exercise.
    is_answer: False for a text that could not be read.
    """

    right: bool
    text: str
    field: str = ""
    mistake: str = ""
    read: str = ""
    is_answer: bool = True


@dataclass
class Answers:
    """The answers to a step's exercise.

    texts: the typed texts, by field.
    chosen: the selected option.
    verdict: the verdict on the last answer; None before the first.
    solved: True if the solution is shown.
    """

    texts: dict[str, str] = field(default_factory=dict)
    chosen: int | None = None
    verdict: Judgement | None = None
    solved: bool = False


@dataclass(frozen=True)
class KeptLecture:
    """An open lecture. Paths are as paths.stored() writes them.

    file: an absolute path; "" for the built-in lecture.
    fingerprint: a hash of the file's content.
    number, title: the step's number, from 0, and its title.
    in_step: True if the session's scene is the step's own.
    answers: the answers by the steps' titles.
    outside: files outside its folder that the user has agreed to.
    build: the number of the step's build, from 0.
    """

    file: str = ""
    fingerprint: str = ""
    number: int = 0
    title: str = ""
    in_step: bool = False
    answers: dict[str, Answers] = field(default_factory=dict)
    outside: tuple[str, ...] = ()
    build: int = 0
