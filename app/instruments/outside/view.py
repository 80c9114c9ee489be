"""The outside view: the scene and the camera in it, seen by a second, free camera.

It keeps its picture from frame to frame. renderer/raster/overlay.py draws.
"""

from __future__ import annotations

import math
import time
from collections.abc import Iterable, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

import moderngl
import numpy as np
from imgui_bundle import ImVec2, imgui

from lucida.app.cameras.travel import Ends
from lucida.app.images.picking import is_quick, line_meetings, nearest_hit, object_on_ray
from lucida.app.images.renderers import look_of
from lucida.app.images.request import ImageRequest
from lucida.app.images.screen import available_px
from lucida.app.instruments.outside.camera_diagram import Content
from lucida.app.instruments.outside.cloud import Cloud
from lucida.app.instruments.outside.diagram import Item
from lucida.app.instruments.outside.extensions import Extension, Extensions
from lucida.app.instruments.outside.extent import end_parameter
from lucida.app.instruments.outside.frustum import pixel_seen, plane_corners
from lucida.app.instruments.outside.gizmo import Gizmo
from lucida.app.instruments.outside.growing import grown_diagram
from lucida.app.instruments.outside.hosted import Hosted
from lucida.app.instruments.outside.looking import (
    Scopes,
    camera_along,
    camera_for_all,
    nearest,
    ray_ends,
    units_px,
    widest_px,
)
from lucida.app.instruments.outside.mouse import Mouse, Scope
from lucida.app.instruments.outside.paint import CASING, ground_of, layers
from lucida.app.instruments.outside.parts import MadePicture, Tools
from lucida.app.instruments.outside.pixel_plane import PixelPlane
from lucida.app.instruments.outside.placing import Edges, LabelPlacer
from lucida.app.instruments.outside.projected import Primitive, project
from lucida.app.instruments.outside.screen import OutsideScreen, image_plane
from lucida.app.instruments.outside.tools import draw_labels, use_tools, written
from lucida.app.state.app_state import AppState
from lucida.app.state.options.shared import Pixel
from lucida.app.ui import theme
from lucida.app.ui.areas import focused_steps, mouse_area
from lucida.app.ui.contrast import Rgb
from lucida.app.ui.host import Host
from lucida.app.ui.instrument import Instrument
from lucida.app.ui.theme import framebuffer_scale
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.camera.navigation import orbited
from lucida.renderer.images.frame import LARGEST_PIXELS, LARGEST_SIDE
from lucida.renderer.scene.model import Scene
from lucida.renderer.system.errors import LucidaError, describe
from lucida.renderer.system.memo import Memo, same

OUTSIDE = "Outside"
TURN_RAD = 0.05  # of an arrow key
SMALLEST_PX = 24  # a view that is smaller shows nothing
GRID_PX = 7.0  # the least distance of the grid's lines, in widths of a line
NUMBER_SPACE = 1.1  # the least distance of pixels' numbers, in sizes of the type


