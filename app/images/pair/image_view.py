"""A view of an image: the mouse and the keyboard over it, its mark, its notes, and its guest."""

from __future__ import annotations

import time
from dataclasses import dataclass, field, replace

from imgui_bundle import ImVec2, imgui

from lucida.app.cameras.remedies import helped, remedy_for
from lucida.app.images.marking import Anchor, followed
from lucida.app.images.placement import Placement, shown_pixel
from lucida.app.images.screen import Screen, available_px
from lucida.app.state.app_state import AppState
from lucida.app.state.options.shared import Pixel
from lucida.app.ui.areas import mouse_area
from lucida.app.ui.guest import Click, Guest, ShownIn
from lucida.app.ui.host import Host
from lucida.app.ui.instrument import Instrument
from lucida.renderer.camera.camera import Camera
from lucida.renderer.system.errors import LucidaError

from .dark_note import dark_note
from .image_mouse import ImageMouse
from .marks import claim_keys, walked
from .pane import Pane, draw_pane
from .rulers import ruler_sizes

PAUSE_S = 0.5  # turns of the wheel, or keys, in quicker succession are one undo step
NARROW_CELL = 4.0  # a smaller hovered pixel also gets a frame in the image under the mouse


@dataclass
class Linked:
    """The state that the two images share.

    walked_frame: the last frame in which a key has moved the mark. size: of the images when last
    drawn. guest: see app/ui/guest.py; it sets itself.
    """

    mouse: ImageMouse = field(default_factory=ImageMouse)
    anchor: Anchor | None = None
    gesture_number: int = 0
    gesture_s: float = 0.0
    walked_frame: int = -1
    size: tuple[int, int] = (0, 0)
    guest: Guest | None = None


