"""Remedies for an image that is black because of the scene: no light, or everything is hidden.

Pure. The causes are those of renderer/compare/why_black.py; app/cameras/remedies.py has
the remedies by camera and exposure.
"""

from __future__ import annotations

from lucida.app.instruments.objects.choosing import chosen, rows_of
from lucida.app.instruments.objects.editing import with_scene
from lucida.app.state.app_state import AppState
from lucida.renderer.editing import objects
from lucida.renderer.editing.changing import set_field

ADD_LIGHT, SHOW_ALL = "Add a light", "Show all objects"


def scene_remedy(state: AppState, cause: str) -> str:
    """Return the label of a button that helps; "" if no edit of the scene does."""
    rows = rows_of(state.scene)
    if any(row.item is None for row in rows):  # made in Python
        return ""
    if cause == "light":
        return ADD_LIGHT
    hidden = cause == "empty" and any(row.hidden and not row.is_light for row in rows)
    return SHOW_ALL if hidden else ""


def remedied(state: AppState, remedy: str) -> AppState:
    """Return the state in which something is visible. Raises LucidaError.

    A new light shines along the camera's view, onto the visible side of the surfaces.
    """
    if remedy == ADD_LIGHT:
        scene, added = objects.add(state.scene, objects.new_table(state.scene, "directional"))
        way = [0.0 - part for part in state.camera.w]
        return with_scene(state, set_field(scene, added, "direction", way), added)
    hidden = [row.item for row in rows_of(state.scene) if row.hidden and not row.is_light]
    shown = objects.hide(state.scene, [item for item in hidden if item is not None], False)
    return with_scene(state, shown, chosen(state))
