"""How kernels are compiled, and where their machine code is kept between runs.

Owns the two decorators of the tracer's code and its cache folder. Knows nothing of rays.

numba's own cache looks at one file only: after an edit of intersect.py it would go on using the
kernel.py compiled before it. Here the cache folder is named by a hash of all the sources that
kernels are made of and of the versions that compile them, so stale code is never found.

The folder lies in NUMBA_CACHE_DIR if that is set, else in the user's cache folder, else beside
this package. What numba finds there it unpickles, and runs: a folder that others could write into
is passed over, and so is a relative one, which would be looked for beside the user's files. Where
none of these will do, kernels are compiled anew in each process.
"""

from __future__ import annotations

import hashlib
import logging
import os
import shutil
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import Any

import llvmlite
import numba
import numpy
import platformdirs
from numba import config

import renderer.scene.flat
from renderer import compile_note, shared_numbers
from renderer.errors import LucidaError
from renderer.private import private_folder
from renderer.trace.compile.numba_inside import missing, part

KEPT = 4  # folders of other sources or versions that stay
KEPT_FOR_S = 3600.0  # younger ones stay too: another process may be filling them

_compiler, _cache = part("numba_compiler"), part("numba_cache")

# No entry points for Python.
_INSIDE = {"forceinline": True, "no_cpython_wrapper": True, "no_cfunc_wrapper": True}
_KERNEL: dict[str, Any] = {"no_cfunc_wrapper": True}
if _compiler is not None:
    # No machine code of their own. No reference counts: arrays belong to the kernel's caller
    # meanwhile, and counting their uses would take longer than most rays.
    _INSIDE |= {"_nrt": False, "pipeline_class": _compiler.PartCompiler}
    _KERNEL["pipeline_class"] = _compiler.KernelCompiler

# numba takes settings from a file in the current folder, at its import and for each compilation. It
# may have come with anything: what counts is the environment.
if hasattr(config, "_config_fname") and hasattr(config, "reload_config"):
    config._config_fname = os.devnull
    config.reload_config()

TRACE_FOLDER = Path(__file__).parents[1]  # the tracer's folder


def inlined(function: Callable[..., Any]) -> Any:
    """Decorator of the small functions that kernels consist of; compiled as part of a kernel.

    It must not make arrays: the kernel does. No fast-math: nothing is reassociated or fused, which
    watertight intersection relies on.
    """
    return numba.njit(error_model="numpy", **_INSIDE)(function)


def kernel(function: Callable[..., Any]) -> Any:
    """Decorator of a function called from Python: compiled at its first call, without the GIL.

    Must be used at module level, or the cache cannot find the function again.
    """
    compiled = numba.njit(nogil=True, error_model="numpy", **_KERNEL)(function)
    folder = cache_folder()
    if _cache is not None:
        _cache.keep(compiled, function, folder)
    elif folder is not None:
        config.CACHE_DIR = str(folder)
        compiled.enable_caching()
    else:
        compile_note.begin(kept=False)
    return compiled


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
    the scene's layout and the shared numbers; the versions."""
    sources = sorted(TRACE_FOLDER.rglob("*.py"))
    digest = hashlib.sha256()
    for path in (*sources, Path(renderer.scene.flat.__file__), Path(shared_numbers.__file__)):
        digest.update(path.name.encode() + b"\0" + path.read_bytes() + b"\0")
    for version in (sys.version, numba.__version__, llvmlite.__version__, numpy.__version__):
        digest.update(version.encode() + b"\0")
    digest.update(repr(missing()).encode())
    return digest.hexdigest()[:20]


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
