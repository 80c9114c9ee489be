"""The selection in numbers: an object's name, shape, place and material, or a light's; without a
selection, the scene's own.

Each line edits a field of the file. The panel takes a state and returns another. An invalid number
is reported; the last valid one stays.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import msgspec
from imgui_bundle import imgui

from lucida.app.state.app_state import AppState
from lucida.app.ui import rows, theme
from lucida.app.ui.checks import checkbox
from lucida.app.ui.fields import Scale
from lucida.app.ui.lettering import fitting_words
from lucida.renderer.editing import objects
from lucida.renderer.editing.changing import Item, fields_of
from lucida.renderer.editing.outline import OutlineRow
from lucida.renderer.files.schema import (
    LightTable,
    MeshTable,
    ModelTable,
    ObjectTable,
    PointLightTable,
    SphereTable,
)
from lucida.renderer.scene.focus import Focus
from lucida.renderer.scene.material import parse_color
from lucida.renderer.scene.model import Scene
from lucida.renderer.system.errors import LucidaError

from .choosing import chosen, rows_of
from .editing import with_scene
from .material_fields import material_lines
from .outliner import SHOWN
from .value_fields import Edits, color_line, light_lines, number_line, vector_line, whole_line

COMMON = {*ObjectTable.__struct_fields__, *LightTable.__struct_fields__}
PLACED = {"translate", "rotate_deg", "scale", "center", "position", "direction", "file"}
NOTHING = "Select an object: double-click it in a view, or click it in the list."
TOLD = {
    "radius": "from the middle to the surface, in world units",
    "tube_radius": "of the tube around the ring",
    "segments": "parts around",
    "sides": "parts around the tube",
    "smooth": "interpolate normals, as on a curved surface",
    "size": "the sides along x, y and z",
    "translate": "its position, added last",
    "rotate_deg": "degrees about the world's x, then y, then z axis",
    "scale": "factors along its own axes, applied first",
    "center": "its position",
    "position": "where the light is",
    "direction": "the direction from the light to the scene",
}


@dataclass(frozen=True)
class Inspector:
    """The inspector's state between frames.

    problem: the reason why the last number was rejected.
    about: the selection at that time.
    """

    problem: str = ""
    about: tuple[Item, ...] = ()


@dataclass(frozen=True)
class PanelSetting:
    """The panel's inputs in addition to the state."""

    fonts: theme.Fonts
    focus: Focus

    @property
    def axes(self) -> list[Scale]:
        """Return the scales for a place in the world, around 0 unless the scene is far away."""
        reach = self.focus.reach
        middles = (middle if abs(middle) > reach else 0.0 for middle in self.focus.center)
        return [Scale(middle - reach, middle + reach) for middle in middles]

    @property
    def lengths(self) -> Scale:
        reach = self.focus.reach
        return Scale(1e-3 * reach, 10 * reach, logarithmic=True)


def inspector_panel(
    inspector: Inspector, state: AppState, around: PanelSetting
) -> tuple[Inspector, AppState]:
    """Draw the panel into the current window."""
    em, style = imgui.get_font_size(), imgui.get_style()
    imgui.push_style_var(imgui.StyleVar_.item_spacing, (style.item_spacing.x, 0.25 * em))
    try:
        return _panel(inspector, state, around)
    finally:
        imgui.pop_style_var()


def _panel(
    inspector: Inspector, state: AppState, around: PanelSetting
) -> tuple[Inspector, AppState]:
    items = chosen(state)
    if items != inspector.about:
        inspector = replace(inspector, problem="", about=items)
    edits = Edits()
    if not items:
        imgui.push_text_wrap_pos(0.0)
        imgui.text_disabled(NOTHING)
        imgui.pop_text_wrap_pos()
        rows.line()
        _scene_lines(edits, state.scene, around)
    else:
        wanted = set(items)
        listed = [row for row in rows_of(state.scene) if row.item in wanted]
        row = next(row for row in listed if row.item == items[-1])
        _head(edits, row, items)
        fields = fields_of(state.scene, items[-1])
        if len(items) == 1:
            if isinstance(fields, LightTable):
                _light_lines(edits, items, fields, around)
            else:
                _shape_lines(edits, items, fields, around)
                _place_lines(edits, items, fields, around)
        of_objects = tuple(row.item for row in listed if not row.is_light and row.item is not None)
        if of_objects:
            material_lines(edits, state.scene, of_objects, around.fonts)
    for edit in edits:
        try:
            state = with_scene(state, edit(state.scene))
            inspector = replace(inspector, problem="")
        except LucidaError as error:
            inspector = replace(inspector, problem=str(error))
    if inspector.problem:
        imgui.push_text_wrap_pos(0.0)
        imgui.text_colored(theme.ERROR, inspector.problem)
        imgui.pop_text_wrap_pos()
    return inspector, state


