"""A run of a teaching renderer, recorded line by line, so that any step of it can be shown again.

The log holds only changes: lines, variables, writes. model.py assembles a moment from it on demand.

One thread runs; others read what is there so far.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from enum import Enum
from types import FrameType
from typing import Any

from lucida.app.instruments.stepper.loop_parts import Model
from lucida.app.instruments.stepper.loops import image_order, rasterization
from lucida.app.instruments.stepper.source import Source, source_of
from lucida.app.state.bounds import check, whole_range_of
from lucida.app.state.options.stepper import StepperOptions
from lucida.app.ui.explaining.columns import Column
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size

MOST_STEPS = whole_range_of(StepperOptions, "steps")[1]
# The interpreter is left to other threads for a moment, this often.
_BREAK_EVERY, BREAK_AFTER_S, _BREAK_S = 8, 0.001, 0.0003
_MISSING = object()


class Order(Enum):
    """The algorithm."""

    RASTER = "rasterization"
    IMAGE = "image order"

    @property
    def renderer(self) -> Callable[..., Any]:
        return _RENDERERS[self]


_RENDERERS = {
    Order.RASTER: rasterization,
    Order.IMAGE: image_order,
}


class RunCancelledError(Exception):
    """Raised to end a run that is no longer wanted, or too long."""


class Recording:
    """A run of one algorithm on a small canvas. Nothing happens before run().

    A step is a line about to be run; the last one is the function's return.
    size: (width, height). Raises LucidaError if it is out of the canvas's bounds.
    """

    def __init__(self, model: Model, camera: Camera, size: Size, order: Order) -> None:
        check(StepperOptions, {"canvas": size})
        self.model, self.camera, self.size, self.order = model, camera, size, order
        self.source: Source = source_of(order.renderer)
        self.complete = False  # run to its end
        self.truncated = False  # stopped after MOST_STEPS
        self._steps = 0
        # Of each step its line. Of each variable, from which step on it has which value.
        self.lines = Column("u1")
        self.values: dict[str, tuple[Column, list[Any]]] = {}
        # Steps at which the bodies of the two loops begin.
        self.pixel_steps, self.object_steps = Column("i4"), Column("i4")
        # Writes to the canvas and to the depth buffer: step, row and column, colour or t.
        self.write_steps, self.write_pixels = Column("i4"), Column("i4", 2)
        self.write_colors = Column("f8", 3)
        self.depth_steps, self.depth_pixels = Column("i4"), Column("i4", 2)
        self.depth_t = Column("f8")

    def __len__(self) -> int:
        """Return the number of steps so far."""
        return self._steps

    def run(self, is_wanted: Callable[[], bool] = lambda: True) -> None:
        """Run to the end, to MOST_STEPS, or until it is no longer wanted."""
        self._is_wanted = is_wanted
        recorder = _Recorder(self)
        before = sys.gettrace()
        sys.settrace(recorder.enter)
        try:
            self.order.renderer(self.model, self.camera, self.size)
            self.complete = True
        except RunCancelledError:
            self.truncated = self._steps >= MOST_STEPS
        finally:
            sys.settrace(before)


class _Recorder:
    """The trace functions: see sys.settrace."""

    def __init__(self, recording: Recording) -> None:
        self._to = recording
        self._code = recording.order.renderer.__code__
        self._shown = recording.source.shown
        self._last: dict[str, Any] = dict.fromkeys(self._code.co_varnames, _MISSING)
        self._failed = False
        self._break_s = time.perf_counter()

    def enter(self, frame: FrameType, event: str, argument: Any) -> Any:
        """Trace a function's lines if it is the renderer's; ignore other functions."""
        return self._line if frame.f_code is self._code else None

    def _line(self, frame: FrameType, event: str, argument: Any) -> Any:
        if event == "exception":
            self._failed = True
        if self._failed:  # unwinding is not a step
            return self._line
        to, step = self._to, self._to._steps
        if step >= MOST_STEPS or not (step % _BREAK_EVERY or to._is_wanted()):
            raise RunCancelledError
        line = self._shown[frame.f_lineno - to.source.first_line]
        values = frame.f_locals
        self._log_values(values, step)
        self._log_writes(values, step)
        if line == to.source.pixels.first:
            to.pixel_steps.append(step)
        if line == to.source.objects.first:
            to.object_steps.append(step)
        to.lines.append(line)
        to._steps = step + 1
        if step % _BREAK_EVERY == 0:
            self._take_a_break()
        return self._line

    def _log_values(self, values: dict[str, Any], step: int) -> None:
        last = self._last
        for name, value in values.items():
            if value is not last[name]:
                last[name] = value
                log = self._to.values.get(name)
                if log is None:
                    # A new dictionary, because another thread may be iterating over the old one.
                    log = (Column("i4"), [])
                    self._to.values = {**self._to.values, name: log}
                log[1].append(value)
                log[0].append(step)

    def _log_writes(self, values: dict[str, Any], step: int) -> None:
        to = self._to
        canvas, depth = values.get("canvas"), values.get("depth")
        if canvas is not None:
            while len(to.write_steps) < len(canvas.log):
                i, j, color = canvas.log[len(to.write_steps)]
                to.write_pixels.append((i, j))
                to.write_colors.append(color)
                to.write_steps.append(step)
        if depth is not None:
            while len(to.depth_steps) < len(depth.log):
                i, j, t = depth.log[len(to.depth_steps)]
                to.depth_pixels.append((i, j))
                to.depth_t.append(t)
                to.depth_steps.append(step)

    def _take_a_break(self) -> None:
        if time.perf_counter() - self._break_s > BREAK_AFTER_S:
            time.sleep(_BREAK_S)
            self._break_s = time.perf_counter()
