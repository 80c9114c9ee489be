"""A run of a teaching renderer, recorded line by line, so that any step of it can be shown again.

The recording holds only changes: lines, variables, writes. model.py assembles a moment from it.
"""

from __future__ import annotations

import sys
import time
from array import array
from collections import defaultdict
from collections.abc import Callable
from types import FrameType
from typing import Any

from lucida.app.state.bounds import check, whole_range_of
from lucida.app.state.options.stepper import StepperOptions
from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size

from .loop_parts import Model
from .source import source_of

MOST_STEPS = whole_range_of(StepperOptions, "steps")[1]
# The recorder checks is_wanted at this interval, and sleeps, so that the window gets its turn.
_BREAK_EVERY, _BREAK_S = 1000, 0.0003


class RunCancelledError(Exception):
    """Raised to end a run that is no longer wanted, or too long."""


class Recording:
    """A run of one algorithm on a small canvas. A step is a line about to be run; the last one is
    the function's return.

    program: a function in loops.py.
    size: (width, height). Raises LucidaError if it is out of the canvas's bounds.
    is_wanted: the run ends early if this returns False.

    lines: the source line of each step.
    changes: for each variable, the steps at which it got a value, and the values.
    writes: the step of each write in the canvas's log.
    pixel_steps, object_steps: the steps at which the bodies of the two loops begin.
    truncated: True if the run was stopped after MOST_STEPS.
    """

    def __init__(
        self,
        model: Model,
        camera: Camera,
        size: Size,
        program: Callable[..., Any],
        is_wanted: Callable[[], bool] = lambda: True,
    ) -> None:
        check(StepperOptions, {"canvas": size})
        self.size, self.source = size, source_of(program)
        self.lines = array("b")
        self.changes: dict[str, tuple[array[int], list[Any]]] = defaultdict(
            lambda: (array("i"), [])
        )
        self.writes, self.pixel_steps, self.object_steps = array("i"), array("i"), array("i")
        self.truncated = False
        self._code, self._is_wanted = program.__code__, is_wanted
        before = sys.gettrace()
        sys.settrace(self._enter)
        try:
            program(model, camera, size)
        except RunCancelledError:
            self.truncated = len(self.lines) >= MOST_STEPS
        finally:
            sys.settrace(before)

    def __len__(self) -> int:
        """Return the number of steps."""
        return len(self.lines)

    def _enter(self, frame: FrameType, event: str, argument: Any) -> Any:
        """Trace a function's lines if it is the program; ignore other functions. See
        sys.settrace.
        """
        return self._line if frame.f_code is self._code else None

    def _line(self, frame: FrameType, event: str, argument: Any) -> Any:
        step = len(self.lines)
        if step % _BREAK_EVERY == 0:
            time.sleep(_BREAK_S)
            if not self._is_wanted():
                raise RunCancelledError
        if step >= MOST_STEPS:
            raise RunCancelledError
        values = frame.f_locals
        for name, value in values.items():
            steps, known = self.changes[name]
            if not known or value is not known[-1]:
                steps.append(step)
                known.append(value)
        if "canvas" in values:
            self.writes.extend([step] * (len(values["canvas"].log) - len(self.writes)))
        line = frame.f_lineno - self.source.first_line
        if line == self.source.pixels.start:
            self.pixel_steps.append(step)
        if line == self.source.objects.start:
            self.object_steps.append(step)
        self.lines.append(line)
        return self._line
