"""Text that a frame of the window cuts off, from its draw lists."""

from __future__ import annotations

import ctypes
import string
from collections.abc import Iterator

import numpy as np
from capitals import vertices_of
from imgui_bundle import imgui

QUAD = np.array([0, 1, 2, 0, 2, 3])  # the corners of a letter, by their order in an index buffer
LETTERS = (
    string.ascii_letters + string.digits + string.punctuation + "\N{MIDDLE DOT}\N{DEGREE SIGN}"
)
LARGEST = 120  # size of type that is looked for
EDGE_PX = 1.5  # an edge's antialiasing
PLACE = 1e-6  # of a texture: letters are told apart by their place in it


def cut_texts() -> dict[str, str]:
    """Return the texts that are cut in the frame just drawn: by their window, the letters of the
    lines that have a cut letter.

    Cut is a letter beyond the left or right edge of what its window, column or button shows, or
    beyond the upper or lower edge where nothing scrolls; and all that lies beyond a window's edge.
    """
    known = _letters()
    found = {}
    for window in imgui.get_current_context().windows:
        if not window.active or window.hidden or "/##" in window.name:  # a field of several lines
            continue
        lines = _cut_lines(window, known)
        if lines:
            found[window.name] = " | ".join(lines)
        if window.scroll_max.x > EDGE_PX and not window.scrollbar_x:
            width = window.inner_rect.get_width()
            found[window.name] = f"{window.content_size.x:.0f} px in {width:.0f}"
    return found


def _cut_lines(
    window: imgui.internal.Window, known: dict[tuple[int, int], tuple[str, float]]
) -> list[str]:
    lines = []
    scrolls_x, scrolls_y = window.scrollbar_x, window.scroll_max.y > 0
    for clip, corners, uv in _quads(window.draw_list):
        x0, y0, x1, y1 = *corners[:, 0].T, *corners[:, 2].T
        letters = [known.get(tuple(key)) for key in np.round(uv[:, 0] / PLACE).astype(int).tolist()]
        ends = np.array([letter[1] if letter else np.nan for letter in letters])
        seen = (x1 > clip[0]) & (x0 < clip[2]) & (y1 > clip[1]) & (y0 < clip[3])
        cut = uv[:, 2, 0] < ends - PLACE  # ImGui has cut this letter itself
        if not scrolls_x:
            cut |= (x0 < clip[0] - EDGE_PX) | (x1 > clip[2] + EDGE_PX)
        if not scrolls_y:
            cut |= (y0 < clip[1] - EDGE_PX) | (y1 > clip[3] + EDGE_PX)
        for k in np.flatnonzero(seen & cut):
            near = np.abs(y1 - y1[k]) < 0.4 * np.max(y1 - y0)
            text = "".join(letters[i][0] for i in np.flatnonzero(near) if letters[i])[:60]
            if text and text not in lines:
                lines.append(text)
    return lines


def _quads(drawn: imgui.ImDrawList) -> Iterator[tuple[np.ndarray, np.ndarray, np.ndarray]]:
    """Yield the letters of each command: what it shows, and their corners (N, 4, 2) on the screen
    and in the texture.
    """
    vertices = vertices_of(drawn)
    if not len(vertices):
        return
    index = _indices(drawn)
    for cmd in drawn.cmd_buffer:
        part = index[cmd.idx_offset : cmd.idx_offset + cmd.elem_count]
        if len(part) < len(QUAD):
            continue
        runs = np.lib.stride_tricks.sliding_window_view(part, len(QUAD))
        first = runs[(runs - runs[:, :1] == QUAD).all(1), 0] + cmd.vtx_offset
        if not len(first):
            continue
        four = vertices[first[:, None] + np.arange(4)]
        pos, uv = four["pos"], four["uv"]
        is_letter = (
            (pos[:, 0, 1] == pos[:, 1, 1])
            & (pos[:, 0, 0] == pos[:, 3, 0])
            & (uv[:, 0, 1] < uv[:, 2, 1])
            & (uv[:, 0, 0] < uv[:, 2, 0])
        )
        clip = np.array([cmd.clip_rect.x, cmd.clip_rect.y, cmd.clip_rect.z, cmd.clip_rect.w])
        if is_letter.any():
            yield clip, pos[is_letter], uv[is_letter]


def _indices(drawn: imgui.ImDrawList) -> np.ndarray:
    kind = np.dtype(f"<u{imgui.INDEX_SIZE}")
    memory = (ctypes.c_char * (len(drawn.idx_buffer) * kind.itemsize)).from_address(
        drawn.idx_buffer.data_address()
    )
    return np.frombuffer(memory, kind).astype(np.int64)


def _letters() -> dict[tuple[int, int], tuple[str, float]]:
    """Return the letters in the texture of fonts, by the place of their upper left corner, with the
    place of their right edge.
    """
    known = {}
    for font in imgui.get_io().fonts.fonts:
        for size in range(8, LARGEST):
            baked = font.get_font_baked(float(size))
            for letter in LETTERS if len(baked.glyphs) > 2 else ():
                if baked.is_glyph_loaded(ord(letter)):
                    glyph = baked.find_glyph(ord(letter))
                    key = round(glyph.u0 / PLACE), round(glyph.v0 / PLACE)
                    known[key] = letter, glyph.u1
    return known
