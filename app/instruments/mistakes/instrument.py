"""The mistakes' view with its actions."""

from __future__ import annotations

from app.instruments.mistakes.actions import WRONG_LINES
from app.instruments.mistakes.view import MistakesView


class Mistakes(MistakesView):
    actions = WRONG_LINES
    mouse = (("click, 1 to 4, A to D", "in the quiz of the mistakes: answer"),)
    synonyms = {
        "Mistakes: which line made this picture?": "quiz question",
        "Mistakes: what will this line do?": "quiz question",
        "Mistakes": "wrong lines errors quiz exercise what if students sign offset",
    }
