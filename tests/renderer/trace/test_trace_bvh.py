"""The tree: every primitive once, every box around what is below it, for any scene."""

from dataclasses import replace

import numpy as np
import pytest
from trace_reference import cast, random_scene, scene_of, tree_of

from lucida.renderer.scene.flat import flatten
from lucida.renderer.scene.model import Mesh, Scene, Sphere
from lucida.renderer.trace.bvh.binary import MAX_DEPTH, build
from lucida.renderer.trace.threads.thread_pool import Team


def binary(flat, team, leaf_size=4):
    """The tree over a scene whose meshes all stand at the origin."""
    spheres = flat.spheres.astype(np.float32)
    spheres.setflags(write=False)
    return build(flat.vertices, flat.faces, spheres, team, leaf_size)


def primitive_boxes(flat):
    corners = flat.vertices[flat.faces].astype(float).reshape(-1, 3, 3)
    spheres = flat.spheres.astype(np.float32).astype(float)
    centre, radius = spheres[:, :3], spheres[:, 3:]
    low = np.concatenate([corners.min(axis=1), centre - radius])
    return low, np.concatenate([corners.max(axis=1), centre + radius])


def check(flat, bvh, leaf_size):
    count = len(flat.faces) + len(flat.spheres)
    assert sorted(bvh.order) == list(range(count))
    low, high = primitive_boxes(flat)
    visits = np.zeros(count, int)
    used = np.zeros(len(bvh.bounds), int)
    deepest = 0
    stack = [(0, 1)] if count else []
    while stack:
        node, level = stack.pop()
        used[node] += 1
        deepest = max(deepest, level)
        first, size = (int(number) for number in bvh.links[node])
        box = bvh.bounds[node]
        if size:
            assert size <= leaf_size
            visits[first : first + size] += 1
            members = bvh.order[first : first + size]
            assert (box[:3] <= low[members]).all()
            assert (box[3:] >= high[members]).all()
        else:
            for child in (first, first + 1):
                assert (box[:3] <= bvh.bounds[child, :3]).all()
                assert (box[3:] >= bvh.bounds[child, 3:]).all()
                stack.append((child, level + 1))
    assert (visits == 1).all()
    assert (used == 1).all()
    assert deepest == bvh.depth


RANDOM = random_scene(np.random.default_rng(1))


def unmoved(shape):
    return replace(shape, transform=np.eye(4)) if isinstance(shape, Mesh) else shape


def soup(count, seed=0, spread=1.0):
    random = np.random.default_rng(seed)
    centres = random.normal(size=(count, 1, 3)) * spread
    vertices = (centres + 0.1 * random.normal(size=(count, 3, 3))).reshape(-1, 3)
    return scene_of(Mesh(vertices, np.arange(3 * count).reshape(-1, 3)))


@pytest.mark.parametrize(("threads", "leaf_size"), [(1, 16), (2, 1), (3, 4)])
def test_every_primitive_is_in_one_leaf(threads, leaf_size):
    team = Team(threads)
    for scene in (
        Scene(()),
        scene_of(Sphere((1, 2, 3), 0.5)),
        soup(1),
        soup(2),
        soup(9000),  # two pieces for threads
        Scene(tuple(replace(e, shape=unmoved(e.shape)) for e in RANDOM.objects)),
        scene_of(*(Sphere((x * 1e-3, 1e3, 1e-3), 0.1) for x in range(200))),
    ):
        flat = flatten(scene)
        check(flat, binary(flat, team, leaf_size), leaf_size)
    team.close()


@pytest.mark.parametrize("count", [5, 3_000])
def test_triangles_that_cannot_be_told_apart_are_halved(count):
    vertices = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], float)
    flat = flatten(scene_of(Mesh(vertices, np.tile([0, 1, 2], (count, 1)))))
    bvh = binary(flat, Team(1))
    check(flat, bvh, 4)
    assert bvh.depth <= np.ceil(np.log2(count)) + 1
    t, primitive, _, _ = cast(
        tree_of(flat), np.array([[0.2, 0.2, 1.0]]), np.array([[0.0, 0.0, -1.0]]), 0.0, np.inf
    )
    assert (t[0], primitive[0]) == (1.0, 0)


def test_the_depth_is_bounded_where_sizes_explode():
    # Each triangle is twice the size of the one before: splits take off one at a time.
    sizes = 2.0 ** np.arange(-60, 36, 0.25)
    corners = np.array([[1, 0, 0], [0, 1, 0], [0, 0, 1]])
    vertices = (sizes[:, None, None] * corners).reshape(-1, 3)
    flat = flatten(scene_of(Mesh(vertices, np.arange(len(vertices)).reshape(-1, 3))))
    bvh = binary(flat, Team(1), 1)
    check(flat, bvh, 1)
    assert bvh.depth <= MAX_DEPTH + 32


def nodes_of(bvh):
    """Each node's box and, of a leaf, its primitives' places; sorted: not by place in memory."""
    leaves = np.where(bvh.links[:, 1:] > 0, bvh.links, 0)
    rows = np.concatenate([bvh.bounds, leaves], axis=1)
    return rows[np.lexsort(rows.T)]


def test_the_tree_does_not_depend_on_the_threads():
    # Few primitives go round in pieces of one size. Of many, more threads take smaller pieces: that
    # decides where nodes stand, not what they are.
    for count, is_one_size in ((40_000, True), (150_000, False)):
        flat = flatten(soup(count))
        trees = []
        for threads in (1, 2, 3, 7):
            team = Team(threads)
            trees.append(binary(flat, team))
            team.close()
        first = trees[0]
        for tree in trees[1:]:
            assert np.array_equal(tree.order, first.order)
            assert tree.depth == first.depth
            assert np.array_equal(nodes_of(tree), nodes_of(first))
            assert np.array_equal(tree.links, first.links) == is_one_size
