"""The two decorators that compile the tracer's code, and the cache of its machine code."""

from __future__ import annotations

import os
import threading
from collections.abc import Callable
from typing import Any

import numba
from numba import config
from numba.core.caching import FunctionCache
from numba.core.runtime import rtsys

from renderer import compile_note
from renderer.trace.compile.cache_folder import cache_folder
from renderer.trace.compile.numba_compiler import KernelCompiler, PartCompiler

# numba reads settings from a file in the current folder, which may come from anywhere. Use only
# the environment.
if hasattr(config, "_config_fname") and hasattr(config, "reload_config"):
    config._config_fname = os.devnull
    config.reload_config()

_cache_dir_lock = threading.Lock()


def inlined(function: Callable[..., Any]) -> Any:
    """Decorate a small function that is compiled as a part of kernels.

    It must not create arrays, because it does not count references: the kernel's caller owns all
    arrays meanwhile. Not fast-math: watertight intersection needs the operations in the order
    written.
    """
    return numba.njit(
        error_model="numpy",
        forceinline=True,
        no_cpython_wrapper=True,
        no_cfunc_wrapper=True,
        pipeline_class=PartCompiler,
        _nrt=False,
    )(function)


def kernel(function: Callable[..., Any]) -> Any:
    """Decorate a function that Python calls: compiled at its first call, run without the GIL.

    Use it only at module level, or the cache cannot find the function again.
    """
    compiled = numba.njit(
        nogil=True, error_model="numpy", no_cfunc_wrapper=True, pipeline_class=KernelCompiler
    )(function)
    folder = cache_folder()
    if folder is None:
        compile_note.begin(kept=False)
        return compiled
    with _cache_dir_lock:  # a cache reads its folder from numba's settings on creation
        users = config.CACHE_DIR, config.CACHE_LOCATOR_CLASSES
        config.CACHE_DIR, config.CACHE_LOCATOR_CLASSES = str(folder), "UserProvidedCacheLocator"
        try:
            compiled._cache = _Cache(function)
        except RuntimeError:  # the folder is no longer writable
            compile_note.begin(kept=False)
        finally:
            config.CACHE_DIR, config.CACHE_LOCATOR_CLASSES = users
    return compiled


class _Cache(FunctionCache):
    """numba's cache of a function. A damaged file or a full disk is a miss, not an error."""

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        loaded = None
        try:
            # Machine code needs only numba's allocator. The inherited method first initialises the
            # whole compiler, which takes half of the program's startup time.
            rtsys.initialize(target_context)
            loaded = self._load_overload(sig, target_context)
        except Exception:  # unpickling a damaged file may raise anything
            pass
        if loaded is None:
            compile_note.begin(kept=True)
        return loaded

    def save_overload(self, sig: Any, data: Any) -> None:
        try:
            try:
                super().save_overload(sig, data)
            except OSError:
                raise
            except Exception:  # the index is damaged: start a new one
                self.flush()
                super().save_overload(sig, data)
        except OSError:  # the disk is full
            compile_note.begin(kept=False)
