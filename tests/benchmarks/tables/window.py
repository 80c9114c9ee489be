"""The window while the eye is dragged: its frames, and how soon the ray image follows.

On GLFW's null platform at 60 frames a second, driven by mouse events as a user's would be.
`python -m tests.benchmarks.tables.window MESH WIDTH HEIGHT LAYOUT SECONDS STEPS` is a process with
one such window: it prints what it measured.
"""

from __future__ import annotations

import json
import math
import os
import subprocess
import sys
import time
from collections.abc import Iterator
from dataclasses import asdict, dataclass, field
from typing import Any

import numpy as np

from app.host.layout import LAYOUTS, OUTSIDE, reset, switch
from tests.benchmarks.cameras import easy_views
from tests.benchmarks.report import Table, short
from tests.benchmarks.run import HD, Run
from tests.benchmarks.scenes import SUBJECTS, Subject, model, shaded_scene

FRAME_S = 1 / 60
FIRST_AT_MOST, FULL_AT_MOST = 1.0, {"small": 2.0, "1M": 3.0}  # frames
DRAG_S, STEPS = 6.0, 12
SETTLE_AT_MOST_S = 180.0


@dataclass(frozen=True)
class Case:
    """A window of `size`. p99_ms: of a frame, at most, by scene."""

    size: tuple[int, int]
    layout: str
    p99_ms: dict[str, float]

    @property
    def name(self) -> str:
        beside = ", outside view" if self.layout == OUTSIDE else ""
        return f"{self.size[0]}x{self.size[1]}{beside}"


CASES = (
    Case((1280, 720), LAYOUTS[0].name, {"small": 16.7, "1M": 20.0}),
    Case((1280, 720), OUTSIDE, {"small": 20.0, "1M": 24.0}),
    Case((2876, 801), LAYOUTS[0].name, {"small": 20.0, "1M": 20.0}),  # both images about 1280x720
)


@dataclass
class Measured:
    """size: of both images. drag_starts_s: when each frame of the drag began; drag_work_s: how
    long until it was shown. Of each single change: after how many seconds the first image of the
    changed camera was there, how many frames of 1/60 s later its frame began than the change's,
    how coarse it was; and the same of the full image."""

    size: tuple[int, int] = (0, 0)
    drag_starts_s: list[float] = field(default_factory=list)
    drag_work_s: list[float] = field(default_factory=list)
    drag_images: int = 0
    first_s: list[float] = field(default_factory=list)
    first_frames: list[int] = field(default_factory=list)
    first_factors: list[int] = field(default_factory=list)
    full_s: list[float] = field(default_factory=list)
    full_frames: list[int] = field(default_factory=list)


def measure(run: Run) -> list[Table]:
    """One table: a row a scene."""
    header: tuple[str, ...] = (
        "scene",
        "window",
        "images",
        "frames",
        "work over 16.7 ms",
        "frame p50 ms",
        "p99 ms",
    )
    header += ("ray images/s", "first after ms (frames)", "full after ms (frames)")
    table = Table("window", "The window: the eye dragged, then moved in single steps", header)
    seconds, steps = (3.0, 4) if run.quick else (DRAG_S, STEPS)
    for subject in run.subjects("small", "1M"):
        for case in CASES:
            run.say(f"window: {subject.name}, {case.name}")
            given = run.file or subject.name, *case.size, case.layout, seconds, steps
            command = [sys.executable, "-m", __name__, *map(str, given)]
            # As `lucida` begins.
            environment = {"OPENBLAS_NUM_THREADS": "1", **os.environ}
            done = subprocess.run(command, capture_output=True, text=True, env=environment)
            if done.returncode:
                lines = done.stderr.strip().splitlines() or ["no reason given"]
                where = f"{subject.name}, {case.name}"
                table.notes.append(f"{where}: the window failed: {lines[-1]}")
                continue
            measured = Measured(**json.loads(done.stdout.splitlines()[-1]))
            add_row(table, subject.name, case, measured)
    table.notes.append(
        "Frame: from the beginning of one to that of the next. Work: until the frame is shown. "
        "After: from a change of the camera until an image of it is shown."
    )
    return [table]


def add_row(table: Table, scene: str, case: Case, measured: Measured) -> None:
    """Add the row of one window's measurements, and its targets."""
    frames_s = np.diff(measured.drag_starts_s)
    work_s = np.array(measured.drag_work_s)
    late = int(np.count_nonzero(work_s > FRAME_S))
    p50, p99 = (float(1e3 * q) for q in np.quantile(frames_s, (0.5, 0.99)))
    rate = measured.drag_images / float(np.sum(frames_s))
    first, full = (
        (_median(measured.first_s), _median(measured.first_frames)),
        (_median(measured.full_s), _median(measured.full_frames)),
    )
    table.add(
        scene,
        case.name,
        f"{measured.size[0]}x{measured.size[1]}",
        str(len(work_s)),
        f"{late} ({100 * late / len(work_s):.1f} %)",
        short(p50),
        short(p99),
        short(rate),
        f"{short(1e3 * first[0])} ({short(first[1])})",
        f"{short(1e3 * full[0])} ({short(full[1])})",
        scene=scene,
        window=case.name,
        frames_over_16_7_ms=late,
        p50_ms=p50,
        p99_ms=p99,
        images_per_s=rate,
        **asdict(measured),
    )
    bounds = {
        "p99 of a frame": (p99, case.p99_ms.get(scene), "ms"),
        "first image after": (first[1], FIRST_AT_MOST, "frames"),
        "full image after": (full[1], FULL_AT_MOST.get(scene), "frames"),
    }
    for what, (value, bound, unit) in bounds.items():
        if bound is not None:
            table.target(f"{scene}, {case.name}: {what}", value, bound, unit, at_least=False)


