"""The places of things in the outside view: for several topics of drives."""

from __future__ import annotations

import numpy as np
from window_driver import SIZE, Driver

from lucida.app.instruments.outside.mouse import Scope
from lucida.app.instruments.outside.projected import Strokes
from lucida.app.instruments.outside.screen import OutsideScreen
from lucida.app.instruments.outside.view import OUTSIDE, OutsideView

IMAGE = f"//###{OUTSIDE}/image##{OUTSIDE}"


def view(d: Driver) -> OutsideView:
    return d.window.views[OUTSIDE]


def enter(d: Driver) -> None:
    d.layout("Outside view")


def scope(d: Driver) -> Scope:
    return view(d).scope


def place(d: Driver, point: np.ndarray) -> tuple[float, float]:
    """Return the place of a world point in the window."""
    at = scope(d)
    size = max(1, round(at.extent.x)), max(1, round(at.extent.y))
    x, y = OutsideScreen(at.shown, size).seen(np.asarray(point, float)).points
    return at.origin.x + float(x), at.origin.y + float(y)


def empty_place(d: Driver) -> tuple[float, float]:
    """Over the view, and neither over the image plane nor a tool."""
    at = scope(d)
    return at.origin.x + 0.62 * at.extent.x, at.origin.y + 0.85 * at.extent.y


def press(d: Driver, name: str) -> None:
    """Select an entry of the view's menu."""
    d.click(f"//###{OUTSIDE}/Show##outside")
    d.click(f"//$FOCUSED/{name}")


def strokes(d: Driver, name: str) -> list[Strokes]:
    return [p for p in view(d).primitives if isinstance(p, Strokes) and p.name == name]


def rect(d: Driver) -> tuple[float, float, float, float]:
    box = d.box(IMAGE)
    assert box.max.x <= SIZE[0]
    return box.min.x, box.min.y, box.max.x, box.max.y
