"""A page of the laboratory as the thread makes it, and the image that it is made of."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.host.view import Host
from app.images.request import ImageRequest
from app.laboratory.options import LaboratoryOptions
from app.laboratory.pages import Image, PagePlan, Panel, panels
from app.state.options import Pixel
from renderer.scene.model import Scene
from renderer.scene_editing.documents import are_versions

PLACE = "Laboratory"  # for the rasterizer's textures


@dataclass(frozen=True, eq=False)
class Source:
    """The linear image that the pages are made of, and what it was drawn from."""

    request: ImageRequest
    color: Image


PageKey = tuple[Source, PagePlan, LaboratoryOptions, float, Pixel]


@dataclass(frozen=True, eq=False)
class MadePage:
    """A page that the thread has made, and its key."""

    key: PageKey
    plan: PagePlan
    panels: tuple[Panel, ...]

    def is_stale(self, scene: Scene, options: LaboratoryOptions, divided: PagePlan) -> bool:
        """Return True if it shows another scene, another page, or an image of another fixed
        size.
        """
        source, _, made_with, *_ = self.key
        if made_with.page != options.page or not are_versions(source.request.scene, scene):
            return True
        is_fixed = divided.is_fixed or self.plan.is_fixed
        return is_fixed and self.plan.image != divided.image


def made_page(
    source: Source, divided: PagePlan, options: LaboratoryOptions, taken_ev: float, pixel: Pixel
) -> MadePage:
    made = panels(options.page, source.color, divided, options, taken_ev, pixel)
    return MadePage((source, divided, options, taken_ev, pixel), divided, made)


def drawn_image(host: Host, request: ImageRequest) -> Image:
    """The rasterizer's image in linear light: float32 (H, W, 3)."""
    textures = host.renderers.textures
    assert textures is not None
    texture = textures.rasterizer.draw(request, PLACE).color
    width, height = request.size
    values = np.frombuffer(texture.read(), np.float32).reshape(height, width, 4)
    return np.ascontiguousarray(values[..., :3])
