"""The change of an undo step, in a few words."""

from __future__ import annotations

from dataclasses import fields, is_dataclass
from typing import Any

from lucida.app.state.app_state import AppState

WORDS = {
    "samples": "samples per pixel",
    "one_based": "pixels counted from 1",
    "fit": "fit to the aspect ratio",
}


def change(before: AppState, after: AppState) -> str:
    """Return the difference of one state from the last: `camera: eye, w`."""
    if after.step is not None and before.step != after.step:
        _, step, build = after.step
        return f"lecture: step {step + 1}" + (f".{build + 1}" if build else "")
    if before.scene is not after.scene:
        return f"scene: {after.scene.name or 'without a name'}"
    parts = []
    camera = _changed(before.camera, after.camera)
    if camera:
        parts.append("camera: " + (", ".join(camera) if len(camera) < 4 else "view"))
    if before.view.fit != after.view.fit:
        parts.append(WORDS["fit"])
    if before.keep_orthonormal != after.keep_orthonormal and not parts:
        parts.append("keep orthonormal")
    parts += _changed(before.options, after.looking_as(before).options)
    return ", ".join(parts[:3]) or "nothing visible"


def _changed(before: Any, after: Any) -> list[str]:
    """Return the names of the fields that differ; for a part, those of its fields."""
    names: list[str] = []
    for field in fields(before):
        old, new = getattr(before, field.name), getattr(after, field.name)
        if old == new or field.name == "marked_size":  # it changes with the mark
            continue
        if is_dataclass(old) and type(old) is type(new):
            names += _changed(old, new)
        else:
            names.append(WORDS.get(field.name, field.name.replace("_", " ")))
    return names
