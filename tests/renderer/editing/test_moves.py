"""Moving objects and lights: where they go, and how that is written."""

from __future__ import annotations

import numpy as np
import pytest
from random_edits import item, stretched, table

from lucida.renderer.editing import changing, moving
from lucida.renderer.scene.shapes import placement
from lucida.renderer.system.errors import LucidaError


@pytest.mark.parametrize("seed", range(40))
def test_a_moved_object_is_where_its_matrix_puts_it(scene, seed):
    rng = np.random.default_rng(seed)
    box = item(scene, "box")
    scale = rng.uniform(0.3, 3, 3) * rng.choice([-1, 1], 3)
    angles = rng.choice([rng.uniform(-400, 400), 90, -90, 180, 0], 3)
    scene = changing.set_field(scene, [box], "rotate_deg", angles)
    scene = changing.set_field(scene, [box], "scale", scale)
    matrix = placement(rng.normal(size=3), rng.uniform(-180, 180, 3), float(rng.uniform(0.5, 2)))
    for now in (matrix, placement(rng.normal(size=3), rng.choice([0, 90, -90], 3))):
        moved = moving.transform(scene, [box], now)
        np.testing.assert_allclose(
            moving.matrix_of(moved, box), now @ moving.matrix_of(scene, box), atol=1e-9
        )
        np.testing.assert_allclose(
            moved.objects[2].shape.transform, now @ scene.objects[2].shape.transform, atol=1e-9
        )


def test_of_all_ways_to_write_a_matrix_the_nearest_is_found():
    """The written numbers come back, though others have the same matrix.

    Tried are rotations by more than a circle, mirrors, and gimbal lock, where z stays; also after
    the object is rotated a little.
    """
    rng = np.random.default_rng(3)
    for number in range(300):
        angles = rng.uniform(-700, 700, 3) * (rng.random(3) < 0.8)
        if number % 3 == 0:
            angles[1] = rng.choice([90, -90, 270, 450])
        else:  # of y and 180 - y the one that x and z go with
            angles[1] = rng.uniform(-89, 89)
        scale = rng.uniform(0.3, 3, 3) * rng.choice([-1, 1], 3)
        linear = placement((0, 0, 0), angles, scale)[:3, :3]
        found, factors = moving.decomposed(linear, angles, scale)
        assert factors == pytest.approx(scale)
        np.testing.assert_allclose(placement((0, 0, 0), found, factors)[:3, :3], linear, atol=1e-9)
        if number % 3:
            assert found == pytest.approx(angles)
            near = angles + rng.uniform(-5, 5, 3)
            assert moving.decomposed(linear, near, scale)[0] == pytest.approx(angles)
        else:
            assert found[2] == pytest.approx(angles[2])
            assert abs(found - angles).max() < 360.001


def test_what_a_move_leaves_alone_stays_as_it_is_written(scene):
    box, before = item(scene, "box"), table(scene, "box")
    moved = changing.table_of(moving.transform(scene, [box], placement((0, 0.5, 0))), box)
    assert moved == {**before, "translate": [0.8, 0.5, 0]}
    turned = changing.table_of(
        moving.transform(scene, [box], placement((0, 0, 0), (0, 15, 0))), box
    )
    assert turned["rotate_deg"] == [0, 45, 0] and "scale" not in turned
    mirrored = stretched(scene, box, placement(scale=(-1, 1, 1)))
    assert table(mirrored, "box")["scale"] == [-1.0, 1.0, 1.0]
    assert table(mirrored, "box")["rotate_deg"] == [0, 30, 0]
    same = moving.transform(scene, [box, item(scene, "ball")], np.eye(4))
    assert changing.table_of(same, box) == before


def test_what_a_file_cannot_hold_is_refused(scene):
    stretch = placement(scale=(2, 1, 1))
    with pytest.raises(LucidaError, match=r"objects\[2\]\.scale: would shear"):
        moving.transform(scene, [item(scene, "box")], stretch)
    with pytest.raises(LucidaError, match=r"objects\[1\]\.scale: would make an ellipsoid"):
        moving.transform(scene, [item(scene, "ball")], stretch)
    with pytest.raises(LucidaError, match="flattens"):
        moving.transform(scene, [item(scene, "box")], np.diag([1, 0, 1, 1]))
    with pytest.raises(LucidaError, match="finite"):
        moving.transform(scene, [item(scene, "box")], np.full((4, 4), np.nan))


def test_spheres_and_lights_move_by_their_own_numbers(scene):
    ball, sun, lamp = (
        item(scene, name) for name in ("ball", "directional light 0", "point light 1")
    )
    moved = moving.transform(scene, [ball, sun, lamp], placement((1, 0, 0), (0, 90, 0), 2.0))
    assert table(moved, "ball")["radius"] == pytest.approx(1.2)
    assert table(moved, "ball")["center"] == pytest.approx([1, 0, 1.4])
    assert table(moved, "directional light 0")["direction"] == pytest.approx([-0.5, -1, -0.4])
    assert table(moved, "point light 1")["position"] == pytest.approx([5, 6, -4])
    assert scene.objects[0] is moved.objects[0]
    bounds = moving.bounds_of(scene, [ball, lamp])
    np.testing.assert_allclose(bounds, [[-1.3, -0.6, -0.6], [2, 3, 2]])
    assert moving.bounds_of(scene, [sun]) is None
    np.testing.assert_allclose(
        moving.matrix_of(scene, sun)[:3, 2], -np.array([0.4, -1, -0.5]) / np.sqrt(1.41)
    )
