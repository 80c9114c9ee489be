"""The compare view: both images in one place, as a difference, a wipe or a flip.

A difference is shown only between two full images of the present state. comparing.py explains the
numbers; composed.py makes the pictures. Over the image, the mouse does the same as in
../pair/view.py.
"""

from __future__ import annotations

from collections.abc import Sequence

import moderngl
import numpy as np
from imgui_bundle import ImVec2, ImVec4, imgui
from numpy.typing import NDArray

from lucida.app.images.compare import comparing, panel
from lucida.app.images.compare.actions import COMPARING, FLIP_KEY
from lucida.app.images.compare.composed import SIDES, Composed, Mapping
from lucida.app.images.pair.view import ImageView, RasterView
from lucida.app.images.placement import Placement
from lucida.app.images.renderers import Renderers, look_of
from lucida.app.images.screen import Screen
from lucida.app.images.shown import Held, Picture, ShownImage, whole
from lucida.app.images.textures import PANE
from lucida.app.state.app_state import AppState
from lucida.app.ui import theme
from lucida.app.ui.areas import focused_steps, mouse_area
from lucida.app.ui.host import Host
from lucida.app.ui.instrument import Instrument, view_of
from lucida.app.ui.lettering import lettering
from lucida.renderer.compare.raster_and_ray import Comparison
from lucida.renderer.raster import Look
from lucida.renderer.raster.targets import Region
from lucida.renderer.system.errors import LucidaError, describe
from lucida.renderer.system.memo import Memo

NAME = "Compare"
KEY_STEP = 0.01  # of the divider, by an arrow key
GRIP_EM = 0.6  # half the width in which the divider can be taken
LARGE_PX = 6.0  # pixels that large are marked without enlarging them
COMPARED = "compared"  # the two images, as they are looked at; see ShownImage.picture
AS_IT_IS = Look(transfer="linear")  # of pictures that have gone through the display transform


