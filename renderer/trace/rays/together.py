"""Traversal of a mesh's tree by 16 rays together, as long as they stay together.

A node is tested once against the whole bundle (bundle.py), and if that succeeds, against its rays,
in lanes. If only a few rays are left, each continues alone (traverse.py).

Source: Benthin, Wald, Woop, Ernst and Mark, "Combining Single and Packet-Ray Tracing for Arbitrary
Ray Distributions on the Intel MIC Architecture", 2012.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from renderer.trace.bvh.bvh16 import BOX, CORNERS, FIRST_LEAF, WIDTH
from renderer.trace.compile.compiled import inlined
from renderer.trace.rays.bundle import (
    are_coherent,
    children_in_spread,
    most_of,
    ray_of_lane,
    rays_in_lanes,
    rays_on_child,
    rays_on_triangle,
    regular,
    space_ray_of,
    spread_of,
    store_rays,
    triangles_in_spread,
    turns_of,
)
from renderer.trace.rays.traverse import any_in_instance, children_on_ray, closest_from
from renderer.trace.rays.waiting import nearest_child
from renderer.trace.simd.lanes import (
    LANES,
    bits,
    count_bits,
    lane_of,
    lowest_bit,
    mask_of,
    select,
    splat,
)
from renderer.trace.simd.memory import load, store

ALONE = 4  # this many rays, or fewer, continue one by one
MOST = 9  # at least this many rays start as a bundle


class Scratch(NamedTuple):
    """One thread's memory, as pointers.

    depths, nodes, masks: of the waiting nodes; the first 16 floats of depths are for traverse.py.
    columns: of 16 rays (store_rays()). turns, closest, slots: for each ray, its octant and axis,
    and the closest hit so far. founds, enters: for each ray, the children of a node that it hits,
    and their depths (16 per ray).
    """

    depths: Any
    nodes: Any
    masks: Any
    columns: Any
    turns: Any
    closest: Any
    slots: Any
    founds: Any
    enters: Any


@inlined
def _bundle(origin, direction, rays, t_max, scratch):
    """Store 16 rays, of which those in the bits of `rays` are active.

    Returns the rays that start as a bundle: as a SpaceRay, their spread and their bits.
    """
    turns = turns_of(direction)
    parts = rays_in_lanes(origin, direction, turns)
    store_rays(scratch.columns, parts)
    store(scratch.turns, 0, turns)
    store(scratch.closest, 0, t_max)
    turn = lane_of(turns, 0)
    ray = space_ray_of(np.int64(turn), parts)
    mask = mask_of(rays) & (turns == turn) & regular(ray)
    bundle = bits(mask)
    if count_bits(bundle) < MOST or not are_coherent(ray, mask):
        bundle = np.int64(0)
    return ray, spread_of(origin, ray, mask), bundle


@inlined
def _enter(world, node, rays, t_min, scratch):
    """Return the bits of the rays that hit any child of a node. Store their children and depths in
    founds and enters.

    This loop does nothing else: the rays' tests are independent, so they overlap in the processor,
    whereas each step of a single ray waits for the previous one.
    """
    left, met = rays, np.int64(0)
    while left != 0:
        lane = lowest_bit(left)
        left &= left - 1
        single = ray_of_lane(scratch.columns, np.int64(scratch.turns[lane]), lane)
        inside, depth = children_on_ray(world.box, node, single, t_min, scratch.closest[lane])
        found = bits(inside)
        scratch.founds[lane] = found
        store(scratch.enters, LANES * lane, depth)
        met |= np.int64(found != 0) << lane
    return met


@inlined
def any_of_16(world, origin, direction, root, rays, t_min, t_max, scratch):
    """Return the bits of the rays that hit any triangle. t_max: F32."""
    ray, spread, bundle = _bundle(origin, direction, rays, t_max, scratch)
    nodes, masks = scratch.nodes, scratch.masks
    # Pop the bundle first.
    nodes[0], masks[0], nodes[1], masks[1] = root, rays & ~bundle, root, bundle
    top, left = 2, rays
    reach = most_of(t_max, mask_of(bundle))
    while top > 0:
        top -= 1
        node, active = np.int64(nodes[top]), masks[top] & left
        if (top == 0) | (count_bits(active) <= ALONE):
            while active != 0:
                lane = lowest_bit(active)
                active &= active - 1
                single = ray_of_lane(scratch.columns, np.int64(scratch.turns[lane]), lane)
                limit = scratch.closest[lane]
                if any_in_instance(world, single, node, top, t_min, limit, nodes):
                    left &= ~(np.int64(1) << lane)
        elif node >= 0:
            found = bits(children_in_spread(world.box, node, ray, spread, t_min, reach)[0])
            while found != 0:
                child = lowest_bit(found)
                found &= found - 1
                inside = rays_on_child(world.box, node * BOX + child, ray, t_min, t_max)
                here = bits(inside) & active
                nodes[top], masks[top] = world.child[node * WIDTH + child], here
                top += here != 0
        else:
            leaf = FIRST_LEAF - node
            found = triangles_in_spread(world.corner, leaf, ray, spread, t_min, reach)
            while found != 0:
                at = leaf * CORNERS + lowest_bit(found)
                found &= found - 1
                left &= ~(bits(rays_on_triangle(world.corner, at, ray, t_min, t_max)[0]) & active)
        if left == 0:
            break
    return rays & ~left


@inlined
def closest_of_16(world, origin, direction, root, rays, t_min, t_max, scratch):
    """Store the closest triangle of each of the rays in scratch.closest and scratch.slots; -1 for
    none.

    t_max: F32.
    """
    ray, spread, bundle = _bundle(origin, direction, rays, t_max, scratch)
    store(scratch.slots, 0, splat(np.int32(-1)))
    depths, nodes, masks = scratch.depths, scratch.nodes, scratch.masks
    # Pop the bundle first.
    depths[LANES], depths[LANES + 1] = np.float32(-np.inf), np.float32(-np.inf)
    nodes[0], masks[0], nodes[1], masks[1] = root, rays & ~bundle, root, bundle
    top = 2
    far = most_of(t_max, mask_of(bundle))
    while top > 0:
        top -= 1
        depth = depths[LANES + top]
        if (top > 0) & (depth >= far):
            continue
        closest = load(scratch.closest, 0)
        node, active = np.int64(nodes[top]), masks[top] & bits(closest > depth)
        if (top == 0) | (count_bits(active) <= ALONE):
            if node >= 0:
                active = _enter(world, node, active, t_min, scratch)
            while active != 0:
                lane = lowest_bit(active)
                active &= active - 1
                single = ray_of_lane(scratch.columns, np.int64(scratch.turns[lane]), lane)
                begin, height = node, top
                if node >= 0:
                    begin, height = nearest_child(
                        np.int64(scratch.founds[lane]), load(scratch.enters, LANES * lane),
                        world.child, node, top, depths, nodes,
                    )  # fmt: skip
                t, slot = closest_from(
                    world, single, begin, height, top, t_min, scratch.closest[lane], depths, nodes
                )
                if slot >= 0:
                    scratch.closest[lane], scratch.slots[lane] = t, slot
            far = most_of(load(scratch.closest, 0), mask_of(bundle))
        elif node >= 0:
            inside, near = children_in_spread(world.box, node, ray, spread, t_min, far)
            found = bits(inside)
            store(depths, 0, near)
            base = top
            while found != 0:
                child = lowest_bit(found)
                found &= found - 1
                inside = rays_on_child(world.box, node * BOX + child, ray, t_min, closest)
                here = bits(inside) & active
                if here != 0:
                    # Insertion sort: there are few.
                    t, i = depths[child], top
                    while i > base and depths[LANES + i - 1] < t:
                        depths[LANES + i] = depths[LANES + i - 1]
                        nodes[i], masks[i] = nodes[i - 1], masks[i - 1]
                        i -= 1
                    depths[LANES + i], masks[i] = t, here
                    nodes[i] = world.child[node * WIDTH + child]
                    top += 1
        else:
            leaf = FIRST_LEAF - node
            found = triangles_in_spread(world.corner, leaf, ray, spread, t_min, far)
            slots = load(scratch.slots, 0)
            while found != 0:
                triangle = lowest_bit(found)
                found &= found - 1
                at = leaf * CORNERS + triangle
                inside, t = rays_on_triangle(world.corner, at, ray, t_min, closest)
                inside = inside & mask_of(active)
                closest = select(inside, t, closest)
                slots = select(inside, splat(np.int32(leaf * WIDTH + triangle)), slots)
            store(scratch.closest, 0, closest)
            store(scratch.slots, 0, slots)
            far = most_of(closest, mask_of(bundle))
