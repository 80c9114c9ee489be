"""The mistakes, as the window takes them."""

from __future__ import annotations

from app.instruments.mistakes.actions import WRONG_LINES
from app.instruments.mistakes.view import MistakesView
from app.instruments.outside.view import OutsideView
from app.ui.instrument import Instrument
from app.ui.view import view_of

MOUSE = (("click, 1 to 4, A to D", "in the quiz of the mistakes: answer"),)
SYNONYMS = {
    "Mistakes: which line made this picture?": "quiz question",
    "Mistakes: what will this line do?": "quiz question",
    "Mistakes": "wrong lines errors quiz exercise what if students sign offset",
}

INSTRUMENT = Instrument(
    lambda views: [MistakesView(view_of(views, OutsideView))], WRONG_LINES, MOUSE, synonyms=SYNONYMS
)
