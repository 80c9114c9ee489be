"""The actions of the view "Poses".

The list and the outside view read arrows, Home and End themselves while they have the keyboard, so
that no key has two meanings.
"""

from __future__ import annotations

from app.instruments.poses.panel import PoseWish
from app.instruments.poses.view import POSES, PosesView
from app.ui.action import Action
from app.ui.host import Host

MENU = "Camera/Poses"
WISHES: tuple[tuple[PoseWish, str], ...] = (
    ("next", "Poses: next"),
    ("previous", "Poses: previous"),
    ("first", "Poses: first"),
    ("last", "Poses: last"),
    ("frame", "Poses: frame the set"),
    ("lay", "Poses: lay the photographs over the images"),
    ("close", "Poses: close the set"),
)


def _has_set(window: Host) -> bool:
    return window.is_visible(POSES) and window.view(PosesView).poses is not None


def _action(wish: PoseWish, name: str) -> Action:
    def run(window: Host) -> None:
        window.view(PosesView).ask(wish)

    return Action(MENU, name, run, can=_has_set, separated=wish == "frame")


CHOOSING = tuple(_action(*entry) for entry in WISHES)
