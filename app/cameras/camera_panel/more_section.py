"""The camera panel's section More: lengths and angles, shift, near and far, exposure."""

from __future__ import annotations

from dataclasses import replace

from imgui_bundle import imgui

from lucida.app.cameras.basis import measures
from lucida.app.cameras.editing import BASIS, Draft, edit_field
from lucida.app.cameras.presets import clip_around
from lucida.app.state.app_state import AppState
from lucida.app.ui import rows, theme
from lucida.app.ui.checks import checkbox
from lucida.app.ui.fields import Scale
from lucida.renderer.camera.navigation import depth_of, dollied, with_shift
from lucida.renderer.system.errors import LucidaError

from .basis_numbers import basis_readout
from .projection import NO_EYE, PanelContext, viewport_scale

SHIFTS = (
    ("u", "Off-axis: the middle of the viewport along u. Its size stays."),
    ("v", "Off-axis: the middle of the viewport along v. Its size stays."),
)
DOLLY = """\
Dolly zoom: the eye goes back and d grows with it, so that the scene's middle keeps its
size; only the perspective changes.
The number is the distance from the eye to the middle, in units of w."""
PLANES = (
    ("near", "Nothing before this plane is drawn: along -w, in units of w. Off: fits the scene."),
    ("far", "Nothing beyond this plane is drawn: along -w, in units of w. Off: fits the scene."),
)
ORTHONORMAL = """\
On: u, v, w stay of length 1 and at right angles; the others follow the one you edit.
Off: any three independent vectors: skewed, scaled or left-handed."""
EXPOSURE = "In stops: +1 doubles the light of both images before it is shown."


def more_section(state: AppState, draft: Draft, around: PanelContext) -> tuple[AppState, Draft]:
    """Draw the section into the current window."""
    found = measures(*(draft.following(state.camera).value(name) for name in BASIS))
    basis_readout(found, around.fonts.mono)
    state = _orthonormal(state)
    state, draft = _shift(state, draft.following(state.camera), around)
    state, draft = _clip(state, draft, around)
    state = _dolly(state, around)
    return _exposure(state, around), draft


def _orthonormal(state: AppState) -> AppState:
    changed, keep = checkbox("keep orthonormal", state.keep_orthonormal)
    rows.tip(ORTHONORMAL)
    return state.with_keep_orthonormal(keep) if changed else state


def _shift(state: AppState, draft: Draft, around: PanelContext) -> tuple[AppState, Draft]:
    halves = rows.Halves()
    for axis, (vector, tooltip) in enumerate(SHIFTS):
        name = f"shift {vector}"
        width = halves.label(axis, name, tooltip)
        low, high = state.camera.viewport[2 * axis : 2 * axis + 2]
        scale, color = viewport_scale(state, around), theme.BASIS[vector]
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


def _dolly(state: AppState, around: PanelContext) -> AppState:
    width = rows.row("dolly zoom", "", DOLLY, around.fonts, derived=True)
    camera, reach = state.camera, around.focus.reach
    depth = depth_of(camera, around.focus.center)
    if camera.is_parallel or not depth > 0:
        why = "behind the eye" if state.scene.visible else "empty"
        rows.instead(NO_EYE if camera.is_parallel else f"none, the scene is {why}")
        return state
    scale = Scale(0.02 * reach, 20.0 * reach, logarithmic=True)
    changed, value = around.field("dolly zoom", depth, width, scale, DOLLY, unit=" to the focus")
    if not (changed and value > 0):
        return state
    try:
        return state.with_camera(
            dollied(camera, around.focus.center, camera.distance * value / depth)
        )
    except (LucidaError, OverflowError):  # at the limits of the number range
        return state


def _exposure(state: AppState, around: PanelContext) -> AppState:
    width = rows.row("exposure", "", EXPOSURE, around.fonts)
    value, scale = state.images.exposure_ev, Scale(-4.0, 4.0)
    changed, value = around.field("exposure", value, width, scale, EXPOSURE, reset=0.0, unit=" EV")
    if changed:
        state = state.with_options(replace(state.options.images, exposure_ev=value))
    return state
