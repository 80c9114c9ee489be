"""View files, VIEW.toml, and [camera] tables, which store a camera exactly."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.lenses import MODELS, Lens
from lucida.renderer.scene.limits import TOML_BYTES
from lucida.renderer.scene.model import View
from lucida.renderer.system.atomic import atomic_write
from lucida.renderer.system.errors import LucidaError, not_together, under

from .reading import decode_text, naming, path_of, read_file
from .schema import CameraFields, LookAtFields, ViewFile
from .tables import VERSION, parse_toml, to_struct
from .toml_writing import toml_text

_CAMERA = ("eye", "u", "v", "w", "distance", "viewport", "projection", "near", "far")
LOOK_AT = {"target", "up", "fov_y_deg", "aspect"}  # fields that identify LookAtFields


def load_view(path: str | Path) -> View:
    """Return the view in a file. Raises LucidaError naming the file, the field and the remedy."""
    data = read_file(path_of(path, "view"), TOML_BYTES)
    return view_from_toml(decode_text(data, str(path)), str(path))


def save_view(path: str | Path, view: View) -> None:
    """Write a view file atomically. load_view returns exactly this view."""
    with atomic_write(path) as file:
        file.write(view_to_toml(view).encode())


def view_to_toml(view: View) -> str:
    """Return the text of a view file."""
    table = view_table(view)
    if not view.fit:
        del table["fit"]
    return toml_text({"lucida": VERSION, "camera": table})


def view_table(view: View) -> dict[str, Any]:
    """Return a view as a [camera] table that includes default values."""
    table: dict[str, Any] = {}
    for name in _CAMERA:
        value = getattr(view.camera, name)
        if value is not None:
            table[name] = list(value) if isinstance(value, tuple) else value
    if (lens := view.camera.lens) is not None:
        table["lens"] = {"model": lens.model, **lens.coefficients}
    return table | {"fit": view.fit}


def view_from_toml(text: str, source: str = "") -> View:
    """Return the view in the text of a view file. source: the file's name, for errors.

    A viewport is used unchanged unless `fit = true`; a camera written by its target is fitted to
    each image, as in a scene file, unless `fit = false`.
    """
    with naming(source):
        table: dict[str, Any] = to_struct(parse_toml(text), ViewFile).camera
        return view_from_table(table, is_fitted=False)


def looks_at(table: dict[str, Any]) -> bool:
    """Return True if a [camera] is written by its target (LookAtFields)."""
    return not LOOK_AT.isdisjoint(table)


def view_from_table(table: dict[str, Any], is_fitted: bool = True) -> View:
    """Return the view of a scene file's [camera]: a view file's fields, or eye and target.

    It fits each image's aspect ratio unless it has `fit = false` or a viewport. is_fitted: False
    for a view file, whose fields need `fit = true` for that.
    """
    with under("camera"):
        if not looks_at(table):
            fields: CameraFields = to_struct(table, CameraFields)
            fit = is_fitted and "viewport" not in table if fields.fit is None else fields.fit
            plain = {name: getattr(fields, name) for name in _CAMERA}
            return View(Camera(**plain, lens=_lens(fields.lens)), fit)
        for name in ("u", "v", "w", "viewport"):
            if name in table:
                raise not_together(name, "target, up, fov_y_deg or aspect", "give either form")
        look: LookAtFields = to_struct(table, LookAtFields)
        camera = Camera.look_at(
            look.eye,
            look.target,
            look.up,
            look.fov_y_deg,
            look.distance,
            look.aspect,
            projection=look.projection,
        )
        camera = replace(camera, near=look.near, far=look.far, lens=_lens(look.lens))
        return View(camera, look.fit is not False)


def _lens(table: dict[str, Any] | None) -> Lens | None:
    if table is None:
        return None
    if not isinstance(model := table.get("model"), str):
        problem = "is missing" if model is None else f"{model!r} is not a name"
        raise LucidaError("lens.model", problem, f"give one of {', '.join(MODELS)}")
    return Lens(model, {name: value for name, value in table.items() if name != "model"})
