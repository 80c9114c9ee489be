"""A lecture in a session file: which one, where it stood, what had been answered.

Owns the structure. Knows nothing of lectures (lecture/session.py makes it and reads it).
"""

from __future__ import annotations

from dataclasses import dataclass, field


@dataclass(frozen=True)
class KeptAnswers:
    """The answers to one step.

    texts: typed, by field. chosen: the option. verdict: whether they were correct, the reply, and
    its field; None before the first. solved: the solution was shown.
    """

    texts: dict[str, str] = field(default_factory=dict)
    chosen: int | None = None
    verdict: tuple[bool, str, str] | None = None
    solved: bool = False


@dataclass(frozen=True)
class KeptLecture:
    """file: an absolute path; "" for the built-in lecture. fingerprint: of what was in it. number,
    title: the step, from 0. in_step: whether the session's scene is the step's own. answers: by
    the steps' titles. outside: files outside of its folder that the user has agreed to. Paths are
    as paths.stored() writes them."""

    file: str = ""
    fingerprint: str = ""
    number: int = 0
    title: str = ""
    in_step: bool = False
    answers: dict[str, KeptAnswers] = field(default_factory=dict)
    outside: tuple[str, ...] = ()
