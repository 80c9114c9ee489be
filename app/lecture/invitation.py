"""The way into a lecture."""

from __future__ import annotations

from imgui_bundle import imgui

from app.host.view import Host
from app.widgets import theme
from app.widgets.messages import wrapped


def invitation(host: Host) -> bool:
    """Draw what a lecture is, and how to begin one. Return True to begin the built-in one."""
    wrapped("A guided lecture: steps of text, each with its own scene, camera and views.")
    asked = bool(imgui.button('Begin "Images, rays and cameras"'))
    if imgui.button("Open lecture..."):
        host.files.open_lecture_dialog()
    wrapped("A lecture's file can be dropped on the window, too.", theme.DIM)
    return asked
