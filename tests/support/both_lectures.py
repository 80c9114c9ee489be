"""The steps of both built-in lectures as one lecture."""

from __future__ import annotations

import functools
from dataclasses import replace

from lucida.app.lecture.model import Lecture
from lucida.app.lecture.reading import BUILTINS, load_lecture


@functools.cache
def both_lectures() -> Lecture:
    """Return the first built-in lecture with the second one's steps behind its own."""
    first, second = (load_lecture(path) for path in BUILTINS.values())
    later = (replace(one, number=one.number + len(first.steps)) for one in second.builds)
    return replace(
        first, builds=(*first.builds, *later), formulas=(*first.formulas, *second.formulas)
    )
