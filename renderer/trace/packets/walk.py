"""A tile's way through the two levels of trees.

Owns the order in which nodes are visited. Knows nothing of what is in a leaf.

The nodes that wait are a stack with the nearest on top, each with the least depth that anything in
it can have, and with its footprint; a node that begins behind all that the pixels of its squares
see is dropped.
"""

from __future__ import annotations

import numpy as np

from renderer.trace.bvh.bvh16 import CORNERS, FIRST_LEAF, WIDTH
from renderer.trace.compile.compiled import inlined
from renderer.trace.packets.footprint import ANY_DEPTH, WHOLE_TILE, children_in_tile, open_squares
from renderer.trace.packets.leaf import rasterize_leaf
from renderer.trace.packets.sphere import intersect_sphere
from renderer.trace.packets.tile import (
    DEPTHS,
    FOOTPRINTS,
    WAITING_DEPTHS,
    WAITING_NODES,
    set_planes,
)
from renderer.trace.simd.lanes import bits, lowest_bit
from renderer.trace.simd.memory import prefetch, store


@inlined
def farthest_seen(view, least):
    """Z of what has the key `least`."""
    return -least if view.parallel else np.float32(1) / least


@inlined
def _push(top, depth, node, footprint, floats, ints):
    """Writes one entry of the stack."""
    floats[WAITING_DEPTHS + top] = depth
    ints[WAITING_NODES + 2 * top] = node
    ints[WAITING_NODES + 2 * top + 1] = footprint


@inlined
def push_children(view, children, child, node, top, floats, ints):
    """Push a node's children onto the stack, the nearest on top. Return the stack's new height.

    children: of children_in_tile().
    """
    inside, depth, footprint, has_small = children
    found = bits(inside)
    if found == 0:
        return top
    store(floats, DEPTHS, depth)
    if has_small:
        store(ints, FOOTPRINTS, footprint)
    base = top
    while found != 0:
        lane = lowest_bit(found)
        found &= found - 1
        z, squares = floats[DEPTHS + lane], WHOLE_TILE
        if has_small:
            squares = ints[FOOTPRINTS + lane]
            if open_squares(view, squares, z, floats) == 0:
                continue
        # By insertion: there are few.
        i = top
        while i > base and floats[WAITING_DEPTHS + i - 1] < z:
            below = WAITING_NODES + 2 * (i - 1)
            _push(i, floats[WAITING_DEPTHS + i - 1], ints[below], ints[below + 1], floats, ints)
            i -= 1
        _push(i, z, child[node * WIDTH + lane], squares, floats, ints)
        top += 1
    return top


@inlined
def walk_world(view, world, tile, floats, ints):
    """Lets the tile's pixels see the scene: the upper tree, spheres and instances."""
    space = world.instances
    least = view.key_far
    _push(0, ANY_DEPTH, world.top, WHOLE_TILE, floats, ints)
    if world.top == 0:
        set_planes(view, space, tile, floats, ints)
    top = 1
    while top > 0:
        top -= 1
        z, footprint = floats[WAITING_DEPTHS + top], ints[WAITING_NODES + 2 * top + 1]
        if open_squares(view, footprint, z, floats) == 0:
            continue
        node = np.int64(ints[WAITING_NODES + 2 * top])
        if node >= 0:
            z_far = farthest_seen(view, least)
            children = children_in_tile(view, world.top_box, node, z_far, floats, ints)
            top = push_children(view, children, world.top_child, node, top, floats, ints)
            continue
        item = FIRST_LEAF - node
        if item >= space:
            least = intersect_sphere(view, world.spheres, item - space, tile, least, floats, ints)
            continue
        set_planes(view, item, tile, floats, ints)
        least = walk_instance(view, world, item, footprint, tile, top, least, floats, ints)
        if top > 0:
            set_planes(view, space, tile, floats, ints)


@inlined
def walk_instance(view, world, space, footprint, tile, base, least, floats, ints):
    """Trace an instance, whose planes are set, for the tile. Return the new least key."""
    _push(base, ANY_DEPTH, world.root[space], footprint, floats, ints)
    top = base + 1
    while top > base:
        top -= 1
        z, footprint = floats[WAITING_DEPTHS + top], ints[WAITING_NODES + 2 * top + 1]
        squares = open_squares(view, footprint, z, floats)
        if squares == 0:
            continue
        node = np.int64(ints[WAITING_NODES + 2 * top])
        if node >= 0:
            z_far = farthest_seen(view, least)
            children = children_in_tile(view, world.box, node, z_far, floats, ints)
            top = push_children(view, children, world.child, node, top, floats, ints)
        else:
            # Ask for the next leaf's corners while this one is at work.
            if top > base:
                following = FIRST_LEAF - np.int64(ints[WAITING_NODES + 2 * top - 2])
                if following >= 0:
                    for line in range(0, CORNERS, 16):
                        prefetch(world.corner, following * CORNERS + line)
            leaf = FIRST_LEAF - node
            least = rasterize_leaf(
                view, world, leaf, space, tile, footprint, squares, z, least, floats, ints
            )
    return least
