"""Files of rays, .csv or .npy, which any language can write, as answers to viewing_ray."""

from __future__ import annotations

import io
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.checking.calls import Call, Failure, Run
from renderer.errors import LucidaError, shortened
from renderer.scene.reading import read_file

_COLUMNS = ("i", "j", "ox", "oy", "oz", "dx", "dy", "dz")
_NAMES = "name its columns i, j, ox, oy, oz, dx, dy, dz"
_LONGEST_FILE = 1 << 28  # bytes
_MOST_RAYS = 1 << 23
_PIXELS = 1 << 30  # rows and columns are smaller
_COMMENTS = ("#", "//", "%")

Floats = NDArray[np.float64]


class RaysFile:
    """A student whose answers are in a file: each call with i and j gets the ray of that pixel.

    base: the number of the first row and column of an .npy of shape (H, W, 6).
    """

    survived = False

    def __init__(self, path: Path | str, base: int = 0) -> None:
        self._path, self._base = Path(path), base
        self._rays: dict[tuple[float, float], list[float]] = {}

    def functions(self) -> None:
        """Read the file; it answers any function with i and j. Raise LucidaError on failure."""
        if self._rays:
            return
        data = read_file(self._path, _LONGEST_FILE)
        try:
            is_array = self._path.suffix.lower() == ".npy"
            table = _from_array(data, self._base) if is_array else _from_text(data)
            self._rays = _by_pixel(table)
        except LucidaError as error:
            raise error.in_file(self._path.name) from None

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
        given = dict(call.arguments)
        if "i" not in given or "j" not in given:
            text = f"a file of rays answers nothing but rays by i and j, not {call.function}"
        elif ray := self._rays.get((given["i"], given["j"])):
            return {"origin": ray[:3], "direction": ray[3:]}
        else:
            text = f"there is no ray of pixel i = {given['i']}, j = {given['j']}"
        return Failure("missing", f"{self._path.name}: {text}", call=number)


def _by_pixel(table: Floats) -> dict[tuple[float, float], list[float]]:
    """Return origin and direction by (i, j), from rows of eight numbers."""
    if not 0 < len(table) <= _MOST_RAYS:
        remedy = f"give up to {_MOST_RAYS:,} rays; {_NAMES}"
        raise LucidaError("", f"it has {len(table):,} rays", remedy)
    pixels = table[:, :2]
    wrong = ~((abs(pixels) < _PIXELS) & (pixels == np.floor(pixels)))  # also flags NaN
    if wrong.any():
        row, column = divmod(int(wrong.argmax()), 2)
        problem = f"{_COLUMNS[column]} is {pixels[row, column]:g}, no whole number of a pixel"
        raise LucidaError(f"ray {row + 1}", problem, "count pixels")
    rays: dict[tuple[float, float], list[float]] = {}
    for number, (i, j, *ray) in enumerate(table.tolist(), 1):
        known = rays.setdefault((i, j), ray)
        if known is not ray and not np.array_equal(known, ray, equal_nan=True):
            problem = f"is another one of pixel i = {i:.0f}, j = {j:.0f}"
            raise LucidaError(f"ray {number}", problem, "give one ray a pixel")
    return rays


def _from_array(data: bytes, base: int) -> Floats:
    """Return a table (N, 8)."""
    try:
        array = np.lib.format.read_array(io.BytesIO(data), allow_pickle=False)
    except (ValueError, EOFError, SyntaxError, TypeError, ArithmeticError, MemoryError) as error:
        problem = f"is no array of numbers that NumPy wrote: {shortened(str(error), 120)}"
        raise LucidaError("", problem, "write it with numpy.save") from None
    if array.dtype.kind not in "fiub":
        raise LucidaError("", f"holds {array.dtype}, not numbers", "save floats")
    if array.ndim == 2 and array.shape[1] == 8:
        return array.astype(np.float64)
    if array.ndim == 3 and array.shape[2] == 6:
        i, j = np.mgrid[: array.shape[0], : array.shape[1]] + base
        return np.dstack([i, j, array]).astype(np.float64).reshape(-1, 8)
    told = f"has the shape {array.shape}"
    raise LucidaError("", told, "wanted are (N, 8), rows i j ox oy oz dx dy dz, or (H, W, 6)")


def _from_text(data: bytes) -> Floats:
    """Return a table (N, 8)."""
    lines = [line.strip() for line in data.decode("utf-8-sig", "replace").splitlines()]
    lines = [line for line in lines if line and not line.startswith(_COMMENTS)]
    separator = next((sign for sign in ";\t," if lines and sign in lines[0]), None)
    if separator != ",":  # the decimal point may be a comma
        lines = [line.replace(",", ".") for line in lines]
    columns = list(range(8))
    if lines and re.search("[a-z]", re.sub(r"nan|inf(inity)?|\de", "", lines[0].lower())):
        columns = _places(lines.pop(0).split(separator))
    if not lines:
        return np.empty((0, 8))
    try:
        return np.loadtxt(lines, delimiter=separator, usecols=columns, ndmin=2, comments=None)
    except ValueError as error:
        raise LucidaError("", shortened(str(error), 120), _NAMES) from None


def _places(names: list[str]) -> list[int]:
    """Return the index of each column, in the order of _COLUMNS."""
    plain = [re.sub(r"[^a-z]", "", name.lower()) for name in names]
    plain = [re.sub("^(o|d)[a-z]*([xyz])$", r"\1\2", name) for name in plain]
    plain = [{"row": "i", "column": "j", "col": "j"}.get(name, name) for name in plain]
    for name in _COLUMNS:
        if plain.count(name) != 1:
            count = "two columns are named" if name in plain else "there is no column"
            raise LucidaError("line 1", f"{count} {name}", _NAMES)
    return [plain.index(name) for name in _COLUMNS]
