"""A scene as one HTML page with both images, whose camera the reader can move."""

from __future__ import annotations

from html import escape
from pathlib import Path
from typing import Any

from lucida.app.instruments.outside.extent import arrow_length
from lucida.renderer.files.export import check_export_path
from lucida.renderer.files.views import view_table
from lucida.renderer.scene.flat import flatten
from lucida.renderer.scene.focus import scene_focus
from lucida.renderer.scene.model import Scene, View
from lucida.renderer.system.atomic import atomic_write

from . import ENDINGS
from .document import document
from .formulas import templates
from .glsl import shaders
from .packing import packed

SHOWS = ("raster", "ray", "wipe", "difference", "outside", "probe", "controls")


def packed_scene(scene: Scene) -> dict[str, Any]:
    """Return a scene for figures, a JSON value: arrays, shaders and name.

    Raises LucidaError if it has too many triangles or texels.
    """
    flat, focus = flatten(scene), scene_focus(scene)
    names = [entry.name for entry in scene.objects]
    programs = {"pinhole": shaders(flat, False), "lens": shaders(flat, True)}
    return packed(flat, focus.framed) | {
        "shaders": programs,
        "name": scene.name,
        "names": names,
        "arrow": arrow_length(focus.reach),
    }


def scene_page(scene: Scene, view: View) -> str:
    """Return the page. view: the camera to begin with. Raises LucidaError."""
    title = scene.name or "A scene"
    content = {"scene": packed_scene(scene), "camera": view_table(view), "shows": SHOWS}
    head = f'<main>\n<h1>{escape(title)}</h1>\n<div id="lucida-figure"></div>\n</main>\n'
    body = head + templates()
    return document(f"{title}: Lucida", "scene_page.js", body, {"lucida-data": content})


def write_scene_page(path: str | Path, scene: Scene, view: View) -> int:
    """Write the page atomically, and return its size in bytes. Raises LucidaError."""
    page = scene_page(scene, view).encode("utf-8", "replace")
    with atomic_write(path) as file:
        file.write(page)
    return len(page)


def check_page_path(path: str | Path) -> Path:
    """Return the path. Raises LucidaError if it cannot be written, or is not a page's."""
    return check_export_path(path, ENDINGS)
