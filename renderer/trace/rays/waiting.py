"""The traversal stack of waiting nodes for a ray, with the nearest on top."""

from __future__ import annotations

import numpy as np

from renderer.trace.bvh.bvh16 import WIDTH
from renderer.trace.compile.compiled import inlined
from renderer.trace.simd.lanes import LANES, lowest_bit
from renderer.trace.simd.memory import as_int32, store

_DEPTHS, WAITING_DEPTHS = 0, LANES  # float32 scratch: children's depths, waiting nodes' depths


@inlined
def nearest_child(found, depth, child, node, top, floats, ints):
    """Return (the nearest of the children in `found`, the stack's height with the others pushed).

    On the stack, nearer ones are above farther ones. Up to three are sorted without branches, which
    would be unpredictable: as integers, with a depth's bits above a child's. Depths below 0, which
    only a negative t_min causes, are in a different order, which costs only time.
    """
    lane = lowest_bit(found)
    found &= found - 1
    first = node * WIDTH
    if found == 0:
        return np.int64(child[first + lane]), top
    store(floats, _DEPTHS, depth)
    depths = as_int32(floats)
    a = _depth_and_child(depths, child, first, lane)
    lane = lowest_bit(found)
    found &= found - 1
    b = _depth_and_child(depths, child, first, lane)
    a, b = min(a, b), max(a, b)
    if found == 0:
        return np.int64(np.int32(a)), _pushed(b, top, depths, ints)
    lane = lowest_bit(found)
    found &= found - 1
    c = _depth_and_child(depths, child, first, lane)
    a, c = min(a, c), max(a, c)
    b, c = min(b, c), max(b, c)
    base = top
    top = _pushed(b, _pushed(c, top, depths, ints), depths, ints)
    while found != 0:
        lane = lowest_bit(found)
        found &= found - 1
        b = _depth_and_child(depths, child, first, lane)
        a, b = min(a, b), max(a, b)
        # Insertion sort: there are few.
        t, i = np.int32(b >> 32), top
        while i > base and depths[WAITING_DEPTHS + i - 1] < t:
            depths[WAITING_DEPTHS + i] = depths[WAITING_DEPTHS + i - 1]
            ints[i] = ints[i - 1]
            i -= 1
        depths[WAITING_DEPTHS + i], ints[i] = t, np.int32(b)
        top += 1
    return np.int64(np.int32(a)), top


@inlined
def _depth_and_child(depths, child, first, lane):
    return (np.int64(depths[_DEPTHS + lane]) << 32) | np.int64(np.uint32(child[first + lane]))


@inlined
def _pushed(depth_and_child, top, depths, ints):
    """Push one node. Return the stack's height."""
    depths[WAITING_DEPTHS + top] = np.int32(depth_and_child >> 32)
    ints[top] = np.int32(depth_and_child)
    return top + 1


@inlined
def without_farther(top, base, closest, floats):
    """Return the stack's height without the nodes on top that begin behind `closest`."""
    while top > base and floats[WAITING_DEPTHS + top - 1] >= closest:
        top -= 1
    return top
