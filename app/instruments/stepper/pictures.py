"""The lecture's pictures of the loops: programs that run, with the images that they fill."""

from __future__ import annotations

import math
from collections.abc import Callable

import moderngl
from imgui_bundle import ImVec2, imgui

from lucida.app.instruments.outside.extent import end_parameter
from lucida.app.instruments.outside.view import OutsideView
from lucida.app.instruments.stepper.drawing import Drawn, draw_program, written
from lucida.app.instruments.stepper.loop_parts import Model
from lucida.app.instruments.stepper.outside_items import traced_items
from lucida.app.instruments.stepper.programs import (
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
from lucida.app.instruments.stepper.questions import draw_questions
from lucida.app.instruments.stepper.runs import Prepared
from lucida.app.state.options.shared import Pixel
from lucida.app.ui import theme
from lucida.app.ui.canvas import Marks, color_picture
from lucida.app.ui.host import Host
from lucida.app.ui.uploads import Uploads
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.checks import Floats
from lucida.renderer.camera.image_plane import Size
from lucida.renderer.system.errors import describe
from lucida.renderer.system.memo import Memo

TEXT = 0.12  # of the height, above the two loops: for a text that lies over it


class LoopPictures:
    """wake: called from a thread when the hits are found."""

    def __init__(self, context: moderngl.Context, wake: Callable[[], None]) -> None:
        self._uploads = Uploads(context)
        self._hits = Prepared("lucida-loops", _hits, wake)
        self._runs = Memo(_runs)
        self._moment = Memo(_moment, 4)
        self._put = {name: Memo(_put) for name in ("first", "second")}

    @property
    def busy(self) -> bool:
        return self._hits.busy

    def release(self) -> None:
        self._hits.close()
        self._uploads.release()

    def draw(self, host: Host, outside: OutsideView, source: str) -> None:
        """Draw the picture into the rest of the window, and its ray in the outside view."""
        self._uploads.begin_frame()
        state, options = host.state, host.state.options.stepper
        made = self._hits.of(state.scene, state.view.for_size(options.canvas), options.canvas)
        low, room = imgui.get_cursor_screen_pos(), imgui.get_content_region_avail()
        if options.picture == "loops":
            low.y, room.y = low.y + TEXT * room.y, (1 - TEXT) * room.y
        if self._hits.error is not None:
            imgui.text_colored(theme.ERROR, describe(self._hits.error))
            return
        if made is None:
            host.animate()
            return
        camera, hits = made.camera, made.value
        runs = self._runs(hits, options.picture, camera)
        first = state.marked or (options.canvas[1] // 2, options.canvas[0] // 2)
        moments = [
            self._moment(run, part, first if options.picture == "rays" else None)
            for run, part in zip(runs, options.parts[-len(runs) :], strict=True)
        ]
        if options.picture == "questions":
            texture = self._texture("first", runs[0].at(1).canvas, host)
            draw_questions(low, room, texture, options.canvas, options.parts[0])
            return
        for run, moment, name, (corner, size) in zip(
            runs, moments, self._put, _places(low, room, len(runs)), strict=False
        ):
            lines, lit = tuple(line.text for line in run.lines), moment.lit
            if options.picture == "program":
                lines, lit = written(lines, lit, state)
            texture, base = self._texture(name, moment.canvas, host), state.options.indexing.value
            marks, canvas = Marks(moment.pixel), options.canvas
            in_words = options.picture != "program"
            drawn = Drawn(lines, lit, texture, canvas, marks, base, in_words)
            draw_program(drawn, corner, size, host.fonts)
        if options.picture == "rays" and camera == host.renderers.camera(state):
            part, end = options.parts[1], end_parameter(camera, host.focus.framed)
            items = traced_items(hits, camera, moments[0].pixel, part, end)
            outside.show(source, items, picture=self._uploads.get("first"))
        else:
            outside.show(source)

    def _texture(self, name: str, canvas: Floats, host: Host) -> int:
        exposure_ev = host.state.images.exposure_ev
        self._put[name](self._uploads, name, canvas, exposure_ev, theme.used())
        texture = self._uploads.get(name)
        assert texture is not None
        return texture.glo


def _places(low: ImVec2, room: ImVec2, count: int) -> list[tuple[ImVec2, ImVec2]]:
    """Return the places of programs: side by side, or one above the other in an upright room."""
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


def _put(
    uploads: Uploads, name: str, canvas: Floats, exposure_ev: float, look: theme.WindowLook
) -> None:
    uploads.put(name, color_picture(canvas, exposure_ev))


def _hits(model: Model, camera: Camera, size: Size, is_wanted: Callable[[], bool]) -> Hits:
    return hits_of(model, camera, size)
