"""The rasterizer's compiled shaders, specialised for the features of a scene."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import moderngl
import numpy as np

from lucida.renderer.images.shared_numbers import CHECKERED
from lucida.renderer.scene.flat import SPECULAR_CHECKERED, FlatScene

from .resources import Owner
from .sources import Constant, link

# The samplers' texture units are the same in all programs. Different kinds never share one.
SAMPLERS = (
    *("triangle_rows", "spheres", "objects", "lights", "faces", "vertices"),
    *("texels", "textures", "uv", "primitives", "positions"),
)
UNITS = {name: unit for unit, name in enumerate(SAMPLERS)}
# Window depths: the background's, and one between it and depth()'s largest in camera.glsl.
FARTHEST, BEFORE_FARTHEST = 1.0, 1 - 2**-21


class Programs:
    """The programs of a context, each compiled once, or once for each kind of scene."""

    def __init__(self, context: moderngl.Context) -> None:
        self._context = context
        self._owner = Owner()
        self._special: dict[tuple[object, ...], moderngl.Program] = {}
        self.clear = self._linked("screen.vert", "clear.frag", {})
        self.background = self._linked("screen.vert", "background.frag", {"HAS_LENS": False})

    def triangles(self, flat: FlatScene, has_lens: bool = False) -> moderngl.Program:
        """Return the first pass for the scene's triangles. has_lens: draws a face of a lens."""
        return self._linked("triangles.vert", "triangles.frag", seeing(flat, has_lens))

    def spheres(self, has_lens: bool = False) -> moderngl.Program:
        """Return the first pass for spheres."""
        return self._linked("spheres.vert", "spheres.frag", {"HAS_LENS": has_lens})

    def shade(self, flat: FlatScene, has_lens: bool = False) -> moderngl.Program:
        """Return the shading pass for the scene's features."""
        features = shading(flat, has_lens)
        return self._linked("screen.vert", "shade.frag", features, BEFORE_FARTHEST)

    def lookup(self) -> moderngl.Program:
        """Return the pass in which each pixel looks up its primitive in a face."""
        return self._linked("screen.vert", "lookup.frag", {"HAS_LENS": True})

    def _linked(
        self,
        vertex: str,
        fragment: str,
        features: Mapping[str, Constant],
        window_depth: float = FARTHEST,
    ) -> moderngl.Program:
        """Return a program after setting its constant uniforms."""
        key = (vertex, fragment, *features.values())
        if key not in self._special:
            program = self._owner.own(link(self._context, vertex, fragment, features))
            for name, value in (*UNITS.items(), ("Camera", 0), ("window_depth", window_depth)):
                set_uniform(program, name, value)
            self._special[key] = program
        return self._special[key]

    def release(self) -> None:
        self._owner.release()


def seeing(flat: FlatScene, has_lens: bool) -> dict[str, bool]:
    """Return the constants of the first pass for the scene's triangles."""
    return {
        "HAS_LENS": has_lens,
        "HAS_TURNED": _has_turned(flat),
        "HAS_HOLES": bool((flat.textures[:, 1, 1] >= 0).any()),
    }


def shading(flat: FlatScene, has_lens: bool) -> dict[str, bool]:
    """Return the constants of the shading pass for the scene's features."""
    return {
        "HAS_LENS": has_lens,
        "HAS_TRIANGLES": len(flat.faces) > 0,
        "HAS_TURNED": _has_turned(flat),
        "HAS_SPHERES": len(flat.spheres) > 0,
        "HAS_NORMALS": bool(flat.normals.any()),
        "HAS_COLORS": bool((flat.colors != 1).any()),
        "HAS_CHECKERS": bool((flat.materials[:, SPECULAR_CHECKERED, 3] == CHECKERED).any()),
        "HAS_TEXTURES": len(flat.texels) > 0,
        "HAS_METALS": bool((flat.textures[:, 1, 0] >= 0).any()),
    }


def _has_turned(flat: FlatScene) -> bool:
    """Return True if an object is rotated or scaled, not only translated."""
    return bool((flat.world_from_object[:, :3, :3] != np.eye(3)).any())


def set_uniform(program: moderngl.Program, name: str, value: Any) -> None:
    """Set a uniform. Ignore one that the compiler has removed."""
    uniform = program.get(name, None)
    if isinstance(uniform, moderngl.Uniform):
        uniform.value = value
    elif isinstance(uniform, moderngl.UniformBlock):
        uniform.binding = value
