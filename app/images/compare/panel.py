"""The compare view's controls and numbers: modes, gain, colour bar, causes, errors, steps."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from imgui_bundle import ImVec2, ImVec4, imgui

from lucida.app.images.compare import comparing
from lucida.app.images.compare.comparing import MODES, ColorScale
from lucida.app.state.bounds import range_of
from lucida.app.state.options.compare import CompareOptions
from lucida.app.state.options.shared import Pixel
from lucida.app.ui import theme
from lucida.app.ui.checks import checkbox
from lucida.app.ui.host import Host
from lucida.app.ui.lettering import fitting_words
from lucida.app.ui.rows import button_width, follow, tip
from lucida.app.ui.sliders import slider_float
from lucida.renderer.compare.raster_and_ray import LABEL_COLORS, Comparison

DrawMap = Callable[[ImVec2, ImVec2, bool], None]  # two corners; whether the signed map

SMALL_EM = 22.0  # a view that is less high has no line for what the images' own windows have too
LOW_EM = 30.0  # a view that is less high has no causes, errors and values
DIGITS = 6  # of a count
VALUES_COLUMNS = 58  # of a pixel's values
NEXT = "next"
COLORS_COMPARED = (
    "Colours are compared as display values (sRGB, exposure 0), by the channel of light that\n"
    "differs most; depths relative to the ray image's."
)


@dataclass(frozen=True)
class CompareReport:
    """The contents of the panel. comparison: None until it is known. headline: one line; color: its
    colour. pixel: the one whose values are shown.
    """

    headline: str
    color: ImVec4
    comparison: Comparison | None = None
    pixel: Pixel | None = None


def toolbar(host: Host) -> None:
    """Draw modes, gain and the switch of the causes, in as many rows as they need."""
    options = host.options.compare
    for mode, name, told in MODES:
        if mode != MODES[0][0]:
            follow(button_width(name))
        if _choice(name, options.mode == mode):
            host.edit(replace(options, mode=mode))
        tip(told)
    follow(imgui.get_frame_height() + imgui.get_style().item_inner_spacing.x + _wide("causes"))
    changed, on = checkbox("causes", options.causes)
    if changed:
        host.edit(replace(options, causes=on))
    tip("Mark the pixels that differ, in the colours of their causes.")
    width = min(9 * imgui.get_font_size(), imgui.get_content_region_avail().x)
    follow(width)
    imgui.set_next_item_width(width)
    has_gain = options.mode in ("absolute", "signed") and host.state.images.channel != "id"
    imgui.begin_disabled(not has_gain)
    changed, gain = slider_float(
        "##gain",
        options.gain,
        *range_of(CompareOptions, "gain"),
        "gain %.3g",
        imgui.SliderFlags_.logarithmic,
    )
    if changed:
        host.edit(replace(options, gain=gain))
    tip("What the difference is multiplied with. Keys [ and ]")
    imgui.end_disabled()


def footer(host: Host, told: CompareReport, is_short: bool, draw_map: DrawMap) -> None:
    """Draw everything below the image, or the headline and the scale alone if there is little room.

    Its height depends only on what the user does, so that nothing jumps. draw_map: draws the colour
    map between two corners.
    """
    imgui.push_font(host.fonts.bold, 0.0)
    shown = fitting_words(told.headline, imgui.get_content_region_avail().x)
    imgui.text_colored(told.color, shown)
    imgui.pop_font()
    if shown != told.headline:
        tip(told.headline)
    _scale_row(host, draw_map)
    if is_short:
        return
    _counts(host, told.comparison)
    _errors(host, told.comparison)
    if _mono_width(host.fonts, VALUES_COLUMNS) <= imgui.get_content_region_avail().x:
        _values(host, told)


def _scale_row(host: Host, draw_map: DrawMap) -> None:
    """Draw the colour bar; in the other modes something else of the same height."""
    top = imgui.get_cursor_pos_y()
    options, images = host.options.compare, host.state.images
    if options.mode in ("absolute", "signed"):
        signed = options.mode == "signed"
        scale = comparing.scale(images.channel, options.gain, signed)
        scale = replace(scale, title=scale.title + comparing.measured_at(images))
        _color_bar(scale, signed, draw_map)
    elif options.mode == "wipe":
        imgui.set_next_item_width(-1)
        changed, percent = imgui.slider_float("##divider", 100 * options.divider, 0.0, 100.0, " ")
        if changed:
            host.edit(replace(options, divider=percent / 100))
        tip("Where the divider stands. It can be dragged in the image, too.")
        text = f"raster left of {100 * options.divider:.0f} %, ray right of it"
        imgui.text(fitting_words(text, imgui.get_content_region_avail().x))
    else:
        for flipped, name in ((False, "raster"), (True, "ray")):
            if flipped:
                imgui.same_line()
            if _choice(f"show {name}", options.flipped == flipped):
                host.edit(replace(options, flipped=flipped))
        imgui.same_line()
        imgui.align_text_to_frame_padding()
        imgui.text_disabled("Hold X to see the other image")
    lines = 2 * imgui.get_text_line_height_with_spacing() + imgui.get_style().item_spacing.y
    imgui.set_cursor_pos_y(top + lines)
    imgui.dummy(ImVec2(0, 0))
    imgui.set_cursor_pos_y(top + lines)


def _color_bar(scale: ColorScale, signed: bool, draw_map: DrawMap) -> None:
    """Draw the colour map, and below it the meaning of its ends and its middle."""
    at, width = imgui.get_cursor_screen_pos(), imgui.get_content_region_avail().x
    height = imgui.get_text_line_height()
    end = ImVec2(at.x + width, at.y + height)
    draw_map(at, end, signed)
    draw = imgui.get_window_draw_list()
    draw.add_rect(at, end, theme.u32(theme.DIM))
    imgui.dummy(ImVec2(width, height))
    tip(COLORS_COMPARED)
    below = imgui.get_cursor_screen_pos()
    low, high, gap = scale.low, scale.high, 2 * imgui.get_font_size()
    if _wide(low) + _wide(scale.middle) + _wide(high) + gap > width:
        low, high = scale.short
    texts = [(low, 0.0), (high, 1.0), (scale.middle, 0.5 if signed else 0.0)]
    if not signed and _wide(scale.title) + 2 * max(map(_wide, (high, scale.middle))) + gap < width:
        texts.append((scale.title, 0.5))
    for text, part in texts:  # at the left end (0), in the middle, or at the right end (1)
        left = below.x + part * (width - _wide(text))
        draw.add_text(ImVec2(left, below.y), theme.u32(theme.TEXT), text)


def _wide(text: str) -> float:
    return imgui.calc_text_size(text).x


def _step(host: Host, comparison: Comparison | None, label: int | None = None) -> None:
    """Go to the next differing pixel, or with Shift to the previous one."""
    if comparison is not None:
        forward = not imgui.get_io().key_shift
        host.apply(comparing.stepped(host.state, comparison, forward, label))


def _counts(host: Host, comparison: Comparison | None) -> None:
    """Draw each cause with its colour and its count; a click goes to the next of its pixels."""
    found = comparing.counts(comparison) if comparison is not None else {}
    draw = imgui.get_window_draw_list()
    for number, cause in enumerate(comparing.offered(host.state)):
        width = _count_width(cause.name)
        if number:
            follow(width)
        count = found.get(cause.label, 0)
        text = str(count) if comparison is not None else "..."
        at, size = imgui.get_cursor_screen_pos(), imgui.get_frame_height()
        imgui.begin_disabled(not count)
        if imgui.button(f"##{cause.name}", ImVec2(width, size)):
            _step(host, comparison, cause.label)
        imgui.end_disabled()
        tip(f"{cause.told}\nClick: the next of these pixels; Shift: the last.")
        pad = imgui.get_style().frame_padding
        edge = size - 2 * pad.y
        low = ImVec2(at.x + pad.x, at.y + pad.y)
        red, green, blue = (LABEL_COLORS[cause.label] / 255).tolist()
        swatch = theme.u32(ImVec4(red, green, blue, 1))
        draw.add_rect_filled(low, ImVec2(low.x + edge, low.y + edge), swatch, 2.0)
        color = theme.u32(theme.TEXT if count else theme.DIM)
        draw.add_text(ImVec2(low.x + edge + pad.x, low.y), color, cause.name)
        imgui.push_font(host.fonts.mono, 0.0)
        right = at.x + width - pad.x - _wide(text)
        draw.add_text(ImVec2(right, low.y), color, text)
        imgui.pop_font()


def _count_width(name: str) -> float:
    style, height = imgui.get_style(), imgui.get_text_line_height()
    digits = imgui.calc_text_size("0" * DIGITS).x
    return height + _wide(name) + digits + 4 * style.frame_padding.x


def _errors(host: Host, comparison: Comparison | None) -> None:
    """Draw the buttons that go to pixels, and the errors over the whole image."""
    fonts, images, indexing = host.fonts, host.state.images, host.options.indexing
    channel = images.channel
    differ = comparison is not None and comparison.agree < comparison.pixels
    imgui.begin_disabled(not differ)
    if imgui.button(NEXT):
        _step(host, comparison)
    imgui.end_disabled()
    tip("Mark the next pixel that differs, and magnify there. Keys N, Shift+N")
    wide = _mono_width(fonts, len("worst (1000, 1000)")) + 2 * imgui.get_style().frame_padding.x
    follow(wide)  # at any pixel, so that rows do not change with it
    worst = comparison.errors[channel].worst if comparison is not None else (0, 0)
    imgui.begin_disabled(comparison is None)
    imgui.push_font(fonts.mono, 0.0)
    if imgui.button(f"worst {indexing.text(worst)}###worst", ImVec2(wide, 0)) and comparison:
        host.apply(comparing.at_worst(host.state, comparison))
    imgui.pop_font()
    imgui.end_disabled()
    tip(
        f"Mark the pixel of the largest error, and magnify there: row and column {indexing.told}. "
        "Shift+M"
    )
    follow(_mono_width(fonts, len("max 100.0/255  RMS  10.000/255  at 0 EV")))
    imgui.push_font(fonts.mono, 0.0)
    text = comparing.error_text(comparison, channel) if comparison is not None else "..."
    text += comparing.measured_at(images)
    imgui.align_text_to_frame_padding()
    imgui.text(text)
    imgui.pop_font()
    tip(COLORS_COMPARED)


def _mono_width(fonts: theme.Fonts, columns: int) -> float:
    imgui.push_font(fonts.mono, 0.0)
    width = imgui.calc_text_size("0" * columns).x
    imgui.pop_font()
    return width


def _values(host: Host, told: CompareReport) -> None:
    """Draw both images' values at a pixel, one above the other. Without a pixel the lines stay
    empty.
    """
    line = imgui.get_text_line_height_with_spacing()
    if told.comparison is None or told.pixel is None:
        top = imgui.get_cursor_pos_y()
        if told.comparison is not None:
            imgui.text_disabled("Point at a pixel, or click it: its values in both images")
        imgui.set_cursor_pos_y(top)
        imgui.dummy(ImVec2(1, 2 * line - imgui.get_style().item_spacing.y))
        return
    channel, indexing = host.state.images.channel, host.options.indexing
    raster, ray, difference = comparing.pixel_values(told.comparison, told.pixel, channel)
    cause = comparing.cause_at(told.comparison, told.pixel)
    imgui.push_font(host.fonts.mono, 0.0)
    pixel = f"{indexing.text(told.pixel)} {indexing.told}"
    name = cause.name if cause is not None else "agree"
    imgui.text(f"raster {raster:24} pixel {pixel}: {name}")
    imgui.text(f"ray    {ray:24} ray - raster {difference}" if difference else f"ray    {ray}")
    imgui.pop_font()


def _choice(name: str, on: bool) -> bool:
    """Draw a button that is one of several, lit if it is the selected one."""
    if on:
        imgui.push_style_color(imgui.Col_.button, theme.FILL)
        imgui.push_style_color(imgui.Col_.button_hovered, theme.FILL)
        imgui.push_style_color(imgui.Col_.text, theme.rgb("#ffffff"))
    pressed = imgui.button(name)
    if on:
        imgui.pop_style_color(3)
    return pressed
