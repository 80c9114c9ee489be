"""Native Embree: embree.cpp, which asks it in C++ without Python's detours, as one more peer.

Owns how that is compiled (once, into build/bench) and called. It is left out where there is no C++
compiler or Embree's headers are not installed.
"""

from __future__ import annotations

import ctypes
import hashlib
import os
import shutil
import subprocess
from pathlib import Path
from typing import Any

import numpy as np

from lucida.renderer.camera.camera import Camera
from lucida.renderer.camera.image_plane import Size
from tools.benchmarks.meshes import Faces, Vertices
from tools.benchmarks.peers import Hits, Peer, processors

SOURCE = Path(__file__).with_suffix(".cpp")
FOLDER = Path(__file__).resolve().parents[2] / "build" / "bench"
FLAGS = ("-std=c++17", "-O3", "-march=native", "-fno-math-errno", "-shared", "-fPIC", "-pthread")
MEDIUM = 1  # RTCBuildQuality
FLOATS = ctypes.POINTER(ctypes.c_float)


class CameraStruct(ctypes.Structure):
    """Camera of embree.cpp."""

    _fields_ = [
        *((name, ctypes.c_float * 3) for name in ("eye", "u", "v", "forward")),
        *((name, ctypes.c_float) for name in ("left", "top", "dx", "dy")),
        *((name, ctypes.c_int) for name in ("width", "height", "parallel")),
    ]


class ImageStruct(ctypes.Structure):
    """Image of embree.cpp."""

    _fields_ = [("t", FLOATS), ("primitive", ctypes.POINTER(ctypes.c_int)), ("normal", FLOATS)]


class NativeEmbree(Peer):
    """rtcIntersect16 on coherent packets of 4x4 pixels. Not robust: in Embree's faster mode, rays
    may slip between triangles."""

    name = "Embree (C++)"

    def __init__(self, threads: int | None = None) -> None:
        self._library = _library()
        self._settings = (threads or processors(), MEDIUM, 0)  # 0: not robust
        self._embree: int | None = None
        self._answer: tuple[np.ndarray, ...] = ()
        self._ways: tuple[Any, np.ndarray] = (None, np.empty(0))

    @classmethod
    def version(cls) -> str:
        return str(_library().embree_version().decode())

    def prepare(self, vertices: Vertices, faces: Faces) -> None:
        v, f = np.ascontiguousarray(vertices, np.float32), np.ascontiguousarray(faces, np.uint32)
        mesh = (v.ctypes.data, len(v), f.ctypes.data, len(f))
        self._embree = self._library.embree_new(*map(ctypes.c_size_t, mesh), *self._settings)
        if not self._embree:
            raise RuntimeError("Embree could not build the scene")

    def trace(self, camera: Camera, size: Size) -> Any:
        width, height = size
        left, right, bottom, top = camera.viewport
        away = 1.0 if camera.is_parallel else camera.distance
        forward = [-away * component for component in camera.w]
        struct = CameraStruct(
            *((ctypes.c_float * 3)(*part) for part in (camera.eye, camera.u, camera.v, forward)),
            *(left, top, (right - left) / width, (bottom - top) / height),
            *(width, height, camera.is_parallel),
        )
        answer, image = self._image(width * height)
        ways = (
            None if camera.lens is None else self._directions(camera, size).ctypes.data_as(FLOATS)
        )
        self._library.embree_image(self._embree, ctypes.byref(struct), ways, image)
        return answer

    def read(self, answer: Any) -> Hits:
        return Hits(*(part.copy() for part in answer))

    def close(self) -> None:
        if self._embree is not None:
            self._library.embree_free(self._embree)
            self._embree = None

    def _directions(self, camera: Camera, size: Size) -> np.ndarray:
        """The rays of the last camera with a lens, ready-made: their making is not timed."""
        if self._ways[0] != (camera, size):
            ways = np.nan_to_num(camera.rays(size).direction)  # those outside of it: no direction
            self._ways = (camera, size), ways.astype(np.float32)
        return self._ways[1]

    def _image(self, count: int) -> tuple[tuple[np.ndarray, ...], ImageStruct]:
        """The arrays of the last answer again: their pages are there already."""
        if not self._answer or len(self._answer[0]) != count:
            self._answer = (
                np.empty(count, np.float32),
                np.empty(count, np.int32),
                np.empty((count, 3), np.float32),
            )
        kinds = (ctypes.c_float, ctypes.c_int, ctypes.c_float)
        pointers = (
            part.ctypes.data_as(ctypes.POINTER(kind))
            for part, kind in zip(self._answer, kinds, strict=True)
        )
        return self._answer, ImageStruct(*pointers)


def _library() -> ctypes.CDLL:
    """embree.cpp, compiled if it has changed. Raises ImportError with the remedy."""
    library = ctypes.CDLL(str(compiled(SOURCE, FOLDER)))
    pointer = ctypes.c_void_p
    library.embree_version.restype = ctypes.c_char_p
    library.embree_new.restype = pointer
    library.embree_free.argtypes = [pointer]
    library.embree_image.argtypes = [pointer, pointer, FLOATS, ImageStruct]
    return library


def compiled(source: Path, folder: Path) -> Path:
    """The shared library made of the source, with Embree 4 or else 3. Raises ImportError."""
    compiler = os.environ.get("CXX") or shutil.which("c++") or shutil.which("g++")
    if compiler is None:
        raise ImportError("no C++ compiler; install the system's g++ and libembree-dev")
    mark = hashlib.sha256(source.read_bytes() + " ".join((compiler, *FLAGS)).encode())
    made = folder / f"embree-{mark.hexdigest()[:12]}.so"
    if made.exists():
        return made
    folder.mkdir(parents=True, exist_ok=True)
    unfinished = made.with_suffix(f".{os.getpid()}")
    for version in (4, 3):
        command = [compiler, *FLAGS, f"-DEMBREE={version}", str(source), f"-lembree{version}"]
        done = subprocess.run([*command, "-o", str(unfinished)], capture_output=True, text=True)
        if not done.returncode:
            return unfinished.replace(made)
    errors = [line for line in done.stderr.splitlines() if "error" in line] or ["unknown reason"]
    raise ImportError(f"{errors[0]}; install the system's libembree-dev")
