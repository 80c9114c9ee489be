"""The guided lecture's view with its actions."""

from __future__ import annotations

from lucida.app.lecture.actions import LECTURE
from lucida.app.lecture.view import LectureView


class LectureInstrument(LectureView):
    actions = LECTURE
