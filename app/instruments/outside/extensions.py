"""Extensions of the outside view by other instruments: lines, labels, points, a picture."""

from __future__ import annotations

from typing import NamedTuple

import moderngl

from lucida.renderer.camera.checks import Floats

from .cloud import Cloud
from .diagram import Item
from .looking import NOTHING


class Extension(NamedTuple):
    """Content that another instrument adds to the view.

    items: lines and labels. cloud: points and lines by the thousand. picture: the picture on the
    image plane, instead of the live image; a new texture whenever it changes.
    """

    items: tuple[Item, ...] = ()
    cloud: Cloud | None = None
    picture: moderngl.Texture | None = None


class Extensions:
    """The extensions of one view, by the instrument that adds them."""

    def __init__(self) -> None:
        self.by_source: dict[str, Extension] = {}

    @property
    def cloud(self) -> Cloud | None:
        found = (one.cloud for one in self.by_source.values() if one.cloud is not None)
        return next(found, None)

    @property
    def picture(self) -> moderngl.Texture | None:
        found = (one.picture for one in self.by_source.values() if one.picture is not None)
        return next(found, None)

    @property
    def items(self) -> tuple[Item, ...]:
        return tuple(item for one in self.by_source.values() for item in one.items)

    @property
    def lines(self) -> tuple[Item, ...]:
        """Return the lines and labels, with those of the cloud, without points."""
        return self.items if self.cloud is None else (self.cloud.lines, *self.items)

    @property
    def points(self) -> Floats:
        """Return points (n, 3) that must be visible together with the scene."""
        return NOTHING if self.cloud is None else self.cloud.around
