"""The decorators that compile the tracer's code, and the cache of its machine code."""

from __future__ import annotations

import shutil
import threading
from collections.abc import Callable
from functools import cache, partial, wraps
from typing import Any

import numba
from numba import config
from numba.core import typed_passes, untyped_passes
from numba.core.compiler import CompilerBase, Flags, compile_extra
from numba.core.compiler_machinery import PassManager
from numba.core.registry import cpu_target

from lucida.renderer.system import compile_note

from .cache_folder import cache_folder
from .emit import defined

_cache_dir_lock = threading.Lock()
_has_failed = threading.Event()  # set once machine code could not be loaded or saved


def is_cached() -> bool:
    """Return True if the cache has all code compiled in this process."""
    return cache_folder() is not None and not _has_failed.is_set()


# numba's passes, except those for features that parts do not use: closures, `with`, array
# expressions and reference counting.
_PASSES = (
    untyped_passes.TranslateByteCode,
    untyped_passes.FixupArgs,
    untyped_passes.IRProcessing,
    untyped_passes.RewriteSemanticConstants,
    untyped_passes.DeadBranchPrune,
    untyped_passes.GenericRewrites,
    untyped_passes.ReconstructSSA,
    typed_passes.NopythonTypeInference,
    typed_passes.PreLowerStripPhis,
    typed_passes.AnnotateTypes,
    typed_passes.NativeLowering,
    typed_passes.NoPythonBackend,
)


_FLAGS = {
    "no_compile": True,
    "no_cpython_wrapper": True,
    "no_cfunc_wrapper": True,
    "error_model": "numpy",
}


class _PartCompiler(CompilerBase):
    """numba's compiler for parts of kernels."""

    def define_pipelines(self) -> list[PassManager]:
        pipeline = PassManager("part")
        for each in _PASSES:
            pipeline.add_pass(each)
        pipeline.finalize()
        return [pipeline]


def inlined(function: Callable[..., Any]) -> Any:
    """Decorate a function with loops or branches that is compiled as a part of kernels.

    Straight-line functions compile in a fraction of the time if they are emitted (emit.py). The
    function must not create arrays or raise errors. Fast-math is off, because watertight
    intersection needs the operations in the order written.

    numba.njit would optimize and compile each function together with all its callees, and then
    again as a part of its callers. Here, it remains LLVM IR, which LLVM optimizes where it is
    inlined into a kernel.
    """

    @cache
    def compiled(kinds: tuple[Any, ...]) -> Any:
        flags = Flags()
        for flag, value in _FLAGS.items():
            setattr(flags, flag, value)
        typing, context = cpu_target.typing_context, cpu_target.target_context
        result = compile_extra(
            typing, context, function, kinds, None, flags, {}, pipeline_class=_PartCompiler
        )
        code = result.library.get_function(result.fndesc.llvm_func_name)
        code.linkage = "available_externally"  # no machine code
        level, config.OPT = config.OPT, 0
        try:
            result.library.finalize()  # links the functions that it calls
        finally:
            config.OPT = level
        return result

    def kind_of(typing, kinds):
        return compiled(kinds).signature.return_type

    def lower(context, builder, sig, args):
        part = compiled(sig.args)
        context.active_code_library.add_linking_library(part.library)
        code = context.declare_function(builder.module, part.fndesc)
        _status, result = context.call_conv.call_function(
            builder, code, sig.return_type, sig.args, args, ("alwaysinline",)
        )
        return result

    return defined(function, kind_of, lower)


def kernel(function: Callable[..., Any]) -> Any:
    """Decorate a function for Python that is compiled at its first call and runs without the GIL.

    Use this only at module level, or the cache cannot find the function again. If the cache is
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
