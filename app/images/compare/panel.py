"""The compare view's controls and numbers: modes, gain, the verdict, the causes."""

from __future__ import annotations

from dataclasses import replace

from imgui_bundle import ImVec2, ImVec4, imgui

from lucida.app.state.bounds import range_of
from lucida.app.state.options.compare import CompareOptions
from lucida.app.ui import theme
from lucida.app.ui.checks import checkbox
from lucida.app.ui.host import Host
from lucida.app.ui.lettering import fitting_words
from lucida.app.ui.rows import button_width, follow, tip
from lucida.renderer.compare.raster_and_ray import LABEL_COLORS, Comparison

from . import comparing
from .comparing import MODES

SWATCH = int(imgui.ColorEditFlags_.no_tooltip | imgui.ColorEditFlags_.no_drag_drop)


def toolbar(host: Host) -> None:
    """Draw the modes, the gain and the switch for causes, in as many rows as they need."""
    options = host.options.compare
    box = imgui.get_frame_height() + imgui.get_style().item_inner_spacing.x
    for number, (mode, name, told) in enumerate(MODES):
        if number:
            follow(button_width(name))
        imgui.push_style_color(
            imgui.Col_.button, theme.FILL if options.mode == mode else theme.FRAME
        )
        if imgui.button(name):
            host.edit(replace(options, mode=mode))
        imgui.pop_style_color()
        tip(told)
    follow(box + imgui.calc_text_size("causes").x)
    changed, on = checkbox("causes", options.causes)
    if changed:
        host.edit(replace(options, causes=on))
    tip("Mark the pixels that differ, in the colours of their causes.")
    width = min(9 * imgui.get_font_size(), imgui.get_content_region_avail().x)
    follow(width)
    imgui.set_next_item_width(width)
    imgui.begin_disabled(options.mode == "wipe" or host.state.images.channel == "id")
    logarithmic = imgui.SliderFlags_.logarithmic
    bounds = range_of(CompareOptions, "gain")
    changed, gain = imgui.slider_float("##gain", options.gain, *bounds, "gain %.3g", logarithmic)
    if changed:
        host.edit(replace(options, gain=gain))
    tip("The factor of the difference.")
    imgui.end_disabled()


def verdict(host: Host, text: str, color: ImVec4, comparison: Comparison | None) -> None:
    """Draw the result in one line, and below it the causes that occur with their counts, the worst
    first. A click on a cause goes to the next of its pixels. comparison: None until it is known.
    """
    imgui.push_font(host.fonts.bold, 0.0)
    shown = fitting_words(text, imgui.get_content_region_avail().x)
    imgui.text_colored(color, shown)
    imgui.pop_font()
    if shown != text:
        tip(text)
    swatch, room = imgui.get_frame_height(), imgui.get_content_region_avail().x
    imgui.dummy(ImVec2(0, swatch))  # always one row, because another height would change the image
    found = comparing.counts(comparison) if comparison is not None else {}
    for cause in reversed(comparing.LABELS):
        text = f"{cause.name} {found.get(cause.label, 0)}"
        width = swatch + button_width(text)
        if comparison is None or not found[cause.label] or width > room:
            continue
        room -= width + imgui.get_style().item_spacing.x
        imgui.same_line()
        red, green, blue = (LABEL_COLORS[cause.label] / 255).tolist()
        imgui.color_button(f"##color {cause.name}", ImVec4(red, green, blue, 1), SWATCH)
        imgui.same_line(0, 0)
        pressed = imgui.button(f"{text}###{cause.name}")
        tip(f"{cause.told}\nClick: the next of these pixels. Shift+click: the previous one.")
        if pressed:
            forward = not imgui.get_io().key_shift
            host.apply(comparing.stepped(host.state, comparison, forward, cause.label))
