"""The mouse over an image: it moves the camera, marks a pixel, or magnifies the pixels.

navigation.py computes the motions of the camera, placement.py those of the magnified image.

    drag                  turns the camera about the point under the pointer
    Shift, right, middle  moves it
    Alt                   looks around
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

from lucida.app.images.placement import panned, step_from, zoomed_at
from lucida.app.images.screen import Screen
from lucida.app.state.app_state import AppState
from lucida.app.state.options.shared import Pixel
from lucida.app.ui.host import Host
from lucida.renderer.camera import navigation
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Vector

from .camera_drag import HALF_TURN, CameraDrag, drag_kind

STILL_PX = 3.0  # a mouse that has moved less counts as unmoved

# Called for a click on a pixel, with True for the second of two. Returns True if other
# code handles the click.
Click = Callable[[Pixel, bool], bool]


@dataclass(frozen=True)
class Grab(CameraDrag):
    """A drag over an image. kind: also "slide", for the magnified image.

    view: its name. shown: the camera as drawn. pixel, part: what was under the mouse, as a pixel
    and in parts of the image. moved_away: the mouse has moved; otherwise it is a click. taken:
    other code handles the click.
    """

    view: str
    shown: Camera
    pixel: Pixel
    part: tuple[float, float]
    moved_away: bool = False
    taken: bool = False


@dataclass(frozen=True)
class Zoom:
    """The last zoom by the wheel: a world point, the camera and the mouse position then.

    No finished image shows the point while the wheel turns, so it is kept.
    """

    view: str
    camera: Camera
    mouse: tuple[float, float]  # in screen coordinates
    point: Vector


class ImageMouse:
    """The mouse over both images. grab: the drag under way."""

    def __init__(self) -> None:
        self.grab: Grab | None = None
        self._zoom: Zoom | None = None
        # The mouse at the last magnification, in screen coordinates, and the point of the image
        # under it. A small image stays in the middle of its window, so the point may leave the
        # mouse in between; it returns when the image is large enough.
        self._magnified: tuple[tuple[float, float], tuple[float, float]] | None = None

    def drag(self, host: Host, view: str, screen: Screen, click: Click) -> AppState:
        """Return the state while the mouse holds the current item, and until it is released."""
        state, grab, mouse = host.state, self.grab, imgui.get_io().mouse_pos
        if imgui.is_item_activated():
            left = imgui.is_mouse_down(imgui.MouseButton_.left) and not imgui.get_io().key_shift
            kind = "slide" if left and imgui.get_io().key_ctrl else drag_kind()
            grab = _begin(host, view, kind, screen)
            double = imgui.is_mouse_double_clicked(imgui.MouseButton_.left)
            self.grab = replace(grab, taken=double and click(grab.pixel, True))
            return state
        if grab is None or grab.view != view:
            return state
        if not imgui.is_item_active():
            self.grab = None
            left = grab.kind in ("orbit", "slide") or imgui.get_io().key_shift
            if grab.moved_away or grab.taken or not left or click(grab.pixel, False):
                return state
            return _marked(state, grab.pixel) if grab.kind == "orbit" else state
        if not grab.moved_away:
            if math.dist(grab.start, (mouse.x, mouse.y)) < STILL_PX:
                return state
            grab = self.grab = replace(grab, moved_away=True)
        if grab.kind == "slide":
            at = screen.pane_px(mouse)
            return state.with_options(panned(state.images, screen.placement, grab.part, *at))
        if state.camera != grab.latest:  # by a key: continue from there
            self.grab = replace(_begin(host, view, grab.kind, screen), moved_away=True)
            return state
        height = min(screen.placement.extent[1], screen.placement.pane[1]) / screen.scale
        point = _image_point(grab.shown, mouse, screen)
        camera = grab.moved(state.camera, mouse, point, HALF_TURN / max(height, 1.0))
        self.grab = replace(grab, latest=camera)
        return state.with_camera(camera)

    def magnify(self, state: AppState, steps: float, screen: Screen) -> AppState:
        """Magnify the pixels at the mouse (Ctrl + wheel)."""
        mouse, placement = imgui.get_io().mouse_pos, screen.placement
        at, place = (mouse.x, mouse.y), screen.pane_px(mouse)
        if self._magnified is None or math.dist(self._magnified[0], at) >= STILL_PX:
            self._magnified = at, placement.part_at(*place)
        to = step_from(placement, state.images, steps)
        if to == placement.magnification:
            return state
        images = zoomed_at(state.images, placement, self._magnified[1], *place, to)
        return state.with_options(images)

    def wheel(self, host: Host, view: str, steps: float, screen: Screen) -> AppState:
        """Zoom at the point under the mouse; at the scene's center if that is unknown."""
        state, mouse, zoom = host.state, imgui.get_io().mouse_pos, self._zoom
        shown, focus = host.renderers.camera(state), host.focus
        pixel = screen.pixel(mouse)
        ray = shown.ray(*pixel, host.renderers.size)
        parameter = host.renderers.depth_at(state, pixel)
        if parameter is None and zoom is not None:
            still = math.dist(zoom.mouse, (mouse.x, mouse.y)) < STILL_PX
            if still and (zoom.view, zoom.camera) == (view, state.camera):
                parameter = navigation.parameter_of(shown, zoom.point)
        if parameter is None:
            parameter = navigation.aim(shown, ray.direction, focus.center, focus.reach)
        x, y, z = (ray.origin + parameter * ray.direction).tolist()
        at, scope = _image_point(shown, mouse, screen), (focus.center, focus.reach)
        camera = navigation.zoomed_by_wheel(state.camera, at, steps, parameter, (x, y, z), scope)
        if camera is None:
            return state
        self._zoom = Zoom(view, camera, (mouse.x, mouse.y), (x, y, z))
        return state.with_camera(camera)


def _begin(host: Host, view: str, kind: str, screen: Screen) -> Grab:
    """Start a drag of the point under the mouse; of the scene's center if nothing is hit."""
    state, mouse = host.state, imgui.get_io().mouse_pos
    shown, pixel = host.renderers.camera(state), screen.pixel(mouse)
    parameter, pivot = host.renderers.depth_at(state, pixel), host.focus.center
    if parameter is None:
        parameter = navigation.parameter_of(shown, host.focus.center)
    elif kind == "orbit":
        ray = shown.ray(*pixel, host.renderers.size)
        x, y, z = (ray.origin + parameter * ray.direction).tolist()
        pivot = (x, y, z)
    return Grab(
        view=view,
        kind=kind,
        camera=state.camera,
        shown=shown,
        start=(mouse.x, mouse.y),
        pixel=pixel,
        part=screen.placement.part_at(*screen.pane_px(mouse)),
        point=_image_point(shown, mouse, screen),
        pivot=pivot,
        parameter=parameter,
        latest=state.camera,
    )


def _marked(state: AppState, pixel: Pixel) -> AppState:
    """Mark a pixel, or clear its mark."""
    return state.with_options(
        replace(state.options, marked=None if state.marked == pixel else pixel)
    )


def _image_point(camera: Camera, mouse: ImVec2, screen: Screen) -> tuple[float, float]:
    row, column = screen.position(mouse)
    x, y = camera.image_point(row, column, screen.placement.size)
    return float(x), float(y)
