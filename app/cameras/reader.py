"""A camera read from a text that somebody has copied: text.py's forms, and near relatives.

Pure; runs none of what it reads. What holds no camera is a LucidaError of one line.
"""

from __future__ import annotations

import argparse
import ast
import re
import shlex
from collections.abc import Callable
from typing import NoReturn

import numpy as np

from app.cameras.options import CAMERA_OPTIONS, add_camera_options, with_camera_options
from app.cameras.text import FITTED
from renderer.camera import Camera, Floats, Vector
from renderer.errors import LucidaError
from renderer.scene import view_from_toml
from renderer.scene.model import View
from renderer.scene.tables import parse_toml
from renderer.scene.views import view_from_table

SOURCE = "clipboard"
MOST_CHARACTERS = 100_000

_OPTION = re.compile(rf"--({'|'.join(CAMERA_OPTIONS)})\b")
_VIEW_NAMES = ("camera_from_world", "view_matrix", "modelview", "view")
_CLIP_NAMES = ("clip_from_camera", "projection_matrix", "projection")
_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")


def read_view(text: str, now: View) -> View:
    """The view in a text. now: the present one, for what the text leaves open.

    A matrix leaves the distance open, which divides only the numbers of the viewport; a command
    line, what it does not name. Raises LucidaError.
    """
    if len(text) > MOST_CHARACTERS:
        raise LucidaError(SOURCE, "holds no camera but a long text", "copy a camera first")
    try:
        if _matrix_in(text, _VIEW_NAMES[0]) or _matrix_in(text, _CLIP_NAMES[0]):
            return View(_from_matrices(text, now.camera), fit=False)
        if re.search(r"\bCamera\s*[.(]", text):
            return _from_python(text)
        if _OPTION.search(text):
            return _from_command_line(text, now)
        if "[camera]" in text:
            return _from_toml(text)
    except LucidaError as error:
        raise error.in_file(SOURCE) from None
    raise LucidaError(
        SOURCE,
        "holds no camera",
        "copy a view file, a command line, Python or OpenGL matrices first",
    )


def _from_toml(text: str) -> View:
    """A view file, or a scene file's camera."""
    tables = parse_toml(text)
    camera = tables.get("camera")
    if isinstance(camera, dict) and len(tables) > 1:  # there is more of a scene
        return view_from_table(camera)
    return view_from_toml(text)


def _from_command_line(text: str, now: View) -> View:
    try:
        words = shlex.split(text, comments=False)
    except ValueError:  # a quotation mark too few
        words = text.split()
    parser = _Parser(prog="lucida", add_help=False, allow_abbrev=False)
    add_camera_options(parser)
    arguments, _ = parser.parse_known_args(words)
    whole = all(getattr(arguments, name) is not None for name in ("eye", "u", "v", "w"))
    return with_camera_options(arguments, View(Camera.canonical()) if whole else now)


class _Parser(argparse.ArgumentParser):
    """One that neither prints nor leaves."""

    def error(self, message: str) -> NoReturn:
        raise LucidaError("", f"holds no camera: {message}", "copy the command line again")


def _from_python(text: str) -> View:
    """A call of Camera or Camera.look_at with plain numbers; nothing of it is run."""
    try:
        tree = ast.parse(text.strip())
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        raise LucidaError("", "holds Python that is not complete", "copy all of it") from None
    camera, fit = None, False
    for node in ast.walk(tree):
        if not isinstance(node, ast.Call):
            continue
        name = ast.unparse(node.func)
        if re.fullmatch(r"(?:\w+\.)*Camera(?:\.look_at|\.canonical)?", name):
            camera = camera or _called(name, node)
        elif name.rpartition(".")[2] == "View":
            fit = any(
                word.arg == "fit"
                and isinstance(word.value, ast.Constant)
                and bool(word.value.value)
                for word in node.keywords
            )
    if camera is None:
        raise LucidaError("", "holds Python without a camera", "copy a call of Camera(...)")
    return View(camera, fit)


