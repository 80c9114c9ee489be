"""Files of rays, .csv or .npy, which any language can write, as answers to viewing_ray."""

from __future__ import annotations

import io
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.checking.calls import Call, Failure, Run
from renderer.errors import LucidaError, shortened
from renderer.scene.reading import read_file

_COLUMNS = ["i", "j", "ox", "oy", "oz", "dx", "dy", "dz"]
_LONGEST_FILE = 1 << 28  # bytes

Floats = NDArray[np.float64]


class RaysFile:
    """A student whose answers are in a file: each call with i and j gets the ray of that pixel.

    base: the number of the first row and column of an .npy of shape (H, W, 6).
    """

    survived = False

    def __init__(self, path: Path | str, base: int = 0) -> None:
        self._path, self._base = Path(path), base
        self._rays: dict[tuple[Any, Any], list[float]] = {}

    def functions(self) -> None:
        """Read the file; it answers any function with i and j. Raise LucidaError on failure."""
        if self._rays:
            return
        data = read_file(self._path, _LONGEST_FILE)
        try:
            is_array = self._path.suffix.lower() == ".npy"
            table = _from_array(data, self._base) if is_array else _from_text(data)
        except (
            ValueError,
            EOFError,
            SyntaxError,
            TypeError,
            ArithmeticError,
            MemoryError,
        ) as error:
            told = f"is no table of rays: {shortened(str(error), 120)}"
            remedy = f"give each ray a row of numbers: {' '.join(_COLUMNS)}"
            raise LucidaError("", told, remedy, self._path.name) from None
        self._rays = {(i, j): ray for i, j, *ray in table.tolist()}

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

    def _answer(self, call: Call, number: int) -> list[float] | Failure:
        given = dict(call.arguments)
        i, j = given.get("i"), given.get("j")
        if ray := self._rays.get((i, j)):
            return ray
        text = f"{self._path.name}: there is no ray of pixel i = {i}, j = {j}"
        return Failure("missing", text, call=number)


def _from_array(data: bytes, base: int) -> Floats:
    """Return a table (N, 8)."""
    array = np.lib.format.read_array(io.BytesIO(data), allow_pickle=False).astype(np.float64)
    if array.ndim == 3 and array.shape[2] == 6:
        i, j = np.mgrid[: array.shape[0], : array.shape[1]] + base
        return np.dstack([i, j, array]).reshape(-1, 8)
    if array.ndim == 2 and array.shape[1] == 8:
        return array
    raise ValueError(f"wanted are the shapes (N, 8) or (H, W, 6), not {array.shape}")


def _from_text(data: bytes) -> Floats:
    """Return a table (N, 8). The separator is a comma, a semicolon or white space."""
    text = data.decode("utf-8-sig", "replace").replace(",", " ").replace(";", " ")
    lines = [line for line in text.splitlines() if line.strip()]
    names = lines[0].lower().split() if lines else []
    columns = [names.index(name) for name in _COLUMNS] if "i" in names else range(8)
    rows = lines[1:] if "i" in names else lines
    if not rows:
        raise ValueError("it has 0 rays")
    return np.loadtxt(rows, usecols=columns, ndmin=2)
