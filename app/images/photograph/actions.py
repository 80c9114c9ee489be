"""The photograph's actions, and its menu on the strip above an image."""

from __future__ import annotations

from dataclasses import replace

from imgui_bundle import imgui

from lucida.app.images.photograph.model import closed
from lucida.app.state.bounds import range_of
from lucida.app.state.options.photograph import PhotographOptions
from lucida.app.ui.action import Action, changing, choosing, draw_entry
from lucida.app.ui.host import Host
from lucida.app.ui.rows import tip

MENU = "Image/Photograph"
SLIDER_EM = 11.0


def is_open(window: Host) -> bool:
    """Return True if there is a photograph for the images."""
    return bool(window.state.options.photograph.file)


PHOTOGRAPH = (
    choosing(
        MENU,
        "Photograph on the images",
        "photograph.shown",
        True,
        "Alt+P",
        off=False,
        can=is_open,
    ),
    Action(MENU, "Close the photograph", changing(closed), can=is_open, separated=True),
)


def entries(host: Host) -> None:
    """Draw the photograph's entries."""
    options = host.options.photograph
    imgui.set_next_item_width(SLIDER_EM * imgui.get_font_size())
    changed, opacity = imgui.slider_float(
        "##opacity", options.opacity, *range_of(PhotographOptions, "opacity"), "opacity %.2f"
    )
    tip("How much of the photograph is seen: a mean of what the screen shows (sRGB), not of light.")
    if changed:
        host.edit(replace(options, opacity=opacity, shown=True))
    imgui.separator()
    for action in PHOTOGRAPH:
        draw_entry(action, host, first=action is PHOTOGRAPH[0])
