"""The invitation to a lecture, when none is open."""

from __future__ import annotations

from pathlib import Path

from imgui_bundle import imgui

from lucida.app.ui import theme
from lucida.app.ui.host import Host
from lucida.app.ui.messages import wrapped

from .reading import BUILTINS


def invitation(host: Host) -> Path | None:
    """Draw a description of lectures and the built-in ones. Return the one to begin."""
    wrapped("A guided lecture: steps of text, each with its own scene, camera and views.")
    asked = None
    for title, path in BUILTINS.items():
        imgui.push_id(title)
        if imgui.button("Begin"):
            asked = path
        imgui.same_line()
        wrapped(title)
        imgui.pop_id()
    if imgui.button("Open lecture..."):
        host.files.open_dialog()
    wrapped("A lecture's file can be dropped on the window, too.", theme.DIM)
    return asked
