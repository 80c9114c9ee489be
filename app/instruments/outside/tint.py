"""Colour the handles like the basis and hide their text, for which ImGuizmo has no settings.

The module replaces colours in vertices that were drawn. It knows nothing of handles and cameras.
"""

from __future__ import annotations

import ctypes
from collections.abc import Mapping

import numpy as np
from imgui_bundle import ImVec4, imgui
from numpy.typing import NDArray

from lucida.app.ui import theme
from lucida.app.ui.contrast import Rgb

Rgb8 = tuple[int, int, int]  # 0..255

# ImGuizmo's own colours of the axes x, y, z, and of the handle under the mouse. They come with
# several opacities, which are kept.
AXES: dict[str, Rgb8] = {"u": (170, 0, 0), "v": (0, 170, 0), "w": (0, 0, 170)}
HELD: Rgb8 = (255, 128, 16)  # almost the colour of u
SHADOW = np.uint32(0xFF000000)  # black, which only the shadow of the text has


def handle_colors(ground: Rgb) -> dict[Rgb8, ImVec4]:
    """Return the colours that replace ImGuizmo's in the current theme. ground: the colour under the
    handles.
    """
    colors = {AXES[name]: theme.seen_on(theme.BASIS[name], ground) for name in AXES}
    return {**colors, HELD: theme.rgb("#ffffff")}


def repaint(draw: imgui.ImDrawList, first: int, colors: Mapping[Rgb8, ImVec4]) -> None:
    """Replace colours, but not opacities, in all vertices of a draw list from `first` on. Hide
    ImGuizmo's last text, which calls the basis x, y and z: the letters of its shadow, and as many
    letters after them.
    """
    packed = vertex_colors(draw)[first:]
    rgb = packed & 0xFFFFFF
    for old, new in colors.items():
        changed = rgb == _packed(old)
        rest = packed[changed] & 0xFF000000
        packed[changed] = rest | _packed(tuple(round(255 * x) for x in (new.x, new.y, new.z)))
    shadow = np.flatnonzero(packed == SHADOW)
    if len(shadow):
        packed[shadow[0] : shadow[0] + 2 * len(shadow)] = 0


def vertex_colors(draw: imgui.ImDrawList) -> NDArray[np.uint32]:
    """Return the colours of a draw list's vertices in place, (n,), opacity in the highest byte.
    They are valid until something more is drawn.
    """
    count, size = draw.vtx_buffer.size(), imgui.VERTEX_SIZE
    if not count:
        return np.empty(0, np.uint32)
    content = (ctypes.c_uint8 * (count * size)).from_address(draw.vtx_buffer.data_address())
    rows = np.frombuffer(memoryview(content), np.uint32).reshape(count, size // 4)
    return rows[:, imgui.VERTEX_BUFFER_COL_OFFSET // 4]


def _packed(rgb: tuple[int, ...]) -> np.uint32:
    """Return a colour as ImGui packs it: red in the lowest byte."""
    return np.uint32(rgb[0] | rgb[1] << 8 | rgb[2] << 16)
