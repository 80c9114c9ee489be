"""Files of rays, .csv or .npy, which any language can write, as answers to viewing_ray."""

from __future__ import annotations

import io
import itertools
import re
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.checking.calls import Call, Failure, Limits, Run
from renderer.errors import LucidaError, shortened
from renderer.scene.reading import read_file

_COLUMNS = ("i", "j", "ox", "oy", "oz", "dx", "dy", "dz")
_ALSO = {
    "row": "i",
    "column": "j",
    "col": "j",
    **{f"{long}{axis}": f"{long[0]}{axis}" for long in ("origin", "direction") for axis in "xyz"},
    **{f"dir{axis}": f"d{axis}" for axis in "xyz"},
}
_NAMES = "name its columns i, j, ox, oy, oz, dx, dy, dz"
_LONGEST_FILE = 1 << 28  # bytes
_LONGEST_LINE = 1 << 16
_MOST_RAYS = 1 << 23
_PIXELS = 1 << 30  # rows and columns are smaller
_PIECE = 1 << 16  # lines to read at a time
_TOO_MUCH = (MemoryError, RecursionError)
_COMMENTS = ("#", "//", "%")


class RaysFile:
    """A student whose answers are in a file: each call with i and j gets the ray of that pixel.

    base: the number of the first row and column of an .npy of shape (H, W, 6).
    seconds: the time limit for reading the file.
    """

    survived = False

    def __init__(self, path: Path | str, base: int = 0, seconds: float = Limits.seconds) -> None:
        self._path, self._base, self._seconds = Path(path), base, seconds
        self._rays: _Rays | None = None

    def functions(self) -> None:
        """Read the file; it answers any function with i and j. Raise LucidaError on failure."""
        if self._rays is None:
            self._rays = self._read()

    def call(self, calls: Sequence[Call]) -> Run:
        """Return the ray of each call's pixel."""
        try:
            self.functions()
        except LucidaError as error:
            return Run((), "", Failure("missing", str(error)))
        return Run(tuple(self._answer(call, number) for number, call in enumerate(calls)))

    def stop(self) -> None:
        """Do nothing: no process is running."""

    def close(self) -> None:
        """Do nothing: no file is open."""

    def _answer(self, call: Call, number: int) -> Any:
        assert self._rays
        given = dict(call.arguments)
        if "i" not in given or "j" not in given:
            text = f"a file of rays answers nothing but rays by i and j, not {call.function}"
        elif ray := self._rays.at(given["i"], given["j"]):
            return {"origin": ray[:3], "direction": ray[3:]}
        else:
            pixel = f"i = {given['i']}, j = {given['j']}"
            text = f"there is no ray of pixel {pixel}; {self._rays.extent}"
        return Failure("missing", f"{self._path.name}: {text}", call=number)

    def _read(self) -> _Rays:
        end = time.monotonic() + self._seconds

        def check_time() -> None:
            if time.monotonic() > end:
                problem = f"reading it takes longer than {self._seconds:g} s"
                raise LucidaError("", problem, "give fewer rays, or a longer time limit")

        data = read_file(self._path, _LONGEST_FILE)
        try:
            if self._path.suffix.lower() == ".npy":
                table, place = _table(_array(data), self._base)
            else:
                table, place = _from_text(data, check_time)
            check_time()
            _check_count(len(table))
            if not len(table):
                raise LucidaError("", "it has no rays", _NAMES)
            return _Rays(table, place)
        except LucidaError as error:
            raise error.in_file(self._path.name) from None


