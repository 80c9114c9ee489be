"""The compare view: both images in one place, as a wipe or a difference.

A difference is shown only between two full images of the present state. The mouse works as in
../pair/view.py.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import moderngl
from imgui_bundle import ImVec2, ImVec4, imgui

from lucida.app.images.pair.pane import Pane
from lucida.app.images.pair.view import ImageView, RasterView
from lucida.app.images.placement import Placement
from lucida.app.images.renderers import Renderers
from lucida.app.images.screen import Screen
from lucida.app.images.shown import Picture, visible_size
from lucida.app.state.app_state import AppState
from lucida.app.ui import theme
from lucida.app.ui.areas import focused_steps, mouse_area
from lucida.app.ui.background import Background
from lucida.app.ui.host import Host
from lucida.app.ui.instrument import Instrument, view_of
from lucida.app.ui.lettering import lettering
from lucida.app.ui.uploads import Uploads
from lucida.renderer.compare.raster_and_ray import Comparison
from lucida.renderer.images.frame import stored
from lucida.renderer.system.errors import describe
from lucida.renderer.system.memo import Memo

from . import comparing, panel
from .actions import COMPARING
from .pictures import Bytes, marked_picture

NAME = "Compare"
KEY_STEP = 0.01  # motion of the divider by an arrow key
GRIP_EM = 0.6  # half the width in which the divider can be grabbed
LARGE_PX = 6.0  # larger pixels are marked without enlarging them
COMPARED = "compared"  # the visible images, see Pictures.picture
SMALL_EM = 20.0  # a lower view shows its image alone
MUTED = 0.6  # brightness of an image in place of a difference


class CompareView(ImageView):
    name = NAME
    title = "Compare  raster and ray"
    actions = COMPARING
    padding = ImVec2(8, 6)
    flags = int(imgui.WindowFlags_.no_scrollbar | imgui.WindowFlags_.no_scroll_with_mouse)

    def __init__(self, views: Sequence[Instrument]) -> None:
        super().__init__(view_of(views, RasterView).linked)
        self._uploads: Uploads | None = None
        self._work: Background[tuple[Comparison, Bytes]] = Background("lucida-difference")
        self._made: tuple[Comparison, Bytes] | None = None  # the last difference, and its source
        self._marks = Memo(marked_picture)
        self._held: float | None = None  # the place in the divider where the mouse grabbed it
        self.screen: Screen | None = None  # where the image is

    @property
    def settled(self) -> bool:
        return not self._work.busy

    def begin(self, host: Host, context: moderngl.Context) -> None:
        self._uploads = Uploads(context)

    def end(self) -> None:
        self._work.close()
        if self._uploads is not None:
            self._uploads.release()
            self._uploads = None

    def cancel(self) -> None:
        super().cancel()
        self._held = None

    def draw(self, host: Host) -> None:
        both = host.renderers
        if self._uploads is not None:
            self._uploads.begin_frame()
        outcome = self._work.poll()
        if outcome is not None and outcome.value is not None:
            self._made = outcome.value
        is_wipe = host.options.compare.mode == "wipe"

        def picture(state: AppState, placement: Placement) -> Picture | None:
            return self._picture(both, state, placement)

        error = both.raster_error or both.ray_error
        self._pane(host, Pane(picture, None, error, legend=is_wipe))
        both.trace(host.state)

    def _strip(self, host: Host) -> None:
        if not host.has_tools or imgui.get_window_height() < SMALL_EM * imgui.get_font_size():
            return
        super()._strip(host)
        panel.toolbar(host)
        both, state = host.renderers, host.state
        verdict, waits = both.verdict(state), waiting(both, state)
        error = both.raster_error or both.ray_error or both.agreement.error
        if error is not None:
            panel.verdict(host, describe(error), theme.ERROR, None)
        elif waits or verdict is None:
            panel.verdict(host, waits or "Comparing ...", theme.DIM, None)
        else:
            text, good = comparing.headline(verdict.comparison, comparing.effects_of(state))
            panel.verdict(host, text, theme.GOOD if good else theme.ERROR, verdict.comparison)

    def _before_image(self, host: Host, screen: Screen) -> None:
        if host.options.compare.mode == "wipe" and min(host.renderers.size):
            self._drag_divider(host, screen)
        else:
            self._held = None

    def _over_image(self, host: Host, screen: Screen) -> None:
        self.screen = screen
        if host.options.compare.mode == "wipe":
            self._draw_divider(host, screen)

    def _on_pixels(self, host: Host, screen: Screen) -> None:
        both, options = host.renderers, host.options.compare
        draw, (low, high) = imgui.get_window_draw_list(), screen.visible
        if options.mode == "wipe":
            picture = both.picture(True, host.state, screen.placement, COMPARED)
            if picture is not None:
                x = self._divider_x(host.state, screen, both.size)
                tint = theme.u32(ImVec4(1, 1, 1, options.rise))
                draw.push_clip_rect(ImVec2(x, low.y), high, True)
                draw.add_image(imgui.ImTextureRef(picture.texture.glo), low, high, col=tint)
                draw.pop_clip_rect()
        elif self._difference(both, host.state) is None:
            draw.add_rect_filled(low, high, theme.u32(theme.rgb("#000000", MUTED)))
        verdict = both.verdict(host.state)
        if options.causes and verdict is not None:
            is_large = min(screen.placement.unit) >= LARGE_PX
            marks = self._marks(verdict.comparison.labels, is_large)
            texture = self._placed("marks", marks, screen.placement)
            draw.add_image(imgui.ImTextureRef(texture.glo), low, high)

    def _picture(self, both: Renderers, state: AppState, placement: Placement) -> Picture | None:
        """Return the visible part of the difference, or of the image left of the divider. Return
        None if it is not ready.
        """
        options = state.options.compare
        if options.mode == "wipe":
            beside = options.divider < 1.0 and options.rise == 1.0
            if beside and both.picture(True, state, placement, COMPARED) is None:
                return None  # the raster image must not look like the ray image
        difference = self._difference(both, state) if options.mode == "absolute" else None
        if difference is None:
            return both.picture(False, state, placement, COMPARED)
        texture = self._placed("difference", difference, placement)
        return Picture(texture, texture)

    def _difference(self, both: Renderers, state: AppState) -> Bytes | None:
        """Return the difference of this state's images, which is computed in the background."""
        verdict, made = both.verdict(state), self._made
        if verdict is None or waiting(both, state):
            return None
        comparison = verdict.comparison
        channel = stored(state.images.channel)
        self._work.ask(_made, comparison, channel, state.options.compare.gain)
        return made[1] if made is not None and made[0] is comparison else None

    def _placed(self, name: str, picture: Bytes, placement: Placement) -> moderngl.Texture:
        """Return the visible part of a picture of the images' size."""
        assert self._uploads is not None
        left, top, right, bottom = placement.visible_parts
        part = (left, top), (right - left, bottom - top)
        return self._uploads.magnified(name, picture, visible_size(placement), *part)

    # The divider.

    def _drag_divider(self, host: Host, screen: Screen) -> None:
        """Handle the divider as a separate item before the image, which then does not get the
        mouse.
        """
        options = host.options.compare
        low, high = screen.visible
        x = self._divider_x(host.state, screen, host.renderers.size)
        grip = GRIP_EM * imgui.get_font_size()
        if not low.x - grip <= x <= high.x + grip:
            return
        imgui.set_cursor_screen_pos(ImVec2(x - grip, low.y))
        mouse_area("divider", ImVec2(2 * grip, max(1.0, high.y - low.y)))
        mouse = imgui.get_io().mouse_pos
        if step := focused_steps()[0]:
            moved = replace(options, divider=options.divider + KEY_STEP * step)
            host.apply(host.state.with_options(moved), ("divider", "keys"))
        if imgui.is_item_hovered() or imgui.is_item_active():
            imgui.set_mouse_cursor(imgui.MouseCursor_.resize_ew)
        if imgui.is_item_activated():
            self._held = mouse.x - x
        if not imgui.is_item_active():
            self._held = None
        elif self._held is not None:
            part, _ = screen.placement.part_at(*screen.pane_px(ImVec2(mouse.x - self._held, low.y)))
            host.edit(replace(options, divider=part))

    def _divider_x(self, state: AppState, screen: Screen, size: tuple[int, int]) -> float:
        return screen.point(0, round(state.options.compare.divider * size[0])).x

    def _draw_divider(self, host: Host, screen: Screen) -> None:
        """Draw a line between the images, with a handle in its middle, and a label on each side."""
        low, high = screen.visible
        x = self._divider_x(host.state, screen, host.renderers.size)
        draw, em = imgui.get_window_draw_list(), imgui.get_font_size()
        _label(host, screen, "Raster", right=False, end=x)
        _label(host, screen, "Ray", right=True, end=x)
        if not low.x <= x <= high.x:
            return
        black, white = theme.u32(theme.rgb("#000000", 0.75)), theme.u32(theme.rgb("#ffffff"))
        middle = ImVec2(x, (low.y + high.y) / 2)
        draw.push_clip_rect(low, high, True)
        for color, width, radius in ((black, 5.0, 1.1), (white, 2.0, 0.95)):
            draw.add_line(ImVec2(x, low.y), ImVec2(x, high.y), color, width)
            draw.add_circle_filled(middle, radius * em, color)
        for side in (-1, 1):
            tip, foot = middle + ImVec2(side * 0.7 * em, 0), middle + ImVec2(side * 0.25 * em, 0)
            wide = ImVec2(0, side * 0.4 * em)
            draw.add_triangle_filled(tip, foot - wide, foot + wide, black)
        draw.pop_clip_rect()


