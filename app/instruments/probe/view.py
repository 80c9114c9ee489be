"""The pixel probe: the numbers of the marked pixel's viewing ray, live while the camera moves.

The view keeps the readings, and makes the lines in the outside view.
probe/panel.py draws a reading; probe/model.py computes it.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import moderngl
import numpy as np
from imgui_bundle import imgui

from lucida.app.images.request import MIRROR_DEPTH
from lucida.app.instruments.outside.diagram import Arrow, Dot, Item, Segments
from lucida.app.instruments.outside.extent import end_parameter
from lucida.app.instruments.outside.growing import stage_at
from lucida.app.instruments.outside.view import OutsideView
from lucida.app.state.app_state import AppState
from lucida.app.state.options.shared import Pixel
from lucida.app.ui import formula, theme
from lucida.app.ui.background import Background
from lucida.app.ui.host import Host
from lucida.app.ui.instrument import Instrument, view_of
from lucida.app.ui.messages import wrapped
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size, has_pixel
from lucida.renderer.system.errors import describe
from lucida.renderer.system.memo import Memo

from . import panel
from .actions import PINNING
from .model import Probe
from .reading import Reading

PROBE = "Probe"
NORMAL = 0.12  # length of a normal's arrow, relative to the scene's reach
HINT = (
    "Point at a pixel in an image or on the image plane. Click to mark it; the arrow keys move it."
)


class ProbeView(Instrument):
    name = PROBE
    title = "Probe"
    actions = PINNING

    def __init__(self, views: Sequence[Instrument]) -> None:
        self._outside = view_of(views, OutsideView)
        self._making: Background[Probe] | None = None
        self._probe: Probe | None = None
        self._wanted: Any = None  # the scene that is prepared, or being prepared
        self._error = ""
        self._seen = False
        self.reading: Reading | None = None  # the visible one
        self._readings = Memo(Probe.at)
        self._items = Memo(_outside_items)

    @property
    def settled(self) -> bool:
        return not self._seen or self._making is None or not self._making.busy

    def begin(self, host: Host, context: moderngl.Context) -> None:
        self._making = Background("lucida-probe", host.animate)

    def end(self) -> None:
        if self._making is not None:
            self._making.close()
        formula.release()

    def unseen(self, host: Host) -> None:
        self._seen = False
        self._outside.show(PROBE, ())

    def draw(self, host: Host) -> None:
        state, size = host.state, host.renderers.size
        self._seen = True
        if min(size) < 1:
            return
        self._prepare(state)
        pixel = self._pixel(host, size)
        reading = self._reading(host.state, pixel, host.renderers.camera(host.state), size)
        self.reading = reading
        host.apply(panel.toolbar(host.state, pixel, reading, host.files.say))
        pins = self._pins(host, size)
        if pins:
            host.apply(panel.pin_row(host.state, pins, pixel))
        shown = None
        if reading is not None and not reading.is_outside:
            shown = reading.bytes, reading.display
        panel.color_row(shown, host.fonts)
        imgui.separator()
        # Formulas have the same rows with and without the scrollbar.
        wide = imgui.get_content_region_avail().x - imgui.get_style().scrollbar_size
        imgui.set_next_window_content_size((max(1.0, wide), 0.0))
        imgui.begin_child("reading", (0, 0), imgui.ChildFlags_.nav_flattened)
        if self._error:
            wrapped(self._error, theme.ERROR)
        elif pixel is None:
            wrapped(HINT, theme.DIM)
        elif reading is None:
            wrapped("preparing the scene for the probe ...", theme.DIM)
        else:
            options, position = host.state.options, host.state.options.outside.formula
            stage = stage_at(position, host.renderers.camera(host.state))
            panel.reading_panel(reading, options.indexing, host.fonts, stage)
        imgui.end_child()
        self._show_outside(host, reading, size)

    # The readings.

    def _prepare(self, state: AppState) -> None:
        """Build the scene's index in the background, once per scene."""
        assert self._making is not None
        outcome = self._making.poll()
        if outcome is not None:
            if outcome.value is not None and outcome.value.scene is self._wanted:
                self._probe, self._error = outcome.value, ""
            elif outcome.error is not None:
                self._error = describe(outcome.error)
        self._wanted = state.scene
        self._making.ask(Probe, state.scene)

    def _pixel(self, host: Host, size: Size) -> Pixel | None:
        """Return the marked pixel, or else the one under the mouse."""
        pixel = host.state.marked
        if pixel is None and host.hovered is not None:
            pixel = host.hovered[1]
        return pixel if pixel is not None and has_pixel(size, pixel) else None

    def _reading(
        self, state: AppState, pixel: Pixel | None, camera: Camera, size: Size
    ) -> Reading | None:
        """Return the pixel's reading, recomputed if its inputs have changed; None outside the
        image.
        """
        probe = self._probe
        if pixel is None or probe is None or probe.scene is not state.scene:
            return None
        if not has_pixel(size, pixel):
            return None
        images, options = state.images, state.options
        depth = MIRROR_DEPTH if options.mirrors else 0
        self._readings.most = 1 + len(options.probe.pins)
        return self._readings(
            probe, pixel, camera, size, images.exposure_ev, images.transfer, options.shadows, depth
        )

    def _pins(self, host: Host, size: Size) -> list[panel.Pin]:
        state, camera = host.state, host.renderers.camera(host.state)
        pins = []
        for pixel in state.options.probe.pins:
            reading = self._reading(state, pixel, camera, size)
            pins.append(panel.Pin(pixel, reading.bytes if reading is not None else None))
        return pins

    # In the outside view.

    def _show_outside(self, host: Host, reading: Reading | None, size: Size) -> None:
        state, camera = host.state, host.renderers.camera(host.state)
        pins = [self._reading(state, pin, camera, size) for pin in state.options.probe.pins]
        pinned = tuple(pin for pin in pins if pin is not None)
        end, length = end_parameter(camera, host.focus.framed), NORMAL * host.focus.reach
        self._outside.show(PROBE, self._items(reading, pinned, end, length))


def _outside_items(
    reading: Reading | None,
    pinned: tuple[Reading, ...],
    end: float,
    normal: float,
) -> tuple[Item, ...]:
    """Return the lines of a reading and of the pins.

    end: ray parameter at which a ray that hits nothing ends. normal: length of the arrow.
    """
    items: list[Item] = []
    for pin in pinned:
        t = pin.hit.t if pin.hit is not None else end
        items.append(_ray(pin, t))
        if pin.hit is not None:
            items.append(Dot("pinned hit", "mark", np.array(pin.hit.point), 3.5))
    if reading is not None and reading.hit is not None:
        items += _normal(reading, normal)
    return tuple(items)


def _ray(pin: Reading, t: float) -> Segments:
    """Return the viewing ray of a pin as far as t."""
    origin = np.array(pin.origin)
    segment = np.array([[origin, origin + t * np.array(pin.direction)]])
    return Segments("pin", "ray", segment, 1.2, 0.9, hidden=0.2, dashed=True, layer=2)


def _normal(reading: Reading, length: float) -> Sequence[Item]:
    assert reading.hit is not None
    point = np.array(reading.hit.point)
    tip = point + length * np.array(reading.hit.normal)
    return [Arrow("normal", "extra", point, tip, width=2.2, head=10.0)]
