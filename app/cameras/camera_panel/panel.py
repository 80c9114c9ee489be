"""The camera's panel: every number of the camera, to drag and to type.

Lays out the panel and words eye and basis. projection.py has the numbers of the projection,
sections.py the parts below. Takes a state and a draft and returns new ones.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from imgui_bundle import imgui

from lucida.app.cameras.basis import measures
from lucida.app.cameras.camera_panel.actions import go_home, go_to_canonical, switch_projection
from lucida.app.cameras.camera_panel.basis_numbers import basis_readout
from lucida.app.cameras.camera_panel.lens_section import lens_section
from lucida.app.cameras.camera_panel.projection import PanelContext, component, projection_numbers
from lucida.app.cameras.camera_panel.sections import (
    Sections,
    Wish,
    header,
    look_section,
    words_section,
)
from lucida.app.cameras.editing import BASIS, Draft
from lucida.app.state.app_state import AppState
from lucida.app.ui import pending, rows, theme
from lucida.app.ui.checks import checkbox, radio_button
from lucida.app.ui.explaining.symbols import spoken
from lucida.app.ui.fields import Scale

ROLES = {
    "eye": ("e", "", "The eye: where all viewing rays start (perspective)."),
    "u": ("u", "right", "u: to the right in the image. A pixel's `x` counts in lengths of u."),
    "v": ("v", "up", "v: up in the image. A pixel's `y` counts in lengths of v."),
    "w": ("w", "back", "w: backwards, against the view direction: the camera looks along -w."),
}
PERSPECTIVE = """\
All rays start at the eye and go through their pixel on the image plane:
`origin = eye,  direction = x*u + y*v - distance*w`"""
PARALLEL = """\
All rays go along -w and start at their pixel, on the plane of the eye:
`origin = eye + x*u + y*v,  direction = -w`"""
EXPOSURE = "In stops: +1 doubles the light of both images before it is shown."
ORTHONORMAL = """\
On: u, v, w stay of length 1 and at right angles; the others follow the one you edit.
Off: any three independent vectors: skewed, scaled or left-handed."""


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
    draft = panel.draft.following(state.camera)
    wish = _projection(state)
    rows.line()
    state, draft = _vectors(state, draft, around)
    found = measures(*(draft.following(state.camera).value(name) for name in BASIS))
    basis_readout(found, around.fonts.mono)
    state = _orthonormal(state)
    rows.line()
    state, draft = projection_numbers(state, draft, around)
    state = _exposure(state, around)
    draft = draft.following(state.camera)
    wish = _resets() or wish
    state, draft, sections, wanted = _sections(state, draft, panel.sections, around)
    draft, wish = draft.following(state.camera), wanted or wish
    if draft.error is not None:
        leaves = wish is not None and wish.leaves
        if pending.note("camera", str(draft.error), "Back to the camera shown") or leaves:
            draft = Draft.of(draft.camera)
    return state, PanelOutcome(draft, sections, wish)


def _projection(state: AppState) -> Wish | None:
    """Draw the two buttons."""
    parallel = state.camera.is_parallel
    half = imgui.get_content_region_avail().x / 2
    wanted = parallel
    if radio_button("perspective", not parallel):
        wanted = False
    rows.tip(spoken(PERSPECTIVE))
    style = imgui.get_style()
    if imgui.get_item_rect_size().x + style.item_spacing.x < half:  # else below: very large type
        imgui.same_line(style.window_padding.x + half)
    if radio_button("parallel", parallel):
        wanted = True
    rows.tip(spoken(PARALLEL))
    return None if wanted == parallel else Wish(switch_projection)


def _vectors(state: AppState, draft: Draft, around: PanelContext) -> tuple[AppState, Draft]:
    thirds = rows.Thirds()
    imgui.text_colored(theme.DIM, "")
    for axis, letter in enumerate("xyz"):
        thirds.go(axis)
        middle = (thirds.field_px - imgui.calc_text_size(letter).x) / 2
        imgui.set_cursor_pos_x(imgui.get_cursor_pos_x() + middle)
        imgui.text_colored(theme.DIM, letter)
    for name, (letter, role, tip) in ROLES.items():
        tooltip = spoken(tip)
        color = theme.BASIS.get(name, theme.PLAIN)
        rows.label(letter, role, color if name in BASIS else theme.TEXT, around.fonts, tooltip)
        reach = around.focus.reach if name == "eye" else 1.0
        for axis, letter in enumerate("xyz"):
            thirds.go(axis)
            # Around 0, unless the scene is far from there.
            middle = around.focus.center[axis] if name == "eye" else 0.0
            middle = middle if abs(middle) > reach else 0.0
            scale = Scale(middle - reach, middle + reach)
            place, width = (name, axis), thirds.field_px
            state, draft = component(
                state, draft, around, place, f"{name}.{letter}", width, scale, color, tooltip
            )
    return state, draft


def _orthonormal(state: AppState) -> AppState:
    changed, keep = checkbox("keep orthonormal", state.keep_orthonormal)
    rows.tip(ORTHONORMAL)
    return state.with_keep_orthonormal(keep) if changed else state


def _exposure(state: AppState, around: PanelContext) -> AppState:
    width = rows.row("exposure", "", EXPOSURE, around.fonts)
    value, scale = state.images.exposure_ev, Scale(-4.0, 4.0)
    changed, value = around.field("exposure", value, width, scale, EXPOSURE, reset=0.0, unit=" EV")
    if changed:
        state = state.with_options(replace(state.options.images, exposure_ev=value))
    return state


def _resets() -> Wish | None:
    """Draw the buttons of the two cameras to begin with."""
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
    opened: list[str] = []
    look = sections.look
    if header("Lens", sections):
        opened.append("Lens")
        state, draft = lens_section(state, draft, around)
    if header("K, R and t", sections):
        opened.append("K, R and t")
        state, wish = words_section(state, around.size, around.fonts)
    if header("Look at", sections):
        opened.append("Look at")
        look, wanted = look_section(look, state, around)
        wish = wish or wanted
    return state, draft, Sections(look, tuple(opened)), wish
