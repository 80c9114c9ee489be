"""numba compilers for kernels, and for functions that are only used as parts of kernels.

numba optimises every function together with everything that it calls, because it may be called on
its own. Functions nested ten deep are then linked and optimised ten times. Here compilation of a
part stops at its own LLVM code. The kernel links each part once and is optimised as a whole. The
machine code is the same, in two thirds of the time.
"""

from __future__ import annotations

from typing import Any

import llvmlite.binding as llvm
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import Compiler, PassManager
from numba.core.typed_passes import InlineOverloads, IRLegalization, NopythonRewrites
from numba.core.untyped_passes import (
    InlineClosureLikes,
    InlineInlinables,
    LiteralPropagationSubPipelinePass,
    LiteralUnroll,
    MakeFunctionToJitFunction,
    WithLifting,
)

# Passes for features that kernels' parts do not use: `with`, closures, literal_unroll, array
# expressions, and variables with a reference count.
_NOT_NEEDED = (
    InlineClosureLikes,
    InlineInlinables,
    InlineOverloads,
    IRLegalization,
    LiteralPropagationSubPipelinePass,
    LiteralUnroll,
    MakeFunctionToJitFunction,
    NopythonRewrites,
    WithLifting,
)


class _Part(JITCodeLibrary):
    """The LLVM code of a function, for its callers to link; it has no machine code."""

    def _optimize_functions(self, ll_module: Any) -> None:
        """Do nothing: the kernel is optimised as a whole."""

    def finalize(self) -> None:
        """Allow no more additions; the kernel does the linking, too."""
        self._raise_if_finalized()
        self._finalize_final_module()

    def _finalize_final_module(self) -> None:
        self._finalize_dynamic_globals()
        self._finalized = True

    def own_module(self) -> Any:
        """Return the LLVM code of this function, without the functions that it calls."""
        return super()._get_module_for_linking()

    def _get_module_for_linking(self) -> Any:
        """Return the code with that of the functions it calls, for callers with numba's own
        compiler.
        """
        module = self.own_module().clone()
        for library in _with_parts(self):
            is_part = isinstance(library, _Part)
            other = library.own_module() if is_part else library._get_module_for_linking()
            module.link_in(other, preserve=True)
        return module

    # numba uses these after compiling, to make a function callable from Python.

    def get_pointer_to_function(self, name: str) -> int:
        return 0

    @property
    def codegen(self) -> _Part:
        return self

    def set_env(self, env_name: str, env: Any) -> None:
        """Do nothing: there is no machine code to hold it."""


class WholeProgram(JITCodeLibrary):
    """A kernel's code, with that of its parts and of their parts."""

    def finalize(self) -> None:
        libraries = _with_parts(self)
        # numba links the libraries that are not parts.
        self._linking_libraries = [each for each in libraries if not isinstance(each, _Part)]
        for part in libraries:
            if isinstance(part, _Part):
                self._reload_init.update(part._reload_init)
                self._final_module.link_in(part.own_module(), preserve=True)
        super().finalize()

    def serialize_using_object_code(self) -> tuple[str, str, tuple[bytes, bytes]]:
        """Serialise with LLVM code for only the functions' names: no other code is linked
        with it.
        """
        name, kind, (machine_code, _) = super().serialize_using_object_code()
        defined = (each.name for each in self._final_module.functions if not each.is_declaration)
        names = "".join(f'define void @"{each}"() {{ ret void }}' for each in defined)
        return name, kind, (machine_code, llvm.parse_assembly(names).as_bitcode())


def _with_parts(library: Any) -> list:
    """Return the libraries that a library calls, and those that their parts call, without
    duplicates.
    """
    found: dict[Any, None] = {}
    waiting = list(library._linking_libraries)
    while waiting:
        called = waiting.pop(0)
        if called not in found:
            found[called] = None
            if isinstance(called, _Part):
                waiting += called._linking_libraries
    return list(found)


class KernelCompiler(Compiler):
    """numba's compiler for kernels; a `pipeline_class` for numba.njit."""

    def define_pipelines(self) -> list[PassManager]:
        state = self.state
        if state.library is None:
            state.library = WholeProgram(state.targetctx.codegen(), state.func_id.func_qualname)
            state.library.enable_object_caching()
        return super().define_pipelines()


class PartCompiler(Compiler):
    """numba's compiler for parts."""

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
