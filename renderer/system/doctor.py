"""Checks of the parts of Lucida on this machine, with remedies for those that fail.

Each check runs in its own process with a time limit, in case a driver crashes or hangs.
"""

from __future__ import annotations

import ctypes
import json
import locale
import os
import shutil
import subprocess
import sys
import sysconfig
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from ctypes.util import find_library
from dataclasses import dataclass
from importlib import import_module, metadata
from importlib.resources import files
from pathlib import Path

from lucida.renderer.raster.contexts import candidates
from lucida.renderer.raster.packages import remedy

from .child import child_command, interpreter

TIMEOUT_S = 60.0  # a driver's first compilation of shaders can take long


@dataclass(frozen=True)
class Check:
    """One part of the report.

    name: a key of PARTS. works: the result. detail: versions, or the reason of the failure.
    remedy: the solution for a failure; "" if it works.
    """

    name: str
    purpose: str
    works: bool
    detail: str
    remedy: str


def report(timeout_s: float = TIMEOUT_S) -> list[Check]:
    """Return all checks: the OpenGL platforms, best first, and then the other parts."""
    names = (*candidates(), *(name for name in PARTS if name not in PLATFORMS))
    with ThreadPoolExecutor(2) as pool:
        return list(pool.map(lambda name: check(name, timeout_s), names))


def can_draw(checks: list[Check]) -> bool:
    """Return True if an OpenGL platform works."""
    return any(check.works for check in checks if check.name in candidates())


def check(name: str, timeout_s: float = TIMEOUT_S) -> Check:
    """Run one check in its own process."""
    python = interpreter()
    if python is None:
        problem = "cannot be checked: this program has Python inside"
        return Check(name, PARTS[name].purpose, False, problem, "run `lucida doctor`")
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
    return Check(name, PARTS[name].purpose, works, detail, "" if works else remedy(name))


def _answer(done: subprocess.CompletedProcess[bytes]) -> tuple[bool, str]:
    """Return the result that the process printed last, or a message about its crash."""
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


# The checks of PARTS.


def _draws(backend: str) -> str:
    """Draw an image of one pixel."""
    from lucida.renderer.camera.camera import Camera
    from lucida.renderer.raster import Rasterizer
    from lucida.renderer.scene.model import Scene, SceneObject, Sphere

    scene = Scene((SceneObject(Sphere((0, 0, -3))),))
    with Rasterizer(scene, backend=backend) as rasterizer:
        if rasterizer.render(Camera(), (1, 1)).channel("id")[0, 0] != 0:
            raise RuntimeError(f"{rasterizer.platform} draws a wrong image")
        return rasterizer.platform.split(": ", 1)[1]


def _shows() -> str:
    """Query the X server, if there is one, without GLFW."""
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
        # The bundled GLFW does not support Wayland.
        return f"X11 {name}, through XWayland: a fractional scale of the desktop blurs it"
    return f"X11 {name}"


def _compiles() -> str:
    import numba

    from lucida.renderer.trace.compile.cache_folder import cache_folder, cache_problem

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


def _is_on_the_path() -> str:
    """Return where a terminal finds the command."""
    found = shutil.which("lucida")
    if found is None:
        folder = sysconfig.get_path("scripts")
        raise RuntimeError(f"the folder of this Python's commands, {folder}, is not on the PATH")
    return found


def _is_not_hidden() -> str:
    """Look for the user's files that a Python started in this folder imports in place of ours."""
    ours = Path(str(files("lucida"))).resolve()
    hiding = [
        str(file)
        for file in (Path("lucida.py"), Path("lucida", "__init__.py"))
        if file.exists() and not file.resolve().is_relative_to(ours)
    ]
    if hiding:
        raise RuntimeError(f"Python imports {' and '.join(hiding)} of this folder instead")
    return "no file in this folder hides the modules"


def _installed(package: str) -> str:
    """Return the version of an optional package that can be imported."""
    import_module(package)
    return f"{package} {metadata.version(package)}"


@dataclass(frozen=True)
class Part:
    """A part of Lucida that may not work here. packages.remedy(name) returns the remedy.

    check: returns versions or a path, or raises an exception with the problem.
    """

    purpose: str
    check: Callable[[], str]


PLATFORMS = {
    "egl": Part("draws without a window", lambda: _draws("egl")),
    "default": Part("draws without a window", lambda: _draws("auto")),
    "osmesa": Part("draws without a window, in software", lambda: _draws("osmesa")),
}
PARTS = PLATFORMS | {
    "display": Part("shows the window", _shows),
    "tracer": Part("compiles the ray tracer", _compiles),
    "formulas": Part("typesets formulas", _typesets),
    "films": Part("saves MP4", lambda: _installed("av")),
    "cluster": Part("draws films on several processes", lambda: _installed("distributed")),
    "widget": Part("explores scenes in notebooks", lambda: _installed("anywidget")),
    "command": Part("starts in a terminal", _is_on_the_path),
    "imports": Part("find Lucida's modules", _is_not_hidden),
}


def main(name: str) -> None:
    """Run one check and print its result as JSON: [works, detail]."""
    try:
        print(json.dumps([True, PARTS[name].check()]))
    except Exception as error:  # any error is the result
        print(json.dumps([False, getattr(error, "problem", "") or str(error) or repr(error)]))
