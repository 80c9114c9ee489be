"""Drives the real window with ImGui's test engine, on GLFW's null platform; a process of its own.

    python window_driver.py REPORT.json FOLDER TOPIC[/DRIVE] ...

runs every function of scenarios/TOPIC.py whose name begins with `drive_` (or the one named), in
order, in one window, and writes a JSON object from their names to "" or the traceback of their
failure. FOLDER has the last pictures of one that failed. test_window.py runs it.
"""

from __future__ import annotations

import json
import os
import signal
import sys
import time
import traceback
from collections import deque
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # as the program does
os.environ.pop("DISPLAY", None)
os.environ.pop("WAYLAND_DISPLAY", None)

import numpy as np
from drives import drives, topic_of
from glimpses import skip_unseen
from imgui_bundle import hello_imgui, imgui
from option_changes import with_options
from PIL import Image

from lucida.app.images.pair import image_view
from lucida.app.images.pair.view import RASTER, RAY
from lucida.app.instruments.outside import ground
from lucida.app.instruments.outside import mouse as outside_mouse
from lucida.app.state.app_state import AppState, History
from lucida.app.state.options import Options
from lucida.app.ui import layout, toasts
from lucida.app.ui.theme import framebuffer_scale
from lucida.app.window import main_window
from lucida.app.window.files import Files
from lucida.app.window.platform import start_platform
from lucida.app.window.viewer import WindowRun
from lucida.renderer.files import load_scene

SIZE = (1100, 720)
# On a slow or busy machine a turn of the wheel takes long: no picture may depend on that.
image_view.PAUSE_S = outside_mouse.WHEEL_PAUSE_S = 10.0
toasts.SHOWN_S = 1e9  # nor what is still told
ground.SHIFTS = ground.SHIFTS[-1:]  # one picture in place of the mean of five, for smooth edges
FRAME_S = 1 / 60  # what ImGui takes a frame for: clicks are double ones however slow frames are
PROMPT_FRAMES = 2  # what the window does by itself takes few frames; threads and pauses are longer
WAIT_S, LONGEST_WAIT_S = 0.05, 0.5  # the first, and where nothing wakes the window
ATTEMPTS = 3  # a picture can be taken of a frame in which a window is still being laid out
PATIENT_S = 300.0  # the first tracing compiles
IMAGES = {name: f"//###{name}/image##{name}" for name in (RASTER, RAY)}
Key = imgui.Key
Found = TypeVar("Found")


