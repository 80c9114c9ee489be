"""Three small pictures for a lecture's three questions: an image, a frame in a scene, a ray."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from lucida.app.ui import theme
from lucida.app.ui.canvas import Marks, draw_canvas
from lucida.renderer.camera.image_plane import Size

# In the unit square, y down: the eye, the frame's corners (near below, near above, far above, far
# below), a ball, and the points where a ray passes the frame and meets the ball.
EYE = ImVec2(0.04, 0.56)
FRAME = ImVec2(0.28, 0.84), ImVec2(0.28, 0.24), ImVec2(0.54, 0.12), ImVec2(0.54, 0.64)
BALL, RADIUS = ImVec2(0.83, 0.42), 0.165
PIXEL, HIT = ImVec2(0.41, 0.492), ImVec2(0.68, 0.444)
PLACES = (0.0, 0.0), (1.0, 0.0), (0.5, 1.0)  # the columns and rows of the pictures


def draw_questions(low: ImVec2, room: ImVec2, texture: int, size: Size, part: float) -> None:
    """Draw as many of the pictures as `part` says, the last one fading in.

    texture: the image's texture, of `size` (width, height).
    """
    gap = imgui.get_font_size()
    side = (min(room.x, room.y) - 3 * gap) / 2
    low = low + (room - ImVec2(2, 2) * (side + gap) + ImVec2(gap, gap)) * 0.5
    draw = imgui.get_window_draw_list()
    for number, place in enumerate(PLACES):
        at = low + ImVec2(*place) * (side + gap)
        opacity = min(max(part - number, 0.0), 1.0)
        if not opacity:
            continue
        if number == 0:
            unit = side / max(size)
            draw_canvas(texture, size, at + ImVec2(0, 0.5 * (side - unit * size[1])), unit, Marks())
        else:
            _frame(at, side, texture if number == 1 else None)
        cover = theme.u32(theme.PANEL, 1 - opacity)
        draw.add_rect_filled(at, at + ImVec2(side, side), cover)


def _frame(at: ImVec2, side: float, texture: int | None) -> None:
    """Draw an eye, a frame and a ball, with the image on the frame or else a ray."""
    draw, width = imgui.get_window_draw_list(), theme.line_px(2.0)
    plain, text = theme.u32(theme.PLAIN), theme.u32(theme.TEXT)
    mark = theme.u32(theme.seen(theme.MARK))
    eye, pixel, hit = (at + point * side for point in (EYE, PIXEL, HIT))
    corners = [at + corner * side for corner in FRAME]
    draw.add_circle_filled(at + BALL * side, RADIUS * side, theme.u32(theme.BASIS["u"]))
    for corner in corners:
        draw.add_line(eye, corner, plain, 0.5 * width)
    if texture is not None:
        below, above, far_above, far_below = corners
        image = imgui.ImTextureRef(texture)
        draw.add_image_quad(image, above, far_above, far_below, below)
    for number, corner in enumerate(corners):
        draw.add_line(corners[number - 1], corner, text, width)
    draw.add_circle_filled(eye, 0.03 * side, text)
    if texture is None:
        draw.add_line(eye, hit, theme.u32(theme.seen(theme.RAY)), 1.2 * width)
        draw.add_circle_filled(pixel, 1.1 * width, mark)
        draw.add_circle_filled(hit, 1.3 * width, mark)
