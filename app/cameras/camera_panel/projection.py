"""The camera panel's numbers of the picture: distance, field of view, viewport.

Its functions take a state and a draft and return new ones, in which coupled numbers agree.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from imgui_bundle import ImVec4, imgui

from lucida.app.cameras.editing import Draft, edit_component, edit_field
from lucida.app.state.app_state import AppState
from lucida.app.ui import rows, theme
from lucida.app.ui.checks import checkbox
from lucida.app.ui.fields import Scale, number_field
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.camera.navigation import distance_for
from lucida.renderer.scene.focus import Focus
from lucida.renderer.system.errors import LucidaError

VIEWPORT = (
    ("left", "The viewport's left edge, in units of u."),
    ("right", "The viewport's right edge, in units of u."),
    ("bottom", "The viewport's lower edge, in units of v."),
    ("top", "The viewport's upper edge, in units of v."),
)
RECTANGLE = "The image's rectangle on the image plane, in units of u and v."
DISTANCE = "d: the distance from the eye to the image plane along -w, in units of w."
FIELD_OF_VIEW = """\
The vertical angle between the viewport's lower and upper edge, seen from the eye.
It determines d: the viewport stays, d changes."""
FIT = """\
On: the viewport is widened or heightened to the image's shape.
Off: it is used unchanged, and the picture may look stretched."""
NO_EYE = "none, rays are parallel"

LEAST_FOV_DEG, MOST_FOV_DEG = 0.5, 175.0  # the limits of dragging


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
        """Draw a field. Return (True if it changed, its value). See number_field()."""
        mono = self.fonts.mono
        return number_field(name, value, width_px, scale, color, mono, tooltip, wrong, reset, unit)


def projection_numbers(
    state: AppState, draft: Draft, around: PanelContext
) -> tuple[AppState, Draft]:
    """Draw the visible numbers into the current window."""
    options = state.options.camera
    if options.shows("d"):
        state, draft = _distance(state, draft.following(state.camera), around)
        state, draft = _field_of_view(state, draft.following(state.camera), around)
        rows.line()
    if options.shows("viewport"):
        state, draft = _viewport(state, draft.following(state.camera), around)
    return state, draft


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
    width = rows.row("d", "distance", DISTANCE, around.fonts)
    imgui.begin_disabled(state.camera.is_parallel)
    changed, value = around.field(
        "distance",
        draft.value("distance"),
        width,
        Scale(0.1 * _side(state), 10.0 * _side(state), logarithmic=True),
        DISTANCE,
        wrong=draft.is_wrong("distance"),
        reset=state.scene.view.camera.distance,
    )
    if imgui.is_item_activated():
        draft = draft.begun()
    imgui.end_disabled()
    return edit_field(state, draft, "distance", value) if changed else (state, draft)


def _field_of_view(state: AppState, draft: Draft, around: PanelContext) -> tuple[AppState, Draft]:
    """Draw the distance as an angle: the field of view of the viewport as drawn."""
    width = rows.row("field of view", "", FIELD_OF_VIEW, around.fonts, derived=True)
    if state.camera.is_parallel:
        rows.instead(NO_EYE)
        return state, draft
    shown = around.shown
    if shown.distance != state.camera.distance:  # changed in this frame
        shown = replace(shown, distance=state.camera.distance)
    changed, value = around.field(
        "field of view",
        shown.fov_y_deg,
        width,
        Scale(0.0, 120.0, least=LEAST_FOV_DEG, most=MOST_FOV_DEG)
        if shown.lens is None
        else Scale(0.0, 180.0, least=LEAST_FOV_DEG, most=359.0),
        FIELD_OF_VIEW,
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
        place, scale = ("viewport", index), viewport_scale(state, around)
        state, draft = component(state, draft, around, place, name, width, scale, color, tooltip)
    return state, draft.following(state.camera)


def viewport_scale(state: AppState, around: PanelContext) -> Scale:
    """Return the scale of the viewport's numbers: lengths for parallel rays, else slopes."""
    reach = around.focus.reach if state.camera.is_parallel else _side(state)
    return Scale(-reach, reach)


def _side(state: AppState) -> float:
    """Return the height of the viewport of the scene's own camera: small in a small scene."""
    _, _, bottom, top = state.scene.view.camera.viewport
    return top - bottom
