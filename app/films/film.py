"""A film, or a large image, on its way: its pictures in a folder, and at last the one file.

What is there already is not drawn again, so that what was interrupted goes on. The folder is the
film itself (OUT/), or lies next to it until it is finished (OUT.frames). Its film.json says whose
pictures it holds.
"""

from __future__ import annotations

import hashlib
import json
import shutil
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import islice
from pathlib import Path

from app import __version__
from app.films.encoding import Writer
from app.films.frames import Look, Shot
from app.films.workers import drawn_by_workers, drawn_here, scene_digest
from renderer.atomic import atomic_write
from renderer.errors import LucidaError
from renderer.scene.model import Scene

_KEY = "film.json"
_ENCODING = 0.1  # of the progress


@dataclass(frozen=True, eq=False)
class Film:
    """Pictures to be drawn, and a file to be made of them.

    path: that file, or a folder. write: makes the file; None if it is a folder. names: of the
    pictures, without ending; none for their numbers.
    """

    path: Path
    scene: Scene
    shots: Sequence[Shot]
    look: Look
    write: Writer | None = None
    names: Sequence[str] = ()

    @property
    def folder(self) -> Path:
        return self.path if self.write is None else self.path.with_name(self.path.name + ".frames")

    @property
    def frames(self) -> list[Path]:
        names = self.names or [f"{number:06d}" for number in range(len(self.shots))]
        return [self.folder / f"{name}{self.look.ending}" for name in names]

    @property
    def key(self) -> str:
        """A digest of all that its pictures depend on."""
        digest = hashlib.sha256(scene_digest(self.scene).encode())
        digest.update(repr((__version__, replace(self.look, threads=None))).encode())
        for shot in self.shots:
            digest.update(repr(shot).encode())
        return digest.hexdigest()


def begin(film: Film) -> int:
    """Prepare the folder of frames. Return how many are there already.

    Raises LucidaError if the film cannot be written, or the folder holds anything else.
    """
    folder, key_file, key = film.folder, film.folder / _KEY, film.key
    try:
        folder.mkdir(exist_ok=True)
        known = json.loads(key_file.read_text("utf-8"))["film"] if key_file.exists() else ""
    except (OSError, ValueError, KeyError, TypeError) as error:
        reason = getattr(error, "strerror", None) or "it is no folder of frames"
        problem = f"cannot be used: {reason}"
        raise LucidaError("", problem, "give another name", str(folder)) from None
    if known != key:
        others = {*folder.iterdir()} - {key_file}
        if others and (film.write is None or not known):
            problem = "holds something else than these pictures"
            raise LucidaError("", problem, "give another name, or remove it", str(folder))
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
    missing = {n: film.shots[n] for n, frame in enumerate(frames) if not frame.exists()}
    drawing = 1.0 if film.write is None else 1 - _ENCODING
    if workers > 1 or scheduler:
        drawn = drawn_by_workers(film.scene, film.look, missing, workers, scheduler)
    else:
        drawn = drawn_here(film.scene, film.look, missing)
    done = len(frames) - len(missing)
    for number, content in islice(drawn, len(missing)):
        with atomic_write(frames[number]) as file:
            file.write(content)
        done += 1
        progress(drawing * done / len(frames))
    if film.write is None:
        return
    for part in film.write(film.path, frames):
        progress(drawing + _ENCODING * part)
    shutil.rmtree(film.folder)
