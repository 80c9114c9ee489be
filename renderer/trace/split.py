"""How a BVH's node is split in two: binned surface area heuristic, partition in place.

Owns the records that the builder sorts: float32 (n, 8), one for each primitive: low x, y, z, high
x, y, z of its box, the bits of its number, nothing. Sorted in place, they are read in order by
every pass over a node. Knows nothing of nodes.

Centres are doubled throughout (low + high): no halving.
Source: Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007.
"""

from __future__ import annotations

import numpy as np

from renderer.trace.compiled import inlined

BINS = 16
NUMBER = 6  # the column of a record, seen as int32, with the primitive's number
FAR = np.float32(3.4e38)


@inlined
def measure(records, start, end, box, centres):
    """Bounds of records[start:end] into box (6,), of their centres into centres (6,)."""
    for axis in range(3):
        low = low_centre = FAR
        high = high_centre = -FAR
        for i in range(start, end):
            a, b = records[i, axis], records[i, 3 + axis]
            low, high = min(low, a), max(high, b)
            low_centre, high_centre = min(low_centre, a + b), max(high_centre, a + b)
        box[axis], box[3 + axis] = low, high
        centres[axis], centres[3 + axis] = low_centre, high_centre


@inlined
def bin_scale(low, high):
    """Bins per unit of (doubled) centre."""
    extent = high - low
    return np.float32(BINS * 0.9999) / extent if extent > np.float32(1e-30) else np.float32(0)


@inlined
def bin_of(low, high, origin, scale):
    return min(max(int((low + high - origin) * scale), 0), BINS - 1)


@inlined
def _half_area(low, high):
    x, y, z = high[0] - low[0], high[1] - low[1], high[2] - low[2]
    return x * y + y * z + z * x


@inlined
def _extended(low, high, bins, axis, b):
    """The box (low, high) made to hold bin b's."""
    return (
        (
            min(low[0], bins[axis, b, 0]),
            min(low[1], bins[axis, b, 1]),
            min(low[2], bins[axis, b, 2]),
        ),
        (
            max(high[0], bins[axis, b, 3]),
            max(high[1], bins[axis, b, 4]),
            max(high[2], bins[axis, b, 5]),
        ),
    )


@inlined
def best_split(records, start, end, centres, scratch):
    """(axis, bin) after which to split records[start:end] at the least cost; axis -1: nowhere.

    scratch: int64 (3, BINS), and float32 (3, BINS, 6), (BINS,), (3,), of the calling thread.
    """
    counts, bins, right, scales = scratch
    for axis in range(3):
        for b in range(BINS):
            counts[axis, b] = 0
            for k in range(3):
                bins[axis, b, k], bins[axis, b, 3 + k] = FAR, -FAR

    # Sort the centres into bins along each axis.
    for axis in range(3):
        scales[axis] = bin_scale(centres[axis], centres[3 + axis])
    for i in range(start, end):
        for axis in range(3):
            b = bin_of(records[i, axis], records[i, 3 + axis], centres[axis], scales[axis])
            counts[axis, b] += 1
            for k in range(3):
                bins[axis, b, k] = min(bins[axis, b, k], records[i, k])
                bins[axis, b, 3 + k] = max(bins[axis, b, 3 + k], records[i, 3 + k])

    # The cost of a split: for each side, its area times its primitives.
    best, best_axis, best_bin = FAR, -1, -1
    for axis in range(3):
        if centres[3 + axis] <= centres[axis]:
            continue
        # Sweep from the right for each right side, then from the left for the sum.
        low, high, n = (FAR, FAR, FAR), (-FAR, -FAR, -FAR), 0
        for b in range(BINS - 1, 0, -1):
            n += counts[axis, b]
            low, high = _extended(low, high, bins, axis, b)
            right[b] = _half_area(low, high) * np.float32(n) if n > 0 else np.float32(0)
        low, high, n = (FAR, FAR, FAR), (-FAR, -FAR, -FAR), 0
        for b in range(BINS - 1):
            n += counts[axis, b]
            low, high = _extended(low, high, bins, axis, b)
            if 0 < n < end - start:
                cost = _half_area(low, high) * np.float32(n) + right[b + 1]
                if cost < best:
                    best, best_axis, best_bin = cost, axis, b
    return best_axis, best_bin


@inlined
def partition(records, start, end, centres, axis, last_bin):
    """Moves the records in bins up to last_bin to the front; gives the first of the others."""
    scale, origin = bin_scale(centres[axis], centres[3 + axis]), centres[axis]
    i, j = start, end - 1
    while True:
        while i <= j and bin_of(records[i, axis], records[i, 3 + axis], origin, scale) <= last_bin:
            i += 1
        while i <= j and bin_of(records[j, axis], records[j, 3 + axis], origin, scale) > last_bin:
            j -= 1
        if i >= j:
            return i
        for k in range(7):
            records[i, k], records[j, k] = records[j, k], records[i, k]
        i += 1
        j -= 1
