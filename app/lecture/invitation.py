"""The ways into a lecture: beginning one, and going on where the sitting before ended."""

from __future__ import annotations

from pathlib import Path

from imgui_bundle import imgui

from app.lecture.reading import BUILTINS
from app.ui import theme
from app.ui.messages import wrapped
from app.ui.view import Host


def invitation(host: Host) -> Path | None:
    """Draw what a lecture is, and how to begin one. Return the built-in one to begin."""
    wrapped("A guided lecture: steps of text, each with its own scene, camera and views.")
    asked = None
    for title, path in BUILTINS.items():
        if imgui.button(f'Begin "{title}"'):
            asked = path
    if imgui.button("Open lecture..."):
        host.files.open_lecture_dialog()
    wrapped("A lecture's file can be dropped on the window, too.", theme.DIM)
    return asked


def continuation(number: int) -> bool:
    """Draw the offer to go on at a step, from 0. Return True if it was taken."""
    asked = bool(imgui.button(f"Continue at step {number + 1} (End)##continue"))
    imgui.set_item_tooltip("Where the lecture was left, with the answers given there")
    return asked
