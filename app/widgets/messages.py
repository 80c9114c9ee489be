"""Messages: over the window, an error that must be answered; or in a view."""

from __future__ import annotations

from dataclasses import dataclass

from imgui_bundle import ImVec2, imgui

from app.widgets import theme
from renderer.errors import describe

WIDTH_EM = 40.0


@dataclass(frozen=True)
class Message:
    """A message. answers: the words on the buttons."""

    text: str
    answers: tuple[str, ...] = ("Close",)


def message_box(message: Message) -> str:
    """Draw the message. Return the selected answer, or ""."""
    viewport = imgui.get_main_viewport()
    em = imgui.get_font_size()
    width = min(WIDTH_EM * em, viewport.work_size.x * 0.8)
    top = ImVec2(viewport.get_center().x, viewport.work_pos.y + 3 * em)
    imgui.set_next_window_pos(top, imgui.Cond_.always, ImVec2(0.5, 0.0))
    imgui.set_next_window_size(ImVec2(width, 0))
    flags = imgui.WindowFlags_
    imgui.push_style_color(imgui.Col_.window_bg, theme.POPUP)
    imgui.push_style_color(imgui.Col_.border, theme.ERROR)
    imgui.begin(
        "##message",
        None,
        flags.no_decoration | flags.no_docking | flags.no_saved_settings | flags.no_move,
    )
    imgui.pop_style_color(2)
    imgui.push_text_wrap_pos(0.0)
    imgui.text(message.text)
    imgui.pop_text_wrap_pos()
    chosen = ""
    for index, answer in enumerate(message.answers):
        if index:
            imgui.same_line()
        if imgui.button(answer):
            chosen = answer
    imgui.end()
    return chosen


@dataclass(frozen=True)
class TextListing:
    """Lines to read, with a title."""

    title: str
    lines: tuple[str, ...]


def listing_box(listing: TextListing) -> bool:
    """Draw the lines in the middle of the window, to scroll and copy. Return True while the box is
    open.
    """
    viewport = imgui.get_main_viewport()
    width = min(52 * imgui.get_font_size(), 0.86 * viewport.work_size.x)
    center = viewport.get_center()
    imgui.set_next_window_pos(center, imgui.Cond_.always, ImVec2(0.5, 0.5))
    imgui.set_next_window_size(ImVec2(width, 0))
    flags = imgui.WindowFlags_
    imgui.push_style_color(imgui.Col_.window_bg, theme.POPUP)
    imgui.begin(
        "##listing",
        None,
        flags.no_decoration | flags.no_docking | flags.no_saved_settings | flags.no_move,
    )
    imgui.pop_style_color()
    imgui.push_text_wrap_pos(0.0)
    imgui.text(listing.title)
    highest = ImVec2(width, 0.5 * viewport.work_size.y)
    imgui.set_next_window_size_constraints(ImVec2(0, 0), highest)
    child = imgui.ChildFlags_
    imgui.begin_child("##lines", ImVec2(0, 0), child.borders | child.auto_resize_y)
    imgui.push_text_wrap_pos(0.0)
    for text in listing.lines:
        imgui.bullet()
        imgui.text(text)
    imgui.pop_text_wrap_pos()
    imgui.end_child()
    imgui.pop_text_wrap_pos()
    if imgui.button("Copy"):
        imgui.set_clipboard_text("\n".join((listing.title, *listing.lines)))
    imgui.same_line()
    stays = not imgui.button("Close")
    imgui.end()
    return stays


def failure_note(title: str, error: Exception) -> bool:
    """Draw the error of a view that could not be drawn. Return True if the user wants a retry."""
    place, room = imgui.get_cursor_pos(), imgui.get_content_region_avail()
    margin = 0.5 * imgui.get_font_size()  # images have none
    imgui.set_cursor_pos(ImVec2(place.x + margin, place.y + margin))
    imgui.begin_group()
    imgui.push_text_wrap_pos(place.x + room.x - margin)
    imgui.text_colored(theme.ERROR, f"{' '.join(title.split())} could not be drawn.")
    imgui.text(describe(error))
    imgui.pop_text_wrap_pos()
    again = bool(imgui.button("Try again"))
    imgui.end_group()
    return again
