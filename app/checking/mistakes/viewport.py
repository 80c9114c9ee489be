"""The lines for the viewport from a field of view, and their mistakes."""

from __future__ import annotations

from collections.abc import Callable

from app.checking.mistakes.program import CodeLine, Mistake

PART = "Any camera"
HALF = "The angle is that of the whole viewport: its half is the tangent of half of it."
ANGLES = ("fov_y", "fov_x", "fov_y_rad", "fov_x_rad")
RARE = {"a quarter of the angle", "half of the viewport's half", "the tangent upside down"}
OPPOSITE = CodeLine("left", "left, bottom = -right, -top")
EDGE = "tan({} / 2)"  # for a viewport at distance 1
# Wrong code for EDGE. {}: the angle in radians; {word}: the angle as given.
OF_ANGLE = (
    ("degrees for radians", "tan({word} / 2)",
     "The tangent takes radians, the field of view is in degrees."),
    ("the whole angle, not half of it", "tan({})", HALF),
    ("a quarter of the angle", "tan({} / 4)", HALF),
    ("the whole viewport for its half", "2 * tan({} / 2)",
     "That is the whole viewport: it reaches half as far to either side of its middle."),
    ("half of the viewport's half", "0.5 * tan({} / 2)",
     "The tangent of half the angle is the half of the viewport already."),
    ("the angle without its tangent", "{} / 2",
     "An edge of the viewport is the tangent of the angle, not the angle."),
    ("the sine for the tangent", "sin({} / 2)",
     "The image plane is a plane: opposite over adjacent is the tangent."),
    ("the tangent upside down", "1 / tan({} / 2)",
     "That is the distance over the edge: the edge is d times the tangent."),
)  # fmt: skip


def radians_of(word: str) -> str:
    return word if word.endswith("_rad") else f"radians({word})"


def angle_mistakes(key: str, line: Callable[[str], str]) -> list[Mistake]:
    """Return mistakes in the use of an angle. line: returns the line `key` for one of the wrong
    codes, or for EDGE.
    """
    return [
        Mistake(name, ((key, line(code)),), hint, PART, name not in RARE)
        for name, code, hint in OF_ANGLE
        if line(code) != line(EDGE)  # equal if the angle is in radians
    ]


def viewport_lines(words: frozenset[str]) -> list[CodeLine]:
    """Return the lines from fov_y or fov_x and the aspect ratio. The angle is in degrees, or in
    radians as fov_y_rad.
    """
    word, aspect, distance = _given(words)
    first, second = _edges(word)
    return [
        CodeLine(first, f"{first} = {distance}tan({radians_of(word)} / 2)"),
        CodeLine(second, _other(word, aspect)),
        OPPOSITE,
    ]


def viewport_mistakes(words: frozenset[str]) -> list[Mistake]:
    word, aspect, distance = _given(words)
    first, second = _edges(word)
    angle = radians_of(word)

    def one(key: str, name: str, code: str, hint: str) -> Mistake:
        return Mistake(name, ((key, f"{key} = {code}"),), hint, PART)

    def written(code: str) -> str:
        return f"{first} = {distance}{code.format(angle, word=word)}"

    sign, undone = ("*", "/") if first == "top" else ("/", "*")
    made = [
        *angle_mistakes(first, written),
        one(second, "the angle scaled, not its tangent",
            f"{distance}tan({angle} {sign} ({aspect}) / 2)",
            "The aspect ratio scales lengths: multiply the tangent by it, not the angle."),
        one(second, "the aspect ratio upside down", f"{first} {undone} ({aspect})",
            "The aspect ratio is width over height: the wider image has the wider viewport."),
        one(second, "no aspect ratio", first,
            "The viewport has the image's aspect ratio, or the image is stretched."),
        one(first, "the angle of the other side",
            f"{distance}tan({angle} / 2) {undone} ({aspect})",
            f"The field of view is the {'vertical' if first == 'top' else 'horizontal'} one."),
    ]  # fmt: skip
    if distance:
        hint = "The viewport is at distance d: its edge is d times the tangent."
        made.append(one(first, "the viewport at distance 1", f"tan({angle} / 2)", hint))
    return made


def _given(words: frozenset[str]) -> tuple[str, str, str]:
    """Return the angle's word, the code of the aspect ratio, and the distance as a factor."""
    word = next(angle for angle in ANGLES if angle in words)
    aspect = "aspect" if "aspect" in words else "width / height"
    return word, aspect, "distance * " if "distance" in words else ""


def _edges(word: str) -> tuple[str, str]:
    return ("top", "right") if word.startswith("fov_y") else ("right", "top")


def _other(word: str, aspect: str) -> str:
    aspect = f"({aspect})" if " " in aspect else aspect
    return f"right = top * {aspect}" if word.startswith("fov_y") else f"top = right / {aspect}"
