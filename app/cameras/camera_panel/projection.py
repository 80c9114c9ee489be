"""The camera panel's numbers of the picture: distance, field of view, viewport, clip planes.

Takes a state and a draft and returns new ones, including the coupling between the numbers.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from imgui_bundle import ImVec4, imgui

from lucida.app.cameras.editing import Draft, edit_component, edit_field
from lucida.app.cameras.presets import clip_around
from lucida.app.state.app_state import AppState
from lucida.app.ui import rows, theme
from lucida.app.ui.checks import checkbox
from lucida.app.ui.explaining.symbols import program, spoken
from lucida.app.ui.fields import Scale, number_field
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.camera.navigation import depth_of, distance_for, dollied, with_shift
from lucida.renderer.scene.focus import Focus
from lucida.renderer.system.errors import LucidaError

VIEWPORT = (
    ("left", "The viewport's left edge, in units of u."),
    ("right", "The viewport's right edge, in units of u."),
    ("bottom", "The viewport's lower edge, in units of v."),
    ("top", "The viewport's upper edge, in units of v."),
)
RECTANGLE = "The rectangle of the image plane that is the image, in units of u and v."
SHIFTS = (
    ("x", "u", "Off-axis: the middle of the viewport along u. Its size stays."),
    ("y", "v", "Off-axis: the middle of the viewport along v. Its size stays."),
)
DISTANCE = "`distance`: how far the image plane lies from the eye along -w, in units of w."
FIELD_OF_VIEW = """\
The vertical angle between the viewport's lower and upper edge, seen from the eye.
It and `distance` are one number: the viewport stays, `distance` changes."""
DOLLY = """\
Dolly zoom: the eye goes back and `distance` grows with it, so that the scene's middle keeps its
size; only the perspective changes.
The number: how far the middle is from the eye, in units of w."""
PLANES = (
    ("near", "Nothing nearer is drawn: a plane, along -w in units of w. Off: fitted to the scene."),
    ("far", "Nothing farther is drawn: a plane, along -w in units of w. Off: fitted to the scene."),
)
FIT = """\
On: the viewport is widened or heightened to the image's shape.
Off: it is used as it stands, and the picture may look stretched."""
NO_EYE = "none, rays are parallel"

LEAST_FOV_DEG, MOST_FOV_DEG = 0.5, 175.0  # where dragging ends


@dataclass(frozen=True)
class PanelContext:
    """The panel's inputs besides the state.

    shown, size: the camera that the images are drawn with, and their size.
    """

    fonts: theme.Fonts
    shown: Camera
    size: Size
    focus: Focus

    def field(
        self,
        name: str,
        value: float,
        width_px: float,
        scale: Scale,
        tooltip: str,
        color: ImVec4 = theme.PLAIN,
        wrong: bool = False,
        reset: float | None = None,
        unit: str = "",
    ) -> tuple[bool, float]:
        """Draw a field. Return (whether it changed, its value). See number_field()."""
        mono = self.fonts.mono
        return number_field(name, value, width_px, scale, color, mono, tooltip, wrong, reset, unit)


def projection_numbers(
    state: AppState, draft: Draft, around: PanelContext
) -> tuple[AppState, Draft]:
    """Draw all numbers into the current window."""
    state, draft = _distance(state, draft.following(state.camera), around)
    state, draft = _field_of_view(state, draft.following(state.camera), around)
    state = _dolly(state, around)
    rows.line()
    state, draft = _viewport(state, draft.following(state.camera), around)
    state, draft = _shift(state, draft, around)
    return _clip(state, draft, around)


def component(
    state: AppState,
    draft: Draft,
    around: PanelContext,
    place: tuple[str, int],
    label: str,
    width_px: float,
    scale: Scale,
    color: ImVec4,
    tooltip: str,
) -> tuple[AppState, Draft]:
    """Draw one number of a field of several. Its menu resets it to the scene's own camera.

    place: the field's name, and the index of the number in it.
    """
    name, index = place
    draft = draft.following(state.camera)
    reset = getattr(state.scene.view.camera, name)[index]
    changed, value = around.field(
        label,
        draft.value(name)[index],
        width_px,
        scale,
        tooltip,
        color,
        draft.is_wrong(name),
        reset,
    )
    if imgui.is_item_activated():
        draft = draft.begun()
    if changed:
        state, draft = edit_component(state, draft, name, index, value)
    return state, draft


def _distance(state: AppState, draft: Draft, around: PanelContext) -> tuple[AppState, Draft]:
    notation = state.options.notation
    symbol, role = ("d", "distance") if notation == "book" else ("distance", "")
    tooltip = spoken(DISTANCE, notation)
    width = rows.row(symbol, role, tooltip, around.fonts)
    imgui.begin_disabled(state.camera.is_parallel)
    changed, value = around.field(
        "distance",
        draft.value("distance"),
        width,
        Scale(0.1 * _side(state), 10.0 * _side(state), logarithmic=True),
        tooltip,
        wrong=draft.is_wrong("distance"),
        reset=state.scene.view.camera.distance,
    )
    if imgui.is_item_activated():
        draft = draft.begun()
    imgui.end_disabled()
    return edit_field(state, draft, "distance", value) if changed else (state, draft)


def _field_of_view(state: AppState, draft: Draft, around: PanelContext) -> tuple[AppState, Draft]:
    """Draw the distance as an angle, of the viewport as drawn."""
    tooltip = spoken(FIELD_OF_VIEW, state.options.notation)
    width = rows.row("field of view", "", tooltip, around.fonts, derived=True)
    if state.camera.is_parallel:
        rows.instead(NO_EYE)
        return state, draft
    shown = around.shown
    if shown.distance != state.camera.distance:  # changed in this very frame
        shown = replace(shown, distance=state.camera.distance)
    changed, value = around.field(
        "field of view",
        shown.fov_y_deg,
        width,
        Scale(0.0, 120.0, least=LEAST_FOV_DEG, most=MOST_FOV_DEG)
        if shown.lens is None
        else Scale(0.0, 180.0, least=LEAST_FOV_DEG, most=359.0),
        tooltip,
        wrong=draft.is_wrong("field of view"),
        unit="\N{DEGREE SIGN} vertical",
    )
    if not changed:
        return state, draft
    try:
        distance = distance_for(shown, value)
    except LucidaError as error:
        return state, replace(draft, error=error)
    return edit_field(state, draft, "distance", distance)


def _dolly(state: AppState, around: PanelContext) -> AppState:
    tooltip = spoken(DOLLY, state.options.notation)
    width = rows.row("dolly zoom", "", tooltip, around.fonts, derived=True)
    camera, reach = state.camera, around.focus.reach
    depth = depth_of(camera, around.focus.center)
    if camera.is_parallel or not depth > 0:
        rows.instead(NO_EYE if camera.is_parallel else "none, the scene is behind the eye")
        return state
    scale = Scale(0.02 * reach, 20.0 * reach, logarithmic=True)
    changed, value = around.field("dolly zoom", depth, width, scale, tooltip, unit=" to the focus")
    if not (changed and value > 0):
        return state
    try:
        return state.with_camera(
            dollied(camera, around.focus.center, camera.distance * value / depth)
        )
    except (LucidaError, OverflowError):  # as far as numbers go
        return state


def _viewport(state: AppState, draft: Draft, around: PanelContext) -> tuple[AppState, Draft]:
    label = "fit" if rows.is_narrow() else "fit to the aspect ratio"
    rows.row("viewport", "", RECTANGLE, around.fonts)
    changed, fit = checkbox(f"{label}###fit to the aspect ratio", state.view.fit)
    rows.tip(FIT)
    if changed:
        state = state.with_fit(fit)
    halves = rows.Halves()
    for index, (name, tooltip) in enumerate(VIEWPORT):
        width = halves.label(index % 2, name, tooltip)
        color = theme.BASIS["u" if index < 2 else "v"]
        place, scale = ("viewport", index), _scale(state, around)
        state, draft = component(state, draft, around, place, name, width, scale, color, tooltip)
    return state, draft.following(state.camera)


def _shift(state: AppState, draft: Draft, around: PanelContext) -> tuple[AppState, Draft]:
    halves = rows.Halves()
    for axis, (place, vector, tooltip) in enumerate(SHIFTS):
        name = f"shift {program(place, state.options.notation)}"
        width = halves.label(axis, name, tooltip)
        low, high = state.camera.viewport[2 * axis : 2 * axis + 2]
        scale, color = _scale(state, around), theme.BASIS[vector]
        changed, value = around.field(
            name, (low + high) / 2, width, scale, tooltip, color, reset=0.0
        )
        if changed:
            try:
                state = state.with_camera(with_shift(state.camera, axis, value))
                draft = draft.following(state.camera)
            except LucidaError as error:
                draft = replace(draft, error=error)
    return state, draft


def _clip(state: AppState, draft: Draft, around: PanelContext) -> tuple[AppState, Draft]:
    """Draw near and far: each a switch and a field, which shows the fitted plane while it is
    off.
    """
    fitted = clip_around(around.shown, around.focus.bounds)
    reach, halves = around.focus.reach, rows.Halves()
    for column, (name, tooltip) in enumerate(PLANES):
        draft = draft.following(state.camera)
        halves.begin(column)
        entered = draft.value(name)
        changed, on = checkbox(name, entered is not None)
        rows.tip(tooltip)
        if changed:
            state, draft = edit_field(state, draft, name, fitted[column] if on else None)
            entered = draft.value(name)
        width = halves.field(column)
        imgui.begin_disabled(entered is None)
        changed, value = around.field(
            f"{name} plane",
            fitted[column] if entered is None else entered,
            width,
            Scale(0.01 * reach, 10.0 * reach, logarithmic=True),
            tooltip,
            wrong=draft.is_wrong(name),
            reset=fitted[column],
        )
        imgui.end_disabled()
        if changed:
            state, draft = edit_field(state, draft, name, value)
    return state, draft


def _scale(state: AppState, around: PanelContext) -> Scale:
    """Return the scale of the viewport's numbers: lengths for parallel rays, else slopes."""
    reach = around.focus.reach if state.camera.is_parallel else _side(state)
    return Scale(-reach, reach)


def _side(state: AppState) -> float:
    """Return the height of the viewport of the scene's own camera: small in a small scene."""
    _, _, bottom, top = state.scene.view.camera.viewport
    return top - bottom
