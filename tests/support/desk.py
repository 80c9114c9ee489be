"""A desk to try the window on: a display that nobody looks at, with a window manager, driven from
outside by keys and mouse, as a person does.

Desk is the display, Program a run of Lucida on it. Nothing here knows what is in the window, and
no time is measured: conditions are waited for.
"""

from __future__ import annotations

import contextlib
import os
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from needed import need, x_server
from PIL import Image, ImageGrab

ROOT = Path(__file__).parents[2]
PATIENT_S = 400.0  # the first picture of an installation waits for compiled kernels
STATUS_PX = 50
REST_S = 2.5  # longer than the window ever waits between two frames
QUIET = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}


def until(condition: Callable[[], object], what: str) -> None:
    end_s = time.monotonic() + PATIENT_S
    while not condition():
        assert time.monotonic() < end_s, f"waited in vain: {what}"
        time.sleep(0.05)


class Desk:
    """Use it as a context manager. size: (width, height) of the screen."""

    def __init__(self, size: tuple[int, int] = (1280, 560)) -> None:
        self.size = size
        self.program: int | None = None  # the process that has the window

    def __enter__(self) -> Desk:
        need("xdotool")
        self._server = x_server(self.size)
        self.display = self._server.__enter__()
        self._manager = subprocess.Popen([need("openbox")], env=self.environment, **QUIET)
        self.key("shift")  # answers once the display takes input
        return self

    def __exit__(self, *exception: object) -> None:
        self._manager.kill()
        self._manager.wait()
        self._server.__exit__(*exception)

    @property
    def environment(self) -> dict[str, str]:
        kept = {k: v for k, v in os.environ.items() if k != "WAYLAND_DISPLAY"}
        return kept | {"DISPLAY": self.display}

    def xdotool(self, *words: object) -> list[str]:
        done = subprocess.run(
            ["xdotool", *map(str, words)], env=self.environment, capture_output=True, text=True
        )
        return done.stdout.split()

    def key(self, *chords: str) -> None:
        """Presses chords, such as ctrl+plus, at once: faster than fingers, and than frames.

        Each is answered for before the next begins: of two presses of Ctrl that a busy server takes
        in the same millisecond, GLFW drops the second.
        """
        for chord in chords:
            self.xdotool("key", chord, "getmouselocation")

    def chord(self, modifier: str, key: str) -> None:
        """Holds a modifier, presses a key, as a finger does."""
        held = "keydown", modifier, "sleep", 0.1, "key", key, "sleep", 0.1, "keyup", modifier
        self.xdotool(*held, "getmouselocation")

    def click(self, x: int, y: int) -> None:
        press = "sleep", 0.1, "mousedown", 1, "sleep", 0.1, "mouseup", 1, "sleep", 0.1
        self.xdotool("mousemove", x, y, *press)

    def rest(self) -> None:
        """Puts the mouse where it points at nothing: the status line's right end."""
        self.xdotool("mousemove", self.size[0] - 30, self.size[1] - 30)

    def picture(self) -> np.ndarray:
        """The screen, uint8 (height, width, 3)."""
        return np.asarray(ImageGrab.grab(xdisplay=self.display).convert("RGB"))

    def still(self) -> np.ndarray:
        """The screen once it rests."""
        last, rest = self.picture(), _Rest(self.program)
        end_s = time.monotonic() + PATIENT_S
        while not rest.is_reached:
            time.sleep(0.4)
            now = self.picture()
            if (now != last).any():
                last, rest = now, _Rest(self.program)
            assert time.monotonic() < end_s, "the window never rests"
        return last

    def burst(self, *chords: str) -> list[float]:
        """The black parts of all different pictures while chords are pressed, each once the screen
        has changed after the one before, until it rests. Menu bar and status line are black in some
        looks: without."""
        last, rest = self.picture(), _Rest(self.program)
        parts = [_black(last)]
        end_s = time.monotonic() + PATIENT_S

        def look() -> None:
            nonlocal last, rest
            assert time.monotonic() < end_s, f"{len(parts)} different pictures, and no rest"
            now = self.picture()
            if (now != last).any():
                last, rest = now, _Rest(self.program)
                parts.append(_black(now))
            else:
                time.sleep(0.01)  # a frame takes longer, and needs the processor

        for chord in chords:
            pressing, before = threading.Thread(target=self.key, args=(chord,)), len(parts)
            pressing.start()
            while pressing.is_alive() or len(parts) == before:
                look()
        while not rest.is_reached:
            look()
        return parts


