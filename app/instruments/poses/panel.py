"""The panel of the view "Poses": the set and its commands, its list, the photograph.

Its functions take values and return requests.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Literal

import moderngl
from imgui_bundle import ImVec2, imgui

from lucida.app.state.options.poses import PosesOptions
from lucida.app.ui import theme
from lucida.app.ui.checks import checkbox
from lucida.app.ui.lettering import fitting_words, lettering
from lucida.app.ui.messages import wrapped
from lucida.app.ui.rows import follow, tip
from lucida.app.ui.theme import Fonts, framebuffer_scale
from lucida.renderer.system.errors import one_line

from .model import PoseSet

PoseWish = Literal["", "open", "close", "frame", "next", "previous", "first", "last", "lay"]
INVITATION = (
    "Open the cameras of a data set or of a reconstruction: a transforms.json (NeRF, nerfstudio),"
    " or a COLMAP model's folder, such as sparse/0. Each becomes a frustum in the outside view."
)
LAY = "on the images"
LAY_TOLD = "each pose's photograph over both images, as you step through (Image > Photograph)"
LISTED = imgui.ChildFlags_.borders | imgui.ChildFlags_.nav_flattened
PHOTO_PART = 0.45  # the photograph's share of the height, below the list


def invitation() -> PoseWish:
    """Draw the panel if no set is open."""
    wrapped(INVITATION)
    wish: PoseWish = "open" if imgui.button("Open cameras...") else ""
    wrapped("Or drop the file or the folder, or: lucida transforms.json", theme.DIM)
    return wish


def failed(name: str, problem: str) -> PoseWish:
    """Draw a set that cannot be read, in one line."""
    wrapped(problem, theme.ERROR)
    return _buttons(
        ("open", "Open cameras...", ""),
        ("close", "Close", f"Remove {one_line(name)} from the list"),
    )


def head(poses: PoseSet, options: PosesOptions, fonts: Fonts) -> tuple[PoseWish, PosesOptions]:
    """Draw the set and its commands. Return the changed options."""
    with lettering(fonts.bold):
        imgui.align_text_to_frame_padding()
        imgui.text(fitting_words(one_line(poses.title), imgui.get_content_region_avail().x))
    tip(one_line(str(poses.path)))
    counts = poses.counts
    follow(imgui.calc_text_size(counts).x)
    imgui.align_text_to_frame_padding()
    imgui.text_colored(theme.DIM, counts)
    if poses.told:
        tip("\n".join(poses.told))
    wish = _buttons(
        ("frame", "Frame the set", "the outside view sees all of its cameras and points"),
        ("open", "Open...", "another set"),
        ("close", "Close", "close the set; the camera stays"),
    )
    aligned = "the points as each camera sees them: they should line up with the photograph"
    if len(poses.points):
        points = _switch("points", options.points, "the reconstruction's points")
        reprojected = _switch("on photographs", options.reprojected, aligned)
        options = replace(options, points=points, reprojected=reprojected)
    return wish, options


def _switch(label: str, is_on: bool, said: str) -> bool:
    """Draw a checkbox in the same row. Return its value."""
    follow(imgui.calc_text_size(label).x + 1.5 * imgui.get_frame_height())
    is_on = checkbox(label, is_on)[1]
    tip(said)
    return is_on


def _buttons(*entries: tuple[PoseWish, str, str]) -> PoseWish:
    """Draw buttons in a row: request, label, tooltip. Return the request of the clicked one."""
    wish: PoseWish = ""
    for number, (name, label, said) in enumerate(entries):
        if number:
            follow(imgui.calc_text_size(label).x + 2 * imgui.get_style().frame_padding.x)
        if imgui.button(f"{label}###{name}"):
            wish = name
        if said:
            tip(said)
    return wish


def rows(poses: PoseSet, chosen: int, scroll: bool) -> int | None:
    """Draw the list. Return the number of the clicked row. Only visible rows are made.

    chosen: the number of the selected one, -1 for none. scroll: scroll to it; without a selection,
    to the first.
    """
    clicked = None
    below = PHOTO_PART * imgui.get_content_region_avail().y if chosen >= 0 else 0.0
    if imgui.begin_child("list", ImVec2(0, -below), LISTED):
        height = imgui.get_text_line_height_with_spacing()
        if scroll:
            top = height * max(chosen, 0)
            seen, tall = imgui.get_scroll_y(), imgui.get_window_height()
            if not seen <= top <= seen + tall - 3 * height:
                imgui.set_scroll_y(max(top - 0.4 * tall, 0.0))
        clipper = imgui.ListClipper()
        clipper.begin(len(poses.names), height)
        while clipper.step():
            for number in range(clipper.display_start, clipper.display_end):
                on = number == chosen
                if on:  # distinct from the one under the mouse
                    imgui.push_style_color(imgui.Col_.header, theme.FILL)
                    imgui.push_style_color(imgui.Col_.text, theme.rgb("#ffffff"))
                if imgui.selectable(f"{one_line(poses.names[number])}###{number}", on)[0]:
                    clicked = number
                imgui.pop_style_color(2 if on else 0)
    imgui.end_child()
    return clicked


def photograph(texture: moderngl.Texture | None, caption: str, laid: bool | None) -> PoseWish:
    """Draw the picture as large as possible, keeping its proportions, above its caption; without a
    picture, only the caption.

    laid: True if it is laid over the images; None if it cannot be.
    """
    wish: PoseWish = ""
    if imgui.begin_child("photograph", ImVec2(0, 0), imgui.ChildFlags_.nav_flattened):
        if laid is not None:
            if checkbox(LAY, laid)[0]:
                wish = "lay"
            tip(LAY_TOLD)
        if texture is not None:
            room, size = imgui.get_content_region_avail(), ImVec2(*texture.size)
            lines = imgui.calc_text_size(caption, False, room.x).y
            high = max(room.y - lines - imgui.get_style().item_spacing.y, 1.0)
            scale = min(room.x / size.x, high / size.y, 2.0 / framebuffer_scale())
            extent = ImVec2(max(scale * size.x, 1.0), max(scale * size.y, 1.0))
            imgui.image(imgui.ImTextureRef(texture.glo), extent)
        wrapped(caption, theme.DIM)
    imgui.end_child()
    return wish


def keys() -> PoseWish:
    """Return the request of a pressed key while the current window has the focus.

    The panel takes these keys from ImGui's navigation, which keeps Tab.
    """
    key, focused = imgui.Key, int(imgui.InputFlags_.route_focused)
    repeated = focused | int(imgui.InputFlags_.repeat)
    table: tuple[tuple[PoseWish, tuple[imgui.Key, ...], int], ...] = (
        ("next", (key.down_arrow, key.right_arrow), repeated),
        ("previous", (key.up_arrow, key.left_arrow), repeated),
        ("first", (key.home,), focused),
        ("last", (key.end,), focused),
    )
    pressed = [
        wish for wish, chords, flags in table for one in chords if imgui.shortcut(int(one), flags)
    ]
    return pressed[0] if pressed and not imgui.is_any_item_active() else ""
