"""The box for long loading and exporting: what is being done, for how long, and Cancel."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from app.widgets import theme

SHOWN_AFTER_S = 0.4
NAME = "##loading"


def loading_box(what: str, time_s: float) -> bool:
    """Draw the box, but not for quick work. Return True if the user cancels.

    what: the description of the work.
    """
    if time_s < SHOWN_AFTER_S:
        return False
    em = imgui.get_font_size()
    viewport = imgui.get_main_viewport()
    top = ImVec2(viewport.get_center().x, viewport.work_pos.y + 3 * em)
    imgui.set_next_window_pos(top, imgui.Cond_.always, ImVec2(0.5, 0.0))
    imgui.set_next_window_size(ImVec2(min(26 * em, 0.8 * viewport.work_size.x), 0))
    flags = imgui.WindowFlags_
    imgui.push_style_color(imgui.Col_.border, theme.ACCENT)
    imgui.push_style_color(imgui.Col_.plot_histogram, theme.ACCENT)
    imgui.begin(
        NAME,
        None,
        flags.no_decoration
        | flags.no_docking
        | flags.no_saved_settings
        | flags.no_move
        | flags.no_focus_on_appearing,
    )
    imgui.push_text_wrap_pos(0.0)
    imgui.text(f"{what} ...")
    imgui.pop_text_wrap_pos()
    # How long it takes is not known: the bar moves, and the time is told.
    imgui.progress_bar(-0.5 * time_s, ImVec2(-8 * em, 0), f"{time_s:.0f} s")
    imgui.same_line()
    cancelled = imgui.button("Cancel", ImVec2(-1, 0))
    imgui.end()
    imgui.pop_style_color(2)
    return bool(cancelled)
