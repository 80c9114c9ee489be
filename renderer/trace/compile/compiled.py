"""The decorators that compile the tracer's code, and the cache of its machine code."""

from __future__ import annotations

import shutil
import threading
from collections.abc import Callable
from functools import partial, wraps
from typing import Any

import numba
from numba import config

from renderer import compile_note
from renderer.trace.compile.cache_folder import cache_folder

_cache_dir_lock = threading.Lock()
_has_failed = threading.Event()  # set once machine code could not be loaded or saved


def is_cached() -> bool:
    """Return True if the cache has all that was compiled in this process."""
    return cache_folder() is not None and not _has_failed.is_set()


def inlined(function: Callable[..., Any]) -> Any:
    """Decorate a function with loops or branches that is compiled as a part of kernels.

    Straight-line ones compile in a fraction of the time if they are emitted (emit.py). It must not
    create arrays. Not fast-math: watertight intersection needs the operations in the
    order written.
    """
    return numba.njit(
        error_model="numpy", forceinline=True, no_cpython_wrapper=True, no_cfunc_wrapper=True
    )(function)


def pasted(function: Callable[..., Any]) -> Any:
    """Decorate a function with a single caller, into which its code is copied before compilation.

    For the large ones: each function that is only `inlined` is optimised together with all that it
    calls, and then once more as a part of its caller.
    """
    return numba.njit(inline="always")(function)


def kernel(function: Callable[..., Any]) -> Any:
    """Decorate a function that Python calls: compiled at its first call, run without the GIL.

    Use it only at module level, or the cache cannot find the function again. If the cache is
    damaged or its disk is full, the function is compiled without it.
    """
    compile_it = partial(numba.njit, nogil=True, error_model="numpy", no_cfunc_wrapper=True)
    uncached = compile_it()(function)
    folder = cache_folder()
    if folder is None:
        return uncached
    with _cache_dir_lock:  # numba reads its folder from its settings
        users, config.CACHE_DIR = config.CACHE_DIR, str(folder)
        try:
            cached = compile_it(cache=True)(function)
        except RuntimeError:  # the folder is no longer writable
            _has_failed.set()
            return uncached
        finally:
            config.CACHE_DIR = users

    @wraps(function)
    def call(*arguments: Any) -> Any:
        if not _has_failed.is_set():
            try:
                return cached(*arguments)
            except MemoryError:
                raise
            except Exception:  # unpickling a damaged file may raise anything
                _has_failed.set()
                compile_note.begin(kept=False)
                shutil.rmtree(folder, ignore_errors=True)
        return uncached(*arguments)

    return call
