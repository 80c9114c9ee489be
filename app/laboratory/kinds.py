"""The kinds of raster image that the lecture names, and what each costs.

Owns their names, bits and bytes. Knows nothing of how an image becomes one (stored.py).
"""

from __future__ import annotations

from dataclasses import dataclass

LECTURE_SIZE = (1024, 1024)  # the lecture's megapixel


@dataclass(frozen=True)
class Kind:
    """name: as switches give it. bits: of one pixel."""

    name: str
    title: str
    bits: int

    @property
    def is_float(self) -> bool:
        """True if the kind keeps linear light, beyond what a display can show."""
        return self.name in ("half", "float")

    def storage_bytes(self, size: tuple[int, int]) -> int:
        """Bytes of an image of (width, height), uncompressed; rows begin at a whole byte."""
        width, height = size
        return -(-width * self.bits // 8) * height


BITMAP = Kind("bitmap", "Bitmap", 1)
GRAY = Kind("gray", "Grayscale", 8)
COLOR = Kind("color", "Colour", 24)
HALF = Kind("half", "Half float", 48)
FLOAT = Kind("float", "Single float", 96)

KINDS = (BITMAP, GRAY, COLOR, HALF, FLOAT)
