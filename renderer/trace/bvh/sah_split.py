"""Splitting a BVH node in two: binned surface area heuristic, in-place partition.

The builder sorts records, RECORD float32 for each primitive in one flat array: -low x, y, z of its
box, the bits of its number, high x, y, z, and padding. Since they are sorted in place, every pass
over a node reads them sequentially.

The low sides are negated, so that the box around two boxes is one maximum of vectors. Bounds are a
vector: the first half is the box in a record's layout, and the second half bounds the centres in
the same way. Bins keep only boxes, in half vectors; the bounds of both halves of a node are
computed while its records are partitioned. Centres are doubled throughout (low + high), to avoid
halving.

Source: Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007.
"""

from __future__ import annotations

import numpy as np

from lucida.renderer.trace.compile.compiled import inlined
from lucida.renderer.trace.compile.emit import choose, emitted, greater, i64, lesser
from lucida.renderer.trace.vector.lanes import (
    LANES,
    bits,
    f64_of,
    i32_of,
    lane_of,
    larger,
    lower_halves,
    lowest_bit,
    mask_of,
    next_of_three,
    quarters_swapped,
    select,
    smallest,
    splat,
    to_f32,
    vfloor,
    vmax,
    vmin,
)
from lucida.renderer.trace.vector.memory import load, load_half, store_half

BINS = 16
SAMPLE = 2048  # records sampled to find a split, if there are many more
RECORD = 8
NUMBER = 3  # a record's column, as int32, with the primitive's number and this bit:
NUMBERED = 1 << 30  # otherwise, small numbers would be denormal, and three times as slow to bin
HIGH = 4  # the column with the high x
ROOM_OF_BINS = 3 * BINS * RECORD + 2 * LANES
FAR = np.float32(3.4e38)
_NODE_LEAVES = 14  # leaves in a typical wide node of 16 (bvh16.py), since few are full
_LOW_CENTRE, _HIGH_CENTRE = 8, 12  # lanes of bounds
_CENTRES = 0xFF00  # the lanes of both


@emitted
def _bounds(records, i):
    """Return the bounds of record i."""
    box = load_half(records, RECORD * i)
    # The centre with both signs is (-low) - high and high - (-low).
    return box - select(mask_of(_CENTRES), quarters_swapped(box), np.float32(0))


@inlined
def bounds_of_records(records, start, end):
    """Return the bounds of records[start:end]; -FAR if there are none."""
    bounds = splat(-FAR)
    for i in range(start, end):
        bounds = larger(bounds, _bounds(records, i))
    return bounds


@emitted
def _bin_scale(bounds):
    """Return bins per unit of (doubled) centre, in the lanes of high centres."""
    extent = bounds + quarters_swapped(bounds)
    is_wide = extent > np.float32(1e-30)
    return select(is_wide, np.float32(BINS * 0.9999) / extent, np.float32(0))


@emitted
def _half_areas(left, right):
    """Return half of the surfaces of two bounds' boxes, in the first lane of each half."""
    both = lower_halves(left, right)
    extent = both + quarters_swapped(both)
    side = extent * next_of_three(extent)
    # Add the three products of two sides.
    one_on = next_of_three(side)
    return side + one_on + next_of_three(one_on)


@emitted
def _units(count, per_primitive):
    """Return the number of units that `count` primitives fill, the last one perhaps partly.

    count: I32, at least 1. per_primitive: the reciprocal of a unit's primitives; dividing would
    take longer than all the rest.
    """
    return to_f32(vfloor((f64_of(count) - 0.5) * per_primitive) + 1.0)


@emitted
def _count_record(records, i, origin, scale, bins, counts):
    """Add record i to its bins, one per axis."""
    own = _bounds(records, i)
    number = i32_of(vmin(vmax((own + origin) * scale, np.float32(0)), np.float32(BINS - 1)))
    for axis in range(3):
        into = axis * BINS + i64(lane_of(number, _HIGH_CENTRE + axis))
        counts[into] = counts[into] + 1
        store_half(bins, RECORD * into, larger(load_half(bins, RECORD * into), own))


