"""The outside view: the scene and the camera in it, seen by a second, free camera.

It keeps its picture from frame to frame. renderer/raster/overlay.py draws the picture.
"""

from __future__ import annotations

import math
import time
from collections.abc import Hashable, Iterable, Sequence
from dataclasses import replace
from functools import partial
from typing import Any, NamedTuple

import moderngl
import numpy as np
from imgui_bundle import ImVec2, imgui

from lucida.app.cameras.travel import Ends
from lucida.app.images.picking import line_meetings, object_on_ray
from lucida.app.images.ray_pictures import RayPictures
from lucida.app.images.renderers import look_of
from lucida.app.images.request import ImageRequest
from lucida.app.images.screen import available_px
from lucida.app.state.app_state import AppState
from lucida.app.state.options.shared import ImageOptions, Pixel
from lucida.app.ui import theme
from lucida.app.ui.areas import focused_steps, mouse_area
from lucida.app.ui.host import Host
from lucida.app.ui.instrument import Instrument
from lucida.app.ui.theme import framebuffer_scale
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.camera.navigation import orbited
from lucida.renderer.raster.overlay import Overlay, PlacedPicture, ShownScene
from lucida.renderer.scene.model import Scene
from lucida.renderer.system.errors import LucidaError, describe
from lucida.renderer.system.memo import Memo

from .camera_diagram import Content
from .cloud_layer import CloudLayer
from .diagram import Item
from .extensions import Extension, Extensions
from .extent import arrow_length, end_parameter
from .frustum import pixel_seen, plane_corners
from .gizmo import Gizmo
from .ground import Ground, GroundPicture
from .growing import grown_diagram
from .hosted import Hosted
from .looking import Scopes, camera_for_all, nearest, ray_ends, units_px, widest_px
from .mouse import Area, Mouse, Scope
from .paint import ground_of, layers
from .placing import LabelPlacer
from .projected import Primitive, project
from .screen import OutsideScreen, image_plane
from .tools import draw_labels, use_tools, written

OUTSIDE = "Outside"
TURN_RAD = 0.05  # per arrow key
SMALLEST_PX = 24  # a smaller view shows nothing
GRID_PX = 7.0  # the least distance between grid lines, in widths of a line
NUMBER_SPACE = 1.1  # the least distance between pixels' numbers, in sizes of the type


class Tools(NamedTuple):
    """The parts of the view that need an OpenGL context. layer: the cloud's renderer."""

    overlay: Overlay
    ground: Ground
    layer: CloudLayer
    hits: RayPictures[dict[Pixel, float]]


class Shown(NamedTuple):
    """The images' display: the live image on the plane, the display's options, and the theme."""

    live: Hashable
    images: ImageOptions
    theme: Hashable


