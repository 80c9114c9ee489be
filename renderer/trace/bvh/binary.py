"""The builder of the bounding volume hierarchy: a binary tree over all triangles and spheres.

A team of threads builds the tree. sah_split.py selects the splits; traverse.py defines the layout
that is traversed.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numba.core import types
from numpy.typing import NDArray

from lucida.renderer.scene.flat import FlatScene
from lucida.renderer.scene.positions import world_vertices
from lucida.renderer.trace.compile.compiled import inlined, kernel
from lucida.renderer.trace.compile.emit import greater, lesser
from lucida.renderer.trace.reference.traverse import Tree
from lucida.renderer.trace.reference.vectors import row
from lucida.renderer.trace.threads.atomic import take_next
from lucida.renderer.trace.threads.thread_pool import Team, new_control
from lucida.renderer.trace.vector.lanes import LANES
from lucida.renderer.trace.vector.memory import load, pointer, stack_room, store

from .sah_split import (
    BINS,
    HIGH,
    NUMBER,
    NUMBERED,
    RECORD,
    ROOM_OF_BINS,
    best_split,
    bounds_of_records,
    partition,
)

F32 = NDArray[np.float32]
I32 = NDArray[np.int32]

LEAF_SIZE = 4  # primitives
MAX_DEPTH = 48  # deeper nodes are halved by count, regardless of their shape, to bound the depth
PIECE = 4096  # least primitives in the subtrees that threads take; none if there are fewer than two
CHUNK = 4096  # primitives that a thread takes at a time


class Bvh(NamedTuple):
    """A binary tree over numbered primitives.

    bounds: float32 (nodes, 6), low x, y, z, high x, y, z. Node 0 is the root; a child's box is
        inside its parent's.
    links: int32 (nodes, 2): (first child, 0) for an inner node, with the second child in the next
        node; (start, count) for a leaf of the primitives order[start : start + count], count > 0.
    order: int32 (n,), each primitive's number once.
    depth: number of nodes on the longest path from the root to a leaf, including both.
    """

    bounds: np.ndarray
    links: np.ndarray
    order: np.ndarray
    depth: int


def build(vertices: F32, faces: I32, spheres: F32, team: Team, leaf_size: int = LEAF_SIZE) -> Bvh:
    """Return the tree over primitives, with at most leaf_size per leaf; no nodes for no primitives.

    vertices (n, 3), faces (m, 3), spheres (k, 4; centre, radius): read-only, in the same space.

    The threads first split the top of the tree, halving the pieces until each thread has some. They
    then split these into pieces small enough to balance the load, and build their subtrees.
    """
    count = len(faces) + len(spheres)
    # A tree of n leaves has 2 n - 1 nodes; unused pages cost nothing.
    bounds, links = np.empty((2 * count, 6), np.float32), np.empty((2 * count, 2), np.int32)
    levels = np.empty(2 * count, np.uint8)
    if not count:
        return _read_only(Bvh(bounds, links, np.empty(0, np.int32), 0))
    records = np.empty((count + 1, RECORD), np.float32)  # the last is read, but not used
    records[-1] = 0
    numbers = records.view(np.int32)[:count]
    _share(team, count, _fill_records, vertices, faces, spheres, records[:count], numbers)

    levels[0], links[0] = 1, (0, count)
    used, piece = 1, max(PIECE, count // (16 * team.size))
    for largest in (*_sizes(count, piece), leaf_size):
        jobs = _jobs(links, levels, used, largest)
        team.run(
            _grow_pieces, records, bounds, links, levels, jobs, largest, leaf_size, new_control(),
            size=len(jobs),
        )  # fmt: skip
        used = _close_gaps(bounds, links, levels, jobs, used)
    depth = int(levels[:used].max())
    order = numbers[:, NUMBER] - np.int32(NUMBERED)
    return _read_only(Bvh(bounds[:used].copy(), links[:used].copy(), order, depth))


def tree_of_scene(flat: FlatScene, team: Team, leaf_size: int = LEAF_SIZE) -> Tree:
    """Return the tree of a scene with its shapes, in the order of the leaves, for closest_hit.

    All numbers except the boxes are float64, relative to the scene's centre.
    """
    middle = flat.bounds.mean(axis=0)
    vertices, spheres = world_vertices(flat, middle), flat.spheres.copy()
    spheres[:, :3] -= middle
    points, balls = vertices.astype(np.float32), spheres.astype(np.float32)
    for array in (points, balls):
        array.setflags(write=False)
    bvh = build(points, flat.faces, balls, team, leaf_size)
    shapes = np.zeros((len(bvh.order), 9))
    _share(team, len(shapes), _fill_shapes, vertices, flat.faces, spheres, bvh.order, shapes)
    shapes[_without_area(flat)[bvh.order]] = np.nan
    # One node waits at each level, and a last one is pushed before it is popped.
    extent = float(np.abs(bvh.bounds[:1]).max(initial=0.0))
    triangles, room = len(flat.faces), bvh.depth + 1
    return _read_only(
        Tree(middle, bvh.bounds, bvh.links, bvh.order, shapes, triangles, room, extent, flat)
    )


def _without_area(flat: FlatScene) -> NDArray[np.bool_]:
    """Return a mask of the primitives without a normal, which must not be hit.

    They are tested in their own space, because rounding might give a degenerate triangle an area in
    world space.
    """
    a, b, c = (flat.vertices[flat.faces[:, k]].astype(np.float64) for k in range(3))
    is_flat = ~np.cross(b - a, c - a).any(axis=1)
    return np.append(is_flat, np.zeros(len(flat.spheres), np.bool_))


def _read_only(tree: Any) -> Any:
    """Return the tree with read-only arrays, as in the scene: a single type for the compiler."""
    for item in tree:
        if isinstance(item, np.ndarray):
            item.setflags(write=False)
    return tree


def _share(team: Team, count: int, fill: Any, *arrays: np.ndarray) -> None:
    """Run a kernel that takes chunks of `count` primitives."""
    team.run(fill, *arrays, new_control(), size=count // CHUNK)  # less is not worth a thread


# Columns of a job: the node, its records, its level, the first node number that it may use, and,
# once done, the number after the last one used.
_NODE, _START, _END, _LEVEL, _FREE, _USED = range(6)


def _sizes(count: int, piece: int) -> list[int]:
    """Return the largest size of nodes after each round: three halvings, then `piece`.

    There are few rounds because each computes the bounds of its records again.
    """
    sizes = [size for size in (count >> 1, count >> 2, count >> 3) if size > piece]
    return sizes + [piece] * (count > 2 * piece)


def _jobs(links: np.ndarray, levels: np.ndarray, used: int, leaf_size: int) -> np.ndarray:
    """Return a job for each leaf that is too large, with space for the nodes it may need.

    The root is always a job, because its bounds are not known yet.
    """
    if used == 1:
        return np.array([[0, 0, links[0, 1], 1, 1, 1]], np.int64)
    node = np.flatnonzero(links[:used, 1] > leaf_size)
    start, size = links[node].astype(np.int64).T
    free = used + np.cumsum(2 * size - 2) - (2 * size - 2)
    return np.stack([node, start, start + size, levels[node], free, free], axis=1)


def _close_gaps(
    bounds: np.ndarray, links: np.ndarray, levels: np.ndarray, jobs: np.ndarray, used: int
) -> int:
    """Move the subtrees' nodes together. Return the number of nodes."""
    for job in jobs:
        first, last = int(job[_FREE]), int(job[_USED])
        shift = first - used
        if not shift:
            used = last
            continue
        nodes = slice(used, used + last - first)
        for array in (bounds, links, levels):
            array[nodes] = array[first:last]
        for part in (links[nodes], links[job[_NODE] : job[_NODE] + 1]):
            part[part[:, 1] == 0, 0] -= shift
        used = nodes.stop
    return used


