"""The platform of the window: a display or none, and OpenGL on it.

This module selects GLFW's platform, checks that OpenGL works there, and creates moderngl's context
in the window. Only this module distinguishes X11 (also XWayland, because the bundle's GLFW has no
Wayland support), the null platform, macOS and Windows.
"""

from __future__ import annotations

import contextlib
import ctypes
import os
import sys
import threading
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

from imgui_bundle import ImVec2, imgui  # before glfw, so that both use the same GLFW library

# isort: split
import glfw
import moderngl

from lucida.renderer.system.errors import LucidaError, one_line

from .key_names import give_key
from .keys import KeyFrames

REQUIRED = (3, 3)
DEFAULT_SIZE = (1280, 720)
_LOCKED = int(imgui.ImFontFlags_.lock_baked_sizes)
LONGEST_PLACING_S = 0.25  # wait for a window manager to place the window


@dataclass(frozen=True)
class Platform:
    """GLFW's platform. has_display: False for the null platform. reason: its cause, in one line."""

    has_display: bool
    reason: str = ""


def start_platform(want_display: bool = True) -> Platform:
    """Start GLFW on a display, or on the null platform (with EGL) if there is none.

    want_display: False for the null platform, if that works here: pictures can then have any size,
    and no window is visible. Raises LucidaError if there is no OpenGL 3.3, with one line that names
    the packages to install.
    """
    if want_display:
        platform = _with_display()
        if not platform.has_display:
            _start_null()
        _check_opengl(platform)
        return platform
    try:
        _start_null()
        _check_opengl(platform := Platform(False, "not asked for"))
        return platform
    except LucidaError:
        glfw.terminate()
        glfw.init_hint(glfw.PLATFORM, glfw.ANY_PLATFORM)
        platform = _with_display()
        if not platform.has_display:
            raise
        _check_opengl(platform)
        return platform


def create_context() -> moderngl.Context:
    """Return moderngl's context in the window's, which must be current. Raises LucidaError."""
    if not glfw.get_current_context():
        raise LucidaError("OpenGL", "the window has no context", "run `lucida doctor`")
    require = REQUIRED[0] * 100 + REQUIRED[1] * 10
    return moderngl.create_context(context=_Loader(), require=require)  # type: ignore[arg-type]


def flush_opengl() -> None:
    """Send waiting commands to the GPU. A swap does that on a display. The null platform has no
    swap, and would draw nothing until the result is read.
    """
    address = glfw.get_proc_address("glFlush")
    if address:
        ctypes.CFUNCTYPE(None)(ctypes.cast(address, ctypes.c_void_p).value or 0)()


def lock_letters(locked: bool = True) -> None:
    """Keep ImGui from rasterizing letters of a new size, or allow it again."""
    for font in imgui.get_io().fonts.fonts:
        flags = font.flags | _LOCKED if locked else font.flags & ~_LOCKED
        font.flags = flags


def begin_letters() -> None:
    """Correct the framebuffer's scale when a frame has begun. Call lock_letters() before the frame.

    ImGui's backend divides the framebuffer's size by the window's, which X11 reports one after the
    other. If the window is resized to 1 x 1 in between, letters become a thousand times as large,
    and ImGui ends the program: "Out of texture memory". Only on macOS can the scale differ from 1.
    """
    if glfw.get_platform() != glfw.PLATFORM_COCOA:
        one = ImVec2(1, 1)
        imgui.get_io().display_framebuffer_scale = one
        imgui.get_main_viewport().framebuffer_scale = one
    lock_letters(False)


def set_title(text: str) -> None:
    """Set the title of the window whose context is current."""
    window = glfw.get_current_context()
    if window:
        glfw.set_window_title(window, one_line(text))


def keep_open() -> None:
    """Keep the window with the current context open after its close button was pressed."""
    window = glfw.get_current_context()
    if window:
        glfw.set_window_should_close(window, False)


def take_keys() -> KeyFrames:
    """Queue the current window's keyboard events, frame by frame."""
    window = glfw.get_current_context()
    keys = KeyFrames(give_key, lambda character: imgui.get_io().add_input_character(character))
    if window:
        glfw.set_key_callback(window, lambda _window, *event: keys.take(*event))
        glfw.set_char_callback(window, lambda _window, character: keys.take(character))
    return keys


def on_drop(dropped: Callable[[list[str]], None]) -> None:
    """Call `dropped` with the paths of files that are dropped on the current window."""
    window = glfw.get_current_context()
    if window:

        def call(_window: Any, count: int, paths: Any) -> None:
            dropped([os.fsdecode(paths[number]) for number in range(count)])

        # glfw.set_drop_callback() assumes that all names are UTF-8, and fails for others.
        binding: Any = glfw
        _on_drop[:] = [binding._GLFWdropfun(call)]  # noqa: SLF001, no public way
        binding._glfw.glfwSetDropCallback(window, _on_drop[0])  # noqa: SLF001


_on_drop: list[Any] = []  # keeps the callback alive as long as the window


