"""The compare view's controls and numbers: modes, gain, the verdict, the causes."""

from __future__ import annotations

from dataclasses import replace

from imgui_bundle import ImVec2, ImVec4, imgui

from lucida.app.images.compare import comparing
from lucida.app.images.compare.comparing import MODES
from lucida.app.state.bounds import range_of
from lucida.app.state.options.compare import CompareOptions
from lucida.app.ui import theme
from lucida.app.ui.checks import checkbox
from lucida.app.ui.host import Host
from lucida.app.ui.lettering import fitting_words
from lucida.app.ui.rows import button_width, follow, tip
from lucida.renderer.compare.raster_and_ray import LABEL_COLORS, Comparison

WIDEST = "000000"  # count
SWATCH = int(imgui.ColorEditFlags_.no_tooltip | imgui.ColorEditFlags_.no_drag_drop)


def toolbar(host: Host) -> None:
    """Draw modes, gain and the switch of the causes, in as many rows as they need."""
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
    """Draw the result in one line, and each cause with its count: a click goes to the next of its
    pixels. comparison: None until it is known.
    """
    imgui.push_font(host.fonts.bold, 0.0)
    shown = fitting_words(text, imgui.get_content_region_avail().x)
    imgui.text_colored(color, shown)
    imgui.pop_font()
    if shown != text:
        tip(text)
    counts = comparing.counts(comparison) if comparison is not None else {}
    swatch, room = imgui.get_frame_height(), imgui.get_content_region_avail().x
    for number, cause in enumerate(comparing.offered(host.state)):
        # The rows do not depend on the counts: another height would be another image.
        width = min(button_width(f"{cause.name} {WIDEST}"), room - swatch)
        if number:
            follow(swatch + width)
        red, green, blue = (LABEL_COLORS[cause.label] / 255).tolist()
        imgui.color_button(f"##color {cause.name}", ImVec4(red, green, blue, 1), SWATCH)
        imgui.same_line(0, 0)
        count = counts.get(cause.label, 0)
        text = str(count) if comparison is not None else "..."
        imgui.begin_disabled(not count)
        pressed = imgui.button(f"{cause.name} {text}###{cause.name}", ImVec2(width, 0))
        imgui.end_disabled()
        tip(f"{cause.told}\nClick: the next of these pixels. Shift+click: the previous one.")
        if pressed and comparison is not None:
            forward = not imgui.get_io().key_shift
            host.apply(comparing.stepped(host.state, comparison, forward, cause.label))
