"""A scene as one HTML page: both images, from a camera that its reader moves."""

from __future__ import annotations

from html import escape
from typing import Any

from app.page.document import document
from app.page.formulas import templates
from app.page.glsl import shaders
from app.page.packing import packed
from renderer.scene.flat import flatten
from renderer.scene.model import Scene, View
from renderer.scene.views import view_table

SHOWS = ("raster", "ray", "wipe", "difference", "outside", "probe", "controls")


def packed_scene(scene: Scene) -> dict[str, Any]:
    """Return a scene as figures take it, a JSON value: arrays, shaders and name.

    Raises LucidaError if it has too many triangles or texels.
    """
    flat = flatten(scene)
    names = [entry.name for entry in scene.objects]
    programs = {"pinhole": shaders(flat, False), "lens": shaders(flat, True)}
    return packed(flat) | {"shaders": programs, "name": scene.name, "names": names}


def scene_page(scene: Scene, view: View) -> str:
    """Return the page. view: the camera to begin with. Raises LucidaError."""
    title = scene.name or "A scene"
    content = {"scene": packed_scene(scene), "camera": view_table(view), "shows": SHOWS}
    body = f'<h1>{escape(title)}</h1>\n<main id="lucida-figure"></main>\n{templates()}'
    return document(f"{title}: Lucida", "scene_page.js", body, {"lucida-data": content})
