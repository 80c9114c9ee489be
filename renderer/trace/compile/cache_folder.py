"""The cache folder for kernels' machine code.

This module does not need numba, so the need to compile is known before numba is imported.

numba's own cache checks only one file, so it would still use the old kernel.py after an edit of
intersect.py. This cache folder is named by a hash of all the kernels' sources and of the compilers'
versions, so stale code is never found.

The folder is in NUMBA_CACHE_DIR if that is set, otherwise in the user's cache folder, otherwise
inside this package. numba unpickles and runs the files in it. A folder that others can write to is
therefore skipped, and so is a relative one, which would depend on the current folder.
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

import llvmlite.binding as llvm
import platformdirs

import lucida.renderer.scene.flat
from lucida.renderer.images import shared_numbers
from lucida.renderer.system.errors import LucidaError
from lucida.renderer.system.private_folder import private_folder

KEPT = 4  # folders of other sources or versions to keep
KEPT_FOR_S = 3600.0  # younger ones are also kept, since another process may be writing them
TRACE_FOLDER = Path(__file__).parents[1]  # the tracer's folder


def cache_folder() -> Path | None:
    """Return the folder for these sources and versions, created if necessary; None if no folder is
    writable.
    """
    return find_cache_folder()[0]


def cache_problem() -> str:
    """Return a message about a skipped folder; "" if no writable folder was skipped."""
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
        except (OSError, RuntimeError):  # RuntimeError: a symlink loop, or no home folder
            continue
        if _writable(folder):
            prune(base, folder)
            return folder, problem
    return None, problem


def source_hash() -> str:
    """Return a hash of the compiled code.

    It covers the tracer's sources and those that they depend on, the scene's layout and the shared
    numbers; their path, by which numba stores machine code; the versions of Python and the
    compilers; and the processor, since several may share a folder.
    """
    sources = sorted(TRACE_FOLDER.rglob("*.py"))
    digest = hashlib.sha256(os.fsencode(TRACE_FOLDER))
    for path in (
        *sources,
        Path(lucida.renderer.scene.flat.__file__),
        Path(shared_numbers.__file__),
    ):
        digest.update(path.name.encode() + b"\0" + path.read_bytes() + b"\0")
    versions = [_version(name) for name in ("numba", "llvmlite", "numpy")]
    for text in (sys.version, *versions, *_processor()):
        digest.update(text.encode() + b"\0")
    return digest.hexdigest()[:20]


def _processor() -> Iterator[str]:
    """Return the name and the features of the processor that numba compiles for."""
    yield os.environ.get("NUMBA_CPU_NAME", "") or llvm.get_host_cpu_name()
    try:
        yield os.environ.get("NUMBA_CPU_FEATURES", "") or llvm.get_host_cpu_features().flatten()
    except RuntimeError:  # the system does not report them
        return


def _version(package: str) -> str:
    """Return a package's version, without importing it if possible."""
    try:
        return metadata.version(package)
    except metadata.PackageNotFoundError:  # in a bundle without package metadata
        return str(import_module(package).__version__)


def _bases() -> Iterator[Path]:
    # Use a folder of our own inside each, since others are pruned. Do not use config.CACHE_DIR,
    # which may come from a file in the current folder.
    if given := os.environ.get("NUMBA_CACHE_DIR"):
        yield Path(given) / "lucida-kernels"
    yield Path(platformdirs.user_cache_dir("lucida", appauthor=False)) / "kernels"
    yield TRACE_FOLDER / "__pycache__" / "kernels"


def _writable(folder: Path) -> bool:
    try:
        folder.chmod(0o700)  # numba's folders inside have the umask's permissions
        with tempfile.TemporaryFile(dir=folder):  # an empty file works even on a full disk
            pass
        os.utime(folder)  # marks the last use, for pruning
    except OSError:
        return False
    return True


def prune(base: Path, used: Path) -> None:
    """Delete folders of other sources, except the most recently used ones."""
    try:
        others = [path for path in base.iterdir() if path.is_dir() and path != used]
        others.sort(key=lambda path: path.stat().st_mtime, reverse=True)
        for path in others[KEPT:]:
            if path.stat().st_mtime < time.time() - KEPT_FOR_S:
                shutil.rmtree(path, ignore_errors=True)
    except OSError:  # another process is pruning, too
        return