class Drawing(NamedTuple):
    """The view's picture, and the diagram in it."""

    texture: moderngl.Texture
    primitives: tuple[Primitive, ...]


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
        self._over = False  # True if the mouse is over the picture
        self._made: Drawing | None = None
        self._scopes, self._placer = Scopes(), LabelPlacer()
        self.extensions = Extensions()
        self.scope: Scope | None = None  # the view as it was last drawn
        self._meetings, self._drawn, self._written = Memo(_meetings), Memo(_drawn), Memo(written)

    @property
    def settled(self) -> bool:
        tools = self.tools
        return not self._scopes.moves and (
            tools is None or (tools.ground.settled and not tools.hits.busy)
        )

    @property
    def primitives(self) -> Sequence[Primitive]:
        """Return the diagram as it was last drawn, in pixels of the view."""
        return self._made.primitives if self._made is not None else ()

    @property
    def size_px(self) -> Size | None:
        """Return the picture's size, (width, height); None while the view is hidden."""
        return self._made.texture.size if self._made is not None else None

    def show(self, source: str, items: Iterable[Item] = (), **more: Any) -> None:
        """Show what another instrument adds, until its next call. more: see Extension."""
        self.extensions.by_source[source] = Extension(tuple(items), **more)

    def begin(self, host: Host, context: moderngl.Context) -> None:
        hits: RayPictures[dict[Pixel, float]] = RayPictures("lucida-outside-rays", host.animate)
        self.tools = Tools(Overlay(context), Ground(), CloudLayer(context), hits)

    def end(self) -> None:
        if self.tools is not None:
            self.tools.hits.close()
            self.tools.overlay.release()
            self.tools.layer.release()

    def cancel(self) -> None:
        self._mouse.cancel()
        self._gizmo.cancel()

    def begin_anew(self) -> None:
        self._scopes, self._placer = Scopes(), LabelPlacer()

    def unseen(self, host: Host) -> None:
        self._made = None
        self._drawn.forget()
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
        end = target.options.outside.camera
        is_changed = state.options.outside.camera != end
        if scope is None or size is None or not is_changed or state.view != target.view:
            return None
        end = end or camera_for_all(host, scope.area, self.extensions.points)
        return Ends(
            scope.camera, end, size, lambda s: s.options.outside.camera, self.with_own_camera
        )

    def look(self, host: Host, camera: Camera | None) -> None:
        """Look through a camera, or through one that sees everything if it is None."""
        host.travel(self.with_own_camera(host.state, camera))

    def object_under(self, host: Host) -> int | None:
        if self.scope is None:
            return None
        return object_on_ray(host.state.scene, *self.scope.ray(imgui.get_mouse_pos()))

    def draw(self, host: Host) -> None:
        size = available_px()
        if min(size) < SMALLEST_PX:
            self.unseen(host)  # a hidden picture must not be waited for
            return
        host.renderers.need_size(host.state.images)
        area = Area.of(size, imgui.get_cursor_screen_pos())
        self._follow_mouse(host, self._scope(host, area))
        scope, draw = self._scope(host, area), imgui.get_window_draw_list()
        try:
            self._made = self._picture(host, scope)
        except (LucidaError, moderngl.Error) as error:
            self.unseen(host)
            draw.add_rect_filled(area.origin, area.far, theme.u32(theme.BACKGROUND))
            imgui.set_cursor_screen_pos(area.origin + ImVec2(theme.px(8), theme.px(8)))
            imgui.text_wrapped(describe(error))
            return
        draw.add_image(imgui.ImTextureRef(self._made.texture.glo), area.origin, area.far)
        draw.push_clip_rect(area.origin, area.far, True)
        ground = ground_of(host.state.scene.background, host.state.images.exposure_ev)
        self._gizmo.follow(host, scope, ground)
        labels = self._written(self._made.primitives, self._placer, size, host.fonts)
        draw_labels(labels, area.origin)
        if host.has_tools:
            use_tools(host, scope, self.actions)
        self.hosted.draw(host, scope, self._over)
        draw.pop_clip_rect()

    def _scope(self, host: Host, area: Area) -> Scope:
        now_s, held = time.monotonic(), imgui.is_any_mouse_down()
        self.scope = self._scopes.of(host, area, self.extensions.points, now_s, held)
        return self.scope

    def _follow_mouse(self, host: Host, scope: Scope) -> None:
        imgui.set_cursor_screen_pos(scope.origin)
        self._over = False
        if self.hosted.holds or (self._gizmo.over and host.state.options.outside.gizmo != "none"):
            imgui.dummy(scope.extent)  # ImGuizmo ignores clicks over an item
            return
        buttons = imgui.ButtonFlags_
        imgui.set_next_item_allow_overlap()
        mouse_area(
            f"image##{self.name}",
            scope.extent,
            buttons.mouse_button_left | buttons.mouse_button_right | buttons.mouse_button_middle,
        )
        self._over = imgui.is_item_hovered() and not self._mouse.dragging
        right, down = focused_steps()
        if right or down:
            camera = orbited(scope.camera, scope.center, right * TURN_RAD, -down * TURN_RAD)
            host.apply(self.with_own_camera(host.state, camera))
            return
        was_dragging = self._mouse.dragging
        camera = self._mouse.follow(scope)
        if camera != scope.camera:
            host.apply(self.with_own_camera(host.state, camera))
        clicked = self._mouse.clicked()
        if self.hosted.take_click(host, scope, clicked, partial(self.object_under, host)):
            return
        pixel = self._pixel_under(host, scope) if imgui.is_item_hovered() or clicked else None
        if pixel is not None and clicked:
            marked = None if host.state.marked == pixel else pixel
            host.edit(replace(host.options, marked=marked))
        elif pixel is not None and not was_dragging:
            host.hover(self.name, pixel)

    def _pixel_under(self, host: Host, scope: Scope) -> Pixel | None:
        """Return the pixel of the image plane under the mouse."""
        both, state = host.renderers, host.state
        if not (state.options.outside.image or state.options.outside.grid):
            return None
        ray = scope.ray(imgui.get_mouse_pos())
        return pixel_seen(both.camera(state), both.size, *ray)

    def _picture(self, host: Host, scope: Scope) -> Drawing:
        """Return the current picture, which is the last one if nothing has changed."""
        both, state, tools, extensions = host.renderers, host.state, self.tools, self.extensions
        assert tools is not None
        assert both.textures is not None
        request, picture, live = both.request(state), extensions.picture, None
        assert request is not None
        if not state.options.outside.image:
            picture = None
        elif picture is None:
            picture = both.textures.whole_raster(request, look_of(state.images))
            live = both.textures.raster.image
        camera, size, moves = scope.shown, scope.area.size, self._scopes.moves
        ground = tools.ground.picture(
            ImageRequest(state.scene, camera, size), both.textures.rasterizer, tools.overlay,
            refines=not moves,
        )  # fmt: skip
        coarse = moves or ground.factor > 1 or both.unfinished(state)
        if coarse or not tools.ground.settled:
            host.animate()
        near, units = nearest(camera, scope), units_px(scope.extent)
        content = self.content(host, OutsideScreen(camera, size, near, *units))
        return self._drawn(
            tools, ground, content, (near, *units),
            Extension(extensions.items, extensions.cloud, picture),
            Shown(live, state.images, theme.used()),
            coarse,
        )  # fmt: skip

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
        text_px = NUMBER_SPACE * theme.type_px() * framebuffer_scale()
        step = math.ceil(max(size) * text_px / max(side_px, 1.0))
        return Content(
            camera,
            size,
            replace(options, camera=None),
            end_parameter(camera, host.focus.framed),
            tuple(hits),
            marked,
            grid_parts=int(side_px / (GRID_PX * screen.unit_px)),
            base=state.options.indexing.value,
            origin=state.options.pixel_origin,
            number_step=None if host.has_tools or not options.grid else step,
            meetings=found,
            names_t=host.has_tools,
            arrow=arrow_length(host.focus.reach),
        )