class ImageView(Instrument):
    """One of the two images."""

    padding = ImVec2(1, 1)
    flags = int(
        imgui.WindowFlags_.no_scrollbar
        | imgui.WindowFlags_.no_scroll_with_mouse
        | imgui.WindowFlags_.no_background
    )

    def __init__(self, linked: Linked) -> None:
        self.linked = linked

    def unseen(self, host: Host) -> None:
        host.renderers.forget_pane(self.name)

    def cancel(self) -> None:
        self.linked.mouse.grab = None

    def begin_anew(self) -> None:
        """Reset the mouse and the mark: the step's mark belongs to the size of its final layout."""
        self.linked.mouse, self.linked.anchor = ImageMouse(), None

    def own_camera(self, host: Host) -> Camera | None:
        return host.state.camera

    def with_own_camera(self, state: AppState, camera: Camera) -> AppState:
        return state.with_camera(camera)

    def object_under(self, host: Host) -> int | None:
        if host.hovered is None or host.hovered[0] != self.name:
            return None
        return host.renderers.object_at(host.state, host.hovered[1])

    def _pane(self, host: Host, pane: Pane) -> None:
        """Draw an image into the rest of the window, and handle the mouse and the keys over it."""
        both, shared, guest = host.renderers, self.linked, self.linked.guest
        self._strip(host)
        room_px = available_px()
        both.fit_pane(self.name, room_px, host.state, ruler_sizes(host.state.images))
        room_px = both.common_room(room_px)
        self._keep_mark(host)
        start, avail = imgui.get_cursor_screen_pos(), imgui.get_content_region_avail()
        screen = Screen.here(both.placed(host.state.images, room_px))
        self._before_image(host, screen)
        clicks: list[tuple[Pixel, bool]] = []
        hovered = self._hovered(host, screen.placement)
        if shared.mouse.grab is None and guest is not None and guest.holds(self.name):
            is_over = True
            imgui.set_cursor_screen_pos(screen.visible[0])
            imgui.dummy(screen.visible[1] - screen.visible[0])
        else:
            is_over = self._mouse(host, screen, clicks)
        if shared.mouse.grab is not None:
            hovered = None
        screen = Screen(both.placed(host.state.images, room_px), screen.corner, screen.scale)
        draw_pane(host, pane, screen, (start, start + avail), hovered, self._on_pixels)
        imgui.set_cursor_screen_pos(start)
        self._over_image(host, screen)
        if not (pane.error or pane.note):
            self._why_black(host, screen)
        if guest is not None:
            self._with_guest(host, guest, screen, clicks, is_over)

    def _mouse(self, host: Host, screen: Screen, clicks: list[tuple[Pixel, bool]]) -> bool:
        """Handle the mouse and the arrow keys over the visible image. Return True if the mouse is
        over it without dragging.

        clicks: receives the guest's clicks, until the image is drawn.
        """
        mouse, io, (low, high) = self.linked.mouse, imgui.get_io(), screen.visible
        buttons = imgui.ButtonFlags_
        imgui.set_cursor_screen_pos(low)
        mouse_area(
            f"image##{self.name}",
            high - low,
            buttons.mouse_button_left | buttons.mouse_button_right | buttons.mouse_button_middle,
        )
        over, keyed = imgui.is_item_hovered(), claim_keys()

        def click(pixel: Pixel, double: bool) -> bool:
            guest = self.linked.guest
            is_wanted = guest is not None and guest.wants(host, double)
            if is_wanted:
                clicks.append((pixel, double))
            return is_wanted

        host.apply(mouse.drag(host, self.name, screen, click))
        if over and io.mouse_wheel:
            if io.key_ctrl:
                state = mouse.magnify(host.state, io.mouse_wheel, screen)
            else:
                state = mouse.wheel(host, self.name, io.mouse_wheel, screen)
            host.apply(state, self._gesture("magnify" if io.key_ctrl else "wheel"))
        over = over and mouse.grab is None
        if over:
            host.hover(self.name, screen.pixel(io.mouse_pos))
        if keyed:
            self._walk(host, screen.placement)
        return over

    def _with_guest(
        self,
        host: Host,
        guest: Guest,
        screen: Screen,
        clicks: list[tuple[Pixel, bool]],
        over: bool,
    ) -> None:
        """Draw the guest over the image, and pass it its clicks."""
        width, height = host.renderers.size
        low, high = screen.point(0, 0), screen.point(height, width)
        extent = ImVec2(high.x - low.x, high.y - low.y)
        shown = ShownIn(self.name, host.renderers.camera(host.state), low, extent)
        io = imgui.get_io()
        for pixel, double in clicks:
            if double:
                host.unclick()
            number = host.renderers.object_at(host.state, pixel)
            guest.click(host, shown, Click(number, double, io.key_shift or io.key_ctrl))
        draw = imgui.get_window_draw_list()
        draw.push_clip_rect(*screen.pane, True)
        guest.draw(host, shown, over)
        draw.pop_clip_rect()

    def _before_image(self, host: Host, screen: Screen) -> None:
        """Draw items that handle the mouse before the image."""

    def _on_pixels(self, host: Host, screen: Screen) -> None:
        """Draw on the image, below the grid, the marks and the legends."""

    def _over_image(self, host: Host, screen: Screen) -> None:
        """Draw over the image."""

    def _why_black(self, host: Host, screen: Screen) -> None:
        """Draw the note on a black image, with the button of its remedy, if any."""
        both, state = host.renderers, host.state
        reason, verdict = both.why_black(state), both.verdict(state)
        if reason is None or verdict is None:
            return
        if not dark_note(reason.text, remedy_for(reason), screen):
            return
        try:
            host.travel(helped(state, reason, verdict.darkness, host.focus))
        except LucidaError as problem:
            host.files.message = str(problem)

    def _strip(self, host: Host) -> None:
        """Draw above the image."""

    def _hovered(self, host: Host, placement: Placement) -> tuple[int, int] | None:
        """Return the pixel to frame: always in the other image, but in this one only if it is
        small.
        """
        if host.hovered is None:
            return None
        size = host.renderers.size
        if host.hovered[0] == self.name and placement.magnification <= NARROW_CELL:
            return None
        row, column = host.hovered[1]
        return (row, column) if row < size[1] and column < size[0] else None

    def _keep_mark(self, host: Host) -> None:
        """Move the mark to the same ray if the images have another size."""
        shared, state, size = self.linked, host.state, host.renderers.size
        marked_size = state.options.marked_size
        is_final, shared.size = size == shared.size and not host.is_rearranging, size
        if marked_size is None and shared.anchor is None and not is_final:
            return  # a step's mark belongs to the size of the final layout
        marked, shared.anchor = followed(state.marked, marked_size, shared.anchor, state.view, size)
        now_size = size if marked is not None else None
        if (marked, now_size) != (state.marked, marked_size):
            host.amend(
                state.with_options(replace(state.options, marked=marked, marked_size=now_size))
            )

    def _walk(self, host: Host, placement: Placement) -> None:
        """Move the mark by the arrow keys, and keep it visible."""
        shared, frame = self.linked, imgui.get_frame_count()
        if shared.walked_frame == frame:  # one image has the mouse, the other the keyboard
            return
        state, size = host.state, host.renderers.size
        middle = (size[1] // 2, size[0] // 2)
        start = host.hovered[1] if host.hovered is not None else middle
        pixel = walked(state.marked, size, start)
        if pixel is None:
            return
        shared.walked_frame = frame
        marked, images = replace(state.options, marked=pixel), state.images
        state = state.with_options(marked, shown_pixel(images, placement, pixel))
        host.apply(state, self._gesture("walk"))

    def _gesture(self, kind: str) -> tuple[str, int]:
        """Return the gesture that a turn of the wheel, or a key, belongs to."""
        shared, now_s = self.linked, time.monotonic()
        shared.gesture_number += now_s - shared.gesture_s > PAUSE_S
        shared.gesture_s = now_s
        return (kind, shared.gesture_number)
