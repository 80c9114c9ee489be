"""The loop stepper's actions.

Its keys work while it has the keyboard, and are read by its panel. They are listed here for
display, and so that no key has two meanings.
"""

from __future__ import annotations

from app.host.action import Action
from app.stepper.controls import Wish
from app.stepper.view import STEPPER, StepperView

KEYS: tuple[tuple[Wish, str, str], ...] = (
    ("play", "play and pause", "Space"),
    ("step", "one line on", "Right"),
    ("back", "one line back", "Left"),
    ("pixel", "to the next pixel's turn", "Down"),
    ("object", "to the next object's turn", "Shift+Down"),
    ("first", "to the beginning", "Home"),
    ("last", "to the end", "End"),
)


def _stepping(wish: Wish, name: str, keys: str) -> Action:
    return Action(
        "Lecture/Loop stepper",
        f"Stepper: {name}",
        lambda window: window.view(StepperView).ask(wish),
        keys,
        can=lambda window: STEPPER in window.shell.stage.rects,
        separated=wish == "play",
    )


STEPPING = tuple(_stepping(wish, name, keys) for wish, name, keys in KEYS)
