"""The table of a step at each of its builds. Fields that a build leaves out keep their previous
values.
"""

from __future__ import annotations

from typing import Any

from msgspec.structs import replace

from lucida.renderer.files.views import LOOK_AT, looks_at, view_from_table, view_table
from lucida.renderer.scene.model import View

from .schema import BuildTable, StepTable
from .text import extended

_BY_BASIS = {"u", "v", "w", "viewport"}  # fields that a camera with a target lacks


def inherited(table: StepTable, build: BuildTable, view: View) -> StepTable:
    """Return a step's table at a build. table, view: at the previous build. Raises LucidaError."""
    text = build.instead or (extended(table.text, build.text) if build.text else table.text)
    camera = build.camera
    if isinstance(camera, dict):
        before = table.camera if isinstance(table.camera, dict) else view_table(view)
        camera = _camera(before, camera)
    return replace(
        table,
        text=text,
        scene=build.scene or table.scene,
        camera=table.camera if camera is None else camera,
        views=table.views if build.views is None else build.views,
        options=_merged(table.options, build.options),
        pixel=table.pixel if build.pixel is None else build.pixel,
    )


def changed_view(view: View, changes: dict[str, Any]) -> View:
    """Return a view with changed fields of its camera. Raises LucidaError."""
    return view_from_table(_camera(view_table(view), changes))


def _merged(before: dict[str, Any], changes: dict[str, Any]) -> dict[str, Any]:
    """Return options with changes. Tables inside them are merged in the same way."""
    merged = before | changes
    for name, value in changes.items():
        old = before.get(name)
        if isinstance(old, dict) and isinstance(value, dict):
            merged[name] = (_camera if name == "camera" else _merged)(old, value)
    return merged


def _camera(before: dict[str, Any], changes: dict[str, Any]) -> dict[str, Any]:
    """Return a camera's table with changed fields: by its target, or by its basis."""
    if looks_at(changes):
        before = {name: value for name, value in before.items() if name not in _BY_BASIS}
    elif looks_at(before) and not _BY_BASIS.isdisjoint(changes):
        before = {k: v for k, v in view_table(view_from_table(before)).items() if k not in LOOK_AT}
    return before | changes
