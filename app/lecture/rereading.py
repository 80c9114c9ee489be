"""A lecture's file read again while it is given: what came of it, and for whom.

Nothing here waits for a window: it runs in a thread. Until it has ended, another lecture may have
been begun.
"""

from __future__ import annotations

from dataclasses import dataclass

from app.lecture.model import Lecture
from app.lecture.reading import load_lecture
from app.lecture.session import LectureSession
from app.lecture.typesetting import first_mistake
from renderer.errors import describe
from renderer.scene.models import read_by
from renderer.scene.subprocess_reader import ModelReader


@dataclass(frozen=True, eq=False)
class LectureReread:
    """The result of reading a session's file again.

    lecture: None if that failed. mistake: the reason, or the first of its formulas that cannot be
    typeset, which is visible there, too; else empty.
    """

    session: LectureSession
    lecture: Lecture | None
    mistake: str = ""


def reread(session: LectureSession) -> LectureReread:
    """A lecture's file read again."""
    agreed = frozenset(session.lecture.outside)
    try:
        # A large model of its scenes' is read in a process of its own.
        with session.watch.reading(), read_by(ModelReader().read):
            lecture = load_lecture(session.path, agreed)
    except Exception as error:  # told below the text, which goes on
        return LectureReread(session, None, describe(error))
    mistake = first_mistake(lecture.formulas)
    return LectureReread(session, lecture, "" if mistake is None else str(mistake))
