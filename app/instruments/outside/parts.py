"""The parts of the outside view that need a context, and the picture that they have made."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import moderngl

from lucida.app.images.ray_pictures import RayPictures
from lucida.app.instruments.outside.cloud_layer import CloudLayer
from lucida.app.instruments.outside.ground import Ground
from lucida.app.instruments.outside.projected import Primitive
from lucida.app.instruments.outside.tools import Written
from lucida.app.state.options.shared import Pixel
from lucida.renderer.raster.overlay import Overlay


@dataclass(frozen=True, eq=False)
class MadePicture:
    """The last picture, what it was made from, and its labels, which are drawn over it."""

    key: tuple[Any, ...]
    texture: moderngl.Texture
    primitives: list[Primitive]
    labels: list[Written]


class Tools(NamedTuple):
    """Hold the parts of the view that need a context. layer: the cloud's picture."""

    overlay: Overlay
    ground: Ground
    layer: CloudLayer
    hits: RayPictures[dict[Pixel, float]]

    @classmethod
    def of(cls, context: moderngl.Context, animate: Callable[[], None]) -> Tools:
        """Return new ones. animate: called when rays were traced."""
        hits: RayPictures[dict[Pixel, float]] = RayPictures("lucida-outside-rays", animate)
        return cls(Overlay(context), Ground(), CloudLayer(context), hits)

    def release(self) -> None:
        """Release all of them, while the context is current."""
        self.hits.close()
        self.overlay.release()
        self.layer.release()

    @property
    def settled(self) -> bool:
        return self.ground.settled and not self.hits.busy
