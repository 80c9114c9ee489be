"""The mouse over an image: it moves the camera, marks a pixel, zooms into the pixels.

Takes a state and returns a new one. navigation.py computes the motions of the camera, placement.py
those of the magnified image.

    drag                  turns the camera about the point under the pointer
    Shift, right, middle  moves it
    Alt, or while flying  looks around
    wheel                 goes closer and farther
    click                 marks the pixel
    Ctrl + wheel          magnifies the pixels
    Ctrl + drag           moves the magnified image
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

from imgui_bundle import ImVec2, imgui

from lucida.app.images.pair.camera_drag import HALF_TURN, CameraDrag, drag_kind
from lucida.app.images.placement import panned, step_from, zoomed_at
from lucida.app.images.screen import Screen
from lucida.app.state.app_state import AppState
from lucida.app.state.options.shared import Pixel
from lucida.renderer.camera import navigation
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Vector

STILL_PX = 3.0  # a mouse that has moved less is still where it was


@dataclass(frozen=True)
class Seen:
    """An image for the mouse.

    name: of its view. shown, size: camera and (width, height) of the full image. center, reach: the
    scene's, see focus.py. depth_at: returns the ray parameter at a pixel, None if it is unknown.
    click: called for a click on a pixel, with True for the second of two; returns True if someone
    else takes it.
    """

    name: str
    shown: Camera
    size: tuple[int, int]
    center: Vector
    reach: float
    depth_at: Callable[[Pixel], float | None]
    click: Callable[[Pixel, bool], bool]


@dataclass(frozen=True)
class Grab(CameraDrag):
    """A drag over an image. kind: also "slide", for the magnified image.

    pane: the view's name. shown: the camera as drawn. pixel, part: what was under the mouse, as a
    pixel and in parts of the image. moved_away: the mouse has moved; otherwise it is a click.
    taken: the click is for someone else.
    """

    pane: str
    shown: Camera
    pixel: Pixel
    part: tuple[float, float]
    moved_away: bool = False
    taken: bool = False


@dataclass(frozen=True)
class Zoom:
    """The last zoom by the wheel: a world point, the camera and the mouse position then.

    While the wheel turns, no finished image shows the point; it is still the same.
    """

    pane: str
    camera: Camera
    mouse: tuple[float, float]  # in screen coordinates
    point: Vector

    def goes_on(self, seen: Seen, state: AppState, mouse: ImVec2) -> bool:
        """Return True if nothing but the wheel has moved since."""
        still = math.dist(self.mouse, (mouse.x, mouse.y)) < STILL_PX
        return still and seen.name == self.pane and state.camera == self.camera


def drag(
    seen: Seen, state: AppState, grab: Grab | None, screen: Screen
) -> tuple[AppState, Grab | None]:
    """Follow the mouse while it holds the current item, and until it is released: a click."""
    mouse = imgui.get_io().mouse_pos
    if imgui.is_item_activated():
        left = imgui.is_mouse_down(imgui.MouseButton_.left) and not imgui.get_io().key_shift
        kind = "slide" if left and imgui.get_io().key_ctrl else drag_kind()
        grab = _begin(seen, state, kind, mouse, screen)
        double = imgui.is_mouse_double_clicked(imgui.MouseButton_.left)
        return state, replace(grab, taken=double and seen.click(grab.pixel, True))
    if grab is None or grab.pane != seen.name:
        return state, grab
    if not imgui.is_item_active():
        left = grab.kind in ("orbit", "slide") or imgui.get_io().key_shift
        if grab.moved_away or grab.taken or not left:
            return state, None
        if seen.click(grab.pixel, False):
            return state, None
        return (_marked(state, grab.pixel) if grab.kind == "orbit" else state), None
    if not grab.moved_away:
        if math.dist(grab.start, (mouse.x, mouse.y)) < STILL_PX:
            return state, grab
        grab = replace(grab, moved_away=True)
    if grab.kind == "slide":
        x, y = screen.pane_px(mouse)
        moved = panned(state.images, screen.placement, grab.part, x, y)
        return state.with_options(moved), grab
    if state.camera != grab.latest and grab.kind != "look":  # by a key: continue from there
        return state, replace(_begin(seen, state, grab.kind, mouse, screen), moved_away=True)
    height = min(screen.placement.extent[1], screen.placement.pane[1]) / screen.scale
    point = _image_point(grab.shown, mouse, screen)
    camera = grab.moved(state.camera, mouse, point, HALF_TURN / max(height, 1.0))
    return state.with_camera(camera), replace(grab, latest=camera)


def _begin(seen: Seen, state: AppState, kind: str, mouse: ImVec2, screen: Screen) -> Grab:
    """Start a drag of the point under the mouse; of the scene's center if nothing is hit."""
    row, column = screen.pixel(mouse)
    parameter = seen.depth_at((row, column))
    pivot = seen.center
    if parameter is None:
        parameter = navigation.parameter_of(seen.shown, seen.center)
    elif kind == "orbit":
        ray = seen.shown.ray(row, column, seen.size)
        x, y, z = (ray.origin + parameter * ray.direction).tolist()
        pivot = (x, y, z)
    return Grab(
        pane=seen.name,
        kind=kind,
        camera=state.camera,
        shown=seen.shown,
        start=(mouse.x, mouse.y),
        pixel=(row, column),
        part=screen.placement.part_at(*screen.pane_px(mouse)),
        point=_image_point(seen.shown, mouse, screen),
        pivot=pivot,
        parameter=parameter,
        latest=state.camera,
    )


