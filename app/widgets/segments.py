"""Many straight lines at once: ImGui needs a call for each, which is too slow for thousands.

They have soft edges like ImGui's own, and are written directly into a draw list's buffers.
"""

from __future__ import annotations

import ctypes
from typing import Any

import numpy as np
from imgui_bundle import ImVec2, imgui
from numpy.typing import ArrayLike, NDArray

MOST_AT_ONCE = 4000  # lines, whose vertex indices fit in 16 bits
SOFT = 0.5  # of a pixel, to both sides of an edge
_ACROSS = np.array([-1.0, -1.0, 1.0, 1.0])  # a line's four vertices at each end, in half widths
_EDGE = np.array([-SOFT, SOFT, -SOFT, SOFT])
_PALE = np.array([True, False, False, True])
# Three strips between them, of two triangles each: 0 to 3 at the start, 4 to 7 at the end.
_INDICES = np.array([(k, k + 1, k + 5, k, k + 5, k + 4) for k in range(3)]).ravel()

VERTEX = np.dtype(
    {
        "names": ["position", "uv", "color"],
        "formats": ["2f4", "2f4", "u4"],
        "offsets": [
            imgui.VERTEX_BUFFER_POS_OFFSET,
            imgui.VERTEX_BUFFER_UV_OFFSET,
            imgui.VERTEX_BUFFER_COL_OFFSET,
        ],
        "itemsize": imgui.VERTEX_SIZE,
    }
)


def ribbons(points: ArrayLike, color: int, width_px: float) -> NDArray[np.void]:
    """Return the vertices (n, 8) of segments (n, 2, 2) for add_ribbons(), to be drawn in many
    frames.

    color: as ImGui packs it.
    width_px: at least 1, in ImGui's units.
    """
    ends = np.asarray(points, float).reshape(-1, 2, 2)
    along = ends[:, 1] - ends[:, 0]
    length = np.linalg.norm(along, axis=1, keepdims=True)
    across = np.stack([-along[:, 1], along[:, 0]], axis=1) / np.where(length > 0, length, 1.0)
    out = _ACROSS * width_px / 2 + _EDGE
    found = np.zeros((len(ends), 8), VERTEX)
    places = ends[:, :, None] + across[:, None, None] * out[:, None]  # (n, end, vertex, x or y)
    found["position"] = places.reshape(-1, 8, 2)
    found["color"] = np.where(np.tile(_PALE, 2), color & 0x00FFFFFF, color)
    return found


def add_ribbons(draw: imgui.ImDrawList, vertices: NDArray[np.void]) -> None:
    """Draw the vertices made by ribbons()."""
    white = imgui.get_font_tex_uv_white_pixel()
    place = np.array([white.x, white.y], np.float32)
    if len(vertices) and (vertices["uv"][0, 0] != place).any():  # letters come, and it moves
        vertices["uv"] = place
    for start in range(0, len(vertices), MOST_AT_ONCE):
        _add(draw, vertices[start : start + MOST_AT_ONCE].reshape(-1))


def _add(draw: imgui.ImDrawList, vertices: NDArray[np.void]) -> None:
    lines = len(vertices) // 8
    draw.prim_reserve(lines * len(_INDICES), len(vertices))
    first = draw._vtx_current_idx
    indices = (first + 8 * np.arange(lines)[:, None] + _INDICES).astype(f"u{imgui.INDEX_SIZE}")
    _to_end(draw.vtx_buffer, imgui.VERTEX_SIZE, vertices)
    _to_end(draw.idx_buffer, imgui.INDEX_SIZE, indices)
    draw._vtx_current_idx = first + len(vertices)
    # ImGui's pointers into its buffers go on from where these end: a rectangle of no size.
    draw.prim_reserve(6, 4)
    draw.prim_rect(ImVec2(0, 0), ImVec2(0, 0), 0)


def _to_end(buffer: Any, item_bytes: int, values: NDArray[Any]) -> None:
    """Copy values to the space that prim_reserve() has made for them."""
    source = np.ascontiguousarray(values)
    place = buffer.data_address() + buffer.size() * item_bytes - source.nbytes
    ctypes.memmove(place, source.ctypes.data, source.nbytes)
