"""The camera's panel: every number of the camera, to drag and to type.

Owns the panel's order and words. Gets a state and a draft and returns new ones.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from imgui_bundle import ImVec4, imgui

from app import theme
from app.editing import BASIS, Draft, edit_component, edit_field
from app.focus import Focus
from app.navigation import switched_projection
from app.options import EXPOSURE_LIMIT_EV
from app.panels.fields import Scale, number_field, short_number
from app.state import AppState
from renderer.camera import Camera

ROLES = {
    "eye": ("eye", "", "The eye e: where all viewing rays start (perspective)."),
    "u": ("u", "right", "u: to the right in the image. A pixel's x counts in lengths of u."),
    "v": ("v", "up", "v: up in the image. A pixel's y counts in lengths of v."),
    "w": ("w", "back", "w: backwards, against the view direction: the camera looks along -w."),
}
VIEWPORT = (
    ("left", "The viewport's left edge, in units of u."),
    ("right", "The viewport's right edge, in units of u."),
    ("bottom", "The viewport's lower edge, in units of v."),
    ("top", "The viewport's upper edge, in units of v."),
)
PERSPECTIVE = """\
All rays start at the eye and go through their pixel on the image plane:
origin = e,  direction = x u + y v - d w"""
PARALLEL = """\
All rays go along -w and start at their pixel, on the plane of the eye:
origin = e + x u + y v,  direction = -w"""


@dataclass(frozen=True)
class Surroundings:
    """What the panel must know beside the state. shown: the camera that the images are drawn
    with."""

    fonts: theme.Fonts
    shown: Camera
    focus: Focus


def camera_panel(state: AppState, draft: Draft, around: Surroundings) -> tuple[AppState, Draft]:
    """Draws the panel into the current window."""
    draft = draft.following(state.camera)
    state = _projection(state, around)
    state, draft = _vectors(state, draft.following(state.camera), around)
    state = _orthonormal(state)
    _line()
    state, draft = _distance(state, draft.following(state.camera), around)
    state, draft = _viewport(state, draft, around)
    state = _fit(state, around)
    _line()
    state = _exposure(state, around)
    _line()
    state = _resets(state)
    draft = draft.following(state.camera)
    return state, _error(draft)


def _projection(state: AppState, around: Surroundings) -> AppState:
    parallel = state.camera.is_parallel
    half = imgui.get_content_region_avail().x / 2
    if imgui.radio_button("perspective", not parallel) and parallel:
        state = state.with_camera(switched_projection(state.camera, around.focus.center))
    imgui.set_item_tooltip(PERSPECTIVE)
    imgui.same_line(imgui.get_style().window_padding.x + half)
    if imgui.radio_button("parallel", parallel) and not parallel:
        state = state.with_camera(switched_projection(state.camera, around.focus.center))
    imgui.set_item_tooltip(PARALLEL)
    _line()
    return state


def _vectors(state: AppState, draft: Draft, around: Surroundings) -> tuple[AppState, Draft]:
    label_px, field_px = _columns(3)
    padding = imgui.get_style().window_padding.x
    spacing = imgui.get_style().item_inner_spacing.x
    for axis, letter in enumerate("xyz"):
        at = padding + label_px + axis * (field_px + spacing)
        width = imgui.calc_text_size(letter).x
        if axis:
            imgui.same_line()
        imgui.set_cursor_pos_x(at + (field_px - width) / 2)
        imgui.text_disabled(letter)
    for name, (label, role, tooltip) in ROLES.items():
        color = theme.BASIS.get(name, theme.PLAIN)
        _label(label, role, color if name in BASIS else theme.TEXT, around.fonts)
        imgui.set_item_tooltip(tooltip)
        scale = Scale(-1.0, 1.0)
        if name == "eye":
            scale = Scale(-around.focus.reach, around.focus.reach)
        for axis, letter in enumerate("xyz"):
            imgui.same_line(padding + label_px + axis * (field_px + spacing))
            state, draft = _component(
                state,
                draft,
                name,
                axis,
                f"{name}.{letter}",
                field_px,
                scale,
                color,
                tooltip,
                around,
            )
    return state, draft


def _distance(state: AppState, draft: Draft, around: Surroundings) -> tuple[AppState, Draft]:
    label_px, _ = _columns(1)
    padding = imgui.get_style().window_padding.x
    avail = imgui.get_content_region_avail().x
    tooltip = "d: how far the image plane lies from the eye along -w, in units of w."
    _label("d", "distance", theme.TEXT, around.fonts)
    imgui.set_item_tooltip(tooltip)
    imgui.same_line(padding + label_px)
    imgui.begin_disabled(state.camera.is_parallel)
    changed, value = number_field(
        "distance",
        draft.value("distance"),
        avail - label_px,
        Scale(0.1, 10.0, logarithmic=True),
        theme.PLAIN,
        around.fonts.mono,
        tooltip,
        draft.is_wrong("distance"),
    )
    imgui.end_disabled()
    if imgui.is_item_activated():
        draft = draft.begun()
    if changed:
        state, draft = edit_field(state, draft, "distance", value)
    imgui.align_text_to_frame_padding()
    imgui.text_colored(theme.DIM, "field of view")
    imgui.set_item_tooltip("Vertical: the angle between the viewport's lower and upper edge.")
    imgui.same_line(padding + label_px)
    imgui.push_font(around.fonts.mono, 0.0)
    if state.camera.is_parallel:
        imgui.text_colored(theme.DIM, "none, rays are parallel")
    else:
        imgui.text(f"{around.shown.fov_y_deg:8.2f}\N{DEGREE SIGN} vertical")
    imgui.pop_font()
    return state, draft


def _fit(state: AppState, around: Surroundings) -> AppState:
    changed, fit = imgui.checkbox("fit to the image's aspect ratio", state.view.fit)
    imgui.set_item_tooltip(
        "On: the viewport is widened or heightened to the image's shape.\n"
        "Off: it is used as it stands, and the picture may look stretched."
    )
    imgui.push_font(around.fonts.mono, 0.0)
    edges = "".join(map(short_number, around.shown.viewport))
    imgui.text_colored(theme.DIM, f"as drawn{edges}")
    imgui.set_item_tooltip("The viewport as drawn: left, right, bottom, top.")
    imgui.pop_font()
    return state.with_fit(fit) if changed else state


def _viewport(state: AppState, draft: Draft, around: Surroundings) -> tuple[AppState, Draft]:
    padding = imgui.get_style().window_padding.x
    avail = imgui.get_content_region_avail().x
    label_px, half = 3.2 * imgui.get_font_size(), avail / 2
    spacing = imgui.get_style().item_inner_spacing.x
    reach = around.focus.reach if state.camera.is_parallel else 1.0  # lengths, or slopes
    scale = Scale(-reach, reach)
    _line()
    _label("viewport", "in units of u and v", theme.TEXT, around.fonts)
    for index, (name, tooltip) in enumerate(VIEWPORT):
        column = index % 2
        if column:
            imgui.same_line(padding + half + spacing)
        imgui.align_text_to_frame_padding()
        imgui.text(name)
        imgui.set_item_tooltip(tooltip)
        imgui.same_line(padding + column * (half + spacing) + label_px)
        state, draft = _component(
            state,
            draft,
            "viewport",
            index,
            name,
            half - label_px - column * spacing,
            scale,
            theme.BASIS["u" if index < 2 else "v"],
            tooltip,
            around,
        )
    return state, draft


def _component(
    state: AppState,
    draft: Draft,
    name: str,
    index: int,
    label: str,
    width_px: float,
    scale: Scale,
    color: ImVec4,
    tooltip: str,
    around: Surroundings,
) -> tuple[AppState, Draft]:
    changed, value = number_field(
        label,
        draft.value(name)[index],
        width_px,
        scale,
        color,
        around.fonts.mono,
        tooltip,
        draft.is_wrong(name),
    )
    if imgui.is_item_activated():
        draft = draft.begun()
    if changed:
        state, draft = edit_component(state, draft, name, index, value)
    return state, draft


def _orthonormal(state: AppState) -> AppState:
    changed, keep = imgui.checkbox("keep orthonormal", state.keep_orthonormal)
    imgui.set_item_tooltip(
        "On: u, v, w stay of length 1 and at right angles; the others follow the one you edit.\n"
        "Off: any three independent vectors: skewed, scaled or left-handed."
    )
    return state.with_keep_orthonormal(keep) if changed else state


def _exposure(state: AppState, around: Surroundings) -> AppState:
    label_px, _ = _columns(1)
    _label("exposure", "", theme.TEXT, around.fonts)
    imgui.same_line(imgui.get_style().window_padding.x + label_px)
    changed, value = number_field(
        "exposure",
        state.images.exposure_ev,
        imgui.get_content_region_avail().x,
        Scale(-4.0, 4.0),
        theme.PLAIN,
        around.fonts.mono,
        "In stops: +1 doubles the light of both images before it is shown.",
    )
    if changed:
        value = min(max(value, -EXPOSURE_LIMIT_EV), EXPOSURE_LIMIT_EV) if value == value else 0.0
        state = state.with_options(images={"exposure_ev": value})
    return state


def _resets(state: AppState) -> AppState:
    width = (imgui.get_content_region_avail().x - imgui.get_style().item_spacing.x) / 2
    if imgui.button("Scene's view", (width, 0)):
        state = state.with_view(state.scene.view)
    imgui.set_item_tooltip("Back to the camera that the scene came with (Home).")
    imgui.same_line()
    if imgui.button("Canonical", (width, 0)):
        state = state.with_view(replace(state.view, camera=Camera.canonical()))
    imgui.set_item_tooltip(
        "The lecture's camera: eye 0, u = x, v = y, w = z, d = 1, viewport 1 x 1."
    )
    return state


def _error(draft: Draft) -> Draft:
    """What is wrong with the numbers, and a way back; its place is kept free."""
    if draft.error is None:
        return draft
    imgui.push_text_wrap_pos(0.0)
    imgui.text_colored(theme.ERROR, str(draft.error))
    imgui.pop_text_wrap_pos()
    if imgui.button("Back to the camera shown"):
        return Draft.of(draft.camera)
    return draft


def _label(text: str, role: str, color: ImVec4, fonts: theme.Fonts) -> None:
    imgui.begin_group()
    imgui.align_text_to_frame_padding()
    imgui.push_font(fonts.bold, 0.0)
    imgui.text_colored(color, text)
    imgui.pop_font()
    if role:
        imgui.same_line(0, 6)
        imgui.align_text_to_frame_padding()
        imgui.text_colored(theme.DIM, role)
    imgui.end_group()


def _columns(fields: int) -> tuple[float, float]:
    """Widths in pixels of the labels and of one of `fields` fields beside them."""
    avail = imgui.get_content_region_avail().x
    label = 4.4 * imgui.get_font_size() if fields == 3 else 5.6 * imgui.get_font_size()
    spacing = imgui.get_style().item_inner_spacing.x
    return label, (avail - label - (fields - 1) * spacing) / fields


def _line() -> None:
    imgui.dummy((0, 0))
    imgui.separator()
    imgui.dummy((0, 0))
