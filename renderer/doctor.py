"""What of Lucida works on this machine, and what to install for the rest.

Owns the checks. Each runs in a process of its own with a time limit: a driver that crashes or hangs
takes nothing else with it. Knows nothing of how the report is shown.
"""

from __future__ import annotations

import ctypes
import json
import locale
import os
import subprocess
import sys
from collections.abc import Callable
from ctypes.util import find_library
from dataclasses import dataclass

from renderer.child import child_command, interpreter
from renderer.raster.contexts import candidates
from renderer.raster.packages import remedy

TIMEOUT_S = 60.0  # the first compilation of a driver's shaders can take long

PURPOSES = {
    "egl": "draws without a window",
    "default": "draws without a window",
    "osmesa": "draws without a window, in software",
    "display": "shows the window",
    "tracer": "compiles the ray tracer",
    "formulas": "typesets formulas",
}


@dataclass(frozen=True)
class Check:
    """One part of the report. name: a key of PURPOSES. works: whether it does. detail: versions, or
    why it does not work. remedy: what to do about that; "" where it works."""

    name: str
    purpose: str
    works: bool
    detail: str
    remedy: str


def report(timeout_s: float = TIMEOUT_S) -> list[Check]:
    """All checks: the OpenGL platforms first, best first; then display, tracer, formulas."""
    return [check(name, timeout_s) for name in (*candidates(), "display", "tracer", "formulas")]


def can_draw(checks: list[Check]) -> bool:
    """Whether an OpenGL platform works."""
    return any(check.works for check in checks if check.name in candidates())


def check(name: str, timeout_s: float = TIMEOUT_S) -> Check:
    """One check, in a process of its own."""
    python = interpreter()
    if python is None:
        problem = "cannot be checked: this program has Python inside"
        return Check(name, PURPOSES[name], False, problem, "run `lucida doctor`")
    try:
        done = subprocess.run(
            child_command(python, __name__, name),
            stdin=subprocess.DEVNULL,
            capture_output=True,
            timeout=timeout_s,
        )
    except subprocess.TimeoutExpired:
        works, detail = False, f"no answer within {timeout_s:g} s"
    except OSError as error:
        works, detail = False, str(error)
    else:
        works, detail = _answer(done)
    return Check(name, PURPOSES[name], works, detail, "" if works else remedy(name))


def _answer(done: subprocess.CompletedProcess[bytes]) -> tuple[bool, str]:
    """What the process said last; a crash says nothing."""
    if done.returncode == 0:
        try:
            works, detail = json.loads(done.stdout.decode().splitlines()[-1])
            return bool(works), " ".join(str(detail).split())
        except (ValueError, IndexError):
            pass
    if done.returncode < 0:
        return False, f"crashed (signal {-done.returncode})"
    last = done.stderr.decode(errors="replace").strip().splitlines()[-1:]
    return False, " ".join(["failed", *last])


# The checks themselves: each gives a detail, or raises an exception that tells what is wrong.


def _draws(backend: str) -> str:
    """Draws an image of one pixel."""
    from renderer.camera import Camera
    from renderer.raster import Rasterizer
    from renderer.scene.model import Scene, SceneObject, Sphere

    scene = Scene((SceneObject(Sphere((0, 0, -3))),))
    with Rasterizer(scene, backend=backend) as rasterizer:
        if rasterizer.render(Camera(), (1, 1)).channel("id")[0, 0] != 0:
            raise RuntimeError(f"{rasterizer.platform} draws a wrong image")
        return rasterizer.platform.split(": ", 1)[1]


def _shows() -> str:
    """Asks the X server, where there is one, without GLFW."""
    if not sys.platform.startswith("linux"):
        return "the system's own"
    name = os.environ.get("DISPLAY", "")
    if not name:
        wayland = os.environ.get("WAYLAND_DISPLAY")
        raise RuntimeError(
            "this Wayland session has no XWayland (DISPLAY is not set)"
            if wayland
            else "DISPLAY is not set; the window can still be saved with --screenshot"
        )
    library = find_library("X11")
    if library is None:
        raise RuntimeError("libX11 is not installed")
    x11 = ctypes.CDLL(library)
    x11.XOpenDisplay.restype = ctypes.c_void_p
    x11.XOpenDisplay.argtypes = (ctypes.c_char_p,)
    if not x11.XOpenDisplay(None):
        raise RuntimeError(f"the X server {name} does not answer")
    if os.environ.get("WAYLAND_DISPLAY"):
        # The bundle's GLFW has no Wayland of its own.
        return f"X11 {name}, through XWayland: a fractional scale of the desktop blurs it"
    return f"X11 {name}"


def _compiles() -> str:
    import numba

    from renderer.trace.compile.cache_folder import cache_folder, cache_problem

    affinity = getattr(os, "sched_getaffinity", None)
    cores = len(affinity(0)) if affinity else os.cpu_count() or 1
    kept = "" if cache_folder() else ", compiled anew in each process"
    problem = f": {cache_problem()}" if cache_problem() else ""
    cores_text = f"{cores} core{'s' if cores > 1 else ''}"
    return f"numba {numba.__version__}, {cores_text}{kept}{problem}"


def _typesets() -> str:
    for name in ("en_US.UTF-8", "en_US.utf8"):
        try:
            locale.setlocale(locale.LC_ALL, name)
        except locale.Error:
            continue
        return f"locale {name}"
    raise RuntimeError("the locale en_US.UTF-8 is missing; formulas are shown as plain text")


CHECKS: dict[str, Callable[[], str]] = {
    "egl": lambda: _draws("egl"),
    "default": lambda: _draws("auto"),
    "osmesa": lambda: _draws("osmesa"),
    "display": _shows,
    "tracer": _compiles,
    "formulas": _typesets,
}


def main(name: str) -> None:
    """Runs one check and prints its answer as JSON: [works, detail]."""
    try:
        print(json.dumps([True, CHECKS[name]()]))
    except Exception as error:  # whatever is wrong is the answer
        print(json.dumps([False, getattr(error, "problem", "") or str(error) or repr(error)]))
