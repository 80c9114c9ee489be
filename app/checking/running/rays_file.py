"""A file of rays, from any language, as what answers calls of viewing_ray: .csv or .npy."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.checking.calls import Call, Failure, Run
from renderer.errors import LucidaError, shortened

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
_COMMENTS = ("#", "//", "%")


@dataclass(frozen=True)
class _Ray:
    place: str  # in the file, for messages
    numbers: tuple[float, ...]


class RaysFile:
    """Answers every call that has i and j by the file's ray of that pixel. base: what the rows and
    columns of an .npy of shape (H, W, 6) are counted from."""

    survived = False

    def __init__(self, path: Path | str, base: int = 0) -> None:
        self._path, self._base = Path(path), base
        self._rays: dict[tuple[int, int], _Ray] | None = None

    def functions(self) -> None:
        """Whichever has i and j. Raises LucidaError where the file cannot be used."""
        if self._rays is None:
            self._rays = self._read()

    def call(self, calls: Sequence[Call]) -> Run:
        try:
            self.functions()
        except LucidaError as error:
            return Run((), "", Failure("missing", str(error)))
        return Run(tuple(self._answer(call, number) for number, call in enumerate(calls)))

    def stop(self) -> None:
        """Nothing runs."""

    def close(self) -> None:
        """Nothing is open."""

    def _answer(self, call: Call, number: int) -> Any:
        assert self._rays
        given = dict(call.arguments)
        if "i" not in given or "j" not in given:
            text = f"a file of rays answers nothing but rays by i and j, not {call.function}"
            return Failure("missing", f"{self._path.name}: {text}", call=number)
        ray = self._rays.get((given["i"], given["j"]))
        if ray is None:
            (top, bottom), (left, right) = ((min(n), max(n)) for n in zip(*self._rays, strict=True))
            has = f"it has i from {top} to {bottom} and j from {left} to {right}"
            text = f"there is no ray of pixel i = {given['i']}, j = {given['j']}; {has}"
            return Failure("missing", f"{self._path.name}: {text}", call=number)
        return {"origin": [*ray.numbers[:3]], "direction": [*ray.numbers[3:]]}

    def _read(self) -> dict[tuple[int, int], _Ray]:
        name = self._path.name
        rays: dict[tuple[int, int], _Ray] = {}
        try:
            if self._path.is_dir():
                raise LucidaError("", "it is a folder", "give a .csv or .npy file")
            if self._path.stat().st_size > _LONGEST_FILE:
                raise LucidaError("", "it is longer than 256 MB", "give fewer rays")
            binary = self._path.suffix.lower() == ".npy"
            found = self._from_array() if binary else _from_text(self._path.read_bytes())
            for place, numbers in found:
                pixel = (_index(place, "i", numbers[0]), _index(place, "j", numbers[1]))
                ray = _Ray(place, numbers[2:])
                before = rays.setdefault(pixel, ray)
                if repr(before.numbers) != repr(ray.numbers):  # NaN is equal to itself here
                    told = (
                        f"another ray of pixel i = {pixel[0]}, j = {pixel[1]} than {before.place}"
                    )
                    raise LucidaError(place, told, "give one ray a pixel")
        except LucidaError as error:
            raise error.in_file(name) from None
        except FileNotFoundError:
            raise LucidaError("", "there is no such file", source=str(self._path)) from None
        except OSError as error:
            raise LucidaError("", f"cannot be read: {error.strerror}", source=name) from None
        if not rays:
            raise LucidaError("", "it has no rays", _NAMES, name)
        return rays

    def _from_array(self) -> Iterator[tuple[str, tuple[float, ...]]]:
        try:
            with self._path.open("rb") as file:
                array = np.lib.format.read_array(file, allow_pickle=False)
        except (ValueError, EOFError, MemoryError, SyntaxError, TypeError, OverflowError) as error:
            told = f"is no array of numbers that NumPy wrote: {error}"
            raise LucidaError("", told, "write it with numpy.save") from None
        table, place = _table(array, self._base)
        for row, numbers in enumerate(table.tolist()):
            yield place(row), tuple(numbers)


def _table(array: NDArray[Any], base: int) -> tuple[NDArray[np.float64], Callable[[int], str]]:
    """(N, 8), and where a row of it is in the array."""

    def row_place(row: int) -> str:
        return f"row {row}"

    if array.dtype.names is not None:
        names = [*array.dtype.names]
        array = array.reshape(-1)
        columns = [_real(array[names[field]]) for field in _places(names, "its fields").values()]
        if any(column.ndim != 1 for column in columns):
            raise LucidaError("", "its fields hold more than one number each", _NAMES)
        return np.stack(columns, -1), row_place
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


def _from_text(data: bytes) -> Iterator[tuple[str, tuple[float, ...]]]:
    where: dict[str, int] | None = None
    separator: str | None = None
    for number, line in enumerate(_text(data).splitlines(), 1):
        text = line.strip()
        if not text.strip(";, \t") or text.startswith(_COMMENTS):
            continue
        place = f"line {number}"
        if where is None:
            separator = next((sign for sign in ";\t," if sign in text), None)
        cells = [cell.strip().strip("\"'").strip() for cell in text.split(separator)]
        while not cells[-1]:
            cells.pop()
        if where is None:
            named = any(_number(cell, separator) is None for cell in cells)
            if named:
                where = _places(cells, place)
                continue
            where = dict(zip(_COLUMNS, range(8), strict=True))
            if len(cells) != 8:
                raise LucidaError(place, f"has {len(cells)} numbers, not 8", _NAMES)
        if len(cells) <= max(where.values()):
            raise LucidaError(place, f"has {len(cells)} values", "give i, j and the six of its ray")
        numbers = []
        for name, column in where.items():
            value = _number(cells[column], separator)
            if value is None:
                told = f"{name} is {shortened(cells[column], 40)!r}, no number"
                raise LucidaError(place, told, "write numbers such as -0.25")
            numbers.append(value)
        yield place, tuple(numbers)


def _text(data: bytes) -> str:
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):
        return data.decode("utf-16", "replace")
    if b"\0" in data:
        raise LucidaError("", "is no text", "write numbers, separated by commas")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("latin-1")


def _places(names: list[str], place: str) -> dict[str, int]:
    """Where each column is, in their order in _COLUMNS."""
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
    """Also what C writes for NaN, and a comma for the point where it separates no columns."""
    if separator != ",":
        cell = cell.replace(",", ".")
    plain = cell.lower().lstrip("+-")
    if plain.startswith(("nan", "1.#")):
        return float("inf" if plain.startswith("1.#inf") else "nan")
    try:
        return float(cell)
    except ValueError:
        return None


def _index(place: str, name: str, value: float) -> int:
    if not value.is_integer():
        raise LucidaError(place, f"{name} is {value:g}, no whole number", "count pixels")
    return int(value)
