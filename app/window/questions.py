"""The window's questions: the text, and the labels of one or two buttons next to Cancel."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from renderer.errors import one_line
from renderer.scene.outside import LISTED


@dataclass(frozen=True)
class WindowQuestion:
    """answer: the words on the button. then: does it. other: another button, and what that does."""

    text: str
    answer: str
    then: Callable[[], None]
    other: tuple[str, Callable[[], None]] | None = None


def outside_question(name: str, files: Sequence[Path]) -> str:
    """Return the question about files outside a folder. name: of the file that names them."""
    named = [f"    {one_line(str(file))}" for file in files]
    more = [f"    and {len(named) - LISTED} more"] if len(named) > LISTED else []
    return "\n".join([f"{name} names files outside of its folder:", *named[:LISTED], *more])