@kernel
def _fill_records(vertices, faces, spheres, records, numbers, control):
    """Fill the records that sah_split.py sorts, with boxes."""
    triangles, count = len(faces), len(records)
    while True:
        start = take_next(control) * CHUNK
        if start >= count:
            return
        # The indices of pointers are not checked for negative values.
        corners, points, boxes = pointer(faces), pointer(vertices), pointer(records)
        for i in range(start, lesser(start + CHUNK, count)):
            at = RECORD * i
            numbers[i, NUMBER] = i | np.int64(NUMBERED)
            boxes[at + HIGH + 3] = 0
            if i < triangles:
                first, second = 3 * np.int64(corners[3 * i]), 3 * np.int64(corners[3 * i + 1])
                third = 3 * np.int64(corners[3 * i + 2])
                for axis in range(3):
                    a, b, c = points[first + axis], points[second + axis], points[third + axis]
                    boxes[at + axis] = -lesser(lesser(a, b), c)
                    boxes[at + HIGH + axis] = greater(greater(a, b), c)
                continue
            s = i - triangles
            for axis in range(3):
                low = spheres[s, axis] - spheres[s, 3]
                high = spheres[s, axis] + spheres[s, 3]
                # Extend the box by more than the rounding error of the line above.
                boxes[at + axis] = abs(low) * np.float32(1.2e-7) - low
                boxes[at + HIGH + axis] = high + abs(high) * np.float32(1.2e-7)


