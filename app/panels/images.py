"""An image in a window: shown pixel by pixel, and a handle to move the camera with.

Owns what the mouse does over an image, and the marks drawn on it. Gets a state and returns a new
one; the motions are navigation.py's.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from imgui_bundle import ImVec2, imgui

from app import navigation, theme
from app.options import Pixel
from app.state import AppState
from renderer.camera import Camera, Vector
from renderer.errors import LucidaError

WHEEL_STEP = 1.15
STILL_PX = 3.0  # a mouse that has moved less while the wheel turned points at the same thing
SLOWEST = 0.1  # of the scene's reach: what the wheel goes towards where nothing is seen
SMALLEST_FRAMED = 6  # a pixel as large as that gets a frame of its own size
HALF_TURN = math.pi  # a drag over the image's whole height


@dataclass(frozen=True)
class Grab:
    """A drag over an image: where it began, and with which camera. shown: as drawn.

    latest: the camera that it has made; where another is found, something else has changed it.
    """

    pane: str
    kind: str  # "orbit" or "pan"
    camera: Camera
    shown: Camera
    start: tuple[float, float]  # the mouse, in screen coordinates
    point: tuple[float, float]  # on the image plane
    pivot: Vector
    parameter: float
    latest: Camera


@dataclass(frozen=True)
class Zoom:
    """What the wheel zoomed at last: a world point, the camera and the place of the mouse then.

    While it turns, no finished image tells what is seen; the point is still the same.
    """

    pane: str
    camera: Camera
    mouse: tuple[float, float]  # in screen coordinates
    point: Vector

    def goes_on(self, pane: Pane, state: AppState, mouse: ImVec2) -> bool:
        """Whether nothing but the wheel has moved since."""
        still = math.dist(self.mouse, (mouse.x, mouse.y)) < STILL_PX
        return still and pane.name == self.pane and state.camera == self.camera


@dataclass(frozen=True)
class Pane:
    """One image's window. texture: gives the GL name of a state's image, None for no image; asked
    after the mouse has moved the camera. note: text over the image.

    shown, size: camera and (width, height) of the full image. center, reach: the scene's, see
    focus.py. depth_at: the ray parameter seen at
    a pixel, None where that is not known. progress: of the image under way, 1 for none.
    """

    name: str
    texture: Callable[[AppState], int | None]
    shown: Camera
    size: tuple[int, int]
    center: Vector
    reach: float
    depth_at: Callable[[Pixel], float | None]
    note: str = ""
    is_error: bool = False
    progress: float = 1.0
    marked: Pixel | None = None


@dataclass(frozen=True)
class PaneResult:
    """hovered: the pixel under the mouse. zoom: what the wheel zoomed at, None if it rests."""

    state: AppState
    grab: Grab | None
    hovered: Pixel | None
    zoom: Zoom | None


def available_px() -> tuple[int, int]:
    """The current window's content in framebuffer pixels, (width, height)."""
    avail, scale = imgui.get_content_region_avail(), framebuffer_scale()
    return max(1, math.floor(avail.x * scale)), max(1, math.floor(avail.y * scale))


def framebuffer_scale() -> float:
    """Framebuffer pixels in one unit of ImGui's coordinates."""
    return imgui.get_io().display_framebuffer_scale.x or 1.0


