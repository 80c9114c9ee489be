"""The traversal of the two levels of trees by a tile's rays.

The waiting nodes are a stack with the nearest on top, each with a lower bound of the depths in it
and with its footprint. A node is dropped if it begins behind everything visible at the pixels of
its squares.
"""

from __future__ import annotations

from functools import partial

import numpy as np

from lucida.renderer.trace.bvh.bvh16 import BOX, CORNERS, FIRST_LEAF, WIDTH
from lucida.renderer.trace.compile.compiled import inlined
from lucida.renderer.trace.compile.emit import choose, emitted, i64
from lucida.renderer.trace.vector.gather import prefetch
from lucida.renderer.trace.vector.lanes import LANES, bits, lowest_bit
from lucida.renderer.trace.vector.memory import store

from .footprint import ANY_DEPTH, WHOLE_TILE, children_in_tile, open_squares
from .leaf import rasterize_leaf
from .lens_frame import turn_rows
from .sphere import intersect_sphere
from .tile import set_space


@emitted
def farthest_seen(view, least):
    """Return the Z of the key `least`."""
    return choose(view.parallel, lambda: -least, lambda: np.float32(1) / least)


@emitted
def _push(top, depth, node, footprint, scratch):
    """Write one entry of the stack."""
    scratch.waiting_depths[top] = depth
    scratch.waiting[2 * top] = node
    scratch.waiting[2 * top + 1] = footprint


@inlined
def push_children(view, children, child, node, top, scratch):
    """Push a node's children onto the stack, the nearest on top. Return the stack's new height.

    children: of children_in_tile().
    """
    inside, depth, footprint, has_small = children
    found = bits(inside)
    if found == 0:
        return top
    store(scratch.depths, 0, depth)
    if has_small:
        store(scratch.footprints, 0, footprint)
    base = top
    while found != 0:
        lane = lowest_bit(found)
        found &= found - 1
        z, squares = scratch.depths[lane], WHOLE_TILE
        if has_small:
            squares = scratch.footprints[lane]
            if open_squares(view, squares, z, scratch) == 0:
                continue
        # Insertion sort, since there are few.
        i = top
        while i > base and scratch.waiting_depths[i - 1] < z:
            node_below, footprint_below = scratch.waiting[2 * i - 2], scratch.waiting[2 * i - 1]
            _push(i, scratch.waiting_depths[i - 1], node_below, footprint_below, scratch)
            i -= 1
        _push(i, z, child[node * WIDTH + lane], squares, scratch)
        top += 1
    return top


@inlined
def walk_world(view, world, tile, least, scratch):
    """Trace the scene for the tile: the upper tree, spheres and instances. least: the tile's least
    key."""
    space = world.instances
    _push(0, ANY_DEPTH, world.top, WHOLE_TILE, scratch)
    if world.top == 0:
        turn_rows(view, space, scratch)
        set_space(view, space, tile, scratch)
    top = 1
    while top > 0:
        top -= 1
        z, footprint = scratch.waiting_depths[top], scratch.waiting[2 * top + 1]
        if open_squares(view, footprint, z, scratch) == 0:
            continue
        node = np.int64(scratch.waiting[2 * top])
        if node >= 0:
            z_far = farthest_seen(view, least)
            children = children_in_tile(view, world.top_box, node, z_far, scratch)
            top = push_children(view, children, world.top_child, node, top, scratch)
            continue
        item = FIRST_LEAF - node
        if item >= space:
            least = intersect_sphere(view, world.spheres, item - space, tile, least, scratch)
            continue
        turn_rows(view, item, scratch)
        set_space(view, item, tile, scratch)
        least = walk_instance(view, world, item, footprint, tile, top, least, scratch)
        if top > 0:
            set_space(view, space, tile, scratch)


@emitted
def _prefetch_next(world, base, top, scratch):
    """Prefetch the memory that the visits to the next two entries will read."""
    for entry in top - 1, top - 2:
        choose(entry >= base, partial(_prefetch, world, scratch.waiting, entry), lambda: None)


@emitted
def _prefetch(world, waiting, entry):
    node = i64(waiting[2 * entry])

    def inner():
        prefetch(world.child, node * WIDTH)
        for line in range(0, BOX, LANES):
            prefetch(world.box, node * BOX + line)

    def leaf():
        for line in range(0, CORNERS, LANES):
            prefetch(world.corner, (FIRST_LEAF - node) * CORNERS + line)

    choose(node >= 0, inner, leaf)


@inlined
def walk_instance(view, world, space, footprint, tile, base, least, scratch):
    """Trace an instance, whose space is set up, for the tile. Return the new least key."""
    _push(base, ANY_DEPTH, world.root[space], footprint, scratch)
    top = base + 1
    while top > base:
        top -= 1
        z, footprint = scratch.waiting_depths[top], scratch.waiting[2 * top + 1]
        squares = open_squares(view, footprint, z, scratch)
        if squares == 0:
            continue
        node = np.int64(scratch.waiting[2 * top])
        if node >= 0:
            z_far = farthest_seen(view, least)
            children = children_in_tile(view, world.box, node, z_far, scratch)
            top = push_children(view, children, world.child, node, top, scratch)
        _prefetch_next(world, base, top, scratch)
        if node < 0:
            leaf = FIRST_LEAF - node
            least = rasterize_leaf(
                view, world, leaf, space, tile, footprint, squares, z, least, scratch
            )
    return least
