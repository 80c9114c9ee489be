"""A view of an image: the mouse and the keyboard over it, its mark, its notes, and its guest."""

from __future__ import annotations

import time
from dataclasses import dataclass, field, replace
from functools import partial

from imgui_bundle import ImVec2, imgui

from lucida.app.cameras.remedies import helped, remedy_for
from lucida.app.images.marking import Anchor, followed
from lucida.app.images.pair.dark_note import DarkNote, note_button
from lucida.app.images.pair.image_mouse import Seen
from lucida.app.images.pair.marks import walked
from lucida.app.images.pair.pane import Drawn, MouseState, Pane, image_pane
from lucida.app.images.pair.pixelgrid import Values
from lucida.app.images.pair.rulers import ruler_sizes
from lucida.app.images.pair.toolbar import image_strip
from lucida.app.images.photograph.layer import PhotographLayer
from lucida.app.images.placement import Placement, shown_pixel
from lucida.app.images.screen import Screen, available_px
from lucida.app.state.app_state import AppState
from lucida.app.state.options.shared import Pixel
from lucida.app.ui.guest import Click, Guest, ShownIn
from lucida.app.ui.host import Host
from lucida.app.ui.instrument import Instrument
from lucida.renderer.camera.camera import Camera
from lucida.renderer.system.errors import LucidaError, describe

PAUSE_S = 0.5  # turns of the wheel, or keys, closer together are one step of undo
STEADY = 6  # frames of one size, two panes each
NARROW_CELL = 4.0  # a hovered pixel that large gets a frame in the image under the mouse too