class OutsideView(Instrument):
    """The scene and the camera in it. hosted: the guest that edits objects."""

    name = OUTSIDE
    title = "Outside view"
    padding = ImVec2(1, 1)
    flags = int(
        imgui.WindowFlags_.no_scrollbar
        | imgui.WindowFlags_.no_scroll_with_mouse
        | imgui.WindowFlags_.no_background
    )

    def __init__(self, views: Sequence[Instrument] = ()) -> None:
        self._mouse, self._gizmo = Mouse(), Gizmo()
        self.tools: Tools | None = None
        self.hosted = Hosted(self.name)
        self._over = False  # whether the mouse is over the picture
        self._error = ""
        self._made: MadePicture | None = None
        self._covered: tuple[Edges, ...] | None = None  # by tools, in the last frame
        self._scopes, self._placer, self._pixels = Scopes(), LabelPlacer(), PixelPlane()
        self.extensions = Extensions()
        self.scope: Scope | None = None  # the view as it was last drawn
        self._meetings = Memo(_meetings)

    @property
    def settled(self) -> bool:
        return not self._scopes.moves and (self.tools is None or self.tools.settled)

    @property
    def primitives(self) -> Sequence[Primitive]:
        """Return the diagram as it was last drawn, in pixels of the view."""
        return self._made.primitives if self._made is not None else ()

    @property
    def cloud(self) -> Cloud | None:
        return self.extensions.cloud

    @property
    def extra(self) -> tuple[Item, ...]:
        return self.extensions.lines

    @property
    def size_px(self) -> Size | None:
        """Return the picture's size, (width, height); None while the view is hidden."""
        return self._made.texture.size if self._made is not None else None

    def show(self, source: str, items: Iterable[Item] = (), **more: Any) -> None:
        """Show what another instrument adds, until its next call. more: see Extension."""
        self.extensions.by_source[source] = Extension(tuple(items), **more)

    def begin(self, host: Host, context: moderngl.Context) -> None:
        self.tools = Tools.of(context, host.animate)

    def end(self) -> None:
        if self.tools is not None:
            self.tools.release()

    def cancel(self) -> None:
        self._mouse.cancel()
        self._gizmo.cancel()

    def begin_anew(self) -> None:
        self._scopes, self._placer = Scopes(), LabelPlacer()
        self._covered = None  # places the labels anew

    def unseen(self, host: Host) -> None:
        self._made = None
        if self.tools is not None:
            self.tools.ground.forget()

    def own_camera(self, host: Host) -> Camera | None:
        return self.scope.camera if self.scope is not None else None

    def with_own_camera(self, state: AppState, camera: Camera | None) -> AppState:
        return state.with_options(replace(state.options.outside, camera=camera))

    def ends(self, host: Host, target: AppState) -> Ends | None:
        """Return the start and the end of the outside camera's transition to a target, or None if
        more than that changes or the view is hidden.
        """
        state, scope, size = host.state, self.scope, self.size_px
        changed = state.options.outside.camera != target.options.outside.camera
        if scope is None or size is None or not changed or state.view != target.view:
            return None
        options = target.options.outside
        end = options.camera or camera_for_all(host, size, scope.extent, self.extensions.points)
        return Ends(
            scope.camera, end, size, lambda s: s.options.outside.camera, self.with_own_camera
        )

    def look(self, host: Host, camera: Camera | None) -> None:
        """Look through a camera; None: through one that sees everything."""
        host.travel(self.with_own_camera(host.state, camera))

    def look_along(self, host: Host, axis: str) -> None:
        """Look along an axis of the world, "x", "-x", ... "-z", at everything."""
        assert self.scope is not None
        self.look(host, camera_along(host, self.scope, axis, self.extensions.points))

    def object_under(self, host: Host) -> int | None:
        if self.scope is None:
            return None
        return object_on_ray(host.state.scene, *self.scope.ray(imgui.get_mouse_pos()))

    def draw(self, host: Host) -> None:
        size = available_px()
        if min(size) < SMALLEST_PX:
            self.unseen(host)  # nobody waits for what is not drawn
            return
        size = min(size[0], LARGEST_SIDE), min(size[1], LARGEST_SIDE, LARGEST_PIXELS // size[0])
        host.renderers.need_size(host.state.images)
        scale = framebuffer_scale()
        origin = imgui.get_cursor_screen_pos()
        extent = ImVec2(size[0] / scale, size[1] / scale)
        pixels = self._pixels.shown(host)
        self.show("pixels", pixels)
        scope = self._follow_mouse(host, size, origin, extent)
        texture = self._texture(host, scope.shown, size, scope)
        draw = imgui.get_window_draw_list()
        far = ImVec2(origin.x + extent.x, origin.y + extent.y)
        if texture is None:
            draw.add_rect_filled(origin, far, theme.u32(theme.BACKGROUND))
            imgui.set_cursor_screen_pos(ImVec2(origin.x + theme.px(8), origin.y + theme.px(8)))
            imgui.text_wrapped(self._error)
            return
        assert self.tools is not None
        assert self._made is not None
        draw.add_image(imgui.ImTextureRef(texture.glo), origin, far)
        draw.push_clip_rect(origin, far, True)
        ground = _ground(host.state)
        self._gizmo.follow(host, scope, ground)
        tools: tuple[Edges, ...] = ()
        if host.has_tools:
            axis, tools = use_tools(host, scope, self.actions)
            if axis is not None:
                self.look_along(host, axis)
        if tools != self._covered:
            labels = written(self._made.primitives, self._placer, extent, host.fonts, tools)
            self._made, self._covered = replace(self._made, labels=labels), tools
        draw_labels(self._made.labels, origin, ground)
        taken = [guest(host, scope, self._over) for guest in self.extensions.guests]
        if self._over:  # not between the two clicks, when the button is held
            self.hosted.double_is_taken = any(taken)
        self.hosted.draw(host, scope, self._over)
        draw.pop_clip_rect()

    # What the mouse does.

    def _follow_mouse(self, host: Host, size: Size, origin: ImVec2, extent: ImVec2) -> Scope:
        scope, begun = self._scope(host, size, origin, extent), host.state
        imgui.set_cursor_screen_pos(origin)
        self._over = False
        if self.hosted.holds or (self._gizmo.over and host.state.options.outside.gizmo != "none"):
            imgui.dummy(extent)  # ImGuizmo takes no click where an item is under the mouse
            return scope
        buttons = imgui.ButtonFlags_
        imgui.set_next_item_allow_overlap()
        mouse_area(
            f"image##{self.name}",
            extent,
            buttons.mouse_button_left | buttons.mouse_button_right | buttons.mouse_button_middle,
        )
        self._over = imgui.is_item_hovered() and not self._mouse.dragging
        right, down = (0, 0) if self.extensions.guests else focused_steps()
        if right or down:
            angles = right * TURN_RAD, -down * TURN_RAD
            camera = orbited(scope.camera, scope.center, *angles)
            host.apply(
                host.state.with_options(replace(host.state.options.outside, camera=camera)),
                (self.name, "turned"),
            )
            return self._scope(host, size, origin, extent)
        if self._pixels.follow(host, scope):
            self._mouse.cancel()
            return self._scope(host, size, origin, extent)
        was_dragging = self._mouse.dragging
        camera, gesture = self._mouse.follow(scope)
        state = host.state
        if camera != scope.camera:
            state = state.with_options(replace(state.options.outside, camera=camera))
            host.apply(state, gesture)
        number = partial(self.object_under, host)
        if self.hosted.take_click(host, scope, self._mouse.clicked(), number):
            return self._scope(host, size, origin, extent)
        pixel = None
        if imgui.is_item_hovered() or self._mouse.clicked():
            pixel = self._pixel_under(host, scope)
        if pixel is not None:
            if self._mouse.clicked():
                marked = None if host.state.marked == pixel else pixel
                host.edit(replace(host.options, marked=marked))
            elif not was_dragging:
                host.hover(self.name, pixel)
        return scope if host.state is begun else self._scope(host, size, origin, extent)

    def _scope(self, host: Host, size: Size, origin: ImVec2, extent: ImVec2) -> Scope:
        now_s, held = time.monotonic(), imgui.is_any_mouse_down()
        points = self.extensions.points
        self.scope = self._scopes.of(host, size, origin, extent, points, now_s, held)
        return self.scope

    def _pixel_under(self, host: Host, scope: Scope) -> Pixel | None:
        """Return the pixel of the image plane that is visible under the mouse."""
        outside = host.state.options.outside
        if not (outside.image or outside.grid):
            return None
        camera, ray = host.renderers.camera(host.state), scope.ray(imgui.get_mouse_pos())
        found = pixel_seen(camera, host.renderers.size, *ray)
        if found is None or (
            is_quick(host.state.scene) and nearest_hit(host.state.scene, *ray)[0] <= found[1]
        ):
            return None
        return found[0]

    # The picture.

    def _texture(
        self, host: Host, camera: Camera, size: Size, scope: Scope
    ) -> moderngl.Texture | None:
        """Return the view's picture, drawn again if anything has changed; None if that failed."""
        try:
            self._made = self._drawn(host, camera, size, scope)
        except (LucidaError, moderngl.Error) as error:
            self.unseen(host)
            self._error = describe(error)
            return None
        assert self.tools is not None
        if self._scopes.waits or self._scopes.moves or not self.tools.ground.settled:
            host.animate()
        return self._made.texture

    def _drawn(self, host: Host, camera: Camera, size: Size, scope: Scope) -> MadePicture:
        """Return the present picture; the last one if nothing has changed."""
        both, state = host.renderers, host.state
        assert self.tools is not None
        assert both.textures is not None
        inner, options, extensions = both.camera(state), state.options.outside, self.extensions
        overlay, exposure_ev = self.tools.overlay, state.images.exposure_ev
        request, live = both.request(state), None
        assert request is not None
        if options.image:
            both.textures.raster.follow(request)
            live = both.textures.raster.image
        ground = self.tools.ground.picture(
            ImageRequest(state.scene, camera, size), both.textures.rasterizer, overlay,
            refines=not self._scopes.moves,
        )  # fmt: skip
        screen = OutsideScreen(camera, size, nearest(camera, scope), *units_px(scope.extent))
        content = self.content(host, screen)
        if options.half_line and self._over:
            content = replace(content, pointed=_pointed(content, scope))
        moves = self._scopes.moves or ground.factor > 1 or both.unfinished(state)
        key = (
            content, ground, screen.near, units_px(scope.extent),
            live and live.number, state.images, theme.used(), extensions.items,
            extensions.cloud, extensions.picture, moves,
        )  # fmt: skip
        if self._made is not None and same(self._made.key, key):
            return self._made
        primitives = project([*grown_diagram(content), *extensions.items], screen)
        labels = written(primitives, self._placer, scope.extent, host.fonts, self._covered or ())
        picture = extensions.picture
        plane = image_plane(inner, camera, size)
        if not options.image:
            picture = None
        elif picture is None:
            picture = both.textures.whole_raster(request, look_of(state.images))
        texture = overlay.draw(
            ground.textures, camera, size, layers(primitives, _ground(state)), plane, picture,
            exposure_ev, options.image_opacity, screen.unit_px, ground.mean, CASING, ground,
            self.tools.layer.picture(extensions.cloud, screen, _ground(state)), moves=moves,
        )  # fmt: skip
        return MadePicture(key, texture, primitives, labels)

    def content(self, host: Host, screen: OutsideScreen) -> Content:
        """Return the content of a screen, with rays' ends as far as they are known."""
        assert self.tools is not None
        both, state = host.renderers, host.state
        camera, size, options = both.camera(state), both.size, state.options.outside
        marked, hits = ray_ends(self.tools.hits, host, camera, size, self.extensions.by_source)
        side_px = widest_px(screen, plane_corners(camera))
        found: tuple[float, ...] = ()
        if options.meetings and marked is not None:
            ray = camera.ray(*marked.pixel, size)
            found = self._meetings(state.scene, *ray.origin.tolist(), *ray.direction.tolist())
        return Content(
            camera, size, replace(options, camera=None),
            end_parameter(camera, host.focus.framed), tuple(hits), marked,
            int(side_px / (GRID_PX * screen.unit_px)), state.options.notation,
            state.options.indexing.value,
            None if host.has_tools or not options.grid else _number_step(size, side_px), found,
            names_t=host.has_tools,
        )  # fmt: skip


def _meetings(scene: Scene, *ray: float) -> tuple[float, ...]:
    return line_meetings(scene, np.array(ray[:3]), np.array(ray[3:]))


def _number_step(size: Size, side_px: float) -> int:
    """Return the least step from one number of a row, or of a column, to the next.

    side_px: of the image plane's longer side.
    """
    text_px = NUMBER_SPACE * theme.type_px() * framebuffer_scale()
    return math.ceil(max(size) * text_px / max(side_px, 1.0))


def _pointed(content: Content, scope: Scope) -> float | None:
    """Return the t of the marked pixel's line that is nearest to the mouse."""
    if content.marked is None:
        return None
    ray = content.camera.ray(*content.marked.pixel, content.size)
    origin, way = scope.ray(imgui.get_mouse_pos())
    start, along = np.asarray(ray.origin), np.asarray(ray.direction)
    sides = np.column_stack([along, -np.asarray(way)])
    found, *_ = np.linalg.lstsq(sides, np.asarray(origin) - start, rcond=None)
    return float(found[0])


def _ground(state: AppState) -> Rgb:
    """Return the colour that most of the drawing is on."""
    return ground_of(state.scene.background, state.images.exposure_ev)