def _marked(state: AppState, pixel: Pixel) -> AppState:
    """Mark a pixel, or clear its mark."""
    return state.with_options(
        replace(state.options, marked=None if state.marked == pixel else pixel)
    )


@dataclass(frozen=True)
class ZoomAnchor:
    """The last magnification: the mouse in screen coordinates, and the place of the image under it.

    A small image stays in the middle of its window, so the place is not always under the mouse in
    between; in the end it is.
    """

    mouse: tuple[float, float]
    part: tuple[float, float]


def magnify(
    state: AppState, steps: float, screen: Screen, anchor: ZoomAnchor | None
) -> tuple[AppState, ZoomAnchor]:
    """Zoom into the pixels at the mouse, by Ctrl and the wheel. anchor: the last one."""
    mouse, placement = imgui.get_io().mouse_pos, screen.placement
    at, (x, y) = (mouse.x, mouse.y), screen.pane_px(mouse)
    if anchor is None or math.dist(anchor.mouse, at) >= STILL_PX:
        anchor = ZoomAnchor(at, placement.part_at(x, y))
    to = step_from(placement, state.images, steps)
    if to != placement.magnification:
        state = state.with_options(zoomed_at(state.images, placement, anchor.part, x, y, to))
    return state, anchor


def wheel(
    seen: Seen, state: AppState, zoom: Zoom | None, steps: float, screen: Screen
) -> tuple[AppState, Zoom | None]:
    """Zoom at the point under the mouse; at the scene's center if that is unknown."""
    mouse = imgui.get_io().mouse_pos
    row, column = screen.pixel(mouse)
    parameter = seen.depth_at((row, column))
    at = _image_point(seen.shown, mouse, screen)
    ray = seen.shown.ray(row, column, seen.size)
    if parameter is None and zoom is not None and zoom.goes_on(seen, state, mouse):
        parameter = navigation.parameter_of(seen.shown, zoom.point)
    if parameter is None:
        parameter = navigation.aim(seen.shown, ray.direction, seen.center, seen.reach)
    x, y, z = (ray.origin + parameter * ray.direction).tolist()
    scope = seen.center, seen.reach
    camera = navigation.zoomed_by_wheel(state.camera, at, steps, parameter, (x, y, z), scope)
    if camera is None:
        return state, None
    return state.with_camera(camera), Zoom(seen.name, camera, (mouse.x, mouse.y), (x, y, z))


def _image_point(camera: Camera, mouse: ImVec2, screen: Screen) -> tuple[float, float]:
    row, column = screen.position(mouse)
    x, y = camera.image_point(row, column, screen.placement.size)
    return float(x), float(y)
