"""The menu for the photograph, on the strip above an image."""

from __future__ import annotations

from dataclasses import replace

from imgui_bundle import imgui

from lucida.app.images.imaging import size_text, with_resolution
from lucida.app.images.photograph.actions import PHOTOGRAPH
from lucida.app.images.photograph.reading import Size
from lucida.app.state.bounds import range_of
from lucida.app.state.options.photograph import PhotographOptions
from lucida.app.ui.action import draw_entry
from lucida.app.ui.host import Host
from lucida.app.ui.rows import tip
from lucida.app.ui.sliders import slider_float
from lucida.renderer.images.frame import check_size
from lucida.renderer.system.errors import LucidaError

SLIDER_EM = 11.0


def entries(host: Host, file_size: Size) -> None:
    """Draw the photograph's entries.

    file_size: its own (width, height); (0, 0) if unknown.
    """
    options = host.options.photograph
    imgui.set_next_item_width(SLIDER_EM * imgui.get_font_size())
    changed, opacity = slider_float(
        "##opacity", options.opacity, *range_of(PhotographOptions, "opacity"), "opacity %.2f"
    )
    tip("How much of the photograph is seen: a mean of what the screen shows (sRGB), not of light.")
    if changed:
        host.edit(replace(options, opacity=opacity, shown=True))
    if fits_images(file_size):
        now = host.state.images.resolution == file_size
        if imgui.menu_item(f"Images of its size, {size_text(file_size)}", "", now)[0]:
            host.change(with_resolution(host.state, file_size))
        tip("Pixel by pixel: each of the photograph is one of the images.")
    imgui.separator()
    for action in PHOTOGRAPH:
        draw_entry(action, host, first=action is PHOTOGRAPH[0])


def fits_images(size: Size) -> bool:
    """Return True if the images can have as many pixels."""
    try:
        check_size(size)
    except LucidaError:
        return False
    return True
