"""The live widget: the browser requests images, and the kernel sends them.

The browser sends the user's actions since its last request, and has at most two requests open.
Therefore nothing queues up while a cell runs or an image takes long. The browser repeats its
request if the image is not ready soon, so that no request keeps the kernel from running cells. Only
the tracer has threads.
"""

from __future__ import annotations

import io
import time
from collections.abc import Iterable
from dataclasses import asdict
from pathlib import Path
from typing import Any

import anywidget
import traitlets
from PIL import Image

from lucida.renderer.camera import navigation
from lucida.renderer.camera.camera import Camera, check_camera
from lucida.renderer.camera.checks import Vector
from lucida.renderer.camera.image_plane import Size, has_pixel
from lucida.renderer.camera.pixels import Pixel
from lucida.renderer.compare.pixel_report import as_rows, picked
from lucida.renderer.files import load_scene
from lucida.renderer.files.views import view_from_table, view_table
from lucida.renderer.images import picture
from lucida.renderer.images.coarseness import Coarseness, reduced
from lucida.renderer.images.frame import CHANNELS, Frame, check_size
from lucida.renderer.images.png import write_png
from lucida.renderer.scene import Scene
from lucida.renderer.scene.focus import scene_focus
from lucida.renderer.scene.model import View
from lucida.renderer.system import compile_note
from lucida.renderer.system.errors import LucidaError
from lucida.renderer.system.memo import Memo
from lucida.renderer.trace import TraceJob, Tracer

from .sliders import sliders_of, target_of, with_number

MOVING_S = 0.03  # for an image in motion: 15 a second, including the transfer to the browser
PATIENCE_S = 0.25  # after this time, the browser is asked to try again
PUSH_S = 0.04  # between images that a running cell sends
QUALITY = 90  # of a JPEG in motion; the image at rest is a PNG


def _new_tracer(scene: Scene, shadows: bool, mirror_depth: int) -> Tracer:
    return Tracer(scene, shadows=shadows, mirror_depth=mirror_depth)


_tracer: Memo[Scene, bool, int, Tracer] = Memo(_new_tracer, most=4)  # shared by all widgets


def _to_json(camera: Camera, _widget: object) -> dict[str, Any]:
    table = view_table(View(camera))
    del table["fit"]
    return table


def _camera_from_json(table: dict[str, Any], widget: Explorer) -> Camera:
    """Return the camera that a browser sent; the present one, with a message, if it is invalid."""
    try:
        return view_from_table({**table, "fit": False}).camera
    except LucidaError as error:
        widget.tell(str(error))
        return widget.camera


def _pixel_from_json(place: list[int] | None, widget: Explorer) -> Pixel | None:
    """Return the pixel that a browser sent; the marked one, with a message, if it is invalid."""
    try:
        return check_pixel(place, widget.size)
    except LucidaError as error:
        widget.tell(str(error))
        return widget.pixel


def check_pixel(place: Any, size: Size) -> Pixel | None:
    """Return (row, column), or None. Raises LucidaError for anything else."""
    if place is None:
        return None
    width, height = size
    try:
        row, column = (int(number) for number in place)
    except (TypeError, ValueError):
        problem = f"{place!r} is not a row and a column"
        raise LucidaError("pixel", problem, "give e.g. (240, 320)") from None
    if not has_pixel(size, (row, column)):
        problem = f"{(row, column)} is outside an image of {width}x{height}"
        raise LucidaError("pixel", problem, f"give (0, 0) to {(height - 1, width - 1)}")
    return row, column


