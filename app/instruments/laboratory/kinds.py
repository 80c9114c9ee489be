"""The kinds of raster image that the lecture names, and their costs."""

from __future__ import annotations

from dataclasses import dataclass

LECTURE_SIZE = (1024, 1024)  # the lecture's megapixel


@dataclass(frozen=True)
class Kind:
    """A kind of raster image. bits: the number of bits per pixel."""

    title: str
    bits: int

    @property
    def each(self) -> str:
        """Return its bits as a caption."""
        return "1 bit per pixel" if self.bits == 1 else f"{self.bits} bits per pixel"

    def storage_bytes(self, size: tuple[int, int]) -> int:
        """Return the bytes of an uncompressed image of (width, height), whose rows begin at whole
        bytes.
        """
        width, height = size
        return -(-width * self.bits // 8) * height


BITMAP = Kind("Bitmap", 1)
GRAY = Kind("Grayscale", 8)
COLOR = Kind("Colour", 24)
FLOAT = Kind("Floating point", 96)

KINDS = (BITMAP, GRAY, COLOR, FLOAT)
