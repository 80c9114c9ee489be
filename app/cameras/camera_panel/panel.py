"""The camera's panel: every number of the camera, to drag and to type.

The module lays out the panel and draws eye and basis. projection.py has the numbers of the
projection, the other modules have the sections below them. They take a state and a draft and return
new ones.
"""

from __future__ import annotations

from dataclasses import dataclass

from imgui_bundle import imgui

from lucida.app.cameras.editing import BASIS, Draft
from lucida.app.state.app_state import AppState
from lucida.app.state.options.camera import CameraPart
from lucida.app.ui import rows, theme
from lucida.app.ui.checks import radio_button
from lucida.app.ui.fields import Scale
from lucida.app.ui.messages import wrapped

from .actions import go_home, go_to_canonical, switch_projection
from .lens_section import lens_section
from .more_section import more_section
from .projection import PanelContext, component, projection_numbers
from .sections import Sections, Wish, header, look_section, words_section

ROLES = {
    "eye": ("e", "eye", "The eye: where all viewing rays start (perspective)."),
    "u": (
        "u",
        "right",
        "u: right in the image. A pixel's position is measured in lengths of u.",
    ),
    "v": ("v", "up", "v: up in the image. A pixel's position is measured in lengths of v."),
    "w": ("w", "back", "w: backwards, against the view direction: the camera looks along -w."),
}
SECTIONS: tuple[CameraPart, ...] = ("More", "Lens", "K, R and t", "Look at")
PERSPECTIVE = """\
All rays start at the eye and go through their pixel on the image plane:
p = cam.e,  d = u*cam.u + v*cam.v - cam.d*cam.w"""
PARALLEL = """\
All rays go along -w and start at their pixel, on the plane of the eye:
p = cam.e + u*cam.u + v*cam.v,  d = -cam.w"""


@dataclass(frozen=True)
class PanelOutcome:
    """The panel's entries, and the effect of a click."""

    draft: Draft
    sections: Sections
    wish: Wish | None = None


def camera_panel(
    state: AppState, panel: PanelOutcome, around: PanelContext
) -> tuple[AppState, PanelOutcome]:
    """Draw the panel into the current window."""
    em, style = imgui.get_font_size(), imgui.get_style()
    imgui.push_style_var(imgui.StyleVar_.item_spacing, (style.item_spacing.x, 0.14 * em))
    imgui.push_style_var(imgui.StyleVar_.frame_padding, (style.frame_padding.x, 0.19 * em))
    try:
        return _panel(state, panel, around)
    finally:
        imgui.pop_style_var(2)


def _panel(
    state: AppState, panel: PanelOutcome, around: PanelContext
) -> tuple[AppState, PanelOutcome]:
    draft, options = panel.draft.following(state.camera), state.options.camera
    wish = _projection(state) if options.shows("projection") else None
    state, draft = _vectors(state, draft, around)
    state, draft = projection_numbers(state, draft, around)
    if not options.shown:
        wish = _resets() or wish
    state, draft, sections, wanted = _sections(state, draft, panel.sections, around)
    draft, wish = draft.following(state.camera), wanted or wish
    if draft.error is not None:  # at the end, so that no number moves
        wrapped(str(draft.error), theme.legible(theme.ERROR))
        if imgui.button("Back to the camera shown") or (wish is not None and wish.leaves):
            draft = Draft.of(draft.camera)
    return state, PanelOutcome(draft, sections, wish)


def _projection(state: AppState) -> Wish | None:
    """Draw the two buttons."""
    parallel = state.camera.is_parallel
    half = imgui.get_content_region_avail().x / 2
    wanted = parallel
    if radio_button("perspective", not parallel):
        wanted = False
    rows.tip(PERSPECTIVE)
    style = imgui.get_style()
    if imgui.get_item_rect_size().x + style.item_spacing.x < half:  # else: very large type
        imgui.same_line(style.window_padding.x + half)
    if radio_button("parallel", parallel):
        wanted = True
    rows.tip(PARALLEL)
    return None if wanted == parallel else Wish(switch_projection)


def _vectors(state: AppState, draft: Draft, around: PanelContext) -> tuple[AppState, Draft]:
    options = state.options.camera
    roles = [name for name in ROLES if options.shows("eye" if name == "eye" else "basis")]
    if not roles:
        return state, draft
    thirds = rows.Thirds()
    imgui.text_colored(theme.DIM, "")
    for axis, letter in enumerate("xyz"):
        thirds.go(axis)
        middle = (thirds.field_px - imgui.calc_text_size(letter).x) / 2
        imgui.set_cursor_pos_x(imgui.get_cursor_pos_x() + middle)
        imgui.text_colored(theme.DIM, letter)
    for name in roles:
        letter, role, tip = ROLES[name]
        color = theme.BASIS.get(name, theme.PLAIN)
        rows.label(letter, role, color if name in BASIS else theme.TEXT, around.fonts, tip)
        reach = around.focus.reach if name == "eye" else 1.0
        for axis, letter in enumerate("xyz"):
            thirds.go(axis)
            # Around 0, unless the scene is far from there.
            middle = around.focus.center[axis] if name == "eye" else 0.0
            middle = middle if abs(middle) > reach else 0.0
            scale = Scale(middle - reach, middle + reach)
            place, width = (name, axis), thirds.field_px
            state, draft = component(
                state, draft, around, place, f"{name}.{letter}", width, scale, color, tip
            )
    return state, draft


def _resets() -> Wish | None:
    """Draw the buttons of the two initial cameras."""
    wish = None
    width = (imgui.get_content_region_avail().x - imgui.get_style().item_spacing.x) / 2
    if imgui.button("Scene's view", (width, 0)):
        wish = Wish(go_home)
    rows.tip("Back to the camera that the scene came with (Home).")
    imgui.same_line()
    if imgui.button("Canonical", (width, 0)):
        wish = Wish(go_to_canonical)
    rows.tip(
        "The lecture's camera: at 0, its basis along the world's axes, the viewport 1 x 1 in front."
    )
    return wish


def _sections(
    state: AppState, draft: Draft, sections: Sections, around: PanelContext
) -> tuple[AppState, Draft, Sections, Wish | None]:
    wish: Wish | None = None
    look, shown = sections.look, state.options.camera.shown
    opened = []
    for name in SECTIONS:
        if not (name in shown if shown else header(name, sections)):
            continue
        opened.append(name)
        draft = draft.following(state.camera)
        if name == "More":
            state, draft = more_section(state, draft, around)
        elif name == "Lens":
            state, draft = lens_section(state, draft, around)
        elif name == "Look at":
            look, wanted = look_section(look, state, around)
            wish = wish or wanted
        else:
            state, wish = words_section(state, around.size, around.fonts)
    return state, draft, Sections(look, sections.opened if shown else tuple(opened)), wish
