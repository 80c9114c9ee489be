"""The kinds of raster image that the lecture names, and what each costs.

Owns their names, bits and bytes. Knows nothing of how an image becomes one (stored.py).
"""

from __future__ import annotations

from dataclasses import dataclass

LECTURE_SIZE = (1024, 1024)  # the lecture's megapixel


@dataclass(frozen=True)
class Kind:
    """name: as files and switches give it. bits: of one pixel.

    levels: what one number can be, in words. use: what the kind is good for.
    """

    name: str
    title: str
    bits: int
    levels: str
    use: str

    @property
    def is_float(self) -> bool:
        """True if the kind keeps linear light, beyond what a display can show."""
        return self.name in ("half", "float")

    def storage_bytes(self, size: tuple[int, int]) -> int:
        """Bytes of an image of (width, height), uncompressed; rows begin at a whole byte."""
        width, height = size
        return -(-width * self.bits // 8) * height


BITMAP = Kind("bitmap", "Bitmap", 1, "0 or 1", "text, line art, masks")
GRAY = Kind("gray", "Grayscale", 8, "0 to 255", "photographs without colour")
COLOR = Kind("color", "Colour", 24, "0 to 255, three times", "displays, nearly all pictures")
HALF = Kind("half", "Half float", 48, "11 bits of precision, up to 65504", "high dynamic range")
FLOAT = Kind("float", "Single float", 96, "24 bits of precision, up to 3e38", "processing")

KINDS = (BITMAP, GRAY, COLOR, HALF, FLOAT)
