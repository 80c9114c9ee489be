"""Find an opened thing of a kind, which a test knows to be there."""

from __future__ import annotations

from typing import TypeVar

from lucida.app.window.opening import Opened

T = TypeVar("T")


def found(opened: Opened, kind: type[T]) -> T:
    thing = opened.find(kind)
    assert thing is not None
    return thing