def check_same(one: np.ndarray, other: np.ndarray, folder: Path) -> None:
    """Both screens show the same above the status line, which tells times; otherwise they are left
    in the folder."""
    differ = (one != other)[:-STATUS_PX].any(axis=2)
    if differ.any():
        for name, picture in (("one", one), ("other", other)):
            Image.fromarray(picture).save(folder / f"{name}.png")
        rows, columns = np.nonzero(differ)
        box = columns.min(), rows.min(), columns.max(), rows.max()
        raise AssertionError(f"{len(rows)} pixels differ, within {box}: see {folder}")


class _Rest:
    """REST_S of which a process has worked, or waited for a processor, less than half.

    On a busy machine, a window that has not changed need not be at rest.
    """

    def __init__(self, process: int | None) -> None:
        self._process = process
        self._begin()

    def _begin(self) -> None:
        self._since_s, self._worked_s = time.monotonic(), _worked_s(self._process)
        assert self._worked_s > 0, "the kernel has no schedstat: nobody knows what rests"

    @property
    def is_reached(self) -> bool:
        if time.monotonic() < self._since_s + REST_S:
            return False
        reached = _worked_s(self._process) - self._worked_s < REST_S / 2
        if not reached:
            self._begin()
        return reached


def _worked_s(process: int | None) -> float:
    """The time that the threads of a process have run or waited for a processor (schedstat)."""
    times = 0
    for file in Path(f"/proc/{process}/task").glob("*/schedstat"):
        with contextlib.suppress(OSError):  # the thread, or the process, has ended
            times += sum(map(int, file.read_text().split()[:2]))
    return times / 1e9


def _black(picture: np.ndarray) -> float:
    return float((picture[60:-60].max(axis=2) < 6).mean())


class Program:
    """A run of Lucida on a desk; arguments: of the command. home: the user's, kept between runs.
    The window takes the whole screen, and rests, when this returns. begun: that picture."""

    def __init__(self, desk: Desk, home: Path, *arguments: str) -> None:
        self._desk = desk
        folders = {f"XDG_{name}_HOME": str(home / name) for name in ("CONFIG", "DATA", "STATE")}
        environment = desk.environment | folders | {"PYTHONPATH": str(ROOT)}
        self._log = home / "program.log"
        with self._log.open("w") as log:
            self._process = subprocess.Popen(
                [sys.executable, "-m", "lucida", *arguments],
                cwd=home,
                env=environment,
                stdout=log,
                stderr=log,
            )
        desk.program = self._process.pid
        until(self._is_shown, "the window")
        width, height = desk.size
        window = desk.xdotool("search", "--onlyvisible", "--name", "^Lucida")[-1]
        size = "windowsize", "--sync", window, width, height - 20
        desk.xdotool(*size, "windowmove", window, 0, 0, "windowactivate", "--sync", window)
        desk.rest()
        self.begun = desk.still()

    def _is_shown(self) -> bool:
        assert self._process.poll() is None, f"it ended: {self._log.read_text()}"
        return bool(self._desk.xdotool("search", "--onlyvisible", "--name", "^Lucida"))

    def __enter__(self) -> Program:
        return self

    def __exit__(self, *exception: object) -> None:
        if self._process.poll() is None:
            self._process.kill()
        self._process.wait()

    def quit(self, told: str = "") -> None:
        """Ctrl+Q; it must end well, and have nothing to say."""
        self._desk.chord("ctrl", "q")
        assert self._process.wait(PATIENT_S) == 0, self._log.read_text()
        assert told in (text := self._log.read_text())
        assert (text == "") == (told == "")
