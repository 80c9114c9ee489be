"""Read a camera from copied text: text.py's forms except Python, and similar ones.

Pure. Text without a camera raises a LucidaError of one line.
"""

from __future__ import annotations

from dataclasses import replace

from lucida.renderer.files import view_from_toml
from lucida.renderer.files.cameras import FORMATS, PosedCamera, one_of, opengl, read_cameras
from lucida.renderer.files.cameras.given import Given
from lucida.renderer.files.reading import naming
from lucida.renderer.files.tables import parse_toml
from lucida.renderer.files.views import view_from_table
from lucida.renderer.scene.model import View
from lucida.renderer.system.errors import LucidaError

from .taken import TakenCamera, is_fitted, told_of

SOURCE = "clipboard"
MOST_CHARACTERS = 100_000


def read_copied(text: str, now: View) -> TakenCamera:
    """Return the camera in a text, with its lens if it has one. Raises LucidaError.

    now: the current view, for values that the text leaves open. Other programs leave the distance
    open, which only scales the viewport's numbers.
    """
    if len(text) > MOST_CHARACTERS:
        remedy = "copy a camera first; a set of cameras is opened as a file"
        raise LucidaError(SOURCE, "holds no camera but a long text", remedy)
    with naming(SOURCE):
        if opengl.has_matrices(text):
            return _from_others(text, "opengl", now)
        if "[camera]" in text:
            return _own(_from_toml(text), "a view file")
        for entry in FORMATS:
            if entry.module.recognises(_given(text)):
                return _from_others(text, entry.name, now)
    raise LucidaError(
        SOURCE,
        "holds no camera",
        "copy a view file, matrices or K, R and t first",
    )


def _own(view: View, told: str) -> TakenCamera:
    posed = PosedCamera(view.camera, fit=view.fit)
    return TakenCamera(view, _said(told), posed)


def _said(told: str) -> str:
    return f"The camera is pasted from the {SOURCE}: {told}."


def _from_toml(text: str) -> View:
    """Return the view in a view file, or in a scene file's camera."""
    tables = parse_toml(text)
    camera = tables.get("camera")
    if isinstance(camera, dict) and len(tables) > 1:  # a scene has more tables
        return view_from_table(camera)
    return view_from_toml(text)


def _given(text: str) -> Given:
    return Given("", text.encode("utf-8", "replace"))


def _from_others(text: str, format: str, now: View) -> TakenCamera:
    """Return a camera in another program's format. It leaves the distance open: the current one
    stays.
    """
    every = read_cameras(_given(text), format)
    if (count := len(every.cameras)) > 1:
        remedy = "save the text as a file and open that: all of them are shown"
        raise LucidaError("", f"holds {count} cameras", remedy)
    found = one_of(every.cameras)
    camera, distance = found.camera, now.camera.distance
    left, right, bottom, top = camera.viewport
    if not camera.is_parallel:
        scale = distance / camera.distance
        left, right, bottom, top = (scale * edge for edge in camera.viewport)
    viewport = (left, right, bottom, top)
    camera = replace(camera, distance=distance, viewport=viewport)
    view = View(camera, is_fitted(found), (camera, found.size))
    return TakenCamera(view, _said(told_of(every)), found)
