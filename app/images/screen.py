"""Conversion between the pixels of an image and places on the screen, in ImGui's units."""

from __future__ import annotations

import math
from dataclasses import dataclass

from imgui_bundle import ImVec2, imgui

from lucida.app.state.options.shared import Pixel
from lucida.app.ui.theme import framebuffer_scale

from .placement import Placement

Box = tuple[ImVec2, ImVec2]  # upper left and lower right corner


def available_px() -> tuple[int, int]:
    """Return the rest of the current window's content, (width, height) in framebuffer pixels."""
    avail, scale = imgui.get_content_region_avail(), framebuffer_scale()
    return max(1, math.floor(avail.x * scale)), max(1, math.floor(avail.y * scale))


@dataclass(frozen=True)
class Screen:
    """An image's place on the screen.

    corner: the upper left of its window's content, on a whole pixel. scale: framebuffer pixels per
    unit.
    """

    placement: Placement
    corner: ImVec2
    scale: float

    @classmethod
    def here(cls, placement: Placement) -> Screen:
        """Return the image's place at the current window's cursor."""
        scale, at = framebuffer_scale(), imgui.get_cursor_screen_pos()
        corner = ImVec2(math.floor(at.x * scale) / scale, math.floor(at.y * scale) / scale)
        return cls(placement, corner, scale)

    @property
    def pane(self) -> Box:
        """All of the window's content except the rulers."""
        near, far = self.placement.margin, self.placement.pane
        return self._point(*map(float, near)), self._point(*map(float, far))

    @property
    def visible(self) -> Box:
        """The visible part of the image."""
        left, top, right, bottom = map(float, self.placement.visible)
        return self._point(left, top), self._point(right, bottom)

    @property
    def cell(self) -> tuple[float, float]:
        """Width and height of an image's pixel, in units."""
        width, height = self.placement.unit
        return width / self.scale, height / self.scale

    def pane_px(self, mouse: ImVec2) -> tuple[float, float]:
        """Return a place of the screen in framebuffer pixels from the window's corner."""
        return (mouse.x - self.corner.x) * self.scale, (mouse.y - self.corner.y) * self.scale

    def pixel(self, mouse: ImVec2) -> Pixel:
        """Return the pixel under the mouse; the nearest one if the mouse is outside the image."""
        return self.placement.pixel_at(*self.pane_px(mouse))

    def position(self, mouse: ImVec2) -> tuple[float, float]:
        """Return row and column of the mouse, with integers at the pixels' centres."""
        return self.placement.image_position(*self.pane_px(mouse))

    def point(self, row: float, column: float) -> ImVec2:
        """Return the position of a pixel's upper left corner."""
        return self._point(*self.placement.corner_of(row, column))

    def _point(self, x: float, y: float) -> ImVec2:
        return ImVec2(self.corner.x + x / self.scale, self.corner.y + y / self.scale)