class CompareView(ImageView):
    name = NAME
    title = "Compare  raster and ray"
    actions = COMPARING
    synonyms = {
        "Worst pixel": "error difference",
        "Compare raster and ray": "difference diff error flip",
    }
    padding = ImVec2(8, 6)
    flags = int(imgui.WindowFlags_.no_scrollbar | imgui.WindowFlags_.no_scroll_with_mouse)

    def __init__(self, views: Sequence[Instrument]) -> None:
        super().__init__(view_of(views, RasterView).linked)
        self._composed: Composed | None = None
        self._shown: dict[str, ShownImage] = {}  # by SIDES
        self._show = {side: Memo(_show) for side in SIDES}
        self._error: Exception | None = None
        self._footer_px = 0.0  # the height of what is below the image, in the last frame
        self._held: float | None = None  # where in the divider the mouse took it
        self.screen: Screen | None = None  # where the image is

    def begin(self, host: Host, context: moderngl.Context) -> None:
        self._composed = Composed(context)
        self._shown = {side: ShownImage(context) for side in SIDES}

    def end(self) -> None:
        if self._composed is not None:
            self._composed.release()
        for shown in self._shown.values():
            shown.release()
        self._composed, self._shown = None, {}

    def cancel(self) -> None:
        super().cancel()
        self._held = None

    def draw(self, host: Host) -> None:
        if not host.has_tools:
            self._image(host)
            host.renderers.trace(host.state)
            return
        if imgui.get_window_height() > panel.SMALL_EM * imgui.get_font_size():
            super()._strip(host)
        host.apply(panel.toolbar(host.state))
        available = imgui.get_content_region_avail()
        size = ImVec2(available.x, max(1.0, available.y - self._footer_px))
        flat, without = imgui.ChildFlags_.nav_flattened, imgui.WindowFlags_.no_background
        imgui.begin_child("image", size, flat, self.flags | without)
        self._image(host)
        imgui.end_child()
        told = self._told(host)
        is_short = available.y < panel.LOW_EM * imgui.get_font_size()
        top = imgui.get_cursor_pos_y()
        wish = panel.footer(host.state, told, is_short, host.fonts, self._color_map)
        footer_px = imgui.get_cursor_pos_y() - top + imgui.get_style().item_spacing.y
        if footer_px != self._footer_px:
            self._footer_px = footer_px
            host.animate()
        host.apply(self._granted(wish, told.comparison))
        host.renderers.trace(host.state)

    # The image.

    def _image(self, host: Host) -> None:
        both, mode = host.renderers, host.state.options.compare.mode
        for shown in self._shown.values():
            shown.begin_frame()
        is_picture = mode in ("wipe", "flip")
        side = SIDES[mode == "flip" and self._flipped(host.state)]
        self._pane(
            host,
            lambda state, placement: self._picture(both, state, placement, side),
            (lambda state, channel, region: self._values(both, state, channel, region))
            if is_picture
            else None,
            both.raster_error or both.ray_error or self._error,
            legend=is_picture,
        )

    def _strip(self, host: Host) -> None:
        """Draw nothing: draw() puts the strip above the view's own controls."""

    def _before_image(self, host: Host, screen: Screen) -> None:
        if host.state.options.compare.mode == "wipe" and min(host.renderers.size):
            self._drag_divider(host, screen)
        else:
            self._held = None

    def _over_image(self, host: Host, screen: Screen) -> None:
        self.screen = screen
        mode = host.state.options.compare.mode
        if mode == "wipe":
            self._draw_divider(host, screen)
        elif mode == "flip":
            _label(host, screen, "Ray" if self._flipped(host.state) else "Raster", right=False)

    def _on_pixels(self, host: Host, screen: Screen) -> None:
        both, state = host.renderers, host.state
        options = state.options.compare
        if options.mode == "wipe":
            picture = self._picture(both, state, screen.placement, SIDES[1])
            if picture is not None:
                low, high = screen.visible
                draw, image = imgui.get_window_draw_list(), imgui.ImTextureRef(picture.texture.glo)
                x = self._divider_x(state, screen, both.size)
                draw.push_clip_rect(ImVec2(x, low.y), high, True)
                draw.add_image(image, low, high, col=theme.u32(ImVec4(1, 1, 1, options.rise)))
                draw.pop_clip_rect()

    def _picture(
        self, both: Renderers, state: AppState, placement: Placement, side: str
    ) -> Picture | None:
        """Return the visible part of the difference, or of the image on one side of a wipe: raster
        left, ray right. Return None if it is not there yet.
        """
        textures, composed = both.textures, self._composed
        assert textures is not None and composed is not None
        options, look = state.options.compare, look_of(state.images)
        request = both.request(state)
        assert request is not None
        picture = textures.raster_in(whole(both.size), request, look, COMPARED)
        if picture is not None and self._shows_ray(state, side):
            ray = textures.ray_in(whole(both.size), request, look, COMPARED)
            # Without the ray image, the raster image must not be taken for it.
            picture = ray if ray is None or side == SIDES[1] else picture
        if picture is None:
            return None
        held, muted, shown = picture.held, False, self._shown[side]
        try:
            if options.mode in ("absolute", "signed"):
                drawn, image = textures.raster.full(request), both.ray_image
                muted = drawn is None or image is None or waiting(both, state) != ""
                if drawn is not None and image is not None and not muted:
                    mapping = Mapping(
                        state.images.channel,
                        state.images.component,
                        options.gain,
                        options.mode == "signed",
                    )
                    held = composed.difference(
                        drawn.textures, drawn.number, image.frame, mapping
                    ).held
            verdict = both.verdict(state)
            labels = verdict.comparison.labels if verdict and options.causes else None
            enlarged = min(placement.unit) < LARGE_PX
            self._show[side](
                shown, composed.compose(both.size, held, muted, labels, enlarged, side).held
            )
            seen = shown.picture(PANE, AS_IT_IS, placement)
            self._error = None
        except (LucidaError, moderngl.Error) as error:  # shown in the view, which goes on
            self._error = error
            self._show[side].forget()
            shown.set_channels({})
            return None
        return seen

    @staticmethod
    def _shows_ray(state: AppState, side: str) -> bool:
        """Return True if a side needs the ray image: the right one, and the left one of a wipe that
        has it beside it.
        """
        options = state.options.compare
        beside = options.mode == "wipe" and options.divider < 1.0 and options.rise == 1.0
        return side == SIDES[1] or beside

    def _flipped(self, state: AppState) -> bool:
        """Return True if flip shows the ray image now."""
        io = imgui.get_io()
        held = imgui.is_key_down(FLIP_KEY) and not (io.want_text_input or io.key_ctrl or io.key_alt)
        return state.options.compare.flipped != held

    def _values(
        self, both: Renderers, state: AppState, channel: str, region: Region
    ) -> NDArray | None:
        """Return the values of the visible pixels, each from the image that it is taken from."""
        raster = both.raster_values(state, channel, region)
        ray = both.ray_values(state, channel, region)
        if state.options.compare.mode == "flip":
            return ray if self._flipped(state) else raster
        if raster is None or ray is None:
            return None
        _, left, _, right = region
        divider = _column(state.options.compare.divider, both.size)
        columns = np.arange(left, right) < divider
        return np.where(columns.reshape((1, -1) + (1,) * (raster.ndim - 2)), raster, ray)

    # The divider.

    def _drag_divider(self, host: Host, screen: Screen) -> None:
        """Handle the divider as an item of its own, before the image's, which then does not get the
        mouse.
        """
        state, size = host.state, host.renderers.size
        low, high = screen.visible
        x, grip = self._divider_x(state, screen, size), GRIP_EM * imgui.get_font_size()
        if not low.x - grip <= x <= high.x + grip:
            return
        imgui.set_cursor_screen_pos(ImVec2(x - grip, low.y))
        mouse_area("divider", ImVec2(2 * grip, max(1.0, high.y - low.y)))
        mouse = imgui.get_io().mouse_pos
        if step := focused_steps()[0]:
            divider = state.options.compare.divider + KEY_STEP * step
            host.apply(comparing.with_divider(state, divider), ("divider", "keys"))
        if imgui.is_item_hovered() or imgui.is_item_active():
            imgui.set_mouse_cursor(imgui.MouseCursor_.resize_ew)
        if imgui.is_item_activated():
            self._held = mouse.x - x
        if not imgui.is_item_active():
            self._held = None
        elif self._held is not None:
            part, _ = screen.placement.part_at(*screen.pane_px(ImVec2(mouse.x - self._held, low.y)))
            host.apply(comparing.with_divider(state, part))

    def _divider_x(self, state: AppState, screen: Screen, size: tuple[int, int]) -> float:
        return screen.point(0, _column(state.options.compare.divider, size)).x

    def _draw_divider(self, host: Host, screen: Screen) -> None:
        """Draw a line between the images, with a handle in its middle, and a label on each side."""
        low, high = screen.visible
        x = self._divider_x(host.state, screen, host.renderers.size)
        draw = imgui.get_window_draw_list()
        em = imgui.get_font_size()
        _label(host, screen, "Raster", right=False, end=x)
        _label(host, screen, "Ray", right=True, end=x)
        if not low.x <= x <= high.x:
            return
        black, white = theme.u32(theme.rgb("#000000", 0.75)), theme.u32(theme.rgb("#ffffff"))
        draw.push_clip_rect(low, high, True)
        draw.add_line(ImVec2(x, low.y), ImVec2(x, high.y), black, 5.0)
        draw.add_line(ImVec2(x, low.y), ImVec2(x, high.y), white, 2.0)
        middle = ImVec2(x, (low.y + high.y) / 2)
        draw.add_circle_filled(middle, 1.1 * em, black)
        draw.add_circle_filled(middle, 0.95 * em, white)
        for side in (-1, 1):
            tip, foot = middle.x + side * 0.7 * em, middle.x + side * 0.25 * em
            draw.add_triangle_filled(
                ImVec2(tip, middle.y),
                ImVec2(foot, middle.y - side * 0.4 * em),
                ImVec2(foot, middle.y + side * 0.4 * em),
                black,
            )
        draw.pop_clip_rect()

    # Below the image.

    def _told(self, host: Host) -> panel.CompareReport:
        both, state = host.renderers, host.state
        verdict, waits = both.verdict(state), waiting(both, state)
        error = both.raster_error or both.ray_error or self._error or both.agreement.error
        pixel = host.hovered[1] if host.hovered else state.marked
        if error is not None:
            return panel.CompareReport(describe(error), theme.ERROR)
        if waits or verdict is None:
            return panel.CompareReport(waits or "Comparing ...", theme.DIM)
        comparison = verdict.comparison
        text, good = comparing.headline(comparison, comparing.effects_of(state))
        width, height = comparison.size
        if pixel is not None and not (pixel[0] < height and pixel[1] < width):
            pixel = None
        return panel.CompareReport(text, theme.GOOD if good else theme.ERROR, comparison, pixel)

    def _granted(self, wish: panel.Wish, comparison: Comparison | None) -> AppState:
        state = wish.state
        if comparison is not None and wish.worst:
            return comparing.at_worst(state, comparison)
        if comparison is not None and wish.step:
            return comparing.stepped(state, comparison, wish.step > 0, wish.label)
        return state

    def _color_map(self, low: ImVec2, high: ImVec2, signed: bool) -> None:
        assert self._composed is not None
        texture = imgui.ImTextureRef(self._composed.color_map(signed).glo)
        imgui.get_window_draw_list().add_image(texture, low, high)


