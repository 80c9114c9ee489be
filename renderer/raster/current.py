"""Unbind the thread's current OpenGL context temporarily, and restore it.

The functions of EGL, GLX and OSMesa that return their current contexts find it.
"""

from __future__ import annotations

import contextlib
import ctypes
import os
import sys
from collections.abc import Callable, Iterator
from functools import cache
from typing import Any

OSMESA_NAMES = (
    "libOSMesa.so.8",
    "libOSMesa.so.6",
    "libOSMesa.so",
    "osmesa.dll",
    "libOSMesa.dll",
    # Full paths, because macOS also searches the current folder for a bare name.
    "/opt/homebrew/lib/libOSMesa.8.dylib",
    "/opt/homebrew/lib/libOSMesa.dylib",
    "/usr/local/lib/libOSMesa.8.dylib",
    "/usr/local/lib/libOSMesa.dylib",
    "/opt/local/lib/libOSMesa.dylib",
)

# From the headers of EGL and OSMesa.
_EGL_DRAW, _EGL_READ = 0x3059, 0x305A
_OSMESA_TYPE = 0x23


@contextlib.contextmanager
def nothing_current() -> Iterator[None]:
    """Unbind another context (a window's, say) from this thread, and restore it afterwards.

    EGL, GLX and OSMesa share Mesa's dispatch table, but are unaware of each other. A context that
    is current in one library when another makes its own current stays broken, because its library
    sees no need to bind it again. OSMesa also mistakes it for its own.
    """
    with contextlib.ExitStack() as stack:
        for unbind in (_unbind_glx, _unbind_egl, _unbind_osmesa):
            if (restore := unbind()) is not None:
                stack.callback(restore)
        yield


# Each unbinds a library's current context, and returns a function to restore it, or None.


def _unbind_egl() -> Callable[[], Any] | None:
    egl = load_egl()
    before = egl.eglGetCurrentContext() if egl is not None else None
    if not before:
        return None
    display = egl.eglGetCurrentDisplay()
    surfaces = egl.eglGetCurrentSurface(_EGL_DRAW), egl.eglGetCurrentSurface(_EGL_READ)
    egl.eglMakeCurrent(display, None, None, None)
    return lambda: egl.eglMakeCurrent(display, *surfaces, before)


def _unbind_glx() -> Callable[[], Any] | None:
    glx = _glx()
    before = glx.glXGetCurrentContext() if glx is not None else None
    if not before:
        return None
    display = glx.glXGetCurrentDisplay()
    drawables = glx.glXGetCurrentDrawable(), glx.glXGetCurrentReadDrawable()
    glx.glXMakeContextCurrent(display, 0, 0, None)
    return lambda: glx.glXMakeContextCurrent(display, *drawables, before)


def _unbind_osmesa() -> Callable[[], Any] | None:
    library = load_osmesa() if load_osmesa.cache_info().currsize else None
    before = library.OSMesaGetCurrentContext() if library is not None else None
    if library is None or not before:
        return None
    width, height, kind = ctypes.c_int(), ctypes.c_int(), ctypes.c_int()
    pixels = ctypes.c_void_p()
    library.OSMesaGetColorBuffer(before, width, height, kind, pixels)
    library.OSMesaGetIntegerv(_OSMESA_TYPE, kind)
    library.OSMesaMakeCurrent(None, None, 0, 0, 0)
    size = width.value, height.value
    return lambda: library.OSMesaMakeCurrent(before, pixels, kind.value, *size)


@cache
def load_egl() -> Any:
    """Return libEGL; None if it is missing."""
    egl = _linux_library("EGL")
    if egl is not None:
        names = ("eglGetCurrentContext", "eglGetCurrentDisplay")
        _declare(egl, _POINTER, None, *names)
        _declare(egl, _POINTER, (_INT,), "eglGetCurrentSurface")
        _declare(egl, _INT, (_POINTER,) * 4, "eglMakeCurrent")
    return egl


@cache
def _glx() -> Any:
    glx = _linux_library("GL")
    if not hasattr(glx, "glXMakeContextCurrent"):  # also without a library
        return None
    drawable = ctypes.c_ulong
    _declare(glx, _POINTER, None, "glXGetCurrentContext", "glXGetCurrentDisplay")
    _declare(glx, drawable, None, "glXGetCurrentDrawable", "glXGetCurrentReadDrawable")
    _declare(glx, _INT, (_POINTER, drawable, drawable, _POINTER), "glXMakeContextCurrent")
    return glx


@cache
def load_osmesa() -> Any:
    """Return libOSMesa. Raises OSError if it is missing."""
    for name in filter(None, (found_library("OSMesa"), *OSMESA_NAMES)):
        try:
            library = ctypes.CDLL(name)
        except OSError:
            continue
        ints, byte = ctypes.POINTER(_INT), ctypes.c_ubyte
        _declare(library, _POINTER, (ints, _POINTER), "OSMesaCreateContextAttribs")
        make_current = _POINTER, _POINTER, ctypes.c_uint, _INT, _INT
        _declare(library, byte, make_current, "OSMesaMakeCurrent")
        _declare(library, _POINTER, (ctypes.c_char_p,), "OSMesaGetProcAddress")
        _declare(library, None, (_POINTER,), "OSMesaDestroyContext")
        _declare(library, _POINTER, None, "OSMesaGetCurrentContext")
        buffer = _POINTER, ints, ints, ints, ctypes.POINTER(_POINTER)
        _declare(library, byte, buffer, "OSMesaGetColorBuffer")
        _declare(library, None, (_INT, ints), "OSMesaGetIntegerv")
        return library
    raise OSError("libOSMesa is not installed")


_POINTER, _INT = ctypes.c_void_p, ctypes.c_int


def _declare(library: Any, result: Any, arguments: Any, *names: str) -> None:
    """Set the types of functions' results and arguments. arguments: None for none."""
    for name in names:
        function = getattr(library, name)
        function.restype, function.argtypes = result, arguments


def found_library(name: str) -> str | None:
    """Return the library that the system finds, unless it is in the current folder.

    On macOS and Windows, libraries have full paths, so a bare name is from the current folder.
    """
    is_linux = sys.platform.startswith("linux")
    if is_linux and (usual := _loaded(f"lib{name}.so.1")) is not None:
        return usual  # Linux's usual name avoids find_library(), which starts programs

    from ctypes.util import find_library

    found = find_library(name)
    return found if found is not None and (is_linux or os.path.isabs(found)) else None


def _loaded(name: str) -> str | None:
    """Return the name if a library with that name can be loaded."""
    try:
        ctypes.CDLL(name)
    except OSError:
        return None
    return name


def _linux_library(name: str) -> Any:
    found = found_library(name) if sys.platform.startswith("linux") else None
    try:
        return ctypes.CDLL(found) if found else None
    except OSError:
        return None
