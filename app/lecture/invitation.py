"""The lecture's column while no lecture is open."""

from __future__ import annotations

from imgui_bundle import imgui

from app.host.view import Host
from app.widgets import theme


def invitation(host: Host) -> bool:
    """Draw what a lecture is, and how to begin one. Return True to begin the built-in one."""
    imgui.push_text_wrap_pos(0.0)
    imgui.text("A guided lecture: steps of text, each with its own scene, camera and views.")
    imgui.pop_text_wrap_pos()
    asked = bool(imgui.button('Begin "Images, rays and cameras"'))
    if imgui.button("Open lecture..."):
        host.files.open_lecture_dialog()
    imgui.push_text_wrap_pos(0.0)
    imgui.text_colored(theme.DIM, "A lecture's file can be dropped on the window, too.")
    imgui.pop_text_wrap_pos()
    return asked
