"""The inspector's lines for materials.

After a change, the selection has its own material.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from imgui_bundle import imgui

from lucida.app.ui import rows, theme
from lucida.app.ui.fields import Scale
from lucida.renderer.editing.changing import Item, entry_of
from lucida.renderer.editing.materials import set_material
from lucida.renderer.scene.model import Scene

from .value_fields import Edits, color_line, number_line

SHININESS = Scale(1, 1000, logarithmic=True, least=1, most=1000)


def material_lines(edits: Edits, scene: Scene, items: Sequence[Item], fonts: theme.Fonts) -> None:
    """Draw the lines for the last of the items, into the current window."""
    rows.line()
    entry = entry_of(scene, items[-1])
    if isinstance(name := entry.fields.material, str):
        imgui.text_disabled(f"material {name}")
        rows.tip("Objects share it by this name. A change gives the selection its own material.")

    def put(field: str, value: Any) -> None:
        if value is not None:
            edits.append(lambda scene: set_material(scene, items, field, value))

    made = entry.objects[0].material
    put("diffuse", color_line("diffuse", made.diffuse, "reflected in all directions", fonts))
    told = "of the highlight; with mirrors on, the reflected part of the light"
    put("specular", color_line("specular", made.specular, told, fonts))
    told = "the highlight's exponent: the larger, the smaller the highlight"
    put("shininess", number_line("shininess", made.shininess, SHININESS, told, fonts, 50.0))
