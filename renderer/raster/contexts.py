"""OpenGL contexts without a window: find a platform, and make its context current.

The platforms are EGL, OSMesa and the system's default. A window's context is passed in.
"""

from __future__ import annotations

import ctypes
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import moderngl

from lucida.renderer.system.child import check_not_forked
from lucida.renderer.system.errors import LucidaError

from .current import found_library, load_egl, load_osmesa, nothing_current
from .packages import remedy

BACKENDS = ("auto", "egl", "osmesa")
# From the headers of OSMesa and GL.
_ATTRIBUTES = (
    *(0x22, 0x1908),  # OSMESA_FORMAT: OSMESA_RGBA
    *(0x30, 24),  # OSMESA_DEPTH_BITS
    *(0x33, 0x34),  # OSMESA_PROFILE: OSMESA_CORE_PROFILE
    *(0x36, 3, 0x37, 3),  # OSMESA_CONTEXT_MAJOR_VERSION, MINOR_VERSION
    0,
)
_GL_UNSIGNED_BYTE = 0x1401

_drivers_pid: int | None = None  # the process that loaded an OpenGL driver


# Providers of an OpenGL context. name: for messages. context: moderngl's object for it. current():
# a context manager that makes it current in the thread, and restores the previous one afterwards.


class Standalone:
    """A context created by moderngl: EGL, or the default of macOS and Windows."""

    def __init__(self, name: str) -> None:
        self.name = name
        settings: dict[str, Any] = {}
        if name == "egl":  # spares moderngl another search
            libraries = {"libgl": found_library("GL"), "libegl": found_library("EGL")}
            settings = {"backend": "egl", **libraries}
        with nothing_current():
            self.context = moderngl.create_context(standalone=True, require=330, **settings)
            self.context.__exit__(None, None, None)

    @contextmanager
    def current(self) -> Iterator[moderngl.Context]:
        egl = load_egl() if self.name == "egl" else None
        with nothing_current(), self.context:
            if egl is not None and not egl.eglGetCurrentContext():
                raise LucidaError(
                    "backend",
                    "another OpenGL context is current in this thread, and EGL may not replace it",
                    "draw in that one (context=...), or from another thread",
                )
            yield self.context

    def release(self) -> None:
        self.context.release()


class OSMesa:
    """Mesa's off-screen software renderer, which needs no display, driver or device.

    Raises OSError if the library is missing, RuntimeError if it has no core 3.3 context.
    """

    name = "osmesa"

    def __init__(self) -> None:
        self._library = load_osmesa()
        attributes = (ctypes.c_int * len(_ATTRIBUTES))(*_ATTRIBUTES)
        self._handle = self._library.OSMesaCreateContextAttribs(attributes, None)
        if not self._handle:
            raise RuntimeError("libOSMesa has no OpenGL 3.3 core context")
        # OSMesa requires a default framebuffer in memory, though everything is drawn into textures.
        self._pixels = (ctypes.c_ubyte * 4)()
        with nothing_current(), self:
            loader: Any = self
            self.context = moderngl.create_context(require=330, context=loader)

    # moderngl's interface for a loader.

    def load_opengl_function(self, name: str) -> int:
        return self._library.OSMesaGetProcAddress(name.encode()) or 0

    def __enter__(self) -> OSMesa:
        if not self._library.OSMesaMakeCurrent(self._handle, self._pixels, _GL_UNSIGNED_BYTE, 1, 1):
            raise RuntimeError("OSMesaMakeCurrent failed")
        return self

    def __exit__(self, *_: object) -> None:
        self._library.OSMesaMakeCurrent(None, None, 0, 0, 0)

    def release(self) -> None:
        handle, self._handle = self._handle, None
        if handle:
            self._library.OSMesaDestroyContext(handle)

    @contextmanager
    def current(self) -> Iterator[moderngl.Context]:
        with nothing_current(), self:
            yield self.context


class WindowContext:
    """The context of a window, which is already current, and is not released here."""

    name = "window"

    def __init__(self, context: moderngl.Context) -> None:
        self.context = context

    @contextmanager
    def current(self) -> Iterator[moderngl.Context]:
        yield self.context

    def release(self) -> None:
        pass


def open_platform(
    backend: str = "auto", context: moderngl.Context | None = None
) -> Standalone | OSMesa | WindowContext:
    """Return a context to draw in. backend: "egl", "osmesa", or "auto": the first that works.

    context: a window's, current in this thread; backend is then ignored.
    Raises LucidaError naming the platforms tried and the packages to install, and also in a forked
    process whose parent has loaded the driver, which would wait for the parent's threads.
    """
    check_process()
    if context is not None:
        return WindowContext(context)
    if backend not in BACKENDS:
        raise LucidaError("backend", f"{backend!r} is unknown", f"give {', '.join(BACKENDS)}")
    tried, remedies = [], []
    for name in candidates() if backend == "auto" else (backend,):
        try:
            return OSMesa() if name == "osmesa" else Standalone(name)
        except Exception as error:  # each library reports a missing driver in its own way
            tried.append(f"{name}: {error}")
            remedies.append(remedy(name))
    problem = f"no OpenGL 3.3 context ({'; '.join(tried)})"
    raise LucidaError("backend", problem, " or ".join(remedies) + "; see `lucida doctor`")


def check_process() -> None:
    """Raise LucidaError in a process that was forked from one with OpenGL in use."""
    global _drivers_pid
    _drivers_pid = _drivers_pid or os.getpid()
    check_not_forked(_drivers_pid, "OpenGL", "was in use")


def is_inherited() -> bool:
    """Return True if the contexts here belong to the process that this one was forked from."""
    return _drivers_pid not in (None, os.getpid())


def candidates() -> tuple[str, ...]:
    """Return the platforms to try on this system, best first."""
    own = "default" if sys.platform in ("darwin", "win32") else "egl"
    return own, "osmesa"
