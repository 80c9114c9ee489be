"""Compiles the packet kernels, then their LLVM code once more, for ARM; prints what that gave.

A program of its own (test_simd.py runs it), because it looks into numba's compiler.
"""

from __future__ import annotations

import llvmlite.binding as llvm
import numpy as np
from numba.core.codegen import JITCodeLibrary

from renderer.scene.flat import flatten
from renderer.scene.model import Mesh, Scene, SceneObject
from renderer.trace.bvh.instances import Instances
from renderer.trace.compile import numba_compiler as inlining
from renderer.trace.packets.engine import PacketEngine
from renderer.trace.threads.thread_pool import Team

TRIPLE = "aarch64-unknown-linux-gnu"
ELF, AARCH64 = b"\x7fELF", 183  # e_machine of an object file, at byte 18


def main() -> None:
    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()
    machine = llvm.Target.from_triple(TRIPLE).create_target_machine(features="+neon", opt=1)
    finalize = JITCodeLibrary.finalize

    def compile_twice(library: JITCodeLibrary) -> None:
        if isinstance(library, inlining.WholeProgram):
            compile_for_arm(library)  # our parts are linked by now, numba's own are not
        finalize(library)

    def compile_for_arm(library: JITCodeLibrary) -> None:
        text = str(library._final_module)  # numba's: it shows it to nobody
        module = llvm.parse_assembly(text)
        module.triple, module.data_layout = TRIPLE, str(machine.target_data)
        code = machine.emit_object(module)
        is_arm = code[:4] == ELF and int.from_bytes(code[18:20], "little") == AARCH64
        foreign = "llvm.x86." in text or " asm " in text
        print(library.name, "vectors" if "<16 x float>" in text else "scalars", is_arm, foreign)

    JITCodeLibrary.finalize = compile_twice
    corners, face = np.eye(3, dtype=np.float32), np.array([[0, 1, 2]], np.int32)
    scene = Scene((SceneObject(Mesh(corners, face)),))
    Instances(scene, flatten(scene), Team(1))
    PacketEngine(Scene(()), Team(1), True, 2)


if __name__ == "__main__":
    main()
