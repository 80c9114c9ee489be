"""The heights of the capitals and digits that a frame of the window draws, from its draw lists."""

from __future__ import annotations

import ctypes
import string

import numpy as np
from imgui_bundle import imgui

LETTERS = string.ascii_uppercase.replace("Q", "").replace("J", "") + string.digits
LARGEST = 200  # size of type that is looked for
VERTEX = np.dtype([("pos", "<f4", 2), ("uv", "<f4", 2), ("color", "<u4")])


def capital_heights() -> dict[float, str]:
    """Return the heights of capitals on the screen, in ImGui's pixels, each with some of the
    letters of that height. Call when a frame has been drawn."""
    known = _glyphs()
    found = {}
    for drawn in imgui.get_draw_data().cmd_lists:
        vertices = vertices_of(drawn)
        uv = np.round(vertices["uv"] * 1e6).astype(np.int64)
        at = np.flatnonzero(np.isin(uv[:, 0] * 10**7 + uv[:, 1], list(known)))
        for k in at.tolist():
            far = vertices["pos"][k + 2] if k + 2 < len(vertices) else vertices["pos"][k]
            letter, high = known[int(uv[k, 0]) * 10**7 + int(uv[k, 1])]
            if far[1] > vertices["pos"][k][1]:
                found.setdefault(high, []).append(letter)
    return {high: "".join(letters[:60]) for high, letters in found.items()}


def vertices_of(drawn: imgui.ImDrawList) -> np.ndarray:
    count = len(drawn.vtx_buffer)
    if not count:
        return np.empty(0, VERTEX)
    memory = (ctypes.c_char * (count * VERTEX.itemsize)).from_address(
        drawn.vtx_buffer.data_address()
    )
    return np.frombuffer(memory, VERTEX).copy()


def _glyphs() -> dict[int, tuple[str, float]]:
    """Return the letters in the texture of fonts, and the capitals' height in each one's type."""
    known = {}
    for font in imgui.get_io().fonts.fonts:
        for size in range(4, LARGEST):
            baked = font.get_font_baked(float(size))
            loaded = [c for c in LETTERS if baked.is_glyph_loaded(ord(c))]
            if not loaded:
                continue
            for letter in loaded:
                glyph = baked.find_glyph(ord(letter))
                key = round(glyph.u0 * 1e6) * 10**7 + round(glyph.v0 * 1e6)
                known[key] = letter, glyph.y1 - glyph.y0
    return known