def default_size(platform: Platform) -> tuple[int, int]:
    """Return two thirds of the screen's (width, height), but at least DEFAULT_SIZE if that fits."""
    monitor = glfw.get_primary_monitor() if platform.has_display else None
    if not monitor:
        return DEFAULT_SIZE
    rooms = glfw.get_monitor_workarea(monitor)[2:]
    width, height = (
        min(room, max(2 * room // 3, least))
        for room, least in zip(rooms, DEFAULT_SIZE, strict=True)
    )
    return width, height


def set_size(size: tuple[int, int]) -> None:
    """Set the (width, height) of the window whose context is current, in screen coordinates."""
    window = glfw.get_current_context()
    if window and glfw.get_window_size(window) != size:
        glfw.set_window_size(window, *size)


def show_window(draw: Callable[[], None]) -> None:
    """Show the current, hidden window in front, and wait briefly for a window manager to place it.

    draw: called afterwards to draw the picture again, because earlier drawing is lost.
    """
    window = glfw.get_current_context()
    if not window:
        return
    placed = threading.Event()

    def refresh(_window: Any) -> None:  # stays, because glfw cannot remove a callback
        if not placed.is_set():
            placed.set()
            draw()
            glfw.swap_buffers(window)

    glfw.set_window_refresh_callback(window, refresh)
    glfw.show_window(window)
    end_s = time.monotonic() + LONGEST_PLACING_S
    while not placed.is_set() and time.monotonic() < end_s:
        glfw.wait_events_timeout(LONGEST_PLACING_S / 10)
    placed.set()


def toggle_full_screen() -> None:
    """Let the current window cover its monitor, or restore its place."""
    window = glfw.get_current_context()
    if not window:
        return
    if glfw.get_window_monitor(window):
        left, top, width, height = _windowed.pop(0) if _windowed else (50, 50, 1280, 720)
        glfw.set_window_monitor(
            window,
            None,  # type: ignore[arg-type]
            left,
            top,
            width,
            height,
            glfw.DONT_CARE,
        )
        return
    _windowed[:] = [(*glfw.get_window_pos(window), *glfw.get_window_size(window))]
    monitor = _monitor_of(_windowed[0])
    if monitor:
        mode = glfw.get_video_mode(monitor)
        glfw.set_window_monitor(
            window, monitor, 0, 0, mode.size.width, mode.size.height, mode.refresh_rate
        )


_windowed: list[tuple[int, int, int, int]] = []  # left, top, width, height before full screen


def _monitor_of(place: tuple[int, int, int, int]) -> Any:
    """Return the monitor that shows most of a window."""
    left, top, width, height = place

    def shared(monitor: Any) -> int:
        x, y = glfw.get_monitor_pos(monitor)
        size = glfw.get_video_mode(monitor).size
        wide = min(left + width, x + size.width) - max(left, x)
        high = min(top + height, y + size.height) - max(top, y)
        return max(wide, 0) * max(high, 0)

    return max(glfw.get_monitors(), key=shared, default=None)


class _Loader:
    """A loader that finds the functions of GLFW's context, for moderngl."""

    def load_opengl_function(self, name: str) -> int:
        return glfw.get_proc_address(name) or 0  # type: ignore[return-value]

    def __enter__(self) -> _Loader:
        return self

    def __exit__(self, *_: object) -> None:
        pass

    def release(self) -> None:
        pass


def why_no_display() -> str:
    """Return the reason why there can be no display, in one line; empty if there may be one."""
    if not sys.platform.startswith("linux") or os.environ.get("DISPLAY"):
        return ""
    if os.environ.get("WAYLAND_DISPLAY"):
        return "this Wayland session has no XWayland (DISPLAY is not set)"
    return "DISPLAY is not set"


def _with_display() -> Platform:
    if reason := why_no_display():
        return Platform(False, reason)
    with _quiet() as errors:
        if glfw.init():
            return Platform(True)
    return Platform(False, errors[-1] if errors else "the display does not answer")


def _start_null() -> None:
    with _quiet() as errors:
        glfw.init_hint(glfw.PLATFORM, glfw.PLATFORM_NULL)
        if not glfw.init():
            raise LucidaError("window", _last(errors), "reinstall imgui-bundle")
        glfw.window_hint(glfw.CONTEXT_CREATION_API, glfw.EGL_CONTEXT_API)


def _check_opengl(platform: Platform) -> None:
    """Create and destroy a test context: a failure of the window's would end the process."""
    remedy = (
        "install a graphics driver with OpenGL 3.3"
        if platform.has_display
        else "install EGL: apt-get install libegl1 libgl1-mesa-dri"
    )
    with _quiet() as errors:
        glfw.window_hint(glfw.VISIBLE, False)
        glfw.window_hint(glfw.CONTEXT_VERSION_MAJOR, REQUIRED[0])
        glfw.window_hint(glfw.CONTEXT_VERSION_MINOR, REQUIRED[1])
        glfw.window_hint(glfw.OPENGL_PROFILE, glfw.OPENGL_CORE_PROFILE)
        glfw.window_hint(glfw.OPENGL_FORWARD_COMPAT, True)
        window = glfw.create_window(16, 16, "lucida", None, None)
        glfw.default_window_hints()
        # A desktop finds the icon by X11's class, which would otherwise be the title.
        glfw.window_hint_string(glfw.X11_CLASS_NAME, "Lucida")
        glfw.window_hint_string(glfw.X11_INSTANCE_NAME, "lucida")
        if not platform.has_display:
            glfw.window_hint(glfw.CONTEXT_CREATION_API, glfw.EGL_CONTEXT_API)
        if not window:
            raise LucidaError("OpenGL 3.3", f"is not available: {_last(errors)}", remedy)
        glfw.destroy_window(window)


@contextlib.contextmanager
def _quiet() -> Iterator[list[str]]:
    """Collect GLFW's errors, which would otherwise be warnings on standard error."""
    errors: list[str] = []

    def collect(code: int, description: Any) -> None:
        text = description.decode(errors="replace") if isinstance(description, bytes) else ""
        errors.append(text or f"error {code:#x}")

    old = glfw.set_error_callback(collect)
    try:
        yield errors
    finally:
        glfw.set_error_callback(old)  # type: ignore[arg-type]


def _last(errors: list[str]) -> str:
    return errors[-1] if errors else "no reason given"
