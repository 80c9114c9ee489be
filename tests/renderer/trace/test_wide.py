"""The wide tree and the two levels: every triangle once, inside its boxes; what moves, moves."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from trace_reference import ball

from lucida.renderer.scene.flat import flatten
from lucida.renderer.scene.model import Mesh, Scene, SceneObject, Sphere
from lucida.renderer.trace.bvh.binary import build
from lucida.renderer.trace.bvh.bvh16 import (
    CORNERS,
    FIRST_LEAF,
    NO_CHILD,
    WIDTH,
    collapse,
    tree_of_boxes,
    tree_of_mesh,
)
from lucida.renderer.trace.bvh.instances import Instances
from lucida.renderer.trace.threads.thread_pool import Team


def wide(mesh, threads=2):
    team = Team(threads)
    try:
        return tree_of_mesh(mesh.vertices, mesh.faces, team)
    finally:
        team.close()


def top_bounds(instances):
    """Return the bounds of the upper tree, in the world."""
    return instances.bounds[-1] + instances.world_from_space[-1, :3, 3]


def shards(count, seed=1):
    random = np.random.default_rng(seed)
    corners = random.uniform(-1, 1, (count, 1, 3)) + random.normal(scale=0.03, size=(count, 3, 3))
    return Mesh(corners.reshape(-1, 3), np.arange(3 * count).reshape(-1, 3))


@pytest.mark.parametrize("count", [1, 2, 16, 17, 300, 20_000])
def test_each_triangle_is_in_one_leaf_within_its_boxes(count):
    mesh = shards(count)
    tree = wide(mesh)
    face, child = tree.face.reshape(-1, WIDTH), tree.child.reshape(-1, WIDTH)
    box, corner = tree.box.reshape(-1, 2, 3, WIDTH), tree.corner.reshape(-1, 3, 3, WIDTH)
    assert np.array_equal(np.sort(face[face >= 0]), np.arange(count))
    seen_leaves = []
    deepest = 0

    def visit(node, low, high, level):
        nonlocal deepest
        deepest = max(deepest, level)
        for lane in np.flatnonzero(child[node] != NO_CHILD):
            inner_low, inner_high = box[node, :, :, lane]
            assert (inner_low >= low).all()
            assert (inner_high <= high).all()
            if child[node, lane] >= 0:
                visit(child[node, lane], inner_low, inner_high, level + 1)
                continue
            leaf = FIRST_LEAF - child[node, lane]
            seen_leaves.append(leaf)
            used = face[leaf] >= 0
            assert (corner[leaf][..., used] >= inner_low[:, None]).all()
            assert (corner[leaf][..., used] <= inner_high[:, None]).all()
            vertices = mesh.vertices[mesh.faces[face[leaf, used]]]
            assert np.array_equal(np.moveaxis(corner[leaf][..., used], 2, 0), vertices)
            # Not a triangle without an area: for such a one, packets compute the leaf in float64.
            assert np.isnan(corner[leaf][..., ~used]).all()

    visit(0, *tree.bounds.astype(np.float32), 1)
    assert sorted(seen_leaves) == list(range(len(face)))
    assert deepest == tree.levels


def test_normals_are_those_of_the_winding():
    mesh = ball()
    tree = wide(mesh)
    used = tree.face >= 0
    normal = np.moveaxis(tree.normal.reshape(-1, 3, WIDTH), 1, 2).reshape(-1, 3)[used]
    a, b, c = mesh.vertices[mesh.faces[tree.face[used]].T].astype(float)
    wanted = np.cross(b - a, c - a)
    lengths = np.linalg.norm(wanted, axis=1)
    assert np.allclose(normal[lengths > 0], (wanted / lengths[:, None])[lengths > 0], atol=1e-6)
    assert not normal[lengths == 0].any()


def test_a_triangle_takes_at_most_120_bytes():
    mesh = shards(100_000)
    tree = wide(mesh)
    size_bytes = sum(array.nbytes for array in tree if isinstance(array, np.ndarray))
    assert size_bytes <= 120 * len(mesh.faces)
    assert len(tree.corner) == len(tree.face) // WIDTH * CORNERS


@pytest.mark.parametrize("count", [300, 4000])
def test_nodes_have_the_least_surface_that_a_binary_tree_allows(count):
    mesh, team = shards(count), Team(2)
    no_spheres = np.zeros((0, 4), np.float32)
    binary = build(mesh.vertices, mesh.faces, no_spheres, team, leaf_size=WIDTH)
    team.close()

    def surface(low, high):
        x, y, z = high.astype(float) - low
        return float(x * y + y * z + z * x)

    @cache
    def least(node, slots):
        """The surface of all wide nodes below a binary node that has so many slots above it."""
        first, size = binary.links[node]
        if size:
            return 0.0
        alone = surface(*binary.bounds[node].reshape(2, 3)) + opened(first, WIDTH)
        return alone if slots == 1 else min(alone, opened(first, slots))

    @cache
    def opened(first, slots):
        return min(least(first, k) + least(first + 1, slots - k) for k in range(1, slots))

    box, child, _, _ = collapse(binary)
    low, high = np.moveaxis(box.reshape(-1, 2, 3, WIDTH), 3, 1).reshape(-1, 2, 3).swapaxes(0, 1)
    taken = sum(surface(low[i], high[i]) for i in np.flatnonzero(child >= 0))
    assert taken == pytest.approx(opened(binary.links[0, 0], WIDTH), rel=1e-4)


@pytest.mark.parametrize("count", [1, 40, 3000])
def test_boxes_are_leaves_of_one(count):
    random = np.random.default_rng(2)
    low = random.uniform(-1, 1, (count, 3)).astype(np.float32)
    high = low + random.uniform(0, 0.1, (count, 3)).astype(np.float32)
    team = Team(2)
    box, child, _ = tree_of_boxes(low, high, team)
    team.close()
    is_leaf = child <= FIRST_LEAF
    item = FIRST_LEAF - child[is_leaf]
    assert np.array_equal(np.sort(item), np.arange(count))
    found = np.moveaxis(box.reshape(-1, 6, WIDTH), 1, 2).reshape(-1, 6)[is_leaf]
    assert np.array_equal(found, np.concatenate([low[item], high[item]], axis=1))


def scene_of(*shapes):
    return Scene(tuple(SceneObject(shape) for shape in shapes))


def placed(mesh, x):
    """The same arrays elsewhere."""
    transform = np.eye(4)
    transform[0, 3] = x
    moved = replace(mesh, transform=transform)
    for name in ("vertices", "faces"):
        object.__setattr__(moved, name, getattr(mesh, name))
    return moved


def test_objects_share_the_tree_of_a_shared_mesh():
    mesh, other = ball(), shards(50)
    scene = scene_of(mesh, placed(mesh, 3), Sphere((9, 0, 0)), other, placed(mesh, -3))
    team = Team(1)
    instances = Instances(scene, flatten(scene), team)
    world = instances.world
    assert np.count_nonzero(world.face >= 0) == len(mesh.faces) + len(other.faces)
    assert world.root[0] == world.root[1] == world.root[3] != world.root[2]
    assert world.root_object.tolist() == [0, 1, 3, 4]
    assert world.sphere_object.tolist() == [2]
    first = np.cumsum([0, len(mesh.faces), len(mesh.faces), len(other.faces)])
    assert world.first_primitive.tolist() == first.tolist()
    assert top_bounds(instances)[:, 0] == pytest.approx([-4, 10], abs=1e-4)

    # Move one object: the trees stay, the upper tree follows.
    moved = scene_of(mesh, placed(mesh, 7), Sphere((9, 0, 0)), other, placed(mesh, -20))
    instances.update(moved, flatten(moved))
    assert instances.world.box is world.box
    assert instances.world.corner is world.corner
    assert top_bounds(instances)[0, 0] == pytest.approx(-21, abs=1e-4)

    # Another mesh: only it is built.
    changed = scene_of(mesh, shards(60, seed=5))
    instances.update(changed, flatten(changed))
    assert np.count_nonzero(instances.world.face >= 0) == len(mesh.faces) + 60
    team.close()
