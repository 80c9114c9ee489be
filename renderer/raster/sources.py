"""Shader sources: included chunks, constants, and driver messages with files and lines.

ShaderSource resolves the `#include "chunks/name.glsl"` of shaders/, inserts constants, and maps the
lines in a driver's message back to a file and line.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import moderngl

from lucida.renderer.images import shared_numbers
from lucida.renderer.system.errors import LucidaError

_INCLUDE = re.compile(r'\s*#\s*include\s+"([^"]+)"\s*$')
_NAME = re.compile(r"\b[A-Z][A-Z0-9_]*\b")
# Mesa: 0:14(5): error; NVIDIA: 0(14) : error; macOS, AMD, Intel: ERROR: 0:14: 'x'
_PLACE = re.compile(r"\b0(?::(\d+)(?:\(\d+\))?|\((\d+)\))")

Vec3 = tuple[float, float, float]
Constant = bool | int | float | Vec3 | tuple[Vec3, ...]


def read_shader(name: str) -> str:
    """Return the text of shaders/`name`, from the checkout or from the installed package.

    The package's name is not used, because a notebook's folder may have its own package shaders.
    """
    try:
        return (Path(__file__).parents[2] / "shaders" / name).read_text("utf-8")
    except OSError:
        raise LucidaError(f"shaders/{name}", "does not exist", "install lucida again") from None


class ShaderSource:
    """The text of one shader stage with its chunks included, each once.

    name: a file under shaders/. constants: declared after the first line, #version, together with
    those of shared_numbers that the text uses. places: (file, line) of each line of the text,
    because drivers count its lines, and some lose the string number of a #line. Raises LucidaError
    for a file that is missing.
    """

    def __init__(
        self,
        name: str,
        constants: Mapping[str, Constant] | None = None,
    ) -> None:
        self.name = name
        self.places: list[tuple[str, int]] = []
        self._taken: set[str] = set()
        self._lines: list[str] = []
        self._expand(name)
        named = set(_NAME.findall("\n".join(self._lines)))
        shared = {key: value for key, value in vars(shared_numbers).items() if key in named}
        for constant, value in (shared | dict(constants or {})).items():
            self._lines.insert(1, _declaration(constant, value))
            self.places.insert(1, (name, 1))
        self.text = "\n".join(self._lines) + "\n"

    def _expand(self, name: str) -> None:
        self._taken.add(name)
        for number, line in enumerate(read_shader(name).splitlines(), 1):
            found = _INCLUDE.match(line)
            if found is None:
                self._lines.append(line)
                self.places.append((name, number))
                continue
            if found[1] not in self._taken:
                self._expand(found[1])

    def explain(self, message: str) -> str:
        """Return a driver's message with each place in the text as file:line."""

        def place(match: re.Match[str]) -> str:
            number = int(match[1] or match[2])
            if not 1 <= number <= len(self.places):
                return match[0]
            return "{}:{}".format(*self.places[number - 1])

        return _PLACE.sub(place, message.strip())


def link(
    context: moderngl.Context,
    vertex: str,
    fragment: str,
    constants: Mapping[str, Constant] | None = None,
) -> moderngl.Program:
    """Return a program from two stages under shaders/, both with the constants.

    Raises LucidaError naming the file and line if the driver rejects one.
    """
    stages = {
        "vertex_shader": ShaderSource(vertex, constants),
        "fragment_shader": ShaderSource(fragment, constants),
    }
    try:
        return context.program(
            vertex_shader=stages["vertex_shader"].text,
            fragment_shader=stages["fragment_shader"].text,
        )
    except moderngl.Error as error:
        message = str(error)
        stage = next((stage for stage in stages if stage in message), None)
        if stage is None:
            raise LucidaError(f"shaders/{vertex}, {fragment}", message, _REMEDY) from None
        body = message.split("===", 1)[-1].lstrip("=\n ")
        raise LucidaError(
            f"shaders/{stages[stage].name}", stages[stage].explain(body), _REMEDY
        ) from None


_REMEDY = "update the graphics driver; without it, use lucida render --backend osmesa"


def _declaration(name: str, value: Constant) -> str:
    """Return the declaration of a GLSL constant: bool, int, float, vec3, or an array of vec3."""
    if isinstance(value, bool):
        return f"const bool {name} = {str(value).lower()};"
    if isinstance(value, int | float):
        return f"const {type(value).__name__} {name} = {value!r};"
    if isinstance(value[0], tuple):
        vectors = ", ".join(_vec3(vector) for vector in value)
        return f"const vec3 {name}[{len(value)}] = vec3[]({vectors});"
    return f"const vec3 {name} = {_vec3(value)};"


def _vec3(vector: Any) -> str:
    return f"vec3({', '.join(repr(float(part)) for part in vector)})"
