"""How numba compiles a function that is only ever a part of kernels: no further than it must.

Owns the changes to numba's compiler for such functions. Knows nothing of what they do.

numba takes each function for one that might be called on its own: it optimises it together with
all that it calls, makes machine code of it, and its callers begin anew with the result. With stages
within stages, the innermost would be optimised once for each level. A part stops at LLVM's code,
linked and not optimised; only the kernel is, as a whole. The machine code is the same, in three
quarters of the time.
"""

from __future__ import annotations

from typing import Any

from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import Compiler, PassManager
from numba.core.typed_passes import InlineOverloads, NopythonRewrites
from numba.core.untyped_passes import (
    InlineClosureLikes,
    InlineInlinables,
    LiteralPropagationSubPipelinePass,
    LiteralUnroll,
    MakeFunctionToJitFunction,
    WithLifting,
)

# Passes for what kernels' parts do not have: `with`, closures, literal_unroll, array expressions.
_NOT_NEEDED = (
    InlineClosureLikes,
    InlineInlinables,
    InlineOverloads,
    LiteralPropagationSubPipelinePass,
    LiteralUnroll,
    MakeFunctionToJitFunction,
    NopythonRewrites,
    WithLifting,
)


class _Part(JITCodeLibrary):
    """LLVM's code of a function, for its callers to link; there is no machine code of it."""

    def _optimize_functions(self, ll_module: Any) -> None:
        """Left to the kernel."""

    def _optimize_final_module(self) -> None:
        """Left to the kernel."""

    def _finalize_final_module(self) -> None:
        self._finalize_dynamic_globals()
        self._finalized = True

    # What numba sets up, once it is compiled, for a function to be called from Python.

    def get_pointer_to_function(self, name: str) -> int:
        return 0

    @property
    def codegen(self) -> _Part:
        return self

    def set_env(self, env_name: str, env: Any) -> None:
        """There is nowhere to set it."""


class PartCompiler(Compiler):
    """numba's compiler for parts; an option `pipeline_class` of numba.njit."""

    def define_pipelines(self) -> list[PassManager]:
        state = self.state
        if state.library is None:
            state.library = _Part(state.targetctx.codegen(), state.func_id.func_qualname)
        pipelines = super().define_pipelines()
        shorter = []
        for pipeline in pipelines:
            shorter.append(PassManager(pipeline.pipeline_name))
            shorter[-1].passes += [item for item in pipeline.passes if item[0] not in _NOT_NEEDED]
            shorter[-1].finalize()
        return shorter
