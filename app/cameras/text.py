"""A camera as text to copy: a view file, Python, OpenGL matrices.

reader.py reads them back, except Python.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, fields
from typing import Any, Literal, get_args

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Floats
from lucida.renderer.camera.lenses import Lens
from lucida.renderer.files import view_to_toml
from lucida.renderer.files.cameras import opengl
from lucida.renderer.scene.model import View
from lucida.renderer.system.errors import LucidaError

from .presets import clip_around

Form = Literal["view file", "Python", "OpenGL matrices"]
FORMS: tuple[Form, ...] = get_args(Form)


@dataclass(frozen=True)
class Subject:
    """The subject of a text form.

    shown: the camera as drawn, with its viewport fitted to the image.
    bounds: points (n, 3) around the scene.
    """

    view: View
    shown: Camera
    bounds: Floats


def as_text(form: Form, subject: Subject) -> str:
    """Return the camera in one of the forms. Raises LucidaError if the form cannot hold it."""
    if form == "view file":
        return view_to_toml(subject.view)
    if form == "Python":
        return python(subject.view)
    if subject.shown.lens is not None:
        remedy = "take the lens off, or copy another form"
        raise LucidaError("lens", "does not fit into a matrix", remedy)
    around = clip_around(subject.shown, subject.bounds)
    return opengl.matrices(subject.shown, around, opengl.FITTED)


def python(view: View) -> str:
    """Return a program that makes the camera, and the view if its viewport is fitted."""
    names = ["Camera", *["Lens"] * bool(view.camera.lens), *["View"] * view.fit]
    lines = [f"from lucida import {', '.join(names)}", "", "camera = Camera("]
    for name, value in _fields(view.camera):
        if isinstance(value, Lens):
            text = f"Lens({value.model!r}, {dict(value.coefficients)!r})".replace("'", '"')
        else:
            text = f'"{value}"' if isinstance(value, str) else repr(value)
        lines.append(f"    {name}={text},")
    lines.append(")")
    if view.fit:
        lines += ["view = View(camera, fit=True)", "# view.for_size((width, height)): as drawn"]
    return "\n".join(lines) + "\n"


def _fields(camera: Camera) -> Iterator[tuple[str, Any]]:
    """Yield the names and values of the camera's fields, except for a clip plane or a lens that it
    does not have.
    """
    for field in fields(camera):
        if (value := getattr(camera, field.name)) is not None:
            yield field.name, value
