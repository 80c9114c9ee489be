"""The wide tree: a binary BVH collapsed to 16 children per node and up to 16 triangles per leaf.

This is the layout that the SIMD kernels traverse, and its construction from a binary tree
(binary.py). One vector holds one coordinate of all boxes in a node, or of all triangles in a leaf.
Source: Wald, Benthin and Boulos, "Getting Rid of Packets: Efficient SIMD Single-Ray Traversal using
Multi-branching BVHs", 2008. The selection of nodes follows Ylitie, Karras and Laine, "Efficient
Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs", 2017.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numba.core import types
from numpy.typing import NDArray

from lucida.renderer.trace.compile.compiled import kernel
from lucida.renderer.trace.compile.emit import emitted, greater, i64, lesser
from lucida.renderer.trace.reference.vectors import cross, dot, minus, times
from lucida.renderer.trace.threads.atomic import take_next
from lucida.renderer.trace.threads.thread_pool import Team, new_control
from lucida.renderer.trace.vector.gather import gather
from lucida.renderer.trace.vector.lanes import (
    LANES,
    i32_of,
    lane_column,
    lane_of,
    lane_row,
    mask_of,
    select,
    splat,
    to_f32,
    to_f64,
    vmax,
    vmin,
    vsqrt,
)
from lucida.renderer.trace.vector.math import select_lanes, store3
from lucida.renderer.trace.vector.memory import load, pointer, stack_room, store

from .binary import MAX_DEPTH, Bvh, build

WIDTH = 16  # children per node, triangles per leaf: the lanes of a vector
NO_CHILD = -1
FIRST_LEAF = -2  # leaf k is the child FIRST_LEAF - k
BOX = 6 * WIDTH  # floats in a node's boxes
CORNERS = 9 * WIDTH  # floats in a leaf's corners
_FAR = np.float32(3.4e38)
# The corners of unused places in a leaf are NaN, since every comparison with NaN is false.
# Coincident corners would look like a triangle that needs float64 (tiles/triangle.py), and more
# than half of all leaves are not full.
_NO_CORNER = np.float32(np.nan)
_NO_SPHERES = np.zeros((0, 4), np.float32)
_NO_SPHERES.setflags(write=False)
_CHUNK = 256  # leaves that a thread takes at a time
_LEVELS = 2 * MAX_DEPTH + 64  # deeper than any binary tree


class WideTree(NamedTuple):
    """A tree with WIDTH children per node; node 0 is the root. All arrays are flat, in C order.

    box: float32, for each node low x, y, z, high x, y, z, each of 16 children. The boxes of missing
        children are inside out.
    child: int32, 16 per node: >= 0 for a node, NO_CHILD, or FIRST_LEAF - k for leaf k.
    corner: float32, for each leaf x, y, z of the corners a, b, c, each of 16 triangles.
    face: int32, 16 per leaf: the number of each triangle, -1 in unused places (whose corners are
        NaN). A triangle's index in this array is called its slot.
    normal: float32, for each leaf x, y, z of 16 unit normals by the winding; 0 for no area.
    bounds: float64 (2, 3), lowest and highest corner.
    levels: number of nodes on the longest path from the root; it bounds a traversal's stack.
    """

    box: NDArray[np.float32]
    child: NDArray[np.int32]
    corner: NDArray[np.float32]
    face: NDArray[np.int32]
    normal: NDArray[np.float32]
    bounds: NDArray[np.float64]
    levels: int


def aligned(count: int, dtype: type) -> NDArray:
    """Return an empty array of 4-byte numbers, aligned to cache lines of 64 bytes, the size of a
    vector.

    NumPy's own arrays may begin in the middle of a line; each vector would then touch two lines.
    """
    room: NDArray = np.empty(count + LANES - 1, dtype)
    first = -room.ctypes.data // 4 % LANES
    return room[first : first + count]


def tree_of_mesh(vertices: NDArray[np.float32], faces: NDArray[np.int32], team: Team) -> WideTree:
    """Return the tree over the triangles faces (m, 3), m > 0, of vertices (n, 3)."""
    binary = build(vertices, faces, _NO_SPHERES, team, leaf_size=WIDTH)
    box, child, leaves, levels = collapse(binary)
    corner = aligned(len(leaves) * CORNERS, np.float32)
    face = np.empty(len(leaves) * WIDTH, np.int32)
    normal = aligned(len(leaves) * 3 * WIDTH, np.float32)
    chunks = len(leaves) // _CHUNK  # a chunk is the least work worth another thread
    team.run(
        _fill_leaves, vertices, faces, binary.order, leaves, corner, face, normal, new_control(),
        size=chunks,
    )  # fmt: skip
    bounds = binary.bounds[0].astype(np.float64).reshape(2, 3)
    return WideTree(box, child, corner, face, normal, bounds, levels)


def tree_of_boxes(
    low: NDArray[np.float32], high: NDArray[np.float32], team: Team
) -> tuple[NDArray[np.float32], NDArray[np.int32], int]:
    """Return (box, child, levels) of a tree whose leaf k is box k, low[k] to high[k]; (n, 3), n >
    0.
    """
    count = len(low)
    # A triangle with two opposite corners of a box is bounded by that box.
    vertices = np.concatenate([low, high])
    first = np.arange(count, dtype=np.int32)
    faces = np.stack([first, first + np.int32(count), first], axis=1)
    for array in (vertices, faces):
        array.setflags(write=False)
    binary = build(vertices, faces, _NO_SPHERES, team, leaf_size=1)
    box, child, leaves, levels = collapse(binary)
    is_leaf = child <= FIRST_LEAF
    child[is_leaf] = FIRST_LEAF - binary.order[leaves[FIRST_LEAF - child[is_leaf], 0]]
    return box, child, levels


def collapse(binary: Bvh) -> tuple[NDArray, NDArray, NDArray, int]:
    """Return (box, child, leaves, levels); leaves, int32 (n, 2), are (start, count) in the binary
    tree's order.
    """
    nodes = len(binary.links)
    room = nodes // 2 + 1  # each wide node replaces at least one inner node, or the only leaf
    box, child = np.empty(room * BOX, np.float32), np.empty(room * WIDTH, np.int32)
    leaves = np.empty((nodes // 2 + 1, 2), np.int32)
    below, row = np.empty((2, nodes), np.int32)
    costs = np.empty((nodes // 2 + 2) * WIDTH, np.float32)
    used, used_leaves, levels = _collapse(
        binary.bounds, binary.links, below, row, costs, box, child, leaves
    )
    flat_box = aligned(used * BOX, np.float32)
    flat_box[:] = box[: used * BOX]
    return (
        flat_box,
        child[: used * WIDTH].copy(),
        leaves[:used_leaves],
        int(levels),
    )


# The binary node, the wide one and its level for each waiting node; the binary nodes and slots of a
# wide node's members.
_waiting = stack_room(types.int64, 3 * WIDTH * _LEVELS)
_member, _slots = stack_room(types.int64, WIDTH), stack_room(types.int64, WIDTH)


@kernel
def _collapse(bounds, links, below, row, costs, box, child, leaves):
    """Collapse the binary tree's nodes into wide ones. Return the numbers of nodes, leaves and
    levels.

    First, compute the cost of each binary node: the least total surface of the wide nodes that its
    subtree takes if it has 1 to WIDTH slots in the node above. In one slot, this is its own surface
    plus the cost of its children in WIDTH slots. In more slots, it is the same, or the cost of its
    children if they share these slots in the best way. Then create the wide nodes from the root on,
    according to the costs. below: scratch for the number of leaves below each binary node.
    row: the start of each node's WIDTH numbers in costs; a leaf's are 0. This is a single function
    because two would take longer to compile.
    """
    # Pointers make a function with many indices faster to compile, and to run.
    bounds, below, leaves = pointer(bounds), pointer(below), pointer(leaves)
    box, child, end, links = pointer(box), pointer(child), len(links), pointer(links)
    row, costs = pointer(row), pointer(costs)
    store(costs, 0, splat(_FAR))
    store(costs, WIDTH, splat(np.float32(0)))
    for m in range(end - 1, -1, -1):  # children come after their parents
        if links[2 * m + 1] != 0:
            below[m], row[m] = 1, WIDTH
            continue
        first = np.int64(links[2 * m])
        below[m] = below[first] + below[first + 1]
        # More slots than leaves are useless, so try those of the child with fewer leaves.
        fewer = first + (below[first] > below[first + 1])
        few, many = np.int64(row[fewer]), np.int64(row[2 * first + 1 - fewer])
        least = splat(_FAR)
        for k in range(1, lesser(np.int64(below[fewer]), WIDTH - 1) + 1):
            # Lane i - 1 is for i slots, k for one child and i - k for the other, which has none in
            # the first k lanes.
            rest = vmax(load(costs, many - k), load(costs, WIDTH - k))
            least = vmin(least, rest + costs[few + k - 1])
        dx = bounds[6 * m + 3] - bounds[6 * m]
        dy = bounds[6 * m + 4] - bounds[6 * m + 1]
        dz = bounds[6 * m + 5] - bounds[6 * m + 2]
        alone = dx * dy + dy * dz + dz * dx + lane_of(least, WIDTH - 1)
        own = first // 2 * WIDTH + 2 * WIDTH  # pairs of children begin at odd indices
        row[m] = own
        store(costs, own, vmin(least, splat(alone)))
    waiting, member, slots = _waiting(), _member(), _slots()
    waiting[0], waiting[1], waiting[2] = 0, 0, 1
    top, nodes, used_leaves, levels = 1, 1, 0, 1
    while top > 0:
        top -= 1
        node, level = waiting[3 * top + 1], waiting[3 * top + 2]
        levels = greater(levels, level)
        # Choose the members with the least cost. Open a member if its slots cost less than a node
        # of its own. Always open one with a slot for each leaf, which costs nothing, and the
        # first one, which becomes the node.
        member[0], slots[0] = waiting[3 * top], WIDTH
        count, i = 1, 0
        while i < count:
            m, s = member[i], slots[i]
            own = np.int64(row[m])
            is_dear = (count > 1) & (below[m] > s) & (costs[own + s - 1] >= costs[own])
            if is_dear | (below[m] == 1):
                i += 1
                continue
            first = np.int64(links[2 * m])
            left, right = np.int64(row[first]) - 1, np.int64(row[first + 1]) - 1
            least, of_left = _FAR, lesser(np.int64(below[first]), s - 1)
            for k in range(greater(1, s - below[first + 1]), of_left + 1):
                cost = costs[left + k] + costs[right + s - k]
                if cost < least:
                    least, of_left = cost, k
            member[i], member[count] = first, first + 1
            slots[i], slots[count] = of_left, s - of_left
            count += 1
        # Write the node; members that are not leaves become nodes of their own.
        for i in range(WIDTH):
            at = node * BOX + i
            if i >= count:
                child[node * WIDTH + i] = NO_CHILD
                for k in range(0, 3 * WIDTH, WIDTH):
                    box[at + k], box[at + k + 3 * WIDTH] = _FAR, -_FAR
                continue
            m = member[i]
            for k in range(6):
                box[at + WIDTH * k] = bounds[6 * m + k]
            start, size = links[2 * m], links[2 * m + 1]
            if size == 0:
                child[node * WIDTH + i] = nodes
                at = 3 * top
                waiting[at], waiting[at + 1], waiting[at + 2] = m, nodes, level + 1
                top += 1
                nodes += 1
            else:
                child[node * WIDTH + i] = FIRST_LEAF - used_leaves
                leaves[2 * used_leaves], leaves[2 * used_leaves + 1] = start, size
                used_leaves += 1
    return nodes, used_leaves, levels


@kernel
def _fill_leaves(vertices, faces, order, leaves, corner, face, normal, control):
    """Store the corners, numbers and normals of the leaves' triangles, in lanes; threads share the
    leaves.
    """
    while True:
        first = take_next(control) * _CHUNK
        if first >= len(leaves):
            return
        for k in range(first, lesser(first + _CHUNK, len(leaves))):
            _fill_leaf(
                pointer(vertices), pointer(faces), pointer(order), leaves[k, 0], leaves[k, 1], k,
                pointer(corner), pointer(face), pointer(normal),
            )  # fmt: skip


@emitted
def _fill_leaf(vertices, faces, order, start, count, k, corner, face, normal):
    """Store leaf k, the triangles order[start : start + count]."""
    lane = i32_of(lane_row() * np.float32(4) + lane_column())
    here = mask_of((i64(1) << count) - 1)
    f = gather(order, lane + start, here)
    store(face, k * WIDTH, select(here, f, np.int32(-1)))
    a, b, c = (_corner(vertices, faces, f * np.int32(3) + np.int32(n), here) for n in range(3))
    for n, point in enumerate((a, b, c)):
        point = select_lanes(here, point, (_NO_CORNER,) * 3)
        store3(corner, k * CORNERS + 3 * WIDTH * n, point)
    # Float64 keeps the normals of small triangles far from the origin accurate.
    across = cross(_minus(b, a), _minus(c, a))
    length = vsqrt(dot(across, across))
    scale = select(length > 0.0, 1.0 / length, 0.0)
    store3(normal, 3 * k * WIDTH, [to_f32(part) for part in times(scale, across)])


@emitted
def _corner(vertices, faces, corner, here):
    """Return x, y, z of 16 triangles' corners; 0 in the lanes outside `here`."""
    at = gather(faces, corner, here) * np.int32(3)
    return tuple(gather(vertices, at + np.int32(axis), here) for axis in range(3))


@emitted
def _minus(a, b):
    return minus(tuple(map(to_f64, a)), tuple(map(to_f64, b)))
