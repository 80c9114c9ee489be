"""The part of pbrt-v4's file format that cameras and scenes are written in, read strictly.

Nothing of what pbrt's documentation does not name is taken: directives, where they may stand, the
types and names of parameters. Source: pbrt-v4's documentation, "pbrt-v4 Input File Format".
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

Value = list[float] | list[str] | list[bool]

_TOKEN = re.compile(r'\s+|#[^\n]*|("(?:[^"\\\n]|\\["\\bfnrt])*")|([\[\]])|([^\s"#\[\]]+)')
_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?\Z")

# How many numbers a value of this type has at least, which it then has a multiple of; 0: texts.
TYPES = {"integer": 1, "float": 1, "point2": 2, "vector2": 2, "point3": 3, "vector3": 3}
TYPES |= {"normal3": 3, "rgb": 3, "bool": 0, "string": 0, "texture": 0}

# What is said of each kind, as far as Lucida may write it: "type name".
KINDS = {
    "Film": {"rgb": "integer xresolution,integer yresolution,string filename"},
    "Camera": {
        "perspective": "float fov,float screenwindow,float frameaspectratio",
        "orthographic": "float screenwindow,float frameaspectratio",
        "spherical": "string mapping",
    },
    "Sampler": {"independent": "integer pixelsamples,integer seed"},
    "PixelFilter": {"box": "float xradius,float yradius"},
    "Integrator": {"path": "integer maxdepth"},
    "LightSource": {
        "point": "point3 from,rgb I,float scale",
        "distant": "point3 from,point3 to,rgb L,float scale",
        "infinite": "rgb L,float scale",
    },
    "Material": {
        "diffuse": "rgb reflectance,texture reflectance",
        "coateddiffuse": "rgb reflectance,texture reflectance,float roughness,"
        "bool remaproughness,float eta",
    },
    "Shape": {"sphere": "float radius", "plymesh": "string filename"},
    "checkerboard": {"checkerboard": "integer dimension,rgb tex1,rgb tex2"},
    "imagemap": {
        "imagemap": "string filename,string wrap,float uscale,float vscale,"
        "float udelta,float vdelta"
    },
}
BEFORE_THE_WORLD = {"Film", "Camera", "Sampler", "PixelFilter", "Integrator"}
IN_THE_WORLD = {"LightSource", "Material", "Shape", "Texture", "AttributeBegin", "AttributeEnd"}


class PbrtError(ValueError):
    """What pbrt would not take."""


@dataclass(frozen=True)
class Directive:
    """kind: the text behind its name. numbers: of a Transform. parameters: by their names."""

    name: str
    kind: str = ""
    numbers: tuple[float, ...] = ()
    parameters: dict[str, Value] = field(default_factory=dict)


def parse(text: str) -> list[Directive]:
    """Raises PbrtError."""
    waiting = list(_tokens(text))[::-1]
    found, depth, in_world = [], 0, False
    while waiting:
        directive = _directive(waiting)
        name = directive.name
        if name == "WorldBegin":
            if in_world:
                raise PbrtError("a second WorldBegin")
            in_world = True
        if name in BEFORE_THE_WORLD if in_world else name in IN_THE_WORLD:
            raise PbrtError(f"{name} on the wrong side of WorldBegin")
        depth += (name == "AttributeBegin") - (name == "AttributeEnd")
        if depth < 0:
            raise PbrtError("AttributeEnd without its beginning")
        found.append(directive)
    if depth:
        raise PbrtError("AttributeBegin without its end")
    return found


def _tokens(text: str) -> Iterator[str]:
    at = 0
    while at < len(text):
        match = _TOKEN.match(text, at)
        if match is None:
            raise PbrtError(f"nothing that is known: {text[at : at + 20]!r}")
        at = match.end()
        if match.lastindex:
            yield match[0]


def _directive(waiting: list[str]) -> Directive:
    """The next one; waiting: tokens, the next one last."""
    name = waiting.pop()
    if name in ("WorldBegin", "AttributeBegin", "AttributeEnd"):
        return Directive(name)
    if name == "Transform":
        numbers = _value(waiting, "float")
        if len(numbers) != 16:
            raise PbrtError(f"Transform has {len(numbers)} numbers")
        return Directive(name, numbers=tuple(map(float, numbers)))
    if name == "Texture":
        own, of, kind = (_text(waiting) for _ in range(3))
        if of not in ("spectrum", "float"):
            raise PbrtError(f"a texture {own} of {of}")
        return Directive(name, kind, parameters=_parameters(waiting, KINDS.get(kind, {}), kind))
    if name not in KINDS:
        raise PbrtError(f"the directive {name}")
    kind = _text(waiting)
    return Directive(name, kind, parameters=_parameters(waiting, KINDS[name], kind))


def _parameters(waiting: list[str], kinds: dict[str, str], kind: str) -> dict[str, Value]:
    if kind not in kinds:
        raise PbrtError(f"the kind {kind!r}")
    allowed, found = kinds[kind].split(","), dict[str, Value]()
    while waiting and waiting[-1].startswith('"'):
        declared = " ".join(_text(waiting).split())
        if declared not in allowed:
            raise PbrtError(f"{kind} has no parameter {declared!r}")
        of, name = declared.split(" ")
        if name in found:
            raise PbrtError(f"{name} is given twice")
        found[name] = _value(waiting, of)
    return found


def _value(waiting: list[str], of: str) -> Value:
    """One value, or several in brackets."""
    tokens = [_next(waiting)]
    if tokens == ["["]:
        tokens = []
        while (token := _next(waiting)) != "]":
            tokens.append(token)
    if of == "bool":
        if tokens not in (["true"], ["false"]):
            raise PbrtError(f"{tokens} is no bool")
        return [tokens == ["true"]]
    if TYPES[of] == 0:
        return [_unquoted(token) for token in tokens]
    if not tokens or len(tokens) % TYPES[of]:
        raise PbrtError(f"{len(tokens)} numbers of {of}")
    for token in tokens:
        if not _NUMBER.match(token) or (of == "integer" and not token.lstrip("+-").isdigit()):
            raise PbrtError(f"{token} is no {of}")
    return [float(token) for token in tokens]


def _next(waiting: list[str]) -> str:
    if not waiting:
        raise PbrtError("the end, where a value should stand")
    return waiting.pop()


def _text(waiting: list[str]) -> str:
    return _unquoted(_next(waiting))


def _unquoted(token: str) -> str:
    if not token.startswith('"'):
        raise PbrtError(f"{token} is not in quotation marks")
    return token[1:-1]
