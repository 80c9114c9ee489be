"""The actions of the view "Poses".

Its keys hold while the list or the outside view has the keyboard, and are read there: here they are
only shown, so that no key has two meanings.
"""

from __future__ import annotations

from app.host.action import Action, Window
from app.poses.panel import PoseWish
from app.poses.view import POSES, PosesView

MENU = "Camera/Poses"
WISHES: tuple[tuple[PoseWish, str, str], ...] = (
    ("next", "Poses: next", "Down or Right"),
    ("previous", "Poses: previous", "Up or Left"),
    ("first", "Poses: first", "Home"),
    ("last", "Poses: last", "End"),
    ("frame", "Poses: frame the set", ""),
    ("lay", "Poses: lay the photographs over the images", ""),
    ("close", "Poses: close the set", ""),
)


def _has_set(window: Window) -> bool:
    return POSES in window.shell.stage.rects and window.view(PosesView).poses is not None


def _action(wish: PoseWish, name: str, keys: str) -> Action:
    def run(window: Window) -> None:
        window.view(PosesView).ask(wish)

    return Action(MENU, name, run, keys, can=_has_set, separated=wish == "frame")


CHOOSING = tuple(_action(*entry) for entry in WISHES)
