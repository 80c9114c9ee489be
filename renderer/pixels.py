"""How a pixel's row and column are counted and written: the one place where they become text.

Inside, in arrays, files and arguments, a pixel is (row, column) from 0, row 0 at the top. What a
user reads or types is counted from 0, as arrays are, or from 1, as lectures do, and says which.
"""

from __future__ import annotations

from enum import Enum

Pixel = tuple[int, int]


class Indexing(Enum):
    """How pixels are counted: from 1, as the lecture does, or from 0, as arrays do."""

    ARRAY = 0
    LECTURE = 1

    @property
    def told(self) -> str:
        """`from 1`."""
        return f"from {self.value}"

    @property
    def offset(self) -> str:
        """What takes a pixel's number to its middle."""
        return "- 0.5" if self is Indexing.LECTURE else "+ 0.5"

    def numbers(self, pixel: Pixel) -> tuple[int, int]:
        """Row and column as the user counts them."""
        return pixel[0] + self.value, pixel[1] + self.value

    def pixel(self, row: int, column: int) -> Pixel:
        """The pixel of a row and a column as the user counts them."""
        return row - self.value, column - self.value

    def text(self, pixel: Pixel, digits: int = 0) -> str:
        """`(12, 40)`; digits: the width that each number is given."""
        row, column = self.numbers(pixel)
        return f"({row:{digits}d}, {column:{digits}d})"

    def short(self, pixel: Pixel) -> str:
        """`12,40`, for narrow places."""
        row, column = self.numbers(pixel)
        return f"{row},{column}"

    def words(self, pixel: Pixel) -> str:
        """`row 12, column 40`."""
        row, column = self.numbers(pixel)
        return f"row {row}, column {column}"
