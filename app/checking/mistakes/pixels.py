"""The two lines from the pixel to (x, y) on the image plane, and their mistakes."""

from __future__ import annotations

from app.checking.mistakes.program import CodeLine, Mistake, Swaps
from renderer.pixels import Indexing

PART = "From pixel to ray"
UNITS = {
    "_pixel": ("x_pixel / width", "y_pixel / height"),
    "01": ("x01", "y01"),
    "11": ("(x11 + 1) / 2", "(y11 + 1) / 2"),
}
# Replacements that flip rows or columns in a line that another mistake has rewritten.
ROWS: Swaps = (("y = top -", "y = bottom +"), ("y = 0.5 -", "y = -0.5 +"), ("y = 1 -", "y = -1 +"))
COLUMNS: Swaps = (
    ("x = left +", "x = right -"),
    ("x = -0.5 +", "x = 0.5 -"),
    ("x = -1 +", "x = 1 -"),
)
FISHEYE = "Straight lines stay straight: equal steps on the image plane, not equal angles."


def pixel_lines(words: frozenset[str], indexing: Indexing, from_top: bool) -> list[CodeLine]:
    """Return the lines for x and y, from i, j or from a task's x01, y01 in [0, 1] or x11, y11 in
    [-1, 1].
    """
    across, down = _parts(words, indexing)
    return [CodeLine("x", _x(across)), CodeLine("y", _y(down, from_top))]


def pixel_mistakes(
    words: frozenset[str], indexing: Indexing, from_top: bool, distance: str
) -> list[Mistake]:
    """Return the mistakes in these lines. distance: its code; empty in parallel projection, which
    has no angles.
    """
    across, down = _parts(words, indexing)
    made = _flips(across, down, from_top)
    unit = _unit(words)
    if unit:
        made += _in_units(words, unit, from_top)
    else:
        made += _centres(indexing, from_top) + _exchanges(indexing, from_top)
        made += _whole_numbers(indexing, from_top)
    made.append(_without_edges(across, down, from_top))
    made += _viewports(across, down, from_top)
    made += [] if unit else [_in_pixels(indexing, from_top)]
    if "left" in words:
        made += _symmetric(across, down, from_top)
        made += [] if unit else _square_pixels(indexing, from_top)
    return made + _angles(across, down, from_top, distance) if distance else made


def _unit(words: frozenset[str]) -> str:
    """Return the unit of the pixel's coordinates; empty for row and column."""
    if {"i", "j"} & words:
        return ""
    return next((unit for unit in UNITS if f"x{unit}" in words), "")


def _parts(words: frozenset[str], indexing: Indexing) -> tuple[str, str]:
    """Return the code of the pixel's position across the image, and down its rows, from 0 to 1."""
    return UNITS.get(_unit(words)) or (
        f"(j {indexing.offset}) / width",
        f"(i {indexing.offset}) / height",
    )


def _x(part: str) -> str:
    return f"x = left + {part} * (right - left)"


def _y(part: str, from_top: bool) -> str:
    """Return the line for y, for rows counted from the top or from the bottom."""
    if from_top:
        return f"y = top - {part} * (top - bottom)"
    return f"y = bottom + {part} * (top - bottom)"


def _flips(across: str, down: str, from_top: bool) -> list[Mistake]:
    hint = (
        "Rows count downwards, v points up: v needs its minus sign."
        if from_top
        else "Here rows count upwards, as v does: v needs no minus sign."
    )
    name = "rows count upwards" if from_top else "rows count downwards"
    down_up = ROWS if from_top else tuple((up, down) for down, up in ROWS)
    return [
        Mistake(name, (("y", _y(down, not from_top)),), hint, PART, swaps=down_up),
        Mistake(
            "columns count leftwards",
            (("x", f"x = right - {across} * (right - left)"),),
            "Columns count to the right, as u does: u has no minus sign.",
            PART,
            swaps=COLUMNS,
        ),
    ]