def waiting(both: Renderers, state: AppState) -> str:
    """Return why the images cannot be compared yet; "" if they can."""
    image = both.ray_image
    if image is None or image.request != both.request(state):
        return both.preparing() or "The ray image is being traced: no difference yet"
    if image.factor > 1:
        return f"The ray image is still coarse (1/{image.factor}): no difference yet"
    if both.raster_factor > 1:
        return f"The raster image is still coarse (1/{both.raster_factor}): no difference yet"
    return ""


def _column(divider: float, size: tuple[int, int]) -> int:
    """Return the first column of the second image."""
    return round(divider * size[0])


def _show(shown: ShownImage, picture: Held) -> None:
    shown.set_channels({"color": picture[0]})


def _label(host: Host, screen: Screen, text: str, right: bool, end: float | None = None) -> None:
    """Draw an image's name in its upper left or right corner.

    end: where the image ends, if before the view does. Without room, there is no name.
    """
    low, high = screen.visible
    with lettering(host.fonts.bold):
        size = imgui.calc_text_size(text)
    pad = 0.5 * size.y
    left = high.x - size.x - 3 * pad if right else low.x + pad
    at, far = ImVec2(left, low.y + pad), ImVec2(left + size.x + 2 * pad, low.y + 2 * pad + size.y)
    if at.x < low.x or far.x > high.x or far.y > high.y:
        return
    if end is not None and not (at.x > end if right else far.x < end):
        return
    draw = imgui.get_window_draw_list()
    draw.add_rect_filled(at, far, theme.u32(ImVec4(0, 0, 0, 0.72)), 4.0)
    white = theme.u32(ImVec4(1, 1, 1, 1))
    with lettering(host.fonts.bold):
        draw.add_text(ImVec2(at.x + pad, at.y + pad / 2), white, text)
