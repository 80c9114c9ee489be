"""The storage of one megapixel, as bars to scale."""

from __future__ import annotations

from lucida.app.instruments.outside.figure import Figure

from .kinds import KINDS, LECTURE_SIZE
from .page import Page
from .sheet import reached, rectangle

LONGEST, LEFT, STEP = 12.0, 14.4, 4.7


def storage(page: Page) -> Figure:
    """Draw a bar for each kind of image. Each build adds one, which grows."""
    sheet, look = page.sheet((32, 20.6)), page.look
    largest = KINDS[-1].storage_bytes(LECTURE_SIZE)
    width, height = LECTURE_SIZE
    sheet.word(f"{width} x {height} pixels", (0, 1.0), 1.6, look.dim, align=0.0)
    for number, kind in enumerate(KINDS):
        part = reached(page.progress, number)
        middle, count = 4.4 + STEP * number, kind.storage_bytes(LECTURE_SIZE)
        length = part * LONGEST * count / largest
        row = sheet.part((0, middle), part)
        row.word(kind.title, (0, -0.8), 1.4, strong=True, align=0.0)
        row.word(kind.each, (0, 1.0), 1.6, look.dim, align=0.0)
        row.fill(rectangle((LEFT, -1.3), (length, 2.6)), look.w)
        row.word(short(count), (LEFT + length + 0.5, 0), 1.5, strong=True, align=0.0)
    return sheet.figure()


def short(count: int) -> str:
    """Return a number of bytes in KB or MB, of 1024 and 1024 x 1024 bytes."""
    return f"{count >> 20} MB" if count >> 20 else f"{count >> 10} KB"