def _head(edits: Edits, row: OutlineRow, items: Sequence[Item]) -> None:
    if len(items) > 1:
        imgui.align_text_to_frame_padding()
        told = f"{len(items)} selected; the last: {row.shown}"
        imgui.text(fitting_words(told, imgui.get_content_region_avail().x))
    else:
        imgui.set_next_item_width(-1)
        changed, name = imgui.input_text_with_hint("##name", row.shown, row.name)
        rows.tip("its name")
        if changed:
            edits.append(lambda scene: objects.rename(scene, items[0], name))
    changed, on = checkbox("shown", not row.hidden)
    rows.tip("Light on" if row.is_light else SHOWN)
    if changed:
        edits.append(lambda scene: objects.hide(scene, items, not on))
    imgui.same_line()
    kind = f"{row.kind} light" if row.is_light else row.kind
    triangles = f", {row.triangles:,} triangles" if row.triangles else ""
    imgui.text_disabled(f"{kind}{triangles}")
    if row.file:
        imgui.same_line()
        imgui.text_disabled(row.file)


def _shape_lines(edits: Edits, items: Sequence[Item], fields: Any, around: PanelSetting) -> None:
    """Draw the fields of a kind of shape."""
    if isinstance(fields, ModelTable):
        return
    rows.line()
    for field in msgspec.structs.fields(type(fields)):
        if field.name not in COMMON | PLACED:
            value, label = getattr(fields, field.name), field.name.replace("_", " ")
            tooltip = TOLD.get(field.name, label)
            edits.set(items, field.name, _value_line(label, value, tooltip, field.default, around))


def _value_line(label: str, value: Any, tooltip: str, default: Any, around: PanelSetting) -> Any:
    fonts = around.fonts
    if isinstance(value, bool):
        changed, on = checkbox(label, value)
        rows.tip(tooltip)
        return on if changed else None
    if isinstance(value, int) and not isinstance(default, float):
        scale = Scale(3, 256, logarithmic=True, least=3, most=1000, whole=True)
        return whole_line(label, value, scale, tooltip, fonts, default)
    if isinstance(value, int | float):
        return number_line(label, value, around.lengths, tooltip, fonts, default)
    reset = (default,) * 3 if isinstance(default, int | float) else default
    return vector_line(label, value, [around.lengths] * 3, tooltip, fonts, reset)


def _place_lines(
    edits: Edits, items: Sequence[Item], fields: SphereTable | MeshTable, around: PanelSetting
) -> None:
    """Draw the place."""
    rows.line()
    fonts = around.fonts

    def line(
        name: str, label: str, scales: Sequence[Scale], reset: tuple[int, int, int], unit: str = ""
    ) -> None:
        value = getattr(fields, name)
        edits.set(items, name, vector_line(label, value, scales, TOLD[name], fonts, reset, unit))

    if isinstance(fields, SphereTable):
        line("center", "centre", around.axes, (0, 0, 0))
        return
    line("translate", "move", around.axes, (0, 0, 0))
    line("rotate_deg", "turn", [Scale(-180, 180)] * 3, (0, 0, 0), "°")
    scale, factors = fields.scale, Scale(0.05, 20, logarithmic=True)
    if isinstance(scale, int | float):
        edits.set(items, "scale", number_line("scale", scale, factors, TOLD["scale"], fonts, 1.0))
    else:
        line("scale", "scale", [factors if k > 0 else Scale(-20, 20) for k in scale], (1, 1, 1))


def _light_lines(
    edits: Edits, items: Sequence[Item], fields: LightTable, around: PanelSetting
) -> None:
    rows.line()
    fonts, is_point = around.fonts, isinstance(fields, PointLightTable)
    name = "position" if is_point else "direction"
    axes, reset = (around.axes, (0, 0, 0)) if is_point else ([Scale(-1, 1)] * 3, (0, -1, 0))
    value = getattr(fields, name)
    edits.set(items, name, vector_line(name, value, axes, TOLD[name], fonts, reset))
    rgb = parse_color("color", fields.color)
    edits.set(items, "color", light_lines(rgb, "of the light", fonts))


def _scene_lines(edits: Edits, scene: Scene, around: PanelSetting) -> None:
    """Draw the scene's own numbers."""
    imgui.set_next_item_width(-1)
    changed, name = imgui.input_text_with_hint("##scene name", "name of the scene", scene.name)
    rows.tip("its name: in the title, and in the status line")
    if changed:
        edits.set_scene("name", name)
    for field, label, told in (
        ("background", "sky", "the colour of rays that hit no object"),
        ("ambient", "ambient", "light from everywhere, which each surface reflects"),
    ):
        edits.set_scene(field, color_line(label, getattr(scene, field), told, around.fonts))
