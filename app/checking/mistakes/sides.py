"""The viewport in other words than one angle, and its mistakes: both angles, the angle of the
longer or shorter side, or its width and height.
"""

from __future__ import annotations

from app.checking.mistakes.program import CodeLine, Mistake
from app.checking.mistakes.viewport import EDGE, OPPOSITE, PART, angle_mistakes, radians_of

SIZES = ("viewport_width", "viewport_height")

Lines = list[CodeLine]
Part = tuple[Lines, list[Mistake]]


def sides_part(words: frozenset[str]) -> Part | None:
    """Return the lines that make left, right, bottom and top, and their mistakes; None for other
    words.
    """
    for unit in ("", "_rad"):
        if {f"fov_x{unit}", f"fov_y{unit}"} <= words:
            return _both(unit, "distance * " if "distance" in words else "")
        for side in ("long", "short"):
            if f"fov_{side}{unit}" in words:
                return _one(side, f"fov_{side}{unit}", words)
    return _by_size() if set(SIZES) <= words else None


def _of_sides(name: str, code: str, hint: str) -> Mistake:
    return Mistake(name, (("right", f"right, top = {code}"),), hint, PART)


def _both(unit: str, distance: str) -> Part:
    def edges(code: str, axes: str = "xy") -> str:
        words = (f"fov_{axis}{unit}" for axis in axes)
        return ", ".join(distance + code.format(radians_of(word), word=word) for word in words)

    made = angle_mistakes("right", lambda code: f"right, top = {edges(code)}")
    hint = "The horizontal angle is that of the width, the vertical one that of the height."
    made.append(_of_sides("the angles exchanged", edges(EDGE, "yx"), hint))
    return [CodeLine("right", f"right, top = {edges(EDGE)}"), OPPOSITE], made


def _one(side: str, word: str, words: frozenset[str]) -> Part:
    """Return the lines for the angle of the image's longer or shorter side."""
    distance = "distance * " if "distance" in words else ""
    aspect = "aspect" if "aspect" in words else "(width / height)"
    which = {"long": "minimum", "short": "maximum"}
    sides = "half * {0}(1, {1}), half * {0}(1, 1 / {1})"
    other = "long" if side == "short" else "short"
    hint = f"The angle is that of the image's {side}er side"

    def half(code: str) -> str:
        return f"half = {distance}{code.format(radians_of(word), word=word)}"

    made = [
        *angle_mistakes("half", half),
        _of_sides("the angle of the other side", sides.format(which[other], aspect),
                  f"{hint}, not of the {other}er one."),
        _of_sides("the vertical angle", f"half * {aspect}, half", f"{hint}, not of the height."),
        _of_sides("the horizontal angle", f"half, half / {aspect}", f"{hint}, not of the width."),
        _of_sides("no aspect ratio", "half, half",
                  "The viewport has the image's aspect ratio, or the image is stretched."),
    ]  # fmt: skip
    right = f"right, top = {sides.format(which[side], aspect)}"
    return [CodeLine("half", half(EDGE)), CodeLine("right", right), OPPOSITE], made


def _by_size() -> Part:
    made = [
        _of_sides("the whole viewport for its half", "viewport_width, viewport_height",
                  "The viewport reaches half its width to either side of its middle."),
        _of_sides("the viewport's width and height exchanged",
                  "viewport_height / 2, viewport_width / 2",
                  "The width is from left to right, the height from bottom to top."),
        _of_sides("a square viewport", "viewport_width / 2, viewport_width / 2",
                  "The viewport is as high as viewport_height says, not as it is wide."),
    ]  # fmt: skip
    half = "right, top = viewport_width / 2, viewport_height / 2"
    return [CodeLine("right", half), OPPOSITE], made
