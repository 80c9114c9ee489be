"""How kernels are compiled: the two decorators of the tracer's code.

Owns numba's settings. Their machine code is kept in cache_folder.py's folder; without one, kernels
are compiled anew in each process. Knows nothing of rays.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import Any

import numba
from numba import config

from renderer import compile_note
from renderer.trace.compile.cache_folder import cache_folder
from renderer.trace.compile.numba_inside import part

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
