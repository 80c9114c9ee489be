"""The `options` of a step: changes of the window's options (app/options.py), by their own names.

Owns the check of values that the options' types do not make. Knows nothing of steps. Whatever is
added to the options can be set in a lecture at once.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from typing import Any, get_args, get_type_hints

import msgspec

from app.options import (
    CYCLES_S,
    EXPOSURE_LIMIT_EV,
    LARGEST_ZOOM,
    MAGNIFICATIONS,
    PIXEL_SIZES,
    Options,
)
from app.teach.lecture.under import under
from app.teach.recording import check_canvas
from renderer.camera import Camera
from renderer.errors import LucidaError
from renderer.frame import check_size
from renderer.scene.reading import suggestion
from renderer.scene.tables import to_struct
from renderer.scene.views import view_from_table

LARGEST_BUNDLE = 64  # rows, or columns, of viewing rays

# What a view could not draw otherwise.
RANGES = {
    "images.exposure_ev": (-EXPOSURE_LIMIT_EV, EXPOSURE_LIMIT_EV),
    "images.magnification": (MAGNIFICATIONS[0], MAGNIFICATIONS[-1]),
    "laboratory.side_px": (3, 300),
    "laboratory.zoom": (1, LARGEST_ZOOM),
    "laboratory.phase": (0, 1),
    "laboratory.cycle_s": CYCLES_S,
}

OWN = ("preferences", "bookmarks")  # the user's own, which no step changes
ELSEWHERE = (*OWN, "marked", "highlight")  # what has a field of its own in a step

NAMES = tuple(entry.name for entry in fields(Options) if entry.name not in ELSEWHERE)


def options_from_table(tables: dict[str, Any]) -> dict[str, Any]:
    """The changes as AppState.with_options() takes them. Raises LucidaError."""
    types = get_type_hints(Options)
    changes: dict[str, Any] = {}
    for name, value in tables.items():
        if name not in NAMES:
            raise LucidaError(name, "is unknown", suggestion(name, NAMES))
        kind = types[name]
        if not is_dataclass(kind):
            changes[name] = getattr(to_struct({name: value}, _struct(Options)), name)
        elif not isinstance(value, dict):
            raise LucidaError(name, "is not a table", f"give e.g. {name}.{fields(kind)[0].name}")
        else:
            with under(name):
                changes[name] = _part(kind, value)
    _check(changes)
    return changes


def _part(kind: Any, table: dict[str, Any]) -> dict[str, Any]:
    """Changes of one part of the options; its cameras are tables as in a scene file."""
    types = get_type_hints(kind)
    changes: dict[str, Any] = {}
    for name, value in table.items():
        if Camera in get_args(types.get(name)) and isinstance(value, dict):
            with under(name):
                changes[name] = _camera(value)
    others = {name: value for name, value in table.items() if name not in changes}
    struct = to_struct(others, _struct(kind))
    return changes | {name: getattr(struct, name) for name in others}


def _numbers(value: Any, field: str = "") -> Iterator[tuple[str, float]]:
    """Every float below a value, with its field's path."""
    if isinstance(value, float):
        yield field, value
    elif isinstance(value, dict):
        for name, part in value.items():
            yield from _numbers(part, f"{field}.{name}" if field else name)
    elif isinstance(value, tuple):
        for number, part in enumerate(value):
            yield from _numbers(part, f"{field}[{number}]")


def _camera(table: dict[str, Any]) -> Camera:
    try:
        return view_from_table(table).camera
    except LucidaError as error:  # without its own "camera.", the field is named already
        field = error.field.removeprefix("camera").removeprefix(".")
        raise LucidaError(field, error.problem, error.remedy) from None


def _struct(kind: Any) -> type[msgspec.Struct]:
    """A structure of a dataclass's fields, all optional, in which an unknown one is an error."""
    types = get_type_hints(kind)
    kept = [
        (entry.name, types[entry.name], None)
        for entry in fields(kind)
        if Camera not in get_args(types[entry.name])
    ]
    return msgspec.defstruct(kind.__name__, kept, forbid_unknown_fields=True)


def _check(changes: dict[str, Any]) -> None:
    for field, value in _numbers(changes):
        if not math.isfinite(value):
            raise LucidaError(field, f"{value:g} is not finite", "give a finite number")
    images, outside = changes.get("images", {}), changes.get("outside", {})
    size = images.get("pixel_size", PIXEL_SIZES[0])
    if size not in PIXEL_SIZES:
        allowed = ", ".join(map(str, PIXEL_SIZES))
        raise LucidaError("images.pixel_size", f"{size} is not possible", f"give one of {allowed}")
    for field, (least, most) in RANGES.items():
        part, name = field.split(".")
        value = changes.get(part, {}).get(name)
        if value is not None and not least <= value <= most:
            raise LucidaError(field, f"{value:g} is out of range", f"give {least:g} to {most:g}")
    if images.get("resolution") is not None:
        try:
            check_size(images["resolution"])
        except LucidaError as error:
            raise LucidaError("images.resolution", error.problem, error.remedy) from None
    if any(not 0 <= side <= LARGEST_BUNDLE for side in outside.get("bundle", ())):
        raise LucidaError(
            "outside.bundle", "is out of range", f"give rows and columns up to {LARGEST_BUNDLE}"
        )
    if "canvas" in changes.get("stepper", {}):
        try:
            check_canvas(changes["stepper"]["canvas"])
        except LucidaError as error:
            raise LucidaError("stepper.canvas", error.problem, error.remedy) from None
