"""A sandbox for the files that a scene names, and checks for files outside its folder.

A scene file may name a model anywhere: "../m.obj", "/home/m.obj", or a link that leads there.
Reading a file of another author stays inside its folder unless the user has agreed.
"""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterable, Iterator
from contextvars import ContextVar
from pathlib import Path

from lucida.renderer.scene.model import Scene
from lucida.renderer.system.cancelling import during
from lucida.renderer.system.errors import LucidaError

LISTED = 8  # files that an error names


class OutsideError(LucidaError):
    """A file names others outside its folder, to which the user has not agreed.
    files: their paths.
    """

    def __init__(self, source: str, files: tuple[Path, ...]) -> None:
        shown = ", ".join(map(str, files[:LISTED])) + ", ..." * (len(files) > LISTED)
        count = f"{len(files)} files" if len(files) > 1 else "a file"
        problem = f"names {count} outside of its folder: {shown}"
        super().__init__("", problem, "agree to that, or copy them into its folder", source)
        self.files = files


class Fence:
    """A sandbox around a folder. agreed: files outside it that may be read; None for all.

    outside: the files outside that were named so far.
    """

    def __init__(self, folder: Path, agreed: frozenset[Path] | None) -> None:
        self.folder, self.agreed = folder, agreed
        self.outside: dict[Path, None] = {}

    @property
    def refused(self) -> tuple[Path, ...]:
        agreed = self.outside if self.agreed is None else self.agreed
        return tuple(file for file in self.outside if file not in agreed)


_fence: ContextVar[Fence | None] = ContextVar("what may be read", default=None)


@contextlib.contextmanager
def kept_inside(source: Path, agreed: frozenset[Path] | None = frozenset()) -> Iterator[Fence]:
    """Require that files named during the block, on this thread, are in the folder of `source` or
    agreed to. Raises OutsideError.
    """
    fence = Fence(source.parent, agreed)
    try:
        with during(_fence, fence):
            yield fence
    except LucidaError:
        if fence.refused:
            raise OutsideError(str(source), fence.refused) from None
        raise


def check_inside(files: Iterable[Path]) -> None:
    """Raise LucidaError, for kept_inside(), if one of the files must not be read."""
    fence = _fence.get()
    if fence is None:
        return
    fence.outside |= dict.fromkeys(outside(files, fence.folder))
    if fence.refused:
        raise LucidaError("", "is outside of the folder", "copy it there", str(fence.refused[0]))


def outside(files: Iterable[Path], folder: Path) -> tuple[Path, ...]:
    """Return the files that are not in the folder or below it, after following links.

    The returned paths are absolute, with their links.
    """
    root = os.path.realpath(folder)
    found = (Path(os.path.abspath(file)) for file in files if not _is_inside(file, root))
    return tuple(dict.fromkeys(found))


def _is_inside(file: Path, root: str) -> bool:
    try:
        if os.name == "nt" and str(file).startswith("\\\\") and not root.startswith("\\\\"):
            return False  # on another machine, which must not be contacted
        return Path(os.path.realpath(file)).is_relative_to(root)
    except (OSError, ValueError):
        return True  # the error is reported when the file is read


def model_files(scene: Scene) -> tuple[Path, ...]:
    """Return the model files that the tables of a scene's file name."""
    origin = scene.origin
    if origin is None or origin.tables is None:
        return ()
    entries = origin.tables.get("objects", ())
    names = (entry["file"] for entry in entries if entry.get("type") == "model")
    return tuple(dict.fromkeys(origin.folder / name for name in names))
