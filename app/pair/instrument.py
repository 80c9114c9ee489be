"""Both images, as the window takes them."""

from __future__ import annotations

from collections.abc import Sequence

from app.host.instrument import Instrument
from app.host.view import View
from app.pair.actions import IMAGE, MOUSE
from app.pair.view import Linked, RasterView, RayView


def _make(views: Sequence[View]) -> list[View]:
    linked = Linked()
    return [RasterView(linked), RayView(linked)]


INSTRUMENT = Instrument(_make, IMAGE, MOUSE)
