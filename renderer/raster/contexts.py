"""OpenGL contexts without a window: which platforms there are, and how one is made current.

Owns the choice of platform (EGL, OSMesa, the system's default) and the passage of "current" from
one context to another. Knows nothing of scenes, shaders or windows: a window's context is passed
in.
"""

from __future__ import annotations

import ctypes
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from ctypes.util import find_library
from functools import cache
from typing import Any, Protocol

import moderngl

from renderer.errors import LucidaError
from renderer.raster.packages import remedy

BACKENDS = ("auto", "egl", "osmesa")
OSMESA_NAMES = (
    "libOSMesa.so.8",
    "libOSMesa.so.6",
    "libOSMesa.so",
    "libOSMesa.8.dylib",
    "libOSMesa.dylib",
    "osmesa.dll",
    "libOSMesa.dll",
)

# Names of the OSMesa and GL headers.
_ATTRIBUTES = {
    "OSMESA_FORMAT": (0x22, 0x1908),  # OSMESA_RGBA
    "OSMESA_DEPTH_BITS": (0x30, 24),
    "OSMESA_PROFILE": (0x33, 0x34),  # OSMESA_CORE_PROFILE
    "OSMESA_CONTEXT_MAJOR_VERSION": (0x36, 3),
    "OSMESA_CONTEXT_MINOR_VERSION": (0x37, 3),
}
_GL_UNSIGNED_BYTE = 0x1401
_EGL_DRAW, _EGL_READ = 0x3059, 0x305A
_OSMESA_TYPE = 0x23


class Platform(Protocol):
    """A way to an OpenGL context. name: for messages. context: moderngl's side of it."""

    name: str
    context: moderngl.Context

    def current(self) -> Any:
        """A context manager inside which this context is the thread's current one; whatever was
        current before is so again afterwards."""

    def release(self) -> None: ...


class Standalone:
    """A context that moderngl itself makes: EGL, or the default of macOS and Windows."""

    def __init__(self, name: str) -> None:
        self.name = name
        settings: dict[str, Any] = {"backend": "egl"} if name == "egl" else {}
        with _nothing_current():
            self.context = moderngl.create_context(standalone=True, require=330, **settings)
            self.context.__exit__(None, None, None)

    @contextmanager
    def current(self) -> Iterator[moderngl.Context]:
        egl = _egl() if self.name == "egl" else None
        with _nothing_current(), self.context:
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
    """Mesa's off-screen software renderer: no display, no driver, no device.

    Raises OSError where the library is missing, RuntimeError where it gives no core 3.3 context.
    """

    name = "osmesa"

    def __init__(self) -> None:
        self._library = _load_osmesa()
        pairs = [number for pair in _ATTRIBUTES.values() for number in pair]
        attributes = (ctypes.c_int * (len(pairs) + 1))(*pairs, 0)
        self._handle = self._library.OSMesaCreateContextAttribs(attributes, None)
        if not self._handle:
            raise RuntimeError("libOSMesa gives no OpenGL 3.3 core context")
        # OSMesa insists on a default framebuffer in memory; everything is drawn into textures.
        self._pixels = (ctypes.c_ubyte * 4)()
        with _nothing_current(), self:
            loader: Any = self
            self.context = moderngl.create_context(require=330, context=loader)

    # What moderngl asks of a loader.

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
        with _nothing_current(), self:
            yield self.context


class Window:
    """The context of a window that is current already, and that stays its owner's."""

    name = "window"

    def __init__(self, context: moderngl.Context) -> None:
        self.context = context

    @contextmanager
    def current(self) -> Iterator[moderngl.Context]:
        yield self.context

    def release(self) -> None:
        pass


def open_platform(backend: str = "auto", context: moderngl.Context | None = None) -> Platform:
    """A context to draw in. backend: "egl", "osmesa", or "auto": the first that works.

    context: a window's, current in this thread; then backend is not looked at.
    Raises LucidaError naming what was tried and what to install.
    """
    if context is not None:
        return Window(context)
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


