"""The camera panel's section Lens: the model, its formula, its coefficients."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from imgui_bundle import imgui

from lucida.app.cameras.editing import Draft, edit_field
from lucida.app.cameras.lens_choices import KINDS, NO_LENS, PANORAMA, RADIUS, of_model, with_lens
from lucida.app.state.app_state import AppState
from lucida.app.ui import rows
from lucida.app.ui.fields import Scale
from lucida.app.ui.formula import formula
from lucida.renderer.camera.lenses import MODELS, Lens, coefficient_range, with_coefficient
from lucida.renderer.system.errors import LucidaError

from .projection import PanelContext

MODEL = "How the lens maps directions to the image plane."


def lens_section(state: AppState, draft: Draft, around: PanelContext) -> tuple[AppState, Draft]:
    """Draw the section into the current window."""
    state = _model(state, around)
    draft = draft.following(state.camera)
    if state.camera.lens is not None:
        state, draft = _numbers(state, draft, around, state.camera.lens)
    return state, draft


def _numbers(
    state: AppState, draft: Draft, around: PanelContext, lens: Lens
) -> tuple[AppState, Draft]:
    """Draw the formula and the coefficients."""
    kind, size_px = KINDS[lens.model], imgui.get_font_size()
    formula(kind.latex.split(r",\quad "), size_px, f"lens {lens.model}")
    is_panorama = lens.model in ("equirectangular", "cylindrical")
    rows.tip(PANORAMA if is_panorama else RADIUS)
    # Only files hold the prism's terms (s1, sx1, ...).
    names = [name for name in MODELS[lens.model] if not name.startswith("s")]
    return _coefficients(state, draft, around, names)


def _model(state: AppState, around: PanelContext) -> AppState:
    """Draw the choice of the model."""
    lens = state.camera.lens
    width = rows.row("model", "", MODEL, around.fonts)
    imgui.set_next_item_width(width)
    chosen = lens
    opened = imgui.begin_combo("##lens model", KINDS[lens.model].name if lens else NO_LENS)
    if not opened and lens is not None:
        rows.tip(KINDS[lens.model].note)
    if opened:
        if imgui.selectable(NO_LENS, lens is None)[0]:
            chosen = None
        for model, kind in KINDS.items():
            selected = lens is not None and lens.model == model
            if imgui.selectable(kind.name, selected)[0] and not selected:
                chosen = of_model(model)
            imgui.set_item_tooltip(kind.note)
        imgui.end_combo()
    if chosen == lens:
        return state
    return state.with_camera(with_lens(state.camera, chosen, around.focus.center))


def _coefficients(
    state: AppState, draft: Draft, around: PanelContext, names: Iterable[str]
) -> tuple[AppState, Draft]:
    """Draw the fields of coefficients, two in a line."""
    halves = rows.Halves()
    own = state.scene.view.camera.lens
    for column, name in enumerate(names):
        draft, lens = draft.following(state.camera), state.camera.lens
        if lens is None:
            break
        tooltip = f"The lens's coefficient {name}."
        width = halves.label(column % 2, name, tooltip)
        low, high = coefficient_range(lens.model, name)
        usual = own if own is not None and own.model == lens.model else of_model(lens.model)
        changed, value = around.field(
            f"lens.{name}",
            lens.coefficient(name),
            width,
            Scale(low, high, least=low, most=high),
            tooltip,
            wrong=draft.is_wrong(f"lens.{name}"),
            reset=usual.coefficient(name),
        )
        if changed:
            state, draft = _edited(state, draft, lens, name, value)
    return state, draft


def _edited(
    state: AppState, draft: Draft, lens: Lens, name: str, value: float
) -> tuple[AppState, Draft]:
    try:
        return edit_field(state, draft, "lens", with_coefficient(lens, name, value))
    except LucidaError as error:
        return state, replace(draft, error=error)