class _Rays:
    """Rays by pixel, from a table (N, 8). extent: which pixels have rays, in words. Raise
    LucidaError if two rays of a pixel differ."""

    def __init__(self, table: NDArray[np.float64], place: Callable[[int], str]) -> None:
        pixels = table[:, :2]
        wrong = ~((abs(pixels) < _PIXELS) & (pixels == np.floor(pixels)))  # also flags NaN
        if wrong.any():
            row, column = divmod(int(wrong.argmax()), 2)
            problem = f"{_COLUMNS[column]} is {pixels[row, column]:g}, no whole number of a pixel"
            raise LucidaError(place(row), problem, "count pixels")
        # Once: each missing pixel of a file of a million rays tells it.
        (top, left), (bottom, right) = pixels.min(0), pixels.max(0)
        self.extent = (
            f"it has i from {top:.0f} to {bottom:.0f} and j from {left:.0f} to {right:.0f}"
        )
        keys = _key(*pixels.astype(np.int64).T)
        order = np.argsort(keys, kind="stable")
        self._keys, self._values = keys[order], table[order, 2:]
        before, after = self._values[:-1], self._values[1:]
        equal = ((before == after) | (np.isnan(before) & np.isnan(after))).all(1)
        clashes = np.flatnonzero((self._keys[:-1] == self._keys[1:]) & ~equal)
        if len(clashes):
            first = clashes[order[clashes + 1].argmin()]
            i, j = pixels[order[first]]
            problem = f"another ray of pixel i = {i:.0f}, j = {j:.0f} than {place(order[first])}"
            raise LucidaError(place(order[first + 1]), problem, "give one ray a pixel")

    def at(self, i: int, j: int) -> list[float]:
        """Return origin and direction, or nothing if this pixel has no ray."""
        place = int(np.searchsorted(self._keys, _key(i, j)))
        if place == len(self._keys) or self._keys[place] != _key(i, j):
            return []
        return self._values[place].tolist()


def _key(i: Any, j: Any) -> Any:
    return i * 2 * _PIXELS + j


def _check_count(rays: int) -> None:
    if rays > _MOST_RAYS:
        raise LucidaError("", f"it has {rays:,} rays", f"give up to {_MOST_RAYS:,}")


def _array(data: bytes) -> NDArray[Any]:
    try:
        return np.lib.format.read_array(io.BytesIO(data), allow_pickle=False)
    except (ValueError, EOFError, SyntaxError, TypeError, ArithmeticError, *_TOO_MUCH) as error:
        problem = f"is no array of numbers that NumPy wrote: {shortened(str(error), 120)}"
        raise LucidaError("", problem, "write it with numpy.save") from None


def _table(array: NDArray[Any], base: int) -> tuple[NDArray[np.float64], Callable[[int], str]]:
    """Return a table (N, 8), and a function that describes the place of a row in the array."""

    def row_place(row: int) -> str:
        return f"row {row}"

    if array.dtype.names is not None:
        names = [*array.dtype.names]
        array = array.reshape(-1)
        columns = [_real(array[names[field]]) for field in _places(names, "its fields").values()]
        if any(column.ndim != 1 for column in columns):
            raise LucidaError("", "its fields hold more than one number each", _NAMES)
        return np.stack(columns, -1), row_place
    if array.ndim in (2, 3):  # before it is copied as float64
        _check_count(len(array) if array.ndim == 2 else len(array) * array.shape[1])
    array = _real(array)
    if array.ndim == 2 and array.shape[1] == 8:
        return array, row_place
    if array.ndim == 3 and array.shape[2] == 6:
        width = array.shape[1]
        i, j = np.mgrid[: array.shape[0], :width] + base
        table = np.dstack([i, j, array]).reshape(-1, 8)
        return table, lambda row: f"[{row // width}, {row % width}]"
    told = f"has the shape {array.shape}"
    raise LucidaError("", told, "wanted are (N, 8), rows i j ox oy oz dx dy dz, or (H, W, 6)")


def _real(array: NDArray[Any]) -> NDArray[np.float64]:
    if array.dtype.kind not in "fiub":
        raise LucidaError("", f"holds {array.dtype}, not numbers", "save floats")
    return array.astype(np.float64)