def _called(name: str, call: ast.Call) -> Camera:
    try:
        values = [ast.literal_eval(value) for value in call.args]
        named = {word.arg: ast.literal_eval(word.value) for word in call.keywords if word.arg}
    except (ValueError, TypeError, RecursionError):
        raise LucidaError(
            "", "holds a camera with more than numbers", "give plain numbers"
        ) from None
    makers: dict[str, Callable[..., Camera]] = {
        "look_at": Camera.look_at,
        "canonical": Camera.canonical,
    }
    make = makers.get(name.rpartition(".")[2], Camera)
    try:
        return make(*values, **named)
    except TypeError as error:  # a field that there is not
        raise LucidaError(
            "", f"holds a camera that is not understood: {error}", "see its fields"
        ) from None


def _from_matrices(text: str, now: Camera) -> Camera:
    view, clip = _matrix(text, _VIEW_NAMES), _matrix(text, _CLIP_NAMES)
    if np.abs(view[3] - [0, 0, 0, 1]).max() > 1e-6 * max(1.0, float(np.abs(view).max())):
        remedy = "transpose it" if not view[:3, 3].any() else "give a rigid or affine matrix"
        raise LucidaError(_VIEW_NAMES[0], "is not affine, column by column", remedy)
    try:
        world_from_camera = np.linalg.inv(view)
    except np.linalg.LinAlgError:
        raise LucidaError(_VIEW_NAMES[0], "has no inverse", "give another") from None
    u, v, w, eye = (_vector(column) for column in world_from_camera.T[:, :3])
    distance = now.distance
    parallel = np.allclose(clip[3], (0, 0, 0, 1))
    if not (parallel or np.allclose(clip[3], (0, 0, -1, 0))):
        problem = "is neither a perspective nor a parallel projection, column by column"
        raise LucidaError(_CLIP_NAMES[0], problem, "transpose it, or give another")
    with np.errstate(all="ignore"):
        if parallel:
            low, high = ((side - clip[[0, 1], 3]) / clip[[0, 1], [0, 1]] for side in (-1.0, 1.0))
            near, far = (clip[2, 3] + 1) / clip[2, 2], (clip[2, 3] - 1) / clip[2, 2]
        else:
            low, high = (
                (side + clip[[0, 1], 2]) * distance / clip[[0, 1], [0, 1]] for side in (-1.0, 1.0)
            )
            near, far = clip[2, 3] / (clip[2, 2] - 1), clip[2, 3] / (clip[2, 2] + 1)
    fitted = FITTED in text
    return Camera(
        eye,
        u,
        v,
        w,
        distance,
        (float(low[0]), float(high[0]), float(low[1]), float(high[1])),
        "parallel" if parallel else "perspective",
        None if fitted or not 0 < near < np.inf else float(near),
        None if fitted or not 0 < far < np.inf else float(far),
    )


def _matrix_in(text: str, name: str) -> re.Match[str] | None:
    """The name of a matrix that is given a value, up to where its numbers begin."""
    return re.search(rf"\b{name}\b\s*(?:\[\s*\d*\s*\])?\s*[=:(]", text)


def _matrix(text: str, names: tuple[str, ...]) -> Floats:
    """The (4, 4) matrix of one of the names, from 16 numbers column by column."""
    found = next((match for name in names if (match := _matrix_in(text, name))), None)
    if found is None:
        raise LucidaError(names[0], "is missing", "copy both matrices")
    rest = re.split(r"=|;", text[found.end() :], maxsplit=1)[0]  # up to the next name
    rest = re.sub(r"#[^\n]*|//[^\n]*|\b[A-Za-z_]\w*", " ", rest)
    numbers = _NUMBER.findall(rest)[:16]
    if len(numbers) < 16:
        raise LucidaError(names[0], f"has {len(numbers)} numbers", "give 16, column by column")
    return np.array([float(number) for number in numbers]).reshape(4, 4).T


def _vector(values: Floats) -> Vector:
    x, y, z = values.tolist()
    return x, y, z
