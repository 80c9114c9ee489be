"""The detective's actions."""

from __future__ import annotations

from app.camera_panel.actions import clipboard_text
from app.detective.panel import MatrixWish
from app.detective.view import DETECTIVE, DetectiveView
from app.host.action import Action, Window

MENU = "Camera/Detective"


def _paste(window: Window) -> None:
    window.shell.stage.show(DETECTIVE)
    window.view(DetectiveView).paste(window, clipboard_text())


def _ask(window: Window, wish: MatrixWish) -> None:
    window.shell.stage.show(DETECTIVE)
    window.view(DetectiveView).ask(wish)


QUESTIONS = (
    Action(MENU, "What is this matrix?", _paste),
    Action(MENU, "Practice matrix", lambda window: _ask(window, "example")),
)
