"""The numbers of a matrix in a copied text, however it was printed.

It accepts NumPy, PyTorch, Python, MATLAB, Julia, C, JSON, YAML, XML, LaTeX, and bare numbers. Pure;
runs none of what it reads. readings.py interprets the numbers.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

import numpy as np

from app.detective.options import MOST_CHARACTERS
from renderer.camera import Floats, Size
from renderer.errors import LucidaError
from renderer.frame import check_size

REMEDY = "paste 16 or 12 numbers; 9 of K or R and 3 of t may stand beside"
ROUNDED = 5e-3  # how far from a rotation one may be that was printed with few digits
MATRIX = (16, 12)
KNOWN = (*MATRIX, 9, 3)
NUMBER_OF_TEXT = 3  # a quoted text with this many numbers is read

K_NAMES = ("k", "intrinsics", "intrinsic", "intrinsicmatrix", "cameramatrix", "calibration")
SIZE_NAMES = ("size", "imagesize", "resolution", "wh", "imsize")
WIDTH_NAMES, HEIGHT_NAMES = ("width", "w", "imagewidth"), ("height", "h", "imageheight")
LENS_NAMES = (
    "dist", "distortion", "distcoeffs", "distcoeff", "distcoefs", "distortioncoefficients",
    "distortioncoeffs", "distortionparameters", "radialdistortion", "tangentialdistortion",
)  # fmt: skip
LENS_LETTER = re.compile(r"[kp][1-6]|d")  # alone; ROS calls all of them D
FOCAL = {
    name: key
    for key, names in {
        "fx": ("fx", "flx"), "fy": ("fy", "fly"), "cx": ("cx",), "cy": ("cy",), "s": ("skew",),
    }.items()
    for name in names
}  # fmt: skip

_TOKEN = re.compile(
    r"""(?P<comment>\#[^\n]*|//[^\n]*|/\*.*?\*/|%[^\n]*)
    |(?P<text>"[^"\n]*"|'[^'\n]*')
    |(?P<extent>(?<![\w.])\d+\s?[x\u00d7]\s?\d+(?![\w.]))
    |(?P<name>[A-Za-z_]\w*(?:(?:\.|::)[A-Za-z_]\w*)*)
    |(?P<number>[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?[fFlL]?(?![\w.]))
    |(?P<tag></|/>|(?<=\n)[ \t]*-(?=[ \t]))
    |(?P<line>\n)
    |(?P<other>[^\s])""",
    re.VERBOSE | re.DOTALL,
)
# A name that is assigned a value: also an array of declared length, or one of its elements.
_GIVEN = re.compile(r"\s*(?:\[\s*\d*\s*\]\s*)*(?:=|:)(?![=:])")
_ELEMENT = re.compile(r"([a-z]?)[0-4][0-4]")
_LENGTHS = re.compile(r"\s*(?:\[\s*\d*\s*\])+")
# Numbers that are not the matrix's: R's names of rows and columns, reshape(4, 4).
_MARGINS = re.compile(r"\[\s*\d+\s*,\s*\]|\[\s*,\s*\d+\s*\]|\breshape\s*\([^()]*\)")
_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")


@dataclass(frozen=True, eq=False)
class Pasted:
    """numbers: of the matrix, in the order of the text: 16, 12, or the 9 of R, with t separately,
    else None. K: (3, 3), row by row, or None. size: (width, height), if the text has it. lens: the
    coefficients of a lens's distortion beside them.
    """

    numbers: Floats
    t: Floats | None = None
    K: Floats | None = None
    size: Size | None = None
    lens: tuple[float, ...] = ()


@dataclass
class _Block:
    """The value of a name. lines: of numbers; units: where it may be divided."""

    name: str = ""
    units: list[list[list[float]]] = field(default_factory=lambda: [[[]]])
    factor: float = 1.0  # MATLAB prints one for all

    def add(self, number: float) -> None:
        self.units[-1][-1].append(number)

    def end_line(self) -> None:
        if self.units[-1][-1]:
            self.units[-1].append([])

    def end_unit(self) -> None:
        if any(self.units[-1]):
            self.units.append([[]])

    @property
    def numbers(self) -> list[float]:
        return [number for unit in self.units for line in unit for number in line]


def pasted(text: str) -> Pasted:
    """Return the matrix in a text. Raises LucidaError, of one line, if there is none."""
    if len(text) > MOST_CHARACTERS:
        raise LucidaError("", f"has {len(text)} letters, too many for a matrix", REMEDY)
    if not text.strip():
        raise LucidaError("", "is empty", REMEDY)
    blocks = _blocks(_MARGINS.sub(" ", text.replace("\u2212", "-")))
    of_lens = [block for block in blocks if _is_of_lens(block)]
    blocks = [block for block in blocks if not _is_of_lens(block)]
    lens = tuple(number for block in of_lens for number in block.numbers)
    lens = lens if any(lens) else ()
    size = _size(blocks)
    k = _named_k(blocks)
    matrices: list[Floats] = []
    rotation, shift = None, None
    for name, numbers in _groups(blocks):
        if len(numbers) in MATRIX:
            matrices.append(numbers)
        elif len(numbers) == 9:
            if k is None and (name in K_NAMES or not is_rotation(numbers.reshape(3, 3))):
                k = _as_k(numbers.reshape(3, 3))
            elif rotation is None:
                rotation = numbers
        elif len(numbers) == 3 and shift is None and name not in SIZE_NAMES:
            shift = numbers
    if len(matrices) > 1:
        raise LucidaError("", f"holds {len(matrices)} matrices", "paste one of them")
    if matrices:
        return Pasted(matrices[0], None, k, size, lens)
    if rotation is not None and shift is not None:
        return Pasted(rotation, shift, k, size, lens)
    raise _nothing(blocks, rotation, k)


def is_rotation(matrix: Floats) -> bool:
    """Return True if a (3, 3) matrix rotates, and perhaps mirrors or scales alike in all
    directions.
    """
    scale = abs(float(np.linalg.det(matrix))) ** (1 / 3)
    if not 1e-9 < scale < 1e9:
        return False
    unit = matrix / scale
    return bool(np.abs(unit @ unit.T - np.eye(3)).max() < ROUNDED)


def _nothing(blocks: Sequence[_Block], rotation: Floats | None, k: Floats | None) -> LucidaError:
    """Return the error that explains why there is no matrix."""
    if rotation is not None:
        return LucidaError("", "holds a rotation without a place", "paste t beside it, 3 numbers")
    if k is not None:
        problem = "holds K, which says nothing of where the camera stands"
        return LucidaError("", problem, "paste a pose beside it: 16 or 12 numbers, or R and t")
    count = sum(len(block.numbers) for block in blocks)
    told = f"holds {count} number{'s' * (count != 1)}, which are no matrix of a camera"
    return LucidaError("", told if count else "holds no numbers", REMEDY)


# From the text to numbers with names.


def _blocks(text: str) -> list[_Block]:
    blocks = [_Block()]
    depth, at = 0, 0
    while found := _TOKEN.search(text, at):
        at, kind, word = found.end(), found.lastgroup, found.group()
        if kind == "line":
            blocks[-1].end_line()
            if re.match(r"[ \t\r]*\n", text[at:]) and depth == 0:
                blocks[-1].end_unit()
        elif kind in ("name", "text"):
            name = word.strip("\"'")
            inside = _NUMBER.findall(name) if kind == "text" else []
            if given := _GIVEN.match(text, at):
                _begin(blocks, _plain(name))
                at = given.end()
            elif len(inside) >= NUMBER_OF_TEXT:
                for number in inside:
                    blocks[-1].add(_number(number))
            elif name.lower() in ("nan", "inf", "infinity"):
                raise LucidaError("", f"holds {name}", "paste finite numbers")
            elif lengths := _LENGTHS.match(text, at):
                at = lengths.end()
        elif kind == "extent":
            width, height = (int(side) for side in re.findall(r"\d+", word))
            if min(width, height) > 4:  # otherwise it is the matrix's own shape
                blocks.append(_Block("size", [[[float(width), float(height)]]]))
                blocks.append(_Block())
        elif kind == "number":
            blocks[-1].add(_number(word))
        elif kind == "other":
            depth = _other(blocks[-1], word, depth, text[found.start() :])
    return [block for block in blocks if block.numbers]


def _begin(blocks: list[_Block], name: str) -> None:
    """Begin the value of a name.

    The elements of one array belong to it one after another, also if each has a name: m00, m01, or
    _11, _12.
    """
    if element := _ELEMENT.fullmatch(name):
        name = element[1] or "_"
    if name and name == blocks[-1].name and len(blocks[-1].numbers) < 16:
        blocks[-1].end_line()
    else:
        blocks.append(_Block(name))


def _other(block: _Block, sign: str, depth: int, rest: str) -> int:
    """Read a single sign. Return the depth of brackets after it."""
    if sign in "([{<":
        return depth + 1
    if sign in ")]}>":
        depth = max(0, depth - 1)
        block.end_line()
        if depth == 0:
            block.end_unit()
    elif sign == ";":
        block.end_line()
    elif sign == "*" and len(block.numbers) == 1:
        block.factor, block.units = block.numbers[0], [[[]]]
    elif sign == "." and rest.startswith("..."):
        raise LucidaError("", "leaves numbers out: ...", "print all of them")
    elif sign in "+-*/^" or sign.isdigit():
        word = rest.split(None, 1)[0][:20]
        raise LucidaError("", f"has {word!r}, which is no plain number", "paste plain numbers")
    return depth


def _number(word: str) -> float:
    number = float(word.rstrip("fFlL"))
    if not np.isfinite(number):
        raise LucidaError("", f"has {word}, which is too large", "paste finite numbers")
    return number


def _plain(name: str) -> str:
    """Return a name as in the tables above: without module, case, underscores, spaces."""
    return re.sub(r"[^a-z0-9]", "", re.split(r"\.|::", name)[-1].lower())


def _groups(blocks: Iterable[_Block]) -> list[tuple[str, Floats]]:
    """Return the arrays, each with its name: adjacent numbers of a known length."""
    found: list[tuple[str, list[float]]] = []
    for block in blocks:
        units = [[line for line in unit if line] for unit in block.units]
        sizes = [sum(map(len, unit)) for unit in units]
        if sum(sizes) in KNOWN and not any(size in (9, *MATRIX) for size in sizes):
            units = [[block.numbers]]
        for unit in units:
            numbers = [number for line in unit for number in line]
            parts = [numbers] if len(numbers) in KNOWN else _by_length(unit)
            found += [(block.name, [block.factor * one for one in part]) for part in parts]
    return [(name, np.array(numbers)) for name, numbers in found if numbers]


def _by_length(lines: Sequence[list[float]]) -> list[list[float]]:
    """Split lines of 3 and lines of 4 numbers into two arrays."""
    parts: list[list[float]] = []
    last = 0
    for line in lines:
        if len(line) != last:
            parts.append([])
        parts[-1] += line
        last = len(line)
    return parts


# The matrix's surroundings.


def _is_of_lens(block: _Block) -> bool:
    count = len(block.numbers)
    is_letter = LENS_LETTER.fullmatch(block.name) is not None
    return count > 0 and (
        block.name in LENS_NAMES
        or (is_letter and (count >= 4) == (block.name == "d") and count < 16)
    )


def _size(blocks: Sequence[_Block]) -> Size | None:
    width, height = 0.0, 0.0
    for block in blocks:
        numbers = block.numbers
        if block.name in SIZE_NAMES and len(numbers) == 2:
            width, height = numbers
        elif block.name in WIDTH_NAMES and len(numbers) == 1:
            width = numbers[0]
        elif block.name in HEIGHT_NAMES and len(numbers) == 1:
            height = numbers[0]
    if not (width and height):
        return None
    if int(width) != width or int(height) != height:
        raise LucidaError("size", f"{width:g} x {height:g} is no image's", "give whole pixels")
    return check_size((int(width), int(height)))


def _named_k(blocks: Sequence[_Block]) -> Floats | None:
    """Return K from its numbers' own names."""
    found = {
        FOCAL[block.name]: block.numbers[0]
        for block in blocks
        if block.name in FOCAL and len(block.numbers) == 1
    }
    if not {"fx", "cx", "cy"} <= found.keys():
        return None
    fx, fy = found["fx"], found.get("fy", found["fx"])
    return np.array([[fx, found.get("s", 0.0), found["cx"]], [0, fy, found["cy"]], [0, 0, 1.0]])


def _as_k(matrix: Floats) -> Floats:
    """Return K by rows; MATLAB prints it by columns. Raises LucidaError for an invalid one."""
    for k in (matrix, matrix.T):
        if not (k[1, 0] or k[2, 0] or k[2, 1]) and k[0, 0] and k[1, 1] and k[2, 2]:
            normal: Floats = k / k[2, 2]
            return normal
    problem = "holds 9 numbers that are neither K, with zeros below its diagonal, nor a rotation"
    raise LucidaError("", problem, "paste K as [fx s cx], [0 fy cy], [0 0 1]")