@dataclass
class Linked:
    """The state that the two images share.

    photograph: laid over them. walked_frame: the last one in which a key has moved the mark. size,
    steady_frames: of the images, and how often they were drawn at that size. guest: see
    app/ui/guest.py; set by itself.
    """

    photograph: PhotographLayer = field(default_factory=PhotographLayer)
    mouse: MouseState = field(default_factory=MouseState)
    anchor: Anchor | None = None
    gesture_number: int = 0
    gesture_s: float = 0.0
    walked_frame: int = -1
    size: tuple[int, int] = (0, 0)
    steady_frames: int = 0
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

    @property
    def settled(self) -> bool:
        return not self.linked.photograph.busy

    def unseen(self, host: Host) -> None:
        host.renderers.forget_pane(self.name)

    def cancel(self) -> None:
        self.linked.mouse.grab = None

    def begin_anew(self) -> None:
        """Reset the mouse and the mark: the step's mark belongs to the size of its final layout."""
        shared = self.linked
        shared.mouse, shared.anchor = MouseState(), None
        shared.steady_frames = 0

    def flown(self, host: Host) -> Camera | None:
        return host.state.camera

    def with_flown(self, state: AppState, camera: Camera) -> AppState:
        return state.with_camera(camera)

    def object_under(self, host: Host) -> int | None:
        if host.hovered is None or host.hovered[0] != self.name:
            return None
        return host.renderers.object_at(host.state, host.hovered[1])

    def _pane(
        self,
        host: Host,
        picture: Drawn,
        values: Values | None,
        error: Exception | None,
        note: str = "",
        progress: float = 1.0,
        legend: bool = True,
    ) -> None:
        """Draw an image into the rest of the window.

        values: of its channel's pixels; None if it shows no channel, and then has no legend
        either.
        """
        both, shared = host.renderers, self.linked
        self._strip(host)
        room_px, options = available_px(), host.state.images
        both.fit_pane(self.name, room_px, options, ruler_sizes(options))
        room_px = both.common_room(room_px)

        def placed(state: AppState) -> Placement:
            return both.placed(state.images, room_px)

        self._keep_mark(host)
        corner = imgui.get_cursor_screen_pos()
        self._before_image(host, Screen.here(placed(host.state)))
        imgui.set_cursor_screen_pos(corner)
        dark = (
            self._why_black(host, Screen.here(placed(host.state))) if not (error or note) else None
        )
        imgui.set_cursor_screen_pos(corner)
        state = host.state
        clicks: list[tuple[Pixel, bool]] = []
        seen = Seen(
            name=self.name,
            shown=both.camera(state),
            size=both.size,
            center=host.focus.center,
            reach=host.focus.reach,
            depth_at=lambda pixel: both.depth_at(state, pixel),
            click=partial(self._for_guest, host, clicks),
        )
        pane = Pane(
            seen=seen,
            picture=picture,
            values=values,
            fonts=host.fonts,
            note=describe(error) if error else note,
            is_error=error is not None,
            dark=dark,
            progress=progress,
            legend=legend,
            has_tools=host.has_tools,
            hovered=self._hovered(host, placed(state)),
            depths=both.depths() if state.images.channel == "depth" else None,
            on_pixels=lambda screen: self._on_pixels(host, screen),
            held=shared.guest is not None and shared.guest.holds(self.name),
        )
        result = image_pane(pane, state, placed, shared.mouse)
        if result.hovered is not None:
            host.hover(self.name, result.hovered)
        host.apply(result.state, self._gesture(result.turned) if result.turned else None)
        if result.keyed:
            self._walk(host, placed(host.state))
        imgui.set_cursor_screen_pos(corner)
        screen = Screen.here(placed(host.state))
        self._over_image(host, screen)
        if shared.guest is not None:
            over = pane.held or result.hovered is not None
            self._with_guest(host, shared.guest, screen, clicks, over)

    def _for_guest(
        self, host: Host, clicks: list[tuple[Pixel, bool]], pixel: Pixel, double: bool
    ) -> bool:
        """Keep a click until the image is drawn, if it is for the guest."""
        guest = self.linked.guest
        if guest is None or not guest.wants(host, double):
            return False
        clicks.append((pixel, double))
        return True

    def _with_guest(
        self,
        host: Host,
        guest: Guest,
        screen: Screen,
        clicks: list[tuple[Pixel, bool]],
        over: bool,
    ) -> None:
        """Draw the guest over the image, and hand it the clicks that it wants."""
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
        """Draw items that take the mouse before the image does."""

    def _on_pixels(self, host: Host, screen: Screen) -> None:
        """Draw on the image, below the grid, the marks and the legends."""

    def _over_image(self, host: Host, screen: Screen) -> None:
        """Draw over the image."""

    def _why_black(self, host: Host, screen: Screen) -> DarkNote | None:
        """Draw the note on a black image, with its button if there is one that helps."""
        both, state = host.renderers, host.state
        reason, verdict = both.why_black(state), both.verdict(state)
        if reason is None or verdict is None:
            return None
        guest = self.linked.guest
        offered = guest.remedy(state, reason.cause) if guest is not None else ""
        note = DarkNote(reason.text, offered or remedy_for(reason))
        if note_button(note, screen):
            try:
                if guest is not None and offered:
                    host.change(guest.remedied(state, offered))
                else:
                    host.travel(helped(state, reason, verdict.darkness, host.focus))
            except LucidaError as problem:
                host.files.message = str(problem)
        return note

    def _strip(self, host: Host) -> None:
        if host.has_tools and not host.state.preferences.presentation:
            image_strip(self.name, host, self.linked.photograph.file_size)

    def _hovered(self, host: Host, placement: Placement) -> tuple[int, int] | None:
        """Return the pixel to frame: always in the other image, in this one only if it is small."""
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
        shared.steady_frames = shared.steady_frames + 1 if size == shared.size else 0
        shared.size = size
        marked_size = state.options.marked_size
        if marked_size is None and shared.anchor is None and shared.steady_frames < STEADY:
            return  # a step's mark belongs to the size that comes when the layout is done
        marked, shared.anchor = followed(state.marked, marked_size, shared.anchor, state.view, size)
        now_size = size if marked is not None else None
        if (marked, now_size) != (state.marked, marked_size):
            host.amend(
                state.with_options(replace(state.options, marked=marked, marked_size=now_size))
            )

    def _walk(self, host: Host, placement: Placement) -> None:
        """Move the mark by the arrow keys, and keep it in sight."""
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
