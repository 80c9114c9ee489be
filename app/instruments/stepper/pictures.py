"""The lecture's pictures of the loops: programs that run, with the images that they fill."""

from __future__ import annotations

import math
from collections.abc import Callable

from imgui_bundle import ImVec2, imgui

from lucida.app.instruments.outside.extent import end_parameter
from lucida.app.instruments.outside.view import OutsideView
from lucida.app.state.options.shared import Pixel
from lucida.app.ui.canvas import Marks
from lucida.app.ui.host import Host
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.system.memo import Memo

from .drawing import Canvases, Drawn, draw_program, written
from .loop_parts import Model
from .outside_items import traced_items
from .programs import (
    IMAGE_ORDER,
    OBJECT_ORDER,
    RAY_TRACING,
    Hits,
    LoopMoment,
    LoopRun,
    hits_of,
    run_part,
    whole_program,
)
from .questions import draw_questions
from .runs import Prepared

TEXT = 0.12  # share of the height above the two loops: space for an overlaid text


class LoopPictures:
    """The pictures of one view.

    hits: the current scene's hits, found on a thread. wake: called from it when they are found.
    """

    def __init__(self, canvases: Canvases, wake: Callable[[], None]) -> None:
        self._canvases = canvases
        self.hits = Prepared("lucida-loops", _hits, wake)
        self._runs = Memo(_runs)
        self._moment = Memo(_moment, 4)

    def draw(self, host: Host, outside: OutsideView, source: str) -> None:
        """Draw the picture into the rest of the window, and its ray in the outside view."""
        state, options = host.state, host.state.options.stepper
        low, room = imgui.get_cursor_screen_pos(), imgui.get_content_region_avail()
        if options.picture == "loops":
            low.y, room.y = low.y + TEXT * room.y, (1 - TEXT) * room.y
        if (made := self.hits.current(host)) is None:
            return
        runs = self._runs(made.value, options.picture, made.camera)
        in_words, exposure_ev = options.picture != "program", state.images.exposure_ev
        first = state.marked or (options.canvas[1] // 2, options.canvas[0] // 2)
        if options.picture == "questions":
            canvas = runs[0].at(1).canvas
            texture = self._canvases.texture("run 0", canvas, exposure_ev)
            draw_questions(low, room, texture.glo, options.canvas, options.parts[0])
            return
        for number, (run, (corner, size)) in enumerate(
            zip(runs, _places(low, room, len(runs)), strict=True)
        ):
            part = options.parts[number - len(runs)]
            moment = self._moment(run, part, first if options.picture == "rays" else None)
            lines, lit = tuple(line.text for line in run.lines), moment.lit
            if not in_words:
                lines, lit = written(lines, lit, state)
            texture = self._canvases.texture(f"run {number}", moment.canvas, exposure_ev)
            marks, base = Marks(moment.pixel), state.options.indexing.value
            drawn = Drawn(lines, lit, texture.glo, options.canvas, marks, base, in_words)
            draw_program(drawn, corner, size, host.fonts)
        if options.picture == "rays" and made.camera == host.renderers.camera(state):
            end = end_parameter(made.camera, host.focus.framed)
            items = traced_items(made.value, made.camera, moment.pixel, options.parts[1], end)
            outside.show(source, items, picture=self._canvases.get("run 0"))
        else:
            outside.show(source)


def _places(low: ImVec2, room: ImVec2, count: int) -> list[tuple[ImVec2, ImVec2]]:
    """Return the places of programs: side by side, or one above the other in a tall area."""
    gap = imgui.get_font_size()
    across = ImVec2(1, 0) if room.x > room.y else ImVec2(0, 1)
    long = (max(room.x, room.y) - gap * (count - 1)) / count
    each = ImVec2(long, room.y) if across.x else ImVec2(room.x, long)
    return [(low + across * (long + gap) * k, each) for k in range(count)]


def _runs(hits: Hits, picture: str, camera: Camera) -> tuple[LoopRun, ...]:
    if picture == "loops":
        return LoopRun(hits, OBJECT_ORDER, by_object=True), LoopRun(hits, IMAGE_ORDER)
    return (LoopRun(hits, whole_program(camera) if picture == "program" else RAY_TRACING),)


def _moment(run: LoopRun, part: float, first: Pixel | None) -> LoopMoment:
    """Return the moment of an option. first: the pixel whose ray is traced first, slowly."""
    if first is None:
        return run.at(run_part(part))
    moment = run.at(max(0.0, part - 3))
    if part > 2:
        moment.canvas[first] = run.at(1).canvas[first]
    if part > 3:
        return moment
    line = min(math.ceil(part), len(RAY_TRACING) - 1)
    return LoopMoment(moment.canvas, first if part > 0 else None, {line: 1.0} if part > 0 else {})


def _hits(model: Model, camera: Camera, size: Size, is_wanted: Callable[[], bool]) -> Hits:
    return hits_of(model, camera, size)
