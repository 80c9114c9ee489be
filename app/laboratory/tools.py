"""The laboratory's switches: which page, and what can be changed on it.

Knows nothing of pictures.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from imgui_bundle import imgui

from app.host.view import Host
from app.laboratory.bitmaps import TITLES
from app.laboratory.displays import DISPLAYS
from app.laboratory.memory import ORDERS
from app.laboratory.options import LaboratoryOptions
from app.laboratory.pages import PAGE_TITLES
from app.state.bounds import range_of, whole_range_of
from app.widgets.checks import checkbox, radio_button
from app.widgets.rows import follow
from app.widgets.sliders import slider_float, slider_int

ROW_EM = 42.0  # the width of all pages' buttons in a row

FIRST = ["rows and columns from 1 (lecture)", "from 0 (array)"]


def toolbar(host: Host) -> LaboratoryOptions:
    """Draw the switches. Return the present options."""
    options = host.state.of(LaboratoryOptions)
    changed = _pages(options)
    width = imgui.get_content_region_avail().x
    imgui.push_item_width(min(14 * imgui.get_font_size(), 0.5 * width))
    match changed.page:
        case "kinds":
            changed = _bitmap(_exposure(changed))
        case "exposure":
            changed = _exposure(changed)
        case "projectors":
            moved, apart = slider_float(
                "apart##apart", options.apart, *range_of(LaboratoryOptions, "apart"), "%.2f"
            )
            changed = replace(changed, apart=apart) if moved else changed
            changed = _content(changed, "white discs")
        case "displays":
            changed = _content(_display(changed), "test picture")
            if changed.content == "image":  # a test picture is as large as there is room
                follow((14 + 9) * imgui.get_font_size())
                moved, side_px = slider_int(
                    "screen pixels per pixel##side",
                    options.side_px,
                    *whole_range_of(LaboratoryOptions, "side_px"),
                )
                changed = replace(changed, side_px=side_px) if moved else changed
        case "array":
            if host.state.step is None:  # a lecture counts in its own way
                imgui.set_next_item_width(18 * imgui.get_font_size())
                number = 0 if host.state.options.one_based else 1
                moved, number = imgui.combo("##base", number, FIRST)
                if moved:
                    host.apply(host.state.with_options(one_based=number == 0))
                follow(18 * imgui.get_font_size())
            imgui.set_next_item_width(18 * imgui.get_font_size())
            orders = list(ORDERS)
            moved, number = imgui.combo(
                "##order", orders.index(options.order), list(ORDERS.values())
            )
            changed = replace(changed, order=orders[number]) if moved else changed
        case "vector":
            moved, zoom = slider_float(
                "zoom##zoom",
                options.zoom,
                *range_of(LaboratoryOptions, "zoom"),
                "%.1fx",
                imgui.SliderFlags_.logarithmic | imgui.SliderFlags_.always_clamp,
            )
            changed = replace(changed, zoom=zoom) if moved else changed
    imgui.pop_item_width()
    imgui.spacing()
    if changed != options:
        host.apply(host.state.with_options(laboratory=changed))
    return changed


def _pages(options: LaboratoryOptions) -> LaboratoryOptions:
    """Draw the choice of pages: in a row, or as a list where there is no room for that."""
    em, names = imgui.get_font_size(), list(PAGE_TITLES)
    if imgui.get_content_region_avail().x > ROW_EM * em:
        page = _radio("page", PAGE_TITLES, options.page)
        return replace(options, page=page)  # type: ignore[arg-type]
    imgui.set_next_item_width(8 * em)
    moved, number = imgui.combo("##page", names.index(options.page), list(PAGE_TITLES.values()))
    follow(20 * em)
    return replace(options, page=names[number]) if moved else options  # type: ignore[arg-type]


def _radio(name: str, titles: Mapping[str, str], chosen: str) -> str:
    """Draw radio buttons in a row, or in several if they must. Return the selected one."""
    for number, (one, title) in enumerate(titles.items()):
        if number:
            follow(imgui.calc_text_size(title).x + 1.5 * imgui.get_frame_height())
        if radio_button(f"{title}##{name}", one == chosen):
            chosen = one
    return chosen


def _content(options: LaboratoryOptions, test: str) -> LaboratoryOptions:
    """Draw the choice between the image and a test picture."""
    follow(imgui.calc_text_size(test).x + 1.5 * imgui.get_frame_height())
    moved, is_test = checkbox(f"{test}##content", options.content == "test")
    return replace(options, content="test" if is_test else "image") if moved else options


def _display(options: LaboratoryOptions) -> LaboratoryOptions:
    titles = {name: display.title for name, display in DISPLAYS.items()}
    return replace(options, display=_radio("display", titles, options.display))  # type: ignore[arg-type]


def _exposure(options: LaboratoryOptions) -> LaboratoryOptions:
    limits = range_of(LaboratoryOptions, "after_ev")
    moved, value = slider_float(
        "exposure after storage##after", options.after_ev, *limits, "%+.1f EV"
    )
    return replace(options, after_ev=value) if moved else options


def _bitmap(options: LaboratoryOptions) -> LaboratoryOptions:
    follow((14 + 4) * imgui.get_font_size())
    methods = list(TITLES)
    moved, number = imgui.combo(
        "bitmap##method", methods.index(options.method), list(TITLES.values())
    )
    return replace(options, method=methods[number]) if moved else options  # type: ignore[arg-type]
