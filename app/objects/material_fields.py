"""The inspector's lines for materials.

A material that several objects share is changed for all of them, or only for the selection, as the
user decides.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

from imgui_bundle import imgui

from app.objects.value_fields import Edits, color_line, number_line
from app.widgets import rows, theme
from app.widgets.checks import checkbox
from app.widgets.fields import Scale
from renderer.scene.model import Checker, Scene, Sphere
from renderer.scene.texture import Texture
from renderer.scene_editing import materials
from renderer.scene_editing.changing import Item, entry_of
from renderer.scene_editing.materials import (
    MaterialUse,
    material_of,
    set_material,
    set_single_sided,
)

OWN, OF_MODEL = "its own", "the model's own"
SHININESS = Scale(1, 1000, logarithmic=True, least=1, most=1000)
CELLS = Scale(1e-2, 100, logarithmic=True)


def material_lines(
    edits: Edits, scene: Scene, items: Sequence[Item], for_all: bool, fonts: theme.Fonts
) -> bool:
    """Draw the lines for the last of the items, into the current window. Return the new for_all."""
    rows.line()
    use = material_of(scene, items[-1])
    _which(edits, scene, items, use, fonts)
    others = set(use.users) - set(items)
    if use.name and others:
        count = len(use.users)
        _, for_all = checkbox(f"for all {count} that have it", for_all)
        rows.tip("otherwise the selection gets its own material")
    all_of_them = for_all or not others

    def put(field: str, value: Any) -> None:
        edits.append(lambda scene: set_material(scene, items, field, value, all_of_them))

    def add(field: str, value: Any) -> None:
        if value is not None:
            put(field, value)

    made = use.material
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
    parts = entry_of(scene, items[-1]).objects
    if not isinstance(parts[0].shape, Sphere):
        is_on = all(part.material.single_sided for part in parts)
        changed, on = checkbox("single-sided", is_on)
        rows.tip("not seen from behind, where corners go clockwise; the shadow stays")
        if changed:
            edits.append(lambda scene: set_single_sided(scene, items, on, all_of_them))
    return for_all


def _which(
    edits: Edits, scene: Scene, items: Sequence[Item], use: MaterialUse, fonts: theme.Fonts
) -> None:
    """Draw the choice of the material: the object's own, or one that has a name."""
    width = rows.row("material", "", "a name that several objects can share, or its own", fonts)
    imgui.set_next_item_width(width)
    if imgui.begin_combo("##material", use.name or (OF_MODEL if use.is_models else OWN)):
        names = materials.material_names(scene)
        for name in names:
            if imgui.selectable(name, name == use.name)[0] and name != use.name:
                edits.append(partial(materials.use_material, items=items, name=name))
        if names:
            imgui.separator()
        if imgui.selectable("Its own", False)[0]:
            edits.append(lambda scene: materials.own_material(scene, items))
        if not use.name and imgui.selectable("Share it under a name", False)[0]:
            free = (f"material {k}" for k in itertools.count(1))
            name = next(name for name in free if name not in names)
            edits.append(partial(materials.share_material, item=items[-1], name=name))
        imgui.end_combo()


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
