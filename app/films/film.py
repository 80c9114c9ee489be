"""A film on its way: its frames as PNGs in a folder, and at last the one file.

What is there already is not drawn again, so that a film that was interrupted goes on. The folder
is the film itself (OUT/), or lies next to it until it is finished (OUT.frames).
"""

from __future__ import annotations

import hashlib
import json
import shutil
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import islice
from pathlib import Path

import numpy as np

from app import __version__
from app.films.encoding import check_film, encode
from app.films.frames import Look
from app.films.workers import drawn_by_workers, drawn_here
from renderer.atomic import atomic_write
from renderer.camera import Camera
from renderer.errors import LucidaError
from renderer.scene.flat import flatten
from renderer.scene.model import Scene

_KEY = "film.json"
_ENCODING = 0.1  # of the progress


@dataclass(frozen=True, eq=False)
class Film:
    """A film to be made. path: a file, or a folder without an ending. cameras: of its frames."""

    path: Path
    scene: Scene
    cameras: Sequence[Camera]
    look: Look
    fps: float

    @property
    def is_folder(self) -> bool:
        return not self.path.suffix

    @property
    def folder(self) -> Path:
        return self.path if self.is_folder else self.path.with_name(self.path.name + ".frames")

    @property
    def frames(self) -> list[Path]:
        return [self.folder / f"{number:06d}.png" for number in range(len(self.cameras))]

    @property
    def key(self) -> str:
        """A digest of all that its frames depend on."""
        digest = hashlib.sha256()
        for array in flatten(self.scene):
            digest.update(f"{array.dtype}{array.shape}".encode())
            digest.update(np.ascontiguousarray(array).data)
        digest.update(repr((__version__, replace(self.look, threads=None))).encode())
        for camera in self.cameras:
            digest.update(repr(camera).encode())
        return digest.hexdigest()


def begin(film: Film) -> int:
    """Prepare the folder of frames. Return how many are there already.

    Raises LucidaError if the film cannot be written, or the folder holds anything else.
    """
    if not film.is_folder:
        check_film(film.path, film.look.frame_size, film.fps)
    folder, key_file, key = film.folder, film.folder / _KEY, film.key
    try:
        folder.mkdir(exist_ok=True)
        known = json.loads(key_file.read_text("utf-8"))["film"] if key_file.exists() else ""
    except (OSError, ValueError, KeyError, TypeError) as error:
        reason = getattr(error, "strerror", None) or "it is no folder of frames"
        raise LucidaError("-o", f"{folder} cannot be used: {reason}", "give another name") from None
    if known != key:
        others = {*folder.iterdir()} - {key_file}
        if others and (film.is_folder or not known):
            problem = f"{folder} holds something else than this film's frames"
            raise LucidaError("-o", problem, "give another name, or remove it")
        for other in others:
            other.unlink()
        with atomic_write(key_file) as file:
            file.write(json.dumps({"film": key}).encode())
    return sum(frame.exists() for frame in film.frames)


def make(
    film: Film,
    workers: int = 1,
    scheduler: str = "",
    progress: Callable[[float], None] = lambda _: None,
) -> None:
    """Draw what is missing, and write the file. begin() must have been called.

    workers: the number of processes; scheduler: the address of Dask's, for many machines.
    progress: called with the finished part, 0 to 1. Raises LucidaError.
    """
    frames = film.frames
    missing = {n: film.cameras[n] for n, frame in enumerate(frames) if not frame.exists()}
    drawing = 1.0 if film.is_folder else 1 - _ENCODING
    if workers > 1 or scheduler:
        drawn = drawn_by_workers(film.scene, film.look, missing, workers, scheduler)
    else:
        drawn = drawn_here(film.scene, film.look, missing)
    done = len(frames) - len(missing)
    for number, png in islice(drawn, len(missing)):
        with atomic_write(frames[number]) as file:
            file.write(png)
        done += 1
        progress(drawing * done / len(frames))
    if film.is_folder:
        (film.folder / _KEY).unlink()
        return
    for part in encode(film.path, frames, film.fps):
        progress(drawing + _ENCODING * part)
    shutil.rmtree(film.folder)
