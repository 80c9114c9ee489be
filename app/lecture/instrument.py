"""The guided lecture's view with its actions."""

from __future__ import annotations

from .actions import LECTURE
from .view import LectureView


class LectureInstrument(LectureView):
    actions = LECTURE
