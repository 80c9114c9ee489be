"""Where kernels' machine code is kept between runs.

Owns the cache folder. Needs no numba: whether kernels must be compiled is known before it is
imported.

numba's own cache looks at one file only: after an edit of intersect.py it would go on using the
kernel.py compiled before it. Here the cache folder is named by a hash of all the sources that
kernels are made of and of the versions that compile them, so stale code is never found.

The folder lies in NUMBA_CACHE_DIR if that is set, else in the user's cache folder, else beside
this package. What numba finds there it unpickles, and runs: a folder that others could write into
is passed over, and so is a relative one, which would be looked for beside the user's files.
"""

from __future__ import annotations

import hashlib
import logging
import os
import shutil
import sys
import tempfile
import time
from collections.abc import Iterator
from functools import cache
from importlib import import_module, metadata
from pathlib import Path

import platformdirs

import renderer.scene.flat
from renderer import shared_numbers
from renderer.errors import LucidaError
from renderer.private import private_folder

KEPT = 4  # folders of other sources or versions that stay
KEPT_FOR_S = 3600.0  # younger ones stay too: another process may be filling them
TRACE_FOLDER = Path(__file__).parents[1]  # the tracer's folder


def cache_folder() -> Path | None:
    """The folder for these sources and versions, made if need be; None: nowhere to write."""
    return find_cache_folder()[0]


def cache_problem() -> str:
    """Why a folder was passed over, for the user; "" if none was that could be written."""
    return find_cache_folder()[1]


@cache
def find_cache_folder() -> tuple[Path | None, str]:
    problem = ""
    for base in filter(Path.is_absolute, _bases()):
        try:
            folder = private_folder(base / source_hash())
        except LucidaError as error:
            if not problem:
                reason = f"{error.problem}; {error.remedy}"
                problem = f"compiled kernels are not kept in {base}: {reason}"
                logging.getLogger(__name__).warning("lucida: %s", problem)
            continue
        except (OSError, RuntimeError):  # RuntimeError: links in a circle, or no home
            continue
        if _writable(folder):
            prune(base, folder)
            return folder, problem
    return None, problem


def source_hash() -> str:
    """Names the code that is compiled: the tracer's sources and what they take from elsewhere,
    the scene's layout and the shared numbers; the versions, and how they are used."""
    sources = sorted(TRACE_FOLDER.rglob("*.py"))
    digest = hashlib.sha256()
    for path in (*sources, Path(renderer.scene.flat.__file__), Path(shared_numbers.__file__)):
        digest.update(path.name.encode() + b"\0" + path.read_bytes() + b"\0")
    versions = [_version(name) for name in ("numba", "llvmlite", "numpy")]
    for text in (sys.version, *versions):
        digest.update(text.encode() + b"\0")
    return digest.hexdigest()[:20]


def _version(package: str) -> str:
    """A package's version, without importing it."""
    try:
        return metadata.version(package)
    except metadata.PackageNotFoundError:  # in a bundle that leaves such files out
        return str(import_module(package).__version__)


def _bases() -> Iterator[Path]:
    # A folder of our own inside each: what is pruned must be ours. Not config.CACHE_DIR: that may
    # come from a file in the current folder.
    if given := os.environ.get("NUMBA_CACHE_DIR"):
        yield Path(given) / "lucida-kernels"
    yield Path(platformdirs.user_cache_dir("lucida", appauthor=False)) / "kernels"
    yield TRACE_FOLDER / "__pycache__" / "kernels"


def _writable(folder: Path) -> bool:
    try:
        folder.chmod(0o700)  # numba's folders inside it have the rights that the umask leaves
        with tempfile.TemporaryFile(dir=folder):  # with nothing in it: a full disk may be read
            pass
        os.utime(folder)  # the last use, for pruning
    except OSError:
        return False
    return True


def prune(base: Path, used: Path) -> None:
    """Removes folders of other sources, but the last few used."""
    try:
        others = [path for path in base.iterdir() if path.is_dir() and path != used]
        others.sort(key=lambda path: path.stat().st_mtime, reverse=True)
        for path in others[KEPT:]:
            if path.stat().st_mtime < time.time() - KEPT_FOR_S:
                shutil.rmtree(path, ignore_errors=True)
    except OSError:  # another process prunes too
        return
