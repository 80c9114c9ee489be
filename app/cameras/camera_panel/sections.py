"""The camera panel's sections below its numbers: K, R and t, look at.

The module draws the widgets and returns the effects of clicks, which camera_panel/view.py runs.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, NamedTuple

from imgui_bundle import imgui

from lucida.app.cameras.other_words import TOLD, other_words
from lucida.app.state.app_state import AppState
from lucida.app.ui import rows, theme
from lucida.app.ui.checks import radio_button
from lucida.app.ui.fields import Scale
from lucida.app.ui.host import Host
from lucida.renderer.camera.checks import Vector
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.camera.intrinsics import PixelOrigin
from lucida.renderer.system.errors import LucidaError

from .actions import look_there
from .projection import PanelContext

ORIGINS: tuple[tuple[str, PixelOrigin], ...] = (("centres", "center"), ("corners", "corner"))
ORIGIN_NOTES: dict[PixelOrigin, str] = {
    "center": "The first pixel's centre is (0, 0), as in OpenCV.",
    "corner": "The image's corner is (0, 0), the first pixel's centre (0.5, 0.5), as in COLMAP.",
}
LOOK_FIELDS = (
    ("target", "The point in view: in the middle of an on-axis image."),
    ("up", "The direction that is up in the image; not along the view direction."),
)


@dataclass(frozen=True)
class LookAt:
    """The form's contents. target: None for a lecture step's target, or the scene's centre."""

    target: Vector | None = None
    up: Vector = (0.0, 1.0, 0.0)


@dataclass(frozen=True)
class Sections:
    """The contents of the sections, entered but not yet applied, and the names of the open ones."""

    look: LookAt = LookAt()
    opened: tuple[str, ...] = ()


class Wish(NamedTuple):
    """A click's effect. leaves: True if it moves the camera, which drops invalid numbers."""

    run: Callable[[Host], None]
    leaves: bool = True


def header(name: str, sections: Sections) -> bool:
    """Draw a section's header. Return True if it is open."""
    imgui.set_next_item_open(name in sections.opened, imgui.Cond_.always)
    opened = imgui.collapsing_header(name)
    if imgui.is_item_toggled_open():
        imgui.internal.mark_ini_settings_dirty()  # the session keeps it
    return opened


def look_section(look: LookAt, state: AppState, around: PanelContext) -> tuple[LookAt, Wish | None]:
    """Draw the form for target and up, seen from the eye."""
    thirds = rows.Thirds()
    target = look.target or state.options.outside.target or around.focus.center
    now = {"target": target, "up": look.up}
    for name, note in LOOK_FIELDS:
        imgui.align_text_to_frame_padding()
        imgui.text_colored(theme.TEXT, name)
        rows.tip(note)
        reach = 1.0 if name == "up" else around.focus.reach
        for axis, letter in enumerate("xyz"):
            thirds.go(axis)
            changed, value = around.field(
                f"look.{name}.{letter}",
                now[name][axis],
                thirds.field_px,
                Scale(-reach, reach),
                note,
                reset=(0.0, 1.0, 0.0)[axis] if name == "up" else None,
            )
            if changed:
                entered: dict[str, Any] = {name: (*now[name][:axis], value, *now[name][axis + 1 :])}
                look = replace(look, **entered)
    wish = None
    if imgui.button("Look there", (-1, 0)):
        wish = Wish(partial(look_there, target=now["target"], up=now["up"]))
    rows.tip(
        "w = from target to eye, of length 1;  u = up x w, of length 1;  v = w x u.\n"
        "Distance, viewport and projection stay."
    )
    return look, wish


def words_section(state: AppState, size: Size, fonts: theme.Fonts) -> tuple[AppState, Wish | None]:
    """Draw K, R and t of the current image."""
    origin = state.options.pixel_origin
    try:
        words = other_words(state.view, size, origin)
    except LucidaError as error:
        imgui.push_text_wrap_pos(0.0)
        imgui.text_colored(theme.DIM, f"No K, R and t: the projection {error.problem}.")
        imgui.pop_text_wrap_pos()
        return state, None
    imgui.text_colored(theme.DIM, "K intrinsics, R rotation, t translation")
    imgui.push_font(fonts.mono, 0.0)
    imgui.text("\n".join(words.read))
    imgui.pop_font()
    rows.tip(
        f"{TOLD},\nin images of {size[0]} x {size[1]} pixels; x to the right, y down, z forward."
    )
    if state.camera.lens is not None:
        imgui.text_colored(theme.DIM, "of the pinhole, without the lens")
    imgui.align_text_to_frame_padding()
    imgui.text_colored(theme.DIM, "integer coordinates at pixels'")
    for name, wanted in ORIGINS:
        if radio_button(name, origin == wanted):
            state = state.with_options(replace(state.options, pixel_origin=wanted))
        rows.tip(ORIGIN_NOTES[wanted])
        imgui.same_line()
    wish = None
    if imgui.button("Copy K, R, t", (-1, 0)):
        wish = Wish(partial(_copy_words, words=words.copied), leaves=False)
    rows.tip("With all digits, in a form that Python and Edit > Paste camera can read.")
    return state, wish


def _copy_words(host: Host, words: str) -> None:
    imgui.set_clipboard_text(words)
    host.files.say("K, R and t are on the clipboard.")
