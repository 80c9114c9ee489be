"""A wrong answer to an exercise, drawn in the outside view next to the correct one."""

from __future__ import annotations

from collections.abc import Hashable

from lucida.app.instruments.outside.diagram import Item
from lucida.app.instruments.outside.extent import end_parameter
from lucida.app.instruments.outside.view import OutsideView
from lucida.app.ui.host import Host
from lucida.renderer.system.memo import Memo

from .ghosts import ghosts
from .session import LectureSession

SOURCE = "Lecture"  # of the drawing, in the outside view


class DrawnAnswer:
    """The drawing of the present answer; a new one opens the outside view."""

    def __init__(self) -> None:
        self._ghosts = Memo(ghosts)
        self._drawn: Hashable = None

    def show(self, host: Host, outside: OutsideView, session: LectureSession) -> None:
        """Show the session's answer if it is wrong. Call once a frame."""
        answers = session.answers
        items: tuple[Item, ...] = ()
        if answers.verdict is not None and not answers.verdict.right:
            step, texts = session.step, tuple(answers.texts.items())
            end = end_parameter(step.view.camera, host.focus.framed)
            items = self._ghosts(step.exercise, texts, step.view.camera, end)
        asked = (session.place, items) if items else None
        if items and asked != self._drawn:
            host.show(outside.name)
        self._drawn = asked
        outside.show(SOURCE, items)

    def hide(self, outside: OutsideView) -> None:
        """Remove the drawing."""
        outside.show(SOURCE)
