"""Fields inside fields: errors get the path of what they are in.

Knows nothing of what is read.
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterator

from app.lecture.text import TextError
from renderer.errors import LucidaError


@contextlib.contextmanager
def under(field: str) -> Iterator[None]:
    """Errors inside get their field under `field`; those of a text keep their line in it."""
    try:
        yield
    except TextError as error:
        error.field = f"{field}.{error.field}" if error.field else field
        raise
    except LucidaError as error:
        raise error.within(field) from None
