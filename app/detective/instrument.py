"""The detective, as an instrument of the window."""

from __future__ import annotations

from app.detective.actions import QUESTIONS
from app.detective.view import DetectiveView
from app.host.instrument import Instrument

SYNONYMS = {
    "Detective": "matrix convention pose extrinsics opencv opengl blender transposed inverse",
    "What is this matrix?": "detective clipboard paste pose convention extrinsics",
    "Practice matrix": "detective quiz example convention",
}

INSTRUMENT = Instrument(lambda views: [DetectiveView()], QUESTIONS, synonyms=SYNONYMS)
