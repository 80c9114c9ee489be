"""The built-in lectures, read once: the first one, and the steps of both as one lecture."""

from __future__ import annotations

import functools
from dataclasses import replace

from lucida.app.lecture.model import Lecture
from lucida.app.lecture.reading import BUILTIN, BUILTINS, load_lecture

read_once = functools.cache(load_lecture)


def first_lecture() -> Lecture:
    return read_once(BUILTIN)


@functools.cache
def both_lectures() -> Lecture:
    """Return the first built-in lecture with the second one's steps behind its own."""
    first, second = (read_once(path) for path in BUILTINS.values())
    later = (replace(one, number=one.number + len(first.steps)) for one in second.builds)
    return replace(
        first, builds=(*first.builds, *later), formulas=(*first.formulas, *second.formulas)
    )
