"""Atomic counters shared by a kernel's threads: they divide the work, and stop it.

These are the atomic operations on the control array. Pieces of work are numbered from 0; each
thread takes the next number until there are no more.

An ordinary array element would not work: the compiler may read it only once, before the loop.
"""

from __future__ import annotations

import numpy as np
from llvmlite import ir
from numba.core import types
from numba.extending import intrinsic

from renderer.trace.compile.compiled import inlined
from renderer.trace.simd.types import address_of
from renderer.trace.threads.thread_pool import CANCELLED, DONE, NEXT


def _element(context, builder, signature, args):
    """Return the address of array[index], the first two arguments."""
    data = address_of(context, builder, signature.args[0], args[0])
    return builder.gep(data, [args[1]])


@intrinsic
def fetch_add(typing, array, index, value):
    """Atomically add value to array[index] (int64). Return the previous value."""

    def codegen(context, builder, signature, args):
        at = _element(context, builder, signature, args)
        return builder.atomic_rmw("add", at, args[2], "seq_cst")

    return types.int64(array, types.int64, types.int64), codegen


@intrinsic
def read(typing, array, index):
    """Return array[index] (int64) as it is in memory now."""

    def codegen(context, builder, signature, args):
        at = _element(context, builder, signature, args)
        return builder.load_atomic(at, "monotonic", 8, typ=ir.IntType(64))

    return types.int64(array, types.int64), codegen


@inlined
def take_next(control):
    """Claim the next piece of work. Return its number."""
    return fetch_add(control, np.int64(NEXT), np.int64(1))


@inlined
def count_done(control):
    """Count a finished piece of work."""
    fetch_add(control, np.int64(DONE), np.int64(1))


@inlined
def is_cancelled(control):
    return read(control, np.int64(NEXT)) >= CANCELLED
