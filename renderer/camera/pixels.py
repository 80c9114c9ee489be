"""The numbering of pixels for the user: the only place where a row and column become text.

Internally, in arrays, files and arguments, a pixel is (row, column) from 0, row 0 at the top. Users
read and type numbers from 0, as in arrays, or from 1, as in lectures; the text says which.
"""

from __future__ import annotations

from enum import Enum

Pixel = tuple[int, int]

# Texels per pixel, along a side, of the pinhole images in which a lens's image is looked up.
ENLARGEMENTS = (1, 2, 4)
ENLARGEMENT = 2


class Indexing(Enum):
    """The first number of a pixel: 1, as in the lecture, or 0, as in arrays."""

    ARRAY = 0
    LECTURE = 1

    @property
    def told(self) -> str:
        """The text `from 1`, or `from 0`."""
        return f"from {self.value}"

    @property
    def offset(self) -> str:
        """The term that leads from a pixel's number to its centre."""
        return "- 0.5" if self is Indexing.LECTURE else "+ 0.5"

    def numbers(self, pixel: Pixel) -> tuple[int, int]:
        """Return row and column in the user's numbering."""
        return pixel[0] + self.value, pixel[1] + self.value

    def pixel(self, row: int, column: int) -> Pixel:
        """Return the pixel at a row and column in the user's numbering."""
        return row - self.value, column - self.value

    def text(self, pixel: Pixel) -> str:
        """Return `(12, 40)`."""
        row, column = self.numbers(pixel)
        return f"({row}, {column})"

    def short(self, pixel: Pixel) -> str:
        """Return `12,40`, for narrow places."""
        row, column = self.numbers(pixel)
        return f"{row},{column}"

    def words(self, pixel: Pixel) -> str:
        """Return `row 12, column 40`."""
        row, column = self.numbers(pixel)
        return f"row {row}, column {column}"
