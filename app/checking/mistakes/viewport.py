"""The viewport from a field of view: the lines, and what goes wrong in them."""

from __future__ import annotations

from app.checking.mistakes.program import CodeLine, Mistake

PART = "Any camera"
HALF = "The angle is that of the whole viewport: its upper half is the tangent of half of it."
ANGLES = ("fov_y", "fov_x", "fov_y_rad", "fov_x_rad")
RARE = {"a quarter of the angle", "half of the viewport's half", "the tangent upside down"}


def viewport_lines(words: frozenset[str]) -> list[CodeLine]:
    """From fov_y or fov_x, in degrees or, as fov_y_rad, in radians, and the aspect ratio."""
    word, aspect, distance = _given(words)
    first, second = _edges(word)
    return [
        CodeLine(first, f"{first} = {distance}tan({_angle(word)} / 2)"),
        CodeLine(second, _other(word, aspect)),
        CodeLine("left", "left, bottom = -right, -top"),
    ]


def viewport_mistakes(words: frozenset[str]) -> list[Mistake]:
    word, aspect, distance = _given(words)
    first, second = _edges(word)
    angle = _angle(word)

    def of_first(name: str, code: str, hint: str) -> Mistake:
        return Mistake(name, ((first, f"{first} = {code}"),), hint, PART, name not in RARE)

    def of_second(name: str, code: str, hint: str) -> Mistake:
        return Mistake(name, ((second, f"{second} = {code}"),), hint, PART)

    sign, undone = ("*", "/") if first == "top" else ("/", "*")
    made = [
        of_first("the whole angle, not half of it", f"{distance}tan({angle})", HALF),
        of_first("a quarter of the angle", f"{distance}tan({angle} / 4)", HALF),
        of_first(
            "the whole viewport for its half",
            f"2 * {distance}tan({angle} / 2)",
            "That is the whole viewport: it reaches half as far to either side of its middle.",
        ),
        of_first(
            "half of the viewport's half",
            f"0.5 * {distance}tan({angle} / 2)",
            "The tangent of half the angle is the upper half already.",
        ),
        of_first(
            "the angle without its tangent",
            f"{distance}{angle} / 2",
            "An edge of the viewport is the tangent of the angle, not the angle.",
        ),
        of_first(
            "the sine for the tangent",
            f"{distance}sin({angle} / 2)",
            "The image plane is a plane: opposite over adjacent is the tangent.",
        ),
        of_first(
            "the tangent upside down",
            f"{distance}(1 / tan({angle} / 2))",
            "That is the distance over the edge: the edge is d times the tangent.",
        ),
        of_second(
            "the angle scaled, not its tangent",
            f"{distance}tan({angle} {sign} ({aspect}) / 2)",
            "The aspect ratio scales lengths: multiply the tangent by it, not the angle.",
        ),
        of_second(
            "the aspect ratio upside down",
            f"{first} {undone} ({aspect})",
            "The aspect ratio is width over height: the wider image has the wider viewport.",
        ),
        of_second(
            "no aspect ratio",
            first,
            "The viewport has the image's aspect ratio, or the image is stretched.",
        ),
        of_first(
            "the angle of the other side",
            f"{distance}tan({angle} / 2) {undone} ({aspect})",
            f"The field of view is the {'vertical' if first == 'top' else 'horizontal'} one.",
        ),
    ]
    if not word.endswith("_rad"):
        made.insert(
            0,
            of_first(
                "degrees for radians",
                f"{distance}tan({word} / 2)",
                "The tangent takes radians, the field of view is in degrees.",
            ),
        )
    if distance:
        made.append(
            of_first(
                "the viewport at distance 1",
                f"tan({angle} / 2)",
                "The viewport is at distance d: its edge is d times the tangent.",
            )
        )
    return made


def _given(words: frozenset[str]) -> tuple[str, str, str]:
    """The angle's word, the aspect ratio, and the distance as a factor."""
    word = next(angle for angle in ANGLES if angle in words)
    aspect = "aspect" if "aspect" in words else "width / height"
    return word, aspect, "distance * " if "distance" in words else ""


def _edges(word: str) -> tuple[str, str]:
    return ("top", "right") if word.startswith("fov_y") else ("right", "top")


def _angle(word: str) -> str:
    return word if word.endswith("_rad") else f"radians({word})"


def _other(word: str, aspect: str) -> str:
    if word.startswith("fov_y"):
        return f"right = top * ({aspect})" if " " in aspect else f"right = top * {aspect}"
    return f"top = right / ({aspect})" if " " in aspect else f"top = right / {aspect}"