def _drawn(
    tools: Tools,
    ground: GroundPicture,
    content: Content,
    scale: tuple[float, float, float],
    added: Extension,
    shown: Shown,
    moves: bool,
) -> Drawing:
    """Draw the view's picture.

    scale: near, unit_px and symbol_px of the screen. added: with the picture on the image plane.
    """
    camera, size, scene = ground.request.camera, ground.request.size, ground.request.scene
    screen, exposure_ev = OutsideScreen(camera, size, *scale), shown.images.exposure_ev
    primitives = tuple(project([*grown_diagram(content), *added.items], screen))
    behind, placed = ground_of(scene.background, exposure_ev), None
    plane = image_plane(content.camera, camera, size)
    if plane is not None and added.picture is not None:
        placed = PlacedPicture(plane, added.picture, content.options.image_opacity, moves)
    texture = tools.overlay.draw(
        ShownScene(ground.textures, ground.mean, exposure_ev, ground), camera, size,
        layers(primitives, behind), screen.unit_px, placed,
        tools.layer.picture(added.cloud, screen, behind),
    )  # fmt: skip
    return Drawing(texture, primitives)


def _meetings(scene: Scene, *ray: float) -> tuple[float, ...]:
    return line_meetings(scene, np.array(ray[:3]), np.array(ray[3:]))
