"""Read folders, within limits, for the window's own file dialog."""

from __future__ import annotations

import os
import string
import sys
from dataclasses import dataclass
from pathlib import Path

MOST_ENTRIES = 5000


@dataclass(frozen=True)
class FolderContent:
    """A folder's content: folders first, then files, by name. error: the reason if it cannot be
    read.
    """

    folder: Path
    folders: tuple[str, ...] = ()
    files: tuple[str, ...] = ()
    error: str = ""
    cut: bool = False  # there was more than MOST_ENTRIES


def read_folder(folder: Path, endings: tuple[str, ...] = ()) -> FolderContent:
    """Read a folder, without hidden files. endings: of the files to list; none for all."""
    folders, files, cut = [], [], False
    try:
        with os.scandir(folder) as entries:
            for count, entry in enumerate(entries):
                if count >= MOST_ENTRIES:
                    cut = True
                    break
                if entry.name.startswith("."):
                    continue
                if _is_folder(entry):
                    folders.append(entry.name)
                elif not endings or entry.name.lower().endswith(endings):
                    files.append(entry.name)
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
        return FolderContent(folder, error=reason[:1].lower() + reason[1:])
    folders.sort(key=str.lower)
    files.sort(key=str.lower)
    return FolderContent(folder, tuple(folders), tuple(files), cut=cut)


def starting_points() -> list[tuple[str, Path]]:
    """Return names and folders to start from: home, its usual folders, and the disks."""
    points = []
    try:
        home = Path.home()
        points = [("Home", home)]
        points += [
            (name, home / name)
            for name in ("Desktop", "Documents", "Downloads", "Pictures")
            if (home / name).is_dir()
        ]
    except (OSError, RuntimeError):
        pass
    points.append(("Here", Path.cwd()))
    if sys.platform == "win32":
        disks = [Path(f"{letter}:\\") for letter in string.ascii_uppercase]
        points += [(str(disk), disk) for disk in disks if disk.exists()]
    else:
        points.append(("Computer", Path("/")))
    return points


def _is_folder(entry: os.DirEntry[str]) -> bool:
    try:
        return entry.is_dir()
    except OSError:
        return False
