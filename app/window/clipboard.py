"""Copy a picture to the system's clipboard: by wl-copy or xclip on Linux, osascript on macOS, the
Win32 API on Windows. GLFW's clipboard holds text only.
"""

from __future__ import annotations

import io
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

from lucida.renderer.system.errors import LucidaError

TIMEOUT_S = 10.0


def copy_png(data: bytes) -> None:
    """Put a PNG file's content into the clipboard as an image. Raises LucidaError, with the program
    to install.
    """
    if sys.platform == "darwin":
        _copy_macos(data)
    elif sys.platform == "win32":
        _copy_windows(data)
    else:
        _copy_linux(data)


def linux_command() -> list[str]:
    """Return the command that takes an image on its standard input. Raises LucidaError."""
    wayland = bool(os.environ.get("WAYLAND_DISPLAY"))
    if wayland and shutil.which("wl-copy"):
        return ["wl-copy", "--type", "image/png"]
    if os.environ.get("DISPLAY") and shutil.which("xclip"):
        return ["xclip", "-selection", "clipboard", "-t", "image/png"]
    package = "wl-clipboard" if wayland else "xclip"
    raise LucidaError(
        "clipboard",
        "no program that puts a picture into it",
        f"install {package}, or save the picture to a file",
    )


def _copy_linux(data: bytes) -> None:
    # Both programs stay behind as the clipboard's owner: their output must not keep us.
    _run(linux_command(), data)


def _copy_macos(data: bytes) -> None:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "picture.png"
        path.write_bytes(data)
        script = f'set the clipboard to (read (POSIX file "{path}") as «class PNGf»)'
        _run(["osascript", "-e", script], b"")


def _run(command: list[str], data: bytes) -> None:
    try:
        subprocess.run(
            command,
            input=data,
            check=True,
            timeout=TIMEOUT_S,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
    except (OSError, subprocess.SubprocessError) as error:
        raise LucidaError(
            "clipboard", f"{command[0]} failed: {error}", "save the picture to a file"
        ) from None


def _copy_windows(data: bytes) -> None:
    """Copy a device-independent bitmap: a BMP file without its file header."""
    from PIL import Image

    buffer = io.BytesIO()
    Image.open(io.BytesIO(data)).convert("RGB").save(buffer, format="BMP")
    _set_clipboard_windows(buffer.getvalue()[14:])


def _set_clipboard_windows(bitmap: bytes) -> None:
    import ctypes

    windll: Any = getattr(ctypes, "windll")  # noqa: B009 - only there on Windows
    user32, kernel32 = windll.user32, windll.kernel32
    kernel32.GlobalAlloc.restype = kernel32.GlobalLock.restype = ctypes.c_void_p
    kernel32.GlobalAlloc.argtypes = (ctypes.c_uint, ctypes.c_size_t)
    kernel32.GlobalLock.argtypes = kernel32.GlobalUnlock.argtypes = (ctypes.c_void_p,)
    user32.SetClipboardData.argtypes = (ctypes.c_uint, ctypes.c_void_p)
    movable, dib = 0x0002, 8
    if not user32.OpenClipboard(None):
        raise LucidaError("clipboard", "another program holds it", "try again")
    try:
        user32.EmptyClipboard()
        handle = kernel32.GlobalAlloc(movable, len(bitmap))
        pointer = kernel32.GlobalLock(handle) if handle else None
        if not pointer:
            raise LucidaError("clipboard", "has no memory for the picture", "save it to a file")
        ctypes.memmove(pointer, bitmap, len(bitmap))
        kernel32.GlobalUnlock(handle)
        user32.SetClipboardData(dib, handle)
    finally:
        user32.CloseClipboard()