class Explorer(anywidget.AnyWidget):
    """The widget that explore() returns.

    camera: a traitlet; set it, observe it, or read it. pixel: a traitlet, the marked pixel (row,
    column) from 0, or None. Both raise LucidaError for invalid values.
    """

    _esm = Path(__file__).parent / "explore.js"
    _css = Path(__file__).parent / "explore.css"
    camera = traitlets.TraitType[Any, Any]().tag(
        sync=True, to_json=_to_json, from_json=_camera_from_json
    )
    pixel = traitlets.Any(None).tag(sync=True, from_json=_pixel_from_json)
    _size = traitlets.Any().tag(sync=True)

    def __init__(
        self,
        scene: Scene | str | Path,
        camera: Camera | None,
        size: Iterable[int],
        shadows: bool,
        mirror_depth: int,
    ) -> None:
        self.scene = scene if isinstance(scene, Scene) else load_scene(scene)
        self.size = check_size(size)
        self._focus = scene_focus(self.scene)
        self._first = (
            self.scene.view.for_size(self.size) if camera is None else check_camera(camera)
        )
        self._target: Vector = self._focus.center
        self._effects = shadows, mirror_depth
        self._coarseness = Coarseness(MOVING_S, unknown=2)
        self._job: TraceJob | None = None
        self._job_of: tuple[Camera, int] | None = None  # and its coarseness
        self._latest: Frame | None = None
        self._latest_of: tuple[Camera, int] | None = None
        self._drag, self._parameter = 0.0, 1.0
        self._answering = self._is_shown = False
        self._pushed_s = 0.0
        super().__init__(camera=self._first, _size=self.size)
        self._start(self.camera, 1)
        self.on_msg(self._answer)

    def __repr__(self) -> str:
        return f"Explorer({self.scene!r}, {self.camera!r})"

    @property
    def frame(self) -> Frame:
        """The full frame of the present camera, with all channels, traced now if necessary."""
        self._trace(1, None)
        assert self._latest is not None
        return self._latest

    @property
    def hit(self) -> dict[str, Any] | None:
        """Return the marked pixel's object, t, point, normal, color and ray; None without one."""
        if self.pixel is None:
            return None
        return picked(self.scene, self.camera, self.frame, self.pixel)

    def tell(self, problem: str) -> None:
        """Show a problem in the browser."""
        self.send({"problem": problem, **self._numbers()})

    @traitlets.validate("camera")
    def _check_camera(self, proposal: Any) -> Camera:
        return check_camera(proposal.value)

    @traitlets.validate("pixel")
    def _check_pixel(self, proposal: Any) -> Pixel | None:
        return check_pixel(proposal.value, self.size)

    @traitlets.observe("camera", "pixel")
    def _push(self, _change: Any) -> None:
        """Send an image without a request, because a cell has changed the camera."""
        now = time.monotonic()
        if self._answering or not self._is_shown or now - self._pushed_s < PUSH_S:
            return  # the browser will request it, at the latest when the cell ends
        self._pushed_s = now
        self._send_image(True, {})

    # The browser's requests.

    def _answer(self, _widget: object, question: dict[str, Any], _buffers: object) -> None:
        """Apply the user's actions. Send the image, or report that it is not ready yet.

        question: "ask", a number to send back; "moves", see _move(); "moving", True if a coarse
        image will do.
        """
        self._answering = self._is_shown = True
        answer = {"answer": question["ask"]}
        try:
            for move in question["moves"]:
                try:
                    self._move(move)
                except (LucidaError, OverflowError) as error:
                    answer["problem"] = str(error)
            self._send_image(question["moving"], answer)
        except BaseException as error:  # even an interrupt, because the browser waits for an answer
            self.send({**answer, "problem": str(error) or repr(error)})
            if not isinstance(error, LucidaError):
                raise
        finally:
            self._answering = False

    def _move(self, move: dict[str, Any]) -> None:
        """Move the camera, or mark a pixel. Places are (row, column), which may be fractional."""
        camera, kind = self.camera, move["do"]
        self._target = target_of(camera, self._focus, self._target)
        if kind == "orbit":
            camera = navigation.orbited(camera, self._target, move["right"], move["up"])
        elif kind == "pan":
            if move["drag"] != self._drag:  # the dragged point keeps its depth
                self._drag, self._parameter = move["drag"], self._parameter_at(move["start"])
            start, end = (self._image_point(move[name]) for name in ("start", "end"))
            camera = navigation.panned(camera, start, end, self._parameter)
        elif kind == "zoom":
            at, parameter = self._image_point(move["at"]), self._parameter_at(move["at"])
            ray = camera.ray(*move["at"], self.size)
            x, y, z = (ray.origin + parameter * ray.direction).tolist()
            scope = self._focus.center, self._focus.reach
            found = navigation.zoomed_by_wheel(
                camera, at, move["steps"], parameter, (x, y, z), scope
            )
            camera = found or camera
        elif kind == "set":
            camera = with_number(camera, move["name"], float(move["value"]), self._target)
        elif kind == "project":
            camera = navigation.switched_projection(camera, self._target)
        elif kind == "reset":
            camera, self._target = self._first, self._focus.center
        else:
            self.pixel = move["at"]
        self.camera = camera

    def _image_point(self, place: list[float]) -> tuple[float, float]:
        x, y = self.camera.image_point(*place, self.size)
        return float(x), float(y)

    def _parameter_at(self, place: list[float]) -> float:
        """Return the ray parameter of the hit there; of the scene's middle if nothing is hit."""
        if self._latest is not None:
            height, width = self._latest.channel("depth").shape
            row, column = (
                min(max(int((at + 0.5) / count * have), 0), have - 1)
                for at, count, have in zip(place, self.size[::-1], (height, width), strict=True)
            )
            parameter = float(self._latest.channel("depth")[row, column])
            if parameter < float("inf"):
                return parameter
        direction = self.camera.ray(*place, self.size).direction
        return navigation.aim(self.camera, direction, self._focus.center, self._focus.reach)

    # Images.

    def _send_image(self, moving: bool, answer: dict[str, Any]) -> None:
        """Send the image of the present camera, or report that it is not ready yet."""
        width, height = self.size
        begun_s = time.monotonic()
        factor = self._coarseness.changed(width * height, begun_s) if moving else 1
        if not self._trace(factor, PATIENCE_S):
            assert self._job is not None
            note = compile_note.note() if self._latest is None else ""
            note = note or f"tracing: {self._job.progress:.0%}"
            self.send({**answer, **self._numbers(), "pending": note})
            return
        assert self._latest is not None and self._latest_of is not None
        factor = self._latest_of[1]
        pixels = picture(self._latest)
        file = io.BytesIO()
        if moving:
            Image.fromarray(pixels).save(file, "JPEG", quality=QUALITY)
        else:
            write_png(file, pixels)
        height, width = pixels.shape[:2]
        spent_s = time.monotonic() - begun_s
        if moving:
            self._coarseness.measured(factor, width * height, spent_s)
        kind = "image/jpeg" if moving else "image/png"
        answer |= self._numbers() | {"type": kind, "factor": factor, "full": not moving}
        if factor == 1 and self.pixel is not None:
            answer["hit"] = as_rows(self.hit or {})
        self.send(answer, [file.getvalue()])

    def _trace(self, factor: int, patience_s: float | None) -> bool:
        """Trace the present camera's image, `factor` times coarser. Return False if that takes
        longer than patience_s seconds; the next call then continues to wait.
        """
        wanted = (self.camera, factor)
        if self._latest_of in (wanted, (self.camera, 1)):
            return True
        if self._job is None or self._job_of not in (wanted, (self.camera, 1)):
            self._start(*wanted)
        assert self._job is not None
        if not self._job.wait(patience_s):
            return False
        job, self._job = self._job, None
        self._latest, self._latest_of = job.result(), self._job_of
        return True

    def _start(self, camera: Camera, factor: int) -> None:
        if self._job is not None:
            self._job.cancel()
        channels = CHANNELS if factor == 1 else ("color", "depth")
        tracer = _tracer(self.scene, *self._effects)
        self._job = tracer.start(camera, reduced(self.size, factor), channels)
        self._job_of = (camera, factor)

    def _numbers(self) -> dict[str, Any]:
        """Return the numbers that the browser shows next to the image."""
        self._target = target_of(self.camera, self._focus, self._target)
        sliders = sliders_of(self.camera, self._target, self._focus)
        numbers = {"sliders": [asdict(slider) for slider in sliders]}
        return numbers | {"projection": self.camera.projection, "pixel": self.pixel}
