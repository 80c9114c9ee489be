"""The inspector's lines for materials.

After a change, the selection has a material of its own.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from imgui_bundle import imgui

from lucida.app.instruments.objects.value_fields import Edits, color_line, number_line
from lucida.app.ui import rows, theme
from lucida.app.ui.checks import checkbox
from lucida.app.ui.fields import Scale
from lucida.renderer.editing.changing import Item, entry_of
from lucida.renderer.editing.materials import set_material, set_single_sided
from lucida.renderer.scene.model import Checker, Scene, Sphere
from lucida.renderer.scene.texture import Texture

SHININESS = Scale(1, 1000, logarithmic=True, least=1, most=1000)
CELLS = Scale(1e-2, 100, logarithmic=True)


def material_lines(edits: Edits, scene: Scene, items: Sequence[Item], fonts: theme.Fonts) -> None:
    """Draw the lines for the last of the items, into the current window."""
    rows.line()
    entry = entry_of(scene, items[-1])
    if isinstance(name := entry.fields.material, str):
        imgui.text_disabled(f"material {name}")
        rows.tip("The scene file shares it by this name. A change gives the selection its own.")

    def put(field: str, value: Any) -> None:
        edits.append(lambda scene: set_material(scene, items, field, value))

    def add(field: str, value: Any) -> None:
        if value is not None:
            put(field, value)

    made = entry.objects[0].material
    add("diffuse", color_line("diffuse", made.diffuse, "reflected to all sides", fonts))
    told = "of the highlight; with mirrors on, the part of the light that is reflected"
    add("specular", color_line("specular", made.specular, told, fonts))
    told = "the highlight's exponent: the larger, the smaller the highlight"
    add("shininess", number_line("shininess", made.shininess, SHININESS, told, fonts, 50.0))
    if made.checker is None:
        _texture_line(made.texture, put, fonts)
    if made.image is None:
        changed, on = checkbox("checker", made.checker is not None)
        rows.tip("every other cell of a pattern of cubes takes another colour")
        if changed:
            default = Checker()
            new = {"diffuse": list(default.diffuse), "size": default.size}
            put("checker", new if on else None)
        elif (checker := made.checker) is not None:
            told = "of every other cell"
            add("checker.diffuse", color_line("cells", checker.diffuse, told, fonts))
            told = "a cell's side"
            add("checker.size", number_line("side", checker.size, CELLS, told, fonts, 1.0))
    if not isinstance(entry.objects[0].shape, Sphere):
        is_on = all(part.material.single_sided for part in entry.objects)
        changed, on = checkbox("single-sided", is_on)
        rows.tip("not seen from behind, where corners go clockwise; the shadow stays")
        if changed:
            edits.append(lambda scene: set_single_sided(scene, items, on))


def _texture_line(
    texture: Texture | None, put: Callable[[str, Any], None], fonts: theme.Fonts
) -> None:
    told = "an image in the scene's folder or below it, which the diffuse colour multiplies"
    width = rows.row("texture", "", told, fonts)
    shown = texture.file.name if texture is not None and texture.file is not None else ""
    shown = shown or ("inside the model's file" if texture is not None else "")
    imgui.set_next_item_width(width)
    flags = imgui.InputTextFlags_.enter_returns_true | imgui.InputTextFlags_.auto_select_all
    done, name = imgui.input_text_with_hint("##texture", "name of a file", shown, int(flags))
    rows.tip(f"{told}; Enter takes it, an empty name takes it away")
    if done and name != shown:
        put("texture", name or None)
