"""Translation of a task's words into those of the table of wrong lines, and back."""

from __future__ import annotations

import re
from collections.abc import Sequence

from app.checking.conventions import PAIRS, Conventions
from app.checking.mistakes.diagnosis import AS_IF
from app.checking.mistakes.rays import EDGES, GRID, SIZES, WORDS, RayTask, has_corners
from app.checking.tasks import CheckTask
from renderer.pixels import Indexing

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


def in_the_tasks_words(task: CheckTask, sentences: Sequence[str]) -> tuple[str, ...]:
    """Return the sentences, followed by the task's names for the letters of a pixel in them.

    Lines of code are left out if the task has other words than the camera's own.
    """
    if task.conventions.vision:
        sentences = [_of_k(task.conventions, one) for one in sentences if not one.startswith(AS_IF)]
    if not {"i", "j", "row", "column", "ij", "ji"} & task.conventions.words:
        sentences = [
            one.replace("row i.", "row.").replace("column j.", "column.") for one in sentences
        ]
    text = " ".join(sentences)
    called = []
    for name, word in task.conventions.arguments:
        for place, part in enumerate(PAIRS.get(word, (word,))):
            letter = LETTERS.get(part, part)
            own = name if word not in PAIRS else f"{name}[{place}]"
            if own != letter and re.search(rf"\b{letter}\b", text):
                called.append(f"{letter} is your `{own}`")
    return (*sentences, f"Here {' and '.join(called)}.") if called else tuple(sentences)


def _of_k(conventions: Conventions, sentence: str) -> str:
    """Return a sentence on half a pixel for a K whose integers are at the pixels' centres."""
    is_at_corners = conventions.first_center == 0.5
    if is_at_corners or not ("0.5" in sentence or "half a pixel" in sentence):
        return sentence
    return f"K counts from centre to centre: the first pixel's is at {conventions.first_center:g}."
