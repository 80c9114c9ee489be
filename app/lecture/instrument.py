"""The guided lecture, as the window takes it."""

from __future__ import annotations

from app.lecture.actions import LECTURE
from app.lecture.view import LectureView
from app.ui.instrument import Instrument

SYNONYMS = {
    "Next step": "slide",
    "Previous step": "slide previous",
    "Play again": "animation movement repeat",
    "Lecture": "slides lesson tutorial course",
}

INSTRUMENT = Instrument(lambda views: [LectureView(views)], LECTURE, synonyms=SYNONYMS)
