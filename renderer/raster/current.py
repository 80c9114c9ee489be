"""The thread's current OpenGL context: unbound temporarily, and restored.

Uses the functions of EGL, GLX and OSMesa that return their current contexts.
"""

from __future__ import annotations

import contextlib
import ctypes
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from typing import Any

OSMESA_NAMES = (
    "libOSMesa.so.8",
    "libOSMesa.so.6",
    "libOSMesa.so",
    "osmesa.dll",
    "libOSMesa.dll",
    # With their folders: macOS also searches the current folder for a bare name.
    "/opt/homebrew/lib/libOSMesa.8.dylib",
    "/opt/homebrew/lib/libOSMesa.dylib",
    "/usr/local/lib/libOSMesa.8.dylib",
    "/usr/local/lib/libOSMesa.dylib",
    "/opt/local/lib/libOSMesa.dylib",
)

# From the headers of EGL and OSMesa.
_EGL_DRAW, _EGL_READ = 0x3059, 0x305A
_OSMESA_TYPE = 0x23


@contextmanager
def nothing_current() -> Iterator[None]:
    """Unbind another context (a window's, say) from this thread, and restore it afterwards.

    EGL, GLX and OSMesa share Mesa's dispatch table, but do not know of each other. If a context of
    one library is still current while another's is made current, it stays broken, since its library
    sees no reason to bind it again. OSMesa also mistakes it for its own.
    """
    with _without_glx(), _without_egl(), _without_osmesa():
        yield


@contextmanager
def _without_egl() -> Iterator[None]:
    egl = load_egl()
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
def _without_glx() -> Iterator[None]:
    glx = _glx()
    before = glx.glXGetCurrentContext() if glx is not None else None
    if not before:
        yield
        return
    display = glx.glXGetCurrentDisplay()
    drawables = glx.glXGetCurrentDrawable(), glx.glXGetCurrentReadDrawable()
    glx.glXMakeContextCurrent(display, 0, 0, None)
    try:
        yield
    finally:
        glx.glXMakeContextCurrent(display, *drawables, before)


@contextmanager
def _without_osmesa() -> Iterator[None]:
    library = load_osmesa() if load_osmesa.cache_info().currsize else None
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
def load_egl() -> Any:
    """Return libEGL; None if it is missing."""
    egl = _linux_library("EGL")
    if egl is not None:
        pointer = ctypes.c_void_p
        for function in ("eglGetCurrentContext", "eglGetCurrentDisplay", "eglGetCurrentSurface"):
            getattr(egl, function).restype = pointer
        egl.eglGetCurrentSurface.argtypes = (ctypes.c_int,)
        egl.eglMakeCurrent.argtypes = (pointer,) * 4
    return egl


@cache
def _glx() -> Any:
    glx = _linux_library("GL")
    if not hasattr(glx, "glXMakeContextCurrent"):  # also if there is no library
        return None
    pointer, drawable = ctypes.c_void_p, ctypes.c_ulong
    for function in ("glXGetCurrentContext", "glXGetCurrentDisplay"):
        getattr(glx, function).restype = pointer
    for function in ("glXGetCurrentDrawable", "glXGetCurrentReadDrawable"):
        getattr(glx, function).restype = drawable
    glx.glXMakeContextCurrent.argtypes = (pointer, drawable, drawable, pointer)
    return glx


@cache
def load_osmesa() -> Any:
    """Return libOSMesa. Raises OSError if it is missing."""
    names = (found_library("OSMesa"), *OSMESA_NAMES)
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


def found_library(name: str) -> str | None:
    """Return the library that the system finds, unless it is in the current folder.

    On macOS and Windows, libraries have full paths, so a bare name is from the current folder.
    """
    is_linux = sys.platform.startswith("linux")
    if is_linux and (usual := _loaded(f"lib{name}.so.1")) is not None:
        return usual  # Linux's usual name: find_library() would start programs

    from ctypes.util import find_library

    found = find_library(name)
    return found if found is not None and (is_linux or os.path.isabs(found)) else None


def _loaded(name: str) -> str | None:
    """Return the name if a library with that name can be loaded."""
    with contextlib.suppress(OSError):
        ctypes.CDLL(name)
        return name
    return None


def _linux_library(name: str) -> Any:
    found = found_library(name) if sys.platform.startswith("linux") else None
    try:
        return ctypes.CDLL(found) if found else None
    except OSError:
        return None
