"""Translation of a task's words into those of the table of wrong lines."""

from __future__ import annotations

from lucida.app.checking.conventions import PAIRS, Conventions
from lucida.app.checking.mistakes.rays import EDGES, GRID, SIZES, WORDS, RayTask, has_corners
from lucida.renderer.camera.pixels import Indexing

LETTERS = {"row": "i", "column": "j"}  # names in the table

_EDGES = {"left", "right", "bottom", "top"}
# The table's names for words.
_SAME = {
    "row": {"i"},
    "column": {"j"},
    "size": {"width", "height"},
    "viewport": {"left", "right", "bottom", "top"},
    **{name: set(pair) for name, pair in PAIRS.items()},
    **{name: {"distance", *_EDGES} for name in ("K", "fx", "fy", "cx", "cy")},
    **{name: {"world_to_camera"} for name in ("R", "t", "cam_from_world")},
    "world_from_cam": {"camera_to_world"},
}
_PIXELS = ({"i", "j"}, {"x_pixel", "y_pixel"}, {"x01", "y01"}, {"x11", "y11"})
_FRAMES = ({"eye", "u", "v", "w"}, {"eye", "target", "up"}, {"eye", "forward", "up"})
_MATRICES = {"camera_to_world", "world_to_camera"}
_KNOWN = {*WORDS, *SIZES, *GRID, *EDGES, *_MATRICES, "target", "up", "forward", "aspect"}


def ray_task(conventions: Conventions) -> RayTask:
    """Return the conventions in the words of the table of wrong lines, or in the camera's own words
    if the table lacks them.
    """
    words = {same for word in conventions.words for same in _SAME.get(word, {word})}
    pixel = next((pair for pair in _PIXELS if pair <= words), {"i", "j"})
    if {"rotation", "eye"} <= words or (words & _MATRICES and conventions.row_vectors):
        words = words - _MATRICES | {"eye", "u", "v", "w"}
    seen = words >= _EDGES or words >= set(SIZES) or any(word.startswith("fov") for word in words)
    placed = bool(words & _MATRICES) or any(frame <= words for frame in _FRAMES)
    if not (has_corners(words) or (seen and placed)):
        words = set(WORDS)
    words = {word for word in words if word in _KNOWN or word.startswith("fov")}
    words = words - set().union(*_PIXELS) | pixel | {"width", "height"}
    return RayTask(
        indexing=Indexing(conventions.base),
        from_top=conventions.rows == "top",
        words=frozenset(words),
        axes=conventions.axes,
    )
