"""The results of a class, as an instrument of the window."""

from __future__ import annotations

from app.host.instrument import Instrument
from app.host.view import view_of
from app.lecture.view import LectureView
from app.results.view import ResultsView

INSTRUMENT = Instrument(
    lambda views: [ResultsView(view_of(views, LectureView))],
    synonyms={"Results": "class students answers mistakes statistics survey"},
)
