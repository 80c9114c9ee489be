"""The menu entries for the photograph."""

from __future__ import annotations

from dataclasses import replace

from imgui_bundle import imgui

from lucida.app.images.imaging import size_text, with_resolution
from lucida.app.images.photograph.model import can_undistort, closed, undistorting
from lucida.app.images.photograph.reading import Size
from lucida.app.state.app_state import AppState
from lucida.app.state.bounds import range_of
from lucida.app.state.options.photograph import PhotographOptions
from lucida.app.ui.rows import tip
from lucida.app.ui.sliders import slider_float
from lucida.renderer.images.frame import check_size
from lucida.renderer.system.errors import LucidaError

SLIDER_EM = 11.0
UNDISTORT = "Undistort the photograph"


def entries(state: AppState, file_size: Size) -> AppState:
    """Draw them. Return the state that was asked for.

    file_size: the photograph's own (width, height); (0, 0) if unknown.
    """
    options = state.options.photograph
    if imgui.menu_item("On the images", "Alt+P", options.shown)[0]:
        state = state.with_options(replace(state.options.photograph, shown=not options.shown))
    imgui.set_next_item_width(SLIDER_EM * imgui.get_font_size())
    changed, opacity = slider_float(
        "##opacity", options.opacity, *range_of(PhotographOptions, "opacity"), "opacity %.2f"
    )
    tip("How much of the photograph is seen: a mean of what the screen shows (sRGB), not of light.")
    if changed:
        state = state.with_options(replace(state.options.photograph, opacity=opacity, shown=True))
    imgui.separator()
    if can_undistort(state):
        if imgui.menu_item(UNDISTORT, "", options.distorted is not None)[0]:
            state = undistorting(state, file_size)
        imgui.set_item_tooltip("What a pinhole would have seen: photograph and camera, no lens.")
    if fits_images(file_size):
        now = state.images.resolution == file_size
        name = f"Images of its size, {size_text(file_size)}"
        if imgui.menu_item(name, "", now)[0]:
            state = with_resolution(state, file_size)
        tip("Pixel by pixel: each of the photograph is one of the images.")
    if imgui.menu_item("Close the photograph", "", False)[0]:
        state = closed(state)
    return state


def fits_images(size: Size) -> bool:
    """Return True if the images can have as many pixels."""
    try:
        check_size(size)
    except LucidaError:
        return False
    return True
