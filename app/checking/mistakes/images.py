"""Lines and mistakes for images as arrays: gray, one bit per pixel, a pixel's place in memory."""

from __future__ import annotations

import functools

from app.checking.mistakes.program import CodeLine, Mistake, Program

KINDS = "Kinds of raster image"
BITS = "One bit per pixel"
ARRAY = "The image as an array"
LUMA = (0.299, 0.587, 0.114)


def _one(name: str, key: str, code: str, hint: str, part: str) -> Mistake:
    return Mistake(name, ((key, code),), hint, part)


def flipped(name: str, part: str) -> tuple[Mistake, ...]:
    """Return the mistakes that flip a whole image. name: of the image in the line `answer`."""
    return tuple(
        Mistake(called, (("answer", f"answer = {name}{turned}"),), hint, part,
                swaps=((f"= {name}", f"= {name}{turned}"), (f"* {name}", f"* {name}{turned}")))
        for called, turned, hint in (
            ("upside down", "[::-1]", "Row 0 is the top row: the image is upside down."),
            ("mirrored", "[:, ::-1]", "Column 0 is the left one: the image is mirrored."),
        )
    )  # fmt: skip


@functools.cache
def gray_program(weights: tuple[float, float, float]) -> Program:
    """Return the program that makes gray from red, green and blue, (H, W) each."""

    def gray(name: str, code: str, hint: str) -> Mistake:
        return _one(name, "gray", f"gray = {code}", hint, KINDS)

    def answer(name: str, code: str, hint: str) -> Mistake:
        return _one(name, "answer", f"answer = {code}", hint, KINDS)

    others = "The three have weights: the eye sees green brightest, blue darkest."
    return Program(
        (CodeLine("gray", f"gray = {_sum(weights)}"), CodeLine("answer", "answer = gray")),
        (
            gray("the mean", "(red + green + blue) / 3", others),
            gray("blue and red exchanged", _sum((weights[2], weights[1], weights[0])),
                 "The first channel is red, the last one is blue."),
            gray("the sum", "red + green + blue", others),
            gray("the brightest of the three", "where(red > green, where(red > blue, red, blue), "
                 "where(green > blue, green, blue))", others),
            gray("lightness", "(where(red > green, where(red > blue, red, blue), where(green > "
                 "blue, green, blue)) + where(red < green, where(red < blue, red, blue), "
                 "where(green < blue, green, blue))) / 2", others),
            gray("green alone", "green", "All three channels count, each with its weight."),
            gray("red alone", "red", "All three channels count, each with its weight."),
            gray("the weights of video", _sum(LUMA),
                 "Those weights are for gamma-encoded video: of linear light they are others."),
            gray("the length of the colour", "sqrt(red**2 + green**2 + blue**2)", others),
            gray("whole numbers before the sum", _sum(weights, "floor({})"),
                 "The channels are fractions: as whole numbers (uint8) they are 0."),
            gray("gamma applied", f"({_sum(weights)})**(1 / 2.2)",
                 "The luminance of linear light is linear: no power of it."),
            answer("bytes for numbers from 0 to 1", "255 * gray",
                   "Numbers go from 0 to 1 here: do not multiply by 255."),
            answer("whole bytes for numbers from 0 to 1", "floor(255*gray + 0.5)",
                   "Numbers go from 0 to 1 here: do not multiply by 255."),
            answer("cut to whole bytes", "floor(255*gray)",
                   "Numbers go from 0 to 1 here. And bytes are rounded, not cut off."),
            answer("no clamp before 8 bits", "floor(256*gray) % 256 / 255",
                   "256 does not fit into 8 bits: clamp before, or white becomes black."),
            answer("cut to 0 and 1", "floor(gray)",
                   "Whole numbers keep only 0 and 1: the array must hold fractions."),
            *flipped("gray", KINDS),
        ),
        ("answer",),
    )  # fmt: skip


def _sum(weights: tuple[float, float, float], channel: str = "{}") -> str:
    """Return the code of the weighted sum. channel: the code for each channel."""
    return " + ".join(
        f"{weight:g}*{channel.format(name)}"
        for weight, name in zip(weights, ("red", "green", "blue"), strict=True)
    )