def _from_text(
    data: bytes, check_time: Callable[[], None]
) -> tuple[NDArray[np.float64], Callable[[int], str]]:
    """Return a table (N, 8), and a function that describes the line of a row."""
    lines = _lines(io.TextIOWrapper(io.BytesIO(data), _encoding(data), "replace"), check_time)
    first = next(lines, None)
    if first is None:
        return np.empty((0, 8)), str
    separator = next((sign for sign in ";\t," if sign in first[1]), None)
    cells, place = _cells(first[1], separator), f"line {first[0]}"
    if any(_number(cell, separator) is None for cell in cells):
        columns = _places(cells, place)
    else:
        columns = dict(zip(_COLUMNS, range(8), strict=True))
        lines = itertools.chain([first], lines)
        if len(cells) != 8:
            raise LucidaError(place, f"has {len(cells)} numbers, not 8", _NAMES)
    numbers, rows = [np.empty(0, np.int64)], [np.empty((0, 8))]
    while piece := list(itertools.islice(lines, _PIECE)):
        numbers.append(np.array([number for number, _ in piece]))
        rows.append(_rows(piece, columns, separator))
    line = np.concatenate(numbers)
    return np.concatenate(rows), lambda row: f"line {line[row]}"


def _lines(text: Iterable[str], check_time: Callable[[], None]) -> Iterator[tuple[int, str]]:
    """Yield number and text of each line that is neither empty nor a comment."""
    for number, line in enumerate(text, 1):
        if number % _PIECE == 0:
            check_time()
        if len(line) > _LONGEST_LINE:
            raise LucidaError(f"line {number}", f"has {len(line):,} characters", _NAMES)
        line = line.strip()
        if line.strip(";, \t") and not line.startswith(_COMMENTS):
            yield number, line


def _rows(
    lines: list[tuple[int, str]], columns: dict[str, int], separator: str | None
) -> NDArray[np.float64]:
    texts = [text.replace("'", '"') for _, text in lines]
    if separator != ",":
        texts = [text.replace(",", ".") for text in texts]
    use = [*columns.values()]
    try:  # several times faster than row by row
        table = np.loadtxt(
            texts, delimiter=separator, usecols=use, ndmin=2, comments=None, quotechar='"'
        )
        if len(table) == len(lines):  # quoted cells may contain line breaks
            return table
    except ValueError:
        pass  # an unusual notation, or a mistake
    return np.array([_row(f"line {n}", _cells(t, separator), columns, separator) for n, t in lines])


def _row(
    place: str, cells: list[str], columns: dict[str, int], separator: str | None
) -> list[float]:
    if len(cells) <= max(columns.values()):
        raise LucidaError(place, f"has {len(cells)} values", "give i, j and the six of its ray")
    numbers = []
    for name, column in columns.items():
        value = _number(cells[column], separator)
        if value is None:
            problem = f"{name} is {shortened(cells[column], 40)!r}, no number"
            raise LucidaError(place, problem, "write numbers such as -0.25")
        numbers.append(value)
    return numbers


def _cells(text: str, separator: str | None) -> list[str]:
    cells = [cell.strip().strip("\"'").strip() for cell in text.split(separator)]
    while not cells[-1]:
        cells.pop()
    return cells


def _encoding(data: bytes) -> str:
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):
        return "utf-16"
    if b"\0" in data:
        raise LucidaError("", "is no text", "write numbers, separated by commas")
    try:
        data.decode("utf-8")
    except UnicodeDecodeError:
        return "latin-1"
    return "utf-8-sig"


def _places(names: list[str], place: str) -> dict[str, int]:
    """Return the index of each column, in the order of _COLUMNS."""
    found: dict[str, int] = {}
    for column, name in enumerate(names):
        plain = re.sub(r"[^a-z0-9]", "", name.lower())
        plain = _ALSO.get(plain, plain)
        if plain in _COLUMNS and found.setdefault(plain, column) != column:
            raise LucidaError(place, f"two columns are named {plain}", _NAMES)
    missing = [name for name in _COLUMNS if name not in found]
    if missing:
        raise LucidaError(place, f"there is no column {missing[0]}", _NAMES)
    return {name: found[name] for name in _COLUMNS}


def _number(cell: str, separator: str | None) -> float | None:
    """Return a cell's number; None if it has none.

    NaN may be written as C writes it. The decimal point may be a comma if commas do not separate
    cells.
    """
    if separator != ",":
        cell = cell.replace(",", ".")
    plain = cell.lower().lstrip("+-")
    if plain.startswith(("nan", "1.#")):
        return float("inf" if plain.startswith("1.#inf") else "nan")
    try:
        return float(cell)
    except ValueError:
        return None
