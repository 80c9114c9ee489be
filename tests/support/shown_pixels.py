"""The pixels that the image windows show, and their menu: for several topics of drives."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from window_driver import Driver, Key

from lucida.app.images.pair.view import RASTER
from lucida.app.images.placement import Placement
from lucida.renderer.images.display import picture
from lucida.renderer.images.frame import Frame

ALT, CTRL, SHIFT = Key.mod_alt, Key.mod_ctrl, Key.mod_shift
MENU = "//##MainMenuBar/Image"


def choose(d: Driver, path: str) -> None:
    d.ctx.menu_click(f"{MENU}/{path}")
    d.settle()


def placement(d: Driver, name: str = RASTER) -> Placement:
    both = d.renderers
    return both.placed(d.state.images, both.common_room(both.panes_px[name]))


def without_overlays(image: np.ndarray) -> np.ndarray:
    """The middle of an image, where no legend, badge or ruler is."""
    height, width = image.shape[:2]
    return image[height // 4 : -height // 3, width // 4 : -width // 4]


def _frame(d: Driver, name: str) -> Frame:
    comparison = d.renderers.agreement.verdict.comparison
    return comparison.raster if name == RASTER else comparison.ray


def pixels(d: Driver, name: str, channel: str) -> np.ndarray:
    """Return what the middle of a fitted image must show: its own channel, as saved pictures have
    it.
    """
    return without_overlays(picture(_frame(d, name), channel).astype(np.int16))


def magnified(d: Driver, name: str, channel: str) -> np.ndarray:
    """Return an image whose pixels are magnified by a whole number."""
    at = placement(d, name)
    factor = round(at.magnification)
    large = picture(_frame(d, name), channel).repeat(factor, axis=0).repeat(factor, axis=1)
    (left, top, right, bottom), (x, y) = at.visible, at.origin
    return large[top - y : bottom - y, left - x : right - x].astype(np.int16)


def counting(owner: object, name: str) -> Callable[[], int]:
    """Counts the calls of a method from now on."""
    method, calls = getattr(owner, name), []

    def counted(*arguments, **named):
        calls.append(arguments)
        return method(*arguments, **named)

    setattr(owner, name, counted)
    return lambda: len(calls)
