"""The mistakes' actions: what is shown, and the quiz's keys.

The panel reads the answers' keys, 1 to 4 and A to D, while the view has the keyboard.
"""

from __future__ import annotations

from app.instruments.mistakes import question
from app.instruments.mistakes.panel import Wish
from app.instruments.mistakes.view import MISTAKES, MistakesView
from app.state.options.mistakes import Mode
from app.ui.action import Action
from app.ui.host import Host

MENU = "Lecture/Mistakes"
MODES: dict[Mode, str] = {
    "laboratory": "Mistakes: a laboratory of wrong lines",
    "which-line": "Mistakes: which line made this picture?",
    "which-picture": "Mistakes: what will this line do?",
}


def _show(window: Host, mode: Mode) -> None:
    window.show(MISTAKES)
    options = question.switched_to(window.state.options.mistakes, mode)
    window.change(window.state.with_options(options))


def _is_quiz_shown(window: Host) -> bool:
    is_quiz = window.state.options.mistakes.mode != "laboratory"
    return is_quiz and window.is_visible(MISTAKES)


def _mode(mode: Mode, name: str) -> Action:
    return Action(
        MENU,
        name,
        lambda window: _show(window, mode),
        is_on=lambda state: state.options.mistakes.mode == mode,
    )


def _asking(name: str, wish: Wish, keys: str, separated: bool) -> Action:
    return Action(
        MENU,
        f"Mistakes: {name}",
        lambda window: window.view(MistakesView).ask(wish),
        keys,
        can=_is_quiz_shown,
        separated=separated,
    )


WRONG_LINES = (
    *(_mode(mode, name) for mode, name in MODES.items()),
    _asking("reveal the answer", "reveal", "U", True),
    _asking("next question", "next", "Shift+U", False),
)