def waiting(both: Renderers, state: AppState) -> str:
    """Return the reason that the images cannot be compared yet, or ""."""
    image = both.ray_image
    if image is None or image.request != both.request(state):
        return both.preparing() or "The ray image is being traced: no difference yet"
    if max(image.factor, both.raster_factor) > 1:
        return "The images are still coarse: no difference yet"
    return ""


def _made(comparison: Comparison, channel: str, gain: float) -> tuple[Comparison, Bytes]:
    return comparison, comparison.false_color(channel, gain)


def _label(host: Host, screen: Screen, text: str, right: bool, end: float) -> None:
    """Draw an image's name in its upper left or right corner. Draw nothing without space for it.
    end: the divider.
    """
    low, high = screen.visible
    draw = imgui.get_window_draw_list()
    with lettering(host.fonts.bold):
        size = imgui.calc_text_size(text)
        pad = 0.5 * size.y
        left = high.x - size.x - 3 * pad if right else low.x + pad
        at = ImVec2(left, low.y + pad)
        far = at + ImVec2(size.x + 2 * pad, pad + size.y)
        if (at.x < end if right else far.x > end) or at.x < low.x or far.x > high.x:
            return
        draw.add_rect_filled(at, far, theme.u32(theme.rgb("#000000", 0.72)), 4.0)
        draw.add_text(at + ImVec2(pad, pad / 2), theme.u32(theme.rgb("#ffffff")), text)