@functools.cache
def bitmap_program(inclusive: bool) -> Program:
    """Return the program that compares gray, (H, W), with a threshold: 1 is white. inclusive: the
    threshold itself is white.
    """
    sign, other = (">=", ">") if inclusive else (">", ">=")
    inverse = "<" if inclusive else "<="

    def white(name: str, code: str, hint: str) -> Mistake:
        return _one(name, "white", f"white = {code}", hint, BITS)

    at = "is white as well: at least" if inclusive else "is black: more than"
    fixed = "The threshold is given: it is not always the middle."
    return Program(
        (
            CodeLine("white", f"white = gray {sign} threshold"),
            CodeLine("answer", "answer = where(white, 1, 0)"),
        ),
        (
            white("the threshold itself", f"gray {other} threshold",
                  f"A gray that is the threshold {at} the threshold."),
            white("black and white exchanged", f"gray {inverse} threshold",
                  "1 is white: what is brighter than the threshold."),
            white("darker or the same is white", f"gray {'<=' if inclusive else '<'} threshold",
                  "1 is white: what is brighter than the threshold."),
            white("128 for the threshold", f"gray {sign} 128", fixed),
            white("0.5 for the threshold", f"gray {sign} 0.5", fixed),
            white("rounded", "floor(gray + 0.5) >= 1", fixed),
            white("what is not black", "gray > 0", fixed),
            white("bytes against a threshold from 0 to 1", f"255*gray {sign} threshold",
                  "Gray and threshold count alike: do not scale one of them."),
            white("numbers from 0 to 1 against a byte", f"gray / 255 {sign} threshold",
                  "Gray and threshold count alike: do not scale one of them."),
            white("the mean for the threshold", f"gray {sign} mean(gray)",
                  "The threshold is given: it is not the mean of the image."),
            _one("gray kept", "answer", "answer = where(white, gray, 0)",
                 "One bit has two values, 0 and 1: what is white is 1.", BITS),
            *flipped("where(white, 1, 0)", BITS),
        ),
        ("answer",),
    )  # fmt: skip


@functools.cache
def offset_program(base: int, column_major: bool, stride: int) -> Program:
    """Return the program for the place of pixel (i, j), counted from base, with `stride` bytes per
    pixel. A stride of 1 counts pixels.
    """
    row, column = ("i", "j") if base == 0 else (f"(i - {base})", f"(j - {base})")
    by_rows, by_columns = f"{row} * width + {column}", f"{column} * height + {row}"
    right, other = (by_columns, by_rows) if column_major else (by_rows, by_columns)

    def pixels(name: str, code: str, hint: str) -> Mistake:
        return _one(name, "pixels", f"pixels = {code}", hint, ARRAY)

    def offset(name: str, code: str, hint: str) -> Mistake:
        return _one(name, "answer", f"answer = {code}", hint, ARRAY)

    order = "column after column" if column_major else "row after row"
    made = [
        pixels("column-major for row-major" if not column_major else "row-major for column-major",
               other, f"Pixels lie {order} here: that is the other order."),
        pixels("row and column exchanged", f"{column} * width + {row}",
               "i is the row: as many whole rows lie before it, each of W pixels."),
        pixels("the height for the width", f"{row} * height + {column}",
               "A row has W pixels: i rows before it are i W pixels."),
        pixels("row and column added", f"{row} + {column}",
               "A row before it is W pixels, not one."),
        pixels("row and column multiplied", f"{row} * {column}",
               "i whole rows of W pixels, and j pixels of its own row: i W + j."),
        pixels("the column added to the width", f"{row} * (width + {column})",
               "Multiply first: i rows of W pixels, and j more: i W + j, not i (W + j)."),
        pixels("one row too many", f"({row} + 1) * width + {column}",
               f"Rows count from {base}: before the first one lies nothing."),
        pixels("one pixel too many", f"{right} + 1",
               f"Columns count from {base}: before the first one lies nothing."),
        pixels("counted from 1", "(i - 1) * width + (j - 1)", "i and j count from 0 here."),
        pixels("counted from 0", "i * width + j",
               "i and j count from 1 here: subtract 1 from both."),
        pixels("one row too few", f"{row} * (width - 1) + {column}",
               "A row has W pixels, not W - 1."),
    ]  # fmt: skip
    if base != 0:
        made = [one for one in made if one.name != "counted from 1"]
    else:
        made = [one for one in made if one.name != "counted from 0"]
    if stride != 1:
        made += [
            offset("pixels for bytes", "pixels", f"A pixel has {stride} bytes: multiply by them."),
            offset("the first row not in bytes", f"{row} * width + {column} * {stride}",
                   f"Rows count in bytes, too: multiply all by {stride}."),
            offset("the columns not in bytes", f"{row} * width * {stride} + {column}",
                   f"Columns count in bytes, too: multiply all by {stride}."),
            *(
                offset(f"{other} bytes per pixel", f"pixels * {other}",
                       f"A pixel has {stride} bytes: three numbers of single precision.")
                for other in (3, 4, 8, 24, 96) if other != stride
            ),
        ]  # fmt: skip
    else:
        made += [
            offset(name, f"pixels * {size}",
                   f"Pixels are counted here, not {unit}: do not multiply by {size}.")
            for name, unit, size in (
                ("bytes for pixels", "bytes", 12),
                ("numbers for pixels", "numbers", 3),
                ("4 bytes per pixel", "bytes", 4),
            )
        ]  # fmt: skip
    last = "answer = pixels" if stride == 1 else f"answer = pixels * {stride}"
    lines = (CodeLine("pixels", f"pixels = {right}"), CodeLine("answer", last))
    unlike = tuple(one for one in made if dict(one.lines).get("pixels") != lines[0].code)
    return Program(lines, unlike, ("answer",))