def image_pane(
    pane: Pane, state: AppState, grab: Grab | None, zoom: Zoom | None = None
) -> PaneResult:
    """Draws the image into the current window and follows the mouse over it. zoom: the last."""
    scale = framebuffer_scale()
    unit = state.images.pixel_size / scale  # one image pixel in ImGui's coordinates
    extent = ImVec2(pane.size[0] * unit, pane.size[1] * unit)
    corner, avail = imgui.get_cursor_screen_pos(), imgui.get_content_region_avail()
    origin = ImVec2(
        math.floor((corner.x + max(0.0, avail.x - extent.x) / 2) * scale) / scale,
        math.floor((corner.y + max(0.0, avail.y - extent.y) / 2) * scale) / scale,
    )
    imgui.set_cursor_screen_pos(origin)
    buttons = imgui.ButtonFlags_
    imgui.invisible_button(
        f"image##{pane.name}",
        extent,
        buttons.mouse_button_left | buttons.mouse_button_right | buttons.mouse_button_middle,
    )
    mouse = imgui.get_io().mouse_pos
    over = imgui.is_item_hovered()
    hovered = _pixel(mouse, origin, unit, pane.size) if over else None
    state, grab = _drag(pane, state, grab, origin, extent, unit)
    state, zoom = _wheel(pane, state, zoom, mouse, origin, unit) if over else (state, None)
    far = ImVec2(origin.x + extent.x, origin.y + extent.y)
    draw = imgui.get_window_draw_list()
    texture = pane.texture(state)
    _surround(draw, corner, avail, origin, origin if texture is None else far)
    if texture is not None:
        draw.add_image(imgui.ImTextureRef(texture), origin, far)
    if pane.marked is not None and grab is None:
        _mark(draw, pane.marked, origin, unit)
    if pane.progress < 1.0:
        end = ImVec2(origin.x + extent.x * pane.progress, far.y)
        draw.add_rect_filled(ImVec2(origin.x, far.y - 3), end, theme.u32(theme.RAY))
    if pane.note:
        _note(draw, pane, origin, far)
    return PaneResult(state, grab, hovered if grab is None else None, zoom)


def _drag(
    pane: Pane, state: AppState, grab: Grab | None, origin: ImVec2, extent: ImVec2, unit: float
) -> tuple[AppState, Grab | None]:
    mouse = imgui.get_io().mouse_pos
    if imgui.is_item_activated():
        left = imgui.is_mouse_down(imgui.MouseButton_.left) and not imgui.get_io().key_shift
        return state, _begin(pane, state, "orbit" if left else "pan", mouse, origin, unit)
    if grab is None or grab.pane != pane.name:
        return state, grab
    if not imgui.is_item_active():
        return state, None
    if state.camera != grab.latest:  # a key was pressed: the drag goes on from there
        return state, _begin(pane, state, grab.kind, mouse, origin, unit)
    try:
        if grab.kind == "pan":
            end = _image_point(grab.shown, mouse, origin, unit, pane.size)
            camera = navigation.panned(grab.camera, grab.point, end, grab.parameter)
        else:
            angle = HALF_TURN / max(extent.y, 1.0)
            right, up = mouse.x - grab.start[0], grab.start[1] - mouse.y
            camera = navigation.orbited(grab.camera, grab.pivot, right * angle, up * angle)
        return state.with_camera(camera), replace(grab, latest=camera)
    except LucidaError:  # too far out: the camera stays
        return state, grab


def _begin(
    pane: Pane, state: AppState, kind: str, mouse: ImVec2, origin: ImVec2, unit: float
) -> Grab:
    """The point under the mouse is what turns and moves; where nothing is seen, the scene."""
    row, column = _pixel(mouse, origin, unit, pane.size)
    parameter = pane.depth_at((row, column))
    pivot = pane.center
    if parameter is None:
        parameter = navigation.parameter_of(pane.shown, pane.center)
    elif kind == "orbit":
        ray = pane.shown.ray(row, column, pane.size)
        x, y, z = (ray.origin + parameter * ray.direction).tolist()
        pivot = (x, y, z)
    point = _image_point(pane.shown, mouse, origin, unit, pane.size)
    camera, start = state.camera, (mouse.x, mouse.y)
    return Grab(pane.name, kind, camera, pane.shown, start, point, pivot, parameter, camera)