def _centres(indexing: Indexing, from_top: bool) -> list[Mistake]:
    """Return mistakes in the half pixel and in the number of steps, in both lines or in only
    one.
    """
    if indexing is Indexing.LECTURE:
        corner, whole, off = "({} - 1)", "{}", "({} + 0.5)"
        whole_name, whole_hint = "no half pixel", "the centre is at j - 0.5, not at j."
        off_hint = "subtract the half pixel, do not add it."
    else:
        corner, whole, off = "{}", "({} + 1)", "({} - 0.5)"
        whole_name, whole_hint = "a whole pixel", "the centre is at j + 0.5, not at j + 1."
        off_hint = "add the half pixel, do not subtract it."
    told = f"i and j count {indexing.told}: "
    centre = f"({{}} {indexing.offset})"
    wrong = (
        (
            "the corner, not the centre",
            f"{corner} / {{}}",
            "That ray goes through the pixel's corner. Its centre is half a pixel further.",
        ),
        (whole_name, f"{whole} / {{}}", told + whole_hint),
        ("one pixel off", f"{off} / {{}}", told + off_hint),
        (
            "one step too few",
            f"{corner} / ({{}} - 1)",
            "W pixels are W steps, each 1/W of the viewport: divide by W, not by W - 1.",
        ),
        (
            "the centre, but one step too few",
            f"{centre} / ({{}} - 1)",
            "The half pixel is right. Divide by W and H, not by W - 1 and H - 1.",
        ),
    )
    made = []
    for name, part, hint in wrong:
        x = ("x", _x(part.format("j", "width")))
        y = ("y", _y(part.format("i", "height"), from_top))
        new = part.partition(" / ")[0]
        swaps = (
            tuple((centre.format(k), new.format(k)) for k in "ij") if part.endswith("/ {}") else ()
        )
        made += [
            Mistake(name, (x, y), hint, PART, not name.startswith("the centre,"), swaps),
            Mistake(f"{name}: in the columns", (x,), f"Of the column: {hint}", PART, False),
            Mistake(f"{name}: in the rows", (y,), f"Of the row: {hint}", PART, False),
        ]
    return made


def _whole_numbers(indexing: Indexing, from_top: bool) -> list[Mistake]:
    x, y = (
        f"({name} {indexing.offset}) // {side}" for name, side in (("j", "width"), ("i", "height"))
    )
    hint = "`//` gives whole numbers, here always 0: divide with `/`."
    return [Mistake("divided to whole numbers", (("x", _x(x)), ("y", _y(y, from_top))), hint, PART)]


def _without_edges(across: str, down: str, from_top: bool) -> Mistake:
    sign, edge = ("-", "t") if from_top else ("", "b")
    return Mistake(
        "the edges left out",
        (
            ("x", f"x = {across} * (right - left)"),
            ("y", f"y = {sign}{down} * (top - bottom)"),
        ),
        f"The viewport begins at its edge, not at its middle: x starts at l, y at {edge}.",
        PART,
    )


def _exchanges(indexing: Indexing, from_top: bool) -> list[Mistake]:
    half = indexing.offset

    def both(name: str, across: str, down: str, hint: str) -> Mistake:
        return Mistake(name, (("x", _x(across)), ("y", _y(down, from_top))), hint, PART)

    return [
        both(
            "row and column exchanged",
            f"(i {half}) / width",
            f"(j {half}) / height",
            "(i, j) is row, column: the column j gives u, the row i gives v.",
        ),
        both(
            "width and height exchanged",
            f"(j {half}) / height",
            f"(i {half}) / width",
            "The column is divided by the width W, the row by the height H.",
        ),
        both(
            "the image transposed",
            f"(i {half}) / height",
            f"(j {half}) / width",
            "The column j, of W, gives u; the row i, of H, gives v: here they are exchanged.",
        ),
        Mistake(
            "both divided by the width",
            (("y", _y(f"(i {half}) / width", from_top)),),
            "The row is divided by the height H: there are H rows.",
            PART,
        ),
        Mistake(
            "both divided by the height",
            (("x", _x(f"(j {half}) / height")),),
            "The column is divided by the width W: there are W columns.",
            PART,
        ),
    ]


def _square_pixels(indexing: Indexing, from_top: bool) -> list[Mistake]:
    row, column = f"(i {indexing.offset})", f"(j {indexing.offset})"
    y = f"y = {'top -' if from_top else 'bottom +'} {row} * (right - left) / width"
    x = f"x = left + {column} * (top - bottom) / height"
    hint = "Pixels need not be square: "
    return [
        Mistake("rows as far apart as columns", (("y", y),), f"{hint}a row is (t - b) / H high.",
                PART),
        Mistake("columns as far apart as rows", (("x", x),),
                f"{hint}a column is (r - l) / W wide.", PART),
    ]  # fmt: skip


