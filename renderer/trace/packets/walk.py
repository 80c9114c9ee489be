"""A tile's way through the two levels of trees.

Owns the order in which nodes are visited. Knows nothing of what is in a leaf.

The nodes that wait are a stack with the nearest on top, each with the least depth that anything in
it can have; a node that begins behind all that the tile sees is dropped.
"""

from __future__ import annotations

import numpy as np

from renderer.trace.bvh.bvh16 import CORNERS, FIRST_LEAF, WIDTH
from renderer.trace.compile.compiled import inlined
from renderer.trace.packets.leaf import rasterize_leaf
from renderer.trace.packets.sphere import intersect_sphere
from renderer.trace.packets.tile import (
    DEPTHS,
    WAITING_DEPTHS,
    WAITING_NODES,
    children_in_tile,
    set_planes,
)
from renderer.trace.simd.lanes import bits, lowest_bit
from renderer.trace.simd.memory import prefetch, store


@inlined
def farthest_seen(view, least):
    """Z of what has the key `least`."""
    return -least if view.parallel else np.float32(1) / least


@inlined
def push_children(inside, depth, child, node, top, floats, ints):
    """Puts a node's children on the stack, the nearest on top; gives the stack's new height."""
    found = bits(inside)
    if found == 0:
        return top
    store(floats, DEPTHS, depth)
    base = top
    while found != 0:
        lane = lowest_bit(found)
        found &= found - 1
        # By insertion: there are few.
        z = floats[DEPTHS + lane]
        i = top
        while i > base and floats[WAITING_DEPTHS + i - 1] < z:
            floats[WAITING_DEPTHS + i] = floats[WAITING_DEPTHS + i - 1]
            ints[WAITING_NODES + i] = ints[WAITING_NODES + i - 1]
            i -= 1
        floats[WAITING_DEPTHS + i] = z
        ints[WAITING_NODES + i] = child[node * WIDTH + lane]
        top += 1
    return top


@inlined
def walk_world(view, world, tile, floats, ints):
    """Lets the tile's pixels see the scene: the upper tree, spheres and instances."""
    space = world.instances
    least = view.key_far
    floats[WAITING_DEPTHS], ints[WAITING_NODES] = np.float32(-np.inf), world.top
    if world.top == 0:
        set_planes(view, space, tile, floats, ints)
    top = 1
    while top > 0:
        top -= 1
        if floats[WAITING_DEPTHS + top] >= farthest_seen(view, least):
            continue
        node = np.int64(ints[WAITING_NODES + top])
        if node >= 0:
            z_far = farthest_seen(view, least)
            inside, depth = children_in_tile(view, world.top_box, node, z_far, floats, ints)
            top = push_children(inside, depth, world.top_child, node, top, floats, ints)
            continue
        item = FIRST_LEAF - node
        if item >= space:
            least = intersect_sphere(view, world.spheres, item - space, tile, least, floats, ints)
            continue
        set_planes(view, item, tile, floats, ints)
        least = walk_instance(view, world, item, tile, top, least, floats, ints)
        if top > 0:
            set_planes(view, space, tile, floats, ints)


@inlined
def walk_instance(view, world, space, tile, base, least, floats, ints):
    """Lets the tile's pixels see an instance, whose planes are set; gives the new least key."""
    floats[WAITING_DEPTHS + base] = np.float32(-np.inf)
    ints[WAITING_NODES + base] = world.root[space]
    top = base + 1
    while top > base:
        top -= 1
        z_far = farthest_seen(view, least)
        if floats[WAITING_DEPTHS + top] >= z_far:
            continue
        node = np.int64(ints[WAITING_NODES + top])
        if node >= 0:
            inside, depth = children_in_tile(view, world.box, node, z_far, floats, ints)
            top = push_children(inside, depth, world.child, node, top, floats, ints)
        else:
            # Ask for the next leaf's corners while this one is at work.
            following = FIRST_LEAF - np.int64(ints[WAITING_NODES + top - 1])
            if following >= 0 and top > base:
                for line in range(0, CORNERS, 16):
                    prefetch(world.corner, following * CORNERS + line)
            leaf = FIRST_LEAF - node
            least = rasterize_leaf(view, world.corner, leaf, space, tile, least, floats, ints)
    return least