def _wheel(
    pane: Pane, state: AppState, zoom: Zoom | None, mouse: ImVec2, origin: ImVec2, unit: float
) -> tuple[AppState, Zoom | None]:
    """Zooms at what is under the mouse, at the scene where that is not known."""
    steps = imgui.get_io().mouse_wheel
    if not steps:
        return state, None
    row, column = _pixel(mouse, origin, unit, pane.size)
    parameter = pane.depth_at((row, column))
    at = _image_point(pane.shown, mouse, origin, unit, pane.size)
    ray = pane.shown.ray(row, column, pane.size)
    if parameter is None and zoom is not None and zoom.goes_on(pane, state, mouse):
        parameter = navigation.parameter_of(pane.shown, zoom.point)
    if parameter is None:
        slowest = SLOWEST * pane.reach / float(np.linalg.norm(ray.direction))
        parameter = max(navigation.parameter_of(pane.shown, pane.center, slowest), slowest)
    x, y, z = (ray.origin + parameter * ray.direction).tolist()
    try:
        camera = navigation.zoomed(state.camera, at, WHEEL_STEP**steps, parameter)
    except (LucidaError, OverflowError):
        return state, None
    if not navigation.may_zoom(state.camera, camera, (x, y, z), pane.center, pane.reach):
        return state, None
    return state.with_camera(camera), Zoom(pane.name, camera, (mouse.x, mouse.y), (x, y, z))


def _pixel(mouse: ImVec2, origin: ImVec2, unit: float, size: tuple[int, int]) -> Pixel:
    row, column = math.floor((mouse.y - origin.y) / unit), math.floor((mouse.x - origin.x) / unit)
    return min(max(row, 0), size[1] - 1), min(max(column, 0), size[0] - 1)


def _image_point(
    camera: Camera, mouse: ImVec2, origin: ImVec2, unit: float, size: tuple[int, int]
) -> tuple[float, float]:
    row, column = (mouse.y - origin.y) / unit - 0.5, (mouse.x - origin.x) / unit - 0.5
    x, y = camera.image_point(row, column, size)
    return float(x), float(y)


def _surround(
    draw: imgui.ImDrawList, corner: ImVec2, avail: ImVec2, origin: ImVec2, far: ImVec2
) -> None:
    """Fills what the image leaves of the window (whose own background would be drawn twice)."""
    end = ImVec2(corner.x + avail.x, corner.y + avail.y)
    for low, high in (
        (corner, ImVec2(end.x, origin.y)),
        (ImVec2(corner.x, far.y), end),
        (ImVec2(corner.x, origin.y), ImVec2(origin.x, far.y)),
        (ImVec2(far.x, origin.y), ImVec2(end.x, far.y)),
    ):
        if high.x > low.x and high.y > low.y:
            draw.add_rect_filled(low, high, theme.u32(theme.BACKGROUND))


def _mark(draw: imgui.ImDrawList, pixel: Pixel, origin: ImVec2, unit: float) -> None:
    """A frame round a pixel: its own border where that is large enough to see."""
    middle = ImVec2(origin.x + (pixel[1] + 0.5) * unit, origin.y + (pixel[0] + 0.5) * unit)
    half = unit / 2 if unit >= SMALLEST_FRAMED else 5.0
    for grow, color in ((2.0, theme.rgb("#000000", 0.7)), (1.0, theme.MARK)):
        reach = half + grow
        draw.add_rect(
            ImVec2(middle.x - reach, middle.y - reach),
            ImVec2(middle.x + reach, middle.y + reach),
            theme.u32(color),
            0.0,
            1.0,
        )


def _note(draw: imgui.ImDrawList, pane: Pane, origin: ImVec2, far: ImVec2) -> None:
    """A line or two of text in the middle of the image, which is darkened."""
    wrap = max(60.0, (far.x - origin.x) * 0.8)
    size = imgui.calc_text_size(pane.note, wrap_width=wrap)
    at = ImVec2((origin.x + far.x - size.x) / 2, (origin.y + far.y - size.y) / 2)
    low, high = ImVec2(at.x - 12, at.y - 8), ImVec2(at.x + size.x + 12, at.y + size.y + 8)
    draw.add_rect_filled(origin, far, theme.u32(theme.rgb("#000000", 0.5)))  # it is not of now
    draw.add_rect_filled(low, high, theme.u32(theme.rgb("#0c0d0f", 0.85)), 4.0)
    color = theme.ERROR if pane.is_error else theme.TEXT
    draw.add_text(
        imgui.get_font(), imgui.get_font_size(), at, theme.u32(color), pane.note, wrap_width=wrap
    )
