"""A film or a large image, made of pictures in a folder.

Pictures whose files exist are not drawn again, so the command continues after a break. The folder
is the film itself (OUT/), or is next to OUT until that file is finished (OUT.frames).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from itertools import islice
from pathlib import Path

from lucida.renderer.scene.model import Scene
from lucida.renderer.system.atomic import atomic_write
from lucida.renderer.system.errors import LucidaError

from .encoding import Writer
from .frames import Look, Shot
from .workers import drawn_by_workers, drawn_here

_ENCODING = 0.1  # its share of the progress


@dataclass(frozen=True, eq=False)
class Film:
    """Pictures to be drawn, and a file to be made of them.

    path: that file, or a folder. write: makes the file; None if it is a folder.
    """

    path: Path
    scene: Scene
    shots: Sequence[Shot]
    look: Look
    write: Writer | None = None

    @property
    def folder(self) -> Path:
        return self.path if self.write is None else self.path.with_name(self.path.name + ".frames")

    @property
    def frames(self) -> list[Path]:
        numbers = range(len(self.shots))
        return [self.folder / f"{number:06d}{self.look.ending}" for number in numbers]


def begin(film: Film) -> int:
    """Make the folder of the frames. Return the number of existing ones.

    Raises LucidaError if the folder cannot be made.
    """
    try:
        film.folder.mkdir(exist_ok=True)
    except OSError as error:
        problem = f"cannot be made: {(error.strerror or str(error)).lower()}"
        raise LucidaError("", problem, "give another name", str(film.folder)) from None
    return sum(frame.exists() for frame in film.frames)


def make(
    film: Film,
    workers: int = 1,
    scheduler: str = "",
    progress: Callable[[float], None] = lambda _: None,
) -> None:
    """Draw what is missing, and write the file. begin() must have been called.

    workers: the number of processes; scheduler: a Dask scheduler's address, for many machines.
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
    for frame in frames:
        frame.unlink()
    with suppress(OSError):  # it holds other files
        film.folder.rmdir()
