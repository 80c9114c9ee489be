"""The panel of the view "Poses": the set and its commands, its list, the photograph.

Takes values and returns requests.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import moderngl
from imgui_bundle import ImVec2, imgui

from app.poses.options import PosesOptions
from app.state.bounds import range_of
from app.widgets import theme
from app.widgets.checks import checkbox
from app.widgets.lettering import fitting_words, lettering
from app.widgets.rows import follow
from app.widgets.sliders import slider_float
from app.widgets.theme import Fonts, framebuffer_scale
from renderer.errors import one_line

PoseWish = Literal[
    "", "open", "close", "frame", "cancel", "next", "previous", "first", "last", "lay"
]
INVITATION = (
    "Open the cameras of a data set or of a reconstruction: a transforms.json (NeRF, nerfstudio),"
    " or a COLMAP model's folder, such as sparse/0. Each becomes a frustum in the outside view."
)
LAY = "on the images"
LAY_TOLD = "each pose's photograph over both images, as they are walked (Image > Photograph)"
SHOWN_AFTER_S = 0.4
BESIDE = 1.2  # width / height from which the photograph is next to the list
PHOTO_PART = 0.52  # of the room's width, next to the list
BELOW_PART = 0.45  # of its height, below it


@dataclass(frozen=True)
class PosesHead:
    """The contents of the panel's head.

    name, folder: of the set.
    counts: its contents in words.
    told: the notes on it.
    """

    name: str
    folder: str
    counts: str
    told: tuple[str, ...]
    has_points: bool


@dataclass(frozen=True)
class PoseRows:
    """The contents of the list.

    names: of all cameras.
    shown: the numbers of those that the search found.
    chosen: the number of the selected one, -1 for none.
    scroll: scroll to it; without a selection, to the first.
    """

    names: Sequence[str]
    shown: Sequence[int]
    chosen: int
    scroll: bool


@dataclass(frozen=True)
class PhotoShown:
    """The photograph in the panel.

    texture: None while there is none.
    caption: below it.
    problem: the reason why there is none.
    laid: True if it is laid over the images; None if it cannot be.
    """

    texture: moderngl.Texture | None
    caption: str
    problem: str
    laid: bool | None = None


def invitation() -> PoseWish:
    """Draw the panel if no set is open."""
    imgui.push_text_wrap_pos(0.0)
    imgui.text(INVITATION)
    imgui.pop_text_wrap_pos()
    wish: PoseWish = "open" if imgui.button("Open cameras...") else ""
    imgui.push_text_wrap_pos(0.0)
    imgui.text_colored(theme.DIM, "Or drop the file or the folder, or: lucida transforms.json")
    imgui.pop_text_wrap_pos()
    return wish


def failed(name: str, problem: str) -> PoseWish:
    """Draw a set that cannot be read, in one line."""
    imgui.push_text_wrap_pos(0.0)
    imgui.text_colored(theme.ERROR, problem)
    imgui.pop_text_wrap_pos()
    wish: PoseWish = "open" if imgui.button("Open cameras...") else ""
    follow(_width("Close"))
    if imgui.button("Close"):
        wish = "close"
    imgui.set_item_tooltip(f"Remove {one_line(name)} from the list")
    return wish


def waiting(name: str, time_s: float) -> PoseWish:
    """Draw a set that is being read."""
    if time_s < SHOWN_AFTER_S:
        return ""
    imgui.text_colored(theme.DIM, f"reading {one_line(name)} ...")
    imgui.progress_bar(-0.5 * time_s, ImVec2(-6 * imgui.get_font_size(), 0), f"{time_s:.0f} s")
    imgui.same_line()
    return "cancel" if imgui.button("Cancel", ImVec2(-1, 0)) else ""


def head(
    told: PosesHead, options: PosesOptions, fonts: Fonts
) -> tuple[PoseWish, dict[str, float | bool]]:
    """Draw the set and its commands. Return the changed options."""
    wish: PoseWish = ""
    changes: dict[str, float | bool] = {}
    with lettering(fonts.bold, imgui.get_font_size()):
        imgui.align_text_to_frame_padding()
        imgui.text(fitting_words(one_line(told.name), imgui.get_content_region_avail().x))
    imgui.set_item_tooltip(one_line(told.folder))
    follow(imgui.calc_text_size(told.counts).x)
    imgui.align_text_to_frame_padding()
    imgui.text_colored(theme.DIM, told.counts)
    if told.told:
        imgui.set_item_tooltip("\n".join(told.told))
    entries: tuple[tuple[PoseWish, str, str], ...] = (
        ("frame", "Frame the set", "the outside view sees all of its cameras and points"),
        ("open", "Open...", "another set"),
        ("close", "Close", "no cameras but the window's own"),
    )
    for number, (name, label, tip) in enumerate(entries):
        if number:
            follow(_width(label))
        if imgui.button(f"{label}###{name}"):
            wish = name
        imgui.set_item_tooltip(tip)
    width = 7.5 * imgui.get_font_size()
    follow(width)
    imgui.set_next_item_width(width)
    changed, length = slider_float(
        "##length", options.length, *range_of(PosesOptions, "length"), "length %.2f",
        imgui.SliderFlags_.logarithmic,
    )  # fmt: skip
    imgui.set_item_tooltip("how long the frusta are drawn: 1 fits the set")
    if changed:
        changes["length"] = length
    if told.has_points:
        follow(imgui.calc_text_size("points").x + 1.5 * imgui.get_frame_height())
        changed, points = checkbox("points", options.points)
        imgui.set_item_tooltip("the reconstruction's points")
        if changed:
            changes["points"] = points
        follow(imgui.calc_text_size("on photographs").x + 1.5 * imgui.get_frame_height())
        changed, on_photographs = checkbox("on photographs", options.reprojected)
        imgui.set_item_tooltip(
            "the points as each camera sees them: they should line up with the photograph"
        )
        if changed:
            changes["reprojected"] = on_photographs
    return wish, changes


def search(query: str, found: int, of: int) -> str:
    """Draw the search field for names."""
    imgui.set_next_item_width(-1)
    _, query = imgui.input_text_with_hint("##search", f"search {of} names", query)
    if query:
        imgui.set_item_tooltip(f"{found} of {of}")
    return str(query)


def rooms(has_photo: bool) -> tuple[ImVec2, ImVec2, bool]:
    """Return the rooms for the list and the photograph, and whether they are side by side."""
    room, gap = imgui.get_content_region_avail(), imgui.get_style().item_spacing
    room = ImVec2(max(room.x, 1.0), max(room.y, 1.0))
    if not has_photo:
        return room, ImVec2(0, 0), False
    if room.x > BESIDE * room.y:
        photo = PHOTO_PART * room.x
        return ImVec2(room.x - photo - gap.x, room.y), ImVec2(photo, room.y), True
    photo = BELOW_PART * room.y
    return ImVec2(room.x, max(room.y - photo - gap.y, 1.0)), ImVec2(room.x, photo), False


def rows(told: PoseRows, room: ImVec2) -> int | None:
    """Draw the list. Return the number of the clicked row. Only visible rows are made."""
    clicked = None
    if imgui.begin_child("list", room, imgui.ChildFlags_.borders):
        height = imgui.get_text_line_height_with_spacing()
        if told.scroll and told.chosen not in told.shown:
            imgui.set_scroll_y(0.0)
        elif told.scroll:
            top = height * told.shown.index(told.chosen)
            seen, tall = imgui.get_scroll_y(), imgui.get_window_height()
            if not seen <= top <= seen + tall - 3 * height:
                imgui.set_scroll_y(max(top - 0.4 * tall, 0.0))
        clipper = imgui.ListClipper()
        clipper.begin(len(told.shown), height)
        while clipper.step():
            for row in range(clipper.display_start, clipper.display_end):
                number = told.shown[row]
                label, on = f"{one_line(told.names[number])}###{number}", number == told.chosen
                if on:  # not to be taken for the one under the mouse
                    imgui.push_style_color(imgui.Col_.header, theme.ACCENT)
                    imgui.push_style_color(imgui.Col_.text, theme.rgb("#ffffff"))
                if imgui.selectable(label, on)[0]:
                    clicked = number
                if on:
                    imgui.pop_style_color(2)
        if not told.shown:
            imgui.text_colored(theme.DIM, "no name has that in it")
    imgui.end_child()
    return clicked


def photograph(shown: PhotoShown, room: ImVec2) -> PoseWish:
    """Draw the picture as large as it fits, keeping its proportions; or the reason why there is
    none.
    """
    wish: PoseWish = ""
    if imgui.begin_child("photograph", room):
        if shown.laid is not None:
            if checkbox(LAY, shown.laid)[0]:
                wish = "lay"
            imgui.set_item_tooltip(LAY_TOLD)
            room = imgui.get_content_region_avail()
        if shown.texture is not None:
            width, height = shown.texture.size
            lines = imgui.calc_text_size(shown.caption, False, room.x).y
            space = ImVec2(room.x, max(room.y - lines - imgui.get_style().item_spacing.y, 1.0))
            scale = min(space.x / width, space.y / height)
            scale = min(scale, 2.0 / framebuffer_scale())
            extent = ImVec2(max(scale * width, 1.0), max(scale * height, 1.0))
            imgui.image(imgui.ImTextureRef(shown.texture.glo), extent)
            imgui.push_text_wrap_pos(0.0)
            imgui.text_colored(theme.DIM, shown.caption)
            imgui.pop_text_wrap_pos()
        elif shown.problem:
            imgui.push_text_wrap_pos(0.0)
            imgui.text_colored(theme.DIM, shown.problem)
            imgui.pop_text_wrap_pos()
    imgui.end_child()
    return wish


def keys() -> PoseWish:
    """Return what the keys ask for while the current window has them.

    They are taken from ImGui's navigation, which keeps Tab.
    """
    key = imgui.Key
    focused = int(imgui.InputFlags_.route_focused)
    repeated = focused | int(imgui.InputFlags_.repeat)
    table: tuple[tuple[PoseWish, int, int], ...] = (
        ("next", int(key.down_arrow), repeated),
        ("next", int(key.right_arrow), repeated),
        ("previous", int(key.up_arrow), repeated),
        ("previous", int(key.left_arrow), repeated),
        ("first", int(key.home), focused),
        ("last", int(key.end), focused),
    )
    pressed = [wish for wish, chord, flags in table if imgui.shortcut(chord, flags)]
    return pressed[0] if pressed and not imgui.is_any_item_active() else ""


def _width(label: str) -> float:
    return imgui.calc_text_size(label).x + 2 * imgui.get_style().frame_padding.x