@inlined
def best_split(records, start, end, bounds, leaf_size, scratch):
    """Return (axis, bin) after which to split records[start:end] at the least cost; axis -1 for no
    split.

    leaf_size: the capacity of a leaf in primitives. scratch: a thread's bins, float32,
    ROOM_OF_BINS, and counts, int32, 4 BINS.
    """
    bins, counts = scratch
    for b in range(3 * BINS):
        counts[b] = 0
        store_half(bins, RECORD * b, splat(-FAR))

    # Sort the centres into bins along each axis.
    # Neighbours often share a bin, and each would wait for the previous one, so take four at a
    # time, from distant places.
    scale, origin = _bin_scale(bounds), quarters_swapped(bounds)
    step, quarter = _steps_of(start, end), (end - start) // 4
    for i in range(start, start + quarter, step):
        for k in range(4):
            _count_record(records, i + k * quarter, origin, scale, bins, counts)
    if step == 1:
        for i in range(start + 4 * quarter, end):
            _count_record(records, i, origin, scale, bins, counts)

    # The cost of a split is, for each side, its area times its number of leaves or, if there are
    # many, of wide nodes. Round up, since half-empty ones take as long as full ones.
    is_small = end - start <= _NODE_LEAVES * leaf_size
    unit = 1.0 / (leaf_size if is_small else _NODE_LEAVES * leaf_size)
    best, best_axis, best_bin = FAR, -1, np.int64(-1)
    total = np.int32(0)
    for b in range(BINS):
        total += counts[b]
    lefts, below = 3 * BINS * RECORD, 3 * BINS
    rights = lefts + LANES
    for axis in range(3):
        # Sweep from both ends, which makes the costs of all splits a vector.
        first = axis * BINS
        left, right, n = splat(-FAR), splat(-FAR), np.int32(0)
        for b in range(BINS):
            left = larger(left, load_half(bins, RECORD * (first + b)))
            right = larger(right, load_half(bins, RECORD * (first + BINS - 1 - b)))
            areas = _half_areas(left, right)
            bins[lefts + b] = lane_of(areas, 0)
            bins[rights + BINS - 2 - b] = lane_of(areas, LANES // 2)
            n += counts[first + b]
            counts[below + b] = n
        n_left = load(counts, below)
        n_right = total - n_left
        is_split = (n_left > np.int32(0)) & (n_right > np.int32(0))
        cost = load(bins, lefts) * _units(n_left, unit) + load(bins, rights) * _units(n_right, unit)
        cost = select(is_split, cost, FAR)
        least = smallest(cost)
        if least < best:
            best, best_axis, best_bin = least, axis, lowest_bit(bits(cost == least))
    return best_axis, best_bin


@emitted
def _steps_of(start, end):
    """Return the step with which best_split() samples records[start:end]; 1 if there are few."""
    count = end - start
    return choose(count <= 2 * SAMPLE, lambda: 1, lambda: count // SAMPLE)


@inlined
def partition(records, start, end, bounds, axis, last_bin):
    """Move the records in bins up to last_bin to the front. Return the start of the others, and the
    bounds of both parts.
    """
    scale = lane_of(_bin_scale(bounds), _HIGH_CENTRE + axis)
    origin = lane_of(bounds, _LOW_CENTRE + axis)
    i, j = start, end - 1
    left, right = splat(-FAR), splat(-FAR)
    while True:
        while i <= j and _bin_of(records, i, axis, origin, scale) <= last_bin:
            left = larger(left, _bounds(records, i))
            i += 1
        while i <= j and _bin_of(records, j, axis, origin, scale) > last_bin:
            right = larger(right, _bounds(records, j))
            j -= 1
        if i >= j:
            return i, left, right
        a, b = load_half(records, RECORD * i), load_half(records, RECORD * j)
        store_half(records, RECORD * i, b)
        store_half(records, RECORD * j, a)


@emitted
def _bin_of(records, i, axis, origin, scale):
    """Return the bin of record i, computed in the same way as in best_split()."""
    centre = records[RECORD * i + HIGH + axis] - records[RECORD * i + axis]
    return lesser(greater(i64((centre + origin) * scale), 0), BINS - 1)