class Driver:
    """The window under test, and what tests do with it. ctx: the test engine's context."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        state = AppState.for_scene(load_scene("still-life"))
        self.start = state
        self.run = WindowRun(start_platform(want_display=False), state, SIZE, remember=False)
        self.window = self.run.window
        self.ctx: Any = None
        self.drop: Callable[[list[str]], None] = lambda paths: None  # files, upon the window
        self.stay = False  # the mouse, while a picture is taken
        self._pictures: deque[np.ndarray] = deque(maxlen=4)
        skip_unseen(self.run)
        self.files.native = False  # the system's dialogs, which would wait for somebody
        on_drop = main_window.on_drop

        def listen(dropped):
            self.drop = dropped
            on_drop(dropped)

        main_window.on_drop = listen

    @property
    def state(self) -> AppState:
        return self.window.state

    @property
    def options(self) -> Options:
        return self.window.state.options

    @property
    def files(self) -> Files:
        return self.window.files

    @property
    def steps(self) -> int:
        """The number of changes that undo can take back."""
        return len(self.window.history.past)

    @property
    def stage(self) -> Any:
        return self.window.shell.stage

    @property
    def renderers(self) -> Any:
        return self.window.renderers

    def reset(self) -> None:
        """Every test begins with the same state and size, at rest."""
        self.window.history = History(self.start)
        self.files.message = ""
        self.window.shell.toasts.clear()
        self.stage.failed.errors.clear()
        self.window.motions.transition.stop()
        self.window.end_movement()
        self.window.motions.transition.instant = True  # no passage unless a test wants one
        self.stay = False
        if imgui.is_mouse_down(0):  # a test that failed may hold it
            self.ctx.mouse_up(0)
        self.ctx.mouse_teleport_to_pos((3, SIZE[1] - 3))  # which takes two frames
        self.resize(SIZE)
        self.rest()

    def begin_topic(self) -> None:
        """Put the views where they are in a new window: topics share one."""
        if self.window.lecture.is_given:
            self.window.lecture.leave(self.window)
        first = layout.LAYOUTS[0]
        layout.switch(first.name)
        self.until(lambda: layout.current() is first)
        for view in self.stage.views.values():
            layout.window_of(view).is_visible = view.name in first.places
        layout.reset()
        self.frames(2)  # ImGui empties its docks
        self.until(lambda: self.stage.rects.keys() >= first.places.keys())

    def resize(self, size: tuple[int, int]) -> None:
        """Resize the window, unless it has that size, and wait until it is drawn so."""
        if tuple(imgui.get_io().display_size) != size:
            hello_imgui.change_window_size(size)
            self.until(lambda: tuple(imgui.get_io().display_size) == size)
            self.settle()

    def layout(self, name: str) -> None:
        """Switch to a layout of the views, unless it is there."""
        if hello_imgui.current_layout_name() != name:
            hello_imgui.switch_layout(name)
            self.until(lambda: hello_imgui.current_layout_name() == name)
            self.until(lambda: not self.window.shell._dividing)
        self.settle()

    def change(self, **options: Any) -> None:
        """Change options of the state, as with_options() does."""
        self.window.change(with_options(self.state, **options))

    def show_small(self) -> None:
        """Show small images, pixel by pixel, to whom their size does not matter."""
        self.change(images={"resolution": (120, 90), "magnification": 1.0})

    def undo(self) -> None:
        self.window.undo()

    def frames(self, count: int = 1) -> None:
        self.ctx.yield_(count)

    def until(self, condition: Callable[[], bool]) -> None:
        end_s = time.monotonic() + PATIENT_S
        frames, wait_s = 0, WAIT_S
        while not condition():
            assert time.monotonic() < end_s, "nothing happened"
            self.frames()
            frames += 1
            if frames > PROMPT_FRAMES:
                # Each frame takes a processor from the threads that the test waits for.
                self.window.news.wait(wait_s)
                self.window.news.clear()
                wait_s = min(1.1 * wait_s, LONGEST_WAIT_S)

    def settle(self) -> None:
        """Wait until both images are complete and compared."""
        self.frames(2)
        self.rest()

    def rest(self) -> None:
        """Wait until everything that two frames started has finished."""
        failures = self.stage.failed.errors
        self.until(lambda: self.window.settled or bool(failures))
        assert not failures, failures
        self.frames()

    def picture(self) -> np.ndarray:
        """Return what the window shows, uint8 (height, width, 3)."""
        seen = []

        def look(target):
            if not self.window.is_rearranging:
                seen.append(target.read())

        self.run.on_drawn = look
        self.until(lambda: bool(seen))
        self.run.on_drawn = None
        self._pictures.append(seen[-1])
        return seen[-1]

    def save_pictures(self, name: str) -> None:
        """Leave the last pictures in the folder, for whoever looks at a failure."""
        for number, seen in enumerate(self._pictures):
            Image.fromarray(seen).save(self.folder / f"{Path(name).name}-{number}.png")

    def in_draw_lists(self, read: Callable[[], Found]) -> Found:
        """Return what `read` finds in the draw lists of a frame, of which no pixel is drawn."""
        found = []
        callbacks = self.run.params.callbacks
        before_swap = callbacks.before_swap

        def drawn():
            if not self.window.is_rearranging:
                found.append(read())
            before_swap()

        callbacks.before_swap = drawn
        try:
            self.until(lambda: bool(found))
        finally:
            callbacks.before_swap = before_swap
        return found[-1]

    def rect(self, name: str) -> tuple[float, float, float, float]:
        """Left, top, right, bottom of an image in the window."""
        box = self.box(IMAGES[name])
        return box.min.x, box.min.y, box.max.x, box.max.y

    def images(self) -> tuple[np.ndarray, np.ndarray]:
        """The pixels of both images as shown, int16. Neither tooltips nor the keyboard's frame are
        in the way.
        """
        imgui.set_nav_cursor_visible(False)
        if not self.stay and tuple(imgui.get_io().mouse_pos) != (3, SIZE[1] - 3):
            self.move_to((3, SIZE[1] - 3))
        window, scale = self.picture(), framebuffer_scale()
        cut = []
        for name in (RASTER, RAY):
            left, top, right, bottom = (round(edge * scale) for edge in self.rect(name))
            cut.append(window[top:bottom, left:right].astype(np.int16))
        return cut[0], cut[1]

    def agreeing_images(self) -> tuple[np.ndarray, np.ndarray]:
        """Both images at rest; they must agree, and show something."""
        self.settle()
        verdict = self.renderers.agreement.verdict_on(self.renderers.request(self.state))
        assert verdict is not None
        assert verdict.comparison.unexplained == 0, verdict.text
        for attempt in range(ATTEMPTS):
            raster, ray = self.images()
            size = self.renderers.size
            seen = f"sizes {raster.shape}, {ray.shape} of {size}"
            if raster.shape == ray.shape and raster.shape[:2] == (size[1], size[0]):
                different = (np.abs(raster - ray).max(axis=2) > 3).mean()
                if different < 0.002 and raster.std() > 5:
                    return raster, ray
                deviations = f"standard deviations {raster.std():.1f} and {ray.std():.1f}"
                seen = f"{different:.2%} of the pixels differ on the screen; {deviations}"
            # Otherwise a message has come or gone in this frame, and the images' room with it.
            print(f"attempt {attempt}: {seen}")
            self.settle()
        raise AssertionError(seen)

    def point(self, name: str, x: float, y: float) -> tuple[float, float]:
        """A place in an image, as parts of its width and height."""
        left, top, right, bottom = self.rect(name)
        return left + x * (right - left), top + y * (bottom - top)

    def drag(self, start: tuple[float, float], end: tuple[float, float], button: int = 0) -> None:
        self.ctx.mouse_teleport_to_pos(start)
        self.ctx.mouse_down(button)
        for part in (0.25, 0.5, 1.0):
            x, y = (a + part * (b - a) for a, b in zip(start, end, strict=True))
            self.ctx.mouse_teleport_to_pos((x, y))
        self.ctx.mouse_up(button)
        self.frames()

    def press(self, chord: int) -> None:
        """Press keys, and draw a frame, in which they have their effect; as the next four do."""
        self.ctx.key_press(chord)
        self.frames()

    def click(self, item: str, button: int = 0) -> None:
        self.ctx.item_click(item, button)
        self.frames()

    def menu(self, path: str) -> None:
        self.ctx.menu_click(f"//##MainMenuBar/{path}")
        self.frames()

    def move_to(self, place: tuple[float, float]) -> None:
        self.ctx.mouse_teleport_to_pos(place)
        self.frames()

    def click_at(self, place: tuple[float, float]) -> None:
        self.move_to(place)
        self.ctx.mouse_click(0)
        self.frames()

    def box(self, item: str) -> imgui.internal.Rect:
        """Return the rectangle of an item in the window."""
        return self.ctx.item_info(item).rect_full

    def field(self, name: str) -> str:
        return f"//Camera/##{name}"

    def drag_field(self, name: str, pixels: float) -> None:
        center = self.box(self.field(name)).get_center()
        self.drag((center.x, center.y), (center.x + pixels, center.y))

    def type(self, name: str, text: str) -> None:
        """Double-clicks a field and types."""
        self.ctx.item_double_click(self.field(name))
        self.ctx.key_chars_replace_enter(text)
        self.frames()


def changed(before: np.ndarray, after: np.ndarray) -> float:
    """The part of the pixels that differ visibly."""
    return float((np.abs(before - after).max(axis=2) > 8).mean())


def ignore_broken_pipes() -> None:
    """As Python does. The test engine takes the signal for a crash and aborts, or hangs while it
    prints: whenever something is written to a process that has just been ended."""
    if hasattr(signal, "SIGPIPE"):
        signal.signal(signal.SIGPIPE, signal.SIG_IGN)


def main(report: Path, folder: Path, names: list[str]) -> None:
    sys.modules["window_driver"] = sys.modules[__name__]  # which the scenarios import
    tests = drives(names)
    results = dict.fromkeys(tests, "was not run")
    firsts = {topic_of(one): one for one in reversed(tests)}.values()
    driver = Driver(folder)
    params = driver.run.params

    def wrapped(name, test):
        def call(ctx):
            driver.ctx = ctx
            try:
                driver.reset()
                if name in firsts:
                    driver.begin_topic()
                test(driver)
                results[name] = "the test engine found an error" if ctx.is_error() else ""
            except BaseException:
                results[name] = traceback.format_exc()
                driver.save_pictures(name)
            if name == list(tests)[-1]:
                params.app_shall_exit = True

        return call

    def register():
        ignore_broken_pipes()
        engine = hello_imgui.get_imgui_test_engine()
        io = imgui.test_engine.get_io(engine)
        io.config_run_speed = imgui.test_engine.TestRunSpeed.fast
        io.config_fixed_delta_time = FRAME_S
        io.config_log_to_tty = True
        io.config_watchdog_warning = io.config_watchdog_kill_test = 2 * PATIENT_S
        for name, test in tests.items():
            entry = imgui.test_engine.register_test(engine, "window", name)
            entry.test_func = wrapped(name, test)
            imgui.test_engine.queue_test(engine, entry)

    params.use_imgui_test_engine = True
    params.callbacks.register_tests = register
    params.fps_idling.enable_idling = False
    try:
        driver.run.run()
    finally:
        report.write_text(json.dumps(results, indent=1))


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]), sys.argv[3:])