def candidates() -> tuple[str, ...]:
    """The platforms to try on this system, best first."""
    own = "default" if sys.platform in ("darwin", "win32") else "egl"
    return own, "osmesa"


@cache
def _load_osmesa() -> Any:
    names = (find_library("OSMesa"), *OSMESA_NAMES)
    for name in filter(None, names):
        try:
            library: Any = ctypes.CDLL(name)
        except OSError:
            continue
        pointer, integer = ctypes.c_void_p, ctypes.c_int
        library.OSMesaCreateContextAttribs.restype = pointer
        library.OSMesaCreateContextAttribs.argtypes = (ctypes.POINTER(integer), pointer)
        library.OSMesaMakeCurrent.restype = ctypes.c_ubyte
        library.OSMesaMakeCurrent.argtypes = (pointer, pointer, ctypes.c_uint, integer, integer)
        library.OSMesaGetProcAddress.restype = pointer
        library.OSMesaGetProcAddress.argtypes = (ctypes.c_char_p,)
        library.OSMesaDestroyContext.restype = None
        library.OSMesaDestroyContext.argtypes = (pointer,)
        library.OSMesaGetCurrentContext.restype = pointer
        numbers = (ctypes.POINTER(integer),) * 3
        library.OSMesaGetColorBuffer.argtypes = (pointer, *numbers, ctypes.POINTER(pointer))
        library.OSMesaGetIntegerv.argtypes = (integer, ctypes.POINTER(integer))
        return library
    raise OSError("libOSMesa is not installed")


@contextmanager
def _nothing_current() -> Iterator[None]:
    """Takes another context (a window's, say) off this thread, and puts it back afterwards.

    EGL and OSMesa share Mesa's dispatch table without telling each other: an EGL context that is
    still current while OSMesa is made current stays broken: EGL sees no reason to bind it again.
    """
    with _without_egl(), _without_osmesa():
        yield


@contextmanager
def _without_egl() -> Iterator[None]:
    egl = _egl()
    before = egl.eglGetCurrentContext() if egl is not None else None
    if not before:
        yield
        return
    display = egl.eglGetCurrentDisplay()
    surfaces = egl.eglGetCurrentSurface(_EGL_DRAW), egl.eglGetCurrentSurface(_EGL_READ)
    egl.eglMakeCurrent(display, None, None, None)
    try:
        yield
    finally:
        egl.eglMakeCurrent(display, *surfaces, before)


@contextmanager
def _without_osmesa() -> Iterator[None]:
    library = _load_osmesa() if _load_osmesa.cache_info().currsize else None
    before = library.OSMesaGetCurrentContext() if library is not None else None
    if library is None or not before:
        yield
        return
    width, height, kind = ctypes.c_int(), ctypes.c_int(), ctypes.c_int()
    pixels = ctypes.c_void_p()
    library.OSMesaGetColorBuffer(before, width, height, kind, pixels)
    library.OSMesaGetIntegerv(_OSMESA_TYPE, kind)
    library.OSMesaMakeCurrent(None, None, 0, 0, 0)
    try:
        yield
    finally:
        library.OSMesaMakeCurrent(before, pixels, kind.value, width.value, height.value)


@cache
def _egl() -> Any:
    name = find_library("EGL") if sys.platform.startswith("linux") else None
    if name is None:
        return None
    try:
        egl: Any = ctypes.CDLL(name)
    except OSError:
        return None
    pointer = ctypes.c_void_p
    for function in ("eglGetCurrentContext", "eglGetCurrentDisplay", "eglGetCurrentSurface"):
        getattr(egl, function).restype = pointer
    egl.eglGetCurrentSurface.argtypes = (ctypes.c_int,)
    egl.eglMakeCurrent.argtypes = (pointer,) * 4
    return egl