@kernel
def _fill_shapes(vertices, faces, spheres, order, shapes, control):
    """Store the corners of triangles, or centres and radii of spheres, in the order of the
    leaves.
    """
    triangles, count = len(faces), len(order)
    while True:
        start = take_next(control) * CHUNK
        if start >= count:
            return
        for i in range(start, lesser(start + CHUNK, count)):
            number = order[i]
            if number >= triangles:
                for k in range(4):
                    shapes[i, k] = spheres[number - triangles, k]
                continue
            a, b, c = (
                row(vertices, np.int64(faces[number, 0])),
                row(vertices, np.int64(faces[number, 1])),
                row(vertices, np.int64(faces[number, 2])),
            )
            for k in range(3):
                shapes[i, k], shapes[i, 3 + k], shapes[i, 6 + k] = a[k], b[k], c[k]


# Each waiting node is less than half of the previous one, because smaller halves are built first.
_WAITING = 72
_waiting, _waiting_bounds = (
    stack_room(types.int64, 4 * _WAITING),
    stack_room(types.float32, LANES * _WAITING),
)
_bins, _counts = stack_room(types.float32, ROOM_OF_BINS), stack_room(types.int32, 4 * BINS)


@kernel
def _grow_pieces(records, bounds, links, levels, jobs, largest, leaf_size, control):
    """Take jobs and build each one's subtree, down to nodes of `largest` primitives."""
    waiting, waiting_bounds, scratch = _waiting(), _waiting_bounds(), (_bins(), _counts())
    while True:
        j = take_next(control)
        if j >= len(jobs):
            return
        _grow(
            pointer(records), bounds, links, levels, jobs[j], largest, leaf_size,
            waiting, waiting_bounds, scratch,
        )  # fmt: skip


@inlined
def _grow(
    records, bounds, links, levels, job, largest, leaf_size, waiting, waiting_bounds, scratch
):
    """Build a job's subtree, with nodes of at most `largest` primitives. Store the index after its
    last node.
    """
    free = job[_FREE]
    for k in range(4):
        waiting[k] = job[k]
    store(waiting_bounds, 0, bounds_of_records(records, job[_START], job[_END]))
    top = 1
    while top > 0:
        top -= 1
        node, start = waiting[4 * top + _NODE], waiting[4 * top + _START]
        end, level = waiting[4 * top + _END], waiting[4 * top + _LEVEL]
        own = load(waiting_bounds, LANES * top)
        for axis in range(3):
            bounds[node, axis] = -waiting_bounds[LANES * top + axis]
            bounds[node, 3 + axis] = waiting_bounds[LANES * top + HIGH + axis]
        levels[node] = level
        if end - start <= largest:
            links[node, 0], links[node, 1] = start, end - start
            continue
        links[node, 0], links[node, 1] = free, 0

        # Split at the least cost, or by count if no split has a cost.
        middle, left, right = start, own, own
        if level < MAX_DEPTH:
            axis, last_bin = best_split(records, start, end, own, leaf_size, scratch)
            if axis >= 0:
                middle, left, right = partition(records, start, end, own, axis, last_bin)
        if (middle == start) | (middle == end):
            middle = (start + end) // 2
            left = bounds_of_records(records, start, middle)
            right = bounds_of_records(records, middle, end)

        # The larger half waits below the smaller one.
        left_is_larger = middle - start > end - middle
        for turn in range(2):
            is_left = left_is_larger == (turn == 0)
            waiting[4 * top + _NODE] = free if is_left else free + 1
            waiting[4 * top + _START] = start if is_left else middle
            waiting[4 * top + _END] = middle if is_left else end
            waiting[4 * top + _LEVEL] = level + 1
            store(waiting_bounds, LANES * top, left if is_left else right)
            top += 1
        free += 2
    job[_USED] = free
