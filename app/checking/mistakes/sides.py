"""The viewport by other words than one side's angle: by both angles, by the angle of the longer or
the shorter side, by its width and height; and what goes wrong there."""

from __future__ import annotations

from app.checking.mistakes.program import CodeLine, Mistake

PART = "Any camera"
HALF = "The angle is that of the whole viewport: its half is the tangent of half of it."
RADIANS = "The tangent takes radians, the field of view is in degrees."
TANGENT = "An edge of the viewport is the tangent of the angle, not the angle."
SIZES = ("viewport_width", "viewport_height")

Lines = list[CodeLine]
Part = tuple[Lines, list[Mistake]]


def sides_part(words: frozenset[str]) -> Part | None:
    """The lines that make left, right, bottom and top, and what is written instead; None where the
    words are others."""
    for unit in ("", "_rad"):
        if {f"fov_x{unit}", f"fov_y{unit}"} <= words:
            return _both(unit, "distance * " if "distance" in words else "")
        for side in ("long", "short"):
            if f"fov_{side}{unit}" in words:
                return _one(side, unit, words)
    return _by_size() if set(SIZES) <= words else None


def _both(unit: str, distance: str) -> Part:
    across, along = (_angle(f"fov_{axis}{unit}") for axis in "xy")

    def line(code: str) -> str:
        first, second = (distance + code.format(angle) for angle in (across, along))
        return f"right, top = {first}, {second}"

    made = [Mistake(name, (("right", line(code)),), hint, PART) for name, code, hint in OF_ANGLE]
    if not unit:
        written = f"right, top = {distance}tan(fov_x / 2), {distance}tan(fov_y / 2)"
        made.insert(0, Mistake("degrees for radians", (("right", written),), RADIANS, PART))
    exchanged = f"right, top = {distance}tan({along} / 2), {distance}tan({across} / 2)"
    made.append(
        Mistake(
            "the angles exchanged",
            (("right", exchanged),),
            "The horizontal angle is that of the width, the vertical one that of the height.",
            PART,
        )
    )
    return [CodeLine("right", line("tan({} / 2)")), _opposite()], made


OF_ANGLE = (
    ("the whole angle, not half of it", "tan({})", HALF),
    (
        "the whole viewport for its half",
        "2 * tan({} / 2)",
        "That is the whole viewport: it reaches half as far to either side of its middle.",
    ),
    (
        "half of the viewport's half",
        "0.5 * tan({} / 2)",
        "The tangent of half the angle is the half of the viewport already.",
    ),
    ("the angle without its tangent", "{} / 2", TANGENT),
    (
        "the tangent upside down",
        "1 / tan({} / 2)",
        "That is the distance over the edge: the edge is d times the tangent.",
    ),
)


def _one(side: str, unit: str, words: frozenset[str]) -> Part:
    """The angle of the image's longer or shorter side."""
    word = f"fov_{side}{unit}"
    angle = _angle(word)
    distance = "distance * " if "distance" in words else ""
    aspect = "aspect" if "aspect" in words else "(width / height)"
    which = {"long": "minimum", "short": "maximum"}
    sides = "right, top = half * {0}(1, {1}), half * {0}(1, 1 / {1})"
    other = "long" if side == "short" else "short"
    hint = f"The angle is that of the image's {side}er side"

    def of_sides(name: str, code: str, told: str) -> Mistake:
        return Mistake(name, (("right", f"right, top = {code}"),), told, PART)

    made = [
        Mistake(name, (("half", f"half = {distance}{code.format(angle)}"),), told, PART)
        for name, code, told in OF_ANGLE
    ]
    if not unit:
        code = f"half = {distance}tan({word} / 2)"
        made.insert(0, Mistake("degrees for radians", (("half", code),), RADIANS, PART))
    made += [
        Mistake(
            "the angle of the other side",
            (("right", sides.format(which[other], aspect)),),
            f"{hint}, not of the {other}er one.",
            PART,
        ),
        of_sides("the vertical angle", f"half * {aspect}, half", f"{hint}, not of the height."),
        of_sides("the horizontal angle", f"half, half / {aspect}", f"{hint}, not of the width."),
        of_sides(
            "no aspect ratio",
            "half, half",
            "The viewport has the image's aspect ratio, or the image is stretched.",
        ),
    ]
    lines = [
        CodeLine("half", f"half = {distance}tan({angle} / 2)"),
        CodeLine("right", sides.format(which[side], aspect)),
        _opposite(),
    ]
    return lines, made


def _by_size() -> Part:
    half = "right, top = viewport_width / 2, viewport_height / 2"
    made = [
        Mistake(
            "the whole viewport for its half",
            (("right", "right, top = viewport_width, viewport_height"),),
            "The viewport reaches half its width to either side of its middle.",
            PART,
        ),
        Mistake(
            "the viewport's width and height exchanged",
            (("right", "right, top = viewport_height / 2, viewport_width / 2"),),
            "The width is from left to right, the height from bottom to top.",
            PART,
        ),
        Mistake(
            "a square viewport",
            (("right", "right, top = viewport_width / 2, viewport_width / 2"),),
            "The viewport is as high as viewport_height says, not as it is wide.",
            PART,
        ),
    ]
    return [CodeLine("right", half), _opposite()], made


def _opposite() -> CodeLine:
    return CodeLine("left", "left, bottom = -right, -top")


def _angle(word: str) -> str:
    return word if word.endswith("_rad") else f"radians({word})"