def _median(values: list[Any]) -> float:
    return float(np.median(values)) if values else math.nan


# The process with the window.


class Script:
    """The user's actions, one a frame, and what the window shows after them."""

    def __init__(self, run: Any, case: Case, seconds: float, steps: int) -> None:
        self._run, self._window, self._case = run, run.window, case
        self._seconds, self._steps = seconds, steps
        self.measured = Measured()
        self._began_s = self._shown_s = 0.0  # this frame, the last one
        self._dragging = False
        self._seen: Any = None
        self._play = self._scene()
        callbacks = run.params.callbacks
        callbacks.pre_new_frame = run.guarded(self._before)
        self._then = callbacks.after_swap
        callbacks.after_swap = run.guarded(self._after)

    def _before(self) -> None:
        """The beginning of a frame: the next thing that the user does."""
        self._shown_s, self._began_s = self._began_s, time.perf_counter()
        if next(self._play, "over") == "over":
            self._run.params.app_shall_exit = True

    def _after(self) -> None:
        """The frame is shown."""
        if self._dragging:
            self.measured.drag_starts_s.append(self._began_s)
            self.measured.drag_work_s.append(time.perf_counter() - self._began_s)
            if self._window.renderers.ray_image is not self._seen:
                self.measured.drag_images += 1
        self._seen = self._window.renderers.ray_image
        self._then()

    def _scene(self) -> Iterator[None]:
        import imgui_bundle  # noqa: F401 - before glfw, so that both use the same library

        # isort: split
        import glfw

        yield from self._settled(3)
        # Larger than the null platform's screen, to which a new window is cut.
        glfw.set_window_size(glfw.get_current_context(), *self._case.size)
        yield from self._settled(3)
        switch(self._case.layout)
        yield from self._settled(3)
        reset()  # both images as large as each other
        yield from self._settled(20)
        self.measured.size = self._window.renderers.size
        yield from self._drag()
        for step in range(self._steps):
            yield from self._settled(20)
            yield from self._single_change(step)

    def _settled(self, frames: int) -> Iterator[None]:
        """Waits until nothing has changed for some frames."""
        until_s, quiet = time.perf_counter() + SETTLE_AT_MOST_S, 0
        while quiet < frames:
            if time.perf_counter() > until_s:
                raise RuntimeError("the images were not complete in time")
            yield
            if self._window.renderers.failure is not None:
                raise self._window.renderers.failure
            quiet = quiet + 1 if self._window.settled else 0

    def _drag(self) -> Iterator[None]:
        """The left button held over the ray image, the mouse going round in loops."""
        from imgui_bundle import imgui

        from app.pair.view import RAY

        pane = imgui.internal.find_window_by_name(self._window.views[RAY].label)
        x, y = pane.pos.x + pane.size.x / 2, pane.pos.y + pane.size.y / 2
        before = self._window.state.camera.eye
        self._mouse(x, y)
        yield
        imgui.get_io().add_mouse_button_event(0, True)
        yield
        start_s = time.perf_counter()
        self._dragging = True
        while (t := time.perf_counter() - start_s) < self._seconds:
            across, down = math.sin(2 * math.pi * t / 5), math.sin(2 * math.pi * t / 3.1)
            self._mouse(x + 0.3 * pane.size.x * across, y + 0.2 * pane.size.y * down)
            yield
        self._dragging = False
        moved = self._window.state.camera.eye != before
        imgui.get_io().add_mouse_button_event(0, False)
        yield
        if not moved:
            raise RuntimeError("the mouse moved nothing")

    @staticmethod
    def _mouse(x: float, y: float) -> None:
        import glfw
        from imgui_bundle import imgui

        # GLFW's own position, too: ImGui's backend asks for it.
        glfw.set_cursor_pos(glfw.get_current_context(), x, y)
        imgui.get_io().add_mouse_pos_event(x, y)

    def _single_change(self, step: int) -> Iterator[None]:
        """The eye moved once; waits for the first image of it, and for the full one."""
        from renderer.navigation import moved

        window, measured = self._window, self.measured
        camera = moved(window.state.camera, (0.01 * (-1) ** step, 0.005, 0.0))
        start_s = self._began_s
        window.change(window.state.with_camera(camera))
        has_first = False
        while self._began_s - start_s < SETTLE_AT_MOST_S:
            yield
            # What the frame before this one showed, until this one began.
            image = window.renderers.ray_image
            if image is None or image.request != window.renderers.request(window.state):
                continue
            elapsed_s = self._began_s - start_s
            frames = round((self._shown_s - start_s) / FRAME_S)
            if not has_first:
                has_first = True
                measured.first_s.append(elapsed_s)
                measured.first_frames.append(frames)
                measured.first_factors.append(image.factor)
            if image.factor == 1:
                measured.full_s.append(elapsed_s)
                measured.full_frames.append(frames)
                return


def _worker(mesh: str, width: str, height: str, layout: str, seconds: str, steps: str) -> None:
    from app.state.app_state import AppState
    from app.window.platform import start_platform
    from app.window.viewer import WindowRun
    from renderer.scene import View

    case = Case((int(width), int(height)), layout, {})
    subject: Subject = SUBJECTS[mesh]() if mesh in SUBJECTS else model(mesh)
    view = View(easy_views(subject, HD)[0].camera, fit=True)
    state = AppState.for_scene(shaded_scene(subject), view)
    run = WindowRun(start_platform(want_display=False), state, case.size, remember=False)
    run.params.fps_idling.enable_idling = False
    run.params.fps_idling.fps_max = 1 / FRAME_S
    script = Script(run, case, float(seconds), int(steps))
    run.run()
    print(json.dumps(asdict(script.measured)))


if __name__ == "__main__":
    _worker(*sys.argv[1:])
