"""numba's cache of compiled kernels in a given folder: quicker to find, harder to break.

A part of numba_inside.py.
"""

from __future__ import annotations

import functools
import sys
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

from numba.core import config, environment
from numba.core.caching import FunctionCache, NullCache
from numba.core.registry import CPUDispatcher
from numba.core.runtime import rtsys

from renderer import compile_note

NEEDS = (
    (FunctionCache, ("_load_overload", "_guard_against_spurious_io_errors", "save_overload")),
    (FunctionCache, ("flush",)),
    (NullCache, ("load_overload",)),
    (CPUDispatcher, ("_cache",)),
    (rtsys, ("initialize",)),
    (environment, ("_rebuild_env", "lookup_environment")),
    (environment.Environment, ("_memo", "consts", "env_name")),
    (config, ("CACHE_DIR", "CACHE_LOCATOR_CLASSES")),
)

_LOCATOR = "UserProvidedCacheLocator"  # numba's name for: CACHE_DIR, and nowhere else
_cache_dir_lock = threading.Lock()


def keep(compiled: Any, function: Callable[..., Any], folder: Path | None) -> None:
    """Gives a kernel its cache. folder: None for none."""
    compiled._cache = _NoCache()
    if folder is None:
        return
    # numba takes a cache's folder from its configuration, at the cache's creation.
    with _cache_dir_lock:
        users = config.CACHE_DIR, config.CACHE_LOCATOR_CLASSES
        config.CACHE_DIR, config.CACHE_LOCATOR_CLASSES = str(folder), _LOCATOR
        try:
            compiled._cache = _Cache(function)
        except RuntimeError:  # the folder can no longer be written
            pass
        finally:
            config.CACHE_DIR, config.CACHE_LOCATOR_CLASSES = users


def _rebuild_environment(module: str, constants: tuple, name: str) -> Any:
    """What a function of a kernel knows of its module. Nothing of that is asked for by machine code
    that calls no Python: numba would import the module, its own arrays and texts among them."""
    known = environment.lookup_environment(name)
    if known is None:
        imported = sys.modules.get(module)
        about = {"__name__": module} if imported is None else vars(imported)
        known = environment.Environment(about)
        known.consts[:] = constants
        known.env_name = name
        environment.Environment._memo[name] = known
    return known


# Under numba's name, which is what cached kernels call it by.
environment._rebuild_env = functools.wraps(environment._rebuild_env)(_rebuild_environment)


class _NoCache(NullCache):
    """What a function has that is compiled anew in each process."""

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        compile_note.begin(kept=False)
        return None


class _Cache(FunctionCache):
    """numba's cache of one function; a damaged or full disk costs compiling again, not an error.

    numba makes its whole compiler ready before it looks for machine code: half of a start's time.
    All that such code needs of it are the functions by which kernels allocate arrays.
    """

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        loaded = None
        try:
            rtsys.initialize(target_context)
            with self._guard_against_spurious_io_errors():
                loaded = self._load_overload(sig, target_context)
        except Exception:  # whatever unpickling a damaged file may raise
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
            except Exception:  # the index that is to be extended is damaged: it begins anew
                self.flush()
                super().save_overload(sig, data)
        except OSError:  # the disk is full
            compile_note.begin(kept=False)
