"""The selection in the 3D views: outlines, handles, and the effect of a click.

One guest serves the two images, the comparison and the outside view (app/ui/guest.py).
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from imgui_bundle import ImVec2, imgui

from lucida.app.instruments.outside.screen import OutsideScreen
from lucida.app.ui import theme
from lucida.app.ui.guest import Click, ShownIn
from lucida.app.ui.host import Host
from lucida.renderer.camera.camera import Camera
from lucida.renderer.editing.changing import Item, ids_of
from lucida.renderer.scene.model import Scene
from lucida.renderer.system.memo import Memo

from .choosing import chosen, picked, unlocked
from .handles import Handles
from .silhouette import Outline, outer, outlines_of

CHOSEN = theme.rgb("#ffa23a")
CASING = theme.rgb("#0c0d0f", 0.7)
WIDTH, RIM = 1.6, 1.0  # of an outline, and of its casing on each side, at 100 %
MOST_VIEWS = 4  # whose outlines are kept


class InViews:
    """The selection in all views. handles: of all views."""

    def __init__(self) -> None:
        self.handles = Handles()
        self._outlines = Memo(_outlines, MOST_VIEWS)
        self._segments = Memo(_segments, MOST_VIEWS)

    # The guest's interface, see app/ui/guest.py.

    def holds(self, view: str) -> bool:
        return self.handles.holds(view)

    def wants(self, host: Host, double: bool) -> bool:
        return double or host.state.options.objects.selects

    def click(self, host: Host, shown: ShownIn, click: Click) -> None:
        host.amend(picked(host.state, click.number, click.more))

    def draw(self, host: Host, shown: ShownIn, over: bool) -> None:
        state = host.state
        items = chosen(state)
        if not items:
            self.handles.forget(shown.name)
            self._outlines.forget()
            self._segments.forget()
            return
        draw = imgui.get_window_draw_list()
        low, extent = shown.origin, shown.extent
        draw.push_clip_rect(low, ImVec2(low.x + extent.x, low.y + extent.y), True)
        self._draw_outlines(host, shown)  # clipped to the image
        draw.pop_clip_rect()
        items = unlocked(state) if state.options.objects.handle == "move" else ()
        scene = self.handles.draw(shown, state.scene, items, host.focus.reach)
        if scene is not state.scene:
            host.apply(replace(host.state, scene=scene), self.handles.gesture)
        if self.handles.dragging:
            host.animate()

    # Drawing.

    def _draw_outlines(self, host: Host, shown: ShownIn) -> None:
        scene, items = host.state.scene, chosen(host.state)
        outline = self._outlines(scene, items, shown.camera)
        segments = self._segments(outline, shown.camera, tuple(shown.origin), tuple(shown.extent))
        draw, width = imgui.get_window_draw_list(), theme.line_px(WIDTH)
        for color, wide in ((CASING, width + 2 * theme.px(RIM)), (CHOSEN, width)):
            ink = theme.u32(color)
            for start, end in segments:
                draw.add_line(start, end, ink, wide)


def _outlines(scene: Scene, items: tuple[Item, ...], camera: Camera) -> tuple[Outline, ...]:
    """Return the outlines of the items' objects that are not hidden."""
    entries = [scene.objects[number] for item in items for number in ids_of(scene, item)]
    return tuple(outlines_of([entry for entry in entries if not entry.hidden], camera))


def _segments(
    outlines: tuple[Outline, ...],
    camera: Camera,
    origin: tuple[float, ...],
    extent: tuple[float, ...],
) -> list[tuple[ImVec2, ImVec2]]:
    """Return the lines of outlines on the screen.

    origin, extent: of the image, in ImGui's units.
    """
    size = max(round(extent[0]), 1), max(round(extent[1]), 1)
    screen, found = OutsideScreen(camera, size), []
    for outline in outlines:
        points, _, numbers = screen.segments(outline.segments)
        there = outer(points, outline.layers[numbers], size) * (np.array(extent) / size) + origin
        found += [(ImVec2(*start), ImVec2(*end)) for start, end in there.tolist()]
    return found
