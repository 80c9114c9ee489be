"""Atomic counters by which a kernel's threads divide their work, and stop it.

These are the atomic operations on the control array. Pieces of work are numbered from 0; each
thread takes the next number until there are no more.

An ordinary array element would not work, because the compiler may read it only once, before the
loop.
"""

from __future__ import annotations

from llvmlite import ir
from numba.core import types

from lucida.renderer.trace.compile.emit import emitted, instruction
from lucida.renderer.trace.vector.types import INT64, first_address

from .thread_pool import CANCELLED, DONE, NEXT


def _address(builder, control, index):
    return builder.gep(first_address(builder, control), [ir.Constant(INT64, index)])


def _add_one(builder, control, index):
    """Add 1 to control[index] (int64), atomically. Return the previous value."""
    at = _address(builder, control, index)
    return builder.atomic_rmw("add", at, ir.Constant(INT64, 1), "seq_cst")


@instruction
def take_next(control):
    """Claim the next piece of work. Return its number."""
    return types.int64, lambda builder: _add_one(builder, control, NEXT)


@instruction
def count_done(control):
    """Count a finished piece of work."""
    return types.void, lambda builder: _add_one(builder, control, DONE)


@instruction
def _next(control):
    """Return the number of the next piece of work, freshly read from memory."""

    def emit(builder):
        at = _address(builder, control, NEXT)
        return builder.load_atomic(at, "monotonic", 8, typ=INT64)

    return types.int64, emit


@emitted
def is_cancelled(control):
    return _next(control) >= CANCELLED