def _viewports(across: str, down: str, from_top: bool) -> list[Mistake]:
    """Return the mistakes of using the lecture's simple viewport, or the usual [-1, 1], for any
    camera.
    """
    up, low = ("0.5 -", "1 - 2 *") if from_top else ("-0.5 +", "-1 + 2 *")
    hint = "This camera's viewport reaches from left to right and from bottom to top, not from "
    return [
        Mistake(
            "the simple camera's viewport",
            (("x", f"x = -0.5 + {across}"), ("y", f"y = {up} {down}")),
            f"{hint}-0.5 to 0.5.",
            "Any camera",
        ),
        Mistake(
            "the viewport from -1 to 1",
            (("x", f"x = -1 + 2 * {across}"), ("y", f"y = {low} {down}")),
            f"{hint}-1 to 1.",
            "Any camera",
        ),
    ]


def _in_pixels(indexing: Indexing, from_top: bool) -> Mistake:
    row, middle = f"(i {indexing.offset})", "height / 2"
    y = f"{middle} - {row}" if from_top else f"{row} - {middle}"
    return Mistake(
        "pixels for the viewport",
        (("x", f"x = (j {indexing.offset}) - width / 2"), ("y", f"y = {y}")),
        "Those are pixels from the image's middle: a pixel is (r - l) / W wide and (t - b) / H "
        "high, and the viewport begins at l and t.",
        PART,
    )


def _symmetric(across: str, down: str, from_top: bool) -> list[Mistake]:
    """Return the mistakes of assuming that every viewport is centred at 0."""
    x = f"(2 * {across} - 1)"
    y = f"(1 - 2 * {down})" if from_top else f"(2 * {down} - 1)"
    return [
        Mistake(
            name,
            (("x", f"x = {x} * {half_width}"), ("y", f"y = {y} * {half_height}")),
            "The viewport need not have 0 in its middle: it reaches from l to r and from b to t.",
            "Any camera",
        )
        for name, half_width, half_height in (
            ("as far to the left as to the right", "right", "top"),
            ("the viewport's middle at 0", "(right - left) / 2", "(top - bottom) / 2"),
        )
    ]


def _angles(across: str, down: str, from_top: bool, distance: str) -> list[Mistake]:
    def steps(part: str, first: str, last: str) -> str:
        start, end = f"atan({first} / {distance})", f"atan({last} / {distance})"
        return f"{distance} * tan({start} + {part} * ({end} - {start}))"

    x = ("x", f"x = {steps(across, 'left', 'right')}")
    y = ("y", f"y = {steps(down, *(('top', 'bottom') if from_top else ('bottom', 'top')))}")
    return [
        Mistake("equal angles, not equal distances", (x, y), FISHEYE, PART),
        Mistake(
            "longitude and latitude",
            (x, ("y", f"{y[1]}\ny = y * sqrt(1 + (x / {distance})**2)")),
            FISHEYE,
            PART,
            is_common=False,
        ),
    ]


def _in_units(words: frozenset[str], unit: str, from_top: bool) -> list[Mistake]:
    """Return mistakes in the use of a pixel's centre in pixels, or of x and y in [0, 1] or
    [-1, 1].
    """
    across, down = UNITS[unit]
    made: list[Mistake] = []
    if unit == "01":
        other, far = [f"(2*{axis}01 - 1)" for axis in "xy"], ("[0, 1]", "[-1, 1]")
        hint = "The coordinates reach over [0, 1], not over [-1, 1]: 0 is the edge."
    else:
        other, far = [f"{axis}11" for axis in "xy"], ("[-1, 1]", "[0, 1]")
        hint = "The coordinates reach over [-1, 1], not over [0, 1]: 0 is the middle."
    if unit != "_pixel":
        lines = (("x", _x(other[0])), ("y", _y(other[1], from_top)))
        made.append(Mistake(f"{far[1]} for {far[0]}", lines, hint, PART))
    made.append(
        Mistake(
            "across and along exchanged",
            (("x", _x(down)), ("y", _y(across, from_top))),
            "The first coordinate goes across the image and gives u, the second gives v.",
            PART,
        )
    )
    if {"width", "height"} <= words:
        x, y = f"({across} + 0.5 / width)", f"({down} + 0.5 / height)"
        made.append(
            Mistake(
                "half a pixel more",
                (("x", _x(x)), ("y", _y(y, from_top))),
                "These coordinates are the point itself: no half pixel is added.",
                PART,
            )
        )
    return made
