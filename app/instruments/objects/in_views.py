"""The selection in the 3D views: outlines, handles, lights to click on, and the effect of a click.

One guest for the two images, the comparison and the outside view (app/ui/guest.py).
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from imgui_bundle import ImVec2, imgui

from lucida.app.instruments.objects.choosing import (
    choose,
    choose_also,
    chosen,
    picked,
    rows_of,
    unlocked,
)
from lucida.app.instruments.objects.handles import Handles
from lucida.app.instruments.objects.remedies import remedied, scene_remedy
from lucida.app.instruments.objects.silhouette import Outline, outer, outlines_of
from lucida.app.instruments.outside.screen import OutsideScreen
from lucida.app.instruments.outside.view import OUTSIDE
from lucida.app.state.app_state import AppState
from lucida.app.ui import theme
from lucida.app.ui.guest import Click, ShownIn
from lucida.app.ui.host import Host
from lucida.renderer.camera.camera import Camera
from lucida.renderer.editing.changing import Item, ids_of
from lucida.renderer.editing.moving import bounds_of
from lucida.renderer.scene.model import Scene
from lucida.renderer.system.memo import Memo

CHOSEN = theme.rgb("#ffa23a")
CASING = theme.rgb("#0c0d0f", 0.7)
WIDTH, RIM = 1.6, 1.0  # of an outline and of its casing to both sides, at 100 %
MOST_VIEWS = 4  # whose outlines are kept
LIGHT_PX, NEAR_PX = 7.0, 14.0  # at 100 %: a light's disc, and from where a click is on it


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
        light = self._light_under(host, shown)
        if light is None:
            host.amend(picked(host.state, click.number, click.more))
        elif click.more:
            host.amend(choose_also(host.state, light))
        else:
            host.amend(choose(host.state, (light,)))

    def remedy(self, state: AppState, cause: str) -> str:
        return scene_remedy(state, cause)

    def remedied(self, state: AppState, remedy: str) -> AppState:
        return remedied(state, remedy)

    def draw(self, host: Host, shown: ShownIn, over: bool) -> None:
        state = host.state
        items = chosen(state)
        if not items and not state.options.objects.selects:
            self.handles.forget(shown.name)
            self._outlines.forget()
            self._segments.forget()
            return
        draw = imgui.get_window_draw_list()
        low, extent = shown.origin, shown.extent
        draw.push_clip_rect(low, ImVec2(low.x + extent.x, low.y + extent.y), True)
        self._draw_outlines(host, shown)  # no further than what the image shows
        draw.pop_clip_rect()
        if shown.name == OUTSIDE:
            self._draw_lights(host, shown)
        items = unlocked(state) if state.options.objects.handle == "move" else ()
        scene = self.handles.draw(shown, state.scene, items, host.focus.reach, host.fonts)
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

    def _draw_lights(self, host: Host, shown: ShownIn) -> None:
        draw, items = imgui.get_window_draw_list(), chosen(host.state)
        for item, at in lights_in(host.state, shown).items():
            color = CHOSEN if item in items else theme.rgb("#ffe9a8")
            radius = theme.px(LIGHT_PX)
            draw.add_circle_filled(at, radius, theme.u32(CASING))
            draw.add_circle_filled(at, 0.62 * radius, theme.u32(color))

    def _light_under(self, host: Host, shown: ShownIn) -> Item | None:
        if shown.name != OUTSIDE:
            return None
        mouse = imgui.get_io().mouse_pos
        near = {
            item: np.hypot(at.x - mouse.x, at.y - mouse.y)
            for item, at in lights_in(host.state, shown).items()
        }
        item = min(near, key=near.__getitem__, default=None)
        return item if item is not None and near[item] < theme.px(NEAR_PX) else None


def lights_in(state: AppState, shown: ShownIn) -> dict[Item, ImVec2]:
    """Return the places of the scene's visible point lights on the screen."""
    found: dict[Item, ImVec2] = {}
    for row in rows_of(state.scene):
        if not row.is_light or row.item is None or row.hidden or row.kind != "point":
            continue
        bounds = bounds_of(state.scene, [row.item])
        if bounds is None:
            continue
        seen = shown.camera.project(bounds[0], (1, 1))
        if seen.parameter > 0:
            x, y = float(seen.column) + 0.5, float(seen.row) + 0.5
            at = ImVec2(shown.origin.x + x * shown.extent.x, shown.origin.y + y * shown.extent.y)
            found[row.item] = at
    return found


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
