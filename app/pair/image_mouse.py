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

import numpy as np
from imgui_bundle import ImVec2, imgui

from app.cameras import navigation
from app.host.fly import held
from app.images.placement import panned, step_from, zoomed_at
from app.images.screen import Screen
from app.state.app_state import AppState
from app.state.options import Pixel
from renderer.camera import Camera, Vector
from renderer.errors import LucidaError

WHEEL_STEP = 1.15
STILL_PX = 3.0  # a mouse that has moved less is still where it was
SLOWEST = 0.1  # of the scene's reach: what the wheel goes towards where nothing is seen
HALF_TURN = math.pi  # a drag over the image's whole height


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
    click: Callable[[Pixel, bool], bool] | None = None


@dataclass(frozen=True)
class Grab:
    """A drag over an image: where it began, and with which camera. shown: as drawn.

    kind: "orbit", "pan", "look", or "slide" for the magnified image. start: the mouse, in screen
    coordinates; pixel, part: what was under it, as a pixel and in parts of the image; moved:
    whether it has left it, else it is a click. latest: the camera that the drag has made; where
    another is found, something else has changed it.
    """

    pane: str
    kind: str
    camera: Camera
    shown: Camera
    start: tuple[float, float]
    pixel: Pixel
    part: tuple[float, float]
    point: tuple[float, float]  # on the image plane
    pivot: Vector
    parameter: float
    latest: Camera
    moved: bool = False
    taken: bool = False  # the click is somebody else's


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
    """Follows the mouse while it holds the current item, and a moment longer: a click."""
    mouse = imgui.get_io().mouse_pos
    if imgui.is_item_activated():
        grab = _begin(seen, state, _kind(), mouse, screen)
        double = imgui.is_mouse_double_clicked(imgui.MouseButton_.left)
        taken = double and seen.click is not None and seen.click(grab.pixel, True)
        return state, replace(grab, taken=taken)
    if grab is None or grab.pane != seen.name:
        return state, grab
    if not imgui.is_item_active():
        left = grab.kind in ("orbit", "slide") or imgui.get_io().key_shift
        if grab.moved or grab.taken or not left:
            return state, None
        if seen.click is not None and seen.click(grab.pixel, False):
            return state, None
        return (_marked(state, grab.pixel) if grab.kind == "orbit" else state), None
    if not grab.moved:
        if math.dist(grab.start, (mouse.x, mouse.y)) < STILL_PX:
            return state, grab
        grab = replace(grab, moved=True)
    if grab.kind == "slide":
        x, y = screen.pane_px(mouse)
        return state.with_options(images=panned(screen.placement, grab.part, x, y)), grab
    if grab.kind == "look":  # by steps: flying moves the camera in between
        return _looked(state, screen), grab
    if state.camera != grab.latest:  # a key was pressed: the drag goes on from there
        return state, replace(_begin(seen, state, grab.kind, mouse, screen), moved=True)
    try:
        if grab.kind == "pan":
            end = _image_point(grab.shown, mouse, screen)
            camera = navigation.panned(grab.camera, grab.point, end, grab.parameter)
        else:
            angle = _angle(screen)
            right, up = mouse.x - grab.start[0], grab.start[1] - mouse.y
            camera = navigation.orbited(grab.camera, grab.pivot, right * angle, up * angle)
        return state.with_camera(camera), replace(grab, latest=camera)
    except LucidaError:  # too far out: the camera stays
        return state, grab


def _kind() -> str:
    io = imgui.get_io()
    if not imgui.is_mouse_down(imgui.MouseButton_.left) or io.key_shift:
        return "pan"
    if io.key_ctrl:
        return "slide"
    return "look" if io.key_alt or any(held()) else "orbit"


def _angle(screen: Screen) -> float:
    """Return the angle of one unit of dragging."""
    height = min(screen.placement.extent[1], screen.placement.pane[1]) / screen.scale
    return HALF_TURN / max(height, 1.0)


def _looked(state: AppState, screen: Screen) -> AppState:
    delta, angle = imgui.get_io().mouse_delta, _angle(screen)
    try:
        return state.with_camera(navigation.looked(state.camera, delta.x * angle, -delta.y * angle))
    except LucidaError:
        return state


def _begin(seen: Seen, state: AppState, kind: str, mouse: ImVec2, screen: Screen) -> Grab:
    """The point under the mouse is what turns and moves; where nothing is seen, the scene."""
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
    """A click on the marked pixel takes the mark away."""
    return state.with_options(marked=None if state.marked == pixel else pixel)


@dataclass(frozen=True)
class Lens:
    """The last magnification: the mouse in screen coordinates, and the place of the image under it.

    A small image stays in the middle of its window, so the place is not always under the mouse in
    between; in the end it is.
    """

    mouse: tuple[float, float]
    part: tuple[float, float]


def magnify(
    state: AppState, steps: float, screen: Screen, lens: Lens | None
) -> tuple[AppState, Lens]:
    """Ctrl and the wheel: zooms into the pixels at the mouse, not the camera. lens: the last."""
    mouse, placement = imgui.get_io().mouse_pos, screen.placement
    at, (x, y) = (mouse.x, mouse.y), screen.pane_px(mouse)
    if lens is None or math.dist(lens.mouse, at) >= STILL_PX:
        lens = Lens(at, placement.part_at(x, y))
    to = step_from(placement, state.images, steps)
    if to != placement.magnification:
        state = state.with_options(images=zoomed_at(placement, lens.part, x, y, to))
    return state, lens


def wheel(
    seen: Seen, state: AppState, zoom: Zoom | None, steps: float, screen: Screen
) -> tuple[AppState, Zoom | None]:
    """Zooms at what is under the mouse, at the scene where that is not known."""
    mouse = imgui.get_io().mouse_pos
    row, column = screen.pixel(mouse)
    parameter = seen.depth_at((row, column))
    at = _image_point(seen.shown, mouse, screen)
    ray = seen.shown.ray(row, column, seen.size)
    if parameter is None and zoom is not None and zoom.goes_on(seen, state, mouse):
        parameter = navigation.parameter_of(seen.shown, zoom.point)
    if parameter is None:
        slowest = SLOWEST * seen.reach / float(np.linalg.norm(ray.direction))
        parameter = max(navigation.parameter_of(seen.shown, seen.center, slowest), slowest)
    x, y, z = (ray.origin + parameter * ray.direction).tolist()
    try:
        camera = navigation.zoomed(state.camera, at, WHEEL_STEP**steps, parameter)
    except (LucidaError, OverflowError):
        return state, None
    if not navigation.may_zoom(state.camera, camera, (x, y, z), seen.center, seen.reach):
        return state, None
    return state.with_camera(camera), Zoom(seen.name, camera, (mouse.x, mouse.y), (x, y, z))


def _image_point(camera: Camera, mouse: ImVec2, screen: Screen) -> tuple[float, float]:
    row, column = screen.position(mouse)
    x, y = camera.image_point(row, column, screen.placement.size)
    return float(x), float(y)
